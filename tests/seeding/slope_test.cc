// Water and soil next to inclined beds: volumes, spacing and the completeness of the kernel's support.
#include <algorithm>

#include "gtest/gtest.h"
#include "scene.hh"

namespace lgiw::test {
namespace {

constexpr double dp = 0.01, h = 1.5 * dp;

/// A flat floor at `floor`, a slope from x = 0 westwards up to far above the water, at `degrees`.
std::string slope_scene(double degrees, double floor) {
  const double run = 0.3, rise = run * std::tan(degrees * M_PI / 180);
  char text[400];
  std::snprintf(text, sizeof text,
                "name: slope\ndimension: 2\nparticle_spacing: 0.01\n"
                "terrain: {profile: [[%.9f, %.9f], [0, %.9f], [0.4, %.9f]]}\nwater: {level: 0.25}\n",
                -run, floor + rise, floor, floor);
  return text;
}

class Slope : public testing::TestWithParam<int> {};

TEST_P(Slope, WaterIsWellSpacedAndSupported) {
  const double slope = std::tan(GetParam() * M_PI / 180);
  double error = 0;
  int64_t points = 0;
  for (int place = 0; place < 5; ++place) {  // of the bed in the lattice
    const double floor = place * dp / 5;
    const Scene s = seeded(slope_scene(GetParam(), floor));
    Neighbours water(2 * h), all(2 * h), wall(2 * h);
    water.add(s.data.water), wall.add(s.data.wall), all.add(s.data.water), all.add(s.data.wall);
    EXPECT_GT(nearest_pair(s.data.water, water, 2 * h), 0.78 * dp);
    EXPECT_GT(nearest_pair(s.data.water, wall, 2 * h), 0.84 * dp);

    // Trapezium or triangle of water on the slope, rectangle on the floor.
    const double depth = 0.25 - floor, at_side = std::max(0.0, depth - 0.3 * slope);
    const double on_slope = slope > 0 ? (depth * depth - at_side * at_side) / (2 * slope) : 0.3 * depth;
    EXPECT_NEAR(sum(s.data.water.volume), 0.4 * depth + on_slope, 0.005 * (0.4 * depth + on_slope));

    for (std::size_t n = 0; n < s.data.water.size(); ++n) {
      const Point p = point(s.data.water, n);
      if (p[2] > 0.25 - 2 * h || p[0] > 0.3) continue;
      double filled = 0;
      all.visit(p, [&](const Point&, double volume, double r) { filled += volume * wendland_2d(r, h); });
      EXPECT_NEAR(filled, 1, 0.11) << p[0] << " " << p[2];
      if (p[2] - std::max(0.0, -p[0] * slope) - floor > 4 * dp * std::hypot(1, slope)) continue;
      error += (filled - 1) * (filled - 1), ++points;
    }
  }
  ASSERT_GT(points, 200);
  EXPECT_LT(std::sqrt(error / double(points)), 0.035);
}

TEST_P(Slope, NothingStandsInTheBed) {
  const Scene s = seeded(slope_scene(GetParam(), 0));
  const double slope = std::tan(GetParam() * M_PI / 180);
  for (std::size_t n = 0; n < s.data.water.size(); ++n) {
    const Point p = point(s.data.water, n);
    const double across = (p[2] - std::max(0.0, -p[0] * slope)) / (p[0] < -dp ? std::hypot(1, slope) : 1);
    EXPECT_GE(across, 0.34 * dp) << p[0] << " " << p[2];
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, Slope, testing::Values(0, 10, 20, 30, 40, 45, 50, 60));

// Viroulet's slide: a triangle of soil with its hypotenuse on a slope of 45 degrees, on the diagonal of the lattice.
TEST(Soil, TriangleOnTheDiagonal) {
  const Scene s = seeded(R"(
name: viroulet
dimension: 2
particle_spacing: 0.005
terrain: {profile: [[-0.3, 0.3], [0.15, -0.15], [2.2, -0.15]]}
water: {level: 0}
slide: {bodies: [[[-0.115, 0.115], [0, 0], [0, 0.115]]]}
)");
  EXPECT_NEAR(sum(s.data.soil.volume), 0.115 * 0.115 / 2, 0.005 * 6.6e-3);
  EXPECT_NEAR(sum(s.data.water.volume), 2.05 * 0.15 + 0.15 * 0.15 / 2, 0.002 * 0.32);
  Neighbours all(0.015);
  all.add(s.data.water), all.add(s.data.soil), all.add(s.data.wall);
  EXPECT_GT(nearest_pair(s.data.soil, all, 0.015), 0.6 * 0.005);
  EXPECT_GT(nearest_pair(s.data.water, all, 0.015), 0.6 * 0.005);
  for (std::size_t n = 0; n < s.data.soil.size(); ++n) EXPECT_LT(s.data.soil.points[3 * n], 0);
}

TEST(Soil, SubmergedWedgeDisplacesWater) {
  const Scene s = seeded(R"(
name: submerged
dimension: 2
particle_spacing: 0.01
terrain: {profile: [[0, 0.5], [0.5, 0], [1.5, 0]]}
water: {level: 0.45}
slide: {bodies: [[[0.2, 0.3], [0.4, 0.1], [0.4, 0.3]]]}
)");
  EXPECT_NEAR(sum(s.data.soil.volume), 0.02, 0.02 * 0.02);
  const double basin = 0.45 * 0.45 / 2 + 0.45;
  EXPECT_NEAR(sum(s.data.water.volume), basin - 0.02, 0.005 * basin);
  Neighbours all(0.03);
  all.add(s.data.water), all.add(s.data.soil), all.add(s.data.wall);
  EXPECT_GT(nearest_pair(s.data.soil, all, 0.03), 0.6 * 0.01);
}

}  // namespace
}  // namespace lgiw::test
