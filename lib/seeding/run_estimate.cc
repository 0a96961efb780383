#include "seeding/run_estimate.hh"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "physics/soil.hh"
#include "physics/time_step.hh"

namespace lgiw {

namespace {

/// Particle-steps a second and thread, walls included; measured on 2 cores with AVX-512, less a quarter for processors
/// with AVX2 only (docs/performance.md).
struct Rates {
  double water, with_soil;
};
constexpr Rates rates_2d{4.2e6, 3.0e6}, rates_3d{2.0e6, 1.5e6};

/// Errors measured with at least `particles` across the length that counts, coarsest first (docs/accuracy-table.md:
/// viroulet, tank, bui-column).
struct MeasuredError {
  double particles, error;
};
constexpr MeasuredError crest_by_slide_thickness[] = {{11, 0.06}, {22, 0.02}};
constexpr MeasuredError runout_by_slide_thickness[] = {{20, 0.1}, {40, 0.01}};  // without water
constexpr MeasuredError pressure_by_water_depth[] = {{10, 0.0084}, {20, 0.0049}, {40, 0.0042}};

template <std::size_t n>
std::optional<double> error_at(const MeasuredError (&table)[n], double particles) {
  std::optional<double> error;
  for (const MeasuredError& row : table)
    if (particles >= row.particles) error = row.error;
  return error;
}

template <std::size_t n>
std::string sentence(const MeasuredError (&table)[n], const std::string& what, double particles,
                     const std::optional<double>& error) {
  char text[200];
  if (error)
    std::snprintf(text, sizeof text, "%s within %.2g %%", what.c_str(), 100 * *error);
  else
    std::snprintf(text, sizeof text, "%s not measured below %g particles (here %.3g)", what.c_str(), table[0].particles,
                  particles);
  return text;
}

}  // namespace

double particle_rate(int dimension, bool soil, int threads) {
  const Rates& rates = dimension == 2 ? rates_2d : rates_3d;
  return threads * (soil ? rates.with_soil : rates.water);
}

ErrorClass expected_error(std::optional<double> slide_particles, std::optional<double> depth_particles) {
  ErrorClass e;
  std::string parts;
  if (slide_particles && !depth_particles) {
    e.runout = error_at(runout_by_slide_thickness, *slide_particles);
    parts += sentence(runout_by_slide_thickness, "run-out", *slide_particles, e.runout) + " (slide thickness)";
  } else if (slide_particles) {
    e.crest = error_at(crest_by_slide_thickness, *slide_particles);
    parts += sentence(crest_by_slide_thickness, "first crest", *slide_particles, e.crest) + " (slide thickness)";
  }
  if (depth_particles) {
    e.pressure = error_at(pressure_by_water_depth, *depth_particles);
    parts += (parts.empty() ? "" : "; ") + sentence(pressure_by_water_depth, "pressure", *depth_particles, e.pressure) +
             (e.pressure ? " of rho g H" : "") + " (water depth)";
  }
  e.text = "error to expect from what was measured: " + (parts.empty() ? "nothing to go by" : parts);
  return e;
}

double soil_sound_speed(const Case& c) {
  if (!c.has_soil()) return 0;
  return SoilMaterial<double>::wave_speed(c.soil.young_modulus, c.soil.poisson_ratio, c.soil.density);
}

double usual_soil_alpha(double gravity, double height, double wave_speed) {
  return 3 * std::sqrt(gravity * height) / wave_speed;
}

StepEstimate estimate_step(const Case& c, double sound_speed, double soil_height, double mu, double acceleration) {
  const double soil_speed = soil_sound_speed(c), wave = std::max(sound_speed, soil_speed);
  const double h = c.numerics.h_over_dp * c.dp;
  const bool verlet = c.numerics.integrator == Integrator::verlet;
  StepEstimate step{c.numerics.cfl * h / std::max(wave + mu, 1e-9), 0};
  const auto limit = [&step](double dt, int condition) {
    if (dt < step.dt) step = {dt, condition};
  };
  if (acceleration > 0) limit(c.numerics.cfl * std::sqrt(h / acceleration), 1);
  double viscous = c.water.viscosity_alpha * sound_speed, diffusive = c.water.density_diffusion * sound_speed;
  if (c.has_soil()) {
    const double g = std::hypot(c.gravity[0], c.gravity[1], c.gravity[2]);
    const double alpha =
        c.soil.viscosity_alpha > 0 ? c.soil.viscosity_alpha : usual_soil_alpha(g, soil_height, soil_speed);
    viscous = std::max(viscous, alpha * soil_speed);
    diffusive = std::max(diffusive, c.soil.stress_diffusion * soil_speed);
  }
  if (viscous > 0) limit(std::min(c.numerics.cfl, viscous_limit(verlet)) * h / viscous, 2);
  if (diffusive > 0) limit(diffusive_limit(verlet) * h / diffusive, 3);
  return step;
}

RunEstimate estimate_run(const Case& c, const ParticleCounts& counts, double sound_speed, double soil_height,
                         double rate, double soil_extent) {
  RunEstimate estimate;
  const double flow = 0.1 * (sound_speed > 0 ? sound_speed : soil_sound_speed(c));
  const double g = std::hypot(c.gravity[0], c.gravity[1], c.gravity[2]);
  estimate.time_step = estimate_step(c, sound_speed, soil_height, flow, g).dt;
  const bool soil_settles = counts.soil > 0 && c.soil.initial_stress == InitialStress::settled;
  // As lgiw-run has it (make_setup.cc): a time that is given wins.
  const double settling = c.numerics.settle_time > 0 ? c.numerics.settle_time
                          : soil_settles             ? 5 * std::max(soil_extent, c.dp) / soil_sound_speed(c)
                                                     : 0;
  estimate.steps = std::ceil((c.output.end_time + settling) / estimate.time_step);
  estimate.run_time = estimate.steps * double(counts.total()) / rate;

  // Numbers held per particle: positions (at their own precision), the other fields, and indices of 4 bytes.
  const double d = c.dimension, position = c.numerics.precision == Precision::single_ ? 4 : 8;
  const double number = c.numerics.precision == Precision::double_ ? 8 : 4, stresses = c.dimension == 2 ? 4 : 6;
  const double water = 2 * position * d + number * (3 * d + 4) + 16;
  const double soil = 2 * position * d + number * (3 * d + 2 * stresses + 4) + 16;
  const double wall = number * (2 * d + 4 + (counts.soil > 0 ? d + stresses : 0)) + 4;
  // As read (points in double, the rest in single), and of what moves two states kept and an output being made.
  const double read = 24 + 3 * 4, kept = c.numerics.retakes > 0 ? 2 : 0, output = 2 * 24 + 2 * 12 + 2 * 16;
  const double held_water = water * (1 + kept) + read + output, held_soil = soil * (1 + kept) + read + 24 + output;
  const double held_wall = wall + read + 3 * 4 + 1;
  estimate.memory_bytes =
      double(counts.water) * held_water + double(counts.soil) * held_soil + double(counts.wall) * held_wall + 3e7;
  return estimate;
}

}  // namespace lgiw
