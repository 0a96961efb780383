// Bodies that no lattice fits: rigid ones that move as prescribed, and soil with free edges.
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "case/polygon.hh"
#include "gtest/gtest.h"
#include "scene.hh"
#include "seeding/rigid_tiling.hh"

namespace lgiw::test {
namespace {

/// A motion file that goes with the test: 1 m in 2 s along (1, -1), pitching by 10 degrees.
class MotionFile {
 public:
  MotionFile() {
    std::string name = (std::filesystem::temp_directory_path() / "lgiw-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    std::ofstream(path()) << "t_s,dx_m,dz_m,pitch_deg\n0,0,0,0\n2,0.70710678,-0.70710678,10\n";
  }
  ~MotionFile() { std::filesystem::remove_all(folder_); }
  std::string path() const { return (folder_ / "motion.csv").string(); }

 private:
  std::filesystem::path folder_;
};

/// Sum of V W over everything at the water particles nearer than `near` to one of a body and deeper than the kernel's
/// support below `level`; checks spacing on the way.
struct Surroundings {
  double least = 1e9, most = 0, squares = 0, nearest = 1e9;
  int count = 0;
  Surroundings(const ParticleData& d, double dp, double level, double near) {
    const double h = 1.5 * dp;
    Neighbours all(2 * h), bodies(near);
    all.add(d.water), all.add(d.soil), all.add(d.wall);
    ParticleBlock body;
    for (std::size_t n = 0; n < d.wall.size(); ++n)
      if (d.wall.body.size() && d.wall.body[n] > 0) {
        body.points.insert(body.points.end(), &d.wall.points[3 * n], &d.wall.points[3 * n] + 3);
        body.volume.push_back(d.wall.volume[n]);
      }
    bodies.add(body), bodies.add(d.soil);
    for (std::size_t n = 0; n < d.water.size(); ++n) {
      const Point p = point(d.water, n);
      double to_body = near;
      bodies.visit(p, [&](const Point&, double, double r) { to_body = std::min(to_body, r); });
      nearest = std::min(nearest, to_body);
      if (to_body >= near || p[2] > level - 2 * h) continue;
      double filled = 0;
      all.visit(p, [&](const Point&, double volume, double r) { filled += volume * wendland_2d(r, h); });
      least = std::min(least, filled), most = std::max(most, filled);
      squares += (filled - 1) * (filled - 1), ++count;
    }
  }
  double rms() const { return std::sqrt(squares / count); }
};

double body_volume(const ParticleBlock& wall, int body) {
  double volume = 0;
  for (std::size_t n = 0; n < wall.size(); ++n)
    if (wall.body[n] == body) volume += wall.volume[n];
  return volume;
}

TEST(Polygon, AreasClippingAndDistance) {
  const std::vector<Point2> triangle{{100, 200}, {103, 200}, {100, 203}};
  EXPECT_DOUBLE_EQ(area_and_centroid(triangle).area, 4.5);
  EXPECT_DOUBLE_EQ(area_and_centroid(triangle).centroid[0], 101);
  EXPECT_DOUBLE_EQ(area_and_centroid({triangle.rbegin(), triangle.rend()}).area, 4.5);
  EXPECT_DOUBLE_EQ(area_and_centroid(clipped(triangle, {101, 201}, {110, 210})).area, 0.5);
  EXPECT_DOUBLE_EQ(area_and_centroid(clipped(triangle, {90, 190}, {101, 201})).area, 1);
  EXPECT_DOUBLE_EQ(area_and_centroid(clipped(triangle, {104, 204}, {110, 210})).area, 0);
  // A U cut across its legs: two pieces of 1.
  const std::vector<Point2> u{{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  EXPECT_DOUBLE_EQ(area_and_centroid(clipped(u, {-1, 2}, {4, 4})).area, 2);
  EXPECT_TRUE(contains(u, {0.5, 2}) && !contains(u, {1.5, 2}));
  EXPECT_DOUBLE_EQ(nearest_boundary(u, {1.6, 2}).distance, 0.4);
  EXPECT_EQ(nearest_boundary(u, {1.6, 2}).edge, 3u);
  EXPECT_EQ(nearest_boundary(u, {1.6, 2}, {false, false, false, true, false, false, false, false}).edge, 5u);
}

TEST(Tiling, PlateOfWholeCells) {
  // 30 mm thick, upright, dp 4 mm: 8 layers (7.5) of 3.75 mm, 50 along it.
  const std::vector<TileParticle> tiles =
      tile_polygon({{1, 0}, {1.03, 0}, {1.03, 0.2}, {1, 0.2}}, 0.004, [](double) { return 0.0; });
  ASSERT_EQ(tiles.size(), 8u * 50u);
  for (const TileParticle& t : tiles) {
    EXPECT_NEAR(t.area, 0.03 * 0.2 / 400, 1e-12);
    EXPECT_NEAR(std::hypot(t.normal[0], t.normal[1]), 1, 1e-12);
    if (t.place[1] > 0.03 && t.place[1] < 0.17) {
      EXPECT_NEAR(t.normal[0], t.place[0] < 1.015 ? -1 : 1, 1e-12);
    }
    EXPECT_GT(t.normal[1], -1e-9) << "nothing flows below it";
  }
}

std::vector<Point2> half_ellipse(double x, double z, double dip, double a, double b) {
  std::vector<Point2> outline;
  for (int k = 0; k <= 60; ++k) {
    const double u = a * std::cos(k * M_PI / 60), v = b * std::sin(k * M_PI / 60);
    outline.push_back({x + u * std::cos(dip) + v * std::sin(dip), z - u * std::sin(dip) + v * std::cos(dip)});
  }
  return outline;
}

TEST(Tiling, HalfEllipseKeepsItsArea) {
  const double dip = 15 * M_PI / 180;
  const std::vector<Point2> outline = half_ellipse(0.4, -0.4 * std::tan(dip), dip, 0.25, 0.026);
  const auto bed = [dip](double x) { return -x * std::tan(dip); };
  for (const double dp : {0.002, 0.003, 0.005, 0.01}) {
    double area = 0;
    for (const TileParticle& t : tile_polygon(outline, dp, bed)) {
      area += t.area;
      EXPECT_TRUE(contains(outline, t.place));
      EXPECT_GT(t.area, 0.2 * dp * dp);
      EXPECT_GT(t.normal[0] * std::sin(dip) + t.normal[1] * std::cos(dip), -1e-3) << "not into the bed";
    }
    EXPECT_NEAR(area, area_and_centroid(outline).area, 1e-12);
  }
}

std::string outline_text(const std::vector<Point2>& outline) {
  std::string text = "[";
  for (const Point2& p : outline)
    text += (text.size() > 1 ? ", [" : "[") + std::to_string(p[0]) + ", " + std::to_string(p[1]) + "]";
  return text + "]";
}

// The first has the place, whichever it is; what another has above and below it is soil all the same.
TEST(Overlap, OfBodiesIsFilledOnce) {
  const std::string inner = "[[50, 10], [80, 10], [80, 20], [50, 20]]",
                    outer = "[[40, 0], [70, 0], [70, 30], [40, 30]]";
  for (const char* water : {"", "water: {level: 40}\n"})
    for (const bool inner_first : {true, false}) {
      const Scene s = seeded(
          "name: o\ndimension: 2\nparticle_spacing: 1\nterrain: {profile: [[0, 0], [200, 0]]}\nslide: {bodies: [" +
          (inner_first ? inner + ", " + outer : outer + ", " + inner) + "]}\n" + water);
      EXPECT_NEAR(sum(s.data.soil.volume), 1000, 1e-3);
      for (std::size_t n = 0; n < s.data.water.size(); ++n) {
        const Point p = point(s.data.water, n);
        EXPECT_FALSE(p[0] > 40.5 && p[0] < 69.5 && p[2] < 29.5) << p[0] << ", " << p[2];
      }
      if (*water) {
        EXPECT_NEAR(sum(s.data.water.volume), 7000, 1e-2 * 7000);
      }
    }
}

TEST(Overlap, OfMovingBodiesHoldsNoWater) {
  const MotionFile motion;
  const Scene s = seeded(
      "name: r\ndimension: 2\nparticle_spacing: 1\nterrain: {profile: [[0, 0], [100, 0]]}\nwater: {level: "
      "25}\nbodies:\n"
      "- {name: A, outline: [[40, 5], [50, 5], [50, 15], [40, 15]], motion: " +
      motion.path() +
      "}\n"
      "- {name: B, outline: [[45, 0], [55, 0], [55, 20], [45, 20]], motion: " +
      motion.path() + "}\n");
  for (std::size_t n = 0; n < s.data.water.size(); ++n) {
    const Point p = point(s.data.water, n);
    EXPECT_FALSE(p[0] > 45.2 && p[0] < 54.8 && p[2] < 19.8) << p[0] << ", " << p[2];
  }
  EXPECT_NEAR(sum(s.data.water.volume), 2250, 0.005 * 2250);
}

TEST(RigidBodies, BlockOnASlope) {
  const MotionFile motion;
  const double dip = 15 * M_PI / 180;
  const std::vector<Point2> outline = half_ellipse(0.6, -0.6 * std::tan(dip), dip, 0.25, 0.026);
  const Scene s = seeded(
      "name: sue\ndimension: 2\nparticle_spacing: 0.004\n"
      "terrain: {profile: [[-0.4, 0.107180], [1.6, -0.428719], [2.2, -0.428719]]}\n"
      "water: {level: 0}\nslide: {bodies: [" +
      outline_text(outline) + "], motion: {file: " + motion.path() + "}}\n");
  ASSERT_EQ(s.data.header.bodies.size(), 1u);
  EXPECT_EQ(s.data.header.bodies[0].name, "slide");
  EXPECT_EQ(s.data.soil.size(), 0u);
  EXPECT_NEAR(s.data.header.bodies[0].pivot[0], area_and_centroid(outline).centroid[0], 1e-5);
  EXPECT_NEAR(s.data.header.bodies[0].pivot[2], area_and_centroid(outline).centroid[1], 1e-5);
  const double volume = area_and_centroid(outline).area;
  EXPECT_NEAR(body_volume(s.data.wall, 1), volume, 1e-4 * volume);  // the text holds six digits
  for (std::size_t n = 0; n < s.data.wall.size(); ++n) EXPECT_EQ(s.data.wall.kind[n] == 2, s.data.wall.body[n] == 1);
  const Surroundings around(s.data, 0.004, 0, 0.008);
  EXPECT_GT(around.count, 100);
  EXPECT_GT(around.nearest, 0.5 * 0.004);
  EXPECT_GT(around.least, 0.93);
  EXPECT_LT(around.most, 1.10);
  printf("block: V W %.3f to %.3f, rms %.3f, nearest %.2f dp\n", around.least, around.most, around.rms(),
         around.nearest / 0.004);
  // Triangle of 1.6 m on the slope, rectangle, less the block.
  const double water = 0.5 * 1.6 * 0.428719 + 0.6 * 0.428719 - volume;
  EXPECT_NEAR(sum(s.data.water.volume), water, 0.003 * water);
}

class Plate : public testing::TestWithParam<double> {};

TEST_P(Plate, HangsInTheWater) {
  const MotionFile motion;
  const double x = 0.5 + GetParam() * 0.01, thick = 0.035;
  const Scene s = seeded(
      "name: plate\ndimension: 2\nparticle_spacing: 0.01\nterrain: {profile: [[0, 0], [1, 0]]}\n"
      "water: {level: 0.4}\nbodies: [{name: plate, motion: " +
      motion.path() + ", outline: " + outline_text({{x, 0.123}, {x + thick, 0.123}, {x + thick, 0.5}, {x, 0.5}}) +
      "}]\n");
  ASSERT_EQ(s.data.header.bodies.size(), 1u);
  EXPECT_NEAR(body_volume(s.data.wall, 1), thick * 0.377, 1e-6);
  EXPECT_NEAR(s.data.header.bodies[0].pivot[0], x + thick / 2, 1e-9);
  EXPECT_NEAR(sum(s.data.water.volume), 0.4 - thick * 0.277, 0.001);
  const Surroundings around(s.data, 0.01, 0.4, 0.02);
  EXPECT_GT(around.count, 50);
  EXPECT_GT(around.nearest, 0.5 * 0.01);
  EXPECT_GT(around.least, 0.93);
  EXPECT_LT(around.most, 1.10);
  printf("plate: V W %.3f to %.3f, rms %.3f, nearest %.2f dp\n", around.least, around.most, around.rms(),
         around.nearest / 0.01);
  for (std::size_t n = 0; n < s.data.water.size(); ++n) {
    const Point p = point(s.data.water, n);
    EXPECT_FALSE(p[0] > x && p[0] < x + thick && p[2] > 0.123) << p[0] << " " << p[2];
  }
}

INSTANTIATE_TEST_SUITE_P(Places, Plate, testing::Values(0, 0.25, 0.5, 0.8));

TEST(RigidBodies, ReachOverTheWholeWidthIn3D) {
  const MotionFile motion;
  const Scene s = seeded(
      "name: wide\nparticle_spacing: 0.05\nterrain: {profile: [[0, 0], [2, 0]], width: 0.5}\n"
      "water: {level: 0.6}\nbodies:\n- {name: a, motion: " +
      motion.path() + ", outline: [[0.5, 0.2], [0.7, 0.2], [0.7, 0.4], [0.5, 0.4]]}\n- {name: b, motion: " +
      motion.path() + ", pivot: [1.5, 0], outline: [[1.41, 0.0], [1.63, 0.0], [1.52, 0.33]]}\n");
  EXPECT_NEAR(body_volume(s.data.wall, 1), 0.2 * 0.2 * 0.5, 1e-6);
  EXPECT_NEAR(body_volume(s.data.wall, 2), 0.5 * 0.22 * 0.33 * 0.5, 1e-6);
  EXPECT_EQ(s.data.header.bodies[1].pivot, (std::array<double, 3>{1.5, 0.25, 0}));
  const double water = (2 * 0.6 - 0.04 - 0.0363) * 0.5;
  EXPECT_NEAR(sum(s.data.water.volume), water, 0.01 * water);
  const Surroundings around(s.data, 0.05, -1, 0.1);
  EXPECT_GT(around.nearest, 0.5 * 0.05);
}

// A smooth hump on a plane slope, from height fields as a DEM gives them.
TEST(RigidBodies, SlideOfADem) {
  const MotionFile motion;
  const double dp = 0.04, dx = 0.02, level = 0;
  Scene s;
  s.c = parse_case(
      "name: hump\nparticle_spacing: 0.04\nterrain: {sources: [{file: dem.tif}]}\n"
      "water: {level: 0, seed: [1, 0.5]}\n"
      "slide: {depth: 0.1, polygon: [[0, 0], [1, 0], [1, 1]], motion: {file: " +
          motion.path() + ", heading: 80}}\n",
      "scene");
  TerrainModel& m = s.model;
  m.ground = {101, 51, 0, 0, dx, {}};
  m.origin = {500, 600, 0};
  m.still_water_level = level;
  double moment = 0;
  for (int j = 0; j < 51; ++j)
    for (int i = 0; i < 101; ++i) {
      const double x = i * dx, y = j * dx, bed = -0.15 - 0.3 * x, r = std::hypot(x - 0.9, y - 0.5) / 0.35;
      const double hump = r < 1 ? 0.12 * (1 - r * r) * (1 - r * r) : 0;
      m.bed.z.push_back(bed), m.ground.z.push_back(bed + hump);
      m.wet.push_back(1), m.slide.push_back(hump > 0);
      m.slide_volume += hump * dx * dx, moment += x * hump * dx * dx;
    }
  m.bed.nx = 101, m.bed.ny = 51, m.bed.dx = dx;
  m.domain = {0, 0, 2, 1};
  s.data = seed_particles(s.c, m);
  const ParticleBlock &wall = s.data.wall, &water = s.data.water;
  EXPECT_NEAR(body_volume(wall, 1), m.slide_volume, 1e-6 * m.slide_volume);
  ASSERT_EQ(s.data.header.bodies.size(), 1u);
  EXPECT_EQ(s.data.header.bodies[0].heading, 80);
  EXPECT_NEAR(s.data.header.bodies[0].pivot[0], moment / m.slide_volume, 0.01);
  EXPECT_NEAR(s.data.header.bodies[0].pivot[1], 0.5, 0.01);
  EXPECT_EQ(s.data.soil.size(), 0u);
  double outwards = 1;
  for (std::size_t n = 0; n < wall.size(); ++n) {
    EXPECT_EQ(wall.kind[n] == 2, wall.body[n] == 1);
    if (wall.body[n] == 1) outwards = std::min(outwards, double(wall.normal[3 * n + 2]));
  }
  EXPECT_GT(outwards, 0.6) << "up and out";
  const double h = 1.5 * dp;
  Neighbours all(2 * h);
  all.add(water), all.add(wall);
  double least = 1e9, most = 0;
  for (std::size_t n = 0; n < water.size(); ++n) {
    const Point p = point(water, n);
    EXPECT_GT(p[2], m.ground.height(p[0], p[1]) + 0.3 * dp);
    if (std::hypot(p[0] - 0.9, p[1] - 0.5) > 0.4 || p[2] > level - 2 * h) continue;
    // Where the slide thins out its particles lie at its surface.
    EXPECT_GT(all.nearest(p), 0.5 * dp) << p[0] << " " << p[1] << " " << p[2];
    double filled = 0;
    all.visit(p, [&](const Point&, double volume, double r) {
      const double q = r / h, b = 1 - 0.5 * q;
      filled += volume * 21 / (16 * M_PI * h * h * h) * b * b * b * b * (2 * q + 1);
    });
    least = std::min(least, filled), most = std::max(most, filled);
  }
  EXPECT_GT(least, 0.9);
  EXPECT_LT(most, 1.1);
  printf("hump: V W %.3f to %.3f\n", least, most);
}

// Free edges: Viroulet's triangle on its slope, at three spacings.
class FreeEdges : public testing::TestWithParam<double> {};

TEST_P(FreeEdges, KeepTheArea) {
  const double dp = GetParam();
  char text[500];
  std::snprintf(text, sizeof text,
                "name: viroulet\ndimension: 2\nparticle_spacing: %g\n"
                "terrain: {profile: [[-0.3, 0.3], [0.15, -0.15], [2.2, -0.15]]}\nwater: {level: 0}\n"
                "slide: {bodies: [[[-0.115, 0.115], [0, 0], [0, 0.115]]]}\n",
                dp);
  const Scene s = seeded(text);
  EXPECT_NEAR(sum(s.data.soil.volume), 0.115 * 0.115 / 2, 1e-6 * 0.0066);
  // As many as the area has cells: particles of very nearly dp2.
  EXPECT_NEAR(s.data.soil.volume[0], dp * dp, 0.008 * dp * dp);
  Neighbours all(3 * dp), soil(3 * dp);
  all.add(s.data.water), all.add(s.data.soil), all.add(s.data.wall), soil.add(s.data.soil);
  EXPECT_GT(nearest_pair(s.data.soil, all, 3 * dp), 0.6 * dp);
  double least = 1e9, most = 0;
  for (std::size_t n = 0; n < s.data.soil.size(); ++n) {
    const Point p = point(s.data.soil, n);
    if (p[0] > -3 * dp || p[2] > 0.115 - 3 * dp) continue;
    double filled = 0;
    all.visit(p, [&](const Point&, double volume, double r) { filled += volume * wendland_2d(r, 1.5 * dp); });
    least = std::min(least, filled), most = std::max(most, filled);
  }
  EXPECT_GT(least, 0.9);
  EXPECT_LT(most, 1.13);
  printf("triangle at %g: V W %.3f to %.3f\n", dp, least, most);
}

INSTANTIATE_TEST_SUITE_P(Spacings, FreeEdges, testing::Values(0.01, 0.005, 0.0025));

TEST(FreeEdges, SubmergedWedgeIsSurroundedEvenly) {
  const Scene s = seeded(R"(
name: wedge
dimension: 2
particle_spacing: 0.01
terrain: {profile: [[0, 0.5], [0.5, 0], [1.5, 0]]}
water: {level: 0.45}
slide: {bodies: [[[0.2, 0.3], [0.4, 0.1], [0.403, 0.303]]]}
)");
  const double soil = area_and_centroid({{0.2, 0.3}, {0.4, 0.1}, {0.403, 0.303}}).area;
  EXPECT_NEAR(sum(s.data.soil.volume), soil, 1e-4 * soil);
  EXPECT_NEAR(sum(s.data.water.volume), 0.45 * 0.45 / 2 + 0.45 - soil, 0.003);
  const Surroundings around(s.data, 0.01, 0.45, 0.02);
  EXPECT_GT(around.nearest, 0.5 * 0.01);
  EXPECT_GT(around.least, 0.9);
  EXPECT_LT(around.most, 1.12);
  printf("wedge: V W %.3f to %.3f, rms %.3f\n", around.least, around.most, around.rms());
}

}  // namespace
}  // namespace lgiw::test
