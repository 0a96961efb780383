// What a run will take, and what can be expected of it, before it is started.
#pragma once

#include <optional>
#include <string>

#include "case/case.hh"
#include "files/particle_file.hh"

namespace lgiw {

struct RunEstimate {
  double memory_bytes = 0;  // held by lgiw-run at its peak; on a device less
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

/// Coefficient of artificial viscosity of soil `height` m high where the case gives none (physics.md section 3).
double usual_soil_alpha(double gravity, double height, double wave_speed);

/// A time step, s, and which condition limits it: 0 acoustic, 1 force, 2 viscous, 3 diffusive.
struct StepEstimate {
  double dt;
  int limit;
};

/// What finish_step() of the solver (passes.hh) comes to. `sound_speed` of the water, m/s, 0 without any;
/// `soil_height`: of the highest column of soil, m; `mu`: the largest |mu_ij| of the artificial viscosity, m/s;
/// `acceleration`: the largest, m/s2.
StepEstimate estimate_step(const Case& c, double sound_speed, double soil_height, double mu, double acceleration);

/// Time step with the largest speed to be expected (a tenth of the water's sound speed) for mu and
/// gravity for the acceleration. `rate` in particle-steps a second; `soil_extent`, m, tells how long the soil settles
/// where its initial stress does. Memory from what lgiw-run holds by phase and precision: the fields of the solver, the
/// particles as read, two states to go back to, an output.
RunEstimate estimate_run(const Case& c, const ParticleCounts& counts, double sound_speed, double soil_height,
                         double rate, double soil_extent = 0);

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
