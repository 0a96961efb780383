#include "measure/highest_surface.hh"

#include <cmath>
#include <utility>

#include "measure/earliest_arrival.hh"
#include "measure/shore.hh"
#include "measure/surface_sampling.hh"

namespace lgiw {

HighestSurface::HighestSurface(const RunHeader& header, std::vector<double> earliest)
    : header_(header), earliest_(std::move(earliest)) {}

void HighestSurface::add(double time, const std::vector<float>& water) {
  if (elevation_.empty()) {
    lake_ = lake_at_rest(header_, water);
    elevation_.assign(water.size(), float(no_value));
    for (std::size_t n = 0; n < water.size(); ++n)
      if (!std::isnan(water[n])) elevation_[n] = float(header_.particles.still_water_level);
  }
  for (std::size_t n = 0; n < water.size(); ++n)
    if (time >= earliest_[n] && !std::isnan(water[n]) && !(water[n] <= elevation_[n])) elevation_[n] = water[n];
}

std::vector<float> highest_surface(const RunReader& run, const Case& c) {
  HighestSurface highest(run.header(), earliest_arrival(run, c));
  for (std::size_t k = 0; k < run.surface_times().size(); ++k)
    highest.add(run.surface_times()[k], run.water_surface(k));
  return highest.elevation();
}

}  // namespace lgiw
