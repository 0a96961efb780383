// Scenes drawn as profiles.
#include <algorithm>
#include <cmath>

#include "hand_rasters.hh"
#include "terrain/analytic_terrain.hh"

namespace lgiw {
namespace {

using namespace test;

Case profile_case(int dimension, std::vector<Point2> profile, double dp) {
  Case c;
  c.dimension = dimension;
  c.dp = dp;
  c.terrain.profile = std::move(profile);
  return c;
}

TEST(Profile, KinksLieOnNodes) {
  // 2.2 m with kinks at 0.15 and 1.0: a spacing of 0.01 / 2 hits both.
  const Case c = profile_case(2, {{0, 0.3}, {0.15, 0}, {1.0, 0.1}, {2.2, 0.1}}, 0.01);
  const TerrainModel model = build(c);
  EXPECT_NEAR(model.ground.dx, 0.005, 1e-12);
  EXPECT_EQ(model.ground.nx, 441u);
  EXPECT_EQ(model.ground.ny, 1u);
  EXPECT_NEAR(model.ground.z[30], 0, 1e-12);
  EXPECT_NEAR(model.ground.z[200], 0.1, 1e-12);
  EXPECT_NEAR(model.ground.height(0.075, 0), 0.15, 1e-12);
  EXPECT_NEAR(model.ground.height(0.575, 0), 0.05, 1e-12);
  EXPECT_EQ(model.ground.z, model.bed.z);
  EXPECT_TRUE(std::isnan(model.still_water_level));
  EXPECT_EQ(model.crs_wkt, "");
  EXPECT_EQ(model.origin[0], 0);
}

TEST(Profile, SpacingMovesToMeetAKink) {
  // Kink at 1 of 3.5: 0.5 divides both, the largest such below 0.6 and above 0.15.
  EXPECT_NEAR(detail::profile_spacing({{0, 0}, {1, 1}, {3.5, 1}}, 0, 0.6), 0.5, 1e-12);
  // A kink that no spacing meets is met to a hundredth of the wanted spacing or so.
  const double dx = detail::profile_spacing({{0, 0}, {1 / std::sqrt(2.0), 1}, {3.5, 1}}, 0, 0.1);
  const double steps = 1 / std::sqrt(2.0) / dx;
  EXPECT_LT(std::abs(steps - std::round(steps)) * dx, 0.01 * 0.1);
  EXPECT_GE(dx, 0.025 * (1 - 1e-12));
}

TEST(Profile, ThreeDimensionsHaveTheSameHeightForAllY) {
  Case c = profile_case(3, {{-1, 1}, {0, 0}, {2, 0}}, 0.2);
  c.terrain.width = 0.6;
  const TerrainModel model = build(c);
  EXPECT_NEAR(model.ground.dx, 0.1, 1e-12);
  EXPECT_EQ(model.ground.nx, 31u);
  EXPECT_EQ(model.ground.ny, 7u);
  EXPECT_NEAR(model.ground.y_max(), 0.6, 1e-12);
  for (std::size_t j = 0; j < 7; ++j) EXPECT_NEAR(model.ground.at(5, j), 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(model.domain[3], 0.6);
}

TEST(Profile, WaterVolumeIsThePolygonsArea) {
  // A 45 degree slope into a basin 1 m deep and 2 m long: 0.5 + 2 m2, surface 3 m.
  Case c = profile_case(2, {{-2, 2}, {0, 0}, {2, 0}}, 0.1);
  c.water.present = true;
  c.water.level = 1;
  TerrainModel model = build(c);
  EXPECT_NEAR(model.reservoir_volume, 2.5, 1e-9);
  EXPECT_NEAR(model.reservoir_area, 3, 1e-9);
  EXPECT_NEAR(model.max_water_depth, 1, 1e-12);
  c.dimension = 3;
  c.terrain.width = 4;
  model = build(c);
  EXPECT_NEAR(model.reservoir_volume, 10, 1e-9);
  // A shore between nodes: level 0.97 gives 0.97^2 / 2 + 2 x 0.97.
  c.dimension = 2;
  c.water.level = 0.97;
  EXPECT_NEAR(build(c).reservoir_volume, 0.5 * 0.97 * 0.97 + 2 * 0.97, 1e-9);
}

TEST(Profile, SeedChoosesTheBasin) {
  Case c = profile_case(2, {{0, 1}, {1, 0}, {2, 1}, {3, -1}, {4, 1}}, 0.1);
  c.water.present = true;
  c.water.level = 0.5;
  c.water.seed = Point2{1, 0};
  const TerrainModel model = build(c);
  EXPECT_NEAR(model.reservoir_volume, 0.25, 1e-9);  // a triangle 1 m wide and 0.5 m deep
  EXPECT_NEAR(model.max_water_depth, 0.5, 1e-12);
  c.water.seed = Point2{2, 0};
  EXPECT_HAS(error_of(c), "water.seed: x = 2 is on dry land (the ground there is at 1 m, the level at 0.5 m)");
  c.water.seed = Point2{7, 0};
  EXPECT_HAS(error_of(c), "lies outside the domain");
}

TEST(Profile, BodiesMarkTheirColumns) {
  Case c = profile_case(2, {{0, 0}, {4, 0}}, 0.2);
  c.water.present = true;
  c.water.level = 1;
  c.water.bodies = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  c.slide.present = true;
  c.slide.bodies = {{{3, 0}, {3.5, 0}, {3, 0.5}}};
  const TerrainModel model = build(c);
  EXPECT_EQ(std::count(model.wet.begin(), model.wet.end(), 1), 11);     // 0 to 1 in steps of 0.1
  EXPECT_EQ(std::count(model.slide.begin(), model.slide.end(), 1), 6);  // 3 to 3.5
}

TEST(Profile, Errors) {
  EXPECT_HAS(error_of(profile_case(2, {{0, 1}, {1, 0}, {1, 1}}, 0.1)), "x does not increase at point 3 (x = 1)");
  EXPECT_HAS(error_of(profile_case(2, {{0, 1}}, 0.1)), "fewer than two points");
  EXPECT_HAS(error_of(profile_case(3, {{0, 1}, {1, 1}}, 0.1)), "terrain.width is missing");
  EXPECT_HAS(error_of(profile_case(2, {}, 0.1)), "the case has no terrain");
  EXPECT_HAS(error_of(profile_case(2, {{0, 1}, {1e6, 1}}, 1e-3)), "terrain nodes");
  Case c = profile_case(2, {{0, 0}, {1, 0}}, 0.1);
  c.water.present = true;
  c.water.level = -1;
  EXPECT_HAS(error_of(c), "water.level -1 m is below the whole terrain");
  c.water.level = 1;
  c.terrain.east = Side::open;
  EXPECT_HAS(error_of(c), "terrain.sides.east is open, but the water reaches it (it is 1 m deep");
}

}  // namespace
}  // namespace lgiw
