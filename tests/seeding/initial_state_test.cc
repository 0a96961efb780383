// Pressure, density and stress at time zero against the formulas, with numbers worked by hand.
#include "seeding/initial_state.hh"

#include "gtest/gtest.h"
#include "scene.hh"

namespace lgiw::test {
namespace {

TEST(InitialState, SoundSpeed) {
  Case c;
  c.dp = 0.01;
  EXPECT_EQ(water_sound_speed(c, 10, 0), 0);  // no water
  c.water.present = true;
  EXPECT_NEAR(water_sound_speed(c, 0.15, 0), 20 * std::sqrt(9.81 * 0.15), 1e-9);  // 24.26 m/s
  EXPECT_NEAR(water_sound_speed(c, 0.15, 5), 24.261, 1e-3);                       // no slide, so no drop
  c.slide.present = true;
  c.soil.friction_angle = 26.565051177;  // tan = 1/2
  // 2 sqrt(g d) = 19.81 m/s against sqrt(2 * 9.81 * 50 * 0.5) = 22.15 m/s
  EXPECT_NEAR(water_sound_speed(c, 10, 50), 10 * 22.1472, 1e-3);
  EXPECT_NEAR(water_sound_speed(c, 10, 1000), 30 * std::sqrt(98.1), 1e-9);  // capped
  EXPECT_NEAR(water_sound_speed(c, 10, 20), 20 * std::sqrt(98.1), 1e-9);    // the water's own is larger
  c.water.sound_speed = 60;
  EXPECT_EQ(water_sound_speed(c, 10, 50), 60);
}

TEST(InitialState, DensityInvertsTheEquationOfState) {
  for (double p : {0.0, 1962.0, 1.6e6}) {
    const double rho = water_density(p, 1000, 40);
    EXPECT_NEAR(40 * 40 * 1000 / 7.0 * (std::pow(rho / 1000, 7) - 1), p, 1e-6 + 1e-9 * p);
  }
  EXPECT_EQ(water_density(0, 1000, 40), 1000);
}

TEST(InitialState, WaterIsHydrostatic) {
  const Scene s = seeded(R"(
name: tank
dimension: 2
particle_spacing: 0.01
terrain: {profile: [[0, -0.3], [0.4, -0.3]]}
water: {level: -0.1, density: 1020}
)");
  const double c0 = s.data.header.sound_speed;
  EXPECT_NEAR(c0, 20 * std::sqrt(9.81 * 0.2), 1e-9);
  for (std::size_t n = 0; n < s.data.water.size(); ++n) {
    const double p = 1020 * 9.81 * (-0.1 - s.data.water.points[3 * n + 2]);
    EXPECT_NEAR(s.data.water.pressure[n], p, 1e-3);
    EXPECT_NEAR(s.data.water.density[n], 1020 * std::pow(1 + 7 * p / (c0 * c0 * 1020), 1 / 7.), 1e-3);
  }
}

TEST(InitialState, DrySoil) {
  const Scene s = seeded(R"(
name: box
dimension: 2
particle_spacing: 0.01
terrain: {profile: [[0, 0], [0.2, 0]]}
slide: {bodies: [[[0, 0], [0.2, 0], [0.2, 0.2], [0, 0.2]]]}
soil: {density: 2000, friction_angle: 30}
)");
  ASSERT_EQ(s.data.soil.size(), 400u);
  for (std::size_t n = 0; n < 400; ++n) {
    const double vertical = -2000 * 9.81 * (0.2 - s.data.soil.points[3 * n + 2]);
    const float* stress = &s.data.soil.stress[6 * n];
    EXPECT_NEAR(stress[2], vertical, 1e-3);
    EXPECT_NEAR(stress[0], 0.5 * vertical, 1e-3);  // K0 = 1 - sin 30
    EXPECT_NEAR(stress[1], 0.5 * vertical, 1e-3);
    for (int k : {3, 4, 5}) EXPECT_EQ(stress[k], 0);
    EXPECT_EQ(s.data.soil.density[n], 2000);
  }
  // Lowest particle: 0.195 m deep, 2000 * 9.81 * 0.195 = 3825.9 Pa.
  EXPECT_NEAR(s.data.soil.stress[2], -3825.9, 0.01);
}

const std::string layer = R"(
name: layer
dimension: 2
particle_spacing: 0.01
terrain: {profile: [[0, 0], [0.2, 0]]}
water: {level: 0.3}
slide: {bodies: [[[0, 0], [0.2, 0], [0.2, 0.2], [0, 0.2]]]}
soil: {density: 2000, friction_angle: 30, pore_pressure: )";

TEST(InitialState, SubmergedSoilIsUnderTotalStress) {
  const Scene s = seeded(layer + "hydrostatic}\n");
  ASSERT_EQ(s.data.soil.size(), 400u);
  for (std::size_t n = 0; n < 400; ++n) {
    const double z = s.data.soil.points[3 * n + 2];
    const double vertical = 981 + 2000 * 9.81 * (0.2 - z), pore = 1000 * 9.81 * (0.3 - z);
    EXPECT_NEAR(s.data.soil.stress[6 * n + 2], -vertical, 1e-2);
    EXPECT_NEAR(s.data.soil.stress[6 * n], -(0.5 * (vertical - pore) + pore), 1e-2);
    EXPECT_NEAR(s.data.soil.pressure[n], pore, 1e-2);
  }
  // By hand, lowest particle: 981 + 3825.9 = 4806.9; pore 2893.95; horizontal 956.475 + 2893.95 = 3850.425.
  EXPECT_NEAR(s.data.soil.stress[0], -3850.425, 0.01);
  EXPECT_NEAR(s.data.soil.stress[2], -4806.9, 0.01);
}

TEST(InitialState, WithoutPorePressure) {
  const Scene s = seeded(layer + "none}\n");
  EXPECT_NEAR(s.data.soil.stress[2], -4806.9, 0.01);
  EXPECT_NEAR(s.data.soil.stress[0], -2403.45, 0.01);
  EXPECT_EQ(s.data.soil.pressure[0], 0);
}

TEST(InitialState, EffectiveStressIsNeverTensile) {
  Case c;
  c.soil.density = 2000;
  c.soil.friction_angle = 30;
  const auto stress = k0_stress(c, 0.1, 0, 3000);  // pore pressure above the weight of 1962 Pa
  EXPECT_NEAR(stress[2], -1962, 1e-9);
  EXPECT_NEAR(stress[0], -1962, 1e-9);
}

TEST(InitialState, TiltedGravityCountsItsVerticalPart) {
  Case c;
  c.gravity = {4.905, 0, -8.4957};
  EXPECT_EQ(vertical_gravity(c), 8.4957);
}

}  // namespace
}  // namespace lgiw::test
