#include "measure/earliest_arrival.hh"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <queue>
#include <utility>

#include "measure/surface_sampling.hh"

namespace lgiw {
namespace {

using Node = std::pair<std::size_t, std::size_t>;  // i, j

/// The nodes of `map` within `reach` (in cells) of (i, j) in x and in y.
template <class Visit>
void for_nodes_around(const SurfaceMap& map, Node at, std::size_t reach, const Visit& visit) {
  const auto from = [&](std::size_t k) { return k > reach ? k - reach : 0; };
  for (std::size_t j = from(at.second); j < std::min(map.ny, at.second + reach + 1); ++j)
    for (std::size_t i = from(at.first); i < std::min(map.nx, at.first + reach + 1); ++i) visit(i, j);
}

double fastest(const std::vector<BodyMotion>& bodies) {
  double speed = 0;
  for (const BodyMotion& motion : bodies)
    for (std::size_t k = 1; k < motion.time.size(); ++k) {
      const auto &a = motion.displacement[k - 1], &b = motion.displacement[k];
      const double way = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
      speed = std::max(speed, way / (motion.time[k] - motion.time[k - 1]));
    }
  return speed;
}

/// Where the slide lies at first: its soil, or what a rigid one has between bed and ground.
std::vector<uint8_t> slide_nodes(const RunHeader& header) {
  const SurfaceMap& map = header.map;
  std::vector<uint8_t> slide(map.size(), 0);
  const auto nearest = [&map](double x, double low, std::size_t count) {
    return std::size_t(std::clamp(std::round((x - low) / map.dx), 0.0, double(count - 1)));
  };
  for (std::size_t k = 0; k + 2 < header.initial_soil.size(); k += 3) {
    const std::size_t j = map.ny > 1 ? nearest(header.initial_soil[k + 1], map.y0, map.ny) : 0;
    slide[j * map.nx + nearest(header.initial_soil[k], map.x0, map.nx)] = 1;
  }
  if (header.particles.bodies.empty()) return slide;
  const std::vector<double> bed = at_nodes(map, header.particles.bed),
                            ground = at_nodes(map, ground_of(header.particles));
  for (std::size_t n = 0; n < slide.size(); ++n)
    if (ground[n] > bed[n] + 1e-6 * header.particles.dp) slide[n] = 1;
  return slide;
}

/// The greatest speed at which something passes each node, m/s.
std::vector<double> passing_speed(const RunHeader& header, double gravity, const std::vector<float>& depth,
                                  const std::vector<float>& speed, const std::vector<float>& soil_speed) {
  const auto known = [](const std::vector<float>& values, std::size_t n) {
    return n < values.size() && !std::isnan(values[n]) ? double(values[n]) : 0.0;
  };
  const double bodies = fastest(header.particles.bodies);
  double slide = bodies;
  for (std::size_t n = 0; n < soil_speed.size(); ++n) slide = std::max(slide, known(soil_speed, n));
  std::vector<double> c(header.map.size());
  for (std::size_t n = 0; n < c.size(); ++n) {
    const double wet = known(depth, n), soil = known(soil_speed, n);
    c[n] = wet > 0 ? known(speed, n) + std::sqrt(gravity * wet) : soil > 0 ? 0 : slide;
    c[n] = std::max({c[n], soil, bodies});
  }
  return c;
}

}  // namespace

std::vector<double> earliest_arrival(const RunHeader& header, const Case& c, const std::vector<float>& depth,
                                     const std::vector<float>& speed, const std::vector<float>& soil_speed) {
  const SurfaceMap& map = header.map;
  const std::vector<uint8_t> slide = slide_nodes(header);
  const bool only_a_slide = std::find(slide.begin(), slide.end(), 1) != slide.end() && c.bodies.empty() &&
                            c.water.bodies.empty() && !c.water.wave;
  const auto measured = [](const std::vector<float>& values) {
    return std::any_of(values.begin(), values.end(), [](float v) { return !std::isnan(v); });
  };
  const bool known = (header.particles.counts.water == 0 || measured(depth)) &&
                     (header.particles.counts.soil == 0 || measured(soil_speed));
  if (!only_a_slide || !known) return std::vector<double>(map.size(), 0);

  // Dijkstra's algorithm over the eight neighbours.
  using Front = std::pair<double, std::size_t>;
  std::priority_queue<Front, std::vector<Front>, std::greater<>> fronts;
  std::vector<double> earliest(map.size(), infinite);
  const auto arrive = [&](std::size_t n, double time) {
    if (time < earliest[n]) earliest[n] = time, fronts.push({time, n});
  };
  const auto node = [&map](std::size_t n) { return Node{n % map.nx, n / map.nx}; };
  const auto reach = std::size_t(
      std::min(std::ceil(2 * c.numerics.h_over_dp * header.particles.dp / map.dx), double(std::max(map.nx, map.ny))));
  for (std::size_t n = 0; n < slide.size(); ++n)
    if (slide[n])
      for_nodes_around(map, node(n), reach, [&](std::size_t i, std::size_t j) { arrive(j * map.nx + i, 0); });

  const std::vector<double> passing = passing_speed(header, std::abs(c.gravity[2]), depth, speed, soil_speed);
  // Ways over neighbours are longer than straight ones, by 1 / cos(pi / 8) at most.
  const double straight = map.ny > 1 ? std::cos(std::numbers::pi / 8) : 1;
  while (!fronts.empty()) {
    const double time = fronts.top().first;
    const std::size_t n = fronts.top().second;
    fronts.pop();
    if (time > earliest[n]) continue;
    const Node at = node(n);
    for_nodes_around(map, at, 1, [&](std::size_t i, std::size_t j) {
      const std::size_t k = j * map.nx + i;
      const double way = straight * map.dx * (i != at.first && j != at.second ? std::numbers::sqrt2 : 1);
      if (k != n) arrive(k, time + way / std::max(passing[n], passing[k]));
    });
  }
  return earliest;
}

std::vector<double> earliest_arrival(const RunReader& run, const Case& c) {
  return earliest_arrival(run.header(), c, run.maximum("depth"), run.maximum("speed"), run.maximum("soil_speed"));
}

double earliest_near(const SurfaceMap& map, const std::vector<double>& earliest, double x, double y) {
  const double u = (x - map.x0) / map.dx, v = map.ny > 1 ? (y - map.y0) / map.dx : 0;
  if (!(u >= -1 && v >= -1 && u <= double(map.nx) && v <= double(map.ny))) return 0;
  double least = infinite;
  const Node at{std::size_t(std::clamp(std::round(u), 0.0, double(map.nx - 1))),
                std::size_t(std::clamp(std::round(v), 0.0, double(map.ny - 1)))};
  for_nodes_around(map, at, 1,
                   [&](std::size_t i, std::size_t j) { least = std::min(least, earliest[j * map.nx + i]); });
  return least;
}

}  // namespace lgiw
