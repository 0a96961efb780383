// dem2particles: a case and its terrain to particles.
#include <gdal_version.h>
#include <hdf5.h>
#include <omp.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/atomic_file.hh"
#include "base/check_outputs.hh"
#include "base/error.hh"
#include "base/make_rule.hh"
#include "base/option_checks.hh"
#include "base/thread_waiting.hh"
#include "base/tool_main.hh"
#include "case/sweep.hh"
#include "files/domain.hh"
#include "seeding/run_estimate.hh"
#include "seeding/seeding.hh"

namespace {

using namespace lgiw;
using nlohmann::ordered_json;

const std::string library_versions = std::string("GDAL ") + GDAL_RELEASE_NAME + ", HDF5 " +
                                     std::to_string(H5_VERS_MAJOR) + "." + std::to_string(H5_VERS_MINOR) + "." +
                                     std::to_string(H5_VERS_RELEASE);

struct Options {
  std::string case_file, output, dependencies, sweep;
  std::vector<std::string> overrides;
  bool dry_run = false;
  double rate = 0;
  CommonOptions common;
};

/// Difference of a to the expected b in per cent; nothing to compare with is no difference.
double difference(double a, double b) { return b > 0 ? 100 * (a / b - 1) : 0; }

ordered_json volumes(int64_t count, double volume, double expected, double surveyed) {
  ordered_json j{{"particles", count},
                 {"volume", volume},
                 {"volume_between_surfaces", expected},
                 {"difference_percent", difference(volume, expected)}};
  if (surveyed > 0) {
    j["terrain_volume"] = surveyed;
    j["terrain_difference_percent"] = difference(volume, surveyed);
  }
  return j;
}

ordered_json summary(const Case& c, const TerrainModel& model, const Seeder& seeder, double rate) {
  const SeedingReport& r = seeder.report();
  const RunEstimate run =
      estimate_run(c, r.counts, seeder.header().sound_speed, r.greatest_soil_column * c.dp, rate, r.soil_extent);
  ordered_json j;
  j["case"] = c.name;
  j["dimension"] = c.dimension;
  j["particle_spacing"] = c.dp;
  j["particles"] = {{"water", r.counts.water},
                    {"soil", r.counts.soil},
                    {"wall", r.counts.wall},
                    {"total", r.counts.total()},
                    {"left_out", r.counts.wall_left_out}};
  // Reservoir and slide as the terrain has them, from the cells of the source.
  if (c.water.present) {
    j["water"] = volumes(r.counts.water, r.water_volume, r.water_expected, model.reservoir_volume);
    j["water"]["greatest_depth"] = r.greatest_depth;
    j["water"]["sound_speed"] = seeder.header().sound_speed;
  }
  if (c.has_soil()) j["soil"] = volumes(r.counts.soil, r.soil_volume, r.soil_expected, model.slide_volume);
  const std::vector<BodyMotion>& bodies = seeder.header().bodies;
  for (std::size_t k = 0; k < bodies.size(); ++k)
    j["bodies"].push_back({{"name", bodies[k].name}, {"volume", r.body_volumes[k]}});
  j["terrain"] = {{"voids_filled", model.voids_filled},
                  {"spikes", model.spikes},
                  {"spikes_removed", model.spikes_removed},
                  {"east_side_moved", r.east_moved},
                  {"north_side_moved", r.north_moved}};
  j["run"] = {{"memory_bytes", run.memory_bytes},
              {"time_step", run.time_step},
              {"steps", run.steps},
              {"end_time", c.output.end_time},
              {"rate", rate},
              {"run_time_s", run.run_time}};
  const auto across = [](double particles) { return particles > 0 ? std::optional<double>(particles) : std::nullopt; };
  const ErrorClass error =
      expected_error(across(r.median_soil_column), across(r.counts.water > 0 ? r.greatest_depth / c.dp : 0));
  j["resolution"] = {{"slide_thickness_particles", r.median_soil_column},
                     {"water_depth_particles", r.counts.water > 0 ? r.greatest_depth / c.dp : 0}};
  j["expected_error"] = error.text;
  j["notes"] = model.notes;
  return j;
}

std::string line(const char* format, auto... values) {
  char text[400];
  std::snprintf(text, sizeof text, format, values...);
  return std::string(text) + "\n";
}

std::string phase_line(const std::string& name, const ordered_json& j, int dimension) {
  const char* unit = dimension == 2 ? "m2" : "m3";
  std::string text = line("%-6s %12lld particles  %.6g %s (%+.2f %% of the %.6g %s between the surfaces)", name.c_str(),
                          j["particles"].get<long long>(), j["volume"].get<double>(), unit,
                          j["difference_percent"].get<double>(), j["volume_between_surfaces"].get<double>(), unit);
  if (j.contains("terrain_volume"))
    text += line("       %+.2f %% of the terrain's %.6g %s", j["terrain_difference_percent"].get<double>(),
                 j["terrain_volume"].get<double>(), unit);
  return text;
}

std::string report_text(const ordered_json& j) {
  const auto& p = j["particles"];
  std::string text;
  for (const char* phase : {"water", "soil"})
    if (j.contains(phase)) text += phase_line(phase, j[phase], j["dimension"].get<int>());
  text += line("wall   %12lld particles, %lld more left out where neither water nor soil can get",
               p["wall"].get<long long>(), p["left_out"].get<long long>());
  text += line("total  %12lld particles at %g m", p["total"].get<long long>(), j["particle_spacing"].get<double>());
  if (j.contains("bodies"))
    for (const auto& body : j["bodies"])
      text += line("body   %s, %.6g %s, moves as prescribed", body["name"].get<std::string>().c_str(),
                   body["volume"].get<double>(), j["dimension"] == 2 ? "m2" : "m3");
  if (j.contains("water"))
    text += line("water  %.4g m deep, sound speed %.4g m/s", j["water"]["greatest_depth"].get<double>(),
                 j["water"]["sound_speed"].get<double>());
  const auto& t = j["terrain"];
  if (t["voids_filled"] != 0 || t["spikes"] != 0)
    text += line("terrain %lld voids filled, %lld spikes, %lld of them removed", t["voids_filled"].get<long long>(),
                 t["spikes"].get<long long>(), t["spikes_removed"].get<long long>());
  for (const auto& [key, name] : {std::pair{"east_side_moved", "east"}, std::pair{"north_side_moved", "north"}})
    if (std::abs(t[key].get<double>()) > 1e-6 * j["particle_spacing"].get<double>())
      text += line("the %s side is moved by %.4g m to a multiple of the particle spacing", name, t[key].get<double>());
  const auto& r = j["run"];
  text += line("lgiw-run: about %.3g MB, time step %.3g s, %.0f steps to %g s, %s at %.3g particle-steps/s",
               r["memory_bytes"].get<double>() / 1e6, r["time_step"].get<double>(), r["steps"].get<double>(),
               r["end_time"].get<double>(), format_duration(r["run_time_s"].get<double>()).c_str(),
               r["rate"].get<double>());
  const double thick = j["resolution"]["slide_thickness_particles"].get<double>();
  const double deep = j["resolution"]["water_depth_particles"].get<double>();
  if (thick > 0 && deep > 0)
    text += line("slide %.3g particles thick (median), water %.3g deep", thick, deep);
  else if (thick > 0)
    text += line("slide %.3g particles thick (median)", thick);
  else if (deep > 0)
    text += line("water %.3g particles deep", deep);
  text += j["expected_error"].get<std::string>() + "\n";
  for (const auto& note : j["notes"]) text += note.get<std::string>() + "\n";
  return text;
}

/// A value as it stands in YAML: a number where it is one, else its text.
ordered_json json_value(const std::string& yaml) {
  if (yaml.empty()) return nullptr;
  const ordered_json value = ordered_json::parse(yaml, nullptr, false);
  return value.is_number() || value.is_boolean() ? value : ordered_json(yaml);
}

int list_sweep(const Options& options) {
  LGIW_VALIDATE(options.output.empty() && !options.dry_run, "--sweep comes with --output or --dry-run",
                "it lists the runs of a sweep and makes no particles", "Give it alone");
  const Sweep sweep = read_sweep(options.sweep, options.case_file, options.overrides);
  ordered_json list{{"keys", sweep.keys}, {"runs", ordered_json::array()}};
  std::string lines;
  for (const SweepRun& r : sweep.runs) {
    ordered_json inputs = ordered_json::object();
    for (std::size_t k = 0; k < sweep.keys.size(); ++k) inputs[sweep.keys[k]] = json_value(r.inputs[k]);
    list["runs"].push_back(
        {{"name", r.name}, {"inputs", inputs}, {"overrides", r.overrides}, {"case_text", r.case_text}});
    lines += r.name + "\t";
    for (const std::string& o : r.overrides) lines += (&o == &r.overrides.front() ? "" : " ") + ("--set '" + o + "'");
    lines += "\n";
  }
  std::cout << (options.common.json ? list.dump(2) + "\n" : lines);
  return 0;
}

int run(const Options& options, const std::string& command) {
  if (!options.sweep.empty()) return list_sweep(options);
  LGIW_VALIDATE(options.dry_run || !options.output.empty(), "no output is named", "particles are written to a file",
                "Give -o particles.h5, or --dry-run for counts only");
  LGIW_VALIDATE(options.output != "-", "particles cannot go to stdout", "HDF5 writes at more places than the end",
                "Name a file");
  LGIW_VALIDATE(options.dependencies.empty() || !options.dry_run, "--dependencies with --dry-run",
                "they are what particles are made anew from, and none are made", "Leave it out");
  const bool quiet = options.common.quiet;
  const Case c = read_case(options.case_file, options.overrides);
  std::vector<std::string> inputs;  // files; GDAL's own names among them are none
  if (options.case_file != "-") inputs.push_back(options.case_file);
  for (const std::string& named : files_of(c)) inputs.push_back(c.resolve(named));
  if (!options.dry_run) check_outputs({options.output, options.dependencies}, inputs, options.common.overwrite, false);
  std::optional<AtomicFile> file;
  if (!options.dry_run) file.emplace(options.output, options.common.overwrite);
  if (!quiet)
    for (const std::string& warning : case_warnings(c)) std::cerr << "dem2particles: " << warning << "\n";

  Provenance provenance;
  provenance.enabled = options.common.provenance;
  provenance.tool = "dem2particles";
  provenance.version = version_string();
  provenance.command_line = command;
  provenance.add_input(options.case_file);
  if (c.slide.motion) provenance.add_input(c.resolve(c.slide.motion->file));
  for (const MovingBody& body : c.bodies) provenance.add_input(c.resolve(body.motion));
  const TerrainModel model = build_terrain(c, provenance);

  Seeder seeder(c, model);
  check_inside(seeder.header(), c.gauges, c.sections);
  {
    Progress progress(options.common.show_progress(), "counting particles");
    seeder.count([&](double done) { progress.update(done); });
  }
  const SeedingReport& report = seeder.report();
  LGIW_VALIDATE(!c.water.present || report.counts.water > 0, "there is no water",
                "no lattice point lies in it at a spacing of " + std::to_string(c.dp) + " m",
                "Choose a smaller particle_spacing or another water.level");
  LGIW_VALIDATE(!c.has_soil() || report.counts.soil > 0, "there is no soil",
                "no lattice point lies in it at a spacing of " + std::to_string(c.dp) + " m",
                "Choose a smaller particle_spacing or a thicker slide");
  const double rate = options.rate > 0
                          ? options.rate
                          : particle_rate(c.dimension, report.counts.soil > 0,
                                          c.numerics.threads > 0 ? c.numerics.threads : omp_get_max_threads());
  const ordered_json result = summary(c, model, seeder, rate);

  if (!options.dry_run) {
    ParticleHeader header = seeder.header();
    header.provenance = provenance.to_json();
    ParticleWriter writer(file->temporary(), header);
    Progress progress(options.common.show_progress(), "writing particles");
    seeder.seed([&](const ParticleBlock& block) { writer.append(block); }, [&](double done) { progress.update(done); });
    writer.finish();
    file->commit();
    if (!options.dependencies.empty()) {
      std::vector<std::string> files;  // but the case: who makes particles from it has named it
      for (const auto& [path, hash] : provenance.inputs)
        if (path != options.case_file) files.push_back(path);
      write_text_file(options.dependencies, make_rule(options.output, files), options.common.overwrite);
    }
  }
  if (options.common.json)
    std::cout << result.dump(2) << "\n";
  else if (options.dry_run)
    std::cout << report_text(result);
  else if (!quiet)
    std::cerr << report_text(result);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  wait_briefly(argv);
  Options options;
  CLI::App app("Turns a case - terrain, still water, slide - into particles for lgiw-run.", "dem2particles");
  app.add_option("case", options.case_file, "Case file (YAML); - for stdin")->required()->type_name("CASE");
  app.add_option("-o,--output", options.output, "Particles file to write (VTKHDF)")->type_name("FILE");
  app.add_option("--set", options.overrides, "Override a key of the case, e.g. --set water.level=745; may be repeated")
      ->type_name("KEY=VALUE or LIST+=ITEM")
      ->allow_extra_args(false);
  app.add_option("--dependencies", options.dependencies,
                 "Rule for make that names the files the particles were made from, besides the case")
      ->type_name("FILE");
  app.add_flag("--dry-run", options.dry_run, "Counts, volumes and what a run will take; writes nothing");
  app.add_option(
         "--sweep", options.sweep,
         "List the runs of a sweep, a line a run: its name, and its --set; every run's case is checked, and nothing "
         "is written")
      ->type_name("SWEEP.yaml");
  app.add_option("--rate", options.rate, "Particle-steps a second that run times are estimated with")
      ->type_name("NUMBER")
      ->check(above_zero);
  add_common_options(app, options.common, library_versions);
  app.footer(
      "Examples:\n  $ dem2particles case.yaml --dry-run\n  $ dem2particles case.yaml -o particles.h5 --set "
      "particle_spacing=10");
  const std::string command = command_line(argc, argv);
  return tool_main(app, argc, argv, [&] { return run(options, command); });
}
