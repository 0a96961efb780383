// impulse-wave: what empirical formulas say of a slide's wave, from numbers or beside a run.
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "assessment.hh"
#include "base/atomic_file.hh"
#include "base/error.hh"
#include "base/option_checks.hh"
#include "base/tool_main.hh"
#include "case/dotted_key.hh"
#include "measure/surface_sampling.hh"
#include "measure/tool_outputs.hh"
#include "report.hh"

namespace {

using namespace lgiw;

struct Options {
  std::string run, case_file, output, summary;
  double speed = no_value, thickness = no_value, width = no_value, volume = no_value, density = no_value,
         slope = no_value, depth = no_value, water_density = no_value;
  double drop = no_value, friction_angle = no_value, angle = 0, bank_slope = no_value, bank_depth = no_value;
  std::vector<double> distances;
  bool channel = false;
  CommonOptions common;

  /// A number of the slide, its name and where it goes.
  struct Number {
    const char* name;
    double value;
    double SlideImpact::*target;
  };
  std::vector<Number> numbers() const {
    return {{"speed", speed, &SlideImpact::speed},       {"thickness", thickness, &SlideImpact::thickness},
            {"width", width, &SlideImpact::width},       {"volume", volume, &SlideImpact::volume},
            {"density", density, &SlideImpact::density}, {"slope", slope, &SlideImpact::slope},
            {"depth", depth, &SlideImpact::depth}};
  }
};

/// What the run has of the slide; the places come later, when the command line has had its say.
void measure(Assessment& a, const Options& options, const RunReader& run, const Case& c) {
  const RunHeader& header = run.header();
  const ParticleHeader& p = header.particles;
  LGIW_VALIDATE(!options.channel, "--channel is for numbers without a run", "the run says whether it is 2-D",
                "leave it out");
  LGIW_VALIDATE(run.has_water_surface() && !run.surface_times().empty(), options.run + " has no water",
                "there is no wave to estimate", "give the run of a case with water");
  LGIW_VALIDATE(p.counts.soil > 0 || !p.bodies.empty(), options.run + " has no slide",
                "there is nothing that could make a wave", "give the run of a case with a slide");
  a.run = options.run, a.case_name = c.name;
  a.channel = a.per_metre = p.dimension == 2;
  a.entry = measure_slide_entry(run, c);
  const SlideEntry& entry = *a.entry;
  a.impact = {entry.speed,
              entry.thickness,
              entry.width,
              entry.volume > 0 ? entry.volume : no_value,
              no_value,
              entry.slope,
              no_value,
              c.water.density,
              std::abs(c.gravity[2])};
  // A rigid slide is a wall, whose density the solver has no use for.
  if (p.counts.soil > 0 || c.places.count("soil.density")) a.impact.density = c.soil.density;
  if (!(entry.volume > 0)) {
    a.notes.push_back("no part of the slide crossed the still water level");
    return;
  }
  a.water = water_ahead(header, run.water_surface(0), entry);
  a.impact.depth = a.water.depth;
  a.drop = entry.drop, a.travel_slope = entry.travel_slope;
  const bool at_rest = std::hypot(c.slide.velocity[0], c.slide.velocity[1], c.slide.velocity[2]) == 0;
  if (p.counts.soil > 0 && at_rest)  // Koerner's slide gets its speed on the way
    a.friction_angle = c.soil.bed == WallFriction::coulomb ? c.soil.bed_friction_angle : c.soil.friction_angle;
  std::size_t frames = 0;
  for (std::size_t k = 0; k < run.frame_count(); ++k)
    if (run.frame_time(k) >= entry.start && run.frame_time(k) <= entry.end) ++frames;
  if (p.counts.soil > 0 && frames < 5)
    a.notes.push_back("the run has " + std::to_string(frames) +
                      " frames while the slide enters the water, so that its speed and thickness are coarse: a shorter "
                      "output.frame_interval tells them better");
  if (entry.submerged_volume > 0.1 * entry.volume)
    a.notes.push_back(number_text(entry.submerged_volume, 3) +
                      " m3 of the slide lay under water from the start; formulas for slides that come from above leave "
                      "them out");
}

Assessment assess(const Options& options, const RunReader* run, const Case& c) {
  Assessment a;
  if (run) {
    measure(a, options, *run, c);
  } else {
    a.impact = {no_value, no_value, no_value, no_value, no_value, no_value, no_value};
    a.channel = options.channel;
    a.per_metre = options.channel && std::isnan(options.width);
    if (a.per_metre) a.impact.width = 1;
  }
  for (const Options::Number& n : options.numbers()) {
    if (std::isnan(n.value)) continue;
    a.impact.*n.target = n.value;
    a.given.push_back(n.name);
  }
  if (run && a.channel && !std::isnan(options.width)) {
    a.per_metre = false;
    if (std::isnan(options.volume)) a.impact.volume *= options.width;  // was measured per metre
  }
  if (!std::isnan(options.water_density)) a.impact.water_density = options.water_density;
  if (!std::isnan(options.drop)) a.drop = options.drop, a.travel_slope = a.impact.slope;
  if (!std::isnan(options.friction_angle)) a.friction_angle = options.friction_angle;
  if (!std::isnan(a.drop) && !std::isnan(a.friction_angle) && !std::isnan(a.travel_slope))
    a.koerner = koerner_speed(a.drop, a.travel_slope, a.friction_angle, a.impact.gravity);
  if (std::isnan(a.impact.speed) && !run && !std::isnan(a.koerner.value)) {
    LGIW_VALIDATE(a.koerner.value > 0, "the slide does not move",
                  "a friction angle of " + number_text(a.friction_angle) + " degrees holds it on " +
                      number_text(a.travel_slope) + " degrees",
                  "give a smaller --friction-angle or the --speed itself");
    a.impact.speed = a.koerner.value;
  }

  std::string missing;
  for (const Options::Number& n : options.numbers())
    if (std::isnan(a.impact.*n.target)) missing += std::string(missing.empty() ? "--" : ", --") + n.name;
  a.complete = missing.empty();
  LGIW_VALIDATE(!a.entry || !(a.entry->volume > 0) || !std::isnan(a.water.x), "there is no water before the slide",
                "it moves away from the lake on its axis", "give the numbers without the run");
  const bool dry = a.entry && !(a.entry->volume > 0);  // nothing came: a result, and no fault of the call
  LGIW_VALIDATE(a.complete || dry,
                missing + (missing.find(' ') == std::string::npos ? " is required" : " are required"),
                run ? options.run + " does not hold it" : "there is no run in which to measure the slide",
                run ? "give it" : "give the numbers or a run");
  if (!a.complete) return a;

  a.places.push_back(impact_place(a));
  if (run && !dry) add_run_places(a, *run, c);
  const double start = a.entry && !dry ? a.entry->start : 0;
  for (double distance : options.distances) {
    const std::string name = number_text(distance, 6) + "m";
    a.places.push_back(wave_place(a, "distance", name, distance, options.angle, start));
    if (!std::isnan(options.bank_slope))
      a.places.push_back(bank_place(a, name, distance, options.angle, options.bank_slope,
                                    std::isnan(options.bank_depth) ? a.impact.depth : options.bank_depth));
  }
  return a;
}

int run(const Options& options, const std::string& command) {
  LGIW_VALIDATE(options.case_file.empty() || !options.run.empty(), "--case is for a run", "none is given",
                "leave it out, or give the run");
  std::optional<RunReader> reader;
  Case c;
  if (!options.run.empty()) {
    reader.emplace(options.run);
    c = case_of_run(reader->header(), options.run, options.case_file);
  }
  const bool text = options.output.empty() && options.summary.empty() && !options.common.json;
  ToolOutputs results("impulse-wave", command, options.common, {options.run, options.case_file});
  results.check({text ? "-" : options.output, options.summary});
  results.hash_inputs();

  const Assessment a = assess(options, reader ? &*reader : nullptr, c);
  if (text) std::cout << report_text(a);
  if (!text && !options.common.quiet) {
    for (const std::string& line : limit_lines(a)) std::cerr << "impulse-wave: " << line << "\n";
    for (const std::string& note : a.notes) std::cerr << "impulse-wave: " << note << "\n";
  }
  results.write(options.output, report_table(a));
  results.summarise(options.summary, report_json(a));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(
      "What published formulas say of the wave of a slide: crests, trough, travel time and run-up, with every limit "
      "of\n"
      "their tests that is broken. From the numbers below, or beside a run: then they are measured in it as the slide\n"
      "crosses the still water level, and the estimates stand beside its gauges and opposite banks. A number that is\n"
      "given replaces the run's. docs/impulse-wave.md has formulas, definitions and the keys of the JSON.",
      "impulse-wave");
  app.add_option("run", options.run, "Run file, as lgiw-run writes it")->type_name("RUN.h5");
  app.add_option("--case", options.case_file,
                 "Take gauges and sections from this case file, not from the run's own case")
      ->type_name("FILE");
  const std::string slide = "The slide at impact";
  const auto number = [&](const std::string& name, double& value, const std::string& what, const std::string& unit,
                          const std::string& group) {
    return app.add_option(name, value, what)->type_name(unit)->check(above_zero)->group(group);
  };
  number("--speed", options.speed, "Speed of the slide at impact", "M/S", slide);
  number("--thickness", options.thickness, "Largest thickness, across the slope", "M", slide);
  number("--width", options.width, "Width; with --channel 1 m, and the volume is per metre", "M", slide);
  number("--volume", options.volume, "Bulk volume", "M3", slide);
  number("--density", options.density, "Bulk density", "KG/M3", slide);
  number("--slope", options.slope, "Angle of impact below the horizontal", "DEG", slide)->check(between(0.0, 90.0));
  number("--depth", options.depth, "Still water depth before the slide", "M", slide);
  number("--water-density", options.water_density, "Density of the water, otherwise 1000 or the run's", "KG/M3", slide);
  number("--drop", options.drop, "Without --speed: how far the slide's centre sinks to the water (Koerner)", "M",
         slide);
  number("--friction-angle", options.friction_angle, "with this angle of dynamic friction", "DEG", slide)
      ->check(between(0.0, 89.0));
  const std::string where = "Where";
  app.add_flag("--channel", options.channel, "2-D: the slide fills the width of a channel")->group(where);
  app.add_option("--distance", options.distances, "Distances from the impact, e.g. 500,1000")
      ->type_name("M,...")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(above_zero)
      ->group(where);
  app.add_option("--angle", options.angle, "of these places off the slide's axis")
      ->type_name("DEG")
      ->check(between(-180.0, 180.0))
      ->needs("--distance")
      ->excludes("--channel")
      ->group(where);
  auto* bank = number("--bank-slope", options.bank_slope, "There is a bank: its slope", "DEG", where)
                   ->check(between(0.0, 90.0))
                   ->needs("--distance");
  number("--bank-depth", options.bank_depth, "Still water depth before the bank, otherwise --depth", "M", where)
      ->needs(bank);
  const std::string outputs = "Outputs";
  app.add_option("-o,--output", options.output,
                 "Table with a row an estimate (CSV; - is stdout); without outputs a report goes to stdout")
      ->type_name("FILE")
      ->group(outputs);
  app.add_option("--summary", options.summary, "The same as JSON")->type_name("FILE")->group(outputs);
  add_common_options(app, options.common, "HDF5 " + hdf5_version());
  app.footer(
      "Examples:\n  $ impulse-wave run.h5\n"
      "  $ impulse-wave --speed 58 --thickness 12 --width 100 --volume 220000 --density 1700 --slope 40 --depth 80 \\\n"
      "    --distance 500,1700 --angle 20 --bank-slope 35");
  const std::string command = command_line(argc, argv);
  return tool_main(app, argc, argv, [&] { return run(options, command); });
}
