// Terrain from a profile z(x). Internal to lib/terrain.
#pragma once

#include "case/case.hh"
#include "terrain/terrain_model.hh"

namespace lgiw::detail {

TerrainModel build_analytic_terrain(const Case& c);

/// A spacing of at most `limit` that divides the length of `profile`, and of these, down to a quarter of `limit`, the
/// one whose nodes come closest to the profile's inner points and to `width` (3-D; 0 in 2-D).
double profile_spacing(const std::vector<Point2>& profile, double width, double limit);

}  // namespace lgiw::detail
