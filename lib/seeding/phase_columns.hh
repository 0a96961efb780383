// What stands over a point of the map: water and soil, from the bed upwards.
#pragma once

#include <cstdint>
#include <vector>

#include "case/case.hh"
#include "files/particle_file.hh"
#include "seeding/bed_surface.hh"
#include "seeding/initial_wave.hh"
#include "terrain/terrain_model.hh"

namespace lgiw {

/// A stretch of one phase over a point of the map, in local elevations.
struct PhaseInterval {
  Phase phase = Phase::water;
  double low = 0, high = 0;
  double surface = 0;       // water: the elevation at which its pressure is zero
  double top_pressure = 0;  // soil: of the water standing on it, Pa
  int lattice = 0;          // which lattice fills it; `apart`: particles that are placed by their outline
  bool rigid = false;       // soil: of a rigid body
  int outline = -1;         // soil: of which of outlines(), -1: of none
};

constexpr int apart = -1;

/// A body given by its outline that is filled on its own terms, not on a lattice.
struct Outline {
  std::vector<Point2> polygon;  // local x, z
  int body = -1;                // rigid: number in Case::bodies, or `slide_body`; soil: -1
  bool rigid() const { return body >= 0; }
};
constexpr int slide_body = 1000;  // more than a case can have

/// Points at x = cell centre + x_offset, z = z_phase + (k + 1/2) dp. Lattice 0 is common to the whole scene; a
/// rectangular body in a scene without a still water level brings its own, so that it is filled to its corners.
struct Lattice {
  double x_offset = 0, z_phase = 0;
};

/// Soil and water of a case in vertical columns. Rigid bodies displace soil, both displace water; neither reaches below
/// the bed. Water is
/// everything below still level that is connected to the reservoir (TerrainModel::wet), or the bodies given.
class PhaseColumns {
 public:
  PhaseColumns(const Case& c, const TerrainModel& model, const MapCells& cells, const BedSurface& bed,
               const InitialWave& wave);

  /// Replaces `column` by the stretches over (x, y), from the lowest up; `bed` is the height of the bed there.
  /// `with_outlines` false: as if outlines() were not there.
  void at(double x, double y, double bed, std::vector<PhaseInterval>& column, bool with_outlines = true) const;
  /// Rigid bodies first; where bodies overlap the first has the place.
  const std::vector<Outline>& outlines() const { return outlines_; }
  const std::vector<Lattice>& lattices() const { return lattices_; }
  /// Top of the highest soil or water anywhere, NaN where there is none at all.
  double highest() const { return highest_; }

 private:
  struct Body {
    std::vector<Point2> polygon;  // local x, z
    int lattice = 0;
    int outline = -1;
    bool rigid = false;
  };
  void add_outline(const std::vector<Point2>& given, int number);
  void add_bodies(const std::vector<std::vector<Point2>>& polygons, bool own_lattice, std::vector<Body>& bodies);
  bool wet_at(double x, double y) const;

  const TerrainModel& model_;
  MapCells cells_;
  const InitialWave& wave_;
  bool raster_soil_ = false, rigid_slide_ = false, level_water_ = false, masked_ = false;
  double level_ = 0, water_weight_ = 0, highest_;
  std::vector<Body> soil_, water_;
  std::vector<Outline> outlines_;
  std::vector<Lattice> lattices_;
};

}  // namespace lgiw
