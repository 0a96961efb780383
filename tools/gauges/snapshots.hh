// Maps of a moment: the wave and the slide's speed at the times of some frames.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "files/run_file.hh"

namespace lgiw {

/// Names of the files that write_snapshots() writes into `folder`.
std::vector<std::string> snapshot_files(const std::string& folder, const RunReader& run,
                                        const std::vector<std::size_t>& frames);

/// GeoTIFFs wave_<t>s.tif, water surface above the still water level (m, NaN where dry), and, where there is soil,
/// slide_speed_<t>s.tif, largest speed of the soil near its surface (m/s, NaN where there is none); t is the time of
/// the frame rounded to whole seconds, to milliseconds where two frames would share one.
void write_snapshots(const std::string& folder, const RunReader& run, const std::vector<std::size_t>& frames,
                     bool overwrite);

}  // namespace lgiw
