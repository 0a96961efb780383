// Maps of a run's wave: rasters of the maxima, shoreline, run-up along it and inundation.
#pragma once

#include <string>
#include <vector>

#include "files/run_file.hh"
#include "measure/arrival_map.hh"
#include "measure/gauge_series.hh"
#include "measure/highest_surface.hh"

namespace lgiw {

/// Names of the files that write_wave_maps() writes into `folder`.
std::vector<std::string> wave_map_files(const std::string& folder, const std::vector<double>& thresholds);

/// GeoTIFFs ground and max_elevation (case datum; of `highest`), max_depth, max_speed, arrival (of the first threshold
/// of `arrivals`), arrival_<threshold>m (of the others) and hazard (0-3, see shore.hh), and wave.gpkg with the layers
/// gauges (points), shoreline and shore_runup (lines; each piece of the latter with runup_m, elevation_m and its
/// distance along the shore), inundation (1 lake at rest, 2 inundated land) and hazard (polygons). Returns the largest
/// run-up along the shore above still water level, m.
double write_wave_maps(const std::string& folder, const RunReader& run, const HighestSurface& highest,
                       const ArrivalMap& arrivals, const std::vector<GaugeSeries>& gauges,
                       const std::vector<GaugePeaks>& peaks, bool overwrite);

}  // namespace lgiw
