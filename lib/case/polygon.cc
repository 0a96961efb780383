#include "case/polygon.hh"

#include <algorithm>
#include <cmath>

namespace lgiw {

AreaAndCentroid area_and_centroid(const std::vector<Point2>& polygon) {
  if (polygon.empty()) return {};
  // Relative to a corner, so that coordinates far from the origin cost no digits.
  const Point2 o = polygon.front();
  double twice = 0, x = 0, z = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double ax = a[0] - o[0], az = a[1] - o[1], bx = b[0] - o[0], bz = b[1] - o[1], cross = ax * bz - bx * az;
    twice += cross, x += cross * (ax + bx), z += cross * (az + bz);
  }
  if (twice == 0) return {0, o};
  return {0.5 * std::abs(twice), {o[0] + x / (3 * twice), o[1] + z / (3 * twice)}};
}

std::vector<Point2> clipped(std::vector<Point2> polygon, const Point2& low, const Point2& high) {
  std::vector<Point2> kept;
  for (std::size_t axis = 0; axis < 2; ++axis)
    for (const double side : {1.0, -1.0}) {
      const double limit = side > 0 ? low[axis] : high[axis];
      kept.clear();
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Point2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        const double inside_a = side * (a[axis] - limit), inside_b = side * (b[axis] - limit);
        if (inside_a >= 0) kept.push_back(a);
        if ((inside_a < 0) == (inside_b < 0)) continue;
        const double part = inside_a / (inside_a - inside_b);
        kept.push_back({a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])});
      }
      polygon.swap(kept);
    }
  return polygon;
}

NearestBoundary nearest_boundary(const std::vector<Point2>& polygon, const Point2& p, const std::vector<bool>& skip) {
  NearestBoundary nearest;
  nearest.distance = HUGE_VAL;
  const bool none = std::all_of(skip.begin(), skip.end(), [](bool s) { return s; });
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    if (!none && skip[k]) continue;
    const Point2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double dx = b[0] - a[0], dz = b[1] - a[1];
    const double along = std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dz) / (dx * dx + dz * dz), 0.0, 1.0);
    const Point2 q{a[0] + along * dx, a[1] + along * dz};
    const double distance = std::hypot(p[0] - q[0], p[1] - q[1]);
    if (distance < nearest.distance) nearest = {q, distance, k};
  }
  return nearest;
}

bool contains(const std::vector<Point2>& polygon, const Point2& p) {
  bool inside = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if ((a[0] <= p[0]) != (b[0] <= p[0]) && p[1] < a[1] + (b[1] - a[1]) * (p[0] - a[0]) / (b[0] - a[0]))
      inside = !inside;
  }
  return inside;
}

}  // namespace lgiw
