#include "solver/make_setup.hh"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "physics/kernel.hh"
#include "physics/soil.hh"
#include "physics/water.hh"
#include "seeding/run_estimate.hh"

namespace lgiw {
namespace {

constexpr double degree = pi / 180;

/// Greatest height of a column of soil particles, one dp wide, m.
double greatest_soil_height(const ParticleBlock& soil, double dp) {
  std::map<std::pair<long, long>, std::pair<double, double>> columns;
  for (std::size_t i = 0; i < soil.size(); ++i) {
    const double z = soil.points[3 * i + 2];
    auto [it, first] = columns.try_emplace(
        {std::lround(std::floor(soil.points[3 * i] / dp)), std::lround(std::floor(soil.points[3 * i + 1] / dp))}, z, z);
    if (!first) it->second = {std::min(it->second.first, z), std::max(it->second.second, z)};
  }
  double height = 0;
  for (const auto& [column, range] : columns) height = std::max(height, range.second - range.first + dp);
  return height;
}

/// Of the water, m/s: the case's own, which may be overridden, or the automatic one of the particles file.
double sound_speed(const Case& c, const ParticleHeader& header) {
  return c.water.sound_speed > 0 ? c.water.sound_speed : header.sound_speed;
}

/// Longest edge of the box around the particles, m.
double greatest_extent(const ParticleBlock& soil) {
  double extent = 0;
  for (int k = 0; k < 3; ++k) {
    double low = soil.points[k], high = low;
    for (std::size_t i = k; i < soil.points.size(); i += 3)
      low = std::min(low, soil.points[i]), high = std::max(high, soil.points[i]);
    extent = std::max(extent, high - low);
  }
  return extent;
}

double greatest_water_depth(const ParticleData& data) {
  double lowest = data.header.still_water_level;
  for (std::size_t i = 0; i < data.water.size(); ++i) lowest = std::min(lowest, data.water.points[3 * i + 2]);
  return data.water.size() ? data.header.still_water_level - lowest + 0.5 * data.header.dp : 0;
}

/// Derivative of values at times, second order within and first order at the ends.
void differentiate(std::vector<MotionRow>& rows, double (MotionRow::*of)[4], double (MotionRow::*to)[4]) {
  const std::size_t n = rows.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, n - 1);
    for (int k = 0; k < 4; ++k) {
      const auto slope = [&](std::size_t a, std::size_t b) {
        return ((rows[b].*of)[k] - (rows[a].*of)[k]) / (rows[b].time - rows[a].time);
      };
      if (before == i || after == i) {
        (rows[i].*to)[k] = after > before ? slope(before, after) : 0;
      } else {
        const double left = rows[i].time - rows[before].time, right = rows[after].time - rows[i].time;
        (rows[i].*to)[k] = (right * slope(before, i) + left * slope(i, after)) / (left + right);
      }
    }
  }
}

/// z up to which walls stand along each side, far below without any.
std::array<double, 4> tops_of_sides(const ParticleData& data) {
  std::array<double, 4> top{-1e300, -1e300, -1e300, -1e300};
  const auto& header = data.header;
  for (std::size_t i = 0; i < data.wall.kind.size(); ++i) {
    if (data.wall.kind[i] != 1) continue;
    const double* x = &data.wall.points[3 * i];
    for (std::size_t side = 0; side < 4; ++side) {
      const std::size_t axis = side / 2;
      const bool beyond = side % 2 ? x[axis] > header.high[axis] : x[axis] < header.low[axis];
      if (beyond) top[side] = std::max(top[side], x[2] + 0.5 * header.dp);
    }
  }
  return top;
}

}  // namespace

PrescribedMotion prescribed_motion(const BodyMotion& motion) {
  PrescribedMotion p;
  p.pivot = motion.pivot;
  p.ahead = {std::sin(motion.heading * degree), std::cos(motion.heading * degree)};
  for (std::size_t i = 0; i < motion.time.size(); ++i) {
    const auto& d = motion.displacement[i];
    p.rows.push_back({motion.time[i], {d[0], d[1], d[2], motion.pitch[i]}, {}, {}});
  }
  differentiate(p.rows, &MotionRow::value, &MotionRow::rate);
  differentiate(p.rows, &MotionRow::rate, &MotionRow::rate2);
  return p;
}

NumberType number_type(Precision precision) {
  switch (precision) {
    case Precision::single_:
      return NumberType::single_;
    case Precision::double_:
      return NumberType::double_;
    default:
      return NumberType::mixed;
  }
}

