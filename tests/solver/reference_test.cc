// The reference values of the model's 2-D tests. Bars are the values that a plain double-precision code of the same
// equations reached; "measured" in the messages is what this solver does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "case_run.hh"
#include "measure/reference_data.hh"

namespace lgiw::test {
namespace {

constexpr double g = 9.81;

std::string number(double x) {
  std::ostringstream s;
  s.precision(12);
  s << x;
  return s.str();
}

TEST(Reference, TankPressure) {
  CaseRun run(R"(
name: tank
dimension: 2
particle_spacing: 0.005
terrain: {profile: [[0, 0], [0.4, 0]]}
water: {level: 0.2, sound_speed: 28.0, viscosity_alpha: 0.05}
output: {end_time: 2}
)");
  ASSERT_EQ(run.data.water.size(), 3200u);
  const ParticleState s = run.at(2);
  const double rms = relative_rms(3200, 1000 * g * 0.2, [&](std::size_t i) {
    return s.water_pressure[i] - 1000 * g * (0.2 - s.water_x[3 * i + 2]);
  });
  std::printf("measured: tank pressure RMS %.3f %% of rho g H\n", 100 * rms);
  EXPECT_LT(rms, 0.0045);  // 0.41 % in the reference, which is a state and not an average: allow a tenth
  EXPECT_LT(run.diagnostic(s, "max_water_speed"), 0.01 * std::sqrt(g * 0.2));
}

TEST(Reference, SoilBox) {
  CaseRun run(R"(
name: box
dimension: 2
particle_spacing: 0.005
terrain: {profile: [[0, 0], [0.2, 0]]}
slide: {bodies: [[[0, 0], [0.2, 0], [0.2, 0.2], [0, 0.2]]]}
soil: {density: 2650, friction_angle: 19.8, young_modulus: 0.84e6, poisson_ratio: 0.3}
output: {end_time: 0.5}
)");
  ASSERT_EQ(run.data.soil.size(), 1600u);
  const ParticleState s = run.at(0.5);
  const double rms = relative_rms(1600, 2650 * g * 0.2, [&](std::size_t i) {
    return s.soil_stress[6 * i + 2] + 2650 * g * (0.2 - s.soil_x[3 * i + 2]);
  });
  std::printf("measured: soil box sigma_v RMS %.3f %% of rho g H\n", 100 * rms);
  EXPECT_LT(rms, 0.0019);
  EXPECT_LT(*std::max_element(s.soil_adps.begin(), s.soil_adps.end()), 0.05);  // it stands still
}

// Walls that hold the water, as those of the program that the bounds come from; slipping ones give 0.27 and 0.21 %.
TEST(Reference, SoilUnderWater) {
  for (const char* pore : {"none", "hydrostatic"}) {
    CaseRun run(std::string(R"(
name: layers
dimension: 2
particle_spacing: 0.005
terrain: {profile: [[0, 0], [0.2, 0]]}
water: {level: 0.2, sound_speed: 28, walls: no_slip, bodies: [[[0, 0.1], [0.2, 0.1], [0.2, 0.2], [0, 0.2]]]}
slide: {bodies: [[[0, 0], [0.2, 0], [0.2, 0.1], [0, 0.1]]]}
soil: {density: 2000, friction_angle: 25, young_modulus: 1e6, poisson_ratio: 0.3, pore_pressure: )") +
                pore + R"(}
output: {end_time: 1}
)");
    const ParticleState s = run.at(1);
    const double scale = 1000 * g * 0.1 + 2000 * g * 0.1;
    const double vertical = relative_rms(s.soil_adps.size(), scale, [&](std::size_t i) {
      return s.soil_stress[6 * i + 2] + 1000 * g * 0.1 + 2000 * g * (0.1 - s.soil_x[3 * i + 2]);
    });
    const double pressure = relative_rms(s.water_pressure.size(), scale, [&](std::size_t i) {
      return s.water_pressure[i] - 1000 * g * (0.2 - s.water_x[3 * i + 2]);
    });
    std::printf("measured: soil under water, pore pressure %s: sigma_v RMS %.3f %%, p RMS %.3f %%\n", pore,
                100 * vertical, 100 * pressure);
    EXPECT_LT(vertical, 0.0027);
    EXPECT_LT(pressure, 0.0017);
  }
}

TEST(Reference, BuoyancyOfASubmergedBlock) {
  CaseRun run(R"(
name: block
dimension: 2
particle_spacing: 0.01
terrain: {profile: [[0, 0], [0.4, 0]]}
water: {level: 0.3, sound_speed: 34}
slide: {bodies: [[[0.15, 0.1], [0.25, 0.1], [0.25, 0.2], [0.15, 0.2]]]}
soil: {density: 2000, friction_angle: 25, young_modulus: 1e6}
output: {end_time: 1}
)");
  ASSERT_EQ(run.data.soil.size(), 100u);
  run.simulation->settle(Settling::water);  // holds the block while the water finds its rest
  double force = 0, side = 0;
  const int samples = 20;
  for (int k = 0; k < samples; ++k) {
    run.at(0.5 + 0.025 * k);
    std::vector<double> water, soil;
    run.simulation->download_accelerations(water, soil);
    for (std::size_t i = 0; i < soil.size(); i += 3) side += soil[i] / samples, force += soil[i + 2] / samples;
  }
  std::printf("measured: buoyancy %.2f N/m against %.2f\n", force, 1000 * g * 0.01);
  EXPECT_NEAR(force, 1000 * g * 0.01, 0.1);  // 98.1 N/m; 98.2 in the reference
  EXPECT_NEAR(side, 0, 0.1);
}

struct Column {
  double surface_rms = 0, front = 0;  // m
};
Column collapse(double dp, double e, double alpha) {
  CaseRun run(R"(
name: column
dimension: 2
particle_spacing: )" +
              number(dp) + R"(
terrain: {profile: [[0, 0], [1, 0]], sides: {east: open}}
slide: {bodies: [[[0, 0], [0.2, 0], [0.2, 0.1], [0, 0.1]]]}
soil: {density: 2650, friction_angle: 19.8, young_modulus: )" +
              number(e) + R"(, poisson_ratio: 0.3, viscosity_alpha: )" + number(alpha) + R"(}
output: {end_time: 0.8}
)");
  const ParticleState s = run.at(0.8);
  EXPECT_EQ(run.simulation->state().lost_soil, 0);
  Column result;
  std::vector<double> x;
  for (std::size_t i = 0; i < s.soil_x.size(); i += 3) x.push_back(s.soil_x[i]);
  std::sort(x.begin(), x.end());
  result.front = x[std::size_t(0.99 * double(x.size()))];
  const ProfileReference measured =
      profile_references(read_csv(LGIW_TEST_DATA "/bui2008_column_collapse/final_surface.csv")).at(0);
  const std::size_t n = measured.distance.size();
  const ColumnSurfaces surface = run.surfaces(s, 0, 0.001, 601);
  double sum = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double z = surface.soil[std::size_t(std::lround(measured.distance[k] / 0.001))];
    sum += std::pow((std::isfinite(z) ? z : 0) - measured.elevation[k], 2);
  }
  result.surface_rms = std::sqrt(sum / double(n));
  std::printf("measured: column dp %.1f mm, E %.2f MPa, alpha %.2f: surface RMS %.2f mm, front (99 %%) %.3f m\n",
              1000 * dp, e / 1e6, run.p.soil_alpha, 1000 * result.surface_rms, result.front);
  return result;
}
TEST(Reference, ColumnCollapseAgainstTheMeasuredSurface) {
  EXPECT_LT(collapse(0.005, 0.84e6, 0.3).surface_rms, 0.0024);
  EXPECT_LT(collapse(0.0025, 0.84e6, 0.3).surface_rms, 0.0015);
}
TEST(Reference, ColumnCollapseFrontAtThreeSpacings) {
  const double expected[3] = {0.38, 0.40, 0.40}, spacing[3] = {0.01, 0.005, 0.0025};
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(collapse(spacing[k], 5.84e6, 0.1).front, expected[k], 0.02) << spacing[k];
}

struct Wave {
  double crest[2], time[2], energy_rise, released;
};
Wave slide(double dp, const char* pore) {
  CaseRun run(R"(
name: slide
dimension: 2
particle_spacing: )" +
              number(dp) + R"(
terrain: {profile: [[-0.25, 0.25], [0.15, -0.15], [2.2, -0.15]]}
water: {level: 0, seed: [1, 0], sound_speed: 24.3, viscosity_alpha: 0.05}
slide: {bodies: [[[0, 0], [0, 0.1167], [-0.1167, 0.1167]]]}
soil: {density: 1900, friction_angle: 25, cohesion: 20, young_modulus: 1e6, poisson_ratio: 0.3, pore_pressure: )" +
              std::string(pore) + R"(}
output: {end_time: 1.2}
)");
  Wave w{{0, 0}, {0, 0}, 0, 0};
  const double gauge[2] = {0.45, 0.75};
  double start = 0, lowest = 1e30;
  ParticleState s;
  for (int k = 0; k <= 120; ++k) {
    s = run.at(0.01 * k);
    const double e = run.energy(s);
    if (k == 0) start = e;
    lowest = std::min(lowest, e);
    w.energy_rise = std::max(w.energy_rise, e - start);
    for (int q = 0; q < 2; ++q) {
      const double z = run.surfaces(s, gauge[q], 1, 1).water[0];
      if (z > w.crest[q]) w.crest[q] = z, w.time[q] = 0.01 * k;
    }
  }
  w.released = start - lowest;
  EXPECT_EQ(run.simulation->state().lost_water + run.simulation->state().lost_soil, 0);
  double x = 0;
  for (std::size_t i = 0; i < s.soil_x.size(); i += 3) x += s.soil_x[i] / double(s.soil_x.size() / 3);
  std::printf(
      "measured: slide dp %.4f, pore pressure %s: crests %.1f mm at %.2f s, %.1f mm at %.2f s; soil centre x %.3f m; "
      "energy "
      "rise %.2g of %.2f J released\n",
      dp, pore, 1000 * w.crest[0], w.time[0], 1000 * w.crest[1], w.time[1], x, w.energy_rise, w.released);
  return w;
}
void check_slide(double dp, double first, double second) {
  const Wave w = slide(dp, "hydrostatic");
  // The reference had its slope in steps of dp, which hold the slide back, and a soil area that fits the lattice; here
  // the slope is smooth and the area differs from its polygon's by +6, -3, +1 % at the three spacings.
  EXPECT_NEAR(w.crest[0], first, 0.1 * first);
  EXPECT_NEAR(w.crest[1], second, 0.1 * second);
  EXPECT_NEAR(w.time[0], 0.595, 0.025);
  EXPECT_NEAR(w.time[1], 0.85, 0.025);
  EXPECT_LT(w.energy_rise, 0.001 * w.released);
}
TEST(Reference, SlideCrestsCoarse) { check_slide(0.01, 0.031, 0.027); }
TEST(Reference, SlideCrestsMiddle) { check_slide(0.005, 0.030, 0.025); }
TEST(Reference, SlideCrestsFine) { check_slide(0.0025, 0.032, 0.027); }
TEST(Reference, SlideWithoutPorePressure) {
  const Wave w = slide(0.005, "none");
  EXPECT_NEAR(w.crest[0], 0.025, 0.002);
  EXPECT_NEAR(w.crest[1], 0.020, 0.002);
}

