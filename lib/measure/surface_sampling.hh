// Values of surface rasters between their nodes, and the places along section lines where they are asked for.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "case/case.hh"
#include "files/height_field.hh"
#include "files/run_file.hh"

namespace lgiw {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Bilinear between the nodes that have a value (wet nodes); NaN where these carry less than half of the weight, and
/// where the point lies more than one cell outside the map. `values` [ny,nx]; x, y local.
double sample_surface(const SurfaceMap& map, const std::vector<float>& values, double x, double y);

/// `field` at the nodes of `map`.
std::vector<double> at_nodes(const SurfaceMap& map, const HeightField& field);

/// The ground before the slide, or the bed where the file has none.
const HeightField& ground_of(const ParticleHeader& header);

/// The case a run was made from, with the gauges, sections and thresholds of `case_file` (empty: its own): what is
/// measured can be chosen anew, what was computed cannot. All of `case_file` where the run holds no case. Throws
/// InputError for gauges and sections outside the run's domain, for a case of another dimension, and for a text that is
/// no case.
Case case_of_run(const RunHeader& header, const std::string& run_path, const std::string& case_file);
/// A place on a section line.
struct Station {
  double distance = 0;  // m from the first point along the line
  double x = 0, y = 0;  // local
};

/// Places every `spacing` along the line from its first to its last point, which is always the last place.
std::vector<Station> section_stations(const Section& section, const std::array<double, 3>& origin, double spacing);

}  // namespace lgiw
