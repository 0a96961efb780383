// The real canyon of the demo: volumes against the terrain's, spacing and walls on rough ground.
#include <algorithm>

#include "base/error.hh"
#include "gtest/gtest.h"
#include "scene.hh"

namespace lgiw::test {
namespace {

std::string canyon(double dp, const std::string& window, const std::string& rest = "") {
  char text[1500];
  std::snprintf(text, sizeof text,
                "name: canyon\nparticle_spacing: %g\nterrain:\n  crs: EPSG:32611\n  vertical_datum: EGM96\n  sources: "
                "[{file: %s/pipelines/demo/terrain/big_tujunga_srtm30_utm11.tif}]\n%s"
                "water: {level: 740, seed: [389600, 3794000]}\n%s",
                dp, LGIW_SOURCE_DIR, window.c_str(), rest.c_str());
  return text;
}

TEST(Canyon, ReservoirVolumeOfTheWholeDem) {
  const Case c = parse_case(canyon(20, ""), "canyon");
  Provenance provenance;
  const TerrainModel model = build_terrain(c, provenance);
  ASSERT_NEAR(model.reservoir_volume, 156.44e6, 0.01e6);  // the table in the DEM's README
  Seeder seeder(c, model);
  const SeedingReport& r = seeder.count();
  EXPECT_NEAR(r.water_volume, 156.44e6, 0.01 * 156.44e6);
  EXPECT_NEAR(r.water_volume, r.water_expected, 0.006 * r.water_expected);
  EXPECT_NEAR(r.max_water_depth, 151, 1.5);
  EXPECT_GT(r.counts.wall_left_out, r.counts.wall / 2);  // high ground
  EXPECT_EQ(r.counts.soil, 0);
}

TEST(Canyon, TooFineASpacingIsRefusedBeforeMemoryIsTaken) {
  const Case c = parse_case(canyon(0.1, ""), "canyon");
  Provenance provenance;
  const TerrainModel model = build_terrain(c, provenance);
  try {
    Seeder seeder(c, model);
    FAIL() << "2.9e9 columns";
  } catch (const InputError& e) {
    EXPECT_EQ(
        std::string(e.what()).rfind("particle_spacing 0.100000 m is too small for this terrain (the map alone has "
                                    "2880000000 columns",
                                    0),
        0u)
        << e.what();
  }
}

TEST(Canyon, SlideVolumeAndSpacing) {
  const std::string window = "  window: [388430, 3793240, 390920, 3795310]\n";
  const Scene s = seeded(canyon(15, window,
                                "slide:\n  polygon: [[389440, 3793700], [389490, 3793770], [389600, 3793780], [389690, "
                                "3793740], [389715, 3793560],"
                                " [389690, 3793390], [389560, 3793370], [389450, 3793420]]\n"
                                "  plane: {point: [389560, 3793802, 690], dip: 23, dip_direction: 350}\n"));
  ASSERT_GT(s.model.slide_volume, 2e6);
  EXPECT_NEAR(sum(s.data.soil.volume), s.model.slide_volume, 0.01 * s.model.slide_volume);

  const double dp = 15, reach = 2 * dp;
  Neighbours fluid(reach), wall(reach);
  fluid.add(s.data.water), fluid.add(s.data.soil), wall.add(s.data.wall);
  EXPECT_GT(nearest_pair(s.data.water, fluid, reach), 0.6 * dp);
  EXPECT_GT(nearest_pair(s.data.soil, fluid, reach), 0.6 * dp);
  EXPECT_GT(nearest_pair(s.data.water, wall, reach), 0.6 * dp);
  EXPECT_GT(nearest_pair(s.data.soil, wall, reach), 0.6 * dp);

  for (std::size_t n = 0; n < s.data.water.size(); ++n) {
    const Point p = point(s.data.water, n);
    EXPECT_GT(p[2], s.model.bed.height(p[0], p[1]) + 0.3 * dp);
    EXPECT_LT(p[2], s.model.still_water_level + 0.5 * dp);
  }
  for (std::size_t n = 0; n < s.data.soil.size(); ++n) {
    const Point p = point(s.data.soil, n);
    const double vertical = s.data.soil.stress[6 * n + 2];
    EXPECT_LE(vertical, 0);
    EXPECT_LE(s.data.soil.stress[6 * n], -s.data.soil.pressure[n] + 1);  // effective stress is compressive
    EXPECT_GT(p[2], s.model.bed.height(p[0], p[1]));
  }
  // Every particle that may move stands on walls: below each, within 2h of the bed under it, there is one.
  for (const ParticleBlock* block : {&s.data.water, &s.data.soil})
    for (std::size_t n = 0; n < block->size(); ++n) {
      Point p = point(*block, n);
      p[2] = s.model.bed.height(p[0], p[1]);
      ASSERT_LT(wall.nearest(p), 1.3 * dp);
    }
}

TEST(Canyon, KernelSupportOnRoughGround) {
  const Scene s = seeded(canyon(10, "  window: [389000, 3793600, 389900, 3794300]\n"));
  const double dp = 10, h = 15, level = s.model.still_water_level;
  Neighbours all(2 * h);
  all.add(s.data.water), all.add(s.data.wall);
  const auto wendland_3d = [&](double r) {
    const double q = r / h, b = 1 - 0.5 * q;
    return 21 / (16 * M_PI * h * h * h) * b * b * b * b * (2 * q + 1);
  };
  double error = 0, least = 2, most = 0;
  int64_t points = 0;
  for (std::size_t n = 0; n < s.data.water.size(); ++n) {
    const Point p = point(s.data.water, n);
    if (p[2] > level - 2 * h || p[2] - s.model.bed.height(p[0], p[1]) > 4 * dp) continue;
    double filled = 0;
    all.visit(p, [&](const Point&, double volume, double r) { filled += volume * wendland_3d(r); });
    error += (filled - 1) * (filled - 1), ++points;
    least = std::min(least, filled), most = std::max(most, filled);
  }
  ASSERT_GT(points, 1000);
  EXPECT_LT(std::sqrt(error / double(points)), 0.04);
  EXPECT_GT(least, 0.88);
  EXPECT_LT(most, 1.15);
}

}  // namespace
}  // namespace lgiw::test
