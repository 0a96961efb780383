// Slides whose way into the water is known: what is measured of them as they pass the shoreline.
#include "measure/slide_entry.hh"

#include <gtest/gtest.h>

#include <filesystem>

#include <cmath>
#include <numbers>

#include "../tools/tool_runner.hh"
#include "basin.hh"
#include "measure/section_runup.hh"

namespace lgiw {
namespace {

using namespace test;

/// A slope of 45 degrees down to z = -100 at x = 100, the still water at z = 0 and its shoreline at x = 0; flat beyond.
ParticleHeader slope(int dimension) {
  ParticleHeader p;
  p.dimension = dimension, p.dp = 1;
  p.origin = {1000, 2000, 500};
  p.still_water_level = 0;
  p.low = {-200, 0, -101}, p.high = {400, 100, 300};
  p.bed.x0 = -200, p.bed.nx = 601, p.bed.ny = dimension == 3 ? 101 : 1;
  for (std::size_t n = 0; n < p.bed.nx * p.bed.ny; ++n) p.bed.z.push_back(std::max(-100.0, 200 - double(n % p.bed.nx)));
  p.ground = p.bed;
  return p;
}

/// A slab on the slope, pieces 1 m apart in rows along it: `length` by `thickness` (in 3-D 20 wide, y from 40 to 60),
/// its front `back` m up the slope from the shoreline, moved `way` m down it, at `speed`.
SlidePieces slab(int dimension, int length, int thickness, double back, double way, double speed) {
  SlidePieces pieces;
  const double r = std::sqrt(0.5);
  for (int j = 0; j < (dimension == 3 ? 20 : 1); ++j)
    for (int l = 0; l < length; ++l)
      for (int t = 0; t < thickness; ++t) {
        const double along = way - back - (l + 0.5), up = t + 0.5;
        pieces.points.insert(pieces.points.end(), {float(r * (along + up)), dimension == 3 ? 40.5f + float(j) : 0.f,
                                                   float(r * (up - along))});
        pieces.velocity.insert(pieces.velocity.end(), {float(r * speed), 0, float(-r * speed)});
      }
  return pieces;
}

void expect_slab(const SlideEntry& entry, int dimension) {
  EXPECT_NEAR(entry.volume, 40 * 8 * (dimension == 3 ? 20 : 1), 1e-9);
  EXPECT_EQ(entry.submerged_volume, 0);
  EXPECT_NEAR(entry.speed, 10, 1e-4);
  EXPECT_NEAR(entry.slope, 45, 1e-3);
  EXPECT_NEAR(entry.thickness, 8, 0.4);
  EXPECT_NEAR(entry.width, dimension == 3 ? 20 : 1, 1e-4);
  EXPECT_NEAR(entry.direction, 90, 1e-6);
  EXPECT_NEAR(entry.x, 1000, 1e-3);
  EXPECT_NEAR(entry.travel_slope, 45, 1e-2);
}

TEST(SlideEntry, SlabOfKnownSpeedAndThickness) {
  for (const int dimension : {2, 3}) {
    const ParticleHeader header = slope(dimension);
    for (const double step : {0.25, 1.0}) {  // whatever the frame interval
      SlideEntryRecorder recorder(header, 1, 1);
      for (double t = 0; t <= 12; t += step) recorder.add(t, slab(dimension, 40, 8, 30, 10 * t, 10));
      const SlideEntry entry = recorder.entry();
      expect_slab(entry, dimension);
      // Its top passes from 2.2 to 6.2 s, its base from 3 to 7 s: a tenth of it in the first and the last 0.8 s.
      EXPECT_NEAR(entry.start, 2.2 + 0.8 * std::sqrt(0.5), 0.05);
      EXPECT_NEAR(entry.end, 7 - 0.8 * std::sqrt(0.5), 0.05);
    }
  }
}

TEST(SlideEntry, WaterThatSlowsTheSlideDoesNotSpoilItsSpeed) {
  // Once under water it creeps.
  const ParticleHeader header = slope(2);
  SlideEntryRecorder recorder(header, 1, 1);
  SlidePieces last;
  for (double t = 0; t <= 12; t += 0.25) {
    SlidePieces pieces = slab(2, 40, 8, 30, 10 * t, 10);
    for (std::size_t k = 0; k < pieces.points.size(); k += 3)
      if (pieces.points[k + 2] < -1) pieces.velocity[k] = 1, pieces.velocity[k + 2] = -0.1f;
    recorder.add(t, pieces);
  }
  EXPECT_NEAR(recorder.entry().speed, 10, 1e-4);
  EXPECT_NEAR(recorder.entry().slope, 45, 1e-3);
}

TEST(SlideEntry, OnlyWhatSinksBelowTheLevelCounts) {
  const ParticleHeader header = slope(2);
  SlideEntryRecorder stops(header, 1, 1), starts_wet(header, 1, 1), dry(header, 1, 1);
  for (double t = 0; t <= 12; t += 0.5) {
    stops.add(t, slab(2, 40, 8, 30, std::min(10 * t, 50.0), 10));  // half of it stays on the bank
    starts_wet.add(t, slab(2, 40, 8, -60, 10 * t, 10));            // 60 m below, wholly submerged
    dry.add(t, slab(2, 40, 8, 30, t, 1));
  }
  EXPECT_LT(stops.entry().volume, 0.55 * 320);
  EXPECT_GT(stops.entry().volume, 0.35 * 320);
  EXPECT_EQ(starts_wet.entry().volume, 0);
  EXPECT_EQ(starts_wet.entry().submerged_volume, 320);
  EXPECT_EQ(dry.entry().volume, 0);
  EXPECT_TRUE(std::isnan(dry.entry().speed));
}

TEST(SlideEntry, ABlockThatFallsFromAboveTheLake) {
  const ParticleHeader header = slope(2);
  SlideEntryRecorder recorder(header, 1, 1);
  for (double t = 0; t <= 4; t += 0.25) {
    SlidePieces block;
    for (int i = 0; i < 10; ++i)
      for (int k = 0; k < 20; ++k) {
        block.points.insert(block.points.end(), {200.5f + float(i), 0, float(10.5 + k - 10 * t)});
        block.velocity.insert(block.velocity.end(), {0, 0, -10});
      }
    recorder.add(t, block);
  }
  const SlideEntry entry = recorder.entry();
  EXPECT_EQ(entry.volume, 200);
  EXPECT_NEAR(entry.speed, 10, 1e-6);
  EXPECT_NEAR(entry.slope, 90, 1e-6);
  EXPECT_NEAR(entry.thickness, 10, 0.2);  // across its way: the width of the block
  EXPECT_NEAR(entry.x, 1205, 1e-3);
  EXPECT_NEAR(entry.drop, 20, 1e-4);
}

TEST(SlideEntry, ABodyThatTurnsAboutItsPivotIntoTheLake) {
  // A bar of 20 m by 1 m that lies 1 m above the lake turns with 0.2 rad/s about the end of its lower edge 1 m below:
  // a piece at (x, 1.5) sinks at atan(1.5 / x), with 0.2 of its distance from the pivot a second.
  const Workshop shop;
  RunHeader header;
  header.particles = slope(2);
  header.particles.counts.water = 1;
  header.particle_volume = 1;
  header.map = {2, 1, 0, 0, 1};
  header.left_out = "[]";
  BodyMotion motion;
  motion.name = "bar", motion.pivot = {200, 0, 0};
  for (int k = 0; k <= 200; ++k)
    motion.time.push_back(0.04 * k), motion.pitch.push_back(0.2 * 0.04 * k), motion.displacement.push_back({0, 0, 0});
  header.particles.bodies = {motion};
  Case c;
  c.dimension = 2;
  c.bodies.resize(1);
  c.bodies[0].outline = {{1200, 501}, {1220, 501}, {1220, 502}, {1200, 502}};
  // In a run whose last surface is at `end`, by a motion that begins at `from`.
  const auto measured = [&](double end, double from) {
    header.particles.bodies = {motion};
    for (double& t : header.particles.bodies[0].time) t += from;
    const std::string path = (shop / "run.h5").string();
    std::filesystem::remove(path);
    RunWriter writer(path, header);
    if (end >= 0) writer.add_surface(end, {1, 1}, {});
    writer.close();
    return measure_slide_entry(RunReader(path), c);
  };
  const SlideEntry entry = measured(-1, 0);
  double speed = 0;
  for (int k = 0; k < 20; ++k) speed += 0.2 * std::hypot(k + 0.5, 1.5) / 20;
  EXPECT_EQ(entry.volume, 20);
  EXPECT_NEAR(entry.speed, speed, 1e-3 * speed);
  EXPECT_NEAR(entry.drop, 1.5, 1e-6);
  EXPECT_EQ(entry.ahead[0], 1);

  // What the table tells beyond the run has not been: by 0.5 s it has turned by 0.1 rad, enough for x > 15 m.
  EXPECT_EQ(measured(0.5, 0).volume, 5);
  EXPECT_EQ(measured(0.5, -0.25).volume, 10);  // 0.15 rad more or less at the end: x > 10 m
  EXPECT_EQ(measured(5, -20).volume, 0);       // over before the run began
}

TEST(SlideEntry, DepthIsTheDeepestThatIsNotTooFarAway) {
  RunHeader header = basin_header(false);
  SlideEntry entry;
  entry.x = 1005, entry.y = 20, entry.ahead = {1, 0};
  const std::vector<float> water = basin_water(header.map, -100);
  EXPECT_NEAR(water_ahead(header, water, entry).x, 1015, 2);       // the water's edge, whose first wet node is at 16
  EXPECT_NEAR(water_ahead(header, water, entry).depth, 10, 1e-9);  // the flat bed, from 5 m on
  // A trench of 30 m, 20 m away: within five of its depths.
  const auto dig = [&](std::size_t from, std::size_t to, double z) {
    for (std::size_t n = 0; n < header.particles.ground.z.size(); ++n)
      if (n % 101 >= from && n % 101 <= to) header.particles.ground.z[n] = z;
  };
  dig(34, 38, -20);
  EXPECT_NEAR(water_ahead(header, water, entry).depth, 30, 1e-9);
  dig(34, 38, 0);
  // Shallow to x = 50 (1 m), then 6 m: some 35 m away is more than five times that.
  dig(15, 49, 9);
  dig(50, 80, 4);
  EXPECT_NEAR(water_ahead(header, water, entry).depth, 1, 1e-9);
  entry.x = 1005, entry.ahead = {-1, 0};  // uphill
  EXPECT_TRUE(std::isnan(water_ahead(header, water, entry).depth));
}

TEST(SlideEntry, BankOppositeInTheBasin) {
  const RunHeader header = basin_header(false);
  const std::vector<float> water = basin_water(header.map, -100);
  const Bank bank = opposite_bank(header, {"A", {{1010, 20}, {1096, 20}}}, water);
  ASSERT_TRUE(bank.present);
  EXPECT_NEAR(bank.x, 80, 1.01);
  EXPECT_NEAR(bank.depth, 10, 1e-9);
  EXPECT_NEAR(bank.slope, std::atan(0.5) * 180 / std::numbers::pi, 1e-6);  // 1:2 from 5 m below to 5 m above
  EXPECT_FALSE(opposite_bank(header, {"A", {{1010, 20}, {1050, 20}}}, water).present);
}

}  // namespace
}  // namespace lgiw