ModelParameters make_model(const Case& c, const ParticleData& data) {
  const ParticleHeader& header = data.header;
  ModelParameters p;
  p.dimension = header.dimension;
  p.dp = header.dp, p.h = c.numerics.h_over_dp * header.dp;
  p.gravity = c.gravity;
  p.cubic_kernel = c.numerics.kernel == KernelName::cubic;
  p.verlet = c.numerics.integrator == Integrator::verlet;
  p.cfl = c.numerics.cfl;
  const double g = std::hypot(c.gravity[0], c.gravity[1], c.gravity[2]);
  const bool water = data.water.size() > 0, soil = data.soil.size() > 0;
  p.water_density = c.water.density;
  if (water) {
    p.sound_speed = sound_speed(c, header);
    p.water_alpha = c.water.viscosity_alpha, p.water_slips = !c.water.no_slip;
    p.density_diffusion = c.water.density_diffusion;
    p.shifting = c.numerics.shifting;
    p.water_depth = greatest_water_depth(data);
    p.still_water_level = header.still_water_level;
  }
  if (soil) {
    const Soil& s = c.soil;
    p.soil_density = s.density, p.young_modulus = s.young_modulus, p.poisson_ratio = s.poisson_ratio;
    p.friction = s.friction_angle * degree, p.dilatancy = s.dilatancy_angle * degree, p.cohesion = s.cohesion;
    p.cone = int(s.cone == ConeMatching::plane_strain       ? Cone::plane_strain
                 : s.cone == ConeMatching::compression_cone ? Cone::compression
                                                            : Cone::plane_strain_associated);
    p.stress_diffusion = s.stress_diffusion, p.artificial_stress = s.artificial_stress;
    p.return_mapping = c.numerics.return_mapping, p.wall_viscosity = c.numerics.wall_viscosity;
    p.corrected_strain_rate = c.numerics.corrected_strain_rate;
    if (s.rate.present) {
      p.friction_fast = s.rate.friction_angle_fast * degree, p.inertial_number = s.rate.inertial_number;
      p.grain_diameter = s.rate.grain_diameter, p.grain_density = s.rate.grain_density;
    }
    p.k0 = 1 - std::sin(p.friction);
    if (water && s.pore_pressure == PorePressure::hydrostatic) p.pore_gradient = c.water.density * g;
    p.coulomb_bed = s.bed == WallFriction::coulomb, p.free_slip_bed = s.bed == WallFriction::free_slip;
    p.coulomb_sides = s.sides == WallFriction::coulomb, p.free_slip_sides = s.sides == WallFriction::free_slip;
    p.bed_friction = std::tan(s.bed_friction_angle * degree);
    const double wave = SoilMaterial<double>::wave_speed(s.young_modulus, s.poisson_ratio, s.density);
    p.soil_height = greatest_soil_height(data.soil, header.dp);
    p.settle_soil = s.initial_stress == InitialStress::settled;
    const double extent = std::max(greatest_extent(data.soil), header.dp);
    p.soil_settle_rate = pi * wave / extent;
    if (p.settle_soil) p.settle_time = 5 * extent / wave;
    p.soil_alpha = s.viscosity_alpha > 0 ? s.viscosity_alpha : usual_soil_alpha(g, p.soil_height, wave);
  }
  p.velocity_factor = c.interface.velocity_factor;
  p.repulsion = c.interface.repulsion;
  p.image_gravity = c.numerics.scheme != "huang2023";
  p.low = header.low, p.high = header.high;
  p.side_at = {header.low[0], header.high[0], header.low[1], header.high[1]};
  p.side_top = tops_of_sides(data);
  p.absorbing_width = header.absorbing_width;
  bool any_absorbing = false;
  for (int side = 0; side < 4; ++side) {
    p.absorbing[side] = header.sides[side] == Side::absorbing && (header.dimension == 3 || side < 2);
    any_absorbing = any_absorbing || p.absorbing[side];
  }
  if (any_absorbing && water) p.absorbing_rate = 9 * std::sqrt(g * p.water_depth) / p.absorbing_width;
  p.settle_rate = std::sqrt(g / p.dp);
  if (c.numerics.settle_time > 0) p.settle_time = c.numerics.settle_time;
  for (const BodyMotion& motion : header.bodies) p.bodies.push_back(prescribed_motion(motion));
  return p;
}

InitialParticles make_particles(const Case& c, const ParticleData& data) {
  InitialParticles in;
  in.water_x = data.water.points, in.soil_x = data.soil.points, in.wall_x = data.wall.points;
  in.soil_stress = data.soil.stress;
  in.wall_normal = data.wall.normal, in.wall_volume = data.wall.volume, in.wall_kind = data.wall.kind;
  in.wall_body = data.wall.body;
  in.water_v = data.water.velocity, in.soil_v = data.soil.velocity;
  // From the pressure, whose single precision is finer than that of the density.
  const EquationOfState<double> eos(c.water.density, sound_speed(c, data.header));
  in.water_excess.reserve(data.water.size());
  for (float pressure : data.water.pressure) in.water_excess.push_back(float(eos.excess(double(pressure))));
  return in;
}

}  // namespace lgiw
