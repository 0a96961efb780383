// Soil-water interface (physics.md section 7): pressure and viscosity between the phases, and the soft repulsion.
#pragma once

#include "physics/water.hh"

namespace lgiw {

/// The repulsive force of Liu et al. 2012, Eqs. (18)-(20), with the value 0.5 at the point left undefined.
template <class T>
struct SoftRepulsion {
  T strength;               // 0.01 c_w^2, m2/s2; 0 leaves it out
  T inverse_dp, eta_scale;  // 1/dp, 2/h
  SoftRepulsion() = default;
  SoftRepulsion(bool on, double sound_speed, double dp, double h)
      : strength(on ? T(0.01 * sound_speed * sound_speed) : T(0)), inverse_dp(T(1 / dp)), eta_scale(T(2 / h)) {}

  /// Acceleration of the water particle divided by r_ws, 1/s2.
  LGIW_FN T operator()(T r, T r2) const {
    const T eta = r * eta_scale;
    const T inner = eta <= T(2.0 / 3) ? T(2.0 / 3) : eta * (2 - T(1.5) * eta);
    const T outer_root = largest(T(0), 2 - eta);
    const T shape = eta < 1 ? inner : T(0.5) * outer_root * outer_root;
    return strength * largest(T(0), 1 - r * inverse_dp) * shape / largest(r2, T(1e-12) / (inverse_dp * inverse_dp));
  }
};

/// Acceleration of a water particle by a soil particle, per unit of r_ws, Eq. (15) with (18). The soil particle
/// receives -m_w/m_s times the same (Eq. (17) with its sign mended): momentum is exchanged exactly.
template <class T>
struct InterfacePair {
  T water_mass;
  SoftRepulsion<T> repulsion;

  /// d = |r_ws|, f = W'/r, Pi of the artificial viscosity of the pair, p/rho^2 of water and of the water image at the
  /// soil particle.
  LGIW_FN T operator()(const Distance<T>& d, T f, T viscous, T water_term, T image_term) const {
    return -water_mass * (water_term + image_term + viscous) * f + repulsion(d.r, d.square);
  }
};

}  // namespace lgiw
