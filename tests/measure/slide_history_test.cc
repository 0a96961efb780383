// Volumes and shapes of lattice blocks, and profiles through them.
#include "measure/slide_history.hh"

#include <gtest/gtest.h>

#include "base/error.hh"
#include "basin.hh"
#include "files/csv_table.hh"
#include "measure/column_surface.hh"
#include "measure/section_profiles.hh"

namespace lgiw {
namespace {

using namespace test;

// The block of basin.hh: 300 particles of 8 m3, first standing from z = 30 to 40, above the water at 10.

TEST(SlideHistory, VolumesOfABlockThatGoesIntoTheWater) {
  const RunHeader header = basin_header();
  const SlideHistory history(header, basin_frame(header, 30, 20, -28, 0, 0.5), 0.2);
  EXPECT_DOUBLE_EQ(history.total_volume(), 2400);
  const SlideState start = history.state(basin_frame(header, 0, 0, 0, 0, 0));
  EXPECT_DOUBLE_EQ(start.slide_volume, 0);
  EXPECT_DOUBLE_EQ(start.unmoved_volume, 2400);
  EXPECT_DOUBLE_EQ(start.immersed_volume, 0);
  EXPECT_DOUBLE_EQ(start.max_speed, 0);
  EXPECT_NEAR(start.centre[0], 1010, 1e-4);
  EXPECT_NEAR(start.centre[1], 20, 1e-4);
  EXPECT_NEAR(start.centre[2], 535, 1e-4);

  const SlideState middle = history.state(basin_frame(header, 10, 10, -21, 7, 0.5));  // from z = 9 to 19
  EXPECT_DOUBLE_EQ(middle.slide_volume, 2400);
  EXPECT_DOUBLE_EQ(middle.unmoved_volume, 0);
  EXPECT_DOUBLE_EQ(middle.immersed_volume, 240);  // 20 x 12 m, 1 m deep: half of the lowest layer
  EXPECT_DOUBLE_EQ(middle.mean_speed, 7);
  EXPECT_DOUBLE_EQ(middle.p99_speed, 7);
  EXPECT_DOUBLE_EQ(middle.max_speed, 7);
  EXPECT_NEAR(middle.centre[0], 1020, 1e-4);
  EXPECT_NEAR(middle.centre[2], 514, 1e-4);

  EXPECT_DOUBLE_EQ(history.state(basin_frame(header, 30, 20, -28, 0, 0.5)).immersed_volume, 20 * 12 * 8);
}

TEST(SlideHistory, ImmersedVolumeLeavesOutWhatWasImmersedAtTheStart) {
  RunHeader header = basin_header();
  header.initial_soil = soil_block(2, 0, 14, 4);  // 6 m deep in the water
  const Frame last = basin_frame(header, 30, 20, -3, 0, 0.5);
  EXPECT_DOUBLE_EQ(SlideHistory(header, last, 0.2).state(last).immersed_volume, 20 * 12 * 3);
}

TEST(SlideHistory, BookkeepingOfSlidingUnmovedAndLostSoil) {
  const RunHeader header = basin_header();
  Frame frame = basin_frame(header, 30, 20, -28, 3, 0.5);
  for (int k = 0; k < 60; ++k) frame.adps[2 + k] = 0.2f;  // the lowest layer: on the threshold is not above it
  for (int k = 290; k < 297; ++k) frame.lost[2 + k] = 1;
  frame.velocity[3 * (2 + 100)] = 80;  // one grain
  const SlideState state = SlideHistory(header, frame, 0.2f).state(frame);
  EXPECT_DOUBLE_EQ(state.unmoved_volume, 60 * 8);
  EXPECT_DOUBLE_EQ(state.lost_volume, 7 * 8);
  EXPECT_DOUBLE_EQ(state.slide_volume, 233 * 8);
  EXPECT_DOUBLE_EQ(state.slide_volume + state.unmoved_volume + state.lost_volume, 2400);
  EXPECT_DOUBLE_EQ(state.max_speed, 80);
  EXPECT_DOUBLE_EQ(state.p99_speed, 3);
  EXPECT_NEAR(state.mean_speed, (232 * 3 + 80) / 233.0, 1e-12);
  // A stricter threshold finds none.
  const SlideHistory none(header, frame, 0.6);
  EXPECT_DOUBLE_EQ(none.state(frame).slide_volume, 0);
  EXPECT_TRUE(std::isnan(none.state(frame).mean_speed));
  EXPECT_TRUE(std::isnan(none.deposit().length));
}

TEST(SlideHistory, BookkeepingThatDoesNotCloseIsAnError) {
  const RunHeader header = basin_header();
  const SlideHistory history(header, basin_frame(header, 30, 20, -28, 0, 0.5), 0.2);
  Frame frame = basin_frame(header, 30, 20, -28, 0, 0.5);
  frame.adps[50] = NAN;
  try {
    history.state(frame);
    FAIL() << "no error";
  } catch (const WorkError& error) {
    EXPECT_STREQ(
        error.what(),
        "the bookkeeping of the soil does not close at t = 30.000000 s (299 sliding + 0 unmoved + 0 lost are not "
        "300 particles) the run is damaged: make it again");
  }
}

TEST(SlideHistory, ShapeOfTheDepositAlongItsMotion) {
  const RunHeader header = basin_header();
  Frame frame = basin_frame(header, 30, 20, -28, 0, 0.5);
  SlideDeposit deposit = SlideHistory(header, frame, 0.2).deposit();
  EXPECT_NEAR(deposit.direction, 90, 1e-4);  // east
  EXPECT_NEAR(deposit.length, 20, 1e-4);
  EXPECT_NEAR(deposit.width, 12, 1e-4);
  EXPECT_NEAR(deposit.runout, 20, 1e-4);
  EXPECT_NEAR(deposit.height_above_water, 2, 1e-4);

  for (std::size_t k = 2; k < 302; ++k) frame.points[3 * k] -= 20, frame.points[3 * k + 1] -= 8;  // southwards
  frame.points[3 * 150 + 1] = 38;  // a grain on its own, out in front or high up, is not the deposit
  frame.points[3 * 150 + 2] = 70;
  deposit = SlideHistory(header, frame, 0.2).deposit();
  EXPECT_NEAR(deposit.direction, 180, 1);
  EXPECT_NEAR(deposit.length, 12, 0.3);
  EXPECT_NEAR(deposit.width, 20, 0.3);
  EXPECT_NEAR(deposit.height_above_water, 2, 1e-4);
}

TEST(SlideHistory, ThicknessSumsToTheVolume) {
  const RunHeader header = basin_header();
  const Frame last = basin_frame(header, 30, 20, -28, 0, 0.5);
  const std::vector<float> thickness = SlideHistory(header, last, 0.2).thickness();
  double sum = 0;
  for (float t : thickness) sum += std::isnan(t) ? 0 : t;
  EXPECT_NEAR(sum * 4, 2400, 1e-3);
  // The block covers x from 20 to 40 and y from 14 to 26 m.
  EXPECT_FLOAT_EQ(thickness[10 * 51 + 15], 10);  // inside
  EXPECT_FLOAT_EQ(thickness[10 * 51 + 10], 5);   // on its edge
  EXPECT_TRUE(std::isnan(thickness[10 * 51 + 22]));
}

/// 24 m of soil on a flat bed, 40 m by 40 m from the domain's corner on, of which the upper 12 m slide: the strain
/// jumps from 0 to 1 at z = 12, so that its mean crosses one half there.
struct LayeredBlock {
  LayeredBlock() : header(basin_header()) {
    for (double& z : header.particles.bed.z) z = 0;
    header.particles.ground = header.particles.bed;
    header.particles.counts.water = 0;
    for (int k = 0; k < 12; ++k)
      for (int j = 0; j < 20; ++j)
        for (int i = 0; i < 20; ++i) {
          frame.points.insert(frame.points.end(), {float(2 * i + 1), float(2 * j + 1), float(2 * k + 1)});
          frame.adps.push_back(k < 6 ? 0 : 1);
          frame.lost.push_back(0);
        }
    header.particles.counts.soil = int64_t(frame.adps.size());
    header.initial_soil = frame.points;
    frame.velocity.assign(frame.points.size(), 0);
  }
  SectionProfile profile(double x0) const {
    return section_profiles(header, frame, {{"A", {{x0, 20}, {1096, 20}}}}, 0.5).at(0);
  }
  RunHeader header;
  Frame frame;
};

TEST(SectionProfiles, SurfacesAndSlipLineThroughALayeredBlock) {
  LayeredBlock block;
  const SectionProfile profile = block.profile(1004);
  ASSERT_EQ(profile.stations.size(), 47u);  // 92 m, every 2 m
  EXPECT_DOUBLE_EQ(profile.stations[8].x, 20);
  EXPECT_DOUBLE_EQ(profile.bed[8], 500);
  EXPECT_DOUBLE_EQ(profile.ground[8], 500);
  EXPECT_NEAR(profile.soil[8], 524, 0.02);
  EXPECT_NEAR(profile.slip[8], 512, 0.05);
  EXPECT_TRUE(std::isnan(profile.water[8]));
  EXPECT_TRUE(std::isnan(profile.soil[40]));
  EXPECT_TRUE(std::isnan(profile.slip[40]));
  // Sheared right down to the bed, the bed is the slip line; not sheared at all, there is none.
  for (float& adps : block.frame.adps) adps = 1;
  EXPECT_DOUBLE_EQ(block.profile(1004).slip[8], 500);
  for (float& adps : block.frame.adps) adps = 0.4f;
  EXPECT_TRUE(std::isnan(block.profile(1004).slip[8]));
}

TEST(SectionProfiles, SurfacesMeetTheSidesOfTheDomainAsThoseOfTheMapDo) {
  LayeredBlock block;
  ParticleHeader& particles = block.header.particles;
  for (const Side side : {Side::wall, Side::absorbing, Side::open}) {
    particles.sides[0] = side;
    const ColumnSurfaces map =
        column_surfaces(column_particles(particles, block.frame), block.header.map, particles.bed);
    const SectionProfile profile = block.profile(1000);
    for (std::size_t k = 0; k < 10; ++k) {
      const double expected = 500 + double(map.soil[10 * 51 + k]);
      EXPECT_TRUE(std::isnan(expected) ? std::isnan(profile.soil[k]) : std::abs(profile.soil[k] - expected) < 1e-6)
          << k;
    }
    // Behind a wall the block goes on as its image; where the side is open it ends there and its edge is rounded off.
    EXPECT_NEAR(profile.soil[4], 524, 0.02);
    if (side == Side::open)
      EXPECT_LT(profile.soil[1], 523.9);
    else
      EXPECT_NEAR(profile.soil[1], 524, 0.02);
  }
}

TEST(CsvTable, QuotesAndNumbers) {
  CsvTable table({"name", "a,b"});
  table.add(std::string("x\"y"), 0.1);
  table.add(std::string("z"), std::nan(""));
  table.add(std::string(""), 3794050.25);
  EXPECT_EQ(table.text("made by hand"), "# made by hand\nname,\"a,b\"\n\"x\"\"y\",0.1\nz,nan\n,3794050.25\n");
}

}  // namespace
}  // namespace lgiw
