// What a run of a seeded case will take, before it is started.
#pragma once

#include "case/case.hh"
#include "seeding/seeding.hh"

namespace lgiw {

struct RunEstimate {
  double memory_bytes = 0;  // held by lgiw-run
  double time_step = 0;     // s
  double steps = 0;
  double run_time = 0;  // s
};

/// Particle-steps a second (all phases, walls included) of lgiw-run on a CPU of two cores, by dimension: what the
/// estimate assumes when nothing better is given.
double default_particle_rate(int dimension);

/// Elastic P-wave speed of the soil, sqrt((K + 4/3 G) / rho), m/s; 0 without a slide.
double soil_sound_speed(const Case& c);

/// Time step from physics.md section 9 with the largest speed to be expected (a tenth of the water's sound speed) for
/// mu: C min(sqrt(h/g), h/(max(c_w, c_s) + v)). `rate` in particle-steps a second. Memory from the fields that the
/// solver holds by phase and precision.
RunEstimate estimate_run(const Case& c, const SeedingReport& report, double sound_speed, double rate);

}  // namespace lgiw
