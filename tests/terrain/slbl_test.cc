// The sloping local base level against its closed forms and against the iteration as it is published.
#include <algorithm>
#include <cmath>

#include "hand_rasters.hh"
#include "terrain/slide_body.hh"

namespace lgiw {
namespace {

using namespace test;
using detail::automatic_tolerance;
using detail::sloping_local_base_level;

HeightField field(std::size_t nx, std::size_t ny, double dx, const std::function<double(double, double)>& z) {
  HeightField ground;
  ground.nx = nx, ground.ny = ny, ground.dx = dx;
  for (std::size_t j = 0; j < ny; ++j)
    for (std::size_t i = 0; i < nx; ++i) ground.z.push_back(z(double(i) * dx, double(j) * dx));
  return ground;
}

std::vector<uint8_t> box(const HeightField& ground, std::size_t i0, std::size_t i1, std::size_t j0, std::size_t j1) {
  std::vector<uint8_t> inside(ground.z.size(), 0);
  for (std::size_t j = j0; j <= j1; ++j)
    for (std::size_t i = i0; i <= i1; ++i) inside[j * ground.nx + i] = 1;
  return inside;
}

// Lower to (mean of neighbours - C) whatever lies higher, until nothing moves: Jaboyedoff et al. 2004, 2019.
std::vector<double> as_published(const HeightField& ground, const std::vector<uint8_t>& inside, double tolerance,
                                 int neighbours) {
  std::vector<double> z = ground.z, next = z;
  const int64_t nx = int64_t(ground.nx), steps[] = {-1, 1, -nx, nx, -nx - 1, -nx + 1, nx - 1, nx + 1};
  for (double largest = 1; largest > 1e-12;) {
    largest = 0;
    for (std::size_t k = 0; k < z.size(); ++k) {
      if (!inside[k]) continue;
      double mean = 0;
      for (int s = 0; s < neighbours; ++s) mean += z[std::size_t(int64_t(k) + steps[s])] / neighbours;
      next[k] = std::min(z[k], mean - tolerance);
      largest = std::max(largest, z[k] - next[k]);
    }
    z = next;
  }
  return z;
}

class Strip : public testing::TestWithParam<int> {};

TEST_P(Strip, OnASlopeIsTheParabola) {
  // 20 intervals along the slope, 40 times as wide: the middle does not feel the ends.
  const int neighbours = GetParam(), n = 20;
  const double dx = 5, tolerance = 0.02;
  const HeightField ground = field(n + 3, 403, dx, [](double x, double) { return 500 - 0.6 * x; });
  const auto inside = box(ground, 2, n, 1, 401);  // between nodes 1 and n + 1, which stay
  SlideSurface::Slbl parameters;
  parameters.neighbours = neighbours;
  const auto z = sloping_local_base_level(ground, inside, parameters, tolerance);
  const double factor = neighbours == 8 ? 4.0 / 3 : 2.0;
  for (int s = 1; s < n; ++s) {
    const std::size_t k = 201 * ground.nx + std::size_t(1 + s);
    EXPECT_NEAR(ground.z[k] - z[k], factor * tolerance * s * (n - s), 1e-4 * tolerance * n * n) << s;
  }
}

INSTANTIATE_TEST_SUITE_P(Neighbours, Strip, testing::Values(4, 8));

TEST(Slbl, DiscIsTheParaboloid) {
  // On a plane, 4 C / dx2 = Laplacian of the depth: C / dx2 (R2 - r2) in a disc, up to its staircase of an edge.
  const int radius = 60;
  const double dx = 2, tolerance = 1e-3;
  const HeightField ground = field(131, 131, dx, [](double x, double y) { return 90 + 0.3 * x - 0.2 * y; });
  std::vector<uint8_t> inside(ground.z.size(), 0);
  for (int j = 0; j < 131; ++j)
    for (int i = 0; i < 131; ++i) inside[std::size_t(j * 131 + i)] = std::hypot(i - 65, j - 65) < radius;
  const auto z = sloping_local_base_level(ground, inside, {}, tolerance);
  const std::size_t middle = 65 * 131 + 65;
  EXPECT_NEAR(ground.z[middle] - z[middle], tolerance * radius * radius, 0.01 * tolerance * radius * radius);
}

TEST(Slbl, SameAsThePublishedIteration) {
  // A rough, partly concave slope, on which some cells stay at the ground.
  const HeightField ground = field(24, 20, 10, [](double x, double y) {
    return 300 - 0.5 * x + 12 * std::sin(0.06 * x) * std::cos(0.05 * y) + 0.0008 * y * y;
  });
  auto inside = box(ground, 2, 21, 3, 16);
  inside[10 * 24 + 2] = inside[4 * 24 + 21] = 0;
  for (const int neighbours : {4, 8})
    for (const double tolerance : {-0.02, 0.0, 0.05}) {
      SlideSurface::Slbl parameters;
      parameters.neighbours = neighbours;
      const auto z = sloping_local_base_level(ground, inside, parameters, tolerance);
      const auto expected = as_published(ground, inside, tolerance, neighbours);
      double worst = 0, deepest = 0;
      int at_ground = 0;
      for (std::size_t k = 0; k < z.size(); ++k) {
        worst = std::max(worst, std::abs(z[k] - expected[k]));
        deepest = std::max(deepest, ground.z[k] - z[k]);
        at_ground += inside[k] && z[k] == ground.z[k];
        if (!inside[k]) {
          ASSERT_EQ(z[k], ground.z[k]);
        }
      }
      EXPECT_LT(worst, 1e-4) << neighbours << " " << tolerance;
      EXPECT_GT(deepest, 3);
      if (tolerance <= 0) {
        EXPECT_GT(at_ground, 10);
      }
    }
}

TEST(Slbl, LimitsOfDepthAndSlope) {
  const HeightField ground = field(43, 403, 5, [](double x, double) { return 500 - 0.6 * x; });
  const auto inside = box(ground, 2, 40, 2, 400);
  SlideSurface::Slbl parameters;
  const double tolerance = 0.05;  // unlimited: 2 C 20 x 20 = 40 m
  const std::size_t middle = 201 * 43 + 21;
  EXPECT_NEAR(ground.z[middle] - sloping_local_base_level(ground, inside, parameters, tolerance)[middle], 40, 0.01);
  parameters.max_depth = 15;
  auto z = sloping_local_base_level(ground, inside, parameters, tolerance);
  double deepest = 0;
  for (std::size_t k = 0; k < z.size(); ++k) deepest = std::max(deepest, ground.z[k] - z[k]);
  EXPECT_DOUBLE_EQ(deepest, 15);
  EXPECT_DOUBLE_EQ(ground.z[middle] - z[middle], 15);
  // 45 degrees from the back scarp: the first cell below it, 5 m on, lies at most 5 m below the ground beside it.
  parameters.max_depth = 0;
  const std::size_t first = 201 * 43 + 2;
  z = sloping_local_base_level(ground, inside, parameters, tolerance);
  EXPECT_GT(ground.z[first - 1] - z[first], 5 + 1);
  parameters.max_slope = 45;
  z = sloping_local_base_level(ground, inside, parameters, tolerance);
  EXPECT_NEAR(ground.z[first - 1] - z[first], 5, 1e-9);
}

TEST(Slbl, AutomaticToleranceReachesTheWantedDepth) {
  // A long strip, 20 m deep by wish: the closed form of the strip. Then an ellipse.
  const HeightField ground = field(43, 1203, 5, [](double x, double) { return 500 - 0.6 * x; });
  SlideSurface::Slbl parameters;
  parameters.max_depth = 20;
  const auto strip = box(ground, 2, 40, 1, 1201);
  const double tolerance = automatic_tolerance(ground, strip, parameters);
  EXPECT_NEAR(tolerance, 2 * 20 * (1.0 / (40 * 40) + 1.0 / (1202 * 1202)), 1e-9);
  parameters.max_depth = 0;  // a tenth of the length of 200 m: 20 m again
  EXPECT_NEAR(automatic_tolerance(ground, strip, parameters), tolerance, 1e-9);

  const HeightField slope = field(107, 67, 5, [](double x, double y) { return 500 - 0.4 * x + 0.0 * y; });
  std::vector<uint8_t> ellipse(slope.z.size(), 0);
  for (int j = 0; j < 67; ++j)
    for (int i = 0; i < 107; ++i)
      ellipse[std::size_t(j * 107 + i)] = std::pow((i - 53) / 50.0, 2) + std::pow((j - 33) / 30.0, 2) < 1;
  for (const int neighbours : {4, 8}) {
    parameters.neighbours = neighbours;
    parameters.max_depth = 30;
    const double c = automatic_tolerance(slope, ellipse, parameters);
    parameters.max_depth = 0;
    const auto z = sloping_local_base_level(slope, ellipse, parameters, c);
    const std::size_t middle = 33 * 107 + 53;
    EXPECT_NEAR(slope.z[middle] - z[middle], 30, 0.6) << neighbours;
  }
}

TEST(Slbl, ThroughTheCase) {
  Scratch scratch;
  Case c = raster_case({write_asc(scratch("a.asc"), 0, 0, 10,
                                  rows_of(40, 40, 0, 0, 10, [](double x, double) { return 400 - 0.5 * x; }))});
  c.slide.present = true;
  c.slide.polygon = {{100, 100}, {300, 100}, {300, 300}, {100, 300}};
  c.slide.surface.slbl.emplace();
  const TerrainModel model = build(c);
  EXPECT_GT(model.slide_volume, 0);
  double deepest = 0;
  for (std::size_t k = 0; k < model.bed.z.size(); ++k) deepest = std::max(deepest, model.ground.z[k] - model.bed.z[k]);
  // A square of side L: 0.0737 L2 q against the inscribed ellipse's L2 q / 16 = 0.1 L (Saint-Venant's torsion problem).
  EXPECT_NEAR(deepest, 0.1 * 210 * 0.0737 * 16, 0.02 * 25);
  EXPECT_HAS(model.notes.back(), "slide.slbl.tolerance: automatic");
}

}  // namespace
}  // namespace lgiw
