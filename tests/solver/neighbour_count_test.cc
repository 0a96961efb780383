// Neighbours counted by cells against lattices, where one can count on paper, and against all pairs.
#include "solver/neighbour_count.hh"

#include <gtest/gtest.h>

#include <random>

namespace lgiw {
namespace {

TEST(Neighbours, OfALatticeInAPlaneAreThoseWithinTheReach) {
  // y = 0 as in 2-D. Only the middle moves; within 2.5 dp lie 20: 4 at 1, 4 at sqrt 2, 4 at 2 and 8 at sqrt 5.
  std::vector<double> xyz{0, 0, 0};
  for (int i = -5; i <= 5; ++i)
    for (int k = -5; k <= 5; ++k)
      if (i || k) xyz.insert(xyz.end(), {0.1 * i, 0, 0.1 * k});
  EXPECT_DOUBLE_EQ(mean_neighbours(xyz, 1, 0.25), 20);
}

TEST(Neighbours, AreAveragedOverThoseThatMove) {
  // A pair, and a wall particle that is near one of them.
  const std::vector<double> xyz{0, 0, 0, 1, 0, 0, 2, 0, 0};
  EXPECT_DOUBLE_EQ(mean_neighbours(xyz, 2, 1.5), 1.5);
  EXPECT_DOUBLE_EQ(mean_neighbours(xyz, 3, 1.5), 4.0 / 3);
  EXPECT_EQ(mean_neighbours(xyz, 0, 1.5), 0);
  EXPECT_EQ(mean_neighbours({}, 0, 1.5), 0);
}

TEST(Neighbours, OfACloudAreThoseOfAllPairs) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-20, 30);
  const std::size_t n = 2000, moving = 1500;
  std::vector<double> xyz(3 * n);
  for (double& x : xyz) x = any(random);
  double sum = 0;
  for (std::size_t i = 0; i < moving; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const double x = xyz[3 * i] - xyz[3 * j], y = xyz[3 * i + 1] - xyz[3 * j + 1],
                   z = xyz[3 * i + 2] - xyz[3 * j + 2];
      sum += i != j && x * x + y * y + z * z < 49;
    }
  EXPECT_DOUBLE_EQ(mean_neighbours(xyz, moving, 7), sum / double(moving));
}

TEST(Neighbours, OfManyParticlesAreThoseOfAnEvenSample) {
  // 250,000 particles on a line: all but the ends have 4 within 2.5 spacings.
  std::vector<double> xyz;
  for (int i = 0; i < 250000; ++i) xyz.insert(xyz.end(), {double(i), 0, 0});
  EXPECT_NEAR(mean_neighbours(xyz, 250000, 2.5), 4, 1e-3);
}

}  // namespace
}  // namespace lgiw
