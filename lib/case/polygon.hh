// Simple polygons in the (x, z) plane.
#pragma once

#include <vector>

#include "case/case.hh"

namespace lgiw {

struct AreaAndCentroid {
  double area = 0;  // m2, not negative
  Point2 centroid{0, 0};
};

/// Of a simple polygon, whichever way round it is given; the centroid of one without area is its first point.
AreaAndCentroid area_and_centroid(const std::vector<Point2>& polygon);

/// The part of a polygon within [low, high] (Sutherland and Hodgman, Commun. ACM 17, 1974, 32-42). Pieces that do not
/// hang together come out joined by edges that double back, which have no area.
std::vector<Point2> clipped(std::vector<Point2> polygon, const Point2& low, const Point2& high);

struct NearestBoundary {
  Point2 point{0, 0};
  double distance = 0;
  std::size_t edge = 0;  // from point number `edge` to the next
};

/// The point of the boundary that is nearest to p; edges marked in `skip` do not count unless all are.
NearestBoundary nearest_boundary(const std::vector<Point2>& polygon, const Point2& p,
                                 const std::vector<bool>& skip = {});

bool contains(const std::vector<Point2>& polygon, const Point2& p);

}  // namespace lgiw
