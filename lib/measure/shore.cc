#include "measure/shore.hh"

#include <gdal_alg.h>

#include <algorithm>
#include <cmath>

#include "base/error.hh"
#include "measure/surface_sampling.hh"

namespace lgiw {
namespace {

/// The four neighbours of node n that lie in the map.
template <class Visit>
void for_neighbours(const SurfaceMap& map, std::size_t n, const Visit& visit) {
  const std::size_t i = n % map.nx, j = n / map.nx;
  if (i > 0) visit(n - 1);
  if (i + 1 < map.nx) visit(n + 1);
  if (j > 0) visit(n - map.nx);
  if (j + 1 < map.ny) visit(n + map.nx);
}

struct LimitNode {
  double x, y, z;
};

/// Where inundation ended, with the height that the water reached there.
std::vector<LimitNode> inundation_limit(const RunHeader& header, const std::vector<float>& max_elevation) {
  const SurfaceMap& map = header.map;
  const std::vector<double> ground = at_nodes(map, ground_of(header.particles));
  std::vector<LimitNode> limit;
  for (std::size_t n = 0; n < map.size(); ++n) {
    if (std::isnan(max_elevation[n])) continue;
    bool at_limit = false, level = false;
    const double still = header.particles.still_water_level, dp = header.particles.dp;
    for_neighbours(map, n, [&](std::size_t k) {
      // What is dry well below still level is full of soil, no land.
      if (!std::isnan(max_elevation[k]) || !(ground[k] > still - dp)) return;
      at_limit = true;
      level = level || ground[k] > max_elevation[n] - dp;
    });
    // The water stood at still level before the wave.
    const double reached = level ? std::max<double>(max_elevation[n], ground[n]) : ground[n];
    if (at_limit)
      limit.push_back(
          {map.x0 + double(n % map.nx) * map.dx, map.y0 + double(n / map.nx) * map.dx, std::max(reached, still)});
  }
  return limit;
}

}  // namespace

std::vector<uint8_t> lake_at_rest(const RunHeader& header, const std::vector<float>& first_water) {
  const std::vector<double> ground = at_nodes(header.map, ground_of(header.particles));
  std::vector<uint8_t> lake(header.map.size(), 0);
  std::vector<std::size_t> open;
  for (std::size_t n = 0; n < lake.size(); ++n)
    if (!std::isnan(first_water[n])) lake[n] = 1, open.push_back(n);
  // Water less than half a particle deep is not measured: the rest of the lake is what lies below its level beside it.
  while (!open.empty()) {
    const std::size_t n = open.back();
    open.pop_back();
    for_neighbours(header.map, n, [&](std::size_t k) {
      if (lake[k] || !(ground[k] < header.particles.still_water_level)) return;
      lake[k] = 1, open.push_back(k);
    });
  }
  return lake;
}

std::vector<std::vector<std::array<double, 2>>> shorelines(const RunHeader& header, const std::vector<uint8_t>& lake) {
  const SurfaceMap& map = header.map;
  const std::vector<double> ground = at_nodes(map, ground_of(header.particles));
  struct Tracing {
    const SurfaceMap& map;
    std::vector<std::vector<std::array<double, 2>>> lines;
  } tracing{map, {}};
  // The depth crosses zero at the shore; dry depressions are lifted above the level.
  const double least = 1e-6 * map.dx;
  const auto write = [](double, int points, double* x, double* y, void* data) {
    Tracing& t = *static_cast<Tracing*>(data);
    std::vector<std::array<double, 2>> line;
    for (int k = 0; k < points; ++k)  // from pixel corners to nodes, which are the centres
      line.push_back({t.map.x0 + (x[k] - 0.5) * t.map.dx, t.map.y0 + (y[k] - 0.5) * t.map.dx});
    if (line.size() >= 2) t.lines.push_back(std::move(line));
    return CE_None;
  };
  // One contour only: the interval is larger than any depth.
  GDALContourGeneratorH generator =
      GDAL_CG_Create(int(map.nx), int(map.ny), FALSE, 0, /*interval=*/1e12, /*base=*/0, write, &tracing);
  std::vector<double> row(map.nx);
  bool traced = generator != nullptr;
  for (std::size_t j = 0; j < map.ny && traced; ++j) {
    for (std::size_t i = 0; i < map.nx; ++i) {
      const std::size_t n = j * map.nx + i;
      const double depth = header.particles.still_water_level - ground[n];
      row[i] = lake[n] ? std::max(depth, least) : std::isnan(depth) ? -least : std::min(depth, -least);
    }
    traced = GDAL_CG_FeedLine(generator, row.data()) == CE_None;
  }
  if (generator) GDAL_CG_Destroy(generator);
  if (!traced) throw WorkError("the shoreline was not traced", "GDAL's contour generator failed", "report this");
  return tracing.lines;
}

std::vector<std::vector<ShorePoint>> shore_runup(const RunHeader& header,
                                                 const std::vector<std::vector<std::array<double, 2>>>& lines,
                                                 const std::vector<float>& max_elevation) {
  std::vector<std::vector<ShorePoint>> result;
  std::vector<ShorePoint*> points;
  for (const auto& line : lines) {
    result.emplace_back();
    for (std::size_t k = 0; k < line.size(); ++k) {
      const double step = k ? std::hypot(line[k][0] - line[k - 1][0], line[k][1] - line[k - 1][1]) : 0;
      result.back().push_back(
          {line[k][0], line[k][1], k ? result.back().back().distance + step : 0, no_value, no_value});
    }
  }
  for (auto& line : result)
    for (ShorePoint& p : line) points.push_back(&p);
  const std::vector<LimitNode> limit = inundation_limit(header, max_elevation);
  const auto squared = [](double dx, double dy) { return dx * dx + dy * dy; };

  for (const LimitNode& node : limit) {
    ShorePoint* nearest = nullptr;
    double least = infinite;
    for (ShorePoint* p : points) {
      const double d = squared(p->x - node.x, p->y - node.y);
      if (d < least) least = d, nearest = p;
    }
    if (nearest && !(nearest->runup_elevation >= node.z)) nearest->runup_elevation = node.z;
  }
  for (ShorePoint* p : points) {
    if (std::isnan(p->runup_elevation)) {
      double least = infinite;
      for (const LimitNode& node : limit) {
        const double d = squared(p->x - node.x, p->y - node.y);
        if (d < least) least = d, p->runup_elevation = node.z;
      }
    }
    p->runup = p->runup_elevation - header.particles.still_water_level;
  }
  return result;
}

std::vector<uint8_t> hazard_classes(const RunHeader& header, const std::vector<uint8_t>& lake,
                                    const std::vector<float>& max_elevation, const std::vector<float>& max_depth) {
  std::vector<uint8_t> classes(lake.size(), 0);
  for (std::size_t n = 0; n < lake.size(); ++n) {
    const double height = lake[n] ? max_elevation[n] - header.particles.still_water_level : max_depth[n];
    if (!std::isnan(height)) classes[n] = height < 1 ? 1 : height <= 3 ? 2 : 3;
  }
  return classes;
}

}  // namespace lgiw
