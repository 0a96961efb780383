// Malformed terrain: each gives one line that says what, why and what to do.
#include <cmath>
#include <filesystem>
#include <limits>

#include "hand_rasters.hh"

namespace lgiw {
namespace {

using namespace test;

struct RasterErrors : testing::Test {
  Scratch scratch;
  std::vector<std::vector<double>> rows = rows_of(6, 5, 0, 0, 10, [](double x, double y) { return x + y; });
  Case good() { return raster_case({write_asc(scratch("good.asc"), 1000, 2000, 10, rows)}); }
};

TEST_F(RasterErrors, MissingFile) {
  const std::string error = error_of(raster_case({scratch("no.tif")}));
  EXPECT_HAS(error, "no.tif': cannot be read as a raster (GDAL: ");
  EXPECT_HAS(error, "No such file");
}

TEST_F(RasterErrors, NoRaster) {
  std::ofstream(scratch("text.tif")) << "this is no raster\n";
  EXPECT_HAS(error_of(raster_case({scratch("text.tif")})), "cannot be read as a raster");
}

TEST_F(RasterErrors, TruncatedTiff) {
  const auto many = rows_of(200, 200, 0, 0, 10, [](double x, double y) { return x + y; });
  const std::string file = write_tif(scratch("cut.tif"), {0, 10, 0, 2000, 0, -10}, "EPSG:32611", many);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  const std::string error = error_of(raster_case({file}));
  EXPECT_HAS(error, "cut.tif'");
  EXPECT_HAS(error, "cannot be read");
}

TEST_F(RasterErrors, TruncatedAscii) {
  const std::string file =
      write_asc(scratch("cut.asc"), 0, 0, 10, rows_of(50, 50, 0, 0, 10, [](double x, double y) { return x + y; }));
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_HAS(error_of(raster_case({file})), "cannot be read to its end");
}

TEST_F(RasterErrors, NoCrsAnywhere) {
  Case c = good();
  c.terrain.crs = "";
  EXPECT_HAS(error_of(c),
             "good.asc': names no CRS (its coordinates could be in metres of any zone or in degrees) set terrain.crs");
}

TEST_F(RasterErrors, NoCrsAndDegrees) {
  EXPECT_HAS(error_of(raster_case({write_asc(scratch("d.asc"), -118.2, 34.2, 1.0 / 3600, rows)})),
             "has no CRS and its coordinates look like degrees");
}

TEST_F(RasterErrors, DegreesAsTheCaseCrs) {
  Case c = raster_case({write_tif(scratch("d.tif"), {-118.2, 0.001, 0, 34.2, 0, -0.001}, "EPSG:4326", rows)});
  c.terrain.crs = "";
  std::string error = error_of(c);
  EXPECT_HAS(error, "its CRS is in degrees");
  EXPECT_HAS(error, "e.g. EPSG:32611");  // the zone it lies in
  c.terrain.crs = "EPSG:4326";
  EXPECT_HAS(error_of(c), "terrain.crs 'EPSG:4326' is in degrees");
}

TEST_F(RasterErrors, FeetMercatorAndNonsenseAsTheCaseCrs) {
  Case c = good();
  c.terrain.crs = "EPSG:2229";  // California zone 5 in US survey feet
  EXPECT_HAS(error_of(c), "terrain.crs 'EPSG:2229' measures in US survey foot");
  c.terrain.crs = "EPSG:3857";
  EXPECT_HAS(error_of(c), "is a Mercator map (its metres grow with latitude");
  c.terrain.crs = "EPSG:99999999";
  EXPECT_HAS(error_of(c), "terrain.crs 'EPSG:99999999' is not a CRS");
}

TEST_F(RasterErrors, ElevationsInFeet) {
  const std::string file = write_tif(scratch("ft.tif"), {0, 10, 0, 50, 0, -10}, "EPSG:32611", rows);
  {
    GDALDatasetUniquePtr data(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE));
    data->GetRasterBand(1)->SetUnitType("ft");
  }
  EXPECT_HAS(error_of(raster_case({file})), "has elevations in 'ft'");
  for (const std::string unit : {"Feet", "US Survey Feet", "cm"}) {
    std::ofstream(scratch("unit.vrt")) << "<VRTDataset rasterXSize=\"6\" rasterYSize=\"5\"><SRS>EPSG:32611</SRS>"
                                          "<GeoTransform>0,10,0,50,0,-10</GeoTransform>"
                                          "<VRTRasterBand dataType=\"Float64\" band=\"1\"><UnitType>"
                                       << unit
                                       << "</UnitType><SimpleSource><SourceFilename relativeToVRT=\"1\">ft.tif"
                                          "</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>";
    EXPECT_HAS(error_of(raster_case({scratch("unit.vrt")})), "has elevations in '" + unit + "'");
  }
}

TEST_F(RasterErrors, VerticalCrsInFeet) {
  // NAVD88 height in US survey feet on top of UTM: a GeoTIFF tells the unit with the band, a VRT only with its CRS.
  const std::string file = write_tif(scratch("ft.tif"), {0, 10, 0, 50, 0, -10}, "EPSG:32611+6360", rows);
  EXPECT_HAS(error_of(raster_case({file})), "has elevations in 'US survey foot'");
  std::ofstream(scratch("ft.vrt")) << R"(<VRTDataset rasterXSize="6" rasterYSize="5"><SRS>EPSG:32611+6360</SRS>
    <GeoTransform>0, 10, 0, 50, 0, -10</GeoTransform><VRTRasterBand dataType="Float64" band="1"><SimpleSource>
    <SourceFilename relativeToVRT="1">ft.tif</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>)";
  EXPECT_HAS(error_of(raster_case({scratch("ft.vrt")})), "its vertical CRS is not in metres (its unit is 0.304800");
}

