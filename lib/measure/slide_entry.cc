#include "measure/slide_entry.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "case/polygon.hh"
#include "files/domain.hh"
#include "physics/rigid_motion.hh"

namespace lgiw {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// The `share` quantile of sorted values.
double quantile(const std::vector<double>& sorted, double share) {
  return sorted[std::size_t(std::lround(share * double(sorted.size() - 1)))];
}

/// Middles of cells of `dp` that lie in an outline (x, z in the case's CRS), in 3-D over the whole width; local, [n,3].
void fill_outline(std::vector<double>& points, const std::vector<Point2>& outline, const ParticleHeader& header) {
  const double dp = header.dp;
  Point2 low = outline.front(), high = low;
  for (const Point2& p : outline)
    for (int a = 0; a < 2; ++a) low[a] = std::min(low[a], p[a]), high[a] = std::max(high[a], p[a]);
  const bool flat = header.dimension == 2;
  for (double x = low[0] + dp / 2; x < high[0]; x += dp)
    for (double z = low[1] + dp / 2; z < high[1]; z += dp) {
      if (!contains(outline, {x, z})) continue;
      for (double y = flat ? 0 : header.low[1] + dp / 2; y < (flat ? 1 : header.high[1]); y += flat ? 1 : dp)
        points.insert(points.end(), {x - header.origin[0], y, z - header.origin[2]});
    }
}

/// The same of what lies between bed and ground of a DEM.
void fill_ground(std::vector<double>& points, const ParticleHeader& header) {
  const double dp = header.dp;
  for (double y = header.low[1] + dp / 2; y < header.high[1]; y += dp)
    for (double x = header.low[0] + dp / 2; x < header.high[0]; x += dp) {
      const double bed = header.bed.height(x, y), top = header.ground.height(x, y);
      for (double z = bed + dp / 2; z < top; z += dp) points.insert(points.end(), {x, y, z});
    }
}

/// The pieces of a body at t = 0.
std::vector<double> body_pieces(const ParticleHeader& header, const Case& c, std::size_t body) {
  std::vector<double> points;
  if (c.slide.motion && body == 0) {
    if (c.slide.bodies.empty()) fill_ground(points, header);
    for (const auto& outline : c.slide.bodies) fill_outline(points, outline, header);
  } else if (const std::size_t k = body - (c.slide.motion ? 1 : 0); k < c.bodies.size()) {
    fill_outline(points, c.bodies[k].outline, header);
  }
  return points;
}

/// What of a motion lies between two times, with rows at both; it rests before its first row and after its last one.
BodyMotion part_of_motion(const BodyMotion& whole, double from, double to) {
  BodyMotion part = whole;
  part.time.clear(), part.displacement.clear(), part.pitch.clear();
  const auto add = [&](double time) {
    const auto next = std::upper_bound(whole.time.begin(), whole.time.end(), time);
    const std::size_t b = std::min(std::size_t(next - whole.time.begin()), whole.time.size() - 1), a = b ? b - 1 : 0;
    const double span = whole.time[b] - whole.time[a];
    const double share = span > 0 ? std::clamp((time - whole.time[a]) / span, 0.0, 1.0) : 0;
    std::array<double, 3> way;
    for (std::size_t k = 0; k < 3; ++k)
      way[k] = (1 - share) * whole.displacement[a][k] + share * whole.displacement[b][k];
    part.time.push_back(time), part.displacement.push_back(way);
    part.pitch.push_back((1 - share) * whole.pitch[a] + share * whole.pitch[b]);
  };
  add(from);
  for (double time : whole.time)
    if (time > from && time < to) add(time);
  if (to > from) add(to);
  return part;
}

/// A body at each row of its motion until the end of the run; between rows it moves evenly.
SlideEntry body_entry(const ParticleHeader& header, const BodyMotion& whole, const std::vector<double>& start,
                      double end) {
  const BodyMotion motion = part_of_motion(whole, 0, std::max(0.0, std::min(end, whole.time.back())));
  const double ahead[2] = {std::sin(motion.heading * degree), std::cos(motion.heading * degree)};
  SlideEntryRecorder recorder(header, header.dp, std::pow(header.dp, header.dimension));
  const auto placed = [&](std::size_t row) {
    const std::array<double, 3>& way = motion.displacement[row];
    const MotionRow only{motion.time[row], {way[0], way[1], way[2], motion.pitch[row]}, {}, {}};
    const RigidState state = rigid_state(&only, 1, motion.pivot.data(), motion.time[row]);
    std::vector<float> points;
    for (std::size_t p = 0; p < start.size(); p += 3) {
      double arm[3], place[3], velocity[3], acceleration[3];
      for (int a = 0; a < 3; ++a) arm[a] = start[p + a] - motion.pivot[a];
      rigid_point(state, ahead[0], ahead[1], arm, place, velocity, acceleration);
      points.insert(points.end(), {float(place[0]), float(place[1]), float(place[2])});
    }
    return points;
  };
  // A row twice: with the velocity before and after it.
  std::vector<float> here = placed(0);
  for (std::size_t row = 0; row + 1 < motion.time.size(); ++row) {
    const std::vector<float> next = placed(row + 1);
    std::vector<float> velocity(here.size());
    for (std::size_t k = 0; k < here.size(); ++k)
      velocity[k] = float((next[k] - here[k]) / (motion.time[row + 1] - motion.time[row]));
    recorder.add(motion.time[row], {here, velocity});
    recorder.add(motion.time[row + 1], {next, velocity});
    here = next;
  }
  return recorder.entry();
}

}  // namespace

