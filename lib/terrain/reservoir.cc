#include "terrain/reservoir.hh"

#include <algorithm>
#include <cmath>

#include "base/error.hh"
#include "terrain/gdal_support.hh"

namespace lgiw::detail {

std::vector<uint8_t> connected_to(const std::vector<uint8_t>& seeds, const std::vector<uint8_t>& allowed,
                                  std::size_t nx, std::size_t ny, int neighbours) {
  std::vector<uint8_t> reached(seeds.size(), 0);
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < seeds.size(); ++k)
    if (seeds[k]) reached[k] = 1, open.push_back(k);
  constexpr int step_i[] = {-1, 1, 0, 0, -1, 1, -1, 1}, step_j[] = {0, 0, -1, 1, -1, -1, 1, 1};
  while (!open.empty()) {
    const std::size_t k = open.back();
    open.pop_back();
    const int64_t i = int64_t(k % nx), j = int64_t(k / nx);
    for (int n = 0; n < neighbours; ++n) {
      const int64_t a = i + step_i[n], b = j + step_j[n];
      if (a < 0 || b < 0 || a >= int64_t(nx) || b >= int64_t(ny)) continue;
      const std::size_t other = std::size_t(b) * nx + std::size_t(a);
      if (!allowed[other] || reached[other]) continue;
      reached[other] = 1;
      open.push_back(other);
    }
  }
  return reached;
}

Reservoir fill_reservoir(const HeightField& ground, const Case& c) {
  const Water& water = c.water;
  const Terrain& sides = c.terrain;
  const double level = water.level, dx = ground.dx;
  const auto [lowest, highest] = std::minmax_element(ground.z.begin(), ground.z.end());
  LGIW_VALIDATE(level > *lowest, at_key(c, "water.level") + text("water.level %g m is below the whole terrain", level),
                text("its lowest place is at %g m", *lowest), "raise the level or check the vertical datum");
  LGIW_VALIDATE(level < *highest, at_key(c, "water.level") + text("water.level %g m is above the whole terrain", level),
                text("its highest place is at %g m, so the water has no shore", *highest),
                "lower the level or check the vertical datum");
  LGIW_VALIDATE(water.seed.has_value(), at_key(c, "water") + "water.seed is missing",
                "a terrain may hold several basins below the level", "name a point in the reservoir");
  const auto [x, y] = *water.seed;
  const double u = (x - ground.x0) / dx, v = (y - ground.y0) / dx;
  LGIW_VALIDATE(u >= -0.5 && v >= -0.5 && u <= double(ground.nx) - 0.5 && v <= double(ground.ny) - 0.5,
                at_key(c, "water.seed") + text("water.seed %.8g, %.8g lies outside the domain", x, y),
                text("it covers x %.8g to %.8g, y %.8g to %.8g", ground.x0, ground.x_max(), ground.y0, ground.y_max()),
                "move the seed into the reservoir or enlarge terrain.window");
  const std::size_t i = std::min(ground.nx - 1, std::size_t(std::max(0.0, std::round(u))));
  const std::size_t j = std::min(ground.ny - 1, std::size_t(std::max(0.0, std::round(v))));
  std::vector<uint8_t> below(ground.z.size());
  for (std::size_t k = 0; k < below.size(); ++k) below[k] = ground.z[k] < level;
  if (!below[j * ground.nx + i]) {
    std::size_t nearest = 0;
    double distance = HUGE_VAL;
    for (std::size_t k = 0; k < below.size(); ++k) {
      if (!below[k]) continue;
      const double d = std::hypot(double(k % ground.nx) - double(i), double(k / ground.nx) - double(j));
      if (d < distance) distance = d, nearest = k;
    }
    throw InputError(at_key(c, "water.seed") + text("water.seed %.8g, %.8g is on dry land", x, y),
                     text("the ground there is at %g m, the level at %g m", ground.at(i, j), level),
                     text("the nearest place below the level is %.8g, %.8g (ground %g m, %.3g m away)",
                          ground.x0 + double(nearest % ground.nx) * dx, ground.y0 + double(nearest / ground.nx) * dx,
                          ground.z[nearest], distance * dx));
  }
  Reservoir reservoir;
  std::vector<uint8_t> seed(below.size(), 0);
  seed[j * ground.nx + i] = 1;
  reservoir.wet = connected_to(seed, below, ground.nx, ground.ny, 4);
  for (std::size_t k = 0; k < below.size(); ++k) {
    if (!reservoir.wet[k]) continue;
    const double depth = level - ground.z[k];
    reservoir.area += dx * dx;
    reservoir.volume += depth * dx * dx;
    reservoir.max_depth = std::max(reservoir.max_depth, depth);
  }
  const struct {
    Side side;
    const char* name;
    std::size_t first, step, count;
  } edges[] = {{sides.west, "west", 0, ground.nx, ground.ny},
               {sides.east, "east", ground.nx - 1, ground.nx, ground.ny},
               {sides.south, "south", 0, 1, ground.nx},
               {sides.north, "north", (ground.ny - 1) * ground.nx, 1, ground.nx}};
  for (const auto& edge : edges) {
    if (edge.side != Side::open) continue;
    for (std::size_t n = 0; n < edge.count; ++n) {
      const std::size_t k = edge.first + n * edge.step;
      LGIW_VALIDATE(
          !reservoir.wet[k],
          at_key(c, "terrain.sides") + text("terrain.sides.%s is open, but the reservoir reaches it", edge.name),
          text("at %.8g, %.8g it is %g m deep and would run out", ground.x0 + double(k % ground.nx) * dx,
               ground.y0 + double(k / ground.nx) * dx, level - ground.z[k]),
          "make that side wall or absorbing");
    }
  }
  return reservoir;
}

}  // namespace lgiw::detail
