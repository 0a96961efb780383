// Disordered particles of all phases, all moving: where no term of the equations is zero.
#pragma once

#include <random>

#include "solver/simulation.hh"

namespace lgiw::test {

struct CloudOptions {
  int dimension = 2;
  bool walls = true, cubic = false, paper = false, gravity = true, pore = true, bodies = false;
  bool coulomb = false, corrected = false, verlet = false;
};

struct Cloud {
  ModelParameters p;
  InitialParticles in;
};

/// Constant linear and angular acceleration: displacement (m) and pitch (rad) at time t.
inline std::array<double, 4> body_motion(double t) {
  return {0.3 * t + 0.8 * t * t, 0, -0.2 * t + 1.1 * t * t, 0.5 * t - 0.9 * t * t};
}
inline PrescribedMotion motion_of_the_body(int dimension) {
  PrescribedMotion m;
  m.pivot = {1.0, 0.2, 0.4};
  if (dimension == 3) m.ahead = {0.6, 0.8};
  for (double t : {-0.5, 0.3, 1.0}) {
    const auto value = body_motion(t);
    m.rows.push_back({t,
                      {value[0], value[1], value[2], value[3]},
                      {0.3 + 1.6 * t, 0, -0.2 + 2.2 * t, 0.5 - 1.8 * t},
                      {1.6, 0, 2.2, -1.8}});
  }
  return m;
}

/// A disordered block: soil in the lower half, water above, walls around, everything moving. Lengths of order dp = 0.1
/// m.
inline Cloud cloud(const CloudOptions& o) {
  Cloud s;
  ModelParameters& p = s.p;
  p.dimension = o.dimension, p.dp = 0.1, p.h = 0.15;
  p.gravity = o.gravity ? std::array<double, 3>{0.5, 0, -9.7} : std::array<double, 3>{0, 0, 0};
  p.cubic_kernel = o.cubic, p.verlet = o.verlet;
  p.sound_speed = 40, p.water_alpha = 0.05, p.water_slips = !o.paper, p.density_diffusion = o.paper ? 0 : 0.1;
  p.soil_density = 1900, p.young_modulus = 2e6, p.friction = 0.45, p.cohesion = 50, p.dilatancy = 0.1;
  p.soil_alpha = 0.2, p.stress_diffusion = o.paper ? 0 : 0.1, p.artificial_stress = o.paper ? 0.5 : 0;
  p.return_mapping = !o.paper, p.wall_viscosity = !o.paper;
  p.k0 = 1 - std::sin(p.friction), p.pore_gradient = o.pore ? 9810 : 0;
  p.velocity_factor = o.paper ? 2 : 1, p.image_gravity = !o.paper;
  p.still_water_level = 0.9;
  p.low = {-1, -1, -1}, p.high = {3, 3, 3};
  p.free_slip_sides = true, p.coulomb_bed = o.coulomb, p.corrected_strain_rate = o.corrected;
  p.bed_friction = 0.3;
  if (o.bodies) p.bodies = {motion_of_the_body(o.dimension)};

  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  const int n = o.dimension == 2 ? 12 : 7, ny = o.dimension == 2 ? 1 : 5;
  for (int k = -3; k < n; ++k)
    for (int j = o.dimension == 2 ? 0 : -3; j < (o.dimension == 2 ? 1 : ny + 3); ++j)
      for (int i = -3; i < n + 3; ++i) {
        const bool inside = i >= 0 && i < n && k >= 0 && j >= 0 && j < ny;
        if (!inside && !o.walls) continue;
        const double jitter = inside ? 0.02 : 0;
        const double x = 0.1 * i + 0.05 + jitter * u(random), z = 0.1 * k + 0.05 + jitter * u(random);
        const double y = o.dimension == 2 ? 0 : 0.1 * j + 0.05 + jitter * u(random);
        if (!inside) {
          s.in.wall_x.insert(s.in.wall_x.end(), {x, y, z});
          const bool bed = k < 0;
          const float side = i < 0 ? 1.f : -1.f;
          if (bed)
            s.in.wall_normal.insert(s.in.wall_normal.end(), {0.f, 0.f, 1.f});
          else
            s.in.wall_normal.insert(s.in.wall_normal.end(), {side, 0.f, 0.f});
          s.in.wall_volume.push_back(float(std::pow(0.1, o.dimension) * (1 + 0.2 * u(random))));
          s.in.wall_kind.push_back(bed ? 0 : 1);
          if (o.bodies) s.in.wall_body.push_back(i >= n ? 1 : 0);  // the east wall and the bed below it move
        } else if (2 * k < n) {
          s.in.soil_x.insert(s.in.soil_x.end(), {x, y, z});
          for (int c = 0; c < 3; ++c) s.in.soil_v.push_back(o.dimension == 2 && c == 1 ? 0 : float(0.3 * u(random)));
          for (int c = 0; c < 6; ++c) {
            const bool zero = o.dimension == 2 && (c == 3 || c == 4);
            s.in.soil_stress.push_back(zero ? 0 : float(c < 3 ? -20000 + 6000 * u(random) : 5000 * u(random)));
          }
        } else {
          s.in.water_x.insert(s.in.water_x.end(), {x, y, z});
          for (int c = 0; c < 3; ++c) s.in.water_v.push_back(o.dimension == 2 && c == 1 ? 0 : float(0.3 * u(random)));
          s.in.water_excess.push_back(float(0.5 + 2.5 * u(random)));  // also below the reference density
        }
      }
  return s;
}

}  // namespace lgiw::test
