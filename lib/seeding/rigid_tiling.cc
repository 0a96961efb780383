#include "seeding/rigid_tiling.hh"

#include <algorithm>
#include <cmath>

#include "case/polygon.hh"

namespace lgiw {

namespace {

constexpr double on_bed = 0.25;  // of dp: an edge no farther from the bed lies on it

}  // namespace

std::vector<TileParticle> tile_polygon(const std::vector<Point2>& polygon, double dp,
                                       const std::function<double(double)>& bed) {
  const std::size_t corners = polygon.size();
  std::vector<bool> on_ground(corners);
  double longest = 0, cosine = 1, sine = 0;
  for (std::size_t k = 0; k < corners; ++k) {
    const Point2 &a = polygon[k], &b = polygon[(k + 1) % corners];
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    if (length > longest * (1 + 1e-9)) longest = length, cosine = (b[0] - a[0]) / length, sine = (b[1] - a[1]) / length;
    on_ground[k] = true;
    for (const double along : {0.0, 0.5, 1.0}) {
      const double x = a[0] + along * (b[0] - a[0]), z = a[1] + along * (b[1] - a[1]);
      if (std::abs(z - bed(x)) > on_bed * dp) on_ground[k] = false;
    }
  }

  // Along and across the longest edge.
  std::vector<Point2> turned;
  for (const Point2& p : polygon) turned.push_back({cosine * p[0] + sine * p[1], cosine * p[1] - sine * p[0]});
  Point2 low = turned[0], high = turned[0];
  for (const Point2& p : turned)
    for (std::size_t axis = 0; axis < 2; ++axis)
      low[axis] = std::min(low[axis], p[axis]), high[axis] = std::max(high[axis], p[axis]);
  const auto layers = [dp](double extent) { return std::max<int64_t>(1, std::llround(extent / dp)); };
  const int64_t nu = layers(high[0] - low[0]), nv = layers(high[1] - low[1]);
  const double du = (high[0] - low[0]) / double(nu), dv = (high[1] - low[1]) / double(nv);

  std::vector<AreaAndCentroid> cells(std::size_t(nu * nv));
  const auto at = [&](int64_t u, int64_t v) -> AreaAndCentroid& { return cells[std::size_t(v * nu + u)]; };
  for (int64_t v = 0; v < nv; ++v)
    for (int64_t u = 0; u < nu; ++u)
      at(u, v) = area_and_centroid(clipped(turned, {low[0] + double(u) * du, low[1] + double(v) * dv},
                                           {low[0] + double(u + 1) * du, low[1] + double(v + 1) * dv}));
  // Smallest first, so that slivers beside each other gather.
  std::vector<int64_t> slivers;
  for (int64_t n = 0; n < nu * nv; ++n)
    if (cells[std::size_t(n)].area > 0 && cells[std::size_t(n)].area < sliver * du * dv) slivers.push_back(n);
  std::stable_sort(slivers.begin(), slivers.end(),
                   [&](int64_t a, int64_t b) { return cells[std::size_t(a)].area < cells[std::size_t(b)].area; });
  for (const int64_t n : slivers) {
    AreaAndCentroid& cell = cells[std::size_t(n)];
    if (cell.area >= sliver * du * dv) continue;  // has gathered enough meanwhile
    const int64_t u = n % nu, v = n / nu;
    AreaAndCentroid* fullest = nullptr;
    for (const auto& [i, j] : {std::pair{u - 1, v}, {u + 1, v}, {u, v - 1}, {u, v + 1}}) {
      if (i < 0 || j < 0 || i >= nu || j >= nv || at(i, j).area <= 0) continue;
      if (!fullest || at(i, j).area > fullest->area) fullest = &at(i, j);
    }
    if (!fullest) continue;
    const double sum = fullest->area + cell.area;
    for (std::size_t axis = 0; axis < 2; ++axis)
      fullest->centroid[axis] = (fullest->area * fullest->centroid[axis] + cell.area * cell.centroid[axis]) / sum;
    fullest->area = sum;
    cell.area = 0;
  }

  std::vector<TileParticle> particles;
  for (const AreaAndCentroid& cell : cells) {
    if (cell.area <= 0) continue;
    TileParticle particle;
    const Point2& c = cell.centroid;
    particle.place = {cosine * c[0] - sine * c[1], sine * c[0] + cosine * c[1]};
    particle.area = cell.area;
    const NearestBoundary nearest = nearest_boundary(polygon, particle.place, on_ground);
    const Point2 &a = polygon[nearest.edge], &b = polygon[(nearest.edge + 1) % corners];
    const double dx = b[0] - a[0], dz = b[1] - a[1], length = std::hypot(dx, dz);
    // The direction to the nearest point, smooth around corners; of the edge where that is too near to have one.
    particle.normal = {dz / length, -dx / length};
    if (nearest.distance > 1e-3 * dp && contains(polygon, particle.place)) {
      for (std::size_t axis = 0; axis < 2; ++axis)
        particle.normal[axis] = (nearest.point[axis] - particle.place[axis]) / nearest.distance;
    } else {
      const Point2 ahead{nearest.point[0] + 1e-3 * dp * particle.normal[0],
                         nearest.point[1] + 1e-3 * dp * particle.normal[1]};
      if (contains(polygon, ahead)) particle.normal = {-particle.normal[0], -particle.normal[1]};
    }
    particles.push_back(particle);
  }
  return particles;
}

}  // namespace lgiw
