// Initial waves and velocities.
#include <algorithm>
#include <map>

#include "base/error.hh"
#include "gtest/gtest.h"
#include "scene.hh"

namespace lgiw::test {
namespace {

/// Solitary wave of H/d = 0.3 over 1 m at x = 10, running west over a flat bed.
std::string solitary(double dp, double height) {
  char text[400];
  std::snprintf(text, sizeof text,
                "name: solitary\ndimension: 2\nparticle_spacing: %g\nterrain: {profile: [[0, -1], [20, -1]]}\n"
                "water: {level: 0, wave: {kind: solitary, height: %g, crest: 10, direction: west}}\n",
                dp, height);
  return text;
}

/// Highest particle of each column, by x.
std::map<double, double> tops(const ParticleBlock& water) {
  std::map<double, double> top;
  for (std::size_t n = 0; n < water.size(); ++n) {
    const Point p = point(water, n);
    top[p[0]] = top.count(p[0]) ? std::max(top[p[0]], p[2]) : p[2];
  }
  return top;
}

class Solitary : public testing::TestWithParam<double> {};

TEST_P(Solitary, HasItsSurfaceVelocityAndPressure) {
  const double height = GetParam(), dp = 0.05, gamma = std::sqrt(0.75 * height), c = std::sqrt(9.81);
  const Scene s = seeded(solitary(dp, height));
  const ParticleBlock& water = s.data.water;
  const auto eta = [&](double x) { return height / std::pow(std::cosh(gamma * (x - 10)), 2); };
  for (const auto& [x, z] : tops(water)) {
    // Half a spacing below the surface, stretched by at most half a layer over the whole depth.
    EXPECT_NEAR(z, eta(x) - 0.5 * dp, 0.02 * dp) << x;
  }
  double area = 0;
  ASSERT_EQ(water.velocity.size(), 3 * water.size());
  EXPECT_TRUE(s.data.header.initial_velocity);
  for (std::size_t n = 0; n < water.size(); ++n) {
    const Point p = point(water, n);
    area += water.volume[n];
    EXPECT_NEAR(water.velocity[3 * n], -c * eta(p[0]), 1e-5);
    const double e = 1e-4, du_dx = -c * (eta(p[0] + e) - eta(p[0] - e)) / (2 * e);
    EXPECT_NEAR(water.velocity[3 * n + 2], -(p[2] + 1) * du_dx, 1e-5);
    EXPECT_NEAR(water.pressure[n], 9810 * (eta(p[0]) - p[2]), 0.02);
  }
  // 20 m2 of water and the wave, which small ones make longer than the tank.
  EXPECT_NEAR(area, 20 + 2 * height / gamma * std::tanh(10 * gamma), 1e-4 * height);
  Neighbours all(2 * dp);
  all.add(water), all.add(s.data.wall);
  EXPECT_GT(nearest_pair(water, all, 2 * dp), 0.75 * dp);
}

// A fifth of a spacing, half of it, and waves of several.
INSTANTIATE_TEST_SUITE_P(Heights, Solitary, testing::Values(0.01, 0.0185, 0.1, 0.3));

TEST(Wave, StandingWaveSmallerThanTheSpacing) {
  const double dp = 0.02, amplitude = 0.004, k = 2 * M_PI / 2;
  const Scene s = seeded(R"(
name: standing
dimension: 2
particle_spacing: 0.02
terrain: {profile: [[0, 0], [2, 0]]}
water: {level: 0.5, wave: {kind: standing, amplitude: 0.004, mode: 2}}
)");
  EXPECT_FALSE(s.data.header.initial_velocity);
  EXPECT_TRUE(s.data.water.velocity.empty());
  EXPECT_EQ(s.data.water.size(), 100u * 25u);
  EXPECT_NEAR(sum(s.data.water.volume), 1, 1e-6);
  for (const auto& [x, z] : tops(s.data.water))
    EXPECT_NEAR(z, 0.5 + amplitude * std::cos(k * x) - 0.5 * dp * (1 + amplitude / 0.5 * std::cos(k * x)), 1e-6);
  for (std::size_t n = 0; n < s.data.water.size(); ++n) {
    const Point p = point(s.data.water, n);
    if (p[2] > 0.5) continue;
    const double head = 0.5 - p[2] + amplitude * std::cos(k * p[0]) * std::cosh(k * p[2]) / std::cosh(k * 0.5);
    EXPECT_NEAR(s.data.water.pressure[n], 9810 * std::max(0.0, head), 0.01);
  }
}

TEST(Wave, RunsOverTheWholeWidthIn3D) {
  const Scene s = seeded(R"(
name: wide
particle_spacing: 0.1
terrain: {profile: [[0, -1], [6, -1]], width: 0.5}
water: {level: 0, wave: {kind: solitary, height: 0.2, crest: 3, direction: east}}
)");
  for (std::size_t n = 0; n < s.data.water.size(); ++n) {
    EXPECT_GT(s.data.water.velocity[3 * n], 0);
    EXPECT_EQ(s.data.water.velocity[3 * n + 1], 0);
  }
  double row = 0;
  for (std::size_t n = 0; n < s.data.water.size(); ++n)
    if (s.data.water.points[3 * n + 1] < 0.1) row += s.data.water.volume[n];
  EXPECT_NEAR(5 * row, sum(s.data.water.volume), 1e-5);
}

TEST(Wave, RefusesWavesThatCannotBe) {
  const auto message = [](const std::string& wave) -> std::string {
    try {
      seeded(
          "name: w\ndimension: 2\nparticle_spacing: 0.05\nterrain: {profile: [[0, 0.5], [1, -1], [9, -1]]}\n"
          "water: {level: 0, wave: " +
          wave + "}\n");
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message("{kind: solitary, height: 0.8, crest: 5, direction: west}"),
            "scene:5: water.wave.height is 0.8 m (a solitary wave over 1 m of water breaks above 0.78 m) write less "
            "than that");
  EXPECT_EQ(message("{kind: solitary, height: 0.1, crest: 0.2, direction: west}"),
            "scene:5: water.wave.crest lies on dry land (the bed there is 0.2 m above the water) move it into the "
            "water");
  EXPECT_EQ(message("{kind: standing, amplitude: 1, mode: 1}"),
            "scene:5: water.wave.amplitude is 1 m (the water is 1 m deep) write less than that");
}

TEST(Velocity, OfTheSoil) {
  const Scene s = seeded(R"(
name: entering
dimension: 2
particle_spacing: 0.01
terrain: {profile: [[0, 0.5], [0.5, 0], [1.5, 0]]}
water: {level: 0.2}
slide: {bodies: [[[0.1, 0.4], [0.2, 0.3], [0.2, 0.4]]], velocity: [1.5, -1.5]}
)");
  ASSERT_EQ(s.data.soil.velocity.size(), 3 * s.data.soil.size());
  for (std::size_t n = 0; n < s.data.soil.size(); ++n) {
    EXPECT_EQ(s.data.soil.velocity[3 * n], 1.5f);
    EXPECT_EQ(s.data.soil.velocity[3 * n + 1], 0);
    EXPECT_EQ(s.data.soil.velocity[3 * n + 2], -1.5f);
  }
  for (const float v : s.data.water.velocity) EXPECT_EQ(v, 0);
  EXPECT_TRUE(s.data.header.initial_velocity);
}

}  // namespace
}  // namespace lgiw::test
