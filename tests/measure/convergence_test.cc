// Orders and errors of results that follow a power law of the spacing, and what is done with those that do not.
#include "measure/convergence.hh"

#include <gtest/gtest.h>

#include <array>

#include <cmath>

#include "measure/comparison.hh"

namespace lgiw {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

TEST(Convergence, OfAPowerLawIsItsOrderAndLimit) {
  // f = 10 + 2 h^1.5 at h = 1, 2, 4: changes 2 (2^1.5 - 1) and that times 2^1.5.
  const auto f = [](double h) { return 10 + 2 * std::pow(h, 1.5); };
  const Convergence c = convergence_of({{4, f(4)}, {1, f(1)}, {2, f(2)}});
  EXPECT_TRUE(c.use_gci);
  EXPECT_NEAR(c.order, 1.5, 1e-9);
  EXPECT_NEAR(c.richardson, 10, 1e-9);
  EXPECT_NEAR(c.gci, 1.25 * 2 / 12, 1e-9);  // 1.25 times the true error of 2, over 12
  EXPECT_NEAR(c.error, 2.5, 1e-9);
  EXPECT_NEAR(c.spread, (f(4) - 12) / 12, 1e-12);
}

TEST(Convergence, SolvesForTheOrderWhereTheRatiosDiffer) {
  const auto f = [](double h) { return -3 + 0.7 * std::pow(h, 0.8); };
  const Convergence c = convergence_of({{5, f(5)}, {10, f(10)}, {15, f(15)}, {40, 99}});  // the coarsest does not count
  EXPECT_NEAR(c.order, 0.8, 1e-9);
  EXPECT_NEAR(c.richardson, -3, 1e-9);
  EXPECT_NEAR(c.error, 1.25 * 0.7 * std::pow(5, 0.8), 1e-9);
}

TEST(Convergence, IsASpreadWhereTheResultsDoNotConverge) {
  const Convergence waves = convergence_of({{1, 10}, {2, 12}, {4, 11}});
  EXPECT_FALSE(waves.use_gci);
  EXPECT_EQ(waves.why, "the results oscillate");
  EXPECT_DOUBLE_EQ(waves.error, 2);
  EXPECT_DOUBLE_EQ(waves.spread, 0.2);
  EXPECT_TRUE(std::isnan(waves.order));

  const Convergence fast = convergence_of({{1, 10}, {2, 11}, {4, 19}});  // 8 / 1 = 2^3
  EXPECT_FALSE(fast.use_gci);
  EXPECT_EQ(fast.why, "order above 2");
  EXPECT_NEAR(fast.order, 3, 1e-9);
  EXPECT_DOUBLE_EQ(fast.error, 9);

  const Convergence slow = convergence_of({{1, 10}, {2, 11}, {4, 12.3}});  // 1.3 = 2^0.38
  EXPECT_FALSE(slow.use_gci);
  EXPECT_EQ(slow.why, "order below 0.5");
  EXPECT_NEAR(slow.order, 0.3785, 1e-4);
  EXPECT_NEAR(slow.error, 2.3, 1e-12);

  EXPECT_EQ(convergence_of({{1, 10}, {2, 12}, {4, 13}}).why, "the changes do not shrink");
  EXPECT_EQ(convergence_of({{1, 10}, {2, 12}, {4, 14}}).why, "the changes do not shrink");  // order 0
  EXPECT_EQ(convergence_of({{1, 10}, {2, 10}, {4, 14}}).why, "no change between two runs");
  EXPECT_DOUBLE_EQ(convergence_of({{1, 10}, {2, 10}, {4, 10}}).error, 0);
}

TEST(Convergence, OfFewerThanThreeResults) {
  const Convergence two = convergence_of({{2, 12}, {1, 10}, {4, nan_value}});
  EXPECT_EQ(two.why, "two runs");
  EXPECT_DOUBLE_EQ(two.spread, 0.2);
  const Convergence one = convergence_of({{2, nan_value}, {1, 10}});
  EXPECT_TRUE(std::isnan(one.error));
  EXPECT_EQ(one.why, "fewer than two runs have it");
  const Convergence coarse = convergence_of({{1, nan_value}, {2, 12}, {4, 13}, {8, 15}});
  EXPECT_TRUE(std::isnan(coarse.error)) << "the error told is that of the finest run";
  EXPECT_EQ(coarse.why, "the finest run has none");
  EXPECT_TRUE(std::isnan(convergence_of({{1, 0}, {2, 1}}).spread));  // there is nothing to be relative to
  EXPECT_DOUBLE_EQ(convergence_of({{1, 0}, {2, 1}}).error, 1);
}

TEST(Cases, DifferOnlyInWhatDoesNotHangOnTheSpacing) {
  const std::string a = "name: a\nparticle_spacing: 5\nsoil: {friction_angle: 20}\ngauges: [{name: G, x: 1}]\n";
  const std::string b = "name: b\nparticle_spacing: 10\nsoil:\n  friction_angle: 2.0e1\ngauges: [{name: G, x: 1}]\n";
  EXPECT_TRUE(case_differences({a, b}).empty());
  const std::string c =
      "particle_spacing: 10\nsoil: {friction_angle: 22}\ngauges: [{name: G, x: 1}, {name: H, x: 2}]\n";
  EXPECT_EQ(case_differences({a, b, c}),
            (std::vector<std::string>{"gauges.1.name", "gauges.1.x", "soil.friction_angle"}));
}

TEST(Comparison, OfAQuantityWithItsBand) {
  const ScalarReference both{"slide_volume_m3", "r.csv:2", 100, 80, 110},
      band{"width_m", "r.csv:3", nan_value, 80, 110};
  const ComparisonRow row = scalar_row(both, "m3", 120);
  EXPECT_DOUBLE_EQ(row.error, 20);
  EXPECT_DOUBLE_EQ(row.error_percent, 20);
  EXPECT_EQ(row.inside, 0);
  EXPECT_EQ(scalar_row(band, "m", 90).error, 0);
  EXPECT_EQ(scalar_row(band, "m", 90).inside, 1);
  EXPECT_DOUBLE_EQ(scalar_row(band, "m", 70).error, -10);
  const auto turned = [](double value, double low, double high, double run) {
    return scalar_row({"direction_deg", "r.csv:4", value, low, high}, "degrees", run);
  };
  EXPECT_NEAR(turned(10, nan_value, nan_value, 339).error, -31, 1e-12);
  EXPECT_NEAR(turned(350, nan_value, nan_value, 20).error, 30, 1e-12);
  EXPECT_TRUE(std::isnan(turned(10, nan_value, nan_value, 339).error_percent));
  for (const auto& [run, inside, error] :
       {std::array{350.0, 1.0, 0.0}, {5.0, 1.0, 0.0}, {30.0, 0.0, 10.0}, {330.0, 0.0, -10.0}}) {
    EXPECT_EQ(turned(nan_value, 340, 20, run).inside, inside) << run;
    EXPECT_NEAR(turned(nan_value, 340, 20, run).error, error, 1e-12) << run;
  }
  EXPECT_EQ(turned(nan_value, 20, 340, 350).inside, 0);
  const std::string text = comparison_table({row}).text();
  EXPECT_EQ(text,
            "name,quantity,unit,run,reference,error,error_percent,low,high,inside\n"
            "slide,slide_volume_m3,m3,120,100,20,20,80,110,0\n");
}

}  // namespace
}  // namespace lgiw
