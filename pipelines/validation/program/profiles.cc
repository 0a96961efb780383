// Measures of shapes: where a front is, how far a surface is from a measured one.
#include <algorithm>
#include <cmath>

#include "base/error.hh"
#include "measure/section_profiles.hh"
#include "measure/section_runup.hh"
#include "measures.hh"

namespace lgiw::validation {
namespace {

/// A surface of the run along x at y of the first row of its map, local z; NaN where there is none.
std::vector<float> surface_at(const Run& run, const Keys& keys, double time) {
  const std::string phase = keys.text("phase");
  LGIW_VALIDATE(run.header().particles.dimension == 2, keys.where() + ": profiles are of 2-D runs",
                "a 3-D surface is no line", "use gauges");
  LGIW_VALIDATE(phase == "water" || phase == "soil", keys.where() + ": phase is " + phase, "there are two",
                "write water or soil");
  const std::size_t k = run.surface_index(time);
  return phase == "water" ? run.file->water_surface(k) : run.file->soil_surface(k);
}

/// The farthest x (case coordinates) that the surface of `phase` reaches without a gap, going east from `source` (the
/// west end), at time `at`: half a cell beyond the last node that has one, or where what lies on the bed gets thinner
/// than `thickness`. Loose grains and drops ahead of it do not count.
double front_at(const Run& run, const Keys& keys, double time) {
  const SurfaceMap& map = run.header().map;
  const std::vector<float> z = surface_at(run, keys, time);
  const double source = keys.number("source", map.x0 + run.origin(0)) - run.origin(0);
  std::size_t i = std::size_t(std::clamp((source - map.x0) / map.dx, 0.0, double(map.nx - 1)));
  LGIW_VALIDATE(std::isfinite(z[i]), keys.where() + ": there is no surface at x = " + std::to_string(source),
                "the front is followed from there", "set source");
  const double thinnest = keys.number("thickness", 0);
  const auto above = [&](std::size_t k) {
    return z[k] - run.bed().height(map.x0 + double(k) * map.dx, map.y0) - thinnest;
  };
  while (i + 1 < map.nx && std::isfinite(z[i + 1]) && !(above(i + 1) < 0)) ++i;
  double beyond = 0.5;
  if (thinnest > 0 && i + 1 < map.nx && above(i + 1) < 0) beyond = above(i) / (above(i) - above(i + 1));
  return map.x0 + (double(i) + beyond) * map.dx + run.origin(0);
}
Value front(const Run& run, const Keys& keys) { return {front_at(run, keys, keys.time("at"))}; }

/// Time, s, from which the front stands at or beyond `x`; `phase`, `source`, `thickness` as above.
double front_time(const Run& run, const Keys& keys, double x) {
  const std::vector<double>& times = run.file->surface_times();
  double x_before = missing, t_before = missing;
  for (double t : times) {
    const double now = front_at(run, keys, t);
    if (now >= x) return std::isnan(t_before) ? t : t_before + (t - t_before) * (x - x_before) / (now - x_before);
    x_before = now, t_before = t;
  }
  return missing;
}
/// Mean speed of the front between `x` and `x_to`, m/s.
Value front_speed(const Run& run, const Keys& keys) {
  const double x = keys.number("x"), to = keys.number("x_to");
  return {(to - x) / (front_time(run, keys, to) - front_time(run, keys, x))};
}
Value front_arrival(const Run& run, const Keys& keys) { return {front_time(run, keys, keys.number("x"))}; }

/// Highest run-up above still water on the bank at `to_x`, seen from the lake at `from_x`, m.
Value runup(const Run& run, const Keys& keys) {
  Section section;
  section.name = "bank";
  section.points = {{keys.number("from_x"), 0}, {keys.number("to_x"), 0}};
  RunupRecorder recorder(run.header(), {section});
  for (std::size_t k = 0; k < run.file->surface_times().size(); ++k)
    recorder.add(run.file->surface_times()[k], run.file->water_surface(k));
  return {recorder.sections()[0].max_height};
}

/// x (case coordinates) that the share `quantile` of a phase's particles does not pass at time `at`.
Value quantile_x(const Run& run, const Keys& keys) {
  const Frame frame = run.frame_at(keys.time("at"));
  const bool water = keys.text("phase") == "water";
  const std::size_t first = water ? 0 : run.water_count(), n = water ? run.water_count() : run.soil_count();
  std::vector<double> x;
  for (std::size_t i = first; i < first + n; ++i) x.push_back(frame.points[3 * i]);
  const auto at = x.begin() + long(keys.number("quantile") * double(n - 1));
  std::nth_element(x.begin(), at, x.end());
  return {*at + run.origin(0)};
}

struct Profile {
  std::vector<double> measured, reference;
};

/// The run's surface at the places of the reference profile; the bed where there is none. `x_column`, `z_column` (1,
/// 2); reference coordinates are multiplied by `scale` and moved by `x_offset`, `z_offset` into those of the case.
Profile compared_profile(const Run& run, const Keys& keys) {
  const CsvFile csv = keys.csv("file");
  const std::vector<double> xs = csv.numbers(keys.text("x_column", "1")), zs = csv.numbers(keys.text("z_column", "2"));
  const SurfaceMap& map = run.header().map;
  const std::vector<float> surface = surface_at(run, keys, keys.time("at"));
  const double scale = keys.number("scale", 1);
  std::vector<double> nodes(map.nx), heights(map.nx);
  for (std::size_t i = 0; i < map.nx; ++i) {
    nodes[i] = map.x0 + double(i) * map.dx;
    heights[i] = std::isfinite(surface[i]) ? double(surface[i]) : run.bed().height(nodes[i], 0);
  }
  Profile p;
  for (std::size_t k = 0; k < xs.size(); ++k) {
    const double x = xs[k] * scale + keys.number("x_offset", 0) - run.origin(0);
    // Half a cell at the walls lies outside the nodes.
    const double z = interpolate(nodes, heights, std::clamp(x, nodes.front(), nodes.back()));
    if (x < nodes.front() - map.dx || x > nodes.back() + map.dx) continue;
    p.measured.push_back(z);
    p.reference.push_back(zs[k] * scale + keys.number("z_offset", 0) - run.origin(2));
  }
  LGIW_VALIDATE(!p.measured.empty(), keys.where() + ": no point of " + csv.name + " lies in the domain",
                "there is nothing to compare", "check scale and x_offset");
  return p;
}

double rms_difference(const Profile& p) {
  double sum = 0;
  for (std::size_t k = 0; k < p.measured.size(); ++k) sum += std::pow(p.measured[k] - p.reference[k], 2);
  return std::sqrt(sum / double(p.measured.size()));
}

/// RMS over the points of a measured profile of the vertical distance to the run's surface, m.
Value profile_rms(const Run& run, const Keys& keys) { return {rms_difference(compared_profile(run, keys)), 0}; }

/// The same over the range of the measured profile.
Value profile_nrmse(const Run& run, const Keys& keys) {
  const Profile p = compared_profile(run, keys);
  const auto [low, high] = std::minmax_element(p.reference.begin(), p.reference.end());
  return {rms_difference(p) / (*high - *low), 0};
}

/// Distance of a point to a polyline.
double distance(double x, double z, const std::vector<std::array<double, 2>>& line) {
  double best = infinite;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    const double ex = line[k + 1][0] - line[k][0], ez = line[k + 1][1] - line[k][1];
    const double length2 = ex * ex + ez * ez;
    const double t =
        length2 > 0 ? std::clamp(((x - line[k][0]) * ex + (z - line[k][1]) * ez) / length2, 0.0, 1.0) : 0.0;
    best = std::min(best, std::hypot(x - line[k][0] - t * ex, z - line[k][1] - t * ez));
  }
  return best;
}

/// RMS distance of the points of a measured failure line to the contour of accumulated plastic strain `threshold` (the
/// case's) at the end, m.
Value failure_line(const Run& run, const Keys& keys) {
  const Frame frame = run.frame_at(last_time);
  Section section;
  section.name = "all";
  const SurfaceMap& map = run.header().map;
  section.points = {{map.x0 + run.origin(0), 0}, {map.x0 + double(map.nx - 1) * map.dx + run.origin(0), 0}};
  const auto profiles =
      section_profiles(run.header(), frame, {section}, keys.number("threshold", run.c.deposit.adps_threshold));
  std::vector<std::array<double, 2>> line;
  for (std::size_t k = 0; k < profiles[0].slip.size(); ++k)
    if (std::isfinite(profiles[0].slip[k]))
      line.push_back({profiles[0].stations[k].x + run.origin(0), profiles[0].slip[k]});
  if (line.size() < 2) return {missing, 0};
  const CsvFile csv = keys.csv("file");
  const std::vector<double> x = csv.numbers("1"), z = csv.numbers("2");
  double sum = 0;
  for (std::size_t k = 0; k < x.size(); ++k) sum += std::pow(distance(x[k], z[k], line), 2);
  return {std::sqrt(sum / double(x.size())), 0};
}

}  // namespace

void add_profiles(std::map<std::string, Measure>& all) {
  all["front"] = front;
  all["front_speed"] = front_speed;
  all["front_arrival"] = front_arrival;
  all["runup"] = runup;
  all["quantile_x"] = quantile_x;
  all["profile_rms"] = profile_rms;
  all["profile_nrmse"] = profile_nrmse;
  all["failure_line"] = failure_line;
}

}  // namespace lgiw::validation
