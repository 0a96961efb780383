// The handful of numbers that a hazard study takes from a run.
#pragma once

#include <string>
#include <vector>

#include "case/case.hh"
#include "files/run_file.hh"

namespace lgiw {

struct Measure {
  std::string name;      // of the gauge or section; "slide", "deposit"
  std::string quantity;  // with its unit at the end, as in the tools' summaries
  std::string unit;
  double value = 0;  // NaN: the run has none, such as the wave at a gauge that stays dry
};

/// max_height_m and time_of_max_s of each gauge in water, runup_m of each section, and of the slide slide_volume_m3,
/// immersed_volume_m3, runout_of_centre_m and runout_of_front_m (and front_x_m in 2-D). What the scene lacks is absent;
/// the order is that of the case. The run has surfaces and, with soil, frames.
std::vector<Measure> run_measures(const RunReader& run, const Case& c);

}  // namespace lgiw
