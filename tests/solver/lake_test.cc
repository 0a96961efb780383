// Water alone at rest in a real canyon, coarser than pipelines/lake-at-rest so that it takes seconds.
#include <gtest/gtest.h>

#include <cstdio>

#include "base/error.hh"
#include "case_run.hh"

namespace lgiw::test {
namespace {

/// A lake 60 s long. What is left of the settling decays as the bulk's viscosity says where the bed holds the water;
/// the water along slipping ones moves on about twice as fast (docs/verification.md), so that the bars differ: energy
/// and speed at 60 s over those at 10 s, and that speed over the speed of long waves.
void expect_calm(const char* walls, double energy, double speed, double fastest) {
  Case c = read_case(LGIW_SOURCE_DIR "/pipelines/lake-at-rest/case.yaml",
                     {"particle_spacing=30", std::string("water.walls=") + walls});
  CaseRun run(c);
  ASSERT_GT(run.data.water.size(), 3000u);
  EXPECT_EQ(run.data.soil.size(), 0u);
  const double depth = 140, wave = std::sqrt(9.81 * depth);
  run.simulation->settle(Settling::water);
  run.at(c.numerics.settle_time);
  run.simulation->settle(Settling::off);
  double energy_at_10 = 0;
  std::vector<double> speeds;
  ParticleState s;
  for (int t = 0; t <= 60; t += 10) {
    s = run.at(t);
    speeds.push_back(run.diagnostic(s, "max_water_speed"));
    if (t == 10) energy_at_10 = run.diagnostic(s, "kinetic_energy");
  }
  std::printf(
      "measured: lake at rest, dp 30 m, %s: fastest particle %.2f m/s at 10 s, %.2f m/s at 60 s (0.01 sqrt(g h) = "
      "%.2f)\n",
      walls, speeds[1], speeds[6], 0.01 * wave);
  // Long waves decay slowest: energy by exp(-4 nu k^2 t) with nu = alpha c h / 10 = 90 m2/s; across the reservoir, 800
  // m wide, k = 2 pi / 800 m: to 0.33 in 50 s. Shorter ones are gone, and a fifth may have come as noise.
  EXPECT_LT(run.diagnostic(s, "kinetic_energy"), energy * energy_at_10);
  EXPECT_LT(speeds[6], speed * speeds[1]);
  EXPECT_LT(speeds[6], fastest * wave);  // 5 particles deep; the bar of 0.01 is for the case's own spacing
  EXPECT_EQ(run.diagnostic(s, "below_bed"), 0);
  EXPECT_EQ(run.simulation->state().lost_water, 0);

  std::vector<float> xyz(s.water_x.begin(), s.water_x.end());
  ColumnParticles columns;
  columns.dimension = 3, columns.dp = 30, columns.h = 45;
  columns.n_water = s.water_x.size() / 3, columns.xyz = xyz.data();
  for (const Gauge& gauge : c.gauges) {
    const SurfaceMap here{1, 1, gauge.x - run.data.header.origin[0], gauge.y - run.data.header.origin[1], 30};
    const ColumnSurfaces surface = column_surfaces(columns, here, run.data.header.bed);
    EXPECT_NEAR(surface.water[0], 740, 0.1 * 30) << gauge.name;
  }
}

TEST(LakeAtRest, RealCanyonCalmsDownAndKeepsItsLevel) { expect_calm("no_slip", 0.4, 0.4, 0.015); }
TEST(LakeAtRest, RealCanyonWithASlippingBedCalmsDownMoreSlowly) { expect_calm("free_slip", 0.6, 0.6, 0.035); }

}  // namespace
}  // namespace lgiw::test
