// deposit-volume: volumes, speeds and shape of the slide of a run.
#include <gdal_version.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/error.hh"
#include "base/option_checks.hh"
#include "base/thread_waiting.hh"
#include "base/tool_main.hh"
#include "case/dotted_key.hh"
#include "files/csv_table.hh"
#include "measure/chosen_frames.hh"
#include "measure/comparison.hh"
#include "measure/section_profiles.hh"
#include "measure/section_slice.hh"
#include "measure/slide_history.hh"
#include "measure/surface_sampling.hh"
#include "measure/tool_outputs.hh"
#include "terrain/geo_output.hh"

namespace {

using namespace lgiw;
using nlohmann::ordered_json;

struct Options : MeasuringOptions {
  std::string profiles, slices, thickness;
  std::vector<std::string> at{"first", "last"};
  double adps = 0;  // 0: the case's
};

/// The line along a 2-D run.
Section whole_profile(const ParticleHeader& header) {
  Section whole{"profile", {}};
  for (double x : {header.low[0], header.high[0]}) whole.points.push_back({x + header.origin[0], header.origin[1]});
  return whole;
}

/// The sections of the case; a 2-D run without any has one along itself.
std::vector<Section> chosen_sections(const Case& c, const ParticleHeader& header) {
  if (!c.sections.empty() || header.dimension == 3) return c.sections;
  return {whole_profile(header)};
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

void add_slices(CsvTable& table, const RunReader& run, const Frame& frame, const std::vector<Section>& sections) {
  for (const Section& section : sections)
    for (const SliceParticle& p : section_slice(run.header(), frame, section))
      table.add(section.name, frame.time, p.distance, p.z, std::string(p.soil ? "soil" : "water"), p.speed, p.adps);
}

/// NaN where none has a value: all of the slide has left.
double largest(const std::vector<SlideState>& states, double SlideState::*value) {
  double result = no_value;
  for (const SlideState& s : states)
    if (!(s.*value <= result) && !std::isnan(s.*value)) result = s.*value;
  return result;
}

ordered_json summary_json(const std::vector<SlideState>& states, const SlideHistory& history, double threshold) {
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
                         {"runout_of_centre_m", deposit.runout},
                         {"runout_of_front_m", deposit.front_runout},
                         {"front_x_m", deposit.front_x}}}};
  return summary;
}

/// Quantities of the summary that can have a reference, with their units.
const std::vector<std::pair<std::string, std::string>> comparable{{"slide_volume_m3", "m3"},
                                                                  {"immersed_volume_m3", "m3"},
                                                                  {"max_slide_speed_m_s", "m/s"},
                                                                  {"unmoved_volume_m3", "m3"},
                                                                  {"lost_soil_volume_m3", "m3"},
                                                                  {"soil_volume_m3", "m3"},
                                                                  {"length_m", "m"},
                                                                  {"width_m", "m"},
                                                                  {"height_above_water_m", "m"},
                                                                  {"direction_deg", "degrees"},
                                                                  {"runout_of_centre_m", "m"},
                                                                  {"runout_of_front_m", "m"},
                                                                  {"front_x_m", "m"}};

/// What --compare names, sound and fit for the run.
struct References {
  std::vector<ScalarReference> scalars;
  std::vector<std::pair<Section, ProfileReference>> profiles;  // each with the line that it lies along
};

