#include "terrain/analytic_terrain.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/error.hh"
#include "terrain/gdal_support.hh"
#include "terrain/reservoir.hh"

namespace lgiw::detail {
namespace {

double profile_height(const std::vector<Point2>& profile, double x) {
  const auto right = std::lower_bound(profile.begin() + 1, profile.end() - 1, x,
                                      [](const Point2& point, double at) { return point[0] < at; });
  const Point2 &a = *(right - 1), &b = *right;
  return a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]);
}

/// Marks the nodes whose x lies within one of the bodies.
std::vector<uint8_t> covered(const HeightField& ground, const std::vector<std::vector<Point2>>& bodies) {
  std::vector<uint8_t> mask(ground.z.size(), 0);
  const double margin = 1e-9 * (std::abs(ground.x_max()) + ground.dx);
  for (const auto& body : bodies) {
    const auto [low, high] = std::minmax_element(body.begin(), body.end());
    for (std::size_t k = 0; k < mask.size(); ++k) {
      const double x = ground.x0 + double(k % ground.nx) * ground.dx;
      if (x >= (*low)[0] - margin && x <= (*high)[0] + margin) mask[k] = 1;
    }
  }
  return mask;
}

}  // namespace

double profile_spacing(const std::vector<Point2>& profile, double width, double limit) {
  const double start = profile.front()[0], length = profile.back()[0] - start;
  std::vector<double> kinks;
  for (std::size_t k = 1; k + 1 < profile.size(); ++k) kinks.push_back(profile[k][0] - start);
  if (width > 0) kinks.push_back(width);
  const auto fewest = std::int64_t(std::ceil(length / limit * (1 - 1e-12)));
  double best = length / double(fewest), smallest = HUGE_VAL;
  for (std::int64_t n = fewest; n <= 4 * fewest; ++n) {
    const double spacing = length / double(n);
    double miss = 0;
    for (const double kink : kinks) miss = std::max(miss, std::abs(kink - std::round(kink / spacing) * spacing));
    // Only a clearly better fit is worth more nodes.
    if (miss < 0.5 * smallest - 1e-9 * limit) smallest = miss, best = spacing;
  }
  return best;
}

