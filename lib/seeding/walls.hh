// Wall particles: columns that follow the bed, and lattices outside the sides of the domain.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "case/case.hh"
#include "seeding/bed_surface.hh"
#include "terrain/terrain_model.hh"

namespace lgiw {

struct WallParticle {
  std::array<double, 3> position, normal;  // normal: unit, into the domain
  double volume = 0;                       // m3; m2 in 2-D
  uint8_t kind = 0;                        // 0 bed, 1 side
};

/// Walls of a scene, column by column of MapCells.
///
/// Bed: a map cell is divided into nx x ny sub-columns, nx = max(1, ceil(sqrt(1 + z_x^2) - 1/4)), so that the spacing
/// along the surface stays within 0.63 and 1.25 dp. With J = sqrt(1 + z_x^2 + z_y^2) layers lie at z_bed - (k + 1/2) dp
/// J, that is dp apart across the surface, and a particle stands for dp/nx x dp/ny x dp J: volumes tile the solid,
/// whatever the bends. A column goes down to where no point of the surface (cliffs beside it included) is nearer than
/// 2h; a last layer of which less than a quarter lies within 2h is left out, since the kernel vanishes there.
///
/// Sides (wall and absorbing ones; open sides have none): outside the domain, above the bed, on the common lattice.
/// Where the bed cuts a lattice cell, the lowest particle is the middle of what is left of it (from 1/2 to 3/2 of a
/// cell), so that side and bed tile the corner too.
class Walls {
 public:
  Walls(const Case& c, const TerrainModel& model, const MapCells& cells, const BedSurface& bed, double z_phase,
        double highest_fluid);

  /// Appends the particles of column (i, j) and returns how many more nothing can reach and are therefore left out.
  int64_t column(int64_t i, int64_t j, std::vector<WallParticle>& particles) const;
  double side_top() const { return side_top_; }
  /// Sub-columns {nx, ny} of a map cell over a surface of this gradient.
  static std::array<int64_t, 2> subdivision(const std::array<double, 2>& gradient, bool two_d);

 private:
  double bottom(double x, double y, double height) const;
  std::array<double, 3> towards_open_space(const std::array<double, 3>& p, double depth,
                                           const std::array<double, 3>& otherwise) const;
  template <class Visit>
  void visit_surface(double x, double y, double reach, const Visit& visit) const;
  bool reachable(int64_t i, int64_t j) const;
  void bed_column(int64_t i, int64_t j, std::vector<WallParticle>& particles) const;
  void side_column(int64_t i, int64_t j, std::vector<WallParticle>& particles) const;

  MapCells cells_;
  const BedSurface& bed_;
  double thickness_, z_phase_, side_top_, soil_margin_;
  bool fixed_top_ = false;
  std::array<bool, 4> side_wall_;  // west, east, south, north
  struct Cell {
    double height;
    std::array<float, 2> slope;
  };
  int64_t halo_ = 0;                // cells of centre_ beyond the rim
  std::vector<Cell> centre_;        // bed at the cell centres, rim and halo included
  std::vector<uint8_t> reachable_;  // per cell of the domain
};

}  // namespace lgiw
