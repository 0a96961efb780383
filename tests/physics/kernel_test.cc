#include "physics/kernel.hh"

#include <gtest/gtest.h>

namespace lgiw {
namespace {

/// Integral of W over the support, by the midpoint rule in r.
template <class K>
double integral(const K& k, double h, int d) {
  double sum = 0;
  const int n = 20000;
  for (int i = 0; i < n; ++i) {
    const double r = (i + 0.5) * 2 * h / n, shell = d == 2 ? 2 * pi * r : 4 * pi * r * r;
    sum += k.value(r) * shell * 2 * h / n;
  }
  return sum;
}

template <class K>
void check(double h, int d) {
  const K k(h);
  EXPECT_NEAR(integral(k, h, d), 1, 1e-6);
  for (double q : {0.1, 0.5, 0.99, 1.01, 1.5, 1.9}) {
    const double r = q * h, e = 1e-6 * h;
    const double slope = (k.value(r + e) - k.value(r - e)) / (2 * e);
    EXPECT_NEAR(k.gradient(r) * r, slope, 1e-6 * k.alpha / h) << "q " << q;
  }
  EXPECT_EQ(k.value(2.5 * h), 0);
  EXPECT_EQ(k.gradient(2.5 * h), 0);
  EXPECT_TRUE(std::isfinite(k.gradient(0.0)));
}

TEST(Kernel, WendlandIsNormalisedAndItsGradientIsItsSlope) {
  check<Wendland<double, 2>>(0.3, 2);
  check<Wendland<double, 3>>(2.5, 3);
}
TEST(Kernel, CubicSplineIsNormalisedAndItsGradientIsItsSlope) {
  check<CubicSpline<double, 2>>(0.3, 2);
  check<CubicSpline<double, 3>>(2.5, 3);
}
TEST(Kernel, ValuesAtTheCentre) {
  EXPECT_NEAR((Wendland<double, 2>(1).value(0)), 7 / (4 * pi), 1e-15);
  EXPECT_NEAR((Wendland<double, 3>(1).value(0)), 21 / (16 * pi), 1e-15);
  EXPECT_NEAR((CubicSpline<double, 2>(1).value(0)), 10 / (7 * pi), 1e-15);
  EXPECT_NEAR((CubicSpline<double, 3>(1).value(0)), 1 / pi, 1e-15);
}

}  // namespace
}  // namespace lgiw
