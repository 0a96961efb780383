// What a tool looks at before any work: whether its outputs can be written, and destroy nothing.
#pragma once

#include <string>
#include <vector>

namespace lgiw {

/// Throws InputError when an output exists and `overwrite` is false or cannot be written, when two outputs have one
/// name, when an output is one of the inputs, or when more than one thing goes to stdout. Empty names are skipped, "-"
/// is stdout; `stdout_taken`: the JSON summary already goes there.
void check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs, bool overwrite,
                   bool stdout_taken);

}  // namespace lgiw
