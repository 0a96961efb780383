// gauges: wave gauges, run-up and maps of a run.
#include <gdal_version.h>
#include <netcdf.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "base/error.hh"
#include "base/thread_waiting.hh"
#include "base/tool_main.hh"
#include "case/dotted_key.hh"
#include "files/csv_table.hh"
#include "files/domain.hh"
#include "gauge_netcdf.hh"
#include "measure/chosen_frames.hh"
#include "measure/comparison.hh"
#include "measure/earliest_arrival.hh"
#include "measure/gauge_series.hh"
#include "measure/section_runup.hh"
#include "measure/surface_sampling.hh"
#include "measure/tool_outputs.hh"
#include "snapshots.hh"
#include "wave_maps.hh"

namespace {

using namespace lgiw;
using nlohmann::ordered_json;

struct Options : MeasuringOptions {
  std::string peaks, runup, netcdf, maps, pressure;
  std::vector<std::string> gauges, snapshots;
  std::vector<double> thresholds;
  bool long_form = false, heights = false, compare_elevations = false;
};

/// What is measured in one pass over the surfaces of a run.
struct Measurements {
  std::vector<GaugeSeries> gauges;
  std::vector<GaugePeaks> peaks;
  std::vector<double> thresholds;  // the first is the case's
  std::vector<SectionRunup> sections;
  double still_water_level = no_value;  // case datum
  double runup = no_value;              // the largest over the sections
  double shore_runup = no_value;        // with --maps
  std::vector<ComparisonRow> comparison;
  std::vector<std::pair<std::string, Series>> pressures;  // of the pressure gauges, Pa
  double pressure_threshold = no_value;                   // Pa: the first threshold as a column of water
};

std::string library_versions() {
  std::string netcdf = nc_inq_libvers();
  netcdf.resize(std::min(netcdf.find(' '), netcdf.size()));
  return std::string("GDAL ") + GDAL_RELEASE_NAME + ", HDF5 " + hdf5_version() + ", netCDF " + netcdf;
}

/// "name,x,y", in 2-D also "name,x".
Gauge parsed_gauge(const std::string& text, int dimension) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  const auto number = [&](const std::string& word) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    LGIW_VALIDATE(!word.empty() && *end == '\0' && std::isfinite(value), "--gauge " + text + " is not a gauge",
                  "'" + word + "' is no number", "write --gauge name,x,y");
    return value;
  };
  const bool complete = parts.size() == 3 || (dimension == 2 && parts.size() == 2);
  LGIW_VALIDATE(complete && !parts[0].empty(), "--gauge " + text + " is not a gauge",
                "it has a name and a place in plan", "write --gauge name,x,y");
  return {parts[0], number(parts[1]), parts.size() == 3 ? number(parts[2]) : 0};
}

std::vector<Gauge> chosen_gauges(const Options& options, const Case& c, const ParticleHeader& header) {
  std::vector<Gauge> gauges;
  if (options.gauges.empty()) {
    for (const Gauge& gauge : c.gauges)
      if (gauge.quantity == GaugeQuantity::surface) gauges.push_back(gauge);
    return gauges;
  }
  std::set<std::string> names;
  for (const std::string& text : options.gauges) {
    gauges.push_back(parsed_gauge(text, header.dimension));
    LGIW_VALIDATE(names.insert(gauges.back().name).second, "two gauges are named " + gauges.back().name,
                  "a name is a column of the table", "give each a name of its own");
  }
  check_inside(header, gauges, {});
  return gauges;
}

std::string surface_name(const GaugeSeries& series) { return series.surface == GaugeSurface::soil ? "soil" : "water"; }

CsvTable series_table(const std::vector<GaugeSeries>& gauges, const std::vector<double>& times, bool heights) {
  std::vector<std::string> header{"time_s"};
  for (const GaugeSeries& s : gauges) header.push_back(s.gauge.name);
  CsvTable table(header);
  for (std::size_t k = 0; k < times.size(); ++k) {
    table.add(times[k]);
    for (const GaugeSeries& s : gauges) table.add(s.elevation[k] - (heights ? s.reference : 0));
  }
  return table;
}

