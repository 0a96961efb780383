// Profiles along section lines: bed, soil surface, water surface and slip line.
#pragma once

#include <vector>

#include "case/case.hh"
#include "files/run_file.hh"
#include "measure/surface_sampling.hh"

namespace lgiw {

/// A profile at one time. Elevations in the case's vertical datum, m, by station; NaN where there is none.
struct SectionProfile {
  std::vector<Station> stations;
  std::vector<double> ground;  // before the slide
  std::vector<double> bed, soil, water;
  /// Lowest elevation at which the accumulated plastic strain rises through the threshold going up; the bed where it is
  /// above the threshold right there (a slide that runs on its given failure surface). NaN where it stays below.
  std::vector<double> slip;
};

/// Profiles of a frame, a station every map.dx. The strain between the particles is their Shepard mean with the
/// measuring kernel of column_surface.hh.
std::vector<SectionProfile> section_profiles(const RunHeader& header, const Frame& frame,
                                             const std::vector<Section>& sections, double adps_threshold);

}  // namespace lgiw
