// Surfaces of lattices whose surface is known: a lattice of spacing dp whose top layer lies at z ends at z + dp/2.
#include "measure/column_surface.hh"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <random>

namespace lgiw {
namespace {

/// A scene in lengths of dp = 0.5 m over x from 0 to 20 m and, in 3-D, y from 0 to 10 m.
struct Scene {
  explicit Scene(int dimension_) : dimension(dimension_) {
    bed.nx = 41, bed.dx = dp, bed.ny = dimension == 3 ? 21 : 1;
    bed.z.assign(bed.nx * bed.ny, 0.0);
    map.nx = 41, map.dx = dp, map.ny = bed.ny;
  }

  void set_bed(const std::function<double(double)>& z) {
    for (std::size_t j = 0; j < bed.ny; ++j)
      for (std::size_t i = 0; i < bed.nx; ++i) bed.at(i, j) = z(double(i) * bed.dx);
  }

  /// Lattice points above the bed for which `inside` holds.
  void fill(std::vector<float>& phase, const std::function<bool(double x, double z)>& inside, double jitter = 0) {
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> shift(-jitter, jitter);
    for (int j = 0; j < (dimension == 3 ? 20 : 1); ++j)
      for (int i = 0; i < 40; ++i)
        for (int k = -20; k < 40; ++k) {
          const double x = (i + 0.5) * dp, y = dimension == 3 ? (j + 0.5) * dp : 0, z = (k + 0.5) * dp;
          if (z < bed.height(x, y) || !inside(x, z)) continue;
          add(phase, x + shift(generator) * dp, dimension == 3 ? y + shift(generator) * dp : 0,
              z + shift(generator) * dp);
        }
  }

  static void add(std::vector<float>& phase, double x, double y, double z) {
    phase.insert(phase.end(), {float(x), float(y), float(z)});
  }

  ColumnSurfaces measure() { return column_surfaces(particles(), map, bed); }

  ColumnParticles particles() {
    xyz = water;
    xyz.insert(xyz.end(), soil.begin(), soil.end());
    ColumnParticles p;
    p.dimension = dimension, p.dp = dp, p.h = 1.5 * dp;
    p.n_water = water.size() / 3, p.n_soil = soil.size() / 3;
    p.xyz = xyz.data();
    p.velocity = velocity.empty() ? nullptr : velocity.data();
    p.lost = lost.empty() ? nullptr : lost.data();
    p.wall_low = {0, 0}, p.wall_high = {20, 10};
    return p;
  }

  double x(std::size_t node) const { return map.x0 + double(node % map.nx) * map.dx; }
  std::size_t node(double px, double py = 0) const {
    return std::size_t(std::lround(py / map.dx)) * map.nx + std::size_t(std::lround(px / map.dx));
  }