/// A layer of soil 0.1 m thick on a plane, long enough for its middle to feel no ends; returns how far the middle
/// moved.
double slope(double degrees) {
  const double t = std::tan(degrees * pi / 180), l = 1.2, top = l * t;
  std::ostringstream yaml;
  yaml << "name: slope\ndimension: 2\nparticle_spacing: 0.01\nterrain: {profile: [[0, " << number(top) << "], [" << l
       << ", 0], [2.4, 0]]}\nslide: {bodies: [[[0.2, " << number(top - 0.2 * t) << "], [1.0, " << number(top - 1.0 * t)
       << "], [1.0, " << number(top - 1.0 * t + 0.1) << "], [0.2, " << number(top - 0.2 * t + 0.1)
       << "]]]}\nsoil: {density: 2000, friction_angle: 25, young_modulus: 2e6}\noutput: {end_time: 1.5}\n";
  CaseRun run(yaml.str());
  ParticleState before, s;
  run.simulation->download(before);
  s = run.at(1.5);
  double moved = 0, n = 0;
  for (std::size_t i = 0; i < s.soil_x.size(); i += 3)
    if (before.soil_x[i] > 0.45 && before.soil_x[i] < 0.75) moved += s.soil_x[i] - before.soil_x[i], n += 1;
  std::printf("measured: soil of 25 degrees on a slope of %.0f: middle moved %.4f m in 1.5 s\n", degrees, moved / n);
  return moved / n;
}
TEST(Reference, SoilStaysOnAFlatSlopeAndLeavesASteepOne) {
  EXPECT_LT(slope(15), 0.01);  // within one particle
  EXPECT_GT(slope(35), 0.2);
}

