// Particles of a rigid body that is given by its outline.
#pragma once

#include <functional>
#include <vector>

#include "case/case.hh"

namespace lgiw {

/// One of the particles that tile a body in (x, z).
struct TileParticle {
  Point2 place, normal;  // normal: unit, out of the body through the nearest part of its outline that can meet fluid
  double area = 0;       // m2
};

/// Tiles a simple polygon with particles about dp apart, in a lattice along its longest edge whose layers fill the
/// polygon's extent along and across that edge exactly. A cell that the outline cuts becomes a particle at the centroid
/// of what is left, with its area; less than `sliver` of a cell joins the neighbour that has the longest side in common
/// with it (the fullest one). The areas add up to the polygon's. Edges that lie on the bed (`bed`: its height at x) get
/// no normals: nothing flows there.
std::vector<TileParticle> tile_polygon(const std::vector<Point2>& polygon, double dp,
                                       const std::function<double(double)>& bed);

constexpr double sliver = 0.3;

}  // namespace lgiw
