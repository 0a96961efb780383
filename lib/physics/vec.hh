// Small fixed vectors. D = 2 is the plane (x, z); the vertical is always component D - 1.
#pragma once

#include <cmath>

#include "physics/platform.hh"

namespace lgiw {

template <class T, int D>
struct Vec {
  T c[D];
  LGIW_FN T& operator[](int k) { return c[k]; }
  LGIW_FN const T& operator[](int k) const { return c[k]; }
};

template <class T, int D>
LGIW_FN T dot(const Vec<T, D>& a, const Vec<T, D>& b) {
  T s = a.c[0] * b.c[0];
  for (int k = 1; k < D; ++k) s += a.c[k] * b.c[k];
  return s;
}
template <class T, int D>
LGIW_FN Vec<T, D> operator-(const Vec<T, D>& a, const Vec<T, D>& b) {
  Vec<T, D> r;
  for (int k = 0; k < D; ++k) r.c[k] = a.c[k] - b.c[k];
  return r;
}
template <class T, int D>
LGIW_FN Vec<T, D> operator*(T s, const Vec<T, D>& a) {
  Vec<T, D> r;
  for (int k = 0; k < D; ++k) r.c[k] = s * a.c[k];
  return r;
}
/// a += s b
template <class T, int D>
LGIW_FN void add_scaled(Vec<T, D>& a, T s, const Vec<T, D>& b) {
  for (int k = 0; k < D; ++k) a.c[k] += s * b.c[k];
}

template <class T>
LGIW_FN T square_root(T x) {
  return std::sqrt(x);
}
/// A distance and its reciprocal, which is large but finite at distance 0.
template <class T>
struct Distance {
  T square, r, inverse;
  LGIW_FN explicit Distance(T square_) : square(square_) {
#if defined(__CUDA_ARCH__)
    inverse = rsqrt(square > T(1e-30) ? square : T(1e-30));  // the processor's own: one instruction gives both
    r = square * inverse;
#else
    r = std::sqrt(square);
    inverse = 1 / (r > T(1e-15) ? r : T(1e-15));
#endif
  }
};

/// The larger one; of a NaN whatever the processor's own instruction makes.
template <class T>
LGIW_FN T largest(T a, T b) {
#if defined(__CUDA_ARCH__)
  return max(a, b);
#else
  return a > b ? a : b;
#endif
}
template <class T>
LGIW_FN T smallest(T a, T b) {
#if defined(__CUDA_ARCH__)
  return min(a, b);
#else
  return a < b ? a : b;
#endif
}

}  // namespace lgiw
