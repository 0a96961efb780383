// Reading, splicing, reprojecting and mending of terrain rasters.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "hand_rasters.hh"

namespace lgiw {
namespace {

using namespace test;

const std::string tujunga = LGIW_SOURCE_DIR "/pipelines/demo/terrain/big_tujunga_srtm30_utm11.tif";
const std::string tirol = LGIW_TEST_DATA "/terrain/tirol/tirol_hit_lidar5.tif";
const std::string exploradores = LGIW_TEST_DATA "/terrain/exploradores/exploradores_aster30_utm18s.tif";
constexpr double tujunga_west = 388313.655454263498541, tujunga_north = 3798017.827628375496715;

Case tujunga_case(double dp, double level) {
  Case c = raster_case({tujunga}, dp);
  c.water.present = true;
  c.water.level = level;
  c.water.seed = Point2{tujunga_west + 30 * 80.5, tujunga_north - 30 * 86.5};
  return c;
}

std::string digits(double value, int places) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", places, value);
  return text;
}

struct FillRow {
  double level;
  const char *area, *volume;
  double depth;
};

// The table of the DEM's README: an exact oracle, to the digits given.
class FillTable : public testing::TestWithParam<FillRow> {};

TEST_P(FillTable, IsReproduced) {
  const FillRow& row = GetParam();
  const TerrainModel model = build(tujunga_case(20, row.level));
  EXPECT_EQ(digits(model.reservoir_area / 1e6, 3), row.area);
  EXPECT_EQ(digits(model.reservoir_volume / 1e6, 2), row.volume);
  EXPECT_EQ(model.max_water_depth, row.depth);
  // Nodes are the cells, so the mask covers the same area.
  EXPECT_EQ(double(std::count(model.wet.begin(), model.wet.end(), 1)) * 900, model.reservoir_area);
}

INSTANTIATE_TEST_SUITE_P(Tujunga, FillTable,
                         testing::Values(FillRow{700, "1.594", "61.27", 111}, FillRow{720, "2.320", "102.21", 131},
                                         FillRow{740, "3.023", "156.44", 151}, FillRow{760, "3.773", "224.83", 171},
                                         FillRow{800, "5.759", "420.22", 211}));

TEST(Rasters, CellsStayAsTheyAreWhereCrsAndGridAgree) {
  const TerrainModel model = build(tujunga_case(20, 740));
  const HeightField& ground = model.ground;
  EXPECT_EQ(ground.nx, 200u);
  EXPECT_EQ(ground.ny, 160u);
  EXPECT_DOUBLE_EQ(ground.dx, 30);
  EXPECT_DOUBLE_EQ(model.origin[0], 388328);  // the south-western cell centre at 388328.66, 3793232.83
  EXPECT_DOUBLE_EQ(model.origin[1], 3793232);
  EXPECT_NEAR(ground.x0, 0.655454, 1e-5);
  EXPECT_NEAR(ground.y0, 0.827628, 1e-5);
  EXPECT_EQ(ground.at(80, 159 - 86), 673);  // the README's seed
  EXPECT_EQ(*std::min_element(ground.z.begin(), ground.z.end()), 589);
  EXPECT_EQ(*std::max_element(ground.z.begin(), ground.z.end()), 1672);
  EXPECT_EQ(model.bed.z, ground.z);
  EXPECT_HAS(model.crs_wkt, "UTM zone 11N");
  EXPECT_EQ(model.domain[2], ground.x_max());
}

TEST(Rasters, ReservoirStaysAtSourceResolutionWhereNodesAreCoarser) {
  const TerrainModel model = build(tujunga_case(75, 740));  // 2 x 2 cells a node
  EXPECT_DOUBLE_EQ(model.ground.dx, 60);
  EXPECT_EQ(model.ground.nx, 100u);
  EXPECT_EQ(digits(model.reservoir_volume / 1e6, 2), "156.44");
  const TerrainModel fine = build(tujunga_case(20, 740));
  EXPECT_DOUBLE_EQ(
      model.ground.at(7, 9),
      (fine.ground.at(14, 18) + fine.ground.at(15, 18) + fine.ground.at(14, 19) + fine.ground.at(15, 19)) / 4);
  EXPECT_NEAR(double(std::count(model.wet.begin(), model.wet.end(), 1)) * 3600, model.reservoir_area,
              0.03 * model.reservoir_area);
}

TEST(Rasters, WindowTakesTheCellsWhoseCentresLieInIt) {
  Scratch scratch;
  Case c = raster_case(
      {write_asc(scratch("a.asc"), 1000, 2000, 10,
                 rows_of(8, 6, 1000, 2000, 10, [](double x, double y) { return x - 1000 + 100 * (y - 2000); }))});
  c.terrain.window = {{1014, 2015, 1056, 2055}};
  const TerrainModel model = build(c);
  EXPECT_EQ(model.ground.nx, 5u);  // centres 1015, 1025, ... 1055 but not 1065
  EXPECT_EQ(model.ground.ny, 5u);  // 2015 ... 2055
  EXPECT_DOUBLE_EQ(model.ground.at(0, 0), 15 + 1500);
  EXPECT_DOUBLE_EQ(model.ground.at(3, 4), 45 + 5500);
  EXPECT_DOUBLE_EQ(model.origin[0] + model.ground.x0, 1015);
  ASSERT_EQ(model.notes.size(), 1u);
  EXPECT_HAS(model.notes[0], "names no CRS: taken to be in EPSG:32611");
}

TEST(Rasters, SouthUpAndNorthUpAreTheSame) {
  Scratch scratch;
  const auto height = [](double x, double y) { return 0.1 * x + 0.02 * x * y; };
  auto rows = rows_of(5, 4, 0, 0, 10, height);
  const TerrainModel north =
      build(raster_case({write_tif(scratch("n.tif"), {0, 10, 0, 40, 0, -10}, "EPSG:32611", rows)}));
  std::reverse(rows.begin(), rows.end());
  const TerrainModel south =
      build(raster_case({write_tif(scratch("s.tif"), {0, 10, 0, 0, 0, 10}, "EPSG:32611", rows)}));
  EXPECT_EQ(north.ground.z, south.ground.z);
  EXPECT_DOUBLE_EQ(north.ground.at(0, 0), height(5, 5));
}

TEST(Rasters, FeetAndDegreesInTheSourceAreReprojected) {
  Scratch scratch;
  // A plane in UTM 11N drawn on a grid of degrees: reprojection must give the plane back.
  const auto plane = [](double x, double y) { return 500 + 0.1 * (x - 390000) + 0.05 * (y - 3795000); };
  OGRSpatialReference degrees, utm;
  degrees.importFromEPSG(4326);
  utm.importFromEPSG(32611);
  degrees.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  std::unique_ptr<OGRCoordinateTransformation> forward(OGRCreateCoordinateTransformation(&degrees, &utm));
  const double cell = 1.0 / 3600, west = -118.21, north = 34.30;
  std::vector<std::vector<double>> rows(60, std::vector<double>(80));
  for (int r = 0; r < 60; ++r)
    for (int k = 0; k < 80; ++k) {
      double x = west + (k + 0.5) * cell, y = north - (r + 0.5) * cell;
      ASSERT_TRUE(forward->Transform(1, &x, &y));
      rows[r][k] = plane(x, y);
    }
  Case c = raster_case({write_tif(scratch("degrees.tif"), {west, cell, 0, north, 0, -cell}, "EPSG:4326", rows)});
  c.terrain.window = {{388800, 3794700, 390200, 3796000}};
  const TerrainModel model = build(c);
  EXPECT_NEAR(model.ground.dx, 25.6, 0.3);  // the shorter side of an arc second at 34.3 degrees
  EXPECT_GT(model.ground.nx, 50u);
  for (std::size_t j = 0; j < model.ground.ny; ++j)
    for (std::size_t i = 0; i < model.ground.nx; ++i)
      ASSERT_NEAR(model.ground.at(i, j),
                  plane(model.origin[0] + model.ground.x0 + double(i) * model.ground.dx,
                        model.origin[1] + model.ground.y0 + double(j) * model.ground.dx),
                  1e-3);
}

TEST(Rasters, TurnedRastersAreWarped) {
  Scratch scratch;
  const auto plane = [](double x, double y) { return 0.3 * x - 0.2 * y + 50; };
  const double c30 = 10 * std::cos(M_PI / 6), s30 = 10 * std::sin(M_PI / 6);
  const std::array<double, 6> geo{1000, c30, s30, 2000, s30, -c30};
  std::vector<std::vector<double>> rows(60, std::vector<double>(60));
  for (int r = 0; r < 60; ++r)
    for (int k = 0; k < 60; ++k)
      rows[r][k] =
          plane(geo[0] + (k + 0.5) * geo[1] + (r + 0.5) * geo[2], geo[3] + (k + 0.5) * geo[4] + (r + 0.5) * geo[5]);
  Case c = raster_case({write_tif(scratch("turned.tif"), geo, "EPSG:32611", rows)});
  c.terrain.window = {{1300, 1750, 1500, 1950}};
  const TerrainModel model = build(c);
  EXPECT_NEAR(model.ground.dx, 10, 1e-9);
  EXPECT_EQ(model.ground.nx, 20u);
  for (std::size_t j = 0; j < model.ground.ny; ++j)
    for (std::size_t i = 0; i < model.ground.nx; ++i)
      ASSERT_NEAR(model.ground.at(i, j), plane(1305 + 10.0 * double(i), 1755 + 10.0 * double(j)), 1e-6);
}

TEST(Splice, FinerOnTopWithABlendedSeam) {
  Scratch scratch;
  // Coarse: 100 m everywhere, 20 m cells. Fine: 110 m, 5 m cells, a quarter of the area, with a void.
  const std::string coarse =
      write_asc(scratch("coarse.asc"), 0, 0, 20, std::vector<std::vector<double>>(20, std::vector<double>(20, 100)));
  std::vector<std::vector<double>> rows(40, std::vector<double>(40, 110));
  rows[20][20] = -9999;
  const std::string fine = write_asc(scratch("fine.asc"), 100, 100, 5, rows);
  Case c = raster_case({coarse, fine}, 5);
  c.terrain.window = {{0, 0, 400, 400}};
  c.terrain.sources[1].blend = 40;
  c.terrain.sources[1].vertical_shift = 0.5;
  const TerrainModel model = build(c);
  ASSERT_DOUBLE_EQ(model.ground.dx, 5);
  const auto z = [&](double x, double y) { return model.ground.height(x - model.origin[0], y - model.origin[1]); };
  EXPECT_EQ(z(52.5, 202.5), 100);             // outside
  EXPECT_NEAR(z(152.5, 152.5), 110.5, 1e-9);  // 40 m and more inside
  EXPECT_NEAR(z(252.5, 147.5), 110.5, 1e-9);
  // Across the western seam the surface climbs without a step: at half the width it is half way up.
  double last = 100;
  for (double x = 92.5; x <= 152.5; x += 5) {
    const double here = z(x, 242.5);
    EXPECT_GE(here, last);
    EXPECT_LE(here - last, 10.5 * 1.5 / 8 + 0.01) << x;  // the steepest of a smooth step over 8 cells
    last = here;
  }
  EXPECT_NEAR(z(120, 242.5), 105.25, 0.4);
  EXPECT_EQ(z(202.5, 197.5), 100);             // the void shows what lies below
  EXPECT_NEAR(z(207.5, 197.5), 100.37, 0.03);  // one cell off: smooth step at 1/9, 0.0343 x 10.5
}

TEST(Splice, DefaultWindowIsTheCommonExtent) {
  Scratch scratch;
  const std::string a =
      write_asc(scratch("a.asc"), 0, 0, 20, std::vector<std::vector<double>>(20, std::vector<double>(20, 100)));
  const std::string b =
      write_asc(scratch("b.asc"), 200, 300, 5, std::vector<std::vector<double>>(60, std::vector<double>(60, 110)));
  const TerrainModel model = build(raster_case({a, b}, 5));
  EXPECT_DOUBLE_EQ(model.origin[0] + model.domain[0], 202.5);
  EXPECT_DOUBLE_EQ(model.origin[0] + model.domain[2], 397.5);
  EXPECT_DOUBLE_EQ(model.origin[1] + model.domain[1], 302.5);
  EXPECT_DOUBLE_EQ(model.origin[1] + model.domain[3], 397.5);
}

TEST(Splice, ASourceWithinTheOthersNarrowsNoDefaultWindow) {
  Scratch scratch;
  const std::string coarse =
      write_asc(scratch("coarse.asc"), 0, 0, 20, std::vector<std::vector<double>>(20, std::vector<double>(20, 100)));
  const std::string site =
      write_asc(scratch("site.asc"), 100, 100, 5, std::vector<std::vector<double>>(40, std::vector<double>(40, 110)));
  const TerrainModel model = build(raster_case({coarse, site}, 5));
  EXPECT_DOUBLE_EQ(model.origin[0] + model.domain[0], 2.5);
  EXPECT_DOUBLE_EQ(model.origin[1] + model.domain[3], 397.5);
}

TEST(Splice, SourceOfFinerThanParticlesIsAveraged) {
  Scratch scratch;
  const TerrainModel model = build(raster_case(
      {write_asc(scratch("a.asc"), 0, 0, 1, rows_of(23, 20, 0, 0, 1, [](double x, double y) { return x + 3 * y; }))},
      5.5));
  EXPECT_DOUBLE_EQ(model.ground.dx, 5);
  EXPECT_EQ(model.ground.nx, 4u);  // 23 cells: three left over
  EXPECT_EQ(model.ground.ny, 4u);
  EXPECT_DOUBLE_EQ(model.ground.at(1, 2), 7.5 + 3 * 12.5);  // a plane's mean is its value in the middle
  EXPECT_DOUBLE_EQ(model.origin[0] + model.ground.x0, 2.5);
}

TEST(Voids, RefusedWithCountAndPlaceOrFilled) {
  Scratch scratch;
  auto rows = rows_of(9, 8, 0, 0, 10, [](double, double) { return 40; });
  rows[2][5] = rows[4][3] = rows[4][4] = -9999;  // the first from the north-west at 55, 55
  Case c = raster_case({write_asc(scratch("a.asc"), 0, 0, 10, rows)});
  const std::string error = error_of(c);
  EXPECT_HAS(error, "the terrain window has 3 void cells (the first at 55, 55)");
  EXPECT_HAS(error, "terrain.voids: fill");
  c.terrain.fill_voids = true;
  const TerrainModel model = build(c);
  EXPECT_EQ(model.voids_filled, 3);
  for (const double z : model.ground.z) EXPECT_DOUBLE_EQ(z, 40);
}

TEST(Voids, MasksFloatNoDataAndScaleAreUnderstood) {
  Scratch scratch;
  const auto rows = rows_of(5, 4, 0, 0, 10, [](double x, double) { return x; });
  const std::string masked = write_tif(scratch("m.tif"), {0, 10, 0, 40, 0, -10}, "EPSG:32611", rows);
  {
    GDALDatasetUniquePtr data(GDALDataset::Open(masked.c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE));
    ASSERT_EQ(CE_None, data->CreateMaskBand(GMF_PER_DATASET));
    uint8_t mask[20];
    std::fill(mask, mask + 20, uint8_t(255));
    mask[5 + 2] = 0;  // the second row from the north, x = 25, y = 25
    ASSERT_EQ(CE_None, data->GetRasterBand(1)->GetMaskBand()->RasterIO(GF_Write, 0, 0, 5, 4, mask, 5, 4, GDT_Byte, 0, 0,
                                                                       nullptr));
  }
  EXPECT_HAS(error_of(raster_case({masked})), "1 void cells (the first at 25, 25)");

  auto least = rows;
  least[1][3] = -3.4028234663852886e38;  // the lowest float, as many tools write it
  const std::string floats = write_tif(scratch("f.tif"), {0, 10, 0, 40, 0, -10}, "EPSG:32611", least, GDT_Float32);
  {
    GDALDatasetUniquePtr data(GDALDataset::Open(floats.c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE));
    data->GetRasterBand(1)->SetNoDataValue(-3.4028234663852886e38);
  }
  EXPECT_HAS(error_of(raster_case({floats})), "1 void cells (the first at 35, 25)");

  const std::string scaled = write_tif(scratch("s.tif"), {0, 10, 0, 40, 0, -10}, "EPSG:32611", rows, GDT_Int16);
  {
    GDALDatasetUniquePtr data(GDALDataset::Open(scaled.c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE));
    data->GetRasterBand(1)->SetScale(0.1);
    data->GetRasterBand(1)->SetOffset(100);
  }
  EXPECT_DOUBLE_EQ(build(raster_case({scaled})).ground.at(3, 0), 103.5);
}

TEST(Voids, FilledValuesLieBetweenTheirSurroundings) {
  Scratch scratch;
  auto rows = rows_of(21, 21, 0, 0, 10, [](double x, double) { return 1000 + x; });
  for (int r = 8; r < 13; ++r)
    for (int k = 8; k < 13; ++k) rows[r][k] = -9999;
  Case c = raster_case({write_asc(scratch("a.asc"), 0, 0, 10, rows)});
  c.terrain.fill_voids = true;
  const TerrainModel model = build(c);
  EXPECT_EQ(model.voids_filled, 25);
  // A slope of 1: the gap spans 1075 to 1135, its middle is at 1105, and the fill climbs with the slope.
  EXPECT_NEAR(model.ground.at(10, 10), 1105, 1e-3);
  for (int i = 8; i < 13; ++i) {
    EXPECT_GT(model.ground.at(i, 10), 1075);
    EXPECT_LT(model.ground.at(i, 10), 1135);
    EXPECT_GT(model.ground.at(i + 1, 10), model.ground.at(i, 10));
  }
  EXPECT_EQ(model.ground.at(7, 10), 1075);  // what was measured stays
}

TEST(Voids, PolygonalBorderOfTirol) {
  Case c = raster_case({tirol}, 5);
  c.terrain.crs = "";
  const std::string error = error_of(c);
  EXPECT_HAS(error, "touches the no-data border of the sources (74209 cells there, 0 voids inside)");
  const std::size_t bracket = error.find('[');
  ASSERT_NE(bracket, std::string::npos);
  c.terrain.window.emplace();
  auto& w = *c.terrain.window;
  ASSERT_EQ(std::sscanf(error.c_str() + bracket, "[%lf, %lf, %lf, %lf]", &w[0], &w[1], &w[2], &w[3]), 4) << error;
  const TerrainModel model = build(c);  // the suggestion holds
  EXPECT_EQ(model.voids_filled, 0);
  EXPECT_DOUBLE_EQ(model.ground.dx, 4.997678230579);
  EXPECT_GT(model.ground.nx * model.ground.ny, 60000u);
  EXPECT_GE(*std::min_element(model.ground.z.begin(), model.ground.z.end()), 1455.16);
  EXPECT_LE(*std::max_element(model.ground.z.begin(), model.ground.z.end()), 2604.47);
  EXPECT_HAS(model.crs_wkt, "MGI / Austria Lambert");
  // Larger by a cell on any side touches the border again: it was the largest.
  for (int side = 0; side < 4; ++side) {
    Case larger = c;
    (*larger.terrain.window)[side] += (side < 2 ? -1 : 1) * 5.0;
    EXPECT_HAS(error_of(larger), "no-data border") << side;
  }
}

TEST(Voids, BorderFilledByChoice) {
  Case c = raster_case({tirol}, 5);
  c.terrain.crs = "";
  c.terrain.fill_voids = true;
  const TerrainModel model = build(c);
  EXPECT_EQ(model.voids_filled, 74209);
  EXPECT_EQ(model.ground.nx, 526u);
  EXPECT_EQ(model.ground.ny, 446u);
  for (const double z : model.ground.z) {
    ASSERT_GE(z, 1455.16);
    ASSERT_LE(z, 2604.47);
  }
  ASSERT_FALSE(model.notes.empty());
  EXPECT_HAS(model.notes.back(), "74209 void cells filled, 74209 of them at the border");
}

TEST(Voids, TirolReprojectedToUtm) {
  // MGI / Austria Lambert to UTM 32N: another datum, another ellipsoid. Elevations along a line in the middle of the
  // area must match those of the original at the same places.
  Case c = raster_case({tirol}, 5);
  c.terrain.crs = "";
  c.terrain.window = {{273500, 358300, 274500, 359000}};
  const TerrainModel original = build(c);
  OGRSpatialReference lambert, utm;
  lambert.importFromEPSG(31287);
  utm.importFromEPSG(32632);
  lambert.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  std::unique_ptr<OGRCoordinateTransformation> forward(OGRCreateCoordinateTransformation(&lambert, &utm));
  double x = 274000, y = 358650;
  ASSERT_TRUE(forward->Transform(1, &x, &y));
  c.terrain.crs = "EPSG:32632";
  c.terrain.window = {{x - 250, y - 250, x + 250, y + 250}};
  const TerrainModel warped = build(c);
  EXPECT_NEAR(warped.ground.dx, 5, 0.01);
  double worst = 0;
  for (double s = -150; s <= 150; s += 10) {
    double u = 274000 + s, v = 358650 + 0.5 * s;
    const double expected = original.ground.height(u - original.origin[0], v - original.origin[1]);
    ASSERT_TRUE(forward->Transform(1, &u, &v));
    worst = std::max(worst, std::abs(warped.ground.height(u - warped.origin[0], v - warped.origin[1]) - expected));
  }
  EXPECT_LT(worst, 0.6);  // m: two bilinear interpolations of a rough 30 degree slope at 5 m
}

TEST(Spikes, ReportedWithWorstPlaceAndRemovedByChoice) {
  Scratch scratch;
  auto rows = rows_of(9, 8, 0, 0, 10, [](double x, double) { return 0.5 * x; });
  rows[3][4] += 80;  // neighbours up to 5 m higher than the slope here: stands out by 75
  rows[6][6] -= 60;  // by 55
  rows[1][1] += 40;  // by 35: no spike at 3 pixels and 60 degrees = 51.96 m
  Case c = raster_case({write_asc(scratch("a.asc"), 0, 0, 10, rows)});
  TerrainModel model = build(c);
  EXPECT_EQ(model.spikes, 2);
  EXPECT_EQ(model.spikes_removed, 0);
  ASSERT_EQ(model.notes.size(), 2u);
  EXPECT_HAS(model.notes[1], "2 spikes of more than 51.96 m, the worst +75 m at 45, 45; kept");
  EXPECT_DOUBLE_EQ(model.ground.at(4, 4), 22.5 + 80);
  c.terrain.remove_spikes = true;
  model = build(c);
  EXPECT_EQ(model.spikes_removed, 2);
  EXPECT_DOUBLE_EQ(model.ground.at(4, 4), 22.5);  // the median of the neighbours
  EXPECT_DOUBLE_EQ(model.ground.at(6, 1), 32.5);
  EXPECT_DOUBLE_EQ(model.ground.at(1, 6), 7.5 + 40);
  c.terrain.spike_threshold = 30;
  EXPECT_EQ(build(c).spikes, 3);
}

TEST(Spikes, AsterWithVoidsAndSpikes) {
  Case c = raster_case({exploradores}, 30);
  c.terrain.crs = "EPSG:32718";
  EXPECT_HAS(error_of(c), "(628 cells there, 462 voids inside)");
  c.terrain.fill_voids = true;
  c.terrain.spike_threshold = 15;
  const TerrainModel model = build(c);
  EXPECT_EQ(model.voids_filled, 1090);
  EXPECT_GT(model.spikes, 0);
  // Count again by brute force on the raster itself.
  GDALDatasetUniquePtr data(GDALDataset::Open(exploradores.c_str()));
  std::vector<double> z(220 * 220);
  ASSERT_EQ(CE_None,
            data->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, 220, 220, z.data(), 220, 220, GDT_Float64, 0, 0, nullptr));
  int spikes = 0, valid_equal = 0;
  for (int r = 0; r < 220; ++r)
    for (int k = 0; k < 220; ++k) {
      if (z[r * 220 + k] == -9999) continue;
      valid_equal += model.ground.at(k, 219 - r) == z[r * 220 + k];
      int known = 0, over = 0, under = 0;
      for (int a = std::max(0, r - 1); a <= std::min(219, r + 1); ++a)
        for (int b = std::max(0, k - 1); b <= std::min(219, k + 1); ++b) {
          if ((a == r && b == k) || z[a * 220 + b] == -9999) continue;
          ++known;
          over += z[r * 220 + k] - z[a * 220 + b] > 15;
          under += z[a * 220 + b] - z[r * 220 + k] > 15;
        }
      spikes += known >= 3 && (over == known || under == known);
    }
  EXPECT_EQ(model.spikes, spikes);
  EXPECT_EQ(valid_equal, 220 * 220 - 1090);  // spikes kept, voids filled, nothing else touched
  c.terrain.remove_spikes = true;
  EXPECT_EQ(build(c).spikes_removed, spikes);
}

