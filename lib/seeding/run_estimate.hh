// What a run will take, and what can be expected of it, before it is started.
#pragma once

#include <optional>
#include <string>

#include "case/case.hh"
#include "files/particle_file.hh"

namespace lgiw {

struct RunEstimate {
  double memory_bytes = 0;  // held by lgiw-run
  double time_step = 0;     // s
  double steps = 0;
  double run_time = 0;  // s
};

/// Particle-steps a second (all phases, walls included) of lgiw-run on `threads` of a CPU, by dimension and by whether
/// there is soil: what estimates assume when nothing better is given. Measured on 2 cores with both in use; many
/// threads that share a memory bus reach less than so many times as much.
double particle_rate(int dimension, bool soil, int threads);

/// Elastic P-wave speed of the soil, sqrt((K + 4/3 G) / rho), m/s; 0 without soil.
double soil_sound_speed(const Case& c);

/// Time step from physics.md section 9 with the largest speed to be expected (a tenth of the water's sound speed) for
/// mu: C min(sqrt(h/g), h/(max(c_w, c_s) + v)). `rate` in particle-steps a second. Memory from the fields that the
/// solver holds by phase and precision.
RunEstimate estimate_run(const Case& c, const ParticleCounts& counts, double sound_speed, double rate);

/// What was measured against a reference with at least so many particles across the slide's thickness or the deepest
/// water; absent where there are fewer than in any measurement, or nothing to count.
struct ErrorClass {
  std::optional<double> crest;     // of the wave's first crest, relative
  std::optional<double> runout;    // of a slide without water, relative
  std::optional<double> pressure;  // RMS at rest, relative to rho g H
  std::string text;                // one line
};
ErrorClass expected_error(std::optional<double> slide_particles, std::optional<double> depth_particles);

}  // namespace lgiw
