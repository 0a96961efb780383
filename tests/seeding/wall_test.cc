// Wall particles: they tile the solid near its surface exactly, whatever the bends, and know where it faces.
#include "seeding/walls.hh"

#include <algorithm>
#include <map>
#include <random>

#include "gtest/gtest.h"
#include "scene.hh"

namespace lgiw::test {
namespace {

Scene terrain_only(double dp, const std::string& profile, double level) {
  char text[2000];
  std::snprintf(text, sizeof text,
                "name: walls\ndimension: 2\nparticle_spacing: %g\nterrain: {profile: %s}\nwater: {level: %g}\n", dp,
                profile.c_str(), level);
  return seeded(text);
}

struct Box {
  double west, east, low, high;
};

/// The parallelogram of a bed particle, as wide as its sub-column and as high as the layers of that are apart.
std::vector<Box> boxes(const ParticleBlock& wall) {
  std::map<double, std::vector<std::size_t>> columns;
  for (std::size_t n = 0; n < wall.size(); ++n)
    if (wall.kind[n] == 0) columns[wall.points[3 * n]].push_back(n);
  std::vector<Box> result;
  for (const auto& [x, members] : columns) {
    const double height = wall.points[3 * members[0] + 2] - wall.points[3 * members[1] + 2];
    for (std::size_t n : members) {
      const double width = wall.volume[n] / height, z = wall.points[3 * n + 2];
      result.push_back({x - 0.5 * width, x + 0.5 * width, z - 0.5 * height, z + 0.5 * height});
    }
  }
  return result;
}

/// Counts how many boxes hold points of the solid near the surface: one each. Boxes end in steps at the surface and at
/// the shell's lower end, so points within `skin` of these are not asked.
void expect_tiled(const ParticleBlock& wall, const std::vector<Point2>& profile, double thickness, double skin) {
  const std::vector<Box> all = boxes(wall);
  const auto height = [&](double x) {
    for (std::size_t k = 0; k + 1 < profile.size(); ++k)
      if (x <= profile[k + 1][0])
        return profile[k][1] +
               (profile[k + 1][1] - profile[k][1]) * (x - profile[k][0]) / (profile[k + 1][0] - profile[k][0]);
    return profile.back()[1];
  };
  const auto to_surface = [&](double x, double z) {
    double least = 1e9;
    for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
      const double dx = profile[k + 1][0] - profile[k][0], dz = profile[k + 1][1] - profile[k][1];
      const double t = std::clamp(((x - profile[k][0]) * dx + (z - profile[k][1]) * dz) / (dx * dx + dz * dz), 0., 1.);
      least = std::min(least, std::hypot(x - profile[k][0] - t * dx, z - profile[k][1] - t * dz));
    }
    return least;
  };
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  const double x_low = profile.front()[0], x_high = profile.back()[0];
  double z_low = 1e9, z_high = -1e9;
  for (const Point2& p : profile) z_low = std::min(z_low, p[1]), z_high = std::max(z_high, p[1]);
  int asked = 0;
  for (int trial = 0; trial < 400000 && asked < 4000; ++trial) {
    const double x = x_low + (x_high - x_low) * unit(random);
    const double z = z_low - thickness + (z_high - z_low + thickness) * unit(random);
    const double away = to_surface(x, z);
    if (z > height(x) || away < skin || away > thickness - skin) continue;
    ++asked;
    const auto held = std::count_if(
        all.begin(), all.end(), [&](const Box& b) { return x >= b.west && x < b.east && z >= b.low && z < b.high; });
    ASSERT_EQ(held, 1) << x << " " << z;
  }
  EXPECT_GE(asked, 1000);
}

TEST(Walls, PlaneSlopeHasItsExactShell) {
  for (double slope : {0.0, 0.5, 1.0, 1.7}) {
    char profile[100];
    std::snprintf(profile, sizeof profile, "[[0, %g], [1, 0]]", slope);
    const Scene s = terrain_only(0.02, profile, 0.9 * slope + 0.1);
    // Three layers of 0.02 under the surface; outside, 2 x 3 flat columns.
    double inside = 0;
    for (std::size_t n = 0; n < s.data.wall.size(); ++n) {
      const double x = s.data.wall.points[3 * n];
      if (s.data.wall.kind[n] != 0 || x < 0.1 || x > 0.9) continue;
      inside += s.data.wall.volume[n];
      EXPECT_NEAR(s.data.wall.normal[3 * n], slope / std::hypot(1, slope), 1e-4);
      EXPECT_NEAR(s.data.wall.normal[3 * n + 2], 1 / std::hypot(1, slope), 1e-4);
      const double across = (slope * (1 - x) - s.data.wall.points[3 * n + 2]) / std::hypot(1, slope) / 0.02;
      EXPECT_NEAR(across - 0.5, std::round(across - 0.5), 1e-6);
      EXPECT_LT(across, 3);
    }
    EXPECT_NEAR(inside, 3 * 0.02 * 0.8 * std::hypot(1, slope), 1e-6);
  }
}

TEST(Walls, SpacingAlongTheSurface) {
  for (int degrees = 0; degrees <= 75; degrees += 5) {
    const double slope = std::tan(degrees * M_PI / 180);
    char profile[100];
    std::snprintf(profile, sizeof profile, "[[0, %.9f], [1, 0]]", slope);
    const Scene s = terrain_only(0.02, profile, 0.5 * slope + 0.05);
    std::vector<double> columns;
    for (std::size_t n = 0; n < s.data.wall.size(); ++n)
      if (s.data.wall.kind[n] == 0) columns.push_back(s.data.wall.points[3 * n]);
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    for (std::size_t k = 1; k < columns.size(); ++k) {
      if (columns[k - 1] < 0.3 || columns[k] > 0.9) continue;
      const double along = (columns[k] - columns[k - 1]) * std::hypot(1, slope) / 0.02;
      EXPECT_GE(along, 0.62) << degrees;
      EXPECT_LE(along, 1.26) << degrees;
    }
  }
}

TEST(Walls, TileConcaveAndConvexBends) {
  const std::vector<Point2> profile{{0, 1}, {0.5, 0.2}, {1, 0}, {1.3, 0.4}, {1.6, 0.1}, {2, 0.1}};
  const Scene s = terrain_only(0.02, "[[0, 1], [0.5, 0.2], [1, 0], [1.3, 0.4], [1.6, 0.1], [2, 0.1]]", 0.8);
  expect_tiled(s.data.wall, profile, 0.06, 0.02);
}

TEST(Walls, TileTheSolidBesideACliff) {
  // The step is given a millimetre wide, since profiles have one height at each x.
  const std::vector<Point2> profile{{0, 1}, {1, 1}, {1.001, 0}, {2, 0}};
  const Scene s = terrain_only(0.05, "[[0, 1], [1, 1], [1.001, 0], [2, 0]]", 0.8);
  expect_tiled(s.data.wall, profile, 0.15, 0.0251);
  // Beside it the lattice stays plain, and at mid-height the nearest particles face east.
  int faced = 0;
  for (std::size_t n = 0; n < s.data.wall.size(); ++n) {
    const Point p = point(s.data.wall, n);
    if (s.data.wall.kind[n] != 0) continue;
    EXPECT_NEAR(s.data.wall.volume[n], 0.0025, 1e-8);
    const double layer = p[2] / 0.05 - 0.5;
    EXPECT_NEAR(layer, std::round(layer), 1e-6);
    if (p[0] > 0.86 && p[0] < 1 && p[2] > 0.2 && p[2] < 0.75) {
      EXPECT_GT(s.data.wall.normal[3 * n], 0.99) << p[0] << " " << p[2];
      ++faced;
    }
  }
  EXPECT_EQ(faced, 3 * 11);
  for (std::size_t n = 0; n < s.data.water.size(); ++n) EXPECT_GT(s.data.water.points[3 * n], 1);
  EXPECT_EQ(s.data.water.size(), 20u * 16u);
}

TEST(Walls, SideAndBedShareTheCorner) {
  // The bed cuts the lattice of the side walls, whose lowest particles take what is left: no gap and no overlap.
  const Scene s = terrain_only(0.02, "[[0, 0.0131], [1, 0.0131]]", 0.3);
  std::map<double, double> top, bottom, volume;
  for (std::size_t n = 0; n < s.data.wall.size(); ++n) {
    const Point p = point(s.data.wall, n);
    if (p[0] > 0) continue;
    const double half = 0.5 * s.data.wall.volume[n] / 0.02;
    top.try_emplace(p[0], -1e9), bottom.try_emplace(p[0], 1e9);
    top[p[0]] = std::max(top[p[0]], p[2] + half), bottom[p[0]] = std::min(bottom[p[0]], p[2] - half);
    volume[p[0]] += s.data.wall.volume[n];
  }
  ASSERT_EQ(top.size(), 3u);
  for (const auto& [x, sum_of_volumes] : volume) EXPECT_NEAR(sum_of_volumes, 0.02 * (top[x] - bottom[x]), 1e-8);
  EXPECT_NEAR(bottom.begin()->second, 0.0131 - 0.06, 1e-6);
}

TEST(Walls, WhereNothingComesTheyAreLeftOut) {
  // A bank to 5 m above water 0.1 m deep: sloshing stops far below its top.
  const Scene s = terrain_only(0.02, "[[0, 5], [5, 0], [6, 0]]", 0.1);
  EXPECT_GT(s.data.header.counts.wall_left_out, 200 * 2 * 3);
  double highest = 0;
  for (std::size_t n = 0; n < s.data.wall.size(); ++n) highest = std::max(highest, s.data.wall.points[3 * n + 2]);
  EXPECT_LT(highest, 0.1 + 10 * 0.02 + 0.1);
  // With the walls all the way up there would be as many as were placed and left out.
  const Scene all = seeded(R"(
name: walls
dimension: 2
particle_spacing: 0.02
terrain: {profile: [[0, 5], [5, 0], [6, 0]], wall_top: 5.2}
water: {level: 0.1}
)");
  EXPECT_EQ(all.data.header.counts.wall_left_out, 0);
  EXPECT_EQ(std::count(all.data.wall.kind.begin(), all.data.wall.kind.end(), 0) + 0,
            std::count(s.data.wall.kind.begin(), s.data.wall.kind.end(), 0) + s.data.header.counts.wall_left_out -
                3 * 8);  // of the west side: 8 dp above the bank
}

}  // namespace
}  // namespace lgiw::test
