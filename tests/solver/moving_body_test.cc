// Bodies that move as prescribed, against what they must do to the water.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "case_run.hh"

namespace lgiw::test {
namespace {

namespace fs = std::filesystem;

/// A piston 30 mm thick pushes still water 0.15 m deep and has reached 0.1 m/s after 0.5 s, slowly enough for long
/// waves. Those run into still water on both sides, along which sqrt(g depth) -+ u/2 stays what it was (Riemann): the
/// water beside the piston stands (sqrt(g d) + U/2)^2/g - d = 12.6 mm higher ahead and 12.1 mm lower behind.
TEST(MovingBody, APistonRaisesTheWaterAheadAndDrawsItDownBehind) {
  const double u = 0.1, d = 0.15, start = 0.5, end = 1.3, g = 9.81;
  const fs::path motion = fs::temp_directory_path() / ("lgiw-piston-" + std::to_string(getpid()) + ".csv");
  {
    std::ofstream file(motion);
    file << "t_s,dx_m,dz_m\n";
    for (int k = 0; k <= 75; ++k) {
      const double t = 0.02 * k;
      file << t << ',' << (t < start ? 0.5 * u * t * t / start : u * (t - 0.5 * start)) << ",0\n";
    }
  }
  CaseRun run(
      "name: piston\ndimension: 2\nparticle_spacing: 0.01\nterrain: {profile: [[0, 0], [3.6, 0]]}\n"
      "water: {level: 0.15, viscosity_alpha: 0.05}\n"
      "bodies: [{name: piston, outline: [[1.77, 0], [1.8, 0], [1.8, 0.25], [1.77, 0.25]], motion: " +
      motion.string() + "}]\n");
  fs::remove(motion);
  const ParticleState s = run.at(end);
  std::vector<double> x;
  std::vector<unsigned> id;
  run.simulation->download_bodies(x, id);
  ASSERT_EQ(x.size(), 3 * id.size());
  ASSERT_EQ(id.size(), 75u);
  for (std::size_t i = 0; i < id.size(); ++i) {
    EXPECT_NEAR(x[3 * i] - run.data.wall.points[3 * id[i]], u * (run.simulation->state().time - 0.5 * start), 1e-6);
    EXPECT_EQ(run.data.wall.body[id[i]], 1);
  }
  const double piston = 1.8 + u * (end - 0.5 * start);
  // Means over 0.4 m on both sides of the piston.
  const auto mean = [&](double from) {
    const std::size_t n = 40;
    double sum = 0;
    for (float z : run.surfaces(s, from, 0.4 / n, n).water) sum += z / n;
    return sum - d;
  };
  const double ahead = mean(piston + 0.05), behind = mean(piston - 0.03 - 0.45), c = std::sqrt(g * d);
  const double higher = std::pow(c + u / 2, 2) / g - d, lower = std::pow(c - u / 2, 2) / g - d;
  std::printf("measured: piston, %.4f m ahead (%.4f), %.4f m behind (%.4f)\n", ahead, higher, behind, lower);
  EXPECT_NEAR(ahead, higher, 0.04 * higher);
  EXPECT_NEAR(behind, lower, -0.04 * lower);
  // It holds water back: none has crossed it.
  for (std::size_t i = 0; i < s.water_x.size(); i += 3)
    EXPECT_EQ(s.water_x[i] > piston - 0.015, run.data.water.points[i] > 1.785) << i / 3;
}

}  // namespace
}  // namespace lgiw::test
