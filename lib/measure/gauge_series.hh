// Wave gauges: the surface at a place in plan against time, and what is read off such a series.
#pragma once

#include <string>
#include <vector>

#include "case/case.hh"
#include "files/run_file.hh"
#include "measure/norms.hh"

namespace lgiw {

enum class GaugeSurface { water, soil };

struct GaugeSeries {
  Gauge gauge;  // coordinates in the case's CRS
  GaugeSurface surface = GaugeSurface::water;
  bool initially_dry = false;     // a water gauge on land
  double bed = 0;                 // elevation
  double reference = 0;           // what heights are measured from: still water level; on soil its surface at the
                                  // start, or the bed where there was none
  std::vector<double> time;       // s
  std::vector<double> elevation;  // of the surface in the case's vertical datum, m; NaN where dry
};

/// Follows gauges through a run's surfaces. A gauge that at the first time is dry and on soil follows the soil surface
/// (S1 and S2 of the reference paper), all others the water.
class GaugeRecorder {
 public:
  GaugeRecorder(const RunHeader& header, const std::vector<Gauge>& gauges);
  /// The next surfaces, [ny,nx] local; empty where the scene has none of that phase.
  void add(double time, const std::vector<float>& water, const std::vector<float>& soil);
  const std::vector<GaugeSeries>& series() const { return series_; }

 private:
  const RunHeader& header_;
  std::vector<GaugeSeries> series_;
};

struct GaugePeaks {
  /// Height above the reference; NaN when never wet. 0 in water that nothing has reached by the end, without a time.
  double max_elevation = 0, max_height = 0, time_of_max = 0;
  /// Water: lowest height in the first stretch below still level that goes deeper than the first threshold. Soil:
  /// lowest height of all. NaN where there is none. Nothing before the wave can be there counts.
  double first_trough = 0, time_of_trough = 0;
  /// gauge_arrival() for each threshold.
  std::vector<double> arrival;
};

/// The first time, not before `earliest` (earliest_arrival.hh), at which the surface differs from the reference, or the
/// water over dry land above it is deep, by more than `threshold`; linear between samples; NaN: never.
double gauge_arrival(const GaugeSeries& series, double threshold, double earliest);

/// A gauge's heights above its reference, of the samples from `earliest` on.
Series heights_of_wave(const GaugeSeries& series, double earliest);

GaugePeaks gauge_peaks(const GaugeSeries& series, const std::vector<double>& thresholds, double earliest = 0);

/// The arrival threshold of a case, with its default of a quarter of dp.
double arrival_threshold(const Case& c, double dp);

}  // namespace lgiw
