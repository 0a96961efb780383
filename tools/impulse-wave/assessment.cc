#include "assessment.hh"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "case/dotted_key.hh"
#include "files/domain.hh"
#include "measure/earliest_arrival.hh"
#include "measure/gauge_series.hh"
#include "measure/norms.hh"
#include "measure/section_runup.hh"

namespace lgiw {
namespace {

struct Polar {
  double distance, angle;
};

/// A place in the case's CRS as seen from the water's edge before the slide.
Polar seen_from(const Assessment& a, double x, double y) {
  const SlideEntry& entry = *a.entry;
  const double dx = x - a.water.x, dy = a.channel ? 0 : y - a.water.y;
  const double along = dx * entry.ahead[0] + dy * entry.ahead[1], aside = dy * entry.ahead[0] - dx * entry.ahead[1];
  return {std::hypot(along, aside), std::abs(std::atan2(aside, along)) * 180 / std::numbers::pi};
}

/// Heights above still water level, and of them the first crest, the trough behind it and the crest behind that.
struct MeasuredWave {
  Extreme crest, trough, second_crest, highest;
};
MeasuredWave measured_wave(const GaugeSeries& s, double threshold, double earliest) {
  const Series heights = heights_of_wave(s, earliest);
  const SeriesFeatures features = features_of(heights, threshold);
  MeasuredWave wave{features.crest, {no_value, no_value}, {no_value, no_value}, features.highest};
  if (std::isnan(wave.crest.time)) return wave;
  wave.trough = first_trough(part_of(heights, wave.crest.time, s.time.back()), threshold);
  if (!std::isnan(wave.trough.time))
    wave.second_crest = first_crest(part_of(heights, wave.trough.time, s.time.back()), threshold);
  return wave;
}

void add_gauges(Assessment& a, const RunReader& run, const Case& c, const GaugeRecorder& gauges,
                const std::vector<double>& earliest) {
  const double threshold = arrival_threshold(c, run.header().particles.dp);
  const auto& origin = run.header().particles.origin;
  for (const GaugeSeries& s : gauges.series()) {
    if (s.surface != GaugeSurface::water || s.initially_dry) continue;
    const Polar seen = seen_from(a, s.gauge.x, s.gauge.y);
    Place place = wave_place(a, "gauge", s.gauge.name, seen.distance, seen.angle, a.entry->start);
    place.x = s.gauge.x, place.y = s.gauge.y;
    const double first = earliest_near(run.header().map, earliest, s.gauge.x - origin[0], s.gauge.y - origin[1]);
    const MeasuredWave wave = measured_wave(s, threshold, first);
    place.largest_crest = wave.highest.value, place.time_of_largest = wave.highest.time;
    place.arrival = gauge_arrival(s, threshold, first);
    const std::map<std::string, double> simulated{{"first_crest_m", wave.crest.value},
                                                  {"first_trough_m", -wave.trough.value},
                                                  {"second_crest_m", wave.second_crest.value},
                                                  {"wave_height_m", wave.crest.value - wave.trough.value},
                                                  {"first_crest_time_s", wave.crest.time}};
    for (PlaceEstimate& e : place.estimates)
      if (const auto found = simulated.find(e.quantity); found != simulated.end()) e.simulated = found->second;
    if (wave.crest.time == s.time.back())
      a.notes.push_back("at gauge " + place.name + " the first crest is still rising at the end of the run");
    if (place.estimates.empty())
      a.notes.push_back("gauge " + place.name + " lies behind the slide, where no formula holds");
    a.places.push_back(std::move(place));
  }
}

/// From the impact along the slide's axis to the edge of the domain.
Section axis_section(const SlideEntry& entry, const RunHeader& header) {
  const ParticleHeader& p = header.particles;
  double length = 0;
  const double step = header.map.dx;
  while (inside_domain(p, entry.x + (length + step) * entry.ahead[0], entry.y + (length + step) * entry.ahead[1]))
    length += step;
  Section section{"axis", {{entry.x, entry.y}}};
  if (length > 0) section.points.push_back({entry.x + length * entry.ahead[0], entry.y + length * entry.ahead[1]});
  return section;
}

void add_banks(Assessment& a, const RunReader& run, const std::vector<Section>& sections, const RunupRecorder& runup,
               const std::vector<float>& first_water) {
  const auto& origin = run.header().particles.origin;
  for (std::size_t k = 0; k < sections.size(); ++k) {
    const Bank bank = opposite_bank(run.header(), sections[k], first_water);
    if (!bank.present || !runup.sections()[k].has_bank) continue;
    const double x = bank.x + origin[0], y = bank.y + origin[1];
    const Polar seen = seen_from(a, x, y);
    Place place = bank_place(a, sections[k].name, seen.distance, seen.angle, bank.slope, bank.depth);
    place.x = x, place.y = y;
    for (PlaceEstimate& e : place.estimates) e.simulated = runup.sections()[k].max_height;
    a.places.push_back(std::move(place));
  }
}

}  // namespace

Place impact_place(const Assessment& a) {
  Place place;
  place.kind = "impact";
  if (a.channel) {
    // Just before x_M: the largest wave, whose distance has no limit.
    place.distance = vaw254_peak_distance(a.impact);
    const ChannelWave wave = vaw254_channel(a.impact, 0, a.per_metre);
    place.estimates = {{"first_crest_m", formulas::vaw254_channel, wave.crest, no_value, wave.broken},
                       {"wave_height_m", formulas::vaw254_channel, wave.height, no_value, wave.broken}};
    const Estimate fritz = fritz_crest(a.impact);
    place.estimates.push_back({"first_crest_m", formulas::fritz, fritz.value, no_value, fritz.broken});
  } else {
    place.distance = vaw254_impact_radius(a.impact, 0);
    const BasinWave wave = vaw254_impact(a.impact);
    place.estimates = {{"first_crest_m", formulas::vaw254_basin, wave.crest, no_value, wave.broken},
                       {"first_trough_m", formulas::vaw254_basin, wave.trough, no_value, wave.broken},
                       {"second_crest_m", formulas::vaw254_basin, wave.second_crest, no_value, wave.broken}};
  }
  return place;
}

Place wave_place(const Assessment& a, const std::string& kind, const std::string& name, double distance, double angle,
                 double start) {
  Place place;
  place.kind = kind, place.name = name, place.distance = distance, place.angle = angle;
  if (angle > 90) return place;
  const auto add = [&](const std::string& quantity, const Formula& formula, double value, const BrokenLimits& broken) {
    place.estimates.push_back({quantity, formula, value, no_value, broken});
  };
  if (a.channel) {
    const ChannelWave wave = vaw254_channel(a.impact, distance, a.per_metre);
    place.near = wave.near;
    add("first_crest_m", formulas::vaw254_channel, wave.crest, wave.broken);
    add("wave_height_m", formulas::vaw254_channel, wave.height, wave.broken);
    const Estimate height = huber_hager_channel_height(a.impact, distance);
    add("wave_height_m", formulas::huber_hager_channel, height.value, height.broken);
    add("first_crest_time_s", formulas::vaw254_channel, start + distance / wave.celerity, wave.broken);
    add("period_s", formulas::vaw254_channel, wave.period, wave.broken);
  } else {
    const BasinWave wave = vaw254_basin(a.impact, distance, angle);
    place.near = wave.near;
    add("first_crest_m", formulas::vaw254_basin, wave.crest, wave.broken);
    const Estimate crest = mohammed_fritz_crest(a.impact, distance, angle);
    add("first_crest_m", formulas::mohammed_fritz, crest.value, crest.broken);
    add("first_trough_m", formulas::vaw254_basin, wave.trough, wave.broken);
    add("second_crest_m", formulas::vaw254_basin, wave.second_crest, wave.broken);
    const Estimate height = huber_hager_basin_height(a.impact, distance, angle);
    add("wave_height_m", formulas::huber_hager_basin, height.value, height.broken);
    add("first_crest_time_s", formulas::vaw254_basin, start + distance / wave.celerity, wave.broken);
  }
  return place;
}

Place bank_place(const Assessment& a, const std::string& name, double distance, double angle, double slope,
                 double depth) {
  Place place;
  place.kind = "bank", place.name = name, place.distance = distance, place.angle = angle;
  place.bank_slope = slope, place.depth = depth;
  if (angle > 90) return place;
  BankWave wave{0, no_value, no_value, depth, slope};
  BrokenLimits limits;  // of the wave that arrives: its run-up is no better than it
  if (a.channel) {
    const ChannelWave arriving = vaw254_channel(a.impact, distance, a.per_metre);
    wave.crest = arriving.crest, wave.height = arriving.height, wave.length = arriving.period * arriving.celerity;
    place.near = arriving.near, limits = arriving.broken;
  } else {
    const BasinWave arriving = vaw254_basin(a.impact, distance, angle);
    wave.crest = arriving.crest, place.near = arriving.near, limits = arriving.broken;
  }
  const auto add = [&](const Formula& formula, const Estimate& runup) {
    BrokenLimits broken = limits;
    broken.insert(broken.end(), runup.broken.begin(), runup.broken.end());
    place.estimates.push_back({"runup_m", formula, runup.value, no_value, broken});
  };
  add(formulas::evers_boes, evers_boes_runup(wave));
  if (a.channel)
    add(formulas::mueller, mueller_runup(wave));  // wants a wave length, which the 3-D formulas do not give
  add(formulas::synolakis, synolakis_runup(wave));
  add(formulas::hall_watts, hall_watts_runup(wave));
  return place;
}

void add_run_places(Assessment& a, const RunReader& run, const Case& c) {
  const RunHeader& header = run.header();
  std::vector<Gauge> wave_gauges;
  for (const Gauge& gauge : c.gauges)
    if (gauge.quantity == GaugeQuantity::surface) wave_gauges.push_back(gauge);
  std::vector<Section> sections = c.sections;
  if (sections.empty()) sections.push_back(axis_section(*a.entry, header));
  if (sections.back().points.size() < 2) sections.pop_back();
  const std::vector<double> earliest = earliest_arrival(run, c);
  GaugeRecorder gauges(header, wave_gauges);
  RunupRecorder runup(header, sections, earliest);
  std::vector<float> first_water;
  for (std::size_t k = 0; k < run.surface_times().size(); ++k) {
    const std::vector<float> water = run.water_surface(k);
    const double time = run.surface_times()[k];
    gauges.add(time, water, run.has_soil_surface() ? run.soil_surface(k) : std::vector<float>{});
    runup.add(time, water);
    if (k == 0) first_water = water;
  }
  add_gauges(a, run, c, gauges, earliest);
  add_banks(a, run, sections, runup, first_water);
}

std::vector<std::string> limit_lines(const Assessment& a) {
  struct Outside {
    Formula formula;
    BrokenLimit limit;
    std::vector<std::string> places;
    std::size_t values = 1;
  };
  std::vector<Outside> outside;
  const auto add = [&](const Formula& formula, const BrokenLimit& limit, const std::string& place) {
    for (Outside& o : outside) {
      if (o.formula.source != formula.source || o.limit.quantity != limit.quantity) continue;
      if (o.limit.value == limit.value) return;
      // Differs from place to place: the first value stands for all.
      ++o.values;
      if (std::find(o.places.begin(), o.places.end(), place) == o.places.end()) o.places.push_back(place);
      return;
    }
    outside.push_back({formula, limit, {place}});
  };
  if (!std::isnan(a.koerner.value))
    for (const BrokenLimit& limit : a.koerner.broken) add(formulas::koerner, limit, "");
  for (const Place& place : a.places) {
    const std::string name = place.name.empty() ? number_text(place.distance, 4) + " m" : place.name;
    for (const PlaceEstimate& e : place.estimates)
      for (const BrokenLimit& limit : e.broken) {
        // Of a run-up the limits of the arriving wave have been told already.
        const bool arriving = place.kind == "bank" && limit.quantity != "a/h" && limit.quantity != "bank";
        add(arriving ? (a.channel ? formulas::vaw254_channel : formulas::vaw254_basin) : e.formula, limit, name);
      }
  }
  std::vector<std::string> lines;
  for (const Outside& o : outside) {
    std::string line =
        o.formula.name + " (" + o.formula.source + "): " + o.limit.quantity + " " + number_text(o.limit.value, 3);
    if (o.values > 1) {
      line += " at " + o.places.front() + " (and others at";
      for (std::size_t k = 1; k < o.places.size(); ++k) line += (k > 1 ? ", " : " ") + o.places[k];
      line += ")";
    }
    const bool low = std::isfinite(o.limit.low), high = std::isfinite(o.limit.high);
    line += low && high ? " is not from " + number_text(o.limit.low, 3) + " to " + number_text(o.limit.high, 3)
            : high      ? " is above " + number_text(o.limit.high, 3)
                        : " is below " + number_text(o.limit.low, 3);
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace lgiw
