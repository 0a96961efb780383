// The wave that is on the water at time zero.
#pragma once

#include <array>

#include "case/case.hh"
#include "seeding/bed_surface.hh"
#include "terrain/terrain_model.hh"

namespace lgiw {

/// Elevation, velocity and pressure of water.wave over a profile; without one the water is at rest and level. Local
/// coordinates.
///
/// Solitary (the data of Synolakis, J. Fluid Mech. 185, 1987, 523-545): eta = H sech2(gamma (x - X) / d), gamma =
/// sqrt(3 H / (4 d)), u = +-eta sqrt(g / d), d the still depth at the crest; w = -(z - z_bed) du/dx satisfies
/// continuity over a flat bed. Standing: eta = A cos(n pi (x - x_west) / L), at rest; its pressure is that of linear
/// theory, eta cosh(k (z + d)) / cosh(k d) below the still water, d the local still depth.
class InitialWave {
 public:
  /// Throws InputError for a crest over dry land or higher than 0.78 d (McCowan's limit), or a standing wave that
  /// leaves the bed dry at its trough over the deepest place.
  InitialWave(const Case& c, const TerrainModel& model, const MapCells& cells, const BedSurface& bed);

  bool present() const { return wave_.has_value(); }
  bool moving() const { return wave_ && wave_->kind == WaveKind::solitary; }
  double elevation(double x) const;  // m above the still water
  double highest() const;            // m above the still water
  /// m/s at height z over a bed of height `bed`.
  std::array<double, 3> velocity(double x, double z, double bed) const;
  /// Height of water, m, whose weight is the pressure at (x, z); not negative.
  double pressure_head(double x, double z, double bed) const;

 private:
  std::optional<Wave> wave_;
  double level_, crest_ = 0, depth_ = 1, gamma_ = 0, speed_ = 0, x_west_, number_ = 0;  // number_: k, 1/m
};

}  // namespace lgiw
