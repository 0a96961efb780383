// Measures of a state: what stays at rest must, and the phases must stay apart.
#include <algorithm>
#include <cmath>

#include "base/error.hh"
#include "measures.hh"

namespace lgiw::validation {
namespace {

/// First particle and number of a phase in the frames.
struct Range {
  std::size_t first, count;
};
Range phase_of(const Run& run, const Keys& keys) {
  const std::string phase = keys.text("phase");
  LGIW_VALIDATE(phase == "water" || phase == "soil", keys.where() + ": phase is " + phase, "there are two",
                "write water or soil");
  const bool water = phase == "water";
  return {water ? 0 : run.water_count(), water ? run.water_count() : run.soil_count()};
}

double gravity(const Run& run) { return -run.c.gravity[2]; }

/// Depth of the water below its still level, m.
double greatest_depth(const Run& run) {
  const HeightField& bed = run.bed();
  return run.level() - *std::min_element(bed.z.begin(), bed.z.end());
}

double pressure_error(const Run& run, const Frame& frame) {
  const double rho_g = run.c.water.density * gravity(run);
  double sum = 0;
  for (std::size_t i = 0; i < run.water_count(); ++i)
    sum += std::pow(frame.pressure[i] - rho_g * (run.level() - frame.points[3 * i + 2]), 2);
  return std::sqrt(sum / double(run.water_count())) / (rho_g * greatest_depth(run));
}

/// RMS over the water of p - rho g (level - z), relative to rho g times the greatest depth; root mean square over the
/// frames from `from` (the last) to `to`.
Value pressure_rms(const Run& run, const Keys& keys) {
  double sum = 0;
  const std::size_t first = run.frame_index(keys.time("from")), last = run.frame_index(keys.time("to"));
  for (std::size_t k = first; k <= last; ++k) sum += std::pow(pressure_error(run, run.file->frame(k)), 2);
  return {std::sqrt(sum / double(last - first + 1)), 0};
}

/// A quantile (1: the fastest) of the speed of a phase over sqrt(g d), d the greatest depth of water.
Value relative_speed(const Run& run, const Keys& keys) {
  const Frame frame = run.frame_at(keys.time("at"));
  const Range range = phase_of(run, keys);
  std::vector<double> speeds;
  for (std::size_t i = range.first; i < range.first + range.count; ++i)
    speeds.push_back(std::hypot(frame.velocity[3 * i], frame.velocity[3 * i + 1], frame.velocity[3 * i + 2]));
  const auto at = speeds.begin() + long(keys.number("quantile", 1) * double(speeds.size() - 1));
  std::nth_element(speeds.begin(), at, speeds.end());
  return {*at / std::sqrt(gravity(run) * greatest_depth(run)), 0};
}

/// How far the centre of a phase has moved from `from` to `to`, over dp.
Value centre_drift(const Run& run, const Keys& keys) {
  const Frame a = run.frame_at(keys.number("from", 0)), b = run.frame_at(keys.time("to"));
  const Range range = phase_of(run, keys);
  double d[3] = {0, 0, 0};
  for (std::size_t i = range.first; i < range.first + range.count; ++i)
    for (int k = 0; k < 3; ++k) d[k] += (double(b.points[3 * i + k]) - a.points[3 * i + k]) / double(range.count);
  return {std::hypot(d[0], d[1], d[2]) / run.dp(), 0};
}

/// Particles that are on the wrong side of a level interface at height `interface` (case's z) by more than dp: water
/// below or soil above.
Value crossed(const Run& run, const Keys& keys) {
  const Frame frame = run.frame_at(keys.time("at"));
  const double z = keys.number("interface") - run.origin(2);
  double n = 0;
  for (std::size_t i = 0; i < run.water_count() + run.soil_count(); ++i) {
    const double above = frame.points[3 * i + 2] - z;
    n += (i < run.water_count() ? -above : above) > run.dp();
  }
  return {n, 0};
}

}  // namespace

void add_states(std::map<std::string, Measure>& all) {
  all["pressure_rms"] = pressure_rms;
  all["relative_speed"] = relative_speed;
  all["centre_drift"] = centre_drift;
  all["crossed"] = crossed;
}

}  // namespace lgiw::validation
