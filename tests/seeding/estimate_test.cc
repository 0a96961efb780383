#include "gtest/gtest.h"
#include "seeding/run_estimate.hh"

namespace lgiw::test {
namespace {

TEST(Estimate, ByHand) {
  Case c;
  c.dimension = 2;
  c.dp = 0.01;
  c.numerics.cfl = 0.4;
  c.water.present = true;
  c.output.end_time = 2;
  const ParticleCounts counts{1000, 0, 500, 0};
  // h = 0.015 m, c = 27 m/s, v = 2.7 m/s: dt = 0.4 * 0.015 / 29.7 = 2.0202e-4 s; 2 s are 9900 steps.
  const RunEstimate e = estimate_run(c, counts, 27, 0, 1.5e6);
  EXPECT_NEAR(e.time_step, 2.0202e-4, 1e-8);
  EXPECT_EQ(e.steps, 9900);
  EXPECT_NEAR(e.run_time, 9.9, 1e-9);
  EXPECT_GT(e.memory_bytes, 1500 * 40);
}

TEST(Estimate, TheSoilsWaveSpeedCounts) {
  Case c;
  c.dp = 0.01;
  c.numerics.cfl = 0.4;
  c.slide.present = true;
  c.soil.young_modulus = 1e6, c.soil.poisson_ratio = 0.3, c.soil.density = 2000;
  // K = 833333, G = 384615: sqrt((K + 4/3 G)/rho) = sqrt(1346154/2000) = 25.944 m/s
  EXPECT_NEAR(soil_sound_speed(c), 25.944, 1e-3);
  EXPECT_NEAR(estimate_run(c, {}, 0, 0, 1e6).time_step, 0.4 * 0.015 / (1.1 * 25.944), 1e-8);
  // Twice the precision, more memory.
  const ParticleCounts counts{0, 1000000, 0, 0};
  const double mixed = estimate_run(c, counts, 0, 0, 1e6).memory_bytes;
  c.numerics.precision = Precision::double_;
  EXPECT_GT(estimate_run(c, counts, 0, 0, 1e6).memory_bytes, 1.2 * mixed);
}

TEST(Estimate, ATimeToSettleThatIsGivenWins) {
  Case c;
  c.dp = 0.01;
  c.slide.present = true;
  c.soil.initial_stress = InitialStress::settled;
  c.output.end_time = 2;
  const ParticleCounts counts{0, 1000, 500, 0};
  const RunEstimate by_itself = estimate_run(c, counts, 0, 0.5, 1e6, 1);
  EXPECT_NEAR(by_itself.steps * by_itself.time_step, 2 + 5 / soil_sound_speed(c), 2 * by_itself.time_step);
  c.numerics.settle_time = 20;
  const RunEstimate given = estimate_run(c, counts, 0, 0.5, 1e6, 1);
  EXPECT_NEAR(given.steps * given.time_step, 22, 2 * given.time_step);
}

TEST(Estimate, VerletHasItsOwnLimits) {
  Case c;
  c.dimension = 2;
  c.dp = 0.01;
  c.water.present = true;
  c.numerics.integrator = Integrator::verlet;
  c.water.density_diffusion = 0.1, c.water.viscosity_alpha = 0.5;
  // h = 0.015 m, c = 27 m/s: 0.0065 h / (0.1 c) = 3.6111e-5 s; without diffusion 0.1 h / (0.5 c) = 1.1111e-4 s.
  EXPECT_NEAR(estimate_run(c, {}, 27, 0, 1e6).time_step, 3.6111e-5, 1e-9);
  c.water.density_diffusion = 0;
  EXPECT_NEAR(estimate_run(c, {}, 27, 0, 1e6).time_step, 1.1111e-4, 1e-8);
  // Soil, 5 m high: alpha c_s = 3 sqrt(9.81 x 5) = 21.01 m/s; 0.1 x 0.015 / 21.01 = 7.139e-5 s.
  c.water.present = false;
  c.slide.present = true;
  c.soil.young_modulus = 1e6, c.soil.poisson_ratio = 0.3, c.soil.density = 2000, c.soil.stress_diffusion = 0;
  EXPECT_NEAR(estimate_run(c, {}, 0, 5, 1e6).time_step, 7.139e-5, 1e-8);
}

TEST(Estimate, RatesGrowWithThreadsAndFallWithTheDimension) {
  EXPECT_EQ(particle_rate(2, true, 4), 4 * particle_rate(2, true, 1));
  EXPECT_GT(particle_rate(2, false, 1), particle_rate(3, false, 1));
  EXPECT_GT(particle_rate(3, true, 2), 0);
}

TEST(Estimate, ErrorClassIsThatOfTheMeasurements) {
  const ErrorClass fine = expected_error(23, 45);
  EXPECT_EQ(fine.crest, 0.02);
  EXPECT_EQ(fine.pressure, 0.0042);
  EXPECT_EQ(fine.text,
            "error to expect from what was measured: first crest within 2 % (slide thickness); pressure within 0.42 % "
            "of rho g H (water depth)");
  const ErrorClass coarse = expected_error(5, 8.5);
  EXPECT_FALSE(coarse.crest);
  EXPECT_FALSE(coarse.pressure);
  EXPECT_EQ(coarse.text,
            "error to expect from what was measured: first crest not measured below 11 particles (here 5) (slide "
            "thickness); pressure not measured below 10 particles (here 8.5) (water depth)");
  EXPECT_EQ(expected_error({}, 40).text,
            "error to expect from what was measured: pressure within 0.42 % of rho g H (water depth)");
  EXPECT_EQ(expected_error(45, {}).text,
            "error to expect from what was measured: run-out within 1 % (slide thickness)");
  EXPECT_EQ(expected_error({}, {}).text, "error to expect from what was measured: nothing to go by");
}

}  // namespace
}  // namespace lgiw::test