double SlideEntryRecorder::Passage::speed() const { return std::hypot(velocity[0], velocity[1], velocity[2]); }

SlideEntryRecorder::SlideEntryRecorder(const ParticleHeader& header, double size, double volume)
    : header_(header), size_(size), volume_(volume) {}

double SlideEntryRecorder::bed_above_level(const SlidePieces& pieces, std::size_t piece) const {
  const float* r = pieces.points.data() + 3 * piece;
  return header_.bed.empty() ? no_value : header_.bed.height(r[0], r[1]) - header_.still_water_level;
}

void SlideEntryRecorder::add(double time, SlidePieces pieces) {
  const std::size_t n = pieces.points.size() / 3;
  const double level = header_.still_water_level, span = time - last_time_;
  if (passages_.size() != n) first_ = pieces, first_time_ = time, passages_.resize(n);
  for (std::size_t k = 0; k < n && !last_.points.empty() && span > 0; ++k) {
    Passage& passage = passages_[k];
    const float *from = last_.points.data() + 3 * k, *to = pieces.points.data() + 3 * k;
    if (passage.sunk || !(first_.points[3 * k + 2] > level)) continue;
    // The share of the step at which a height above something becomes 0; more than 1 where it does not.
    const auto share_of = [](double before, double after) {
      return before > 0 && after <= 0 ? before / (before - after) : 2.0;
    };
    const double sinks = share_of(from[2] - level, to[2] - level);
    if (!passage.there) {
      const double shore = share_of(bed_above_level(last_, k), bed_above_level(pieces, k));
      const double share = std::min(sinks, shore);
      if (share > 1) continue;
      passage.there = true;
      passage.time = last_time_ + share * span;
      // Along the shoreline's normal, or downwards: whichever way it passes.
      const double way = shore < sinks ? std::hypot(to[0] - from[0], to[1] - from[1]) : from[2] - to[2];
      passage.duration = std::min(size_ * span / way, 2 * (passage.time - first_time_));
      for (std::size_t a = 0; a < 3; ++a) {
        passage.place[a] = (1 - share) * from[a] + share * to[a];
        passage.velocity[a] = (1 - share) * last_.velocity[3 * k + a] + share * pieces.velocity[3 * k + a];
      }
    }
    passage.sunk = sinks <= 1;
  }
  last_ = std::move(pieces), last_time_ = time;
}

