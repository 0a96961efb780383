// Elastoplastic soil (physics.md sections 3-5): Drucker-Prager constants, Jaumann rate, return mapping, rate form.
// Tension positive, total stress; p_f is the pore pressure that turns it into effective stress in the yield function.
#pragma once

#include "physics/tensor.hh"

namespace lgiw {

enum class Cone { plane_strain, plane_strain_associated, compression };

/// Elastic and Drucker-Prager constants.
template <class T>
struct SoilMaterial {
  T bulk, shear;  // K, G in Pa
  T alpha_phi, k_c, alpha_psi;

  SoilMaterial() = default;
  /// Angles in radians, E and c in Pa. The table of physics.md section 4.
  SoilMaterial(double young_modulus, double poisson_ratio, double friction, double cohesion, double dilatancy,
               Cone cone)
      : bulk(T(young_modulus / (3 * (1 - 2 * poisson_ratio)))), shear(T(young_modulus / (2 * (1 + poisson_ratio)))) {
    const double tan_phi = std::tan(friction), tan_psi = std::tan(dilatancy);
    const double sin_phi = std::sin(friction), sin_psi = std::sin(dilatancy), cos_phi = std::cos(friction);
    double a_phi, k, a_psi;
    switch (cone) {
      case Cone::plane_strain_associated:
        a_phi = tan_phi / std::sqrt(9 + 12 * tan_phi * tan_phi);
        k = 3 * cohesion / std::sqrt(9 + 12 * tan_phi * tan_phi);
        a_psi = tan_psi / std::sqrt(9 + 12 * tan_psi * tan_psi);
        break;
      case Cone::compression:
        a_phi = 2 * sin_phi / (std::sqrt(3.0) * (3 - sin_phi));
        k = 6 * cohesion * cos_phi / (std::sqrt(3.0) * (3 - sin_phi));
        a_psi = 2 * sin_psi / (std::sqrt(3.0) * (3 - sin_psi));
        break;
      default: {  // exact in plane strain for any dilatancy
        a_psi = tan_psi / std::sqrt(9 + 12 * tan_psi * tan_psi);
        const double beta = std::sqrt(1 - 3 * a_psi * a_psi);
        a_phi = sin_phi / (3 * (beta + a_psi * sin_phi));
        k = cohesion * cos_phi * (1 - 3 * a_phi * a_psi) / beta;
      }
    }
    alpha_phi = T(a_phi), k_c = T(k), alpha_psi = T(a_psi);
  }
  /// Speed of elastic compression waves, m/s.
  static double wave_speed(double young_modulus, double poisson_ratio, double density) {
    const double k = young_modulus / (3 * (1 - 2 * poisson_ratio)), g = young_modulus / (2 * (1 + poisson_ratio));
    return std::sqrt((k + 4 * g / 3) / density);
  }
};

/// sqrt(J2) and the deviator of a stress.
template <class T, int D>
struct Deviator {
  Stress<T, D> s;
  T i1, root_j2;
  LGIW_FN explicit Deviator(const Stress<T, D>& sigma) : s(sigma), i1(trace(sigma)) {
    add_isotropic(s, -i1 / 3);
    root_j2 = square_root(T(0.5) * double_contraction(s));
  }
};

/// f = sqrt(J2) + alpha_phi (I1 + 3 p_f) - k_c
template <class T>
LGIW_FN T yield_function(const SoilMaterial<T>& m, T i1, T root_j2, T pore_pressure) {
  return root_j2 + m.alpha_phi * (i1 + 3 * pore_pressure) - m.k_c;
}

/// Elastic rate of stress times dt with the Jaumann rate: sigma' = w sigma - sigma w + 2 G e' + K tr(eps') I.
/// l[a*D + b] = dv_a/dx_b in 1/s. In 2-D the out-of-plane strain rate is zero, its deviatoric part is not.
template <class T, int D>
LGIW_FN Stress<T, D> elastic_increment(const SoilMaterial<T>& m, const Stress<T, D>& sigma, const T* l, T dt) {
  T volumetric = l[0];
  for (int a = 1; a < D; ++a) volumetric += l[a * D + a];
  Stress<T, D> d;
  for (int a = 0; a < D; ++a)
    for (int b = a; b < D; ++b) {
      // w_ab = (l_ab - l_ba)/2 is antisymmetric: (w s - s w)_ab = sum_c w_ac s_cb + w_bc s_ca
      T rotation = 0;
      for (int c = 0; c < D; ++c)
        rotation += T(0.5) * ((l[a * D + c] - l[c * D + a]) * sigma.c[stress_index<D>(c, b)] +
                              (l[b * D + c] - l[c * D + b]) * sigma.c[stress_index<D>(c, a)]);
      d.c[stress_index<D>(a, b)] = dt * (rotation + m.shear * (l[a * D + b] + l[b * D + a]));
    }
  if (D == 2) d.c[Stress<T, D>::size - 1] = 0;
  add_isotropic(d, dt * (m.bulk - 2 * m.shear / 3) * volumetric);
  return d;
}

/// Takes the trial stress back by the plastic multiplier `lambda` along the flow direction of the cone; root_j2 >= 0 is
/// what then remains. Returns the increment of Adps.
template <class T, int D>
LGIW_FN T return_along_flow(const SoilMaterial<T>& m, const Deviator<T, D>& trial, T lambda, T root_j2,
                            Stress<T, D>& sigma) {
  const T i1 = trial.i1 - 9 * m.bulk * m.alpha_psi * lambda;
  const T scale = trial.root_j2 > 0 ? root_j2 / trial.root_j2 : T(0);
  for (int k = 0; k < Stress<T, D>::size; ++k) sigma.c[k] = scale * trial.s.c[k];
  add_isotropic(sigma, i1 / 3);
  return lambda * square_root(T(1.0 / 3) + 2 * m.alpha_psi * m.alpha_psi);
}

/// Return mapping (physics.md section 5). Brings the trial stress back to the cone or its apex and returns the
/// increment of Adps, the accumulated deviatoric plastic strain: int sqrt(2/3 deps_p : deps_p).
template <class T, int D>
LGIW_FN T return_mapping(const SoilMaterial<T>& m, Stress<T, D>& sigma, T pore_pressure) {
  const Deviator<T, D> trial(sigma);
  const T f = yield_function(m, trial.i1, trial.root_j2, pore_pressure);
  if (!(f > 0)) return 0;
  const T lambda = f / (m.shear + 9 * m.bulk * m.alpha_phi * m.alpha_psi);
  const T root_j2 = trial.root_j2 - m.shear * lambda;
  if (root_j2 >= 0) return return_along_flow(m, trial, lambda, root_j2, sigma);
  // Only a cone with friction has an apex; without it root_j2 = k_c >= 0 above.
  const T i1 = smallest(trial.i1, m.k_c / m.alpha_phi - 3 * pore_pressure);
  const T volumetric = (trial.i1 - i1) / (3 * m.bulk);
  for (int k = 0; k < Stress<T, D>::size; ++k) sigma.c[k] = 0;
  add_isotropic(sigma, i1 / 3);
  const T shear_part = trial.root_j2 / m.shear;
  return square_root(T(2.0 / 3) * (T(0.5) * shear_part * shear_part + volumetric * volumetric / 3));
}

/// Strength that grows with the rate of shearing: mu(I) = mu_s + (mu_2 - mu_s) / (I_0 / I + 1) with the inertial number
/// I = |gamma'| d sqrt(rho_g / p) (Jop, Forterre and Pouliquen, Nature 441, 2006, 727). On the Drucker-Prager cone mu
/// is 3 alpha_phi, sqrt(J2) over the effective mean pressure p; in plane strain without dilatancy sin(phi).
template <class T>
struct RateStrength {
  T extra_alpha = 0;  // alpha_phi of the fastest shearing less that of the slowest; 0: independent of the rate
  T threshold = 0;    // I_0 / (d sqrt(rho_g)): the shear rate at which half of it acts is threshold sqrt(p)