CsvTable long_table(const std::vector<GaugeSeries>& gauges) {
  CsvTable table({"time_s", "gauge", "surface", "elevation_m", "height_m"});
  for (const GaugeSeries& s : gauges)
    for (std::size_t k = 0; k < s.time.size(); ++k)
      table.add(s.time[k], s.gauge.name, surface_name(s), s.elevation[k], s.elevation[k] - s.reference);
  return table;
}

std::string threshold_name(double threshold) {
  char text[60];
  std::snprintf(text, sizeof text, "arrival_%gm_s", threshold);
  return text;
}

CsvTable peaks_table(const Measurements& m) {
  std::vector<std::string> header{
      "name",           "surface",         "x", "y", "max_elevation_m", "max_height_m", "time_of_max_s",
      "first_trough_m", "time_of_trough_s"};
  for (double threshold : m.thresholds) header.push_back(threshold_name(threshold));
  CsvTable table(header);
  for (std::size_t g = 0; g < m.gauges.size(); ++g) {
    const GaugeSeries& s = m.gauges[g];
    const GaugePeaks& p = m.peaks[g];
    table.add(s.gauge.name, surface_name(s), s.gauge.x, s.gauge.y, p.max_elevation, p.max_height, p.time_of_max,
              p.first_trough, p.time_of_trough);
    for (double arrival : p.arrival) table.add(arrival);
  }
  return table;
}

CsvTable runup_table(const std::vector<SectionRunup>& sections, const std::vector<double>& times,
                     double still_water_level) {
  std::vector<std::string> header{"time_s"};
  for (const SectionRunup& s : sections) {
    header.push_back(s.name + "_elevation_m");
    header.push_back(s.name + "_height_m");
  }
  CsvTable table(header);
  for (std::size_t k = 0; k < times.size(); ++k) {
    table.add(times[k]);
    for (const SectionRunup& s : sections) table.add(s.elevation[k], s.elevation[k] - still_water_level);
  }
  return table;
}

/// What a sensitivity study of the case starts from. Angles in degrees; what the scene lacks is absent.
ordered_json parameters_json(const Case& c, const ParticleHeader& particles, double deepest) {
  ordered_json parameters{{"particle_spacing_m", particles.dp}};
  if (particles.counts.soil > 0) {
    parameters["friction_angle_deg"] = c.soil.friction_angle;
    if (c.soil.bed == WallFriction::coulomb) parameters["bed_friction_angle_deg"] = c.soil.bed_friction_angle;
  }
  if (particles.counts.water > 0) {
    parameters["still_water_level_m"] = particles.still_water_level + particles.origin[2];
    parameters["still_water_depth_m"] = deepest;
    parameters["water_fills_to_level"] = c.water.bodies.empty();
  }
  return parameters;
}

/// Greatest depth of the water at rest, m; NaN without any.
double deepest_water(const RunHeader& header, const std::vector<float>& water) {
  const ParticleHeader& p = header.particles;
  if (ground_of(p).empty()) return no_value;
  const std::vector<double> ground = at_nodes(header.map, ground_of(p));
  double depth = no_value;
  for (std::size_t n = 0; n < water.size(); ++n)
    if (!std::isnan(water[n]) && !(p.still_water_level - ground[n] <= depth)) depth = p.still_water_level - ground[n];
  return depth;
}