TEST_F(RasterErrors, PlaceInTheCaseFileComesFirst) {
  const std::string yaml = "name: dry\nparticle_spacing: 0.5\nterrain:\n  crs: EPSG:32611\n  sources:\n    - file: " +
                           write_asc(scratch("dry.asc"), 1000, 2000, 10, rows) +
                           "\nwater:\n  level: 40\n  seed: [1055, 2045]\n";
  const Case c = parse_case(yaml, "dry.yaml");
  EXPECT_EQ(error_of(c).rfind("dry.yaml:9: water.seed 1055, 2045 is on dry land (the ground there is at 100 m", 0), 0u)
      << error_of(c);
}

TEST_F(RasterErrors, OnlyNan) {
  for (auto& row : rows)
    for (double& z : row) z = std::numeric_limits<double>::quiet_NaN();
  EXPECT_HAS(error_of(raster_case({write_tif(scratch("nan.tif"), {0, 10, 0, 50, 0, -10}, "EPSG:32611", rows)})),
             "the terrain window holds no elevations at all (all of its 30 cells are no-data or NaN)");
}

TEST_F(RasterErrors, HolesInABandOfAlpha) {
  const std::string file = scratch("alpha.tif");
  GDALAllRegister();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  {
    const GDALDatasetUniquePtr data(driver->Create(file.c_str(), 6, 5, 2, GDT_Float32, nullptr));
    double place[] = {0, 10, 0, 50, 0, -10};
    data->SetGeoTransform(place);
    OGRSpatialReference crs;
    crs.importFromEPSG(32611);
    data->SetSpatialRef(&crs);
    std::vector<float> z(30, 100), alpha(30, 1);
    z[14] = alpha[14] = 0;
    ASSERT_EQ(data->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, 6, 5, z.data(), 6, 5, GDT_Float32, 0, 0), CE_None);
    ASSERT_EQ(data->GetRasterBand(2)->RasterIO(GF_Write, 0, 0, 6, 5, alpha.data(), 6, 5, GDT_Float32, 0, 0), CE_None);
    data->GetRasterBand(2)->SetColorInterpretation(GCI_AlphaBand);
  }
  EXPECT_HAS(error_of(raster_case({file})), "void");
}

TEST_F(RasterErrors, UndeclaredNoData) {
  rows[1][2] = -32768;
  const std::string error =
      error_of(raster_case({write_tif(scratch("u.tif"), {0, 10, 0, 50, 0, -10}, "EPSG:32611", rows)}));
  EXPECT_HAS(error, "has -32768 m at 25, 35");
  EXPECT_HAS(error, "gdal_edit.py -a_nodata -32768");
}

