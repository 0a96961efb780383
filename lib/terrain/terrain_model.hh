// Terrain, reservoir and slide of a case as height fields: what the seeding of particles starts from.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/provenance.hh"
#include "case/case.hh"
#include "files/height_field.hh"

namespace lgiw {

/// All in local coordinates: local = case CRS - origin. ground and bed share one grid, whose spacing is at most dp or
/// the pixel of the finest source, whichever is larger; bed <= ground, and soil lies between them.
///
/// Nodes are cell centres of the finest source where that is north-up with square pixels in the case's CRS, so its
/// values stay as they are; where dp spans k >= 2 pixels, a node is the mean of k x k cells. Analytic scenes: origin 0,
/// nodes at most dp/2 apart and placed on the kinks of the profile as well as one spacing can; ny == 1 in 2-D.
struct TerrainModel {
  HeightField ground, bed;
  std::vector<uint8_t> wet;    // per node: in the reservoir (connected to the seed, ground below still water level)
  std::vector<uint8_t> slide;  // per node: soil there
  std::array<double, 3> origin{0, 0, 0};
  std::string crs_wkt;
  double still_water_level = 0;  // local; NaN without water
  // Report.
  int64_t voids_filled = 0, spikes = 0, spikes_removed = 0;
  double reservoir_area = 0, reservoir_volume = 0;  // from the source-resolution cells, m2, m3 (2-D: m, m2)
  double slide_volume = 0;                          // m3, from the source-resolution cells; 0 for slide.bodies
  double max_water_depth = 0;                       // m
  std::array<double, 4> domain{};                   // local x_min, y_min, x_max, y_max; the outermost nodes of a DEM
  std::vector<std::string> notes;                   // what the user should know, one sentence each
};

/// Builds the model for a case with raster sources or an analytic profile; hashes the input files into `provenance`.
///
/// Throws InputError for whatever is wrong with the inputs: sources that are no rasters, truncated, without CRS (unless
/// the case names one), a case CRS in degrees or feet, windows outside the sources or on voids (unless
/// terrain.fill_voids), a seed on dry land, a level above or below the terrain, a reservoir at an open side, slides
/// outside the domain, above the ground or empty.
TerrainModel build_terrain(const Case& c, Provenance& provenance);

/// Per node of `model.ground`: 1 where water or soil can get to, and walls are therefore needed, kernel support
/// included.
///
/// Water: nodes connected to the reservoir that lie below still level + terrain.runup_allowance. Automatic allowance:
/// half the drop from the slide's highest point to the still level, at least 10 dp; of the run-ups of impulse waves in
/// the field, only Lituya Bay 1958 (524 m after a drop of about 900 m) exceeds that. Soil: the slide's footprint and
/// nodes connected to it that lie below the energy line, which falls from the slide's highest point at
/// terrain.reach_angle (Heim's angle of reach). Connections are 8-fold. All of it widened by 2 h + dp. Analytic scenes
/// are small: every node.
std::vector<uint8_t> reachable_nodes(const TerrainModel& model, const Case& c);

}  // namespace lgiw