SlideEntry SlideEntryRecorder::entry() const {
  SlideEntry entry;
  std::vector<Passage> passages;
  std::array<double, 3> way{};  // to the shoreline, summed
  for (std::size_t k = 0; k < passages_.size(); ++k) {
    const Passage& p = passages_[k];
    if (first_.points[3 * k + 2] <= header_.still_water_level) entry.submerged_volume += volume_;
    if (!p.sunk) continue;
    passages.push_back(p);
    for (std::size_t a = 0; a < 3; ++a) way[a] += p.place[a] - first_.points[3 * k + a];
  }
  const std::size_t n = passages.size();
  entry.volume = double(n) * volume_;
  if (n == 0) return entry;

  std::array<double, 3> place{}, velocity{};
  std::vector<double> speeds;
  for (const Passage& p : passages) {
    for (std::size_t a = 0; a < 3; ++a) {
      place[a] += p.place[a] / double(n), velocity[a] += p.velocity[a] / double(n);
    }
    speeds.push_back(p.speed());
  }
  std::sort(speeds.begin(), speeds.end());
  entry.speed = 0;
  for (double v : speeds) entry.speed += v / double(n);
  entry.slow_speed = quantile(speeds, 0.1), entry.fast_speed = quantile(speeds, 0.9);
  const double forward = std::hypot(velocity[0], velocity[1]);
  entry.slope = std::atan2(-velocity[2], forward) / degree;
  if (forward > 0) entry.ahead = {velocity[0] / forward, velocity[1] / forward};
  const double azimuth = std::atan2(entry.ahead[0], entry.ahead[1]) / degree;
  entry.direction = azimuth < 0 ? azimuth + 360 : azimuth;
  entry.x = place[0] + header_.origin[0], entry.y = place[1] + header_.origin[1];
  entry.drop = -way[2] / double(n);
  entry.travel_slope = std::atan2(-way[2], std::hypot(way[0], way[1])) / degree;

  entry.width = 1;
  if (header_.dimension == 3) {
    double variance = 0;
    for (const Passage& p : passages) {
      const double aside = (p.place[1] - place[1]) * entry.ahead[0] - (p.place[0] - place[0]) * entry.ahead[1];
      variance += aside * aside / double(n);
    }
    // Exact for columns of pieces side by side: their middles alone vary by size^2/12 less.
    entry.width = std::sqrt(12 * variance + size_ * size_);
  }

  // A piece enters bit by bit, and those of a row not all at the same times, so that the flux does not depend on how
  // the rows happen to pass.
  constexpr int bits = 8;
  constexpr double golden = 0.6180339887498949;
  struct Bit {
    double time, speed;
  };
  std::vector<Bit> flow;
  for (std::size_t k = 0; k < n; ++k) {
    const double first = golden * double(k) - std::floor(golden * double(k));
    for (int b = 0; b < bits; ++b)
      flow.push_back({passages[k].time + ((b + first) / bits - 0.5) * passages[k].duration, passages[k].speed()});
  }
  std::sort(flow.begin(), flow.end(), [](const Bit& a, const Bit& b) { return a.time < b.time; });
  entry.start = flow[flow.size() / 20].time, entry.end = flow[flow.size() - 1 - flow.size() / 20].time;
  const std::size_t parts = std::min<std::size_t>(10, std::max<std::size_t>(1, n / 5));
  entry.thickness = 0;
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t from = part * flow.size() / parts, to = (part + 1) * flow.size() / parts;
    double speed = 0;
    for (std::size_t k = from; k < to; ++k) speed += flow[k].speed / double(to - from);
    // From the first bit to the last there is one interval less than there are bits.
    const double span = (flow[to - 1].time - flow[from].time) * double(to - from) / double(to - from - 1);
    const double part_volume = double(to - from) / bits * volume_;
    if (span > 0 && speed > 0) entry.thickness = std::max(entry.thickness, part_volume / (span * entry.width * speed));
  }
  return entry;
}

SlideEntry measure_slide_entry(const RunReader& run, const Case& c) {
  const RunHeader& header = run.header();
  const ParticleHeader& p = header.particles;
  if (p.counts.soil > 0 && run.frame_count() > 0) {
    const std::size_t first = std::size_t(p.counts.water), soil = std::size_t(p.counts.soil);
    const Frame last = run.frame(run.frame_count() - 1);
    std::vector<std::size_t> slide;
    for (std::size_t k = first; k < first + soil; ++k)
      if (last.adps[k] > c.deposit.adps_threshold) slide.push_back(k);
    SlideEntryRecorder recorder(p, p.dp, header.particle_volume);
    for (std::size_t f = 0; f < run.frame_count(); ++f) {
      const Frame frame = run.frame(f);
      SlidePieces pieces;
      for (const std::size_t k : slide)
        for (std::size_t a = 0; a < 3; ++a) {
          pieces.points.push_back(frame.points[3 * k + a]);
          pieces.velocity.push_back(frame.velocity[3 * k + a]);
        }
      recorder.add(frame.time, std::move(pieces));
    }
    return recorder.entry();
  }
  const std::vector<double>& times = run.surface_times();
  const double end = times.empty() ? std::numeric_limits<double>::max() : times.back();
  for (std::size_t k = 0; k < p.bodies.size(); ++k) {
    const SlideEntry entry = body_entry(p, p.bodies[k], body_pieces(p, c, k), end);
    if (entry.volume > 0) return entry;
  }
  return {};
}

WaterAhead water_ahead(const RunHeader& header, const std::vector<float>& first_water, const SlideEntry& entry) {
  const ParticleHeader& p = header.particles;
  const HeightField& ground = ground_of(p);
  WaterAhead water;
  if (ground.empty()) return water;
  double near = no_value, far = no_value, edge = no_value;
  for (double r = 0;; r += header.map.dx / 2) {
    const double x = entry.x + r * entry.ahead[0], y = entry.y + r * entry.ahead[1];
    if (!inside_domain(p, x, y)) break;
    if (std::isnan(sample_surface(header.map, first_water, x - p.origin[0], y - p.origin[1]))) continue;
    if (std::isnan(edge)) edge = r, water.x = x, water.y = y;
    const double depth = p.still_water_level - ground.height(x - p.origin[0], y - p.origin[1]);
    if (!(depth <= 0) && !(depth <= far)) far = depth;
    if (r - edge <= 5 * depth && !(depth <= near)) near = depth;
  }
  water.depth = std::isnan(near) ? far : near;
  return water;
}

}  // namespace lgiw
