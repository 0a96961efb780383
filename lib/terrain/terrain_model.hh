// Terrain, reservoir and slide of a case as height fields: what the seeding of particles starts from.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/provenance.hh"
#include "case/case.hh"
#include "files/height_field.hh"

namespace lgiw {

/// All in local coordinates: local = case CRS - origin. ground and bed share one grid, whose spacing is at most dp or the
/// pixel of the finest source, whichever is larger; bed <= ground, and soil lies between them.
struct TerrainModel {
  HeightField ground, bed;
  std::vector<uint8_t> wet;        // per node: in the reservoir (connected to the seed, ground below still water level)
  std::vector<uint8_t> slide;      // per node: soil there
  std::array<double, 3> origin{0, 0, 0};
  std::string crs_wkt;
  double still_water_level = 0;    // local; NaN without water
  // Report.
  int64_t voids_filled = 0, spikes = 0, spikes_removed = 0;
  double reservoir_area = 0, reservoir_volume = 0;   // from the source-resolution cells, m2, m3
  double slide_volume = 0;         // m3
  double max_water_depth = 0;      // m
};

/// Builds the model for a case with raster sources or an analytic profile; hashes the input files into `provenance`.
TerrainModel build_terrain(const Case& c, Provenance& provenance);

}  // namespace lgiw
