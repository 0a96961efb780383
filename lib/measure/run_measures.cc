#include "measure/run_measures.hh"

#include "base/error.hh"
#include "measure/earliest_arrival.hh"
#include "measure/gauge_series.hh"
#include "measure/section_runup.hh"
#include "measure/slide_history.hh"

namespace lgiw {

std::vector<Measure> run_measures(const RunReader& run, const Case& c) {
  LGIW_EXPECT(!run.surface_times().empty());
  const RunHeader& header = run.header();
  std::vector<Measure> measures;
  if (run.has_water_surface()) {
    std::vector<Gauge> wave_gauges;
    for (const Gauge& gauge : c.gauges)
      if (gauge.quantity == GaugeQuantity::surface) wave_gauges.push_back(gauge);
    const std::vector<double> earliest = earliest_arrival(run, c);
    GaugeRecorder gauges(header, wave_gauges);
    RunupRecorder runup(header, c.sections, earliest);
    for (std::size_t k = 0; k < run.surface_times().size(); ++k) {
      const std::vector<float> water = run.water_surface(k);
      const double time = run.surface_times()[k];
      gauges.add(time, water, run.has_soil_surface() ? run.soil_surface(k) : std::vector<float>{});
      runup.add(time, water);
    }
    for (const GaugeSeries& s : gauges.series()) {
      if (s.surface != GaugeSurface::water) continue;
      const auto& origin = header.particles.origin;
      const double first = earliest_near(header.map, earliest, s.gauge.x - origin[0], s.gauge.y - origin[1]);
      const GaugePeaks peaks = gauge_peaks(s, {arrival_threshold(c, header.particles.dp)}, first);
      measures.push_back({s.gauge.name, "max_height_m", "m", peaks.max_height});
      measures.push_back({s.gauge.name, "time_of_max_s", "s", peaks.time_of_max});
    }
    for (const SectionRunup& s : runup.sections())
      if (s.has_bank) measures.push_back({s.name, "runup_m", "m", s.max_height});
  }
  if (header.particles.counts.soil > 0) {
    const Frame last = run.frame(run.frame_count() - 1);
    const SlideHistory history(header, last, c.deposit.adps_threshold);
    const SlideState state = history.state(last);
    const SlideDeposit deposit = history.deposit();
    measures.push_back({"slide", "slide_volume_m3", "m3", state.slide_volume});
    if (run.has_water_surface()) measures.push_back({"slide", "immersed_volume_m3", "m3", state.immersed_volume});
    measures.push_back({"deposit", "runout_of_centre_m", "m", deposit.runout});
    measures.push_back({"deposit", "runout_of_front_m", "m", deposit.front_runout});
    if (header.particles.dimension == 2) measures.push_back({"deposit", "front_x_m", "m", deposit.front_x});
  }
  return measures;
}

}  // namespace lgiw
