// Slide bodies against volumes that one can work out by hand.
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>

#include "hand_rasters.hh"
#include "terrain/geo_output.hh"

namespace lgiw {
namespace {

using namespace test;

const std::string helens = LGIW_TEST_DATA "/terrain/st_helens/pre_event_dem_10m.asc";
const std::string depths = LGIW_TEST_DATA "/terrain/st_helens/source_depth_10m.asc";

Case helens_case() {
  Case c = raster_case({helens}, 2);
  c.terrain.crs = "EPSG:32149";
  c.terrain.window = {{361015.6, 70223.5, 361805, 71443.4}};  // the last column is no-data
  c.slide.present = true;
  return c;
}

TEST(StHelens, ThicknessRasterHasTheSurveyedVolume) {
  Case c = helens_case();
  c.slide.surface.thickness = depths;
  const TerrainModel model = build(c);
  EXPECT_EQ(std::llround(model.slide_volume), 22481);
  EXPECT_EQ(std::count(model.slide.begin(), model.slide.end(), 1), 30);  // 3000 m2
  double top = -1e9, low = 1e9, row = 0, column = 0, deepest = 0;
  for (std::size_t k = 0; k < model.slide.size(); ++k) {
    if (!model.slide[k]) {
      ASSERT_EQ(model.bed.z[k], model.ground.z[k]);
      continue;
    }
    top = std::max(top, model.ground.z[k]), low = std::min(low, model.ground.z[k]);
    deepest = std::max(deepest, model.ground.z[k] - model.bed.z[k]);
    row += double(121 - k / model.ground.nx) / 30, column += double(k % model.ground.nx) / 30;
  }
  EXPECT_NEAR(top, 438, 0.5);
  EXPECT_NEAR(low, 403, 0.5);
  EXPECT_NEAR(deepest, 15.7, 0.05);
  EXPECT_NEAR(row, 36.9, 0.05);
  EXPECT_NEAR(column, 24.1, 0.05);
}

TEST(StHelens, BeforeAndAfterGiveTheSame) {
  Scratch scratch;
  // after = before + depth, as the README has it.
  GDALAllRegister();
  std::vector<std::vector<double>> rows(122, std::vector<double>(80));
  GDALDatasetUniquePtr dem(GDALDataset::Open(helens.c_str())), depth(GDALDataset::Open(depths.c_str()));
  for (int r = 0; r < 122; ++r) {
    std::vector<double> change(80);
    ASSERT_EQ(CE_None,
              dem->GetRasterBand(1)->RasterIO(GF_Read, 0, r, 80, 1, rows[r].data(), 80, 1, GDT_Float64, 0, 0, nullptr));
    ASSERT_EQ(CE_None, depth->GetRasterBand(1)->RasterIO(GF_Read, 0, r, 80, 1, change.data(), 80, 1, GDT_Float64, 0, 0,
                                                         nullptr));
    for (int k = 0; k < 80; ++k)
      if (change[k] != -9999) rows[r][k] += change[k];
    for (double& z : rows[r])
      if (z == -9999) z = NAN;  // no-data, which the copy does not declare
  }
  double geo[6];
  dem->GetGeoTransform(geo);
  const std::string after =
      write_tif(scratch("after.tif"), {geo[0], geo[1], geo[2], geo[3], geo[4], geo[5]}, "EPSG:32149", rows);
  Case c = helens_case();
  c.slide.surface.before = helens;
  c.slide.surface.after = after;
  const TerrainModel model = build(c);
  EXPECT_EQ(std::llround(model.slide_volume), 22481);
  c.slide.surface.before = c.slide.surface.after = "";
  // The later ground as a failure surface, inside an outline around the source.
  c.slide.surface.failure_surface = after;
  c.slide.polygon = {{361200, 71000}, {361320, 71000}, {361320, 71150}, {361200, 71150}};
  EXPECT_EQ(std::llround(build(c).slide_volume), 22481);
}

TEST(StHelens, NoDataColumnIsRefusedWithoutAWindow) {
  Case c = helens_case();
  c.terrain.window.reset();
  EXPECT_HAS(error_of(c), "touches the no-data border of the sources (122 cells there, 0 voids inside)");
}

TEST(StHelens, VolumeIsKeptOnCoarserNodes) {
  Case c = helens_case();
  c.dp = 20;
  c.slide.min_thickness = 1;
  c.slide.surface.thickness = depths;
  const TerrainModel model = build(c);
  EXPECT_DOUBLE_EQ(model.ground.dx, 20);
  EXPECT_EQ(std::llround(model.slide_volume), 22481);
  double volume = 0;
  for (std::size_t k = 0; k < model.bed.z.size(); ++k) volume += (model.ground.z[k] - model.bed.z[k]) * 400;
  EXPECT_NEAR(volume, model.slide_volume, 1e-6 * volume);
}

struct Slides : testing::Test {
  Scratch scratch;
  // A plane that falls eastward by 0.5: z = 100 - x / 2, 10 m cells, 400 x 300 m.
  const std::string file = write_asc(scratch("plane.asc"), 0, 0, 10,
                                     rows_of(40, 30, 0, 0, 10, [](double x, double) { return 100 - 0.5 * x + 200; }));
  Case c = raster_case({file});
  void SetUp() override {
    c.slide.present = true;
    c.slide.polygon = {{100, 100}, {180, 100}, {180, 160}, {100, 160}};  // 8 x 6 cells, edges on cell edges
  }
};

TEST_F(Slides, VerticalDepth) {
  c.slide.surface.depth = 7;
  const TerrainModel model = build(c);
  EXPECT_DOUBLE_EQ(model.slide_volume, 80 * 60 * 7);
  EXPECT_EQ(std::count(model.slide.begin(), model.slide.end(), 1), 48);
  EXPECT_DOUBLE_EQ(model.bed.at(10, 10), 300 - 0.5 * 105 - 7);
  EXPECT_DOUBLE_EQ(model.bed.at(9, 10), model.ground.at(9, 10));
}

TEST_F(Slides, BaseElevation) {
  // Soil above 220 m: from x = 105 (ground 247.5) to 155 (222.5); 165 and 175 lie below.
  c.slide.surface.base_elevation = 220;
  const TerrainModel model = build(c);
  EXPECT_DOUBLE_EQ(model.slide_volume, (27.5 + 22.5 + 17.5 + 12.5 + 7.5 + 2.5) * 6 * 100);
  EXPECT_EQ(std::count(model.slide.begin(), model.slide.end(), 1), 36);
  EXPECT_DOUBLE_EQ(model.bed.at(12, 12), 220);
}

TEST_F(Slides, InclinedPlane) {
  // Through (140, 130, 220), parallel to the ground but 10 m below (ground at x = 140: 230): dips 26.565 degrees to the
  // east.
  c.slide.surface.plane = SlideSurface::Plane{140, 130, 220, std::atan(0.5) * 180 / M_PI, 90};
  EXPECT_NEAR(build(c).slide_volume, 80 * 60 * 10, 1e-6);
  // Dipping north at 45 degrees through the same point: thickness 10 - (x - 140) / 2 + (y - 130); symmetric rows of
  // y - 130 = -25 ... 25 and columns of (x - 140) / 2 = -17.5 ... 17.5, what is below zero counts nothing.
  c.slide.surface.plane = SlideSurface::Plane{140, 130, 220, 45, 0};
  double expected = 0;
  for (double y = -25; y <= 25; y += 10)
    for (double x = -35; x <= 35; x += 10) {
      const double thickness = 10 - x / 2 + y;
      if (thickness >= 0.5) expected += thickness * 100;  // min_thickness: half of dp = 1
    }
  EXPECT_NEAR(build(c).slide_volume, expected, 1e-6);
}

TEST_F(Slides, FailureSurfaceRasterOnAnotherGrid) {
  // z = 210 + 0.1 (x - 100) drawn in 25 m cells: bilinear on a plane is exact.
  const std::string surface =
      write_asc(scratch("surface.asc"), 0, 0, 25,
                rows_of(16, 12, 0, 0, 25, [](double x, double) { return 210 + 0.1 * (x - 100); }));
  c.slide.surface.failure_surface = surface;
  double expected = 0;
  for (double x = 105; x < 180; x += 10) expected += std::max(0.0, 300 - 0.5 * x - 210 - 0.1 * (x - 100)) * 600;
  EXPECT_NEAR(build(c).slide_volume, expected, 1e-6 * expected);
}

TEST_F(Slides, ThicknessWithPolygonAndThinCells) {
  auto rows = rows_of(40, 30, 0, 0, 10, [](double, double) { return 0; });
  rows[16][12] = -3;    // inside the polygon (row 16 from the north: y = 135), a depth change
  rows[16][13] = 2;     // a thickness
  rows[16][14] = 0.25;  // thinner than half of dp
  rows[2][2] = 9;       // outside the polygon
  c.slide.surface.thickness = write_asc(scratch("t.asc"), 0, 0, 10, rows);
  const TerrainModel model = build(c);
  EXPECT_DOUBLE_EQ(model.slide_volume, 500);
  EXPECT_HAS(model.notes.back(), "slide: 1 cells thinner than 0.5 m left out (25 m3)");
}

TEST_F(Slides, ThicknessOfNoDataThatIsNotDeclared) {
  auto rows = rows_of(40, 30, 0, 0, 10, [](double, double) { return 3; });
  rows[16][12] = -8888;
  c.slide.surface.thickness = write_asc(scratch("t.asc"), 0, 0, 10, rows);
  EXPECT_HAS(error_of(c), "slide.thickness has -8888 m (no slide is thicker than 2000 m; this looks like no-data");
}

TEST_F(Slides, PolygonFileInDegreesWithAHole) {
  // The outline of SetUp with a hole of 2 x 2 cells, in longitude and latitude.
  GDALAllRegister();  // this test writes with GDAL before the library has done so
  OGRSpatialReference utm, degrees;
  utm.importFromEPSG(32611);
  degrees.importFromEPSG(4326);
  degrees.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::string shifted = write_asc(scratch("far.asc"), 390000, 3795000, 10,
                                        rows_of(40, 30, 0, 0, 10, [](double x, double) { return 300 - 0.5 * x; }));
  c = raster_case({shifted});
  c.slide.present = true;
  c.slide.surface.depth = 2;
  c.slide.polygon_file = scratch("outline.geojson");
  OGRPolygon polygon;
  for (const auto& ring : {std::vector<Point2>{{100, 100}, {180, 100}, {180, 160}, {100, 160}, {100, 100}},
                           std::vector<Point2>{{120, 120}, {120, 140}, {140, 140}, {140, 120}, {120, 120}}}) {
    OGRLinearRing line;
    for (const auto& [x, y] : ring) line.addPoint(390000 + x, 3795000 + y);
    polygon.addRing(&line);
  }
  polygon.assignSpatialReference(&utm);
  ASSERT_EQ(polygon.transformTo(&degrees), OGRERR_NONE);
  {
    GDALDatasetUniquePtr data(GetGDALDriverManager()->GetDriverByName("GeoJSON")->Create(
        c.slide.polygon_file.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    const char* options[] = {"COORDINATE_PRECISION=12", nullptr};
    OGRLayer* layer = data->CreateLayer("outline", &degrees, wkbPolygon, const_cast<char**>(options));
    OGRFeature feature(layer->GetLayerDefn());
    feature.SetGeometry(&polygon);
    ASSERT_EQ(layer->CreateFeature(&feature), OGRERR_NONE);
  }
  EXPECT_DOUBLE_EQ(build(c).slide_volume, (48 - 4) * 100 * 2);
}

TEST_F(Slides, ReprojectedThicknessKeepsItsVolume) {
  // A dome of cosine shape in UTM 12N, read into a case in UTM 11N at the edge of both zones.
  OGRSpatialReference utm11, utm12;
  utm11.importFromEPSG(32611);
  utm12.importFromEPSG(32612);
  std::unique_ptr<OGRCoordinateTransformation> forward(OGRCreateCoordinateTransformation(&utm11, &utm12));
  double x = 776000, y = 3796000;  // near 114 W
  c = raster_case({write_asc(scratch("edge.asc"), x - 500, y - 500, 5,
                             std::vector<std::vector<double>>(200, std::vector<double>(200, 300)))});
  ASSERT_TRUE(forward->Transform(1, &x, &y));
  const double radius = 200;
  const auto rows = rows_of(120, 120, x - 300, y - 300, 5, [&](double u, double v) {
    const double r = std::hypot(u - x, v - y);
    return r < radius ? 20 * std::pow(std::cos(0.5 * M_PI * r / radius), 2) : 0;
  });
  c.slide.present = true;
  c.slide.min_thickness = 1e-6;
  c.slide.surface.thickness = write_tif(scratch("dome.tif"), {x - 300, 5, 0, y + 300, 0, -5}, "EPSG:32612", rows);
  double volume = 0;
  for (const auto& row : rows)
    for (const double t : row) volume += 25 * t;
  // Both zones stretch lengths by about 1.0005 here, areas by 1.001 each: equal to a part in a thousand.
  EXPECT_NEAR(build(c).slide_volume, volume, 2e-3 * volume);
}

TEST_F(Slides, OutsideTheDomain) {
  c.slide.surface.depth = 7;
  c.slide.polygon = {{1000, 100}, {1100, 100}, {1100, 160}};
  EXPECT_HAS(error_of(c),
             "the slide's polygon lies outside the domain (it covers x 1000 to 1100, y 100 to 160; the domain "
             "x 5 to 395, y 5 to 295)");
  c.slide.polygon = {{300, 100}, {500, 100}, {500, 160}, {300, 160}};
  EXPECT_HAS(error_of(c), "reaches across the edge of the domain");
}

TEST_F(Slides, EmptyOnes) {
  c.slide.surface.base_elevation = 260;
  EXPECT_HAS(error_of(c),
             "the slide is empty: the failure surface lies above the ground everywhere (slide.base_elevation comes "
             "no nearer than -12.5 m below the ground)");
  c.slide.surface.base_elevation.reset();
  c.slide.surface.depth = 0.3;
  EXPECT_HAS(error_of(c), "too thin to be filled with particles (at most 0.3 m, and slide.min_thickness is 0.5 m)");
  c.slide.surface.depth.reset();
  c.slide.surface.thickness =
      write_asc(scratch("zero.asc"), 0, 0, 10, rows_of(40, 30, 0, 0, 10, [](double, double) { return 0; }));
  EXPECT_HAS(error_of(c), "the slide is empty");
  c.slide.surface.thickness = "";
  EXPECT_HAS(error_of(c), "the slide has no failure surface");
}

TEST_F(Slides, BadOutlines) {
  c.slide.surface.depth = 7;
  c.slide.polygon = {{100, 100}, {180, 160}, {180, 100}, {100, 160}};
  EXPECT_HAS(error_of(c), "slide.polygon crosses itself");
  c.slide.polygon = {{100, 100}, {180, 160}};
  EXPECT_HAS(error_of(c), "slide.polygon has no area");
  c.slide.polygon = {{101, 101}, {103, 101}, {103, 103}};
  EXPECT_HAS(error_of(c), "contains no terrain node (the nodes are 10 m apart)");
  c.slide.polygon.clear();
  EXPECT_HAS(error_of(c), "the slide has no outline");
  c.slide.polygon_file = scratch("no.gpkg");
  EXPECT_HAS(error_of(c), "no.gpkg': cannot be read as vectors");
  std::ofstream(scratch("points.geojson")) << R"({"type": "Point", "coordinates": [0, 0]})";
  c.slide.polygon_file = scratch("points.geojson");
  EXPECT_HAS(error_of(c), "holds no polygon");
}

TEST_F(Slides, RastersThatDoNotFit) {
  c.slide.polygon.clear();
  c.slide.surface.thickness =
      write_asc(scratch("far.asc"), 5000, 0, 10, rows_of(4, 3, 0, 0, 10, [](double, double) { return 3; }));
  EXPECT_HAS(error_of(c), "lies outside the domain (it covers x 5000 to 5040");
  c.slide.surface.thickness =
      write_asc(scratch("edge.asc"), 0, 0, 10, rows_of(40, 30, 0, 0, 10, [](double, double) { return 3; }));
  EXPECT_HAS(error_of(c), "the slide reaches the edge of the domain");
  c.slide.surface.thickness = scratch("no.tif");
  EXPECT_HAS(error_of(c), "slide.thickness '" + scratch("no.tif") + "': cannot be read as a raster");
}

}  // namespace
}  // namespace lgiw
