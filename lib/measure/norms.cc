#include "measure/norms.hh"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hh"

namespace lgiw {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr Extreme no_extreme{nothing, nothing};

/// The largest of sign * value in the first stretch in which it is above zero and rises above `threshold`.
Extreme first_extreme(const Series& series, double sign, double threshold) {
  Extreme best = no_extreme;
  const auto significant = [&] { return sign * best.value > threshold; };
  for (std::size_t k = 0; k < series.time.size(); ++k) {
    const double v = sign * series.value[k];
    if (v > 0 && !(v <= sign * best.value)) best = {series.value[k], series.time[k]};
    if (v <= 0) {
      if (significant()) break;
      best = no_extreme;  // a ripple
    }
  }
  return significant() ? best : no_extreme;
}

Extreme extreme_of_all(const Series& series, double sign) {
  Extreme best = no_extreme;
  for (std::size_t k = 0; k < series.time.size(); ++k)
    if (!std::isnan(series.value[k]) && !(sign * series.value[k] <= sign * best.value))
      best = {series.value[k], series.time[k]};
  return best;
}

double median_step(const Series& series) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < series.time.size(); ++k) steps.push_back(series.time[k] - series.time[k - 1]);
  std::nth_element(steps.begin(), steps.begin() + std::ptrdiff_t(steps.size() / 2), steps.end());
  return steps[steps.size() / 2];
}

/// Pearson's coefficient of a[i + shift] and b[i] over the pairs that have both; NaN where fewer than half of all do or
/// where one does not vary.
double correlation_at(const std::vector<double>& a, const std::vector<double>& b, std::ptrdiff_t shift) {
  const auto n = std::ptrdiff_t(b.size()), first = std::max<std::ptrdiff_t>(0, -shift);
  const std::ptrdiff_t last = std::min(n, n - shift);
  double count = 0, sum_a = 0, sum_b = 0;
  const auto each_pair = [&](auto&& use) {
    for (std::ptrdiff_t i = first; i < last; ++i) {
      const double u = a[std::size_t(i + shift)], v = b[std::size_t(i)];
      if (!std::isnan(u) && !std::isnan(v)) use(u, v);
    }
  };
  each_pair([&](double u, double v) { ++count, sum_a += u, sum_b += v; });
  if (2 * count < double(n)) return nothing;
  double aa = 0, bb = 0, ab = 0;
  each_pair([&](double u, double v) {
    const double da = u - sum_a / count, db = v - sum_b / count;
    aa += da * da, bb += db * db, ab += da * db;
  });
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : nothing;
}

void find_lag(const Series& run, const Series& reference, SeriesNorms& norms) {
  norms.phase_lag = norms.correlation = nothing;
  const double length = norms.to - norms.from;
  const double step = std::max(std::min(median_step(run), median_step(reference)), length / 2000);
  const auto n = std::size_t(length / step + 1e-9) + 1;
  if (n < 8) return;
  std::vector<double> a(n), b(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = std::min(norms.from + double(i) * step, norms.to);
    a[i] = value_at(run, t), b[i] = value_at(reference, t);
  }
  // From no shift outwards, so that of equal peaks (a periodic wave) the nearest counts.
  const auto reach = std::ptrdiff_t(n / 4);
  std::ptrdiff_t best_shift = 0;
  for (std::ptrdiff_t k = 0; k <= reach; ++k)
    for (const std::ptrdiff_t shift : {k, -k}) {
      const double r = correlation_at(a, b, shift);
      // A gain at the level of rounding is none.
      if (!std::isnan(r) && !(r <= norms.correlation + 1e-12)) norms.correlation = r, best_shift = shift;
    }
  if (std::isnan(norms.correlation)) return;
  if (best_shift == reach || best_shift == -reach) {
    norms.correlation = nothing;
    return;
  }
  const double before = correlation_at(a, b, best_shift - 1), after = correlation_at(a, b, best_shift + 1);
  const double bend = before - 2 * norms.correlation + after;
  const double offset = bend < 0 ? 0.5 * (before - after) / bend : 0;  // NaN neighbours: no refinement
  norms.phase_lag = (double(best_shift) + offset) * step;
}

}  // namespace

double value_at(const Series& series, double time) {
  const auto& t = series.time;
  if (t.empty() || !(time >= t.front() && time <= t.back())) return nothing;
  const auto k = std::size_t(std::lower_bound(t.begin(), t.end(), time) - t.begin());
  if (t[k] == time) return series.value[k];
  const double a = (time - t[k - 1]) / (t[k] - t[k - 1]);
  return series.value[k - 1] + a * (series.value[k] - series.value[k - 1]);
}

Series part_of(const Series& series, double from, double to) {
  Series part;
  const auto add = [&](double t) { part.time.push_back(t), part.value.push_back(value_at(series, t)); };
  add(from);
  for (double t : series.time)
    if (t > from && t < to) add(t);
  if (to > from) add(to);
  return part;
}

Extreme first_crest(const Series& series, double threshold) { return first_extreme(series, 1, threshold); }
Extreme first_trough(const Series& series, double threshold) { return first_extreme(series, -1, threshold); }

double arrival_time(const Series& series, double threshold) {
  const auto size = [&](std::size_t k) { return std::abs(series.value[k]); };
  for (std::size_t k = 0; k < series.time.size(); ++k) {
    if (!(size(k) > threshold)) continue;
    if (k == 0 || !(size(k - 1) <= threshold)) return series.time[k];
    const double a = (threshold - size(k - 1)) / (size(k) - size(k - 1));
    return series.time[k - 1] + a * (series.time[k] - series.time[k - 1]);
  }
  return nothing;
}