References chosen_references(const Options& options, const std::vector<Section>& sections,
                             const ParticleHeader& header) {
  References references;
  for (const std::string& file : options.compare) {
    const CsvText table = read_csv(file);
    if (holds_scalars(table)) {
      for (const ScalarReference& s : scalar_references(table)) {
        std::vector<std::string> names;
        for (const auto& [name, unit] : comparable) names.push_back(name);
        LGIW_VALIDATE(std::find(names.begin(), names.end(), s.quantity) != names.end(),
                      s.place + ": " + s.quantity + " is not measured",
                      "quantities are named as in the summary and in " + std::string("its deposit"),
                      "do you mean " + nearest_word(s.quantity, names) + "?");
        references.scalars.push_back(s);
      }
      continue;
    }
    for (const ProfileReference& p : profile_references(table)) {
      if (!p.along_section) {
        LGIW_VALIDATE(header.dimension == 2, file + " has places by x_m", options.run + " is 3-D",
                      "give distances along a section as distance_m");
        references.profiles.push_back({whole_profile(header), p});
        continue;
      }
      LGIW_VALIDATE(!sections.empty(), "there is no section", file + " lies along one",
                    "add sections to the case and pass it with --case");
      LGIW_VALIDATE(!p.section.empty() || sections.size() == 1, file + " does not name its section",
                    "the case has " + std::to_string(sections.size()), "add a column section");
      const auto section = std::find_if(sections.begin(), sections.end(),
                                        [&](const Section& s) { return p.section.empty() || s.name == p.section; });
      LGIW_VALIDATE(section != sections.end(), file + ": there is no section " + p.section, "the case names others",
                    "name one of the case");
      references.profiles.push_back({*section, p});
    }
  }
  for (const auto& [section, p] : references.profiles) {
    double length = 0;
    for (std::size_t k = 1; k < section.points.size(); ++k)
      length +=
          std::hypot(section.points[k][0] - section.points[k - 1][0], section.points[k][1] - section.points[k - 1][1]);
    const double start = p.along_section ? 0 : header.low[0] + header.origin[0];
    LGIW_VALIDATE(p.distance.front() < start + length && p.distance.back() > start,
                  p.file + ": the profile shares no place with the run",
                  "the run's line is from " + number_text(start) + " m to " + number_text(start + length) + " m",
                  p.along_section ? "give distances from the section's first point" : "give x in the case's CRS");
  }
  return references;
}