ordered_json summary_json(const Measurements& m, const ordered_json& parameters) {
  ordered_json summary;
  summary["gauges"] = ordered_json::array();
  for (std::size_t g = 0; g < m.gauges.size(); ++g) {
    const GaugeSeries& s = m.gauges[g];
    const GaugePeaks& p = m.peaks[g];
    ordered_json gauge{{"name", s.gauge.name},
                       {"x", s.gauge.x},
                       {"y", s.gauge.y},
                       {"surface", surface_name(s)},
                       {"max_elevation_m", p.max_elevation},
                       {"max_height_m", p.max_height},
                       {"time_of_max_s", p.time_of_max},
                       {"first_trough_m", p.first_trough},
                       {"time_of_trough_s", p.time_of_trough},
                       {"arrival_s", p.arrival.front()}};
    for (std::size_t t = 1; t < m.thresholds.size(); ++t) gauge[threshold_name(m.thresholds[t])] = p.arrival[t];
    summary["gauges"].push_back(std::move(gauge));
  }
  summary["still_water_level_m"] = m.still_water_level;
  if (!m.pressures.empty()) summary["pressure_gauges"] = ordered_json::array();
  for (const auto& [name, series] : m.pressures) {
    const Extreme highest = features_of(series, m.pressure_threshold).highest;
    summary["pressure_gauges"].push_back(
        {{"name", name}, {"max_pressure_pa", highest.value}, {"time_of_max_s", highest.time}});
  }
  summary["runup_m"] = m.runup;
  summary["sections"] = ordered_json::array();
  for (const SectionRunup& s : m.sections)
    summary["sections"].push_back({{"name", s.name},
                                   {"runup_m", s.max_height},
                                   {"runup_elevation_m", s.max_elevation},
                                   {"time_of_runup_s", s.time_of_max},
                                   {"overtopped", !std::isnan(s.overtopped)}});
  if (!std::isnan(m.shore_runup)) summary["shore_runup_m"] = m.shore_runup;
  summary["parameters"] = parameters;
  if (!m.comparison.empty()) summary["comparison"] = comparison_json(m.comparison);
  return summary;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text.empty() ? "none" : text;
}

CsvTable pressure_table(const std::vector<std::pair<std::string, Series>>& pressures) {
  std::vector<std::string> header{"time_s"};
  for (const auto& [name, series] : pressures) header.push_back(name);
  CsvTable table(header);
  for (std::size_t k = 0; k < pressures.front().second.time.size(); ++k) {
    table.add(pressures.front().second.time[k]);
    for (const auto& [name, series] : pressures) table.add(series.value[k]);
  }
  return table;
}

/// The references of --compare; refuses what the run has nothing to set against.
std::vector<SeriesReference> chosen_references(const Options& options, const std::vector<GaugeSeries>& gauges,
                                               const std::vector<Section>& sections, const RunReader& run) {
  const std::vector<double>& times = run.surface_times();
  std::vector<std::string> gauge_names, section_names;
  for (const GaugeSeries& s : gauges) gauge_names.push_back(s.gauge.name);
  for (const std::string& name : run.header().pressure_gauges) {
    LGIW_VALIDATE(
        options.compare.empty() || std::find(gauge_names.begin(), gauge_names.end(), name) == gauge_names.end(),
        "two gauges are named " + name, "one of them measures pressure", "give the other another name");
    gauge_names.push_back(name);
  }
  for (const Section& s : sections) section_names.push_back(s.name);
  const auto has = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  std::vector<SeriesReference> references;
  std::set<std::string> seen;
  for (const std::string& file : options.compare) {
    references.push_back(series_reference(read_csv(file)));
    const SeriesReference& reference = references.back();
    std::vector<std::string> unknown;
    for (const auto& [name, series] : reference.series) {
      const bool gauge = has(gauge_names, name), section = has(section_names, name);
      if (!gauge && !section) unknown.push_back(name);
      LGIW_VALIDATE(!gauge || !section, reference.file + ": " + name + " is both a gauge and a section",
                    "it is not plain which of them was measured", "rename one of them in the case");
      LGIW_VALIDATE(seen.insert(name).second, reference.file + ": " + name + " has a reference already",
                    "each gauge and section has one", "leave one of them out");
    }
    LGIW_VALIDATE(unknown.empty(), reference.file + ": the run has no gauge or section " + joined(unknown),
                  "its gauges are " + joined(gauge_names) + " and its sections " + joined(section_names),
                  "name the columns as the case does");
    for (const auto& [name, series] : reference.series) {
      std::ostringstream spans;
      spans << "it is from " << series.time.front() << " s to " << series.time.back() << " s, the run's surfaces from "
            << times.front() << " s to " << times.back() << " s";
      LGIW_VALIDATE(series.time.front() < times.back() && series.time.back() > times.front(),
                    reference.file + ": " + name + " shares no time with the run", spans.str(),
                    "give times since the start of the run, in s");
    }
  }
  return references;
}