TEST(Rasters, ReadsAverageWhenASourceIsFarFinerThanTheParticles) {
  Scratch scratch;
  // A virtual raster of 6400 x 6400 cells, 41 million, drawn from 8 x 8: more than are ever held.
  write_tif(scratch("small.tif"), {0, 800, 0, 6400, 0, -800}, "EPSG:32611",
            rows_of(8, 8, 0, 0, 800, [](double x, double) { return std::floor(x / 1600); }));
  std::ofstream(scratch("huge.vrt")) << R"(<VRTDataset rasterXSize="6400" rasterYSize="6400">
    <SRS>EPSG:32611</SRS><GeoTransform>0, 1, 0, 6400, 0, -1</GeoTransform>
    <VRTRasterBand dataType="Float64" band="1"><SimpleSource>
      <SourceFilename relativeToVRT="1">small.tif</SourceFilename><SourceBand>1</SourceBand>
      <SrcRect xOff="0" yOff="0" xSize="8" ySize="8"/><DstRect xOff="0" yOff="0" xSize="6400" ySize="6400"/>
    </SimpleSource></VRTRasterBand></VRTDataset>)";
  const TerrainModel model = build(raster_case({scratch("huge.vrt")}, 50));
  EXPECT_DOUBLE_EQ(model.ground.dx, 50);
  EXPECT_EQ(model.ground.nx, 128u);
  EXPECT_DOUBLE_EQ(model.ground.height(1000 - model.origin[0], 500), 0);
  EXPECT_DOUBLE_EQ(model.ground.height(5600 - model.origin[0], 500), 3);
  ASSERT_FALSE(model.notes.empty());
  EXPECT_HAS(model.notes[0], "cells of 1 m averaged to 2 m while reading");
  const std::string error = error_of(raster_case({scratch("huge.vrt")}, 1));
  EXPECT_HAS(error, "6400 x 6400 cells of 1 m");
  EXPECT_HAS(error, "cut it with terrain.window or choose a larger particle_spacing");
}

