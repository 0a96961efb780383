// Where walls are needed, on a valley that one can work out by hand.
#include <algorithm>
#include <cmath>

#include "hand_rasters.hh"

namespace lgiw {
namespace {

using namespace test;

// A V-shaped valley along y: z = |x - 500|, 10 m cells, 1000 x 400 m.
struct Valley : testing::Test {
  Scratch scratch;
  Case c = raster_case({write_asc(scratch("valley.asc"), 0, 0, 10,
                                  rows_of(100, 40, 0, 0, 10, [](double x, double) { return std::abs(x - 500); }))});
  void SetUp() override {
    c.dp = 1;
    c.numerics.h_over_dp = 1.5;  // widened by 4 m: one node
    c.water.present = true;
    c.water.level = 100;
    c.water.seed = Point2{505, 200};
  }
  static std::pair<int, int> columns(const std::vector<uint8_t>& reached, std::size_t nx, std::size_t row) {
    const auto* first = reached.data() + row * nx;
    const int low = int(std::find(first, first + nx, 1) - first);
    int high = int(nx) - 1;
    while (high >= 0 && !first[high]) --high;
    return {low, high};
  }
};

TEST_F(Valley, WaterReachesLevelPlusAllowance) {
  c.terrain.runup_allowance = 50;  // ground below 150: x - 500 in (-150, 150), centres 355 to 645: columns 35 to 64
  const TerrainModel model = build(c);
  const auto reached = reachable_nodes(model, c);
  EXPECT_EQ(columns(reached, 100, 0), std::pair(34, 65));  // one more for the kernel
  EXPECT_EQ(std::count(reached.begin(), reached.end(), 1), 40 * 32);
  c.terrain.runup_allowance = 0;  // automatic, no slide: 10 dp = 10 m, below 110: 395 to 605
  EXPECT_EQ(columns(reachable_nodes(model, c), 100, 17), std::pair(38, 61));
}

TEST_F(Valley, SoilReachesTheEnergyLine) {
  c.water.present = false;
  c.slide.present = true;
  c.slide.polygon = {{100, 150}, {200, 150}, {200, 250}, {100, 250}};
  c.slide.surface.depth = 10;
  c.terrain.reach_angle = 11;
  const TerrainModel model = build(c);
  const auto reached = reachable_nodes(model, c);
  // From the top (x = 105, z = 395) the line falls 0.19438 per m. On the far bank z = x - 500 <= 395 - 0.19438 (x -
  // 105) up to x = 766.4 in the slide's own row: centre 765, column 76, and one more.
  const std::size_t row = 15;  // y = 155, the first node of the slide from the south
  EXPECT_EQ(columns(reached, 100, row).second, 77);
  // Nothing above the slide but the margin: column 10 is the slide's first, at its own height only the top counts.
  EXPECT_EQ(columns(reached, 100, row).first, 9);
  // Along the valley the distance counts as well: at y = 395 from (105, 155), 240 m north.
  double limit = 0;
  for (double x = 505; x < 1000; x += 10)
    if (x - 500 <= 395 - std::tan(11 * M_PI / 180) * std::hypot(x - 105, 240)) limit = x;
  EXPECT_EQ(columns(reached, 100, 39).second, int((limit - 5) / 10) + 1);
}

TEST_F(Valley, BothTogetherAndAutomaticAllowance) {
  c.slide.present = true;
  c.slide.polygon = {{100, 150}, {200, 150}, {200, 250}, {100, 250}};
  c.slide.surface.depth = 10;
  c.terrain.reach_angle = 40;  // soil stays on this bank, and at y = 5 above all of it
  const TerrainModel model = build(c);
  const auto reached = reachable_nodes(model, c);
  // Half the drop from 395 to 100: 147.5, banks below 247.5: centres 255 to 745 (columns 25 to 74), one more.
  EXPECT_EQ(columns(reached, 100, 0), std::pair(24, 75));
  for (std::size_t k = 0; k < reached.size(); ++k) {
    if (model.wet[k] || model.slide[k]) {
      ASSERT_EQ(reached[k], 1);
    }
  }
}

TEST_F(Valley, HollowsBehindARidgeStayOut) {
  // The same valley with a second one, as deep, from x = 1000 on: below level + allowance, but not connected.
  c = raster_case({write_asc(scratch("two.asc"), 0, 0, 10, rows_of(200, 40, 0, 0, 10, [](double x, double) {
                               return std::abs(std::fmod(x, 1000) - 500);
                             }))});
  SetUp();
  const TerrainModel model = build(c);
  const auto reached = reachable_nodes(model, c);
  EXPECT_EQ(columns(reached, 200, 3).second, 61);
}

TEST(Reachable, TujungaGrowsWithTheAllowanceAndStaysPartial) {
  Case c = raster_case({LGIW_SOURCE_DIR "/pipelines/demo/terrain/big_tujunga_srtm30_utm11.tif"}, 20);
  c.water.present = true;
  c.water.level = 740;
  c.water.seed = Point2{388313.655 + 30 * 80.5, 3798017.828 - 30 * 86.5};
  const TerrainModel model = build(c);
  int64_t last = std::count(model.wet.begin(), model.wet.end(), 1);
  for (const double allowance : {20, 60, 120}) {
    c.terrain.runup_allowance = allowance;
    const auto reached = reachable_nodes(model, c);
    const int64_t count = std::count(reached.begin(), reached.end(), 1);
    EXPECT_GT(count, last);
    EXPECT_LT(count, int64_t(reached.size()));
    last = count;
  }
}

TEST(Reachable, AnalyticScenesEverywhere) {
  Case c;
  c.dimension = 2;
  c.dp = 0.1;
  c.terrain.profile = {{0, 1}, {1, 0}, {2, 0}};
  const TerrainModel model = build(c);
  const auto reached = reachable_nodes(model, c);
  EXPECT_EQ(std::count(reached.begin(), reached.end(), 1), int64_t(model.ground.nx));
}

}  // namespace
}  // namespace lgiw