/// Surfaces as heights above their reference level, m; pressures in Pa.
std::vector<ComparisonRow> compare_with(const std::vector<SeriesReference>& references, const Measurements& m,
                                        bool elevations) {
  std::vector<ComparisonRow> rows;
  std::vector<double> runups, reference_runups;
  const auto append = [&](const std::vector<ComparisonRow>& more) {
    rows.insert(rows.end(), more.begin(), more.end());
  };
  const auto compare = [&](const std::string& name, Series run, Series reference, double level) {
    for (double& z : run.value) z -= level;
    if (elevations)
      for (double& z : reference.value) z -= level;
    const SeriesNorms norms = compare_series(run, reference, m.thresholds.front());
    append(series_rows(name, "m", norms));
    return norms;
  };
  for (const SeriesReference& file : references)
    for (const auto& [name, reference] : file.series) {
      for (const GaugeSeries& s : m.gauges)
        if (s.gauge.name == name) compare(name, {s.time, s.elevation}, reference, s.reference);
      for (const auto& [gauge, pressure] : m.pressures)
        if (gauge == name) append(series_rows(name, "Pa", compare_series(pressure, reference, m.pressure_threshold)));
      for (const SectionRunup& s : m.sections) {
        if (s.name != name) continue;
        const SeriesNorms norms = compare(name, {s.time, s.elevation}, reference, m.still_water_level);
        runups.push_back(norms.run.highest.value), reference_runups.push_back(norms.reference.highest.value);
      }
    }
  // Of one ratio there is nothing to take a mean of.
  if (runups.size() > 1) append(aida_rows(aida_numbers(runups, reference_runups)));
  return rows;
}