TEST_F(RasterErrors, UndeclaredNoDataThatCouldBeASeaFloor) {
  rows[1][2] = -9999;
  const std::string file = write_tif(scratch("u.tif"), {0, 10, 0, 50, 0, -10}, "EPSG:32611", rows);
  EXPECT_HAS(error_of(raster_case({file})),
             "has -9999 m at 25, 35 (most rasters mean no-data by it, and this one does not declare it) declare it");
  rows[1][2] = -9998;
  EXPECT_NO_THROW(build(raster_case({write_tif(scratch("deep.tif"), {0, 10, 0, 50, 0, -10}, "EPSG:32611", rows)})));
}

TEST_F(RasterErrors, HugeDimensions) {
  std::ofstream(scratch("huge.vrt")) << R"(<VRTDataset rasterXSize="2000000000" rasterYSize="2000000000">
    <SRS>EPSG:32611</SRS><GeoTransform>0, 1e-3, 0, 2e6, 0, -1e-3</GeoTransform>
    <VRTRasterBand dataType="Float32" band="1"/></VRTDataset>)";
  EXPECT_HAS(error_of(raster_case({scratch("huge.vrt")}, 0.01)), "cells of 0.0");
}

TEST_F(RasterErrors, WindowOutsideWithBothExtents) {
  Case c = good();
  c.terrain.window = {{900, 2000, 1050, 2040}};
  EXPECT_HAS(
      error_of(c),
      "terrain.window reaches outside the terrain sources (it is x 900 to 1050, y 2000 to 2040; they cover x 1000 to "
      "1060, y 2000 to 2050)");
  c.terrain.window = {{1010, 2010, 1012, 2040}};
  EXPECT_HAS(error_of(c), "fewer than 3 x 3 nodes");
}

TEST_F(RasterErrors, SourcesApart) {
  Case c = raster_case({write_asc(scratch("a.asc"), 0, 0, 10, rows), write_asc(scratch("b.asc"), 500, 0, 10, rows)});
  EXPECT_HAS(error_of(c), "the terrain sources have no common extent");
}

TEST_F(RasterErrors, Picture) {
  GDALAllRegister();
  const std::string file = scratch("rgb.tif");
  {
    GDALDatasetUniquePtr data(
        GetGDALDriverManager()->GetDriverByName("GTiff")->Create(file.c_str(), 6, 5, 3, GDT_Byte, nullptr));
    double geo[6] = {0, 10, 0, 50, 0, -10};
    data->SetGeoTransform(geo);
  }
  EXPECT_HAS(error_of(raster_case({file})), "is a picture");
}

TEST_F(RasterErrors, NoGeoreference) {
  GDALAllRegister();
  const std::string file = scratch("plain.tif");
  GDALDatasetUniquePtr(
      GetGDALDriverManager()->GetDriverByName("GTiff")->Create(file.c_str(), 6, 5, 1, GDT_Float32, nullptr));
  EXPECT_HAS(error_of(raster_case({file})), "has no georeference");
}

/// In degrees such a place hung the search for its UTM zone.
TEST_F(RasterErrors, BeyondAnyMap) {
  for (const char* crs : {"EPSG:4326", "EPSG:32611"}) {
    const std::string file = write_tif(scratch("far.tif"), {1e25, 1e22, 0, 50, 0, -10}, crs, rows);
    EXPECT_HAS(error_of(raster_case({file})), "far.tif': one of its corners lies at 1e+25, 50 (");
    std::filesystem::remove(file);
  }
}

TEST_F(RasterErrors, FarMoreNodesThanTheSourcesHaveCells) {
  const auto flat = [](double, double) { return 1.0; };
  const std::string coarse = write_asc(scratch("coarse.asc"), 0, 0, 1000, rows_of(3, 3, 0, 0, 1000, flat));
  Case c = raster_case({coarse, write_asc(scratch("fine.asc"), 500, 500, 0.5, rows_of(20, 20, 0, 0, 0.5, flat))}, 0.5);
  const std::string error = error_of(c);
  EXPECT_HAS(error, "the terrain would have 6000 x 6000 nodes of 0.5 m (terrain source '");
  EXPECT_HAS(error, "fine.asc' is so fine; its sources have 409 cells in all) cut it with terrain.window");
  c.terrain.window = {{480, 480, 530, 530}};
  EXPECT_EQ(build(c).ground.z.size(), 100u * 100);
}

TEST_F(RasterErrors, TwoDimensionalCase) {
  Case c = good();
  c.dimension = 2;
  EXPECT_HAS(error_of(c), "terrain.sources in a 2-D case");
}

}  // namespace
}  // namespace lgiw
