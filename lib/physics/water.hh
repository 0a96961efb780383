// Weakly compressible water (physics.md section 2): equation of state, continuity with density diffusion, momentum.
// The state variable is the excess density e = rho - rho0: single precision then resolves pressures far below those of
// one particle spacing of water.
#pragma once

#include "physics/vec.hh"

namespace lgiw {

/// Tait: p = c^2 rho0 / 7 ((rho/rho0)^7 - 1), Eq. (4).
template <class T>
struct EquationOfState {
  T rho0, stiffness;  // kg/m3, c^2 rho0 / 7 in Pa
  EquationOfState() = default;
  EquationOfState(double density, double sound_speed)
      : rho0(T(density)), stiffness(T(sound_speed * sound_speed * density / 7)) {}

  /// Pressure (Pa) at excess density e (kg/m3). (1 + s)^7 - 1 is expanded, since the subtraction would lose the digits.
  LGIW_FN T pressure(T e) const {
    const T s = e / rho0;
    return stiffness * s * (7 + s * (21 + s * (35 + s * (35 + s * (21 + s * (7 + s))))));
  }
  /// Excess density at pressure p. Two Newton steps on the expanded polynomial after the linear guess: the compressions
  /// of this model stay below a few per cent, where this is exact to rounding.
  LGIW_FN T excess(T p) const {
    const T y = p / stiffness;
    T s = y / (7 + 3 * y);
    for (int k = 0; k < 3; ++k) {
      const T f = s * (7 + s * (21 + s * (35 + s * (35 + s * (21 + s * (7 + s)))))) - y;
      const T s1 = 1 + s, s3 = s1 * s1 * s1;
      s -= f / (7 * s3 * s3);
    }
    return rho0 * s;
  }
};

/// d(rho_i)/dt from particle j: continuity, Eq. (1), and density diffusion without its hydrostatic part.
template <class T, int D>
struct WaterContinuity {
  T mass;                     // m_j, kg
  T diffusion;                // 2 delta h c_w, m2/s; 0 between unlike particles
  Vec<T, D> static_gradient;  // rho0 g / c_w^2: gradient of density at rest

  /// r = r_i - r_j, v = v_i - v_j, f = W'/r, e the excess densities, inverse_j = 1/rho_j in m3/kg.
  LGIW_FN T operator()(const Vec<T, D>& r, const Vec<T, D>& v, T f, T e_i, T e_j, T inverse_j) const {
    return mass * f * (dot(v, r) - diffusion * (e_j - e_i + dot(static_gradient, r)) * inverse_j);
  }
  /// Without diffusion.
  LGIW_FN T operator()(const Vec<T, D>& r, const Vec<T, D>& v, T f) const { return mass * f * dot(v, r); }
};

/// Particle shifting: particles drift from crowded to empty places with -A h |v| grad C, grad C = sum V_j grad W_ij
/// (Lind et al. 2012; Skillen et al. 2013). At a free surface, where grad C points outwards, it fades with the
/// divergence of position, div r = -sum V_j r_ij . grad W_ij, which is D inside and about D/2 to 2/3 D at the surface:
/// from full at D to none at D - 1/2 (2-D) and D - 1/4 (3-D).
template <class T, int D>
struct ParticleShifting {
  T strength = 0;  // A h, m
  T surface = T(D) - (D == 2 ? T(0.5) : T(0.25));
  ParticleShifting() = default;
  ParticleShifting(double a, double h) : strength(T(a * h)) {}

  /// Velocity (m/s) with which a particle of speed |v| drifts, for the gradient of concentration (1/m) and div r.
  LGIW_FN Vec<T, D> operator()(const Vec<T, D>& gradient, T divergence, T speed) const {
    const T inside = smallest(T(1), largest(T(0), (divergence - surface) / (T(D) - surface)));
    return (-strength * speed * inside) * gradient;
  }
};

/// What the artificial viscosity of a pair gives: mu_ij in m/s, also the velocity that limits the time step, and Pi_ij
/// in m5/(kg s2), zero for receding particles.
template <class T>
struct Viscous {
  T mu, pi;
};

/// Monaghan's artificial viscosity, Eq. (5).
template <class T, int D>
struct ArtificialViscosity {
  T alpha_c_h;   // alpha times sound speed times smoothing length, m2/s
  T h, epsilon;  // smoothing length, 0.01 h^2
  ArtificialViscosity() = default;
  ArtificialViscosity(double alpha, double sound_speed, double smoothing_length)
      : alpha_c_h(T(alpha * sound_speed * smoothing_length)),
        h(T(smoothing_length)),
        epsilon(T(0.01 * smoothing_length * smoothing_length)) {}

  /// mu_ij = h v.r / (r^2 + 0.01 h^2), Pi_ij = -alpha c min(mu_ij, 0) / rho_mean; one division for both.
  LGIW_FN Viscous<T> operator()(T vr, T r2, T rho_mean) const {
    const T both = 1 / ((r2 + epsilon) * rho_mean);
    return {h * vr * (rho_mean * both), -alpha_c_h * smallest(vr, T(0)) * both};
  }
};

/// v.r of a particle beside a wall particle, for the artificial viscosity: r from the wall particle, n the wall's
/// normal. A wall that slips resists only the motion along n: the artificial viscosity, alpha c h / 8, is thousands of
/// times that of water, and a no-slip wall with it drags down waves in depths of ten to twenty particles.
template <class T, int D>
LGIW_FN T approach_to_wall(const Vec<T, D>& v, const Vec<T, D>& r, const Vec<T, D>& n, T slip) {
  return (1 - slip) * dot(v, r) + slip * dot(v, n) * dot(n, r);
}

/// Walls push water and never pull it: p_i/rho_i^2 + p_w/rho_w^2 of a pair with a wall particle, or 0. Water that
/// leaves a wall has air behind it, which the model lacks. Where walls pull, thin sheets seep into them, and drops that
/// touched one are caught.
template <class T>
LGIW_FN T push_of_wall(T term, T wall_term) {
  return largest(T(0), term + wall_term);
}
/// The same for continuity: d(rho)/dt by all walls (kg/m3/s), less what would stretch water below its reference
/// density.
template <class T>
LGIW_FN T compression_by_walls(T rate, T excess) {
  return excess > 0 ? rate : largest(T(0), rate);
}

}  // namespace lgiw
