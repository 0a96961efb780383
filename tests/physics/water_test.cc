#include "physics/water.hh"

#include <gtest/gtest.h>

namespace lgiw {
namespace {

TEST(EquationOfState, MatchesTheFormulaAndItsInverse) {
  const EquationOfState<double> eos(1000, 400);
  for (double rho : {990.0, 999.9, 1000.0, 1000.1, 1010.0, 1050.0}) {
    const double p = 400.0 * 400.0 * 1000 / 7 * (std::pow(rho / 1000, 7) - 1);
    EXPECT_NEAR(eos.pressure(rho - 1000), p, 1e-6 + 1e-9 * std::fabs(p));
    EXPECT_NEAR(eos.excess(p), rho - 1000, 1e-9);
  }
}
TEST(EquationOfState, SinglePrecisionResolvesAMillimetreOfWater) {
  const EquationOfState<float> eos(1000, 400);
  const float one_millimetre = 9.81f;  // Pa
  EXPECT_NEAR(eos.pressure(eos.excess(one_millimetre)), one_millimetre, 1e-4f);
}
TEST(WaterContinuity, DiffusionVanishesInHydrostaticWater) {
  const double c = 100, g = 9.81;
  WaterContinuity<double, 2> law{10, 2 * 0.1 * 0.15 * c, {{0, 1000 * -g / (c * c)}}};
  const Vec<double, 2> r{{0.03, 0.08}}, v{{0, 0}};
  // Linear density at rest: e falls upwards by rho0 g/c^2 a metre; r = r_i - r_j.
  const double slope = -1000 * g / (c * c), e_j = 2, e_i = e_j + slope * r[1];
  EXPECT_NEAR(law(r, v, -5.0, e_i, e_j, 1 / (1000 + e_j)), 0, 1e-14);
  EXPECT_GT(std::fabs(law(r, v, -5.0, e_j, e_j, 1 / (1000 + e_j))), 1e-6);
}
TEST(WaterContinuity, ApproachCompresses) {
  const WaterContinuity<double, 2> law{10, 0, {{0, 0}}};
  const Vec<double, 2> r{{0.1, 0}}, towards{{-1, 0}};
  EXPECT_NEAR(law(r, towards, -5.0), 10 * -5.0 * -0.1, 1e-14);
}
TEST(ArtificialViscosity, ActsOnApproachOnlyAndEvenly) {
  const ArtificialViscosity<double, 2> law(0.05, 100, 0.15);
  const double r2 = 0.01;
  EXPECT_EQ(law(0.2, r2, 1000).pi, 0);
  const double mu = 0.15 * -0.2 / (0.01 + 0.01 * 0.15 * 0.15);
  EXPECT_NEAR(law(-0.2, r2, 1000).mu, mu, 1e-15);
  EXPECT_NEAR(law(0.2, r2, 1000).mu, -mu, 1e-15);
  EXPECT_NEAR(law(-0.2, r2, 1000).pi, -0.05 * 100 * mu / 1000, 1e-15);
  EXPECT_GT(law(-0.2, r2, 1000).pi, 0);
}
TEST(Walls, PushWaterAndNeverPullIt) {
  EXPECT_NEAR(push_of_wall(2.0, 1.0), 3, 1e-15);
  EXPECT_NEAR(push_of_wall(2.0, -1.5), 0.5, 1e-15);  // the pair presses, though the wall alone would pull
  EXPECT_EQ(push_of_wall(-2.0, 1.5), 0);
  EXPECT_EQ(push_of_wall(-2.0, -1.0), 0);
}
TEST(Walls, CompressWaterAndStretchItNoFurtherThanItsReferenceDensity) {
  EXPECT_EQ(compression_by_walls(4.0, -1.0), 4);
  EXPECT_EQ(compression_by_walls(4.0, 1.0), 4);
  EXPECT_EQ(compression_by_walls(-4.0, 1.0), -4);
  EXPECT_EQ(compression_by_walls(-4.0, 0.0), 0);
  EXPECT_EQ(compression_by_walls(-4.0, -1.0), 0);
}

}  // namespace
}  // namespace lgiw
