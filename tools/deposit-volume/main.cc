// deposit-volume: volumes, speeds and shape of the slide of a run.
#include <gdal_version.h>
#include <hdf5.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/atomic_file.hh"
#include "base/error.hh"
#include "base/tool_main.hh"
#include "measure/csv_table.hh"
#include "measure/section_profiles.hh"
#include "measure/slide_history.hh"
#include "measure/surface_sampling.hh"
#include "measure/tool_outputs.hh"
#include "terrain/geo_output.hh"

namespace {

using namespace lgiw;
using nlohmann::ordered_json;

const std::string hdf5_version =
    std::to_string(H5_VERS_MAJOR) + "." + std::to_string(H5_VERS_MINOR) + "." + std::to_string(H5_VERS_RELEASE);

struct Options {
  std::string run, case_file, output, profiles, thickness, summary;
  std::vector<std::string> at{"first", "last"};
  double adps = 0;  // 0: the case's
  CommonOptions common;
};

/// Frames that --at asks for: `first`, `last` and times, which take the nearest frame. In order of time, each once.
std::vector<std::size_t> chosen_frames(const std::vector<std::string>& at, const RunReader& run) {
  std::vector<std::size_t> frames;
  const std::size_t last = run.frame_count() - 1;
  for (const std::string& word : at) {
    if (word == "first" || word == "last") {
      frames.push_back(word == "first" ? 0 : last);
      continue;
    }
    char* end = nullptr;
    const double time = std::strtod(word.c_str(), &end);
    LGIW_VALIDATE(!word.empty() && *end == '\0' && std::isfinite(time), "--at has '" + word + "'",
                  "it is neither first, last nor a time in s", "write for example --at first,20,last");
    std::ostringstream range;
    range << "the run's frames are from " << run.frame_time(0) << " s to " << run.frame_time(last) << " s";
    LGIW_VALIDATE(time >= run.frame_time(0) && time <= run.frame_time(last), "there is no frame at " + word + " s",
                  range.str(), "name a time between them");
    std::size_t nearest = 0;
    for (std::size_t k = 1; k <= last; ++k)
      if (std::abs(run.frame_time(k) - time) < std::abs(run.frame_time(nearest) - time)) nearest = k;
    frames.push_back(nearest);
  }
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

/// The sections of the case; a 2-D run without any has one along itself.
std::vector<Section> chosen_sections(const Case& c, const ParticleHeader& header) {
  if (!c.sections.empty() || header.dimension == 3) return c.sections;
  Section whole{"profile", {}};
  for (double x : {header.low[0], header.high[0]}) whole.points.push_back({x + header.origin[0], header.origin[1]});
  return {whole};
}

CsvTable history_table(const std::vector<SlideState>& states) {
  CsvTable table({"time_s", "slide_volume_m3", "immersed_volume_m3", "unmoved_volume_m3", "lost_volume_m3",
                  "mean_speed_m_s", "p99_speed_m_s", "max_speed_m_s", "centre_x", "centre_y", "centre_z"});
  for (const SlideState& s : states)
    table.add(s.time, s.slide_volume, s.immersed_volume, s.unmoved_volume, s.lost_volume, s.mean_speed, s.p99_speed,
              s.max_speed, s.centre[0], s.centre[1], s.centre[2]);
  return table;
}

void add_profiles(CsvTable& table, const RunReader& run, const Frame& frame, const std::vector<Section>& sections,
                  double threshold) {
  const auto profiles = section_profiles(run.header(), frame, sections, threshold);
  const auto& origin = run.header().particles.origin;
  for (std::size_t s = 0; s < sections.size(); ++s) {
    const SectionProfile& p = profiles[s];
    for (std::size_t k = 0; k < p.stations.size(); ++k)
      table.add(sections[s].name, frame.time, p.stations[k].distance, p.stations[k].x + origin[0],
                p.stations[k].y + origin[1], p.ground[k], p.bed[k], p.soil[k], p.water[k], p.slip[k]);
  }
}

double largest(const std::vector<SlideState>& states, double SlideState::*value) {
  double result = 0;
  for (const SlideState& s : states)
    if (s.*value > result) result = s.*value;
  return result;
}

ordered_json summary_json(const std::vector<SlideState>& states, const SlideHistory& history, double threshold,
                          const Provenance& provenance) {
  const SlideState& last = states.back();
  const SlideDeposit deposit = history.deposit();
  ordered_json summary{{"slide_volume_m3", last.slide_volume},
                       {"immersed_volume_m3", last.immersed_volume},
                       {"max_slide_speed_m_s", largest(states, &SlideState::p99_speed)},
                       {"max_soil_particle_speed_m_s", largest(states, &SlideState::max_speed)},
                       {"unmoved_volume_m3", last.unmoved_volume},
                       {"lost_soil_volume_m3", last.lost_volume},
                       {"soil_volume_m3", history.total_volume()},
                       {"adps_threshold", threshold},
                       {"deposit",
                        {{"length_m", deposit.length},
                         {"width_m", deposit.width},
                         {"height_above_water_m", deposit.height_above_water},
                         {"direction_deg", deposit.direction},
                         {"runout_of_centre_m", deposit.runout}}}};
  if (provenance.enabled) summary["provenance"]["deposit-volume"] = ordered_json::parse(provenance.to_json());
  return summary;
}

int run(const Options& options, const std::string& command) {
  const RunReader run(options.run);
  const RunHeader& header = run.header();
  const ParticleHeader& particles = header.particles;
  LGIW_VALIDATE(particles.counts.soil > 0, options.run + " has no soil", "there is no slide to measure",
                "give the run of a case with a slide");
  LGIW_VALIDATE(run.frame_count() > 0, options.run + " holds no frames", "the run has not got that far",
                "wait for lgiw-run to write some");
  const Case c = case_of_run(header, options.run, options.case_file);
  const double threshold = options.adps > 0 ? options.adps : c.deposit.adps_threshold;
  const std::vector<Section> sections = chosen_sections(c, particles);
  LGIW_VALIDATE(options.profiles.empty() || !sections.empty(), "there is no section", "profiles lie along sections",
                "add sections to the case and pass it with --case");
  LGIW_VALIDATE(options.thickness.empty() || particles.dimension == 3, "--thickness is for 3-D runs",
                options.run + " is 2-D", "leave it out; --profiles has the deposit");
  const std::vector<std::size_t> profile_frames = chosen_frames(options.at, run);
  const std::string output = !options.output.empty() ? options.output : options.common.json ? "" : "-";
  std::vector<std::string> inputs{options.run};
  if (!options.case_file.empty() && options.case_file != "-") inputs.push_back(options.case_file);
  check_outputs({output, options.profiles, options.thickness, options.summary}, inputs, options.common.overwrite,
                options.common.json);

  Provenance provenance;
  provenance.enabled = options.common.provenance;
  provenance.tool = "deposit-volume";
  provenance.version = version_string();
  provenance.command_line = command;
  for (const std::string& input : inputs) provenance.add_input(input);

  const SlideHistory history(header, run.frame(run.frame_count() - 1), threshold);
  std::vector<SlideState> states;
  CsvTable profiles({"section", "time_s", "distance_m", "x", "y", "ground_m", "bed_m", "soil_m", "water_m", "slip_m"});
  {
    Progress progress(options.common.show_progress(), "slide");
    for (std::size_t k = 0; k < run.frame_count(); ++k) {
      const Frame frame = run.frame(k);
      states.push_back(history.state(frame));
      if (!options.profiles.empty() && std::binary_search(profile_frames.begin(), profile_frames.end(), k))
        add_profiles(profiles, run, frame, sections, threshold);
      progress.update(double(k + 1) / double(run.frame_count()));
    }
  }

  const std::string comment = provenance.enabled ? "provenance: " + provenance.to_json() : "";
  const auto write = [&](const std::string& path, const CsvTable& table) {
    if (!path.empty()) write_text_file(path, table.text(comment), options.common.overwrite);
  };
  write(output, history_table(states));
  write(options.profiles, profiles);
  if (!options.thickness.empty())
    write_geotiff(options.thickness, header.map, history.thickness(), {particles.origin, particles.crs_wkt}, "m",
                  "thickness of the slide at the end", options.common.overwrite);
  const ordered_json summary = summary_json(states, history, threshold, provenance);
  if (!options.summary.empty()) write_text_file(options.summary, summary.dump(2) + "\n", options.common.overwrite);
  if (options.common.json) std::cout << summary.dump(2) << "\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(
      "Volumes, speeds and shape of a run's slide: the soil whose accumulated plastic strain is above a threshold.\n"
      "Volumes are in m3, in 2-D per metre of width.",
      "deposit-volume");
  app.add_option("run", options.run, "Run file, as lgiw-run writes it")->required()->type_name("RUN.h5");
  const std::string measured = "What is measured";
  app.add_option("--adps", options.adps, "Accumulated plastic strain above which soil is slide, instead of the case's")
      ->type_name("STRAIN")
      ->check(CLI::PositiveNumber)
      ->group(measured);
  app.add_option("--case", options.case_file, "Take sections and threshold from this case file, not from the run's own")
      ->type_name("FILE")
      ->group(measured);
  app.add_option("--at", options.at, "Times of the profiles: first, last or seconds (the nearest frame)")
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str()
      ->group(measured);
  const std::string outputs = "Outputs";
  app.add_option("-o,--output", options.output,
                 "Table of volumes, speeds (of what is slide at the end; p99: 99th percentile) and centre against time "
                 "(CSV); stdout without -o or with -")
      ->type_name("FILE")
      ->group(outputs);
  app.add_option("--profiles", options.profiles, "Table of bed, soil, water and slip line along the sections (CSV)")
      ->type_name("FILE")
      ->group(outputs);
  app.add_option("--thickness", options.thickness, "Thickness of the slide at the end (GeoTIFF)")
      ->type_name("FILE")
      ->group(outputs);
  app.add_option("--summary", options.summary, "Volumes, speeds and shape of the deposit as JSON")
      ->type_name("FILE")
      ->group(outputs);
  const std::string versions = std::string("GDAL ") + GDAL_RELEASE_NAME + ", HDF5 " + hdf5_version;
  add_common_options(app, options.common, versions);
  app.footer(
      "Example:\n  deposit-volume run.h5 -o slide.csv --thickness thickness.tif --profiles profiles.csv --at "
      "first,20,last");
  const std::string command = command_line(argc, argv);
  return tool_main(app, argc, argv, [&] { return run(options, command); });
}