  RateStrength() = default;
  /// `slow` and `fast` are the same soil with the friction angles of either end; grain diameter in m, density in kg/m3.
  RateStrength(const SoilMaterial<double>& slow, const SoilMaterial<double>& fast, double inertial_number,
               double grain_diameter, double grain_density)
      : extra_alpha(T(fast.alpha_phi - slow.alpha_phi)),
        threshold(T(inertial_number / (grain_diameter * std::sqrt(grain_density)))) {}
};

/// Return mapping with mu(I), implicit in the plastic multiplier l: the shear rate is l / dt, so that
///   f_trial - H l = 3 (alpha_2 - alpha_s) p(l) l / (l + c),   p(l) = p + 3 K alpha_psi l,   c = dt threshold sqrt(p),
/// H = G + 9 K alpha_phi alpha_psi, a quadratic equation with one positive root at any dt. c takes the trial pressure.
template <class T, int D>
LGIW_FN T return_mapping(const SoilMaterial<T>& m, const RateStrength<T>& rate, Stress<T, D>& sigma, T pore_pressure,
                         T dt) {
  const Deviator<T, D> trial(sigma);
  const T pressure = -trial.i1 / 3 - pore_pressure;
  if (!(pressure > 0)) return return_mapping(m, sigma, pore_pressure);  // the apex knows no friction
  const T f = yield_function(m, trial.i1, trial.root_j2, pore_pressure);
  if (!(f > 0)) return 0;
  const T h = m.shear + 9 * m.bulk * m.alpha_phi * m.alpha_psi, extra = 3 * rate.extra_alpha;
  const T c = dt * rate.threshold * square_root(pressure);
  const T a = h + extra * 3 * m.bulk * m.alpha_psi, b = h * c + extra * pressure - f;
  const T root = square_root(b * b + 4 * a * f * c);
  const T lambda = b > 0 ? 2 * f * c / (b + root) : (root - b) / (2 * a);  // without cancellation
  return return_along_flow(m, trial, lambda, largest(T(0), trial.root_j2 - m.shear * lambda), sigma);
}

/// The paper's rate form, Eqs. (8)-(9), with lambda' >= 0, the drift correction and the apex shift that it needs
/// (physics.md section 5). sigma is the stress before the step, increment the elastic one over dt; returns the Adps
/// increment.
template <class T, int D>
LGIW_FN T rate_form_update(const SoilMaterial<T>& m, Stress<T, D>& sigma, const Stress<T, D>& increment, const T* l,
                           T dt, T pore_pressure) {
  const Deviator<T, D> old(sigma);
  const T scale = m.k_c + m.alpha_phi * (largest(T(0), -old.i1 - 3 * pore_pressure)) + m.shear * T(1e-7);
  const T tolerance = T(1e-3) * scale;
  const bool yields = yield_function(m, old.i1, old.root_j2, pore_pressure) >= -tolerance;
  for (int k = 0; k < Stress<T, D>::size; ++k) sigma.c[k] += increment.c[k];
  T adps = 0;
  if (yields && old.root_j2 > tolerance) {  // at the apex the deviator is rounding, which has any direction
    T volumetric = 0, s_eps = 0;
    for (int a = 0; a < D; ++a) {
      volumetric += l[a * D + a];
      for (int b = 0; b < D; ++b) s_eps += old.s.c[stress_index<D>(a, b)] * l[a * D + b];
    }
    const T rate = (3 * m.alpha_phi * m.bulk * volumetric + m.shear / old.root_j2 * s_eps) /
                   (9 * m.alpha_phi * m.alpha_psi * m.bulk + m.shear);
    const T lambda = dt * largest(T(0), rate);
    for (int k = 0; k < Stress<T, D>::size; ++k) sigma.c[k] -= lambda * m.shear / old.root_j2 * old.s.c[k];
    add_isotropic(sigma, -3 * lambda * m.alpha_psi * m.bulk);
    adps = lambda * square_root(T(1.0 / 3) + 2 * m.alpha_psi * m.alpha_psi);
  }
  // Apex: no mean stress beyond the tip of the cone.
  if (m.alpha_phi > 0) {
    const T excess = trace(sigma) - (m.k_c / m.alpha_phi - 3 * pore_pressure);
    if (excess > 0) add_isotropic(sigma, -excess / 3);
  }
  // Drift: scale the deviator back to the cone.
  const Deviator<T, D> now(sigma);
  if (yield_function(m, now.i1, now.root_j2, pore_pressure) > 0 && now.root_j2 > 0) {
    const T factor = largest(T(0), m.k_c - m.alpha_phi * (now.i1 + 3 * pore_pressure)) / now.root_j2;
    for (int k = 0; k < Stress<T, D>::size; ++k) sigma.c[k] = factor * now.s.c[k];
    add_isotropic(sigma, now.i1 / 3);
  }
  return adps;
}

/// Artificial stress (Gray et al. 2001), the R of Eq. (7): -epsilon times the tensile principal stresses over rho^2, in
/// the axes of the principal stresses. 2-D: in the plane only.
template <class T>
LGIW_FN Stress<T, 2> artificial_stress(const Stress<T, 2>& s, T epsilon_over_rho2) {
  const T mean = T(0.5) * (s.c[0] + s.c[1]), half = T(0.5) * (s.c[0] - s.c[1]);
  const T radius = square_root(half * half + s.c[2] * s.c[2]);
  const T t1 = largest(T(0), mean + radius), t2 = largest(T(0), mean - radius);
  // The tensile part as a function of the tensor: a I + b (s - mean I).
  const T a = T(0.5) * (t1 + t2), b = radius > 0 ? T(0.5) * (t1 - t2) / radius : T(0);
  Stress<T, 2> r;
  r.c[0] = -epsilon_over_rho2 * (a + b * half);
  r.c[1] = -epsilon_over_rho2 * (a - b * half);
  r.c[2] = -epsilon_over_rho2 * b * s.c[2];
  r.c[3] = 0;
  return r;
}
template <class T>
LGIW_FN Stress<T, 3> artificial_stress(const Stress<T, 3>& s, T epsilon_over_rho2) {
  // Jacobi rotations; six sweeps of a 3 x 3 matrix reach rounding.
  T a[3][3] = {{s.c[0], s.c[3], s.c[5]}, {s.c[3], s.c[1], s.c[4]}, {s.c[5], s.c[4], s.c[2]}};
  T v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int sweep = 0; sweep < 6; ++sweep)
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        if (a[p][q] == 0) continue;
        const T theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const T t = (theta >= 0 ? T(1) : T(-1)) / (std::fabs(theta) + square_root(theta * theta + 1));
        const T c = 1 / square_root(t * t + 1), n = t * c;
        for (int k = 0; k < 3; ++k) {
          const T akp = a[k][p], akq = a[k][q];
          a[k][p] = c * akp - n * akq, a[k][q] = n * akp + c * akq;
        }
        for (int k = 0; k < 3; ++k) {
          const T apk = a[p][k], aqk = a[q][k];
          a[p][k] = c * apk - n * aqk, a[q][k] = n * apk + c * aqk;
          const T vkp = v[k][p], vkq = v[k][q];
          v[k][p] = c * vkp - n * vkq, v[k][q] = n * vkp + c * vkq;
        }
      }
  Stress<T, 3> r;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      T sum = 0;
      for (int k = 0; k < 3; ++k) sum += largest(T(0), a[k][k]) * v[i][k] * v[j][k];
      r.c[stress_index<3>(i, j)] = -epsilon_over_rho2 * sum;
    }
  return r;
}

}  // namespace lgiw
