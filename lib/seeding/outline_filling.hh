// Particles of the bodies that are given by outlines: soil that no lattice fits, and rigid bodies.
#pragma once

#include <vector>

#include "seeding/bed_surface.hh"
#include "seeding/phase_columns.hh"
#include "seeding/rigid_tiling.hh"

namespace lgiw {

/// A particle of soil in (x, z).
struct SoilPoint {
  double x = 0, z = 0, area = 0;  // m, m, m2
};

/// Particles of PhaseColumns::outlines() in the (x, z) plane; in 3-D every row of map cells has the same.
///
/// Soil: the outline's width is divided evenly into columns about dp wide. A column gets as many particles as its area
/// has dp2, rounded so that the columns together err by less than one, spread evenly over its height; the particles of
/// a body share its area, which is thereby exact. Rigid: tile_polygon().
class OutlineFilling {
 public:
  OutlineFilling(const MapCells& cells, const BedSurface& bed, const PhaseColumns& columns);

  const std::vector<SoilPoint>& soil(int64_t i) const { return soil_[std::size_t(i)]; }  // in map column i
  const std::vector<std::vector<TileParticle>>& rigid() const { return rigid_; }         // per outline

 private:
  void fill_soil(const MapCells& cells, const BedSurface& bed, const PhaseColumns& columns, int outline);
  std::vector<std::vector<SoilPoint>> soil_;
  std::vector<std::vector<TileParticle>> rigid_;
};

}  // namespace lgiw
