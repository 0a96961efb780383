// GeoTIFF and GeoPackage, read back with GDAL.
#include <ogrsf_frmts.h>

#include <cmath>
#include <limits>

#include "files/height_field.hh"
#include "hand_rasters.hh"
#include "terrain/gdal_support.hh"
#include "terrain/geo_output.hh"

namespace lgiw {
namespace {

using namespace test;

GeoReference utm() {
  OGRSpatialReference crs;
  crs.importFromEPSG(32611);
  return {{388000, 3793000, 0}, detail::wkt_of(crs), "Office <A> & B, CC BY 4.0"};
}

std::string bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(GeoTiff, ReadsBackWithCrsUnitAndNoData) {
  Scratch scratch;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  HeightField grid;  // any grid will do
  grid.nx = 3, grid.ny = 2, grid.x0 = 10, grid.y0 = 20, grid.dx = 5;
  const std::vector<float> values{1, 2, 3, 4, nan, 6};
  write_geotiff(scratch("a.tif"), grid, values, utm(), "m", "largest water depth", false);
  GDALDatasetUniquePtr data(GDALDataset::Open(scratch("a.tif").c_str()));
  ASSERT_TRUE(data);
  double geo[6];
  data->GetGeoTransform(geo);
  EXPECT_DOUBLE_EQ(geo[0], 388007.5);   // the western edge of the first cell
  EXPECT_DOUBLE_EQ(geo[3], 3793027.5);  // the northern edge of the last row
  EXPECT_DOUBLE_EQ(geo[1], 5);
  EXPECT_DOUBLE_EQ(geo[5], -5);
  GDALRasterBand* band = data->GetRasterBand(1);
  EXPECT_EQ(band->GetRasterDataType(), GDT_Float32);
  EXPECT_EQ(std::string(band->GetUnitType()), "m");
  EXPECT_EQ(std::string(band->GetDescription()), "largest water depth");
  EXPECT_TRUE(std::isnan(band->GetNoDataValue()));
  float back[6];
  ASSERT_EQ(CE_None, band->RasterIO(GF_Read, 0, 0, 3, 2, back, 3, 2, GDT_Float32, 0, 0, nullptr));
  EXPECT_EQ(back[0], 4);  // the northern row comes first
  EXPECT_TRUE(std::isnan(back[1]));
  EXPECT_EQ(back[3], 1);
  EXPECT_EQ(std::string(data->GetSpatialRef()->GetAuthorityCode(nullptr)), "32611");
  EXPECT_EQ(std::string(data->GetMetadataItem("LAYOUT", "IMAGE_STRUCTURE")), "COG");
  EXPECT_EQ(std::string(data->GetMetadataItem("TIFFTAG_COPYRIGHT")), "Office <A> & B, CC BY 4.0");
}

TEST(GeoTiff, RerunsAreByteIdenticalAndNothingIsOverwritten) {
  Scratch scratch;
  const RasterGrid grid(40, 30, 0, 0, 2);
  std::vector<float> values(grid.size());
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = float(k) * 0.1f;
  write_geotiff(scratch("a.tif"), grid, values, utm(), "m", "depth", false);
  write_geotiff(scratch("b.tif"), grid, values, utm(), "m", "depth", false);
  EXPECT_EQ(bytes(scratch("a.tif")), bytes(scratch("b.tif")));
  EXPECT_HAS(error_of([&] { write_geotiff(scratch("a.tif"), grid, values, utm(), "m", "x", false); }), "a.tif");
  EXPECT_EQ(bytes(scratch("a.tif")), bytes(scratch("b.tif")));
  values[0] = 7;
  write_geotiff(scratch("a.tif"), grid, values, utm(), "m", "depth", true);
  EXPECT_NE(bytes(scratch("a.tif")), bytes(scratch("b.tif")));
  EXPECT_THROW(write_geotiff(scratch("no/folder.tif"), grid, values, utm(), "m", "x", false), InputError);
}

TEST(GeoTiff, ScenesWithoutACrs) {
  Scratch scratch;
  write_geotiff(scratch("a.tif"), RasterGrid(4, 1, 0, 0, 0.1), {1, 2, 3, 4}, {}, "m", "2-D", false);
  GDALDatasetUniquePtr data(GDALDataset::Open(scratch("a.tif").c_str()));
  ASSERT_TRUE(data);
  EXPECT_EQ(data->GetRasterYSize(), 1);
  EXPECT_EQ(data->GetSpatialRef(), nullptr);
  EXPECT_EQ(data->GetMetadataItem("TIFFTAG_COPYRIGHT"), nullptr);
}

void write_package(const std::string& path, bool overwrite = false) {
  GeoPackage package(path, utm(), overwrite);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  package.add_points("gauges",
                     {{{{10, 20, 30}}, {{"name", std::string("G1")}, {"max_height_m", 2.5}, {"rank", int64_t(1)}}},
                      {{{11, 21, 31}}, {{"name", std::string("G2")}, {"max_height_m", nan}, {"rank", int64_t(2)}}}});
  package.add_lines("runup", {{{{0, 0, 740}, {10, 0, 745}, {20, 5, 742}}, {{"length_m", 21.2}}}});
  // Two pieces of class 1 (they meet at a corner only), one of class 2 with a hole.
  const std::vector<uint8_t> classes{1, 0, 2, 2, 2,  //
                                     0, 1, 2, 0, 2,  //
                                     0, 0, 2, 2, 2};
  package.add_polygons("inundation", RasterGrid(5, 3, 0, 0, 10), classes, {"below 1 m", "1 to 3 m"});
  package.commit();
}

TEST(GeoPackages, ReadBack) {
  Scratch scratch;
  write_package(scratch("a.gpkg"));
  GDALDatasetUniquePtr data(GDALDataset::Open(scratch("a.gpkg").c_str(), GDAL_OF_VECTOR));
  ASSERT_TRUE(data);
  ASSERT_EQ(data->GetLayerCount(), 3);
  EXPECT_EQ(std::string(data->GetMetadataItem("ATTRIBUTION")), "Office <A> & B, CC BY 4.0");
  OGRLayer* gauges = data->GetLayerByName("gauges");
  EXPECT_EQ(std::string(gauges->GetSpatialRef()->GetAuthorityCode(nullptr)), "32611");
  OGRFeatureUniquePtr feature(gauges->GetNextFeature());
  const OGRPoint* point = feature->GetGeometryRef()->toPoint();
  EXPECT_DOUBLE_EQ(point->getX(), 388010);
  EXPECT_DOUBLE_EQ(point->getY(), 3793020);
  EXPECT_DOUBLE_EQ(point->getZ(), 30);
  EXPECT_EQ(std::string(feature->GetFieldAsString("name")), "G1");
  EXPECT_DOUBLE_EQ(feature->GetFieldAsDouble("max_height_m"), 2.5);
  feature.reset(gauges->GetNextFeature());
  EXPECT_TRUE(feature->IsFieldNull(feature->GetFieldIndex("max_height_m")));
  EXPECT_EQ(feature->GetFieldAsInteger64("rank"), 2);
  feature.reset(data->GetLayerByName("runup")->GetNextFeature());
  const OGRLineString* line = feature->GetGeometryRef()->toLineString();
  ASSERT_EQ(line->getNumPoints(), 3);
  EXPECT_DOUBLE_EQ(line->getZ(1), 745);
  OGRLayer* zones = data->GetLayerByName("inundation");
  ASSERT_EQ(zones->GetFeatureCount(), 2);
  feature.reset(zones->GetNextFeature());
  EXPECT_EQ(feature->GetGeometryRef()->toMultiPolygon()->getNumGeometries(), 2);
  EXPECT_DOUBLE_EQ(feature->GetFieldAsDouble("area_m2"), 200);
  EXPECT_EQ(std::string(feature->GetFieldAsString("name")), "below 1 m");
  feature.reset(zones->GetNextFeature());
  EXPECT_DOUBLE_EQ(feature->GetFieldAsDouble("area_m2"), 800);
  const OGRMultiPolygon* ring = feature->GetGeometryRef()->toMultiPolygon();
  ASSERT_EQ(ring->getNumGeometries(), 1);
  EXPECT_EQ(ring->getGeometryRef(0)->getNumInteriorRings(), 1);
  OGREnvelope envelope;
  ring->getEnvelope(&envelope);
  EXPECT_DOUBLE_EQ(envelope.MinX, 388015);  // half a cell west of node 2
  EXPECT_DOUBLE_EQ(envelope.MaxY, 3793025);
}

TEST(GeoPackages, AreByteIdenticalAndWholeOrAbsent) {
  Scratch scratch;
  write_package(scratch("a.gpkg"));
  write_package(scratch("b.gpkg"));
  EXPECT_EQ(bytes(scratch("a.gpkg")), bytes(scratch("b.gpkg")));
  EXPECT_HAS(error_of([&] { write_package(scratch("a.gpkg")); }), "a.gpkg");
  write_package(scratch("a.gpkg"), true);
  {
    GeoPackage package(scratch("c.gpkg"), utm(), false);
    package.add_points("p", {{{{0, 0, 0}}, {}}});
    EXPECT_HAS(error_of([&] { package.add_lines("l", {{{{0, 0, 0}}, {}}}); }), "fewer than two points");
  }
  EXPECT_FALSE(std::filesystem::exists(scratch("c.gpkg")));  // never committed
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(scratch(""))) ++files;
  EXPECT_EQ(files, 2);
}

}  // namespace
}  // namespace lgiw
