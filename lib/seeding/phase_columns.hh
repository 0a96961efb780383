// What stands over a point of the map: water and soil, from the bed upwards.
#pragma once

#include <cstdint>
#include <vector>

#include "case/case.hh"
#include "files/particle_file.hh"
#include "seeding/bed_surface.hh"
#include "terrain/terrain_model.hh"

namespace lgiw {

/// A stretch of one phase over a point of the map, in local elevations.
struct PhaseInterval {
  Phase phase = Phase::water;
  double low = 0, high = 0;
  double surface = 0;       // water: the elevation at which its pressure is zero
  double top_pressure = 0;  // soil: of the water standing on it, Pa
  int lattice = 0;          // which lattice fills it
};

/// Points at x = cell centre + x_offset, z = z_phase + (k + 1/2) dp. Lattice 0 is common to the whole scene; a
/// rectangular body in a scene without a still water level brings its own, so that it is filled to its corners.
struct Lattice {
  double x_offset = 0, z_phase = 0;
};

/// Soil and water of a case in vertical columns. Soil displaces water; neither reaches below the bed. Water is
/// everything below still level that is connected to the reservoir (TerrainModel::wet), or the bodies given.
class PhaseColumns {
 public:
  PhaseColumns(const Case& c, const TerrainModel& model, const MapCells& cells, const BedSurface& bed);

  /// Replaces `column` by the stretches over (x, y), from the lowest up; `bed` is the height of the bed there.
  void at(double x, double y, double bed, std::vector<PhaseInterval>& column) const;
  const std::vector<Lattice>& lattices() const { return lattices_; }
  /// Top of the highest soil or water anywhere, NaN where there is none at all.
  double highest() const { return highest_; }

 private:
  struct Body {
    std::vector<Point2> polygon;  // local x, z
    int lattice = 0;
  };
  void add_bodies(const std::vector<std::vector<Point2>>& polygons, bool own_lattice, std::vector<Body>& bodies);
  bool wet_at(double x, double y) const;

  const TerrainModel& model_;
  MapCells cells_;
  bool raster_soil_ = false, level_water_ = false, masked_ = false;
  double level_ = 0, water_weight_ = 0, highest_;
  std::vector<Body> soil_, water_;
  std::vector<Lattice> lattices_;
};

}  // namespace lgiw
