// Scenes on the lattice, whose particles can be counted by hand.
#include <omp.h>

#include <algorithm>

#include "gtest/gtest.h"
#include "scene.hh"

namespace lgiw::test {
namespace {

const std::string tank = R"(
name: tank
dimension: 2
particle_spacing: 0.005
terrain: {profile: [[0, 0], [0.4, 0]]}
water: {level: 0.2}
)";

TEST(Box, TankIsThePlainLattice) {
  const Scene s = seeded(tank);
  const ParticleBlock &water = s.data.water, &wall = s.data.wall;
  ASSERT_EQ(water.size(), 80u * 40u);
  EXPECT_EQ(s.data.soil.size(), 0u);
  for (std::size_t n = 0; n < water.size(); ++n) {  // columns from the west, upwards
    EXPECT_NEAR(water.points[3 * n], (double(n / 40) + 0.5) * 0.005, 1e-12);
    EXPECT_EQ(water.points[3 * n + 1], 0);
    EXPECT_NEAR(water.points[3 * n + 2], (double(n % 40) + 0.5) * 0.005, 1e-12);
    EXPECT_FLOAT_EQ(water.volume[n], 2.5e-5f);
  }
  // Floor: three layers (2h = 3 dp) under 80 + 2 * 3 columns. Sides: 6 columns as high again as the tank is deep, 0.4
  // m.
  const auto sides = std::count(wall.kind.begin(), wall.kind.end(), 1);
  EXPECT_EQ(int64_t(wall.size()) - sides, 86 * 3);
  EXPECT_EQ(sides, 6 * 80);
  EXPECT_NEAR(sum(wall.volume), (86 * 3 + 6 * 80) * 2.5e-5, 1e-9);
  for (std::size_t n = 0; n < wall.size(); ++n) {
    const Point p = point(wall, n);
    const bool side = wall.kind[n] == 1;
    EXPECT_EQ(side, p[2] > 0);
    EXPECT_EQ(wall.normal[3 * n], side ? (p[0] < 0 ? 1.f : -1.f) : 0.f);
    EXPECT_EQ(wall.normal[3 * n + 2], side ? 0.f : 1.f);
    const double column = p[0] / 0.005 - 0.5, layer = p[2] / 0.005 - 0.5;
    EXPECT_NEAR(column, std::round(column), 1e-9);
    EXPECT_NEAR(layer, std::round(layer), 1e-9);
    EXPECT_TRUE(!side || p[0] < 0 || p[0] > 0.4);
  }
  EXPECT_EQ(s.data.header.counts.water, 3200);
  EXPECT_EQ(s.data.header.counts.wall, 738);
  EXPECT_EQ(s.data.header.counts.wall_left_out, 0);
  EXPECT_EQ(s.data.header.low[0], 0);
  EXPECT_NEAR(s.data.header.high[0], 0.4, 1e-12);
}

TEST(Box, OpenSideHasNoWall) {
  const Scene s = seeded(R"(
name: open
dimension: 2
particle_spacing: 0.01
terrain: {profile: [[0, 0], [0.4, 0]], sides: {east: open}}
water: {level: 0.2, bodies: [[[0, 0], [0.1, 0], [0.1, 0.2], [0, 0.2]]]}
)");
  EXPECT_EQ(s.data.water.size(), 10u * 20u);
  for (std::size_t n = 0; n < s.data.wall.size(); ++n)
    EXPECT_TRUE(s.data.wall.kind[n] == 0 || s.data.wall.points[3 * n] < 0);
  EXPECT_GT(std::count(s.data.wall.kind.begin(), s.data.wall.kind.end(), 1), 0);
}

TEST(Box, SoilColumnOnAFloorWithALeftWall) {
  const Scene s = seeded(R"(
name: column
dimension: 2
particle_spacing: 0.005
terrain: {profile: [[0, 0], [0.6, 0]], sides: {east: open}}
slide: {bodies: [[[0, 0], [0.2, 0], [0.2, 0.1], [0, 0.1]]]}
soil: {density: 2650, friction_angle: 19.8, young_modulus: 8.4e5}
)");
  ASSERT_EQ(s.data.soil.size(), 40u * 20u);
  EXPECT_EQ(s.data.water.size(), 0u);
  EXPECT_TRUE(std::isnan(s.data.header.still_water_level));
  EXPECT_EQ(s.data.header.sound_speed, 0);
  const auto [low, high] = std::minmax_element(s.data.soil.points.begin(), s.data.soil.points.end());
  EXPECT_EQ(*low, 0);  // y
  EXPECT_NEAR(*high, 0.1975, 1e-12);
  // Wall top: 8 dp above the soil: z from 0 to 0.14 in 3 columns.
  EXPECT_EQ(std::count(s.data.wall.kind.begin(), s.data.wall.kind.end(), 1), 3 * 28);
  EXPECT_EQ(std::count(s.data.wall.kind.begin(), s.data.wall.kind.end(), 0), 3 * (120 + 6));
}

TEST(Box, BodyOffTheLatticeKeepsItsCount) {
  // No multiple of dp anywhere: the body brings its own lattice, from its corner.
  const Scene s = seeded(R"(
name: shifted
dimension: 2
particle_spacing: 0.005
terrain: {profile: [[0, 0], [0.6, 0]]}
slide: {bodies: [[[0.1013, 0.0012], [0.3013, 0.0012], [0.3013, 0.1012], [0.1013, 0.1012]]]}
)");
  ASSERT_EQ(s.data.soil.size(), 40u * 20u);
  double left = 1, bottom = 1;
  for (std::size_t n = 0; n < 800; ++n) {
    left = std::min(left, s.data.soil.points[3 * n]);
    bottom = std::min(bottom, s.data.soil.points[3 * n + 2]);
  }
  EXPECT_NEAR(left, 0.1013 + 0.0025, 1e-9);
  EXPECT_NEAR(bottom, 0.0012 + 0.0025, 0.0013);  // the lowest layers settle on the bed
}

TEST(Box, SoilUnderWaterSharesTheLattice) {
  const Scene s = seeded(R"(
name: layer
dimension: 2
particle_spacing: 0.005
terrain: {profile: [[0, 0], [0.2, 0]]}
water: {level: 0.2}
slide: {bodies: [[[0, 0], [0.2, 0], [0.2, 0.1], [0, 0.1]]]}
)");
  ASSERT_EQ(s.data.soil.size(), 40u * 20u);
  ASSERT_EQ(s.data.water.size(), 40u * 20u);
  for (std::size_t n = 0; n < 800; ++n) {
    EXPECT_LT(s.data.soil.points[3 * n + 2], 0.1);
    EXPECT_GT(s.data.water.points[3 * n + 2], 0.1);
  }
  Neighbours all(0.01);
  all.add(s.data.water), all.add(s.data.soil), all.add(s.data.wall);
  for (const ParticleBlock* block : {&s.data.water, &s.data.soil, &s.data.wall})
    EXPECT_NEAR(nearest_pair(*block, all, 0.01), 0.005, 1e-9);
}

TEST(Box, ThreeDimensions) {
  const Scene s = seeded(R"(
name: basin
dimension: 3
particle_spacing: 0.02
terrain: {profile: [[0, 0], [0.4, 0]], width: 0.2}
water: {level: 0.1}
)");
  ASSERT_EQ(s.data.water.size(), 20u * 10u * 5u);
  EXPECT_NEAR(sum(s.data.water.volume), 0.4 * 0.2 * 0.1, 1e-8);
  // Floor 26 x 16 columns of 3; sides over the other 26 * 16 - 200 columns up to 0.1 + max(0.1, 10 dp) = 0.3 m: 15
  // layers.
  EXPECT_EQ(std::count(s.data.wall.kind.begin(), s.data.wall.kind.end(), 0), 26 * 16 * 3);
  EXPECT_EQ(std::count(s.data.wall.kind.begin(), s.data.wall.kind.end(), 1), (26 * 16 - 200) * 15);
  for (std::size_t n = 0; n < s.data.wall.size(); ++n) {
    const float* v = &s.data.wall.normal[3 * n];
    EXPECT_NEAR(std::hypot(v[0], v[1], v[2]), 1, 1e-6);
    if (s.data.wall.kind[n] == 0) continue;
    const Point p = point(s.data.wall, n);
    EXPECT_EQ(v[0] > 0, p[0] < 0);
    EXPECT_EQ(v[0]<0, p[0]> 0.4);
    EXPECT_EQ(v[1] > 0, p[1] < 0);
    EXPECT_EQ(v[1]<0, p[1]> 0.2);
  }
}

TEST(Box, WaterOnlyOnTheSeedsSideOfASill) {
  const std::string two_basins = R"(
name: basins
dimension: 2
particle_spacing: 0.01
terrain: {profile: [[0, 0], [0.4, 0], [0.5, 0.3], [0.6, 0], [1, 0]]}
water: {level: 0.2, seed: [0.8, 0]}
)";
  const Scene s = seeded(two_basins);
  for (std::size_t n = 0; n < s.data.water.size(); ++n) EXPECT_GT(s.data.water.points[3 * n], 0.5);
  // 0.4 x 0.2 and the triangle on the slope of 3 : 1, 0.2 x 0.0667 / 2.
  EXPECT_NEAR(sum(s.data.water.volume), 0.08 + 0.2 * (0.2 / 3) / 2, 0.01 * 0.0867);
}

