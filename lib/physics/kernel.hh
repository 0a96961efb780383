// Smoothing kernels with support 2h (physics.md section 1). gradient() returns F = W'(r)/r <= 0, so that
// grad_i W_ij = F r_ij; both are zero outside the support, and F stays finite at r = 0: no branch is needed in a pair
// loop, which has the reciprocal of r at hand (Distance).
#pragma once

#include "physics/vec.hh"

namespace lgiw {

constexpr double pi = 3.14159265358979323846;

/// Wendland C2: W = alpha (1 - q/2)^4 (2q + 1), q = r/h; alpha = 7/(4 pi h^2) in 2-D, 21/(16 pi h^3) in 3-D.
template <class T, int D>
struct Wendland {
  T inverse_h, alpha, slope;
  Wendland() = default;
  explicit Wendland(double h)
      : inverse_h(T(1 / h)),
        alpha(T(D == 2 ? 7 / (4 * pi * h * h) : 21 / (16 * pi * h * h * h))),
        slope(T(-5 * (D == 2 ? 7 / (4 * pi * h * h) : 21 / (16 * pi * h * h * h)) / (h * h))) {}
  LGIW_FN T value(T r) const {
    const T q = r * inverse_h;
    const T t = largest(T(0), 1 - T(0.5) * q);
    return alpha * (t * t) * (t * t) * (2 * q + 1);
  }
  LGIW_FN T gradient(T r) const {
    const T t = largest(T(0), 1 - T(0.5) * r * inverse_h);
    return slope * t * t * t;
  }
  LGIW_FN T gradient(const Distance<T>& d) const { return gradient(d.r); }
};

/// Cubic spline, Eq. (3): alpha = 10/(7 pi h^2) in 2-D, 1/(pi h^3) in 3-D. Written as W = alpha/4 ((2 - q)+^3 -
/// 4 (1 - q)+^3), which needs no branch.
template <class T, int D>
struct CubicSpline {
  T inverse_h, alpha, slope;
  CubicSpline() = default;
  explicit CubicSpline(double h)
      : inverse_h(T(1 / h)),
        alpha(T(D == 2 ? 10 / (7 * pi * h * h) : 1 / (pi * h * h * h))),
        slope(T(-0.75 * (D == 2 ? 10 / (7 * pi * h * h) : 1 / (pi * h * h * h)) / h)) {}
  LGIW_FN T value(T r) const {
    const T q = r * inverse_h, outer = largest(T(0), 2 - q), inner = largest(T(0), 1 - q);
    return T(0.25) * alpha * (outer * outer * outer - 4 * inner * inner * inner);
  }
  LGIW_FN T gradient(const Distance<T>& d) const {
    const T q = d.r * inverse_h, outer = largest(T(0), 2 - q), inner = largest(T(0), 1 - q);
    return slope * d.inverse * (outer * outer - 4 * inner * inner);
  }
  LGIW_FN T gradient(T r) const { return gradient(Distance<T>(r * r)); }
};

}  // namespace lgiw