  int dimension;
  double dp = 0.5;
  HeightField bed;
  SurfaceMap map;
  std::vector<float> water, soil, xyz, velocity;
  std::vector<unsigned char> lost;
};

class ColumnSurface : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, ColumnSurface, testing::Values(2, 3),
                         [](const auto& p) { return std::to_string(p.param) + "D"; });

TEST_P(ColumnSurface, FlatLakeIsFoundAtEveryNodeUpToTheWalls) {
  Scene scene(GetParam());
  scene.fill(scene.water, [](double, double z) { return z < 5; });
  const ColumnSurfaces s = scene.measure();
  ASSERT_EQ(s.water.size(), scene.map.size());
  for (std::size_t n = 0; n < scene.map.size(); ++n) {
    EXPECT_NEAR(s.water[n], 5, 0.01 * scene.dp) << "node at x = " << scene.x(n);
    EXPECT_NEAR(s.depth[n], 5, 0.01 * scene.dp);
  }
  EXPECT_TRUE(s.soil.empty());
  EXPECT_TRUE(s.speed.empty());
}

TEST_P(ColumnSurface, JitteredLakeIsFlatWithinAFewHundredthsOfDp) {
  Scene scene(GetParam());
  scene.fill(
      scene.water, [](double, double z) { return z < 5; }, 0.1);
  const ColumnSurfaces s = scene.measure();
  double mean = 0, square = 0;
  for (float z : s.water) {
    const double error = (z - 5) / scene.dp;
    EXPECT_LT(std::abs(error), 0.12);  // four standard deviations of the noise that the jitter is
    mean += error / double(s.water.size()), square += error * error / double(s.water.size());
  }
  EXPECT_LT(std::abs(mean), 0.02);
  EXPECT_LT(std::sqrt(square), 0.05);
}

TEST_P(ColumnSurface, LakeOnAFortyDegreeBank) {
  Scene scene(GetParam());
  const double slope = std::tan(40 * std::numbers::pi / 180);
  scene.set_bed([&](double x) { return 9.1 - slope * x; });
  scene.fill(scene.water, [](double, double z) { return z < 5; });
  const ColumnSurfaces s = scene.measure();
  int deep = 0, dry = 0;
  for (std::size_t n = 0; n < scene.map.size(); ++n) {
    const double depth = 5 - (9.1 - slope * scene.x(n));
    if (depth > 2 * scene.dp) {
      EXPECT_NEAR(s.water[n], 5, 0.05 * scene.dp) << "depth " << depth / scene.dp << " dp";
      EXPECT_NEAR(s.depth[n], depth, 0.05 * scene.dp);
      ++deep;
    } else if (depth > scene.dp) {
      EXPECT_NEAR(s.water[n], 5, 0.2 * scene.dp) << "depth " << depth / scene.dp << " dp";
    } else if (depth < 0) {
      EXPECT_TRUE(std::isnan(s.water[n])) << "depth " << depth / scene.dp << " dp";
      ++dry;
    }
  }
  EXPECT_GT(deep, 25);
  EXPECT_GT(dry, 8);
}

TEST_P(ColumnSurface, LakeBesideAVerticalStepInTheBed) {
  Scene scene(GetParam());
  scene.bed.dx = 0.01, scene.bed.nx = 2001, scene.bed.ny = 1;  // the same for all y
  scene.bed.z.assign(scene.bed.nx, 0.0);
  scene.set_bed([](double x) { return x < 8.5 ? 12.0 : 0.0; });
  scene.fill(scene.water, [](double x, double z) { return x > 8.5 && z < 5; });
  const ColumnSurfaces s = scene.measure();
  for (std::size_t n = 0; n < scene.map.size(); ++n) {
    if (scene.x(n) > 9.4) {
      EXPECT_NEAR(s.water[n], 5, 0.05 * scene.dp) << "x = " << scene.x(n);
    } else if (scene.x(n) > 8.9) {  // one dp from the step, whose part above the lake counts as filled
      EXPECT_NEAR(s.water[n], 5, 0.2 * scene.dp) << "x = " << scene.x(n);
    } else if (scene.x(n) < 8.4) {
      EXPECT_TRUE(std::isnan(s.water[n])) << "x = " << scene.x(n);
    }
  }
}

TEST_P(ColumnSurface, WaveOfKnownShape) {
  Scene scene(GetParam());
  const double length = 20, amplitude = 1;
  const auto wave = [&](double x) { return 6 + amplitude * std::cos(2 * std::numbers::pi * x / length); };
  scene.fill(scene.water, [](double, double z) { return z < 6; });
  // Columns shifted as a whole, and the bed with them: the density stays.
  for (std::size_t p = 0; p < scene.water.size(); p += 3) scene.water[p + 2] += float(wave(scene.water[p]) - 6);
  scene.set_bed([&](double x) { return wave(x) - 6; });
  const ColumnSurfaces s = scene.measure();
  for (std::size_t n = 0; n < scene.map.size(); ++n)
    EXPECT_NEAR(s.water[n], wave(scene.x(n)), 0.05 * scene.dp) << "x = " << scene.x(n);
}

/// The surface by the definition: plain sums in double over all particles, of which none is near bed or walls, with
/// the height halved down to 1e-9 dp.
double surface_by_definition(const Scene& scene, double x, double y) {
  const double h = 1.5 * scene.dp;
  const double factor = scene.dimension == 2 ? 7 / (4 * std::numbers::pi * std::pow(1.5, 2))
                                             : 21 / (16 * std::numbers::pi * std::pow(1.5, 3));
  const auto filled = [&](double z) {
    double sum = 0;
    for (std::size_t p = 0; p < scene.water.size(); p += 3) {
      const double u = std::hypot(scene.water[p] - x, scene.water[p + 1] - y, scene.water[p + 2] - z) / (2 * h);
      if (u < 1) sum += factor * std::pow(1 - u, 4) * (4 * u + 1);
    }
    return sum;
  };
  double upper = 8;
  while (filled(upper - scene.dp / 20) < 0.5) upper -= scene.dp / 20;
  double lower = upper - scene.dp / 20;
  while (upper - lower > 1e-9 * scene.dp) (filled((upper + lower) / 2) < 0.5 ? upper : lower) = (upper + lower) / 2;
  return lower;
}

TEST_P(ColumnSurface, IsThatOfTheDefinitionWithinATenThousandthOfDp) {
  Scene scene(GetParam());
  scene.fill(
      scene.water, [](double x, double z) { return z < 5 + 0.8 * std::sin(x); }, 0.3);
  Scene::add(scene.water, 9.9, scene.dimension == 3 ? 5.1 : 0, 7.2);  // splash
  const ColumnSurfaces s = scene.measure();
  for (double x = 2; x < 18; x += scene.dp) {
    const double y = scene.dimension == 3 ? 5 : 0;
    EXPECT_NEAR(s.water[scene.node(x, y)], surface_by_definition(scene, x, y), 1e-4 * scene.dp) << "x = " << x;
  }
}

/// Beside a bank of 40 degrees that rises from the water, with the midpoint rule of the bed refined by brute force.
TEST_P(ColumnSurface, FractionBelowTheBedIsThatOfItsIntegral) {
  Scene scene(GetParam());
  const double slope = std::tan(40 * std::numbers::pi / 180), h = 1.5 * scene.dp;
  scene.set_bed([&](double x) { return slope * (x - 10); });
  // Soil that fills nothing but by the bed: one layer, so that the surface hangs on the bed's part.
  for (int j = 0; j < (scene.dimension == 3 ? 20 : 1); ++j)
    for (int i = 0; i < 40; ++i) {
      const double x = (i + 0.5) * scene.dp;
      Scene::add(scene.soil, x, scene.dimension == 3 ? (j + 0.5) * scene.dp : 0, slope * (x - 10) + 0.4 * scene.dp);
    }
  const ColumnSurfaces s = scene.measure();
  const double y = scene.dimension == 3 ? 5 : 0;
  const auto kernel = [&](double r) { return r < 2 * h ? std::pow(1 - r / (2 * h), 4) * (4 * r / (2 * h) + 1) : 0.0; };
  const auto filled = [&](double x, double z) {
    const int n = 40;
    const double step = 2 * h / n, factor = scene.dimension == 2 ? 7 / (4 * std::numbers::pi * h * h)
                                                                 : 21 / (16 * std::numbers::pi * h * h * h);
    double below = 0, whole = 0, sum = 0;
    for (int j = scene.dimension == 3 ? -n : 0; j < (scene.dimension == 3 ? n : 1); ++j)
      for (int i = -n; i < n; ++i)
        for (int k = -n; k < n; ++k) {
          const double dx = (i + 0.5) * step, dy = scene.dimension == 3 ? (j + 0.5) * step : 0, dz = (k + 0.5) * step;
          const double w = kernel(std::sqrt(dx * dx + dy * dy + dz * dz));
          whole += w, below += z + dz < slope * (x + dx - 10) ? w : 0;
        }
    for (std::size_t p = 0; p < scene.soil.size(); p += 3)
      sum += std::pow(scene.dp, scene.dimension) * factor *
             kernel(std::hypot(scene.soil[p] - x, scene.soil[p + 1] - y, scene.soil[p + 2] - z));
    return sum + below / whole;
  };
  int found = 0;
  for (double x : {6.0, 8.5, 10.0, 13.0}) {
    const double z = s.soil[scene.node(x, y)];
    if (std::isnan(z)) continue;  // half of what is filled may be bed
    ++found;
    EXPECT_NEAR(filled(x, z), 0.5, 0.005) << "x = " << x;
  }
  EXPECT_EQ(found, 4);
}

TEST_P(ColumnSurface, WhatIsKeptOfTheBedServesParticlesThatMove) {
  Scene scene(GetParam());
  scene.set_bed([](double x) { return 4 - 0.7 * x + std::sin(x); });
  scene.fill(
      scene.soil, [](double x, double z) { return x < 6 && z < 5 - 0.5 * x; }, 0.2);
  scene.fill(
      scene.water, [](double, double z) { return z < 2; }, 0.2);
  ColumnSurfaceMap kept(scene.map, scene.bed);
  for (double fall : {0.0, 0.6, -1.1}) {  // dp: deeper and less deep in the bed than at first
    for (auto* phase : {&scene.water, &scene.soil})
      for (std::size_t p = 2; p < phase->size(); p += 3) (*phase)[p] -= float(fall * scene.dp);
    const ColumnSurfaces once = scene.measure(), again = kept(scene.particles());
    int wet = 0;
    for (std::size_t n = 0; n < scene.map.size(); ++n) {
      EXPECT_TRUE(once.water[n] == again.water[n] || (std::isnan(once.water[n]) && std::isnan(again.water[n])));
      EXPECT_TRUE(once.soil[n] == again.soil[n] || (std::isnan(once.soil[n]) && std::isnan(again.soil[n])));
      if (!std::isnan(once.water[n])) ++wet;
    }
    EXPECT_GT(wet, 10);
  }
}

TEST_P(ColumnSurface, DropletAndSplashAboveTheLakeArePassedOver) {
  Scene scene(GetParam());
  scene.fill(scene.water, [](double, double z) { return z < 5; });
  Scene::add(scene.water, 10, scene.dimension == 3 ? 5 : 0, 15);
  Scene::add(scene.water, 10.1, scene.dimension == 3 ? 5 : 0, 8);
  scene.velocity.assign(scene.water.size(), 0.0f);
  for (std::size_t p = 0; p < scene.velocity.size(); p += 3) scene.velocity[p] = 2;
  scene.velocity[scene.velocity.size() - 3] = 50;  // the droplets are fast
  scene.velocity[scene.velocity.size() - 6] = 50;
  const ColumnSurfaces s = scene.measure();
  const std::size_t n = scene.node(10, 5 * (scene.dimension - 2));
  EXPECT_NEAR(s.water[n], 5, 0.02 * scene.dp);
  EXPECT_FLOAT_EQ(s.speed[n], 2);
}

TEST_P(ColumnSurface, SheetInTheAirThinnerThanDpIsPassedOverAndAThickJetIsNot) {
  Scene scene(GetParam());
  scene.fill(scene.water, [](double, double z) { return z < 5 || (z > 10 && z < 10.5); });
  EXPECT_NEAR(scene.measure().water[scene.node(10)], 5, 0.02 * scene.dp);
  scene.fill(scene.water, [](double, double z) { return z > 10.5 && z < 12; });
  EXPECT_NEAR(scene.measure().water[scene.node(10)], 12, 0.05 * scene.dp);
}

TEST_P(ColumnSurface, DryBedIsNaNAlsoWithADropletOnIt) {
  Scene scene(GetParam());
  scene.fill(scene.water, [](double x, double z) { return x < 5 && z < 5; });
  Scene::add(scene.water, 15, scene.dimension == 3 ? 5 : 0, 0.25);
  const ColumnSurfaces s = scene.measure();
  EXPECT_NEAR(s.water[scene.node(2)], 5, 0.02 * scene.dp);
  for (double x : {7.0, 10.0, 14.5, 15.0, 15.5}) {
    EXPECT_TRUE(std::isnan(s.water[scene.node(x, 5 * (scene.dimension - 2))])) << "x = " << x;
    EXPECT_TRUE(std::isnan(s.depth[scene.node(x, 5 * (scene.dimension - 2))])) << "x = " << x;
  }
}

TEST_P(ColumnSurface, FilmOfOneLayerIsWet) {
  Scene scene(GetParam());
  scene.fill(scene.water, [](double, double z) { return z < 0.5; });
  const ColumnSurfaces s = scene.measure();
  for (std::size_t n = 0; n < scene.map.size(); ++n) EXPECT_NEAR(s.water[n], 0.5, 0.05 * scene.dp);
}

TEST_P(ColumnSurface, SoilBelowWater) {
  Scene scene(GetParam());
  scene.fill(scene.soil, [](double, double z) { return z < 3; });
  scene.fill(scene.water, [](double, double z) { return z > 3 && z < 5; });
  scene.velocity.assign(scene.water.size() + scene.soil.size(), 0.0f);
  for (std::size_t p = 0; p < scene.velocity.size(); p += 3) scene.velocity[p + 2] = p < scene.water.size() ? 3 : -4;
  const ColumnSurfaces s = scene.measure();
  for (std::size_t n = 0; n < scene.map.size(); ++n) {
    EXPECT_NEAR(s.soil[n], 3, 0.01 * scene.dp);
    EXPECT_NEAR(s.water[n], 5, 0.01 * scene.dp);
    EXPECT_NEAR(s.depth[n], 2, 0.02 * scene.dp);
    EXPECT_FLOAT_EQ(s.speed[n], 3);
    EXPECT_FLOAT_EQ(s.soil_speed[n], 4);
  }
}

TEST_P(ColumnSurface, SoilAloneOnASlope) {
  Scene scene(GetParam());
  scene.set_bed([](double x) { return 0.5 * x - 4; });
  // A layer 3 m thick, measured vertically, on the lattice shifted with the slope.
  for (int j = 0; j < (scene.dimension == 3 ? 20 : 1); ++j)
    for (int i = 0; i < 40; ++i)
      for (int k = 0; k < 6; ++k) {
        const double x = (i + 0.5) * scene.dp;
        Scene::add(scene.soil, x, scene.dimension == 3 ? (j + 0.5) * scene.dp : 0, 0.5 * x - 4 + (k + 0.5) * scene.dp);
      }
  const ColumnSurfaces s = scene.measure();
  for (std::size_t n = 0; n < scene.map.size(); ++n) {
    EXPECT_TRUE(std::isnan(s.water[n]));
    if (scene.x(n) < 2 || scene.x(n) > 18) continue;  // mirrored, the slope has a kink at the walls
    EXPECT_NEAR(s.soil[n], 0.5 * scene.x(n) - 1, 0.05 * scene.dp);
  }
}

TEST_P(ColumnSurface, SoilThatRisesFromTheLakeIsNotWater) {
  Scene scene(GetParam());
  scene.fill(scene.soil, [](double x, double z) { return x < 8 && z < 9; });
  scene.fill(scene.water, [](double x, double z) { return x > 8 && z < 5; });
  const ColumnSurfaces s = scene.measure();
  EXPECT_TRUE(std::isnan(s.water[scene.node(6)]));
  EXPECT_NEAR(s.soil[scene.node(6)], 9, 0.01 * scene.dp);
  EXPECT_TRUE(std::isnan(s.soil[scene.node(12)]));
  for (double x : {9.0, 10.0, 15.0}) EXPECT_NEAR(s.water[scene.node(x)], 5, 0.05 * scene.dp) << "x = " << x;
}

TEST_P(ColumnSurface, LostAndNonFiniteParticlesDoNotCount) {
  Scene scene(GetParam());
  scene.fill(scene.water, [](double, double z) { return z < 5; });
  const std::size_t n = scene.water.size() / 3;
  scene.fill(scene.water, [](double, double z) { return z > 5 && z < 7; });
  scene.lost.assign(scene.water.size() / 3, 0);
  for (std::size_t p = n; p < scene.lost.size(); ++p) scene.lost[p] = 1;
  Scene::add(scene.water, 10, 0, std::nan(""));
  scene.lost.push_back(0);
  EXPECT_NEAR(scene.measure().water[scene.node(10)], 5, 0.01 * scene.dp);
}

TEST_P(ColumnSurface, WithoutParticlesOrBed) {
  Scene scene(GetParam());
  for (float z : scene.measure().water) EXPECT_TRUE(std::isnan(z));
  scene.fill(scene.water, [](double, double z) { return z < 5; });
  scene.bed = {};
  EXPECT_NEAR(scene.measure().water[scene.node(10)], 5, 0.01 * scene.dp);
}

TEST_P(ColumnSurface, DoesNotDependOnTheNumberOfThreads) {
  Scene scene(GetParam());
  scene.set_bed([](double x) { return 2 * std::sin(x); });
  scene.fill(
      scene.soil, [](double x, double z) { return x < 10 && z < 12 - x; }, 0.3);
  scene.fill(
      scene.water, [](double x, double z) { return z > 12 - x && z < 5; }, 0.3);
  // So many that several threads sort them.
  const std::vector<float> once = scene.water;
  while (scene.water.size() / 3 < 30000) scene.water.insert(scene.water.end(), once.begin(), once.end());
  scene.velocity.assign(scene.water.size() + scene.soil.size(), 1.0f);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const ColumnSurfaces one = scene.measure();
  omp_set_num_threads(3);
  const ColumnSurfaces three = scene.measure();
  omp_set_num_threads(threads);
  const auto same = [](const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
  };
  EXPECT_TRUE(same(one.water, three.water));
  EXPECT_TRUE(same(one.soil, three.soil));
  EXPECT_TRUE(same(one.depth, three.depth));
  EXPECT_TRUE(same(one.speed, three.speed));
  EXPECT_TRUE(same(one.soil_speed, three.soil_speed));
}

}  // namespace
}  // namespace lgiw
