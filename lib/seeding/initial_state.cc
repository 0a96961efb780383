#include "seeding/initial_state.hh"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lgiw {

double vertical_gravity(const Case& c) { return std::abs(c.gravity[2]); }

double water_sound_speed(const Case& c, double max_depth, double drop_height, double body_speed) {
  if (!c.water.present) return 0;
  if (c.water.sound_speed > 0) return c.water.sound_speed;
  const double g = vertical_gravity(c), wave_speed = std::sqrt(g * std::max(max_depth, c.dp));
  double slide_speed = body_speed;
  if (c.has_soil()) {
    const double friction = std::tan(c.soil.friction_angle * std::numbers::pi / 180);
    slide_speed = std::max({slide_speed, std::sqrt(2 * g * std::max(drop_height, 0.0) * std::max(1 - friction, 0.0)),
                            std::hypot(c.slide.velocity[0], c.slide.velocity[1], c.slide.velocity[2])});
  }
  return 10 * std::max(2 * wave_speed, std::min(slide_speed, 3 * wave_speed));
}

double water_density(double pressure, double reference_density, double sound_speed) {
  return reference_density * std::pow(1 + 7 * pressure / (sound_speed * sound_speed * reference_density), 1.0 / 7.0);
}

std::array<double, 6> k0_stress(const Case& c, double depth, double top_pressure, double pore_pressure) {
  const double k0 = 1 - std::sin(c.soil.friction_angle * std::numbers::pi / 180);
  const double vertical = top_pressure + c.soil.density * vertical_gravity(c) * depth;  // compression
  const double horizontal = k0 * std::max(vertical - pore_pressure, 0.0) + std::min(pore_pressure, vertical);
  return {-horizontal, -horizontal, -vertical, 0, 0, 0};
}

}  // namespace lgiw
