#include "seeding/run_estimate.hh"

#include <algorithm>
#include <cmath>

#include "seeding/initial_state.hh"

namespace lgiw {

double default_particle_rate(int dimension) { return dimension == 2 ? 5e6 : 1.5e6; }

double soil_sound_speed(const Case& c) {
  if (!c.has_soil()) return 0;
  const double e = c.soil.young_modulus, nu = c.soil.poisson_ratio;
  const double bulk = e / (3 * (1 - 2 * nu)), shear = e / (2 * (1 + nu));
  return std::sqrt((bulk + 4 * shear / 3) / c.soil.density);
}

RunEstimate estimate_run(const Case& c, const SeedingReport& report, double sound_speed, double rate) {
  RunEstimate estimate;
  const double h = c.numerics.h_over_dp * c.dp, fastest = std::max(sound_speed, soil_sound_speed(c));
  const double speed = 0.1 * (sound_speed > 0 ? sound_speed : fastest);
  estimate.time_step =
      c.numerics.cfl * std::min(std::sqrt(h / vertical_gravity(c)), h / std::max(fastest + speed, 1e-9));
  estimate.steps = std::ceil((c.output.end_time + c.numerics.settle_time) / estimate.time_step);
  estimate.run_time = estimate.steps * double(report.counts.total()) / rate;

  // Numbers held per particle: positions (at their own precision), the other fields, and indices of 4 bytes.
  const double d = c.dimension, position = c.numerics.precision == Precision::single_ ? 4 : 8;
  const double number = c.numerics.precision == Precision::double_ ? 8 : 4, stresses = c.dimension == 2 ? 4 : 6;
  const double water = 2 * position * d + number * (3 * d + 4) + 16;
  const double soil = 2 * position * d + number * (3 * d + 2 * stresses + 4) + 16;
  const double wall = number * (2 * d + 4 + (c.has_soil() ? d + stresses : 0)) + 4;
  estimate.memory_bytes =
      double(report.counts.water) * water + double(report.counts.soil) * soil + double(report.counts.wall) * wall + 6e7;
  return estimate;
}

}  // namespace lgiw