SeriesFeatures features_of(const Series& series, double threshold) {
  return {extreme_of_all(series, 1), extreme_of_all(series, -1), first_crest(series, threshold),
          first_trough(series, threshold), arrival_time(series, threshold)};
}

SeriesNorms compare_series(const Series& run, const Series& reference, double threshold) {
  SeriesNorms norms;
  norms.rmse = norms.nrmse = norms.mae = norms.willmott_d = norms.phase_lag = norms.correlation = nothing;
  norms.run = norms.reference = {no_extreme, no_extreme, no_extreme, no_extreme, nothing};
  norms.from = norms.to = nothing;
  if (run.time.size() < 2 || reference.time.size() < 2) return norms;
  const double from = std::max(run.time.front(), reference.time.front());
  const double to = std::min(run.time.back(), reference.time.back());
  if (!(from < to)) return norms;
  norms.from = from, norms.to = to;
  norms.run = features_of(part_of(run, from, to), threshold);
  norms.reference = features_of(part_of(reference, from, to), threshold);

  std::vector<double> computed, observed;
  for (std::size_t k = 0; k < reference.time.size(); ++k) {
    const double p = value_at(run, reference.time[k]), o = reference.value[k];
    if (!std::isnan(p) && !std::isnan(o)) computed.push_back(p), observed.push_back(o);
  }
  norms.samples = observed.size();
  if (observed.empty()) return norms;
  const auto n = double(observed.size());
  double mean = 0, squares = 0, absolutes = 0, potential = 0;
  for (double o : observed) mean += o / n;
  for (std::size_t k = 0; k < observed.size(); ++k) {
    const double error = computed[k] - observed[k];
    squares += error * error, absolutes += std::abs(error);
    potential += std::pow(std::abs(computed[k] - mean) + std::abs(observed[k] - mean), 2);
  }
  const auto [low, high] = std::minmax_element(observed.begin(), observed.end());
  norms.rmse = std::sqrt(squares / n);
  norms.mae = absolutes / n;
  norms.nrmse = *high > *low ? norms.rmse / (*high - *low) : nothing;
  norms.willmott_d = potential > 0 ? 1 - squares / potential : nothing;
  find_lag(run, reference, norms);
  return norms;
}

AidaNumbers aida_numbers(const std::vector<double>& run, const std::vector<double>& reference) {
  LGIW_EXPECT(run.size() == reference.size());
  if (run.empty()) return {nothing, nothing};
  double mean = 0, square = 0;
  const auto n = double(run.size());
  for (std::size_t k = 0; k < run.size(); ++k) {
    if (!(run[k] > 0) || !(reference[k] > 0)) return {nothing, nothing};
    const double ratio = std::log(reference[k] / run[k]);
    mean += ratio / n, square += ratio * ratio / n;
  }
  return {std::exp(mean), std::exp(std::sqrt(std::max(0.0, square - mean * mean)))};
}

ProfileNorms compare_profiles(const SurfaceProfile& run, const std::vector<double>& distance,
                              const std::vector<double>& elevation, double toe, int direction) {
  LGIW_EXPECT(run.distance.size() >= 2 && run.bed.size() == run.distance.size() && run.soil.size() == run.bed.size());
  const std::size_t n = run.distance.size();
  Series surface{run.distance, run.soil};
  const Series bed{run.distance, run.bed};
  for (std::size_t k = 0; k < n; ++k)
    if (std::isnan(surface.value[k])) surface.value[k] = run.bed[k];

  ProfileNorms norms;
  norms.height_run = norms.height_reference = nothing;
  double distances = 0, heights = 0, first = nothing, last = nothing;
  for (std::size_t k = 0; k < distance.size(); ++k) {
    const double x = distance[k], z = elevation[k], below = value_at(surface, x);
    if (std::isnan(below) || std::isnan(z)) continue;
    ++norms.samples;
    heights += (z - below) * (z - below);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < n; ++i) {
      const double x0 = surface.time[i - 1], z0 = surface.value[i - 1];
      const double dx = surface.time[i] - x0, dz = surface.value[i] - z0, length2 = dx * dx + dz * dz;
      if (std::isnan(length2)) continue;
      const double a = std::clamp(((x - x0) * dx + (z - z0) * dz) / length2, 0.0, 1.0);
      nearest = std::min(nearest, std::hypot(x - x0 - a * dx, z - z0 - a * dz));
    }
    distances += nearest * nearest;
    if (!(first <= x)) first = x;
    if (!(last >= x)) last = x;
    if (!(z <= norms.height_reference)) norms.height_reference = z;
  }
  const auto samples = double(norms.samples);
  norms.rms_distance = norms.samples ? std::sqrt(distances / samples) : nothing;
  norms.rms_height = norms.samples ? std::sqrt(heights / samples) : nothing;
  if (norms.samples)
    for (double z : part_of(surface, first, last).value)
      if (!(z <= norms.height_run)) norms.height_run = z;

  // From the front's side inwards, the first place that is thicker than the toe.
  const auto front = [&](const std::vector<double>& x, const std::vector<double>& z) {
    const std::size_t count = x.size();
    double outer_x = nothing, outer = nothing;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = direction > 0 ? count - 1 - k : k;
      const double thickness = z[i] - value_at(bed, x[i]);
      if (std::isnan(thickness)) continue;
      if (thickness > toe)
        return std::isnan(outer) ? x[i] : outer_x + (toe - outer) / (thickness - outer) * (x[i] - outer_x);
      outer_x = x[i], outer = thickness;
    }
    return nothing;
  };
  norms.front_run = front(run.distance, surface.value);
  norms.front_reference = front(distance, elevation);
  return norms;
}

double percent_error(double run, double reference) {
  return reference != 0 ? 100 * (run - reference) / std::abs(reference) : nothing;
}

}  // namespace lgiw
