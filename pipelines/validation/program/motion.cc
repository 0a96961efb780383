// Measures of motion: accelerations of bodies, period and decay of standing waves.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hh"
#include "measures.hh"
#include "series.hh"

namespace lgiw::validation {
namespace {

/// Acceleration of the centre of the soil along a direction `dip` degrees below east, m/s2: least squares of
/// s = v0 t + a t^2 / 2 over the frames from `from` to `to`. Reference: g (sin - tan(friction) cos) with `friction` in
/// degrees, where given, on a plane that gravity meets at `steep` (dip) degrees.
Value acceleration(const Run& run, const Keys& keys) {
  const double dip = keys.number("dip") * std::numbers::pi / 180;
  const std::size_t first = run.frame_index(keys.number("from", 0)), last = run.frame_index(keys.time("to"));
  double t2 = 0, t3 = 0, t4 = 0, st = 0, st2 = 0, start = 0, t0 = 0;
  for (std::size_t k = first; k <= last; ++k) {
    const Frame frame = run.file->frame(k);
    double s = 0;
    for (std::size_t i = run.water_count(); i < run.water_count() + run.soil_count(); ++i)
      s += frame.points[3 * i] * std::cos(dip) - frame.points[3 * i + 2] * std::sin(dip);
    s /= double(run.soil_count());
    if (k == first) start = s, t0 = frame.time;
    const double t = frame.time - t0;
    s -= start;
    t2 += t * t, t3 += t * t * t, t4 += t * t * t * t, st += s * t, st2 += s * t * t;
  }
  // Normal equations of s = v t + b t^2.
  const double b = (st2 * t2 - st * t3) / (t4 * t2 - t3 * t3);
  Value value{2 * b, missing};
  if (keys.has("friction")) {
    const auto& gravity = run.c.gravity;
    const double g = std::hypot(gravity[0], gravity[1], gravity[2]);
    const double steep = keys.number("steep", keys.number("dip")) * std::numbers::pi / 180;
    value.reference =
        g * (std::sin(steep) - std::tan(keys.number("friction") * std::numbers::pi / 180) * std::cos(steep));
  }
  return value;
}

/// Times at which a series crosses its mean upwards.
std::vector<double> rises(const Series& s) {
  double mean = 0;
  for (double v : s.value) mean += v / double(s.value.size());
  std::vector<double> times;
  for (std::size_t k = 1; k < s.value.size(); ++k) {
    const double a = s.value[k - 1] - mean, b = s.value[k] - mean;
    if (a < 0 && b >= 0) times.push_back(s.time[k - 1] + (s.time[k] - s.time[k - 1]) * a / (a - b));
  }
  return times;
}

/// Period of a gauge that oscillates, s: mean over all its cycles.
Value period(const Run& run, const Keys& keys) {
  const std::vector<double> times =
      rises(between(gauge_series(run, keys.text("gauge")), keys.number("from", 0), keys.number("to", last_time)));
  if (times.size() < 2) return {};
  return {(times.back() - times.front()) / double(times.size() - 1)};
}

/// Rate at which the height from trough to crest of an oscillating gauge decays, 1/s: least squares of the logarithm of
/// the range in each cycle. Reference, where `wavelength` is given: 2 nu k^2, nu = alpha c h / 8 (2-D).
Value decay_rate(const Run& run, const Keys& keys) {
  const Series s = between(gauge_series(run, keys.text("gauge")), keys.number("from", 0), keys.number("to", last_time));
  const std::vector<double> times = rises(s);
  double n = 0, t1 = 0, t2 = 0, y1 = 0, ty = 0;
  for (std::size_t k = 0; k + 1 < times.size(); ++k) {
    const Series cycle = between(s, times[k], times[k + 1]);
    const double y = std::log(extreme(cycle, true).value - extreme(cycle, false).value);
    const double t = (times[k] + times[k + 1]) / 2;
    n += 1, t1 += t, t2 += t * t, y1 += y, ty += t * y;
  }
  Value rate;
  if (keys.has("wavelength")) {
    const double k = 2 * std::numbers::pi / keys.number("wavelength");
    rate.reference = 2 * k * k * run.c.water.viscosity_alpha * run.header().particles.sound_speed *
                     run.c.numerics.h_over_dp * run.dp() / 8;
  }
  if (n >= 2) rate.measured = -(n * ty - t1 * y1) / (n * t2 - t1 * t1);
  return rate;
}

}  // namespace

void add_motion(std::map<std::string, Measure>& all) {
  all["acceleration"] = acceleration;
  all["period"] = period;
  all["decay_rate"] = decay_rate;
}

}  // namespace lgiw::validation
