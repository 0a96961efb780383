// Small 2-D scenes on a lattice, built here by hand so that the solver's tests do not lean on the seeding room.
#pragma once

#include <cmath>
#include <functional>
#include <memory>

#include "physics/soil.hh"
#include "physics/water.hh"
#include "solver/simulation.hh"

namespace lgiw::test {

constexpr double deg = 3.14159265358979323846 / 180;
constexpr double g = 9.81;

struct Scene {
  ModelParameters p;
  InitialParticles in;

  /// A plane-strain scene with the defaults of physics.md.
  Scene(double dp, double x0, double x1, double z0, double z1, double h_over_dp = 1.5) {
    p.dimension = 2;
    p.dp = dp, p.h = h_over_dp * dp;
    p.gravity = {0, 0, -g};
    p.low = {x0, 0, z0}, p.high = {x1, 0, z1};
  }
  using Test = std::function<bool(double, double)>;

  static void lattice(std::vector<double>& out, double dp, double x0, double x1, double z0, double z1, const Test& keep) {
    const long nx = std::lround((x1 - x0) / dp), nz = std::lround((z1 - z0) / dp);
    for (long k = 0; k < nz; ++k)
      for (long i = 0; i < nx; ++i) {
        const double x = x0 + (i + 0.5) * dp, z = z0 + (k + 0.5) * dp;
        if (keep(x, z)) out.insert(out.end(), {x, 0, z});
      }
  }
  /// Walls of lattice particles where keep() holds; the normal and kind come from `surface`: (x, z) -> {nx, nz, kind}.
  void walls(double x0, double x1, double z0, double z1, const Test& keep,
             const std::function<std::array<double, 3>(double, double)>& surface) {
    const std::size_t before = in.n_wall();
    lattice(in.wall_x, p.dp, x0, x1, z0, z1, keep);
    for (std::size_t i = before; i < in.n_wall(); ++i) {
      const auto s = surface(in.wall_x[3 * i], in.wall_x[3 * i + 2]);
      in.wall_normal.insert(in.wall_normal.end(), {float(s[0]), 0.f, float(s[1])});
      in.wall_kind.push_back(uint8_t(s[2]));
      in.wall_volume.push_back(float(p.dp * p.dp));
    }
  }
  /// A box open at the top: floor (kind 0) and side walls (kind 1), three or more layers.
  void box(double x0, double x1, double z0, double z1) {
    const double t = std::ceil(2 * p.h / p.dp - 1e-9) * p.dp;
    walls(x0 - t, x1 + t, z0 - t, z1, [=](double x, double z) { return x < x0 || x > x1 || z < z0; },
          [=](double x, double z) -> std::array<double, 3> {
            if (z < z0) return {0, 1, 0};
            return {x < x0 ? 1.0 : -1.0, 0, 1};
          });
  }
  /// Water at rest below `level`.
  void water(double level, double sound_speed, double alpha, const std::function<void(std::vector<double>&)>& place) {
    p.sound_speed = sound_speed, p.water_alpha = alpha, p.density_diffusion = 0.1;
    p.still_water_level = level;
    place(in.water_x);
    const EquationOfState<double> eos(p.water_density, sound_speed);
    for (std::size_t i = 0; i < in.n_water(); ++i)
      in.water_excess.push_back(float(eos.excess(p.water_density * g * (level - in.water_x[3 * i + 2]))));
  }
  void soil_material(double density, double e, double nu, double phi_deg, double cohesion) {
    p.soil_density = density, p.young_modulus = e, p.poisson_ratio = nu;
    p.friction = phi_deg * deg, p.cohesion = cohesion;
    p.k0 = 1 - std::sin(p.friction);
    p.stress_diffusion = 0.1;
  }
  double soil_wave_speed() const {
    return SoilMaterial<double>::wave_speed(p.young_modulus, p.poisson_ratio, p.soil_density);
  }
  /// Soil at rest under its own weight, a top at z = top(x) and water of depth over it where the level is higher.
  void soil(const std::function<void(std::vector<double>&)>& place, const std::function<double(double)>& top) {
    place(in.soil_x);
    for (std::size_t i = 0; i < in.n_soil(); ++i) {
      const double x = in.soil_x[3 * i], z = in.soil_x[3 * i + 2];
      const bool wet = in.n_water() > 0;
      const double above = wet ? std::max(0.0, p.water_density * g * (p.still_water_level - top(x))) : 0;
      const double pore = p.pore_gradient > 0 ? std::max(0.0, p.pore_gradient * (p.still_water_level - z)) : 0;
      const double vertical = -(above + p.soil_density * g * (top(x) - z));
      const double across = -(p.k0 * (-vertical - pore) + pore);
      in.soil_stress.insert(in.soil_stress.end(), {float(across), float(across), float(vertical), 0.f, 0.f, 0.f});
    }
  }
};

/// Kinetic, potential and compression energy (J) of the water and kinetic and potential of the soil.
inline double mechanical_energy(const ParticleState& s, const ModelParameters& p) {
  const double v = std::pow(p.dp, p.dimension), mw = p.water_density * v, ms = p.soil_density * v;
  double e = 0;
  auto add = [&](const std::vector<double>& x, const std::vector<float>& u, double m) {
    for (std::size_t i = 0; i < x.size() / 3; ++i)
      e += m * (g * x[3 * i + 2] + 0.5 * (u[3 * i] * u[3 * i] + u[3 * i + 2] * u[3 * i + 2]));
  };
  add(s.water_x, s.water_v, mw), add(s.soil_x, s.soil_v, ms);
  return e;
}

}  // namespace lgiw::test
