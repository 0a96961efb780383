#include "measure/gauge_series.hh"

#include <algorithm>
#include <cmath>

#include "base/error.hh"
#include "measure/surface_sampling.hh"

namespace lgiw {

GaugeRecorder::GaugeRecorder(const RunHeader& header, const std::vector<Gauge>& gauges) : header_(header) {
  for (const Gauge& gauge : gauges) {
    GaugeSeries series;
    series.gauge = gauge;
    const auto& origin = header.particles.origin;
    series.bed = header.particles.bed.empty()
                     ? no_value
                     : header.particles.bed.height(gauge.x - origin[0], gauge.y - origin[1]) + origin[2];
    series_.push_back(std::move(series));
  }
}

void GaugeRecorder::add(double time, const std::vector<float>& water, const std::vector<float>& soil) {
  const auto& origin = header_.particles.origin;
  for (GaugeSeries& series : series_) {
    const double x = series.gauge.x - origin[0], y = series.gauge.y - origin[1];
    const auto sample = [&](const std::vector<float>& values) {
      return values.empty() ? no_value : sample_surface(header_.map, values, x, y) + origin[2];
    };
    if (series.time.empty()) {
      series.initially_dry = std::isnan(sample(water));
      const double soil_surface = sample(soil);
      const bool on_soil = series.initially_dry && (water.empty() || !std::isnan(soil_surface));
      series.surface = on_soil ? GaugeSurface::soil : GaugeSurface::water;
      const double before = std::isnan(soil_surface) ? series.bed : soil_surface;
      series.reference = on_soil ? before : header_.particles.still_water_level + origin[2];
    }
    series.time.push_back(time);
    series.elevation.push_back(sample(series.surface == GaugeSurface::soil ? soil : water));
  }
}

double gauge_arrival(const GaugeSeries& series, double threshold, double earliest) {
  if (series.time.empty() || !(earliest <= series.time.back())) return no_value;
  Series change{series.time, series.elevation};
  const bool on_land = series.surface == GaugeSurface::water && series.initially_dry;
  for (double& z : change.value) z -= on_land ? std::max(series.bed, series.reference) : series.reference;
  return arrival_time(part_of(change, std::max(earliest, series.time.front()), series.time.back()), threshold);
}

Series heights_of_wave(const GaugeSeries& series, double earliest) {
  Series heights;
  for (std::size_t k = 0; k < series.time.size(); ++k) {
    if (series.time[k] < earliest) continue;
    heights.time.push_back(series.time[k]);
    heights.value.push_back(series.elevation[k] - series.reference);
  }
  return heights;
}

GaugePeaks gauge_peaks(const GaugeSeries& series, const std::vector<double>& thresholds, double earliest) {
  GaugePeaks peaks{no_value, no_value, no_value, no_value, no_value, {}};
  for (std::size_t k = 0; k < series.time.size(); ++k)
    if (series.time[k] >= earliest && !std::isnan(series.elevation[k]) &&
        !(series.elevation[k] <= peaks.max_elevation)) {
      peaks.max_elevation = series.elevation[k];
      peaks.max_height = series.elevation[k] - series.reference;
      peaks.time_of_max = series.time[k];
    }
  // The water is at rest until something comes.
  const bool at_rest = series.surface == GaugeSurface::water && !series.initially_dry && !series.time.empty();
  if (at_rest && !(earliest <= series.time.back())) peaks.max_elevation = series.reference, peaks.max_height = 0;
  const Series heights = heights_of_wave(series, earliest);

  const bool water = series.surface == GaugeSurface::water;
  for (double threshold : thresholds) peaks.arrival.push_back(gauge_arrival(series, threshold, earliest));
  const double depth = water && !thresholds.empty() ? thresholds.front() : 0;
  const Extreme trough = water ? first_trough(heights, depth) : features_of(heights, depth).lowest;
  if (trough.value < 0) peaks.first_trough = trough.value, peaks.time_of_trough = trough.time;
  return peaks;
}

double arrival_threshold(const Case& c, double dp) {
  return c.output.arrival_threshold > 0 ? c.output.arrival_threshold : dp / 4;
}

}  // namespace lgiw
