// Series in time, of the run's gauges and of references.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "run.hh"

namespace lgiw::validation {

struct Series {
  std::vector<double> time, value;  // s; rising
};

/// Height of a gauge above its reference level, m, from the run's gauges.csv.
Series gauge_series(const Run& run, const std::string& gauge);
/// The part of a series in a span of time, without what is not finite.
Series between(const Series& s, double from, double to);

struct Extreme {
  double value = std::numeric_limits<double>::quiet_NaN(), time = value;
};
Extreme extreme(const Series& s, bool highest);

}  // namespace lgiw::validation
