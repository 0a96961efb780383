// What a simulation is made from, in double precision and without a backend: parameters of the model and initial
// particles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "physics/rigid_motion.hh"

namespace lgiw {

/// A rigid body that moves as prescribed.
struct PrescribedMotion {
  std::array<double, 3> pivot{};      // m, at t = 0
  std::array<double, 2> ahead{1, 0};  // unit vector in plan: a positive pitch lowers this side
  std::vector<MotionRow> rows;        // at least one
};

/// The model of a case in numbers, SI units, angles in radians. make_setup() fills it from a case.
struct ModelParameters {
  int dimension = 3;
  double dp = 0, h = 0;
  std::array<double, 3> gravity{0, 0, -9.81};  // 2-D: x and z are used
  double water_depth = 0, soil_height = 0;     // m: the deepest water and the highest column of soil at the start
  bool cubic_kernel = false;
  bool verlet = false;
  double cfl = 0.6;
  // Water.
  double water_density = 1000, sound_speed = 0, water_alpha = 0, density_diffusion = 0;
  bool water_slips = true;  // along walls
  double shifting = 0;      // A of particle shifting
  // Soil.
  double soil_density = 0, young_modulus = 0, poisson_ratio = 0.3, friction = 0, cohesion = 0, dilatancy = 0;
  int cone = 0;  // Cone
  double soil_alpha = 0, stress_diffusion = 0, artificial_stress = 0;
  bool return_mapping = true, wall_viscosity = true, corrected_strain_rate = false;
  double friction_fast = 0;  // friction angle of mu(I) at infinite shear rate; 0: strength independent of the rate
  double inertial_number = 0, grain_diameter = 0, grain_density = 0;
  double k0 = 1;
  double pore_gradient = 0;  // rho0 g of the pore water, Pa/m; 0: none
  bool coulomb_bed = false, coulomb_sides = false, free_slip_bed = false, free_slip_sides = true;
  double bed_friction = 0;  // tan(delta) of Coulomb walls
  // Interface.
  double velocity_factor = 1;
  bool repulsion = true, image_gravity = true;
  // Domain.
  double still_water_level = 0;
  std::array<double, 3> low{}, high{};
  std::array<bool, 4> absorbing{};  // west, east, south, north
  std::array<double, 4> side_at{};  // their coordinates
  // up to where walls stand there, z in m
  std::array<double, 4> side_top{-1e300, -1e300, -1e300, -1e300};
  double absorbing_width = 0, absorbing_rate = 0;  // m, 1/s at the side itself
  double settle_rate = 0, soil_settle_rate = 0;    // 1/s: damping of water and soil while settling
  double settle_time = 0;                          // s
  bool settle_soil = false;
  std::vector<PrescribedMotion> bodies;
};

/// Particles in the order of the particles file; all [n] or [n][...] row by row.
struct InitialParticles {
  std::vector<double> water_x, soil_x, wall_x;  // [n,3]
  std::vector<float> water_excess;              // rho - rho0
  std::vector<float> soil_stress;               // [n,6] xx yy zz xy yz xz
  std::vector<float> wall_normal, wall_volume;  // [n,3], [n]
  std::vector<uint8_t> wall_kind;
  std::vector<uint8_t> wall_body;      // [n]: 0 stands still, k moves with ModelParameters::bodies[k-1]; empty: all 0
  std::vector<float> water_v, soil_v;  // [n,3], or empty: at rest
  std::size_t n_water() const { return water_x.size() / 3; }
  std::size_t n_soil() const { return soil_x.size() / 3; }
  std::size_t n_wall() const { return wall_x.size() / 3; }
  /// Wall particles of moving bodies.
  int n_moving() const {
    int n = 0;
    for (uint8_t b : wall_body) n += b > 0;
    return n;
  }
};

}  // namespace lgiw