int run(const Options& options, const std::string& command) {
  RunReader run(options.run);
  const RunHeader& header = run.header();
  const ParticleHeader& particles = header.particles;
  const Case c = case_of_run(header, options.run, options.case_file);
  const bool flat = particles.dimension == 2, has_water = run.has_water_surface();
  LGIW_VALIDATE(!run.surface_times().empty(), options.run + " holds no surfaces", "the run has not got that far",
                "wait for lgiw-run to write some");
  LGIW_VALIDATE(options.maps.empty() || !flat, "--maps is for 3-D runs", options.run + " is 2-D",
                "leave it out; --runup has the run-up");
  LGIW_VALIDATE((options.maps.empty() && options.runup.empty()) || has_water, options.run + " has no water",
                "there is no run-up and no wave to map", "leave out --maps and --runup");
  LGIW_VALIDATE(options.runup.empty() || !c.sections.empty(), "there is no section",
                "run-up is followed along sections, from the slide to the opposite bank",
                "add sections to the case and pass it with --case");
  LGIW_VALIDATE(options.pressure.empty() || !header.pressure_gauges.empty(), options.run + " has no pressure gauges",
                "they are recorded while the case runs", "give gauges of the case quantity: pressure and run it again");
  LGIW_VALIDATE(options.snapshots.empty() || run.frame_count() > 0, options.run + " holds no frames",
                "the run has not got that far", "wait for lgiw-run to write some");
  const std::vector<std::size_t> snapshots = chosen_frames("--snapshots", options.snapshots, run);
  for (double threshold : options.thresholds)
    LGIW_VALIDATE(std::isfinite(threshold) && threshold > 0, "--thresholds has " + std::to_string(threshold),
                  "a threshold is a change of the surface in m", "give numbers above 0");
  LGIW_VALIDATE(
      std::set<double>(options.thresholds.begin(), options.thresholds.end()).size() == options.thresholds.size(),
      "--thresholds names one twice", "each is a column of the table", "name each once");

  Measurements m;
  m.still_water_level = particles.still_water_level + particles.origin[2];
  m.thresholds = {arrival_threshold(c, particles.dp)};
  m.pressure_threshold = c.water.density * std::abs(c.gravity[2]) * m.thresholds.front();
  for (double threshold : options.thresholds)
    if (threshold != m.thresholds.front()) m.thresholds.push_back(threshold);
  GaugeRecorder gauges(header, chosen_gauges(options, c, particles));

  const std::vector<SeriesReference> references =
      chosen_references(options, gauges.series(), has_water ? c.sections : std::vector<Section>{}, run);

  std::vector<std::string> outputs{options.peaks, options.runup, options.netcdf, options.summary, options.pressure};
  const bool other_outputs = options.common.json || !options.maps.empty() ||
                             std::any_of(outputs.begin(), outputs.end(), [](const auto& o) { return !o.empty(); });
  const bool stdout_used =
      options.common.json || !options.compare.empty() || (other_outputs && gauges.series().empty());
  const std::string output = !options.output.empty() ? options.output : stdout_used ? "" : "-";
  const bool only_pressure = !header.pressure_gauges.empty();
  LGIW_VALIDATE(!gauges.series().empty() || (output.empty() && options.peaks.empty() && options.netcdf.empty()),
                "there is no gauge", only_pressure ? "the case has pressure gauges only" : "the case names none",
                only_pressure ? "write those with --pressure FILE, or pass --gauge name,x,y"
                              : "add gauges to the case or pass --gauge name,x,y");
  outputs.insert(outputs.begin(), {output, options.comparison_output()});
  std::vector<std::string> inputs{options.run, options.case_file};
  inputs.insert(inputs.end(), options.compare.begin(), options.compare.end());
  ToolOutputs results("gauges", command, options.common, inputs);
  if (!options.maps.empty()) {
    make_folder(options.maps);
    for (const auto& files :
         {wave_map_files(options.maps, options.thresholds), snapshot_files(options.maps, run, snapshots)})
      outputs.insert(outputs.end(), files.begin(), files.end());
  }
  results.check(outputs);
  results.hash_inputs();

  const std::vector<double> earliest = earliest_arrival(run, c);
  RunupRecorder runup(header, has_water ? c.sections : std::vector<Section>{}, earliest);
  HighestSurface highest(header, earliest);
  std::vector<double> mapped{m.thresholds.front()};
  mapped.insert(mapped.end(), options.thresholds.begin(), options.thresholds.end());
  ArrivalMap arrivals(header, options.maps.empty() ? std::vector<double>{} : mapped, earliest);
  std::vector<float> first_water;
  {
    Progress progress(options.common.show_progress(), "gauges");
    const std::vector<double>& times = run.surface_times();
    for (std::size_t k = 0; k < times.size(); ++k) {
      const std::vector<float> water = has_water ? run.water_surface(k) : std::vector<float>{};
      gauges.add(times[k], water, run.has_soil_surface() ? run.soil_surface(k) : std::vector<float>{});
      if (has_water) runup.add(times[k], water), arrivals.add(times[k], water);
      if (!options.maps.empty()) highest.add(times[k], water);
      if (k == 0) first_water = water;
      progress.update(double(k + 1) / double(times.size()));
    }
  }
  m.gauges = gauges.series();
  for (const GaugeSeries& s : m.gauges)
    m.peaks.push_back(gauge_peaks(
        s, m.thresholds,
        earliest_near(header.map, earliest, s.gauge.x - particles.origin[0], s.gauge.y - particles.origin[1])));
  m.sections = runup.sections();
  for (const SectionRunup& s : m.sections) {
    if (!std::isnan(s.max_height) && !(s.max_height <= m.runup)) m.runup = s.max_height;
    if (!s.has_bank && !options.common.quiet)
      std::cerr << "gauges: section " << s.name
                << " has no opposite bank (it does not run from the lake to dry land above "
                << "its level) let it end there\n";
    if (!std::isnan(s.overtopped) && !options.common.quiet)
      std::cerr << "gauges: water passes the end of section " << s.name << " (from " << number_text(s.overtopped, 4)
                << " s on: its run-up is a lower bound) let it end higher\n";
  }

  for (std::size_t g = 0; g < header.pressure_gauges.size(); ++g) {
    const std::vector<float> pressure = run.pressure(g);
    m.pressures.push_back({header.pressure_gauges[g], {run.surface_times(), {pressure.begin(), pressure.end()}}});
  }
  m.comparison = compare_with(references, m, options.compare_elevations);

  results.write(
      output, options.long_form ? long_table(m.gauges) : series_table(m.gauges, run.surface_times(), options.heights));
  results.write(options.peaks, peaks_table(m));
  results.write(options.runup, runup_table(m.sections, run.surface_times(), m.still_water_level));
  if (!options.pressure.empty()) results.write(options.pressure, pressure_table(m.pressures));
  if (!options.compare.empty()) results.write(options.comparison_output(), comparison_table(m.comparison));
  const Provenance& provenance = results.provenance();
  if (!options.netcdf.empty())
    write_gauge_netcdf(options.netcdf, particles, m.gauges, c.name, provenance.enabled ? provenance.to_json() : "",
                       options.common.overwrite);
  if (!options.maps.empty())
    m.shore_runup = write_wave_maps(options.maps, run, highest, arrivals, m.gauges, m.peaks, options.common.overwrite);
  write_snapshots(options.maps, run, snapshots, options.common.overwrite);
  results.summarise(options.summary,
                    summary_json(m, parameters_json(c, particles, deepest_water(header, first_water))));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  wait_briefly(argv);
  Options options;
  CLI::App app(
      "Wave gauges, run-up and wave maps of a run. Elevations are in the case's vertical datum, heights above its "
      "still\n"
      "water level; a gauge that starts on soil follows the soil surface, its heights are changes since the start.\n"
      "What a surface does before anything can have come from the slide counts in no peak, arrival, run-up or map.",
      "gauges");
  add_measuring_options(
      app, options, "gauges, sections and the arrival threshold", "Gauges, run-up and comparison as JSON",
      "Measured series (CSV): time_s (or t_s) and a column of heights above still water level a gauge, or of run-up a "
      "section, named as in the case; on soil changes since the start; of a pressure gauge Pa. May be repeated");
  app.add_flag("--compare-elevations", options.compare_elevations,
               "The measured series are elevations in the case's vertical datum")
      ->needs("--compare")
      ->group("Comparison with measurements");
  const std::string measured = "What is measured";
  app.add_option("--gauge", options.gauges, "A gauge instead of the case's ones; may be repeated")
      ->type_name("NAME,X,Y")
      ->allow_extra_args(false)
      ->group(measured);
  app.add_option("--thresholds", options.thresholds,
                 "More thresholds (m) for arrival times than the case's arrival_threshold, e.g. 0.5,1,3")
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->group(measured);
  const std::string outputs = "Outputs";
  app.add_option(
         "-o,--output", options.output,
         "Table of the surface at the gauges against time (CSV); stdout without -o (but for a comparison) or with -")
      ->type_name("FILE")
      ->group(outputs);
  auto* long_form = app.add_flag("--long", options.long_form,
                                 "Table with a row a gauge and time: time_s,gauge,surface,elevation_m,height_m");
  long_form->group(outputs);
  app.add_flag("--heights", options.heights, "Heights instead of elevations in the table")
      ->excludes(long_form)
      ->group(outputs);
  app.add_option("--peaks", options.peaks, "Table of highest surface, first trough and arrivals by gauge (CSV)")
      ->type_name("FILE")
      ->group(outputs);
  app.add_option("--runup", options.runup, "Table of the run-up on the opposite bank by section against time (CSV)")
      ->type_name("FILE")
      ->group(outputs);
  app.add_option("--pressure", options.pressure,
                 "Table of the pressure at the case's pressure gauges against time (CSV, Pa)")
      ->type_name("FILE")
      ->group(outputs);
  app.add_option("--netcdf", options.netcdf, "The series as CF timeSeries netCDF")->type_name("FILE")->group(outputs);
  app.add_option("--maps", options.maps,
                 "Folder for GeoTIFFs of the maxima and wave.gpkg with shoreline, run-up along it and inundation")
      ->type_name("FOLDER")
      ->group(outputs);
  app.add_option(
         "--snapshots", options.snapshots,
         "Times of maps of the wave and the slide's speed, in the folder of --maps: first, last or seconds (the "
         "nearest frame)")
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->needs("--maps")
      ->group(outputs);
  add_common_options(app, options.common, library_versions());
  app.footer(
      "Examples:\n  $ gauges run.h5 -o gauges.csv --peaks peaks.csv --runup runup.csv --maps maps --thresholds 0.5,1\n"
      "  $ gauges run.h5 --gauge P1,389450,3794050 --heights\n"
      "  $ gauges run.h5 --compare measured.csv --compare-output comparison.csv");
  const std::string command = command_line(argc, argv);
  return tool_main(app, argc, argv, [&] { return run(options, command); });
}
