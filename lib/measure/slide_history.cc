#include "measure/slide_history.hh"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.hh"
#include "measure/surface_sampling.hh"

namespace lgiw {
namespace {

/// Marks the particles of the largest group, which hang together over square cells (corners count); `points` [n,3].
std::vector<uint8_t> largest_group(const std::vector<std::array<double, 3>>& points, double cell) {
  std::vector<uint8_t> in_group(points.size(), 0);
  if (points.empty()) return in_group;
  double x0 = points[0][0], y0 = points[0][1], x1 = x0, y1 = y0;
  for (const auto& p : points) {
    x0 = std::min(x0, p[0]), x1 = std::max(x1, p[0]);
    y0 = std::min(y0, p[1]), y1 = std::max(y1, p[1]);
  }
  const int64_t nx = int64_t((x1 - x0) / cell) + 1, ny = int64_t((y1 - y0) / cell) + 1;
  const auto cell_of = [&](const std::array<double, 3>& p) {
    return std::size_t(int64_t((p[1] - y0) / cell) * nx + int64_t((p[0] - x0) / cell));
  };
  std::vector<int64_t> count(std::size_t(nx * ny), 0), group(std::size_t(nx * ny), -1);
  for (const auto& p : points) ++count[cell_of(p)];
  std::vector<int64_t> sizes;
  for (std::size_t start = 0; start < count.size(); ++start) {
    if (!count[start] || group[start] >= 0) continue;
    const int64_t name = int64_t(sizes.size());
    sizes.push_back(0);
    std::vector<std::size_t> open{start};
    group[start] = name;
    while (!open.empty()) {
      const int64_t n = int64_t(open.back()), i = n % nx, j = n / nx;
      open.pop_back();
      sizes.back() += count[std::size_t(n)];
      for (int64_t jj = std::max<int64_t>(0, j - 1); jj <= std::min(ny - 1, j + 1); ++jj)
        for (int64_t ii = std::max<int64_t>(0, i - 1); ii <= std::min(nx - 1, i + 1); ++ii) {
          const std::size_t k = std::size_t(jj * nx + ii);
          if (count[k] && group[k] < 0) group[k] = name, open.push_back(k);
        }
    }
  }
  const int64_t largest = std::max_element(sizes.begin(), sizes.end()) - sizes.begin();
  for (std::size_t p = 0; p < points.size(); ++p) in_group[p] = group[cell_of(points[p])] == largest;
  return in_group;
}

}  // namespace

SlideHistory::SlideHistory(const RunHeader& header, const Frame& last, double adps_threshold)
    : header_(header),
      last_(last),
      threshold_(adps_threshold),
      first_(std::size_t(header.particles.counts.water)),
      n_soil_(std::size_t(header.particles.counts.soil)) {
  LGIW_EXPECT(n_soil_ > 0 && header.initial_soil.size() == 3 * n_soil_);
  body_.resize(n_soil_);
  for (std::size_t k = 0; k < n_soil_; ++k) body_[k] = sliding(last_, k);
  initial_below_level_ = volume_below_level(header.initial_soil, 0, nullptr);
}

bool SlideHistory::sliding(const Frame& frame, std::size_t soil) const {
  return !frame.lost[first_ + soil] && frame.adps[first_ + soil] > threshold_;
}

double SlideHistory::total_volume() const { return double(n_soil_) * header_.particle_volume; }

double SlideHistory::volume_below_level(const std::vector<float>& points, std::size_t first,
                                        const uint8_t* lost) const {
  const double level = header_.particles.still_water_level, dp = header_.particles.dp;
  if (std::isnan(level)) return no_value;
  double particles = 0;
  for (std::size_t k = 0; k < n_soil_; ++k)
    if (!lost || !lost[k]) particles += std::clamp((level - points[3 * (first + k) + 2]) / dp + 0.5, 0.0, 1.0);
  return particles * header_.particle_volume;
}

std::array<double, 3> SlideHistory::centre(const Frame& frame) const {
  std::array<double, 3> sum{};
  double n = 0;
  for (std::size_t k = 0; k < n_soil_; ++k) {
    if (!body_[k] || frame.lost[first_ + k]) continue;
    for (int a = 0; a < 3; ++a) sum[a] += frame.points[3 * (first_ + k) + a];
    ++n;
  }
  for (double& s : sum) s = n > 0 ? s / n : no_value;
  return sum;
}

SlideState SlideHistory::state(const Frame& frame) const {
  SlideState state;
  state.time = frame.time;
  std::size_t slide = 0, unmoved = 0, lost = 0;
  std::vector<double> speeds;
  for (std::size_t k = 0; k < n_soil_; ++k) {
    const std::size_t p = first_ + k;
    if (frame.lost[p]) {
      ++lost;
      continue;
    }
    // Not the negation of sliding(): a particle whose strain is not a number is neither.
    if (sliding(frame, k)) ++slide;
    if (frame.adps[p] <= threshold_) ++unmoved;
    if (body_[k])
      speeds.push_back(std::hypot(frame.velocity[3 * p], frame.velocity[3 * p + 1], frame.velocity[3 * p + 2]));
  }
  if (slide + unmoved + lost != n_soil_)
    throw WorkError("the bookkeeping of the soil does not close at t = " + std::to_string(frame.time) + " s",
                    std::to_string(slide) + " sliding + " + std::to_string(unmoved) + " unmoved + " +
                        std::to_string(lost) + " lost are not " + std::to_string(n_soil_) + " particles",
                    "the run is damaged: make it again");
  const double volume = header_.particle_volume;
  state.slide_volume = double(slide) * volume;
  state.unmoved_volume = double(unmoved) * volume;
  state.lost_volume = double(lost) * volume;
  state.immersed_volume = volume_below_level(frame.points, first_, frame.lost.data() + first_) - initial_below_level_;
  state.mean_speed = state.p99_speed = state.max_speed = no_value;
  if (!speeds.empty()) {
    std::sort(speeds.begin(), speeds.end());  // also makes the sum independent of the particles' order
    double sum = 0;
    for (double v : speeds) sum += v;
    state.mean_speed = sum / double(speeds.size());
    state.p99_speed = speeds[std::size_t(0.99 * double(speeds.size() - 1))];
    state.max_speed = speeds.back();
  }
  state.centre = centre(frame);
  for (int a = 0; a < 3; ++a) state.centre[a] += header_.particles.origin[a];
  return state;
}

SlideDeposit SlideHistory::deposit() const {
  SlideDeposit deposit{no_value, no_value, no_value, no_value, no_value, no_value, no_value};
  const double dp = header_.particles.dp;
  const bool flat = header_.particles.dimension == 2;
  std::vector<std::array<double, 3>> points;
  std::array<double, 2> motion{};
  for (std::size_t k = 0; k < n_soil_; ++k) {
    if (!body_[k]) continue;
    const float* r = last_.points.data() + 3 * (first_ + k);
    points.push_back({r[0], flat ? 0 : r[1], r[2]});
    for (int a = 0; a < (flat ? 1 : 2); ++a) motion[a] += r[a] - header_.initial_soil[3 * k + a];
  }
  if (points.empty()) return deposit;
  const double runout = std::hypot(motion[0], motion[1]) / double(points.size());
  deposit.runout = runout;

  const std::vector<uint8_t> in_group = largest_group(points, 2 * dp);
  const bool moved = runout > 1e-6 * dp;
  const std::array<double, 2> along = moved ? std::array<double, 2>{motion[0] / (runout * double(points.size())),
                                                                    motion[1] / (runout * double(points.size()))}
                                            : std::array<double, 2>{1, 0};
  const auto front = [&](const float* r) {  // 99th percentile along the motion
    std::vector<double> l(n_soil_);
    for (std::size_t k = 0; k < n_soil_; ++k) l[k] = r[3 * k] * along[0] + (flat ? 0 : r[3 * k + 1] * along[1]);
    const auto rank = std::ptrdiff_t(0.99 * double(n_soil_ - 1));
    std::nth_element(l.begin(), l.begin() + rank, l.end());
    return l[std::size_t(rank)];
  };
  const double front_now = front(last_.points.data() + 3 * first_);
  deposit.front_runout = front_now - front(header_.initial_soil.data());
  if (flat) deposit.front_x = front_now * along[0] + header_.particles.origin[0];

  std::array<double, 2> low{infinite, infinite}, high{-infinite, -infinite};
  double top = -infinite;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (!in_group[p]) continue;
    const auto& r = points[p];
    const double l = r[0] * along[0] + r[1] * along[1], w = r[1] * along[0] - r[0] * along[1];
    low = {std::min(low[0], l), std::min(low[1], w)};
    high = {std::max(high[0], l), std::max(high[1], w)};
    top = std::max(top, r[2]);
  }
  deposit.height_above_water = top + dp / 2 - header_.particles.still_water_level;
  if (!moved) return deposit;
  const double azimuth = std::atan2(along[0], along[1]) * 180 / std::numbers::pi;
  deposit.direction = azimuth < 0 ? azimuth + 360 : azimuth;
  deposit.length = high[0] - low[0] + dp;
  if (!flat) deposit.width = high[1] - low[1] + dp;
  return deposit;
}

std::vector<float> SlideHistory::thickness(const SurfaceMap& map) const {
  std::vector<double> volume(map.size(), 0);
  for (std::size_t k = 0; k < n_soil_; ++k) {
    if (!body_[k]) continue;
    const float* r = last_.points.data() + 3 * (first_ + k);
    const double u = (r[0] - map.x0) / map.dx, v = (r[1] - map.y0) / map.dx;
    const double i = std::floor(u), j = std::floor(v), a = u - i, b = v - j;
    for (int dj = 0; dj < 2; ++dj)
      for (int di = 0; di < 2; ++di) {
        if (i + di < 0 || j + dj < 0 || i + di >= double(map.nx) || j + dj >= double(map.ny)) continue;
        volume[std::size_t(j + dj) * map.nx + std::size_t(i + di)] += (di ? a : 1 - a) * (dj ? b : 1 - b);
      }
  }
  std::vector<float> result(map.size(), float(no_value));
  for (std::size_t n = 0; n < result.size(); ++n)
    if (volume[n] > 0) result[n] = float(volume[n] * header_.particle_volume / (map.dx * map.dx));
  return result;
}

}  // namespace lgiw
