// What make must know to run a tool again when one of its inputs has changed.
#pragma once

#include <string>
#include <vector>

namespace lgiw {

/// "target: input input ...", and a rule without a recipe for each input, so that one that is gone stops nothing. Only
/// files: neither pipes nor GDAL's own names.
std::string make_rule(const std::string& target, const std::vector<std::string>& inputs);

}  // namespace lgiw
