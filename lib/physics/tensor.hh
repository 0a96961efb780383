// Symmetric stress tensors. Components: 3-D xx yy zz xy yz xz; 2-D (plane strain, first axis x, second axis z)
// xx zz xz and, last, the out-of-plane normal stress, which takes part in I1 and J2.
#pragma once

#include "physics/vec.hh"

namespace lgiw {

template <int D>
struct StressSize;
template <>
struct StressSize<2> {
  static constexpr int value = 4;
};
template <>
struct StressSize<3> {
  static constexpr int value = 6;
};

template <class T, int D>
struct Stress {
  static constexpr int size = StressSize<D>::value;
  T c[size];
};

/// The component of (a, b).
template <int D>
LGIW_FN constexpr int stress_index(int a, int b) {
  if (D == 2) return a == b ? a : 2;
  return a == b ? a : (a + b == 1 ? 3 : (a + b == 3 ? 4 : 5));
}

template <class T>
LGIW_FN T trace(const Stress<T, 2>& s) {
  return s.c[0] + s.c[1] + s.c[3];
}
template <class T>
LGIW_FN T trace(const Stress<T, 3>& s) {
  return s.c[0] + s.c[1] + s.c[2];
}

/// Adds s to the normal components, the out-of-plane one too.
template <class T>
LGIW_FN void add_isotropic(Stress<T, 2>& t, T s) {
  t.c[0] += s, t.c[1] += s, t.c[3] += s;
}
template <class T>
LGIW_FN void add_isotropic(Stress<T, 3>& t, T s) {
  t.c[0] += s, t.c[1] += s, t.c[2] += s;
}

/// s : s
template <class T>
LGIW_FN T double_contraction(const Stress<T, 2>& s) {
  return s.c[0] * s.c[0] + s.c[1] * s.c[1] + s.c[3] * s.c[3] + 2 * s.c[2] * s.c[2];
}
template <class T>
LGIW_FN T double_contraction(const Stress<T, 3>& s) {
  return s.c[0] * s.c[0] + s.c[1] * s.c[1] + s.c[2] * s.c[2] +
         2 * (s.c[3] * s.c[3] + s.c[4] * s.c[4] + s.c[5] * s.c[5]);
}

/// The in-plane product sigma r.
template <class T>
LGIW_FN Vec<T, 2> apply(const Stress<T, 2>& s, const Vec<T, 2>& r) {
  return {{s.c[0] * r.c[0] + s.c[2] * r.c[1], s.c[2] * r.c[0] + s.c[1] * r.c[1]}};
}
template <class T>
LGIW_FN Vec<T, 3> apply(const Stress<T, 3>& s, const Vec<T, 3>& r) {
  return {{s.c[0] * r.c[0] + s.c[3] * r.c[1] + s.c[5] * r.c[2], s.c[3] * r.c[0] + s.c[1] * r.c[1] + s.c[4] * r.c[2],
           s.c[5] * r.c[0] + s.c[4] * r.c[1] + s.c[2] * r.c[2]}};
}

/// Q s Q with the reflection Q = I - 2 n n^T: the stress seen in a mirror of normal n.
template <class T, int D>
LGIW_FN Stress<T, D> reflect(const Stress<T, D>& s, const Vec<T, D>& n) {
  const Vec<T, D> sn = apply(s, n);
  const T nsn = dot(n, sn);
  Stress<T, D> r = s;
  for (int a = 0; a < D; ++a)
    for (int b = a; b < D; ++b)
      r.c[stress_index<D>(a, b)] += -2 * (n.c[a] * sn.c[b] + sn.c[a] * n.c[b]) + 4 * nsn * n.c[a] * n.c[b];
  return r;
}

}  // namespace lgiw
