// When the wave of a slide can be anywhere at the earliest.
#pragma once

#include <vector>

#include "case/case.hh"
#include "files/run_file.hh"

namespace lgiw {

/// Lower bounds of the arrival of anything that the slide sets in motion, s, per map node. It starts with the run
/// wherever the slide lies, a kernel's reach around it included, and goes from node to node no faster than water there
/// carries it, at |u| + sqrt(g d) with the greatest speed and depth of the run, or than the slide itself; over ground
/// that neither reaches at the slide's greatest speed. What a surface does before is not the wave: columns at steep
/// shores, which particles fill but roughly, rise and fall while these find their places.
///
/// `depth`, `speed` and `soil_speed` are the run's maxima [ny,nx], empty where it has none. 0 everywhere where
/// something else than a slide moves the water: an initial wave, a body of water, rigid bodies of a profile; and where
/// the maxima are missing.
std::vector<double> earliest_arrival(const RunHeader& header, const Case& c, const std::vector<float>& depth,
                                     const std::vector<float>& speed, const std::vector<float>& soil_speed);
std::vector<double> earliest_arrival(const RunReader& run, const Case& c);  // of its maxima

/// The least of the nodes around (x, y), local; 0 outside the map.
double earliest_near(const SurfaceMap& map, const std::vector<double>& earliest, double x, double y);

}  // namespace lgiw
