// Maps of how runs of one case at several particle spacings differ.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "case/case.hh"
#include "files/run_file.hh"

namespace lgiw {

/// Names of the files that write_difference_maps() writes into `folder`.
std::vector<std::string> difference_map_files(const std::string& folder,
                                              const std::vector<std::unique_ptr<RunReader>>& runs);

/// Of each run minus the finest, at the nodes of the coarsest run's map, for 3-D runs sorted from fine to coarse:
/// highest water surface of the wave (HighestSurface; no-data where either stayed dry), soil surface at the end
/// (no-data where either has none) and thickness of the slide at the end (a run without soil there counts 0; no-data
/// where neither has any). Thickness is the volume of particles by cell of that map for both, so that the sum of a map
/// is the difference of the volumes.
void write_difference_maps(const std::string& folder, const std::vector<std::unique_ptr<RunReader>>& runs,
                           const Case& c, bool overwrite);

}  // namespace lgiw