ParticleData in_tiles(const Case& c, const TerrainModel& model, int64_t tile) {
  Seeder seeder(c, model);
  seeder.count();
  ParticleData data;
  seeder.seed(
      [&](const ParticleBlock& b) {
        ParticleBlock& to = b.phase == Phase::water ? data.water : b.phase == Phase::soil ? data.soil : data.wall;
        to.points.insert(to.points.end(), b.points.begin(), b.points.end());
        to.volume.insert(to.volume.end(), b.volume.begin(), b.volume.end());
        to.stress.insert(to.stress.end(), b.stress.begin(), b.stress.end());
        to.normal.insert(to.normal.end(), b.normal.begin(), b.normal.end());
      },
      {}, tile);
  return data;
}

TEST(Box, NeitherTilesNorThreadsMatter) {
  const Scene s = seeded(R"(
name: slide
dimension: 3
particle_spacing: 0.02
terrain: {profile: [[-0.5, 0.5], [0, 0], [0.6, 0.03]], width: 0.3}
water: {level: 0.17}
slide: {bodies: [[[-0.4, 0.4], [-0.2, 0.2], [-0.2, 0.4]]]}
)");
  const int threads = omp_get_max_threads();
  for (const auto& [tile, workers] : {std::pair{7, 1}, std::pair{1000, 2}, std::pair{1 << 20, 3}}) {
    omp_set_num_threads(workers);
    const ParticleData d = in_tiles(s.c, s.model, tile);
    EXPECT_EQ(d.water.points, s.data.water.points) << tile;
    EXPECT_EQ(d.soil.points, s.data.soil.points) << tile;
    EXPECT_EQ(d.soil.stress, s.data.soil.stress) << tile;
    EXPECT_EQ(d.wall.points, s.data.wall.points) << tile;
    EXPECT_EQ(d.wall.normal, s.data.wall.normal) << tile;
    EXPECT_EQ(d.wall.volume, s.data.wall.volume) << tile;
  }
  omp_set_num_threads(threads);
  EXPECT_GT(s.data.soil.size(), 100u);
}

}  // namespace
}  // namespace lgiw::test