/// `whole`: the case has no section, and a profile along one lies along the whole of a 2-D run.
std::vector<ComparisonRow> compare_with(const References& references, const ordered_json& summary, const RunReader& run,
                                        double threshold, bool whole) {
  std::vector<ComparisonRow> rows;
  for (const ScalarReference& s : references.scalars) {
    const ordered_json& of_deposit = summary["deposit"];
    const ordered_json& value = summary.contains(s.quantity) ? summary[s.quantity] : of_deposit[s.quantity];
    const auto unit =
        std::find_if(comparable.begin(), comparable.end(), [&](const auto& c) { return c.first == s.quantity; });
    rows.push_back(scalar_row(s, unit->second, value.get<double>()));
  }
  if (references.profiles.empty()) return rows;
  std::vector<Section> sections;
  for (const auto& [section, p] : references.profiles) sections.push_back(section);
  const ParticleHeader& header = run.header().particles;
  const auto profiles = section_profiles(run.header(), run.frame(run.frame_count() - 1), sections, threshold);
  for (std::size_t k = 0; k < profiles.size(); ++k) {
    const ProfileReference& reference = references.profiles[k].second;
    SurfaceProfile surface{{}, profiles[k].bed, profiles[k].soil};
    for (const Station& s : profiles[k].stations)
      surface.distance.push_back(reference.along_section ? s.distance : s.x + header.origin[0]);
    // Sections of a case lead away from the slide; along all of a 2-D run the motion tells where the front is.
    const bool backwards =
        (whole || !reference.along_section) && summary["deposit"]["direction_deg"].get<double>() > 180;
    const auto more = profile_rows(sections[k].name, compare_profiles(surface, reference.distance, reference.elevation,
                                                                      header.dp / 2, backwards ? -1 : 1));
    rows.insert(rows.end(), more.begin(), more.end());
  }
  return rows;
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
  LGIW_VALIDATE((options.profiles.empty() && options.slices.empty()) || !sections.empty(), "there is no section",
                "profiles and slices lie along sections", "add sections to the case and pass it with --case");
  LGIW_VALIDATE(options.thickness.empty() || particles.dimension == 3, "--thickness is for 3-D runs",
                options.run + " is 2-D", "leave it out; --profiles has the deposit");
  const std::vector<std::size_t> profile_frames = chosen_frames("--at", options.at, run);
  const References references = chosen_references(options, sections, particles);
  const bool stdout_used = options.common.json || !options.compare.empty();
  const std::string output = !options.output.empty() ? options.output : stdout_used ? "" : "-";
  std::vector<std::string> inputs{options.run, options.case_file};
  inputs.insert(inputs.end(), options.compare.begin(), options.compare.end());
  ToolOutputs results("deposit-volume", command, options.common, inputs);
  results.check(
      {output, options.profiles, options.slices, options.thickness, options.summary, options.comparison_output()});
  results.hash_inputs();

  const SlideHistory history(header, run.frame(run.frame_count() - 1), threshold);
  std::vector<SlideState> states;
  CsvTable profiles({"section", "time_s", "distance_m", "x", "y", "ground_m", "bed_m", "soil_m", "water_m", "slip_m"});
  CsvTable slices({"section", "time_s", "distance_m", "z_m", "phase", "speed_m_s", "adps"});
  {
    Progress progress(options.common.show_progress(), "slide");
    for (std::size_t k = 0; k < run.frame_count(); ++k) {
      const Frame frame = run.frame(k);
      states.push_back(history.state(frame));
      if (!options.profiles.empty() && std::binary_search(profile_frames.begin(), profile_frames.end(), k))
        add_profiles(profiles, run, frame, sections, threshold);
      if (!options.slices.empty() && std::binary_search(profile_frames.begin(), profile_frames.end(), k))
        add_slices(slices, run, frame, sections);
      progress.update(double(k + 1) / double(run.frame_count()));
    }
  }

  results.write(output, history_table(states));
  results.write(options.profiles, profiles);
  results.write(options.slices, slices);
  if (!options.thickness.empty())
    write_geotiff(options.thickness, header.map, history.thickness(), particles, "m",
                  "thickness of the slide at the end", options.common.overwrite);
  ordered_json summary = summary_json(states, history, threshold);
  if (!options.compare.empty()) {
    const std::vector<ComparisonRow> comparison = compare_with(references, summary, run, threshold, c.sections.empty());
    results.write(options.comparison_output(), comparison_table(comparison));
    summary["comparison"] = comparison_json(comparison);
  }
  results.summarise(options.summary, summary);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  wait_briefly(argv);
  Options options;
  CLI::App app(
      "Volumes, speeds and shape of a run's slide: the soil whose accumulated plastic strain is above a threshold.\n"
      "Volumes are in m3, in 2-D per metre of width.",
      "deposit-volume");
  add_measuring_options(
      app, options, "sections and threshold", "Volumes, speeds, shape of the deposit and comparison as JSON",
      "Measurements (CSV): x_m,z_m (2-D) or [section,]distance_m,z_m of the final soil surface, or quantity,value "
      "and/or low,high with quantities as in the summary. May be repeated");
  const std::string measured = "What is measured";
  app.add_option("--adps", options.adps, "Accumulated plastic strain above which soil is slide, instead of the case's")
      ->type_name("STRAIN")
      ->check(above_zero)
      ->group(measured);
  app.add_option("--at", options.at, "Times of the profiles and slices: first, last or seconds (the nearest frame)")
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str()
      ->group(measured);
  const std::string outputs = "Outputs";
  app.add_option("-o,--output", options.output,
                 "Table of volumes, speeds (of what is slide at the end; p99: 99th percentile) and centre against time "
                 "(CSV); stdout without -o (but for a comparison) or with -")
      ->type_name("FILE")
      ->group(outputs);
  app.add_option("--profiles", options.profiles, "Table of bed, soil, water and slip line along the sections (CSV)")
      ->type_name("FILE")
      ->group(outputs);
  app.add_option("--slices", options.slices,
                 "Table of the particles within a spacing of the sections: phase, speed, strain (CSV)")
      ->type_name("FILE")
      ->group(outputs);
  app.add_option("--thickness", options.thickness, "Thickness of the slide at the end (GeoTIFF)")
      ->type_name("FILE")
      ->group(outputs);
  const std::string versions = std::string("GDAL ") + GDAL_RELEASE_NAME + ", HDF5 " + hdf5_version();
  add_common_options(app, options.common, versions);
  app.footer(
      "Examples:\n  $ deposit-volume run.h5 -o slide.csv --thickness thickness.tif --profiles profiles.csv --at "
      "first,20,last\n  $ deposit-volume run.h5 --compare surface.csv --compare volumes.csv");
  const std::string command = command_line(argc, argv);
  return tool_main(app, argc, argv, [&] { return run(options, command); });
}
