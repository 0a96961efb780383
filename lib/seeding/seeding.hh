// From a case and its terrain to particles.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "case/case.hh"
#include "files/particle_file.hh"
#include "terrain/terrain_model.hh"

namespace lgiw {

/// Volumes in m3 (m2 in 2-D).
struct SeedingReport {
  ParticleCounts counts;
  double water_volume = 0, soil_volume = 0, wall_volume = 0;  // of the particles
  double water_expected = 0, soil_expected = 0;               // between bed, soil top and still water, integrated
  std::vector<double> body_volumes;                           // of ParticleHeader::bodies, of the particles
  double max_water_depth = 0, slide_drop_height = 0;          // m; what the automatic sound speed rests on: the depth
                                                              // to the bed, below submerged soil too
  double greatest_depth = 0;                                  // m; of the water itself
  double east_moved = 0, north_moved = 0;                     // m: sides moved to a multiple of dp
  // Particles: over the columns, one dp wide, that hold soil.
  double median_soil_column = 0, greatest_soil_column = 0;
  double soil_extent = 0;  // m, along the axis where it is longest
};

/// Places the particles of a case: water and soil on a common lattice of spacing dp, walls as lib/seeding/walls.hh has
/// it.
///
/// The lattice has a layer of particles half a dp below the still water. A particle stands for dp^D; a column H layers
/// deep gets H of them on average over neighbouring columns, so that volumes are unbiased whatever the shape of the
/// bed. The lowest `settled_layers` of a column are stretched or squeezed so that the lowest lies half a dp above the
/// bed: neither voids nor crowding at the wall. On steep slopes particles nearer than `nearest_wall` dp (across the
/// bed) are moved out to that distance.
///
/// Measured with the Wendland kernel, h = 1.5 dp. Slopes of 0 to 70 degrees (2-D) that meet the lattice in seven places
/// each: volume error of a basin 20 dp deep 0.3 %, nearest pair 0.80 dp, nearest wall particle 0.85 dp, sum of V W over
/// water and wall 0.93 to 1.10 (RMS error 2.5 %). Big Tujunga at dp of 7.5 to 15 m: water 0.2 %, nearest pair 0.74 dp,
/// nearest wall 0.84 dp for water and 0.60 dp for soil (beside the steps of a failure surface). Plain lattice points
/// above the bed instead err by 2 % in volume over flat beds and stand anywhere from 0 to 1 dp above it.
///
/// Rigid bodies that move (slide.motion, bodies) are particles of wall, kind 2. Of outlines they are tiled as
/// lib/seeding/rigid_tiling.hh has it, over the whole width. A rigid slide of a DEM is divided into columns and layers
/// as walls are, downwards from the ground; the last layer of a column is what is left (less than 0.3 of a layer joins
/// the one above), and the volumes are scaled to that of the terrain. Water settles on such a slide as on the bed.
///
/// Around outlines (rigid ones, and soil as lib/seeding/outline_filling.hh fills it) water starts from its lattice: of
/// the cells that an outline cuts so many keep a particle that the volume is kept, and if there are any, the water
/// within `packed_layers` dp is packed (lib/seeding/packing.hh); what comes nearer than dp/2 to other particles goes.
///
/// With water.wave the column under eta has round(eta / dp) more layers than the one at rest and is stretched from the
/// bed to end at eta exactly, with the volumes of its particles: free surface and volume are continuous, whatever dp.
///
/// The order is water, soil, wall, each row by row of map columns from the south-west, in a column upwards (walls
/// downwards), rigid bodies of outlines last: it depends neither on the tile size nor on the number of threads.
class Seeder {
 public:
  static constexpr int settled_layers = 8;
  static constexpr double nearest_wall = 0.35;
  static constexpr double packed_layers = 5;

  /// `model` must outlive the seeder. Throws InputError for cases without terrain or with more than 2e9 particles, and
  /// for motion files that are unsound.
  Seeder(const Case& c, const TerrainModel& model);
  ~Seeder();

  /// First pass: counts and volumes. `progress`, here and below, gets the fraction done.
  const SeedingReport& count(const std::function<void(double)>& progress = {});
  const SeedingReport& report() const;
  /// All but the provenance; header.counts is filled by count().
  const ParticleHeader& header() const;
  /// Second pass: hands out blocks of one phase, tile by tile of `tile_columns` map columns, phases interleaved.
  void seed(const std::function<void(const ParticleBlock&)>& sink, const std::function<void(double)>& progress = {},
            int64_t tile_columns = 1 << 15) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// All particles in memory: for tests and small scenes.
ParticleData seed_particles(const Case& c, const TerrainModel& model);

}  // namespace lgiw
