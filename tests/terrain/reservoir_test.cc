// Reservoirs small enough to fill by hand.
#include "hand_rasters.hh"

namespace lgiw {
namespace {

using namespace test;

struct Reservoirs : testing::Test {
  Scratch scratch;
  // A lake of five cells around (35, 25), a hollow beside it that touches it over a corner only, and a far one. From
  // the north, 10 m cells, level 10.
  const std::vector<std::vector<double>> rows = {{20, 20, 20, 20, 20, 20},
                                                 {20, 20, 20, 20, 4, 20},
                                                 {20, 20, 6, 7, 20, 20},
                                                 {20, 20, 8, 9, 10, 20},
                                                 {1, 20, 5, 20, 20, 20}};
  Case c = raster_case({write_asc(scratch("lake.asc"), 0, 0, 10, rows)});
  void SetUp() override {
    c.water.present = true;
    c.water.level = 10;
    c.water.seed = Point2{33, 27};
  }
};

TEST_F(Reservoirs, OnlyWhatIsConnectedToTheSeed) {
  const TerrainModel model = build(c);
  EXPECT_DOUBLE_EQ(model.reservoir_area, 500);  // 6 7 8 9 5; not 4 (corner), not 10 (at the level), not 1
  EXPECT_DOUBLE_EQ(model.reservoir_volume, (4 + 3 + 2 + 1 + 5) * 100);
  EXPECT_DOUBLE_EQ(model.max_water_depth, 5);
  EXPECT_EQ(model.wet[0 * 6 + 2], 1);
  EXPECT_EQ(model.wet[3 * 6 + 4], 0);
  EXPECT_EQ(model.wet[0], 0);
  EXPECT_DOUBLE_EQ(model.still_water_level, 10);
}

TEST_F(Reservoirs, WithoutWaterThereIsNoLevel) {
  c.water.present = false;
  const TerrainModel model = build(c);
  EXPECT_TRUE(std::isnan(model.still_water_level));
  EXPECT_EQ(model.reservoir_area, 0);
}

TEST_F(Reservoirs, SeedOnDryLandNamesTheNearestWetPlace) {
  c.water.seed = Point2{12, 24};
  const std::string error = error_of(c);
  EXPECT_HAS(error, "water.seed 12, 24 is on dry land (the ground there is at 20 m, the level at 10 m)");
  EXPECT_HAS(error, "the nearest place below the level is 25, 25 (ground 6 m, 10 m away)");
}

TEST_F(Reservoirs, SeedOutside) {
  c.water.seed = Point2{100, 24};
  EXPECT_HAS(error_of(c), "water.seed 100, 24 lies outside the domain (it covers x 5 to 55, y 5 to 45)");
}

TEST_F(Reservoirs, SeedMissing) {
  c.water.seed.reset();
  EXPECT_HAS(error_of(c), "water.seed is missing");
}

TEST_F(Reservoirs, LevelAboveOrBelowEverything) {
  c.water.level = 25;
  EXPECT_HAS(error_of(c), "water.level 25 m is above the whole terrain (its highest place is at 20 m");
  c.water.level = 0.5;
  EXPECT_HAS(error_of(c), "water.level 0.5 m is below the whole terrain (its lowest place is at 1 m)");
}

TEST_F(Reservoirs, OpenSideThatTheWaterReaches) {
  c.terrain.south = Side::open;
  EXPECT_HAS(error_of(c), "terrain.sides.south is open, but the reservoir reaches it (at 25, 5 it is 5 m deep");
  c.terrain.south = Side::absorbing;
  c.terrain.west = Side::open;  // the hollow at the western side is not the reservoir
  EXPECT_DOUBLE_EQ(build(c).reservoir_area, 500);
}

}  // namespace
}  // namespace lgiw
