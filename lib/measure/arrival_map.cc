#include "measure/arrival_map.hh"

#include <algorithm>
#include <cmath>

#include "measure/surface_sampling.hh"

namespace lgiw {

ArrivalMap::ArrivalMap(const RunHeader& header, std::vector<double> thresholds, std::vector<double> earliest)
    : thresholds_(std::move(thresholds)),
      reference_(at_nodes(header.map, header.particles.bed)),
      earliest_(std::move(earliest)),
      level_(header.particles.still_water_level),
      arrival_(thresholds_.size(), std::vector<float>(header.map.size(), float(no_value))) {
  // Where the bed lies below the level there is the lake, measured or not.
  for (double& z : reference_) z = std::max(z, level_);
}

void ArrivalMap::add(double time, const std::vector<float>& water) {
  if (first_)
    for (std::size_t n = 0; n < water.size(); ++n)
      if (!std::isnan(water[n])) reference_[n] = level_;
  first_ = false;
  for (std::size_t t = 0; t < thresholds_.size(); ++t)
    for (std::size_t n = 0; n < water.size(); ++n)
      if (std::isnan(arrival_[t][n]) && time >= earliest_[n] && std::abs(water[n] - reference_[n]) > thresholds_[t])
        arrival_[t][n] = float(time);
}

}  // namespace lgiw
