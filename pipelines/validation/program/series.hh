// Series in time, of the run's gauges and of references.
#pragma once

#include <string>
#include <vector>

#include "measure/norms.hh"
#include "measures.hh"
#include "run.hh"

namespace lgiw::validation {

/// Height of a gauge above its reference level, m, from the run's gauges.csv.
Series gauge_series(const Run& run, const std::string& gauge);
/// The part of a series in a span of time, without what is not finite.
Series between(const Series& s, double from, double to);

/// Each value replaced by the median of those within half a `window` (s) of its time: splash that passes a gauge is
/// gone, waves that last longer than the window stay.
Series running_median(const Series& s, double window);

/// Highest or lowest value and its time, by the parabola through it and its neighbours; NaN of nothing.
Extreme extreme(const Series& s, bool highest);

/// Norms of the gauge `gauge` against the columns 1 and `column` of `file`, or a cosine of `amplitude` and `period`
/// that is at t = 0 at its lowest or highest as the gauge is; up to the time `to`.
SeriesNorms reference_norms(const Run& run, const Keys& keys);

}  // namespace lgiw::validation
