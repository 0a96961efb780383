// Arrival times of a wave over the whole map, at several thresholds at once.
#pragma once

#include <cstdint>
#include <vector>

#include "files/run_file.hh"

namespace lgiw {

/// First time at which the water surface differs from still level, or the water over initially dry land above it is
/// deep, by more than a threshold, per map node, from the surfaces of a run; NaN: never. Not before `earliest` [ny,nx],
/// where the surface moves without the wave (earliest_arrival.hh).
class ArrivalMap {
 public:
  ArrivalMap(const RunHeader& header, std::vector<double> thresholds, std::vector<double> earliest);
  void add(double time, const std::vector<float>& water);
  const std::vector<double>& thresholds() const { return thresholds_; }
  const std::vector<float>& arrival(std::size_t threshold) const { return arrival_[threshold]; }  // [ny,nx], s

 private:
  std::vector<double> thresholds_;
  std::vector<double> reference_;  // [ny,nx]: still water level, or the bed of what is dry at first above it
  std::vector<double> earliest_;   // [ny,nx], s
  double level_;
  bool first_ = true;
  std::vector<std::vector<float>> arrival_;
};

}  // namespace lgiw
