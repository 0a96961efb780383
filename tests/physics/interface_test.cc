#include "physics/interface.hh"

#include <gtest/gtest.h>

namespace lgiw {
namespace {

TEST(SoftRepulsion, FollowsTheFormula) {
  const double c = 20, dp = 0.005, h = 0.0075;
  const SoftRepulsion<double> law(true, c, dp, h);
  auto expected = [&](double r) {  // Eqs. (18)-(20)
    const double eta = r / (0.5 * h);
    const double f =
        eta <= 2.0 / 3 ? 2.0 / 3 : (eta < 1 ? 2 * eta - 1.5 * eta * eta : (eta < 2 ? 0.5 * (2 - eta) * (2 - eta) : 0));
    return r < dp ? 0.01 * c * c * (1 - r / dp) * f / (r * r) : 0;
  };
  for (double r : {0.0005, 0.0024, 0.003, 0.00374, 0.00376, 0.0049, 0.0051, 0.02})
    EXPECT_NEAR(law(r, r * r), expected(r), 1e-9 * (1 + expected(r))) << r;
  EXPECT_NEAR(law(0.5 * h, 0.25 * h * h), 0.01 * c * c * (1 - 0.5 * h / dp) * 0.5 / (0.25 * h * h),
              1e-6);  // eta = 1: 0.5
  EXPECT_TRUE(std::isfinite(law(0, 0)));
  EXPECT_EQ((SoftRepulsion<double>(false, c, dp, h)(0.001, 1e-6)), 0);
}
TEST(InterfacePair, PressurePushesApart) {
  const InterfacePair<double> law{2.0, SoftRepulsion<double>(false, 20, 0.005, 0.0075)};
  // a_w = -m_w (p_w/rho_w^2 + p_s/rho_s^2) F r, F < 0
  EXPECT_NEAR(law(Distance<double>(2.5e-5), -3.0, 0.1, 0.4, 0.6), 2.0 * (0.4 + 0.6 + 0.1) * 3.0, 1e-12);
}

}  // namespace
}  // namespace lgiw
