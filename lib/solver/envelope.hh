// How far a case lies from what the solver was tried on, and what to expect beyond.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "case/case.hh"
#include "solver/setup.hh"

namespace lgiw {

/// A dimensionless number of a case and the range in which the stability matrix passes (`make -C pipelines stability`,
/// docs/stability.md); infinite where no limit was found.
struct EnvelopeAxis {
  std::string name;
  double value, low, high;
  std::string below, above;  // what to expect there, and what to change
  bool inside() const { return value >= low && value <= high; }
};

/// The axes that the scene has.
std::vector<EnvelopeAxis> envelope_of(const Case& c, const ModelParameters& p);

/// One sentence for every axis that the case is outside of.
std::vector<std::string> warnings_of(const std::vector<EnvelopeAxis>& envelope);
/// A list of {axis, value, low, high, inside}; null for no limit.
nlohmann::ordered_json json_of(const std::vector<EnvelopeAxis>& envelope);

}  // namespace lgiw
