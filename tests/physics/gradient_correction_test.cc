#include "physics/gradient_correction.hh"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "physics/kernel.hh"

namespace lgiw {
namespace {

/// Plain and corrected gradient at the first of a set of points that move with the linear field v = G x.
template <int D>
struct Sums {
  double l[D * D] = {}, corrected[D * D];
  MomentMatrix<double, D> moment;

  Sums(const std::vector<Vec<double, D>>& points, const double* g, double h) {
    const Wendland<double, D> kernel(h);
    for (const Vec<double, D>& x : points) {
      const Vec<double, D> r = points[0] - x;
      const double f = kernel.gradient(std::sqrt(dot(r, r)));
      moment.add(f, r);
      for (int a = 0; a < D; ++a)
        for (int b = 0; b < D; ++b)
          for (int c = 0; c < D; ++c) l[a * D + b] += -g[a * D + c] * r[c] * f * r[b];
    }
    for (int k = 0; k < D * D; ++k) corrected[k] = l[k];
    correct_gradient(corrected, moment);
  }
};

/// A point at the origin among disordered ones of spacing 1; `keep` tells which of them there are.
template <int D, class Keep>
std::vector<Vec<double, D>> disordered(const Keep& keep, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-0.3, 0.3);
  std::vector<Vec<double, D>> points{Vec<double, D>{}};
  const int layers = D == 2 ? 0 : 4;
  for (int i = -4; i <= 4; ++i)
    for (int j = -4; j <= 4; ++j)
      for (int k = -layers; k <= layers; ++k) {
        Vec<double, D> x;
        const int lattice[3] = {i, j, k};
        for (int a = 0; a < D; ++a) x[a] = lattice[a] + u(random);
        if ((i || j || k) && keep(x)) points.push_back(x);
      }
  return points;
}

template <int D>
void exact_inside_and_at_a_free_surface() {
  const double g[9] = {0.3, -1.2, 0.7, 2.1, -0.4, 0.9, -0.6, 1.5, 0.2};
  double worst_plain = 0;
  for (unsigned seed = 1; seed <= 20; ++seed)
    for (double surface : {10.0, 0.5}) {  // points above it are missing
      const Sums<D> s(disordered<D>([&](const Vec<double, D>& x) { return x[D - 1] < surface; }, seed), g, 1.5);
      for (int k = 0; k < D * D; ++k) {
        EXPECT_NEAR(s.corrected[k], g[k], 1e-12) << "seed " << seed << " surface " << surface;
        worst_plain = std::max(worst_plain, std::fabs(s.l[k] - g[k]));
      }
    }
  EXPECT_GT(worst_plain, 0.2);
}
TEST(GradientCorrection, IsExactForLinearFieldsOnDisorderedParticles2d) { exact_inside_and_at_a_free_surface<2>(); }
TEST(GradientCorrection, IsExactForLinearFieldsOnDisorderedParticles3d) { exact_inside_and_at_a_free_surface<3>(); }

/// What an inverse alone would do to a grain with one or two neighbours in a line: divide by zero.
template <int D>
void never_larger_than_the_sum_or_the_truth() {
  double g[9] = {0.3, -1.2, 0.7, 2.1, -0.4, 0.9, -0.6, 1.5, 0.2};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-2.5, 2.5);
  for (int count = 0; count < 12; ++count)
    for (int k = 0; k < 200; ++k) {
      std::vector<Vec<double, D>> points{Vec<double, D>{}};
      for (int n = 0; n < count; ++n) {
        Vec<double, D> x;
        for (int a = 0; a < D; ++a) x[a] = u(random);
        points.push_back(x);
      }
      const Sums<D> s(points, g, 1.5);
      for (int c = 0; c < D * D; ++c) {
        const double low = std::min(s.l[c], g[c]), high = std::max(s.l[c], g[c]);
        EXPECT_GE(s.corrected[c], low - 1e-9);
        EXPECT_LE(s.corrected[c], high + 1e-9);
      }
    }
  // A line of points determines no gradient across it: the plain sum stays.
  std::vector<Vec<double, D>> line;
  for (double t : {0.0, 1.0, -1.0, 2.0}) {
    Vec<double, D> x{};
    x[0] = t, line.push_back(x);
  }
  const Sums<D> s(line, g, 1.5);
  for (int c = 0; c < D * D; ++c) EXPECT_EQ(s.corrected[c], s.l[c]);
}
TEST(GradientCorrection, LooseParticlesKeepThePlainSum2d) { never_larger_than_the_sum_or_the_truth<2>(); }
TEST(GradientCorrection, LooseParticlesKeepThePlainSum3d) { never_larger_than_the_sum_or_the_truth<3>(); }

}  // namespace
}  // namespace lgiw
