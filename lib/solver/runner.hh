// A run from start to end: outputs, maxima, diagnostics, checkpoints, and what to do when something goes wrong.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "case/case.hh"
#include "files/particle_file.hh"
#include "solver/simulation.hh"

namespace lgiw {

struct RunOptions {
  std::string output;  // final name of the run file
  bool overwrite = false, resume = false, provenance = true;
  std::string provenance_json;                               // of this run
  std::function<void(double, const std::string&)> progress;  // fraction done, note
  std::function<void(const std::string&)> log;               // one line
  /// What stands between the run and its solver, where something does: tests make steps fail there.
  std::function<std::unique_ptr<Simulation>(std::unique_ptr<Simulation>)> wrap;
};

/// What a run would cost: counts, memory (of a simulation on the CPU, which is made but takes no step), time step,
/// steps, seconds at `particle_steps_per_s` (0: what run_estimate.hh holds for the threads in use), resolution,
/// warnings and the class of error to be expected.
std::string plan_json(const Case& c, const ParticleData& data, double particle_steps_per_s);

/// Runs a case. The run file grows under a hidden temporary name beside `output` and takes that name when it is
/// complete; checkpoints lie beside it as OUTPUT.checkpoint. Returns the summary as JSON. SIGINT, SIGTERM and SIGHUP end
/// the step, write a checkpoint and throw Interrupted. A particle in a state that is not finite or out of range throws
/// WorkError with its place and the last good checkpoint.
std::string run_case(const Case& c, const ParticleData& data, const RunOptions& options);

struct Interrupted {
  int signal;
};

std::string partial_path(const std::string& output);
std::string checkpoint_path(const std::string& output);

}  // namespace lgiw
