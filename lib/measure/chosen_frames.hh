// Which frames of a run an option asks for.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "files/run_file.hh"

namespace lgiw {

/// `words` are `first`, `last` and times in s, which take the nearest frame. Returns the frames in order of time, each
/// once. Throws InputError, naming `option`, for a word that is none of these and for a time outside the run.
std::vector<std::size_t> chosen_frames(const std::string& option, const std::vector<std::string>& words,
                                       const RunReader& run);

}  // namespace lgiw
