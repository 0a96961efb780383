// The highest water surface that the wave makes, over the whole map.
#pragma once

#include <vector>

#include "case/case.hh"
#include "files/run_file.hh"

namespace lgiw {

/// Per node of the map the highest of the surfaces from `earliest` [ny,nx] on (earliest_arrival.hh), local z; where
/// water is measured at the first time no lower than its level, at which it is at rest before; NaN where neither is,
/// also in what of the lake is too shallow to be measured. 3-D runs only.
class HighestSurface {
 public:
  HighestSurface(const RunHeader& header, std::vector<double> earliest);
  /// The next water surface, [ny,nx] local.
  void add(double time, const std::vector<float>& water);
  const std::vector<float>& elevation() const { return elevation_; }
  const std::vector<uint8_t>& lake() const { return lake_; }  // at rest: shore.hh

 private:
  const RunHeader& header_;
  std::vector<double> earliest_;
  std::vector<uint8_t> lake_;
  std::vector<float> elevation_;
};
std::vector<float> highest_surface(const RunReader& run, const Case& c);  // of its surfaces

}  // namespace lgiw
