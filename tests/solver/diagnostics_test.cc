// Pressure gauges and the error budget, by hand.
#include "solver/diagnostics.hh"

#include <cmath>

#include "gtest/gtest.h"
#include "physics/water.hh"
#include "solver/water_pressure.hh"

namespace lgiw::test {
namespace {

/// Still water, 1 m deep, 2 m wide, on the lattice that seeding uses.
struct Basin {
  ModelParameters p;
  ParticleState s;
  explicit Basin(int dimension, double dp) {
    p.dimension = dimension, p.dp = dp, p.h = 1.5 * dp, p.sound_speed = 60;
    const EquationOfState<double> eos(p.water_density, p.sound_speed);
    const int n = int(std::lround(1 / dp)), rows = dimension == 3 ? 2 * n : 1;
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < rows; ++j)
        for (int i = 0; i < 2 * n; ++i) {
          const double z = (k + 0.5) * dp, pressure = 1000 * 9.81 * (1 - z);
          s.water_x.insert(s.water_x.end(), {(i + 0.5) * dp, dimension == 3 ? (j + 0.5) * dp : 0, z});
          s.water_pressure.push_back(float(pressure));
          s.water_excess.push_back(float(eos.excess(pressure)));
        }
    s.water_v.assign(s.water_x.size(), 0);
    s.water_lost.assign(s.water_pressure.size(), 0);
  }
};

TEST(PressureGauge, HydrostaticPressureInTheOpenAtWallsAndInCorners) {
  for (int dimension : {2, 3}) {
    const Basin basin(dimension, dimension == 2 ? 0.025 : 0.05);
    const double y = 1;
    const std::vector<std::array<double, 3>> at{{1, y, 0.5},  {1.013, y, 0.207}, {0, y, 0.31},
                                                {0, y, 0},    {0.7, y, 0},       {2, y, 0.6},
                                                {1, y, 0.95}, {1, y, 1.2},       {-0.4, y, 0.3}};
    const std::vector<float> pressure = water_pressures(basin.p, basin.s, at);
    for (std::size_t k = 0; k < 7; ++k)
      EXPECT_NEAR(pressure[k], 9810 * (1 - at[k][2]), 0.002 * 9810) << k << " in " << dimension << "-D";
    EXPECT_EQ(pressure[7], 0) << "above the water";
    EXPECT_EQ(pressure[8], 0) << "behind the wall";
  }
}

TEST(PressureGauge, SprayIsNoPressureAndLostWaterIsNone) {
  Basin basin(2, 0.025);
  // One particle 0.5 dp from the gauge, at q = 1/3: dp^2 W = dp^2 7/(4 pi h^2) (5/6)^4 (5/3) = 0.1990 < 0.2.
  ParticleState& s = basin.s;
  std::fill(s.water_lost.begin(), s.water_lost.end(), 1);
  s.water_lost[0] = 0;
  s.water_pressure[0] = 5000, s.water_excess[0] = 0;
  EXPECT_EQ(water_pressures(basin.p, s, {{0.025, 0, 0.0125}})[0], 0);
  // Right on the gauge the share is 0.2476, and the pressure the particle's own.
  EXPECT_EQ(water_pressures(basin.p, s, {{0.0125, 0, 0.0125}})[0], 5000);
  s.water_lost[0] = 1;
  EXPECT_EQ(water_pressures(basin.p, s, {{0.0125, 0, 0.0125}})[0], 0);
}

}  // namespace
}  // namespace lgiw::test
