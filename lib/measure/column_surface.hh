// Finds the water and the soil surface in vertical columns through the particles.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "files/height_field.hh"
#include "files/run_file.hh"

namespace lgiw {

/// Particles as they come from a frame or from the solver. xyz [n,3] local (in 2-D y = 0); `lost` may be null.
struct ColumnParticles {
  int dimension = 3;
  double dp = 0;  // volume of each is dp^D
  double h = 0;   // smoothing length of the measuring kernel (Wendland C2), 1.5 dp
  std::size_t n_water = 0, n_soil = 0;
  const float* xyz = nullptr;       // water first, then soil
  const float* velocity = nullptr;  // [n,3] or null
  const unsigned char* lost = nullptr;
  /// Vertical side walls in x and y (local; header.low, header.high): what moves and the bed are mirrored in them, so
  /// that a surface is found right up to the wall. Infinite (the default): no walls.
  std::array<double, 2> wall_low{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  std::array<double, 2> wall_high{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
};

/// As a particles file says, between the sides of the domain that are walls, without the particles themselves.
ColumnParticles column_particles(const ParticleHeader& header);
/// With those of a frame, to which it refers.
ColumnParticles column_particles(const ParticleHeader& header, const Frame& frame);

struct ColumnSurfaces {
  std::vector<float> water;       // elevation, NaN where dry
  std::vector<float> soil;        // elevation, NaN where there is no soil; empty without soil
  std::vector<float> depth;       // of water above soil or bed, NaN where dry
  std::vector<float> speed;       // largest |v| of water in the column, NaN where dry; empty without velocity
  std::vector<float> soil_speed;  // the same of soil
};

/// Surfaces at every node of `map`, evaluated again and again as the particles move over one bed.
///
/// The filled fraction at a point is sum_j V_j W(r - r_j) over the particles, plus the fraction of the kernel that lies
/// below the bed (by integration over the height field: right on slopes, in corners and at steps); a surface is where
/// the fraction falls through 1/2. Water: fraction of water + soil + bed, searched from the top down, the highest
/// crossing at which water is more than half of what is filled; a droplet or a sheet thinner than one dp does not reach
/// 1/2 and is passed over. Soil: fraction of soil + bed. Robust on dry beds (NaN) and at the walls (the bed counts as
/// filled). Speeds are those of particles at most dp/2 above the surface within max(map.dx, h)/2 of the node in x and
/// in y, so that splash does not count. Uses all OpenMP threads; the result does not depend on their number. Particles
/// that are lost, not finite or outside the map are left out. `bed` may be empty; it is referred to. Dimension, dp,
/// h and walls are those of the first call: what depends on them and on the bed alone is computed once.
class ColumnSurfaceMap {
 public:
  ColumnSurfaceMap(const SurfaceMap& map, const HeightField& bed);
  ~ColumnSurfaceMap();
  /// The result lives until the next call.
  const ColumnSurfaces& operator()(const ColumnParticles& particles);

 private:
  struct Scene;
  SurfaceMap map_;
  const HeightField& bed_;
  std::unique_ptr<Scene> scene_;
};

/// The same, once.
ColumnSurfaces column_surfaces(const ColumnParticles& particles, const SurfaceMap& map, const HeightField& bed);

}  // namespace lgiw
