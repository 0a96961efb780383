// The basin's shore: straight lines at x = 15 and x = 80, with a run-up of 4 m along the eastern one.
#include "measure/shore.hh"

#include <gtest/gtest.h>

#include "basin.hh"

namespace lgiw {
namespace {

using namespace test;

std::vector<float> highest_water(const RunHeader& header) {
  std::vector<float> highest(header.map.size(), NAN);
  for (int k = 0; k <= 60; ++k) {
    const std::vector<float> water = basin_water(header.map, 0.5 * k);
    for (std::size_t n = 0; n < water.size(); ++n)
      if (!std::isnan(water[n]) && !(water[n] <= highest[n])) highest[n] = water[n];
  }
  return highest;
}

TEST(Shore, LakeAtRestTakesInTheUnmeasuredShallows) {
  RunHeader header = basin_header();
  std::vector<float> water = basin_water(header.map, 0);
  std::size_t wet = 0;
  for (float z : water) wet += !std::isnan(z);
  EXPECT_EQ(wet, 32u * 21);  // x from 16 to 78
  for (std::size_t n = 0; n < water.size(); ++n)
    if (n % 51 == 39) water[n] = NAN;  // x = 78, 1 m deep: say that it was too shallow
  // A depression behind the bank is not the lake.
  for (std::size_t n = 0; n < header.particles.ground.z.size(); ++n)
    if (n % 101 >= 92 && n % 101 <= 96) header.particles.ground.z[n] = 5;
  const std::vector<uint8_t> lake = lake_at_rest(header, water);
  std::size_t count = 0;
  for (uint8_t cell : lake) count += cell;
  EXPECT_EQ(count, 32u * 21);
  EXPECT_EQ(lake[10 * 51 + 39], 1);
  EXPECT_EQ(lake[10 * 51 + 47], 0);
}

TEST(Shore, LinesLieWhereTheGroundMeetsTheLevel) {
  const RunHeader header = basin_header();
  const auto lines = shorelines(header, lake_at_rest(header, basin_water(header.map, 0)));
  ASSERT_EQ(lines.size(), 2u);
  bool west = false, east = false;
  for (const auto& line : lines) {
    const double x = line[0][0] < 50 ? 15 : 80;
    (x < 50 ? west : east) = true;
    double low = 40, high = 0;
    for (const auto& p : line) {
      EXPECT_NEAR(p[0], x, 1e-3);
      low = std::min(low, p[1]), high = std::max(high, p[1]);
    }
    EXPECT_LE(low, 0.01);
    EXPECT_GE(high, 39.99);
  }
  EXPECT_TRUE(west && east);
}

TEST(Shore, RunupAlongIt) {
  const RunHeader header = basin_header();
  const auto lines = shorelines(header, lake_at_rest(header, basin_water(header.map, 0)));
  const auto runup = shore_runup(header, lines, highest_water(header));
  ASSERT_EQ(runup.size(), 2u);
  for (const auto& line : runup) {
    ASSERT_GE(line.size(), 20u);
    EXPECT_NEAR(line.back().distance, 40, 2.1);
    for (const ShorePoint& p : line) {
      // At the start the crest at x = 20 is 1 m high 4 m away, at the western lake's last node x = 16.
      EXPECT_NEAR(p.runup, p.x < 50 ? 1 : 4, 1e-4) << p.x << " " << p.y;
      EXPECT_NEAR(p.runup_elevation, p.x < 50 ? 11 : 14, 1e-4);
    }
  }
}

TEST(Shore, SoilInTheLakeIsNoShore) {
  const RunHeader header = basin_header();
  const auto lines = shorelines(header, lake_at_rest(header, basin_water(header.map, 0)));
  std::vector<float> highest = highest_water(header);
  for (std::size_t n = 0; n < highest.size(); ++n) {
    const std::size_t i = n % 51, j = n / 51;
    if (i >= 8 && i <= 11 && j >= 9 && j <= 11) highest[n] = NAN;  // x from 16 to 22, y from 18 to 22
  }
  for (const auto& line : shore_runup(header, lines, highest))
    for (const ShorePoint& p : line) EXPECT_NEAR(p.runup, p.x < 50 ? 1 : 4, 1e-4) << p.y;
}

TEST(Shore, RunupIsAtLeastStillLevel) {
  const RunHeader header = basin_header();
  std::vector<float> highest = basin_water(header.map, 100);  // the wave is gone
  for (float& z : highest) z -= 0.3f;                         // and the surface measured a little low
  const auto lines = shorelines(header, lake_at_rest(header, highest));
  for (const auto& line : shore_runup(header, lines, highest))
    for (const ShorePoint& p : line) EXPECT_DOUBLE_EQ(p.runup, 0);
}

TEST(Shore, HazardClasses) {
  RunHeader header = basin_header();
  header.map.nx = 6, header.map.ny = 1;
  const std::vector<uint8_t> lake{1, 1, 1, 0, 0, 0};
  const std::vector<float> elevation{10.5, 11, 13.1f, 20, 20, NAN}, depth{9, 9, 9, 0.4f, 3, NAN};
  const std::vector<uint8_t> expected{1, 2, 3, 1, 2, 0};
  EXPECT_EQ(hazard_classes(header, lake, elevation, depth), expected);
}

}  // namespace
}  // namespace lgiw
