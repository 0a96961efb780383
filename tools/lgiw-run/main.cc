// lgiw-run: particles -> run. The simulation itself is in lib/solver.
#include <omp.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "base/atomic_file.hh"
#include "base/check_outputs.hh"
#include "base/error.hh"
#include "base/option_checks.hh"
#include "base/thread_waiting.hh"
#include "base/tool_main.hh"
#include "files/csv_table.hh"
#include "files/domain.hh"
#include "files/run_file.hh"
#include "solver/runner.hh"
#include "solver/simulation.hh"

namespace {

using namespace lgiw;

struct Options {
  std::string particles, output, case_file, summary, diagnostics, xmf;
  std::vector<std::string> overrides;
  std::string backend;
  int threads = 0;
  bool resume = false, dry_run = false;
  double rate = 0;
  CommonOptions common;
};

void write_diagnostics(const std::string& run, const std::string& path, bool overwrite) {
  const auto columns = RunReader(run).diagnostics();
  std::vector<std::string> header{"time"};
  for (const auto& [name, values] : columns)
    if (name != "time") header.push_back(name);
  CsvTable table(header);
  const std::size_t rows = columns.count("time") ? columns.at("time").size() : 0;
  for (std::size_t row = 0; row < rows; ++row)
    for (const std::string& name : header) table.add(columns.at(name)[row]);
  write_text_file(path, table.text(), overwrite);
}

/// What the particles were made from cannot be changed any more.
void refuse_geometry(const Case& c, const ParticleHeader& header, const std::string& particles) {
  LGIW_VALIDATE(c.dimension == header.dimension && c.dp == header.dp, "the case does not fit " + particles,
                "its dimension or particle spacing is another", "make the particles again with dem2particles");
  if (header.case_text.empty()) return;
  const std::string key = differing_geometry(parse_case(header.case_text, particles + " (case)"), c);
  LGIW_VALIDATE(key.empty(), "the case does not fit " + particles, key + " is not what the particles were made with",
                "give it to dem2particles");
}

int run(const Options& o, int argc, char** argv) {
  LGIW_VALIDATE(o.dry_run || !o.output.empty(), "no output file is named", "the run has to go somewhere",
                "use -o RUN.h5");
  LGIW_VALIDATE(o.output != "-", "a run cannot go to standard output", "HDF5 files need a seekable file",
                "use -o RUN.h5");
  std::vector<std::string> outputs{o.output, o.summary, o.diagnostics, o.xmf}, inputs{o.particles};
  if (!o.case_file.empty() && o.case_file != "-") inputs.push_back(o.case_file);
  check_outputs(outputs, inputs, o.common.overwrite, o.common.json || o.dry_run);
  if (o.threads > 0) omp_set_num_threads(o.threads);
  const ParticleData data = read_particles(o.particles);
  std::vector<std::string> overrides = o.overrides;
  if (!o.backend.empty()) overrides.push_back("numerics.backend=" + o.backend);
  const Case c = o.case_file.empty() ? parse_case(data.header.case_text, o.particles + " (case)", overrides)
                                     : read_case(o.case_file, overrides);
  refuse_geometry(c, data.header, o.particles);
  check_inside(data.header, c.gauges, c.sections);
  LGIW_VALIDATE(data.header.counts.water + data.header.counts.soil > 0, o.particles + " holds nothing that moves",
                "it has neither water nor soil particles", "check water.level, water.seed and slide of the case");
  if (o.threads == 0 && c.numerics.threads > 0) omp_set_num_threads(c.numerics.threads);
  if (o.dry_run) {
    std::cout << plan_json(c, data, o.rate) << "\n";
    return 0;
  }

  Provenance provenance{"lgiw-run", version_string(), command_line(argc, argv), {}, o.common.provenance};
  provenance.add_input(o.particles);
  if (!o.case_file.empty()) provenance.add_input(o.case_file);
  Progress progress(o.common.show_progress(), "lgiw-run");
  RunOptions options;
  options.output = o.output;
  options.overwrite = o.common.overwrite, options.resume = o.resume, options.provenance = o.common.provenance;
  options.provenance_json = provenance.to_json();
  options.progress = [&](double fraction, const std::string& note) { progress.update(fraction, note); };
  if (!o.common.quiet)
    options.log = [](const std::string& line) { std::fprintf(stderr, "lgiw-run: %s\n", line.c_str()); };
  std::string summary;
  try {
    summary = run_case(c, data, options);
  } catch (const Interrupted& i) {
    if (!o.common.quiet)
      std::fprintf(stderr, "lgiw-run: stopped by signal %d; the state is in %s: go on with --resume\n", i.signal,
                   checkpoint_path(o.output).c_str());
    return 128 + i.signal;
  }
  if (!o.summary.empty()) write_text_file(o.summary, summary + "\n", o.common.overwrite);
  if (!o.diagnostics.empty()) write_diagnostics(o.output, o.diagnostics, o.common.overwrite);
  if (!o.xmf.empty()) write_xdmf(o.output, o.xmf, o.common.overwrite);
  if (o.common.json) std::cout << summary << "\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  wait_briefly(argv);
  CLI::App app(
      "Runs the soil-water SPH simulation of a particles file and writes frames, surfaces, maxima and diagnostics.",
      "lgiw-run");
  Options o;
  app.add_option("particles", o.particles, "Particles file, as dem2particles writes it")
      ->required()
      ->type_name("PARTICLES.h5");
  app.add_option("-o,--output", o.output, "Run file to write (VTKHDF)")->type_name("FILE");
  app.add_option("--case", o.case_file,
                 "Case file in place of the one inside the particles file (same dimension and spacing)")
      ->type_name("FILE");
  app.add_option("--set", o.overrides, "Override a key of the case, e.g. --set soil.friction_angle=25; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--backend", o.backend, "Where to run; auto: a CUDA device where there is one")
      ->type_name("NAME")
      ->check(CLI::IsMember({"auto", "cpu", "cuda"}));
  app.add_option("--threads", o.threads, "OpenMP threads; 0: all")->type_name("NUMBER")->check(CLI::Range(0, 1024));
  app.add_flag("--resume", o.resume, "Go on from the checkpoint beside the output");
  app.add_flag("--dry-run", o.dry_run, "Print particle counts, time step, steps and run time as JSON; start nothing");
  app.add_option("--rate", o.rate, "Particle-steps a second that --dry-run assumes")
      ->type_name("NUMBER")
      ->check(above_zero);
  app.add_option("--summary", o.summary, "Summary as JSON")->type_name("FILE");
  app.add_option("--diagnostics", o.diagnostics,
                 "Table of energies, momentum, speeds and time steps against time (CSV; - is stdout)")
      ->type_name("FILE");
  app.add_option("--xmf", o.xmf, "Xdmf sidecar of the run for ParaView before 5.12")->type_name("FILE");
  std::string cuda;
  add_common_options(app, o.common, std::string("CUDA backend: ") + (cuda_available(&cuda) ? "yes" : cuda));
  app.footer(
      "Environment:\n  LGIW_INSTRUCTIONS           Vector instructions of the CPU: baseline, avx2 or avx512; otherwise "
      "the widest\n\n"
      "Examples:\n  $ lgiw-run particles.h5 --dry-run\n"
      "  $ lgiw-run particles.h5 -o run.h5 --summary run.json --diagnostics diagnostics.csv\n"
      "  $ lgiw-run particles.h5 -o run.h5 --resume");
  return tool_main(app, argc, argv, [&] { return run(o, argc, argv); });
}
