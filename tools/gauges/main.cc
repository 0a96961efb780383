// gauges: wave gauges, run-up and maps of a run.
#include <gdal_version.h>
#include <hdf5.h>
#include <netcdf.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "base/atomic_file.hh"
#include "base/error.hh"
#include "base/tool_main.hh"
#include "gauge_netcdf.hh"
#include "measure/csv_table.hh"
#include "measure/gauge_series.hh"
#include "measure/section_runup.hh"
#include "measure/surface_sampling.hh"
#include "measure/tool_outputs.hh"
#include "wave_maps.hh"

namespace {

using namespace lgiw;
using nlohmann::ordered_json;

const std::string hdf5_version =
    std::to_string(H5_VERS_MAJOR) + "." + std::to_string(H5_VERS_MINOR) + "." + std::to_string(H5_VERS_RELEASE);

struct Options {
  std::string run, case_file, output, peaks, runup, netcdf, maps, summary;
  std::vector<std::string> gauges;
  std::vector<double> thresholds;
  bool long_form = false, heights = false;
  CommonOptions common;
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
};

std::string library_versions() {
  std::string netcdf = nc_inq_libvers();
  netcdf = netcdf.substr(0, netcdf.find(' '));
  return std::string("GDAL ") + GDAL_RELEASE_NAME + ", HDF5 " + hdf5_version + ", netCDF " + netcdf;
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

ordered_json summary_json(const Measurements& m, const Provenance& provenance) {
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
  summary["runup_m"] = m.runup;
  summary["sections"] = ordered_json::array();
  for (const SectionRunup& s : m.sections)
    summary["sections"].push_back({{"name", s.name},
                                   {"runup_m", s.max_height},
                                   {"runup_elevation_m", s.max_elevation},
                                   {"time_of_runup_s", s.time_of_max}});
  if (!std::isnan(m.shore_runup)) summary["shore_runup_m"] = m.shore_runup;
  if (provenance.enabled) summary["provenance"]["gauges"] = ordered_json::parse(provenance.to_json());
  return summary;
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
  for (double threshold : options.thresholds)
    LGIW_VALIDATE(std::isfinite(threshold) && threshold > 0, "--thresholds has " + std::to_string(threshold),
                  "a threshold is a change of the surface in m", "give numbers above 0");
  LGIW_VALIDATE(
      std::set<double>(options.thresholds.begin(), options.thresholds.end()).size() == options.thresholds.size(),
      "--thresholds names one twice", "each is a column of the table", "name each once");

  Measurements m;
  m.still_water_level = particles.still_water_level + particles.origin[2];
  m.thresholds = {arrival_threshold(c, particles.dp)};
  for (double threshold : options.thresholds)
    if (threshold != m.thresholds.front()) m.thresholds.push_back(threshold);
  GaugeRecorder gauges(header, chosen_gauges(options, c, particles));

  std::vector<std::string> outputs{options.peaks, options.runup, options.netcdf, options.summary};
  const bool other_outputs = options.common.json || !options.maps.empty() ||
                             std::any_of(outputs.begin(), outputs.end(), [](const auto& o) { return !o.empty(); });
  const std::string output = !options.output.empty()                                             ? options.output
                             : options.common.json || (other_outputs && gauges.series().empty()) ? ""
                                                                                                 : "-";
  LGIW_VALIDATE(!gauges.series().empty() || (output.empty() && options.peaks.empty() && options.netcdf.empty()),
                "there is no gauge", "the case names none", "add gauges to the case or pass --gauge name,x,y");
  outputs.insert(outputs.begin(), output);
  std::vector<std::string> inputs{options.run};
  if (!options.case_file.empty() && options.case_file != "-") inputs.push_back(options.case_file);
  check_outputs(outputs, inputs, options.common.overwrite, options.common.json);
  if (!options.maps.empty()) {
    std::error_code error;
    std::filesystem::create_directories(options.maps, error);
    LGIW_VALIDATE(std::filesystem::is_directory(options.maps), options.maps + " cannot be made a folder",
                  error ? error.message() : "a file has that name", "name another folder");
    check_outputs(wave_map_files(options.maps, options.thresholds), inputs, options.common.overwrite, false);
  }

  Provenance provenance;
  provenance.enabled = options.common.provenance;
  provenance.tool = "gauges";
  provenance.version = version_string();
  provenance.command_line = command;
  for (const std::string& input : inputs) provenance.add_input(input);

  RunupRecorder runup(header, has_water ? c.sections : std::vector<Section>{});
  ArrivalMap arrivals(header, options.maps.empty() ? std::vector<double>{} : options.thresholds);
  std::vector<float> first_water;
  {
    Progress progress(options.common.show_progress(), "gauges");
    const std::vector<double>& times = run.surface_times();
    for (std::size_t k = 0; k < times.size(); ++k) {
      const std::vector<float> water = has_water ? run.water_surface(k) : std::vector<float>{};
      gauges.add(times[k], water, run.has_soil_surface() ? run.soil_surface(k) : std::vector<float>{});
      if (has_water) runup.add(times[k], water), arrivals.add(times[k], water);
      if (k == 0) first_water = water;
      progress.update(double(k + 1) / double(times.size()));
    }
  }
  m.gauges = gauges.series();
  for (const GaugeSeries& s : m.gauges) m.peaks.push_back(gauge_peaks(s, m.thresholds));
  m.sections = runup.sections();
  for (const SectionRunup& s : m.sections) {
    if (!std::isnan(s.max_height) && !(s.max_height <= m.runup)) m.runup = s.max_height;
    if (!s.has_bank && !options.common.quiet)
      std::cerr << "gauges: section " << s.name
                << " has no opposite bank (it does not run from the lake to dry land above "
                << "its level) let it end there\n";
  }

  const std::string comment = provenance.enabled ? "provenance: " + provenance.to_json() : "";
  const auto write = [&](const std::string& path, const CsvTable& table) {
    if (!path.empty()) write_text_file(path, table.text(comment), options.common.overwrite);
  };
  write(output,
        options.long_form ? long_table(m.gauges) : series_table(m.gauges, run.surface_times(), options.heights));
  write(options.peaks, peaks_table(m));
  write(options.runup, runup_table(m.sections, run.surface_times(), m.still_water_level));
  if (!options.netcdf.empty())
    write_gauge_netcdf(options.netcdf, particles, m.gauges, c.name, provenance.enabled ? provenance.to_json() : "",
                       options.common.overwrite);
  if (!options.maps.empty())
    m.shore_runup =
        write_wave_maps(options.maps, run, first_water, arrivals, m.gauges, m.peaks, options.common.overwrite);
  const ordered_json summary = summary_json(m, provenance);
  if (!options.summary.empty()) write_text_file(options.summary, summary.dump(2) + "\n", options.common.overwrite);
  if (options.common.json) std::cout << summary.dump(2) << "\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(
      "Wave gauges, run-up and wave maps of a run. Elevations are in the case's vertical datum, heights above its "
      "still\n"
      "water level; a gauge that starts on soil follows the soil surface, its heights are changes since the start.",
      "gauges");
  app.add_option("run", options.run, "Run file, as lgiw-run writes it")->required()->type_name("RUN.h5");
  const std::string measured = "What is measured";
  app.add_option("--case", options.case_file,
                 "Take gauges and sections from this case file, not from the run's own case")
      ->type_name("FILE")
      ->group(measured);
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
  app.add_option("-o,--output", options.output,
                 "Table of the surface at the gauges against time (CSV); stdout without -o or with -")
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
  app.add_option("--netcdf", options.netcdf, "The series as CF timeSeries netCDF")->type_name("FILE")->group(outputs);
  app.add_option("--maps", options.maps,
                 "Folder for GeoTIFFs of the maxima and wave.gpkg with shoreline, run-up along it and inundation")
      ->type_name("FOLDER")
      ->group(outputs);
  app.add_option("--summary", options.summary, "Gauges and run-up as JSON")->type_name("FILE")->group(outputs);
  add_common_options(app, options.common, library_versions());
  app.footer(
      "Example:\n  gauges run.h5 -o gauges.csv --peaks peaks.csv --runup runup.csv --maps maps --thresholds 0.5,1\n"
      "  gauges run.h5 --gauge P1,389450,3794050 --heights");
  const std::string command = command_line(argc, argv);
  return tool_main(app, argc, argv, [&] { return run(options, command); });
}