/// Highest mean speed of the soil in the first 0.1 s of an embankment that stands, m/s. (The mean: a lone grain at the
/// tip of its toe creeps in either case.)
double restlessness(bool settled) {
  CaseRun run(R"(
name: embankment
dimension: 2
particle_spacing: 0.01
terrain: {profile: [[0, 0], [1, 0]]}
slide: {bodies: [[[0.1, 0], [0.9, 0], [0.6, 0.2], [0.4, 0.2]]]}
soil: {density: 2000, friction_angle: 40, cohesion: 5000, young_modulus: 2e6, initial_stress: settled}
output: {end_time: 0.1}
)");
  EXPECT_TRUE(run.p.settle_soil);
  EXPECT_GT(run.p.settle_time, 0);
  if (settled) {
    run.simulation->settle(Settling::all);
    run.at(run.p.settle_time);
    run.simulation->settle(Settling::off);
  }
  double fastest = 0;
  for (int k = 1; k <= 20; ++k) fastest = std::max(fastest, run.diagnostic(run.at(0.005 * k), "mean_soil_speed"));
  std::printf("measured: embankment, %s: mean soil speed up to %.5f m/s\n", settled ? "settled" : "K0", fastest);
  return fastest;
}
TEST(Reference, SettledStressLeavesAnEmbankmentAtRest) { EXPECT_LT(restlessness(true), 0.3 * restlessness(false)); }

}  // namespace
}  // namespace lgiw::test
