#include "measure/arrival_map.hh"

#include <cmath>

#include "measure/surface_sampling.hh"

namespace lgiw {

ArrivalMap::ArrivalMap(const RunHeader& header, std::vector<double> thresholds)
    : thresholds_(std::move(thresholds)),
      reference_(at_nodes(header.map, header.particles.bed)),
      level_(header.particles.still_water_level),
      arrival_(thresholds_.size(), std::vector<float>(header.map.size(), float(no_value))) {}

void ArrivalMap::add(double time, const std::vector<float>& water) {
  if (first_)
    for (std::size_t n = 0; n < water.size(); ++n)
      if (!std::isnan(water[n])) reference_[n] = level_;
  first_ = false;
  for (std::size_t t = 0; t < thresholds_.size(); ++t)
    for (std::size_t n = 0; n < water.size(); ++n)
      if (std::isnan(arrival_[t][n]) && std::abs(water[n] - reference_[n]) > thresholds_[t])
        arrival_[t][n] = float(time);
}

}  // namespace lgiw
