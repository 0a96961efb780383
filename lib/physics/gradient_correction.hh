// First-order velocity gradient on disordered particles (physics.md section 3): the plain sum is exact for a linear
// field only where the particles' moment matrix is the identity.
#pragma once

#include "physics/vec.hh"

namespace lgiw {

/// A_ab = sum_j V_j (x_j - x_i)_a dW_ij/dx_b = -sum_j V_j (W'/r) r_a r_b, symmetric; the plain gradient of a linear
/// field is (true gradient) A. 1 deep inside, 1/2 on a plane free surface, 0 for a lone particle.
template <class T, int D>
struct MomentMatrix {
  T c[D * (D + 1) / 2];  // 11 12 22 or 11 12 13 22 23 33

  LGIW_FN MomentMatrix() {
    for (int k = 0; k < D * (D + 1) / 2; ++k) c[k] = 0;
  }
  /// A neighbour at r = x_i - x_j with f = V_j W'/r.
  LGIW_FN void add(T f, const Vec<T, D>& r) {
    int k = 0;
    LGIW_COMPONENTS
    for (int a = 0; a < D; ++a) {
      LGIW_COMPONENTS
      for (int b = a; b < D; ++b) c[k++] -= f * r.c[a] * r.c[b];
    }
  }
  LGIW_FN void scale(T s) {
    for (int k = 0; k < D * (D + 1) / 2; ++k) c[k] *= s;
  }
};

template <class T>
LGIW_FN T determinant(const MomentMatrix<T, 2>& m) {
  return m.c[0] * m.c[2] - m.c[1] * m.c[1];
}
template <class T>
LGIW_FN T determinant(const MomentMatrix<T, 3>& m) {
  return m.c[0] * (m.c[3] * m.c[5] - m.c[4] * m.c[4]) - m.c[1] * (m.c[1] * m.c[5] - m.c[4] * m.c[2]) +
         m.c[2] * (m.c[1] * m.c[4] - m.c[3] * m.c[2]);
}
/// det(A) A^-1, in the same order of components.
template <class T>
LGIW_FN MomentMatrix<T, 2> adjugate(const MomentMatrix<T, 2>& m) {
  MomentMatrix<T, 2> r;
  r.c[0] = m.c[2], r.c[1] = -m.c[1], r.c[2] = m.c[0];
  return r;
}
template <class T>
LGIW_FN MomentMatrix<T, 3> adjugate(const MomentMatrix<T, 3>& m) {
  const T* c = m.c;
  MomentMatrix<T, 3> r;
  r.c[0] = c[3] * c[5] - c[4] * c[4], r.c[1] = c[2] * c[4] - c[1] * c[5], r.c[2] = c[1] * c[4] - c[2] * c[3];
  r.c[3] = c[0] * c[5] - c[2] * c[2], r.c[4] = c[1] * c[2] - c[0] * c[4], r.c[5] = c[0] * c[3] - c[1] * c[1];
  return r;
}

/// Turns the plain gradient l[a*D + b] = sum_j V_j (v_j - v_i)_a dW/dx_b into l A^-1, exact for linear fields, where
/// the neighbours determine it. Where few of them do, at the edge of a free surface and for grains in flight, it goes
/// over into the plain gradient: full correction from det A = `full` upwards, none below `none`.
template <class T, int D>
LGIW_FN void correct_gradient(T* l, const MomentMatrix<T, D>& m) {
  constexpr T half = D == 2 ? T(0.25) : T(0.125);  // det A on a plane free surface
  constexpr T full = T(0.9) * half, none = T(0.4) * half;
  const T det = determinant(m);
  if (!(det > none)) return;
  const T t = smallest(T(1), (det - none) / (full - none));
  const T weight = t * t * (3 - 2 * t) / det;
  const MomentMatrix<T, D> inverse = adjugate(m);
  for (int a = 0; a < D; ++a) {
    T row[D];
    for (int b = 0; b < D; ++b) {
      T sum = 0;
      for (int k = 0; k < D; ++k) {
        const int low = k < b ? k : b, high = k < b ? b : k;
        sum += l[a * D + k] * inverse.c[low * D - low * (low - 1) / 2 + high - low];
      }
      row[b] = weight * sum + (1 - t * t * (3 - 2 * t)) * l[a * D + b];
    }
    for (int b = 0; b < D; ++b) l[a * D + b] = row[b];
  }
}

}  // namespace lgiw