TEST(Spikes, OfAveragedCellsStandOutByAsManyTimesMore) {
  Scratch scratch;
  write_tif(scratch("flat.tif"), {0, 1125, 0, 9000, 0, -1125}, "EPSG:32611",
            rows_of(8, 8, 0, 0, 1125, [](double, double) { return 0; }));
  const auto one_cell = [&](const char* name, double height) {
    write_tif(scratch(name), {0, 2, 0, 2, 0, -2}, "EPSG:32611", {{height}});
  };
  one_cell("low.tif", 8);
  one_cell("high.tif", 12);
  // 81 million cells of 1 m, more than are ever read as they are: averages of 2 x 2. Both blocks stand out more than 3
  // cells at 60 degrees between cells of 1 m, 5.196 m, and one of them between those of 2 m.
  const auto drawn = [](const char* name, int size, int x, int y, int width) {
    const std::string n = std::to_string(size), w = std::to_string(width);
    return std::string("<SimpleSource><SourceFilename relativeToVRT=\"1\">") + name +
           "</SourceFilename><SourceBand>1</SourceBand><SrcRect xOff=\"0\" yOff=\"0\" xSize=\"" + n + "\" ySize=\"" +
           n + "\"/><DstRect xOff=\"" + std::to_string(x) + "\" yOff=\"" + std::to_string(y) + "\" xSize=\"" + w +
           "\" ySize=\"" + w + "\"/></SimpleSource>";
  };
  std::ofstream(scratch("huge.vrt")) << R"(<VRTDataset rasterXSize="9000" rasterYSize="9000">
    <SRS>EPSG:32611</SRS><GeoTransform>0, 1, 0, 9000, 0, -1</GeoTransform>
    <VRTRasterBand dataType="Float64" band="1">)"
                                     << drawn("flat.tif", 8, 0, 0, 9000) << drawn("low.tif", 1, 2000, 1000, 2)
                                     << drawn("high.tif", 1, 4000, 3000, 2) << "</VRTRasterBand></VRTDataset>";
  const TerrainModel model = build(raster_case({scratch("huge.vrt")}, 50));
  EXPECT_EQ(model.spikes, 1);
  ASSERT_EQ(model.notes.size(), 2u);
  EXPECT_HAS(model.notes[1], "1 spike of more than 10.39 m, the worst +12 m at 4001, 5999; kept");
}

TEST(Rasters, InputsAreHashedOnce) {
  Scratch scratch;
  const std::string file =
      write_asc(scratch("a.asc"), 0, 0, 10, rows_of(4, 4, 0, 0, 10, [](double x, double) { return x; }));
  OGRSpatialReference utm;
  utm.importFromEPSG(32611);
  char* wkt = nullptr;
  utm.morphToESRI();
  utm.exportToWkt(&wkt);
  std::ofstream(scratch("a.prj")) << wkt;
  CPLFree(wkt);
  Provenance provenance;
  Case c = raster_case({file});
  c.terrain.crs = "";
  build_terrain(c, provenance);
  ASSERT_EQ(provenance.inputs.size(), 2u);
  EXPECT_EQ(provenance.inputs[0].first, file);
  EXPECT_EQ(provenance.inputs[1].first, scratch("a.prj"));
  EXPECT_EQ(provenance.inputs[0].second.size(), 64u);
}

}  // namespace
}  // namespace lgiw