TerrainModel build_analytic_terrain(const Case& c) {
  const std::vector<Point2>& profile = c.terrain.profile;
  LGIW_VALIDATE(profile.size() >= 2, "terrain.profile has fewer than two points", "it is a polyline z(x)",
                "name its ends and kinks");
  for (std::size_t k = 1; k < profile.size(); ++k)
    LGIW_VALIDATE(profile[k][0] > profile[k - 1][0],
                  at_key(c, "terrain.profile") +
                      text("terrain.profile: x does not increase at point %zu (x = %g)", k + 1, profile[k][0]),
                  text("the point before lies at x = %g, and the bed has one height at each x", profile[k - 1][0]),
                  "order the points by x; side walls need no points, and steep steps take a small difference in x");
  const bool three = c.dimension == 3;
  LGIW_VALIDATE(!three || c.terrain.width > 0, "terrain.width is missing", "a 3-D scene extrudes terrain.profile in y",
                "give the width in m");
  const double length = profile.back()[0] - profile.front()[0], limit = std::min(0.5 * c.dp, length);
  const double across = three ? std::ceil(c.terrain.width / limit) : 1;
  LGIW_VALIDATE(length / limit * across < 4e7, text("the scene has %.3g terrain nodes", length / limit * across),
                "their spacing is half of particle_spacing", "choose a larger one");

  TerrainModel model;
  HeightField& ground = model.ground;
  ground.x0 = profile.front()[0];
  ground.dx = profile_spacing(profile, three ? c.terrain.width : 0, limit);
  ground.nx = std::size_t(std::llround(length / ground.dx)) + 1;
  ground.ny = three ? std::size_t(std::ceil(c.terrain.width / ground.dx - 1e-6)) + 1 : 1;
  std::vector<double> row(ground.nx);
  for (std::size_t i = 0; i < ground.nx; ++i) row[i] = profile_height(profile, ground.x0 + double(i) * ground.dx);
  row.back() = profile.back()[1];
  for (std::size_t j = 0; j < ground.ny; ++j) ground.z.insert(ground.z.end(), row.begin(), row.end());
  model.bed = ground;
  model.domain = {ground.x0, 0, profile.back()[0], three ? c.terrain.width : 0};
  model.slide = covered(ground, c.slide.present ? c.slide.bodies : std::vector<std::vector<Point2>>{});
  model.wet.assign(ground.z.size(), 0);
  model.still_water_level = c.water.present ? c.water.level : std::numeric_limits<double>::quiet_NaN();
  if (!c.water.present) return model;
  if (!c.water.bodies.empty()) {
    model.wet = covered(ground, c.water.bodies);
    return model;
  }
  const double level = c.water.level, lowest = *std::min_element(row.begin(), row.end());
  LGIW_VALIDATE(level > lowest, at_key(c, "water.level") + text("water.level %g m is below the whole terrain", level),
                text("its lowest place is at %g m", lowest), "raise the level");
  for (std::size_t k = 0; k < model.wet.size(); ++k) model.wet[k] = ground.z[k] < level;
  if (c.water.seed) {
    const double x = (*c.water.seed)[0];
    LGIW_VALIDATE(x >= ground.x0 && x <= ground.x_max(),
                  at_key(c, "water.seed") + text("water.seed: x = %g lies outside the domain", x),
                  text("terrain.profile runs from x = %g to %g", ground.x0, ground.x_max()), "move it into the water");
    const auto i = std::size_t(std::llround((x - ground.x0) / ground.dx));
    LGIW_VALIDATE(model.wet[i], at_key(c, "water.seed") + text("water.seed: x = %g is on dry land", x),
                  text("the ground there is at %g m, the level at %g m", ground.at(i, 0), level),
                  "move it into the water");
    std::vector<uint8_t> seeds(model.wet.size(), 0);
    seeds[i] = 1;
    model.wet = connected_to(seeds, model.wet, ground.nx, ground.ny, 4);
  }
  for (const auto& [side, name, index] :
       {std::tuple{c.terrain.west, "west", std::size_t(0)}, std::tuple{c.terrain.east, "east", ground.nx - 1}})
    LGIW_VALIDATE(side != Side::open || !model.wet[index],
                  at_key(c, "terrain.sides") + text("terrain.sides.%s is open, but the water reaches it", name),
                  text("it is %g m deep there and would run out", level - ground.at(index, 0)),
                  "make that side wall or absorbing");

  LGIW_VALIDATE(!three || (c.terrain.south != Side::open && c.terrain.north != Side::open),
                at_key(c, "terrain.sides") + "terrain.sides: south or north is open, but the water reaches it",
                "an analytic scene is the same for all y and would run out", "make them wall or absorbing");

  // Exact between nodes, which lie on the kinks where they can: each wetted piece of the bed is a trapezium or a
  // triangle.
  for (std::size_t i = 0; i + 1 < ground.nx; ++i) {
    const double a = level - row[i], b = level - row[i + 1];
    model.max_water_depth = std::max({model.max_water_depth, model.wet[i] ? a : 0, model.wet[i + 1] ? b : 0});
    if (!model.wet[i] && !model.wet[i + 1]) continue;
    const double wetted = a > 0 && b > 0 ? 1 : std::max(a, b) / std::abs(a - b);
    model.reservoir_area += wetted * ground.dx;
    model.reservoir_volume += wetted * ground.dx * 0.5 * (std::max(a, 0.0) + std::max(b, 0.0));
  }
  if (three) model.reservoir_area *= c.terrain.width, model.reservoir_volume *= c.terrain.width;
  return model;
}

}  // namespace lgiw::detail
