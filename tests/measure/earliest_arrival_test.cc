// The earliest times of a slide's wave, on a flat bed where they can be told on paper.
#include "measure/earliest_arrival.hh"

#include <gtest/gtest.h>

#include <cmath>

#include "basin.hh"
#include "measure/surface_sampling.hh"

namespace lgiw {
namespace {

using namespace test;

constexpr std::size_t nx = 101, ny = 81;

/// A lake of 1000 x 800 m in cells of 10 m, with one piece of soil at (200, 400). The kernel reaches 3 x 4 m: a cell
/// on.
RunHeader lake() {
  RunHeader header;
  header.particles.dp = 4;
  header.particles.bed = {2, 2, 0, 0, 1000, {0, 0, 0, 0}};
  header.particles.ground = header.particles.bed;
  header.map = {nx, ny, 0, 0, 10};
  header.initial_soil = {201, 398, 5};
  return header;
}
std::size_t node(double x, double y) { return std::size_t(y / 10) * nx + std::size_t(x / 10); }
std::vector<float> everywhere(float value) { return std::vector<float>(nx * ny, value); }

TEST(EarliestArrival, GoesWithTheFastestWaveAndIsABoundInAnyDirection) {
  const Case c;
  const double speed = 4 + std::sqrt(9.81 * 40);
  const auto earliest = earliest_arrival(lake(), c, everywhere(40), everywhere(4), {});
  EXPECT_EQ(earliest[node(200, 400)], 0);
  EXPECT_EQ(earliest[node(220, 420)], 0) << "within the kernel's reach, rounded up to cells";
  for (const auto& [x, y] : {std::pair{900.0, 400.0}, {200.0, 800.0}, {600.0, 800.0}, {800.0, 600.0}, {0.0, 0.0}}) {
    // From the edge of the source, a square of 20 m to either side.
    const double way = std::hypot(std::max(0.0, std::abs(x - 200) - 20), std::max(0.0, std::abs(y - 400) - 20));
    EXPECT_LE(earliest[node(x, y)], way / speed * (1 + 1e-9)) << x << " " << y;
    EXPECT_GE(earliest[node(x, y)], 0.92 * way / speed) << x << " " << y;
  }
}

TEST(EarliestArrival, TakesTheSlideWhereItIsFasterAndOnDryLand) {
  std::vector<float> depth = everywhere(NAN), soil_speed = everywhere(NAN);
  for (std::size_t n = 0; n < depth.size(); ++n)
    if (n % nx >= 50) depth[n] = 40;                                      // the lake begins at x = 500
  for (double x = 200; x <= 400; x += 10) soil_speed[node(x, 400)] = 30;  // the slide's way, and dry ground between
  const auto earliest = earliest_arrival(lake(), Case(), depth, depth, soil_speed);
  const double straight = std::cos(M_PI / 8), water = 40 + std::sqrt(9.81 * 40);
  EXPECT_NEAR(earliest[node(400, 400)], straight * 180 / 30, 1e-9);
  EXPECT_NEAR(earliest[node(490, 400)], straight * 270 / 30, 1e-9);
  EXPECT_NEAR(earliest[node(700, 400)], straight * (270 / 30.0 + 210 / water), 1e-9);
}

TEST(EarliestArrival, OfARigidSlideStartsWhereItLies) {
  RunHeader header = lake();
  header.initial_soil.clear();
  header.particles.ground.nx = 101, header.particles.ground.ny = 81, header.particles.ground.dx = 10;
  header.particles.ground.z.assign(nx * ny, 0);
  header.particles.ground.z[node(500, 400)] = 7;
  header.particles.bodies = {{"slide", {}, 90, {0, 2, 4}, {0, 0, 0}, {{0, 0, 0}, {30, 0, -40}, {40, 0, -40}}}};
  const auto earliest = earliest_arrival(header, Case(), everywhere(1), everywhere(0), {});
  EXPECT_EQ(earliest[node(500, 400)], 0);
  EXPECT_NEAR(earliest[node(820, 400)], std::cos(M_PI / 8) * 300 / 25, 1e-9)
      << "50 m in 2 s, faster than shallow water";
}

TEST(EarliestArrival, IsTheStartWhereTheWaterMovesByItself) {
  const std::vector<double> start(nx * ny, 0);
  RunHeader none = lake();
  none.initial_soil.clear();
  EXPECT_EQ(earliest_arrival(none, Case(), everywhere(40), everywhere(4), {}), start);
  Case wave, column, gate;
  wave.water.wave.emplace();
  column.water.bodies.resize(1);
  gate.bodies.resize(1);
  for (const Case& c : {wave, column, gate})
    EXPECT_EQ(earliest_arrival(lake(), c, everywhere(40), everywhere(4), {}), start);
}

TEST(EarliestArrival, NearAPlaceIsTheLeastAround) {
  const auto earliest = earliest_arrival(lake(), Case(), everywhere(40), everywhere(4), {});
  const SurfaceMap map = lake().map;
  EXPECT_EQ(earliest_near(map, earliest, 702, 397), earliest[node(690, 400)]);
  EXPECT_EQ(earliest_near(map, earliest, -3, 802),
            earliest[node(0, 790)] < earliest[node(10, 790)] ? earliest[node(0, 790)] : earliest[node(10, 790)]);
  EXPECT_EQ(earliest_near(map, earliest, -30, 802), 0);
}

TEST(EarliestArrival, OfAFlumeGoesAlongIt) {
  RunHeader header = lake();
  header.map = {nx, 1, 0, 0, 10};
  const auto earliest = earliest_arrival(header, Case(), std::vector<float>(nx, 10), {}, {});
  EXPECT_NEAR(earliest[90], 680 / std::sqrt(98.1), 1e-9) << "no way round: exactly";
}

}  // namespace
}  // namespace lgiw
