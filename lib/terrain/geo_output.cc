#include "terrain/geo_output.hh"

#include <cpl_conv.h>
#include <gdal_alg.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/atomic_file.hh"
#include "base/error.hh"
#include "terrain/gdal_support.hh"

namespace lgiw {
namespace {

using namespace detail;

[[noreturn]] void fail(const std::string& path) {
  throw WorkError("cannot write '" + path + "'", QuietGdal::message(), "check the disk and the folder");
}

RasterGrid placed(const RasterGrid& grid, const GeoReference& where) {
  return RasterGrid(grid.nx, grid.ny, grid.x0 + where.origin[0], grid.y0 + where.origin[1], grid.dx);
}

void expect_size(const RasterGrid& grid, std::size_t size, const std::string& path) {
  if (grid.nx == 0 || grid.ny == 0 || grid.size() != size)
    throw WorkError("cannot write '" + path + "'", text("%zu values for %zu x %zu nodes", size, grid.nx, grid.ny),
                    "report this");
}

}  // namespace

void write_geotiff(const std::string& path, const RasterGrid& grid, const std::vector<float>& values,
                   const GeoReference& where, const std::string& unit, const std::string& description, bool overwrite) {
  const QuietGdal quiet;
  expect_size(grid, values.size(), path);
  AtomicFile file(path, overwrite);
  const GDALDatasetUniquePtr raster = memory_raster(placed(grid, where), GDT_Float32, values.data(), where.crs_wkt);
  GDALRasterBand* band = raster->GetRasterBand(1);
  band->SetUnitType(unit.c_str());
  band->SetDescription(description.c_str());
  if (!where.attribution.empty()) raster->SetMetadataItem("TIFFTAG_COPYRIGHT", where.attribution.c_str());
  char words[][32] = {"COMPRESS=DEFLATE", "PREDICTOR=YES", "NUM_THREADS=1"};
  char* options[] = {words[0], words[1], words[2], nullptr};
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("COG");
  if (!driver)
    throw WorkError("cannot write '" + path + "'", "this GDAL has no COG driver", "install GDAL 3.1 or newer");
  GDALDatasetUniquePtr written(
      driver->CreateCopy(file.temporary().c_str(), raster.get(), FALSE, options, nullptr, nullptr));
  if (!written) fail(path);
  CPLErrorReset();
  written.reset();  // the last bytes go out here, and GDAL 3.6 tells of a failure only through its error state
  if (CPLGetLastErrorType() >= CE_Failure) fail(path);
  file.commit();
}

struct GeoPackage::Impl {
  Impl(const std::string& path, const GeoReference& where_, bool overwrite) : file(path, overwrite), where(where_) {
    // The time of the last change would otherwise be the time of writing.
    CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", "2000-01-01T00:00:00.000Z");
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GPKG");
    if (!driver) throw WorkError("cannot write '" + path + "'", "this GDAL has no GPKG driver", "install it");
    data.reset(driver->Create(file.temporary().c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    if (!data) fail(path);
    if (!where.crs_wkt.empty()) crs = crs_from_wkt(where.crs_wkt);
    if (!where.attribution.empty()) data->SetMetadataItem("ATTRIBUTION", where.attribution.c_str());
  }
  ~Impl() {
    data.reset();
    CPLSetThreadLocalConfigOption("OGR_CURRENT_DATE", nullptr);
  }

  OGRLayer* layer(const std::string& name, OGRwkbGeometryType type) {
    OGRLayer* result = data->CreateLayer(name.c_str(), crs.IsEmpty() ? nullptr : &crs, type, nullptr);
    if (!result) fail(file.path());
    return result;
  }

  void add(const std::string& name, OGRwkbGeometryType type, const std::vector<VectorFeature>& features) {
    OGRLayer* target = layer(name, type);
    if (!features.empty())
      for (const auto& [key, value] : features[0].attributes) {
        OGRFieldDefn field(key.c_str(), value.index() == 0 ? OFTReal : value.index() == 1 ? OFTInteger64 : OFTString);
        if (target->CreateField(&field) != OGRERR_NONE) fail(file.path());
      }
    for (const VectorFeature& feature : features) {
      OGRFeature row(target->GetLayerDefn());
      if (type == wkbPoint25D) {
        const auto p = place(feature.points.at(0));
        OGRPoint point(p[0], p[1], p[2]);
        row.SetGeometry(&point);
      } else {
        LGIW_VALIDATE(feature.points.size() >= 2, "a line of layer '" + name + "' has fewer than two points",
                      text("it has %zu", feature.points.size()), "give it at least two");
        OGRLineString line;
        for (const auto& local : feature.points) {
          const auto p = place(local);
          line.addPoint(p[0], p[1], p[2]);
        }
        row.SetGeometry(&line);
      }
      for (const auto& [key, value] : feature.attributes) {
        const int index = row.GetFieldIndex(key.c_str());
        if (index < 0)
          throw WorkError("layer '" + name + "' has no attribute '" + key + "'", "its first feature lacks it",
                          "report this");
        if (const double* number = std::get_if<double>(&value)) {
          if (std::isnan(*number))
            row.SetFieldNull(index);
          else
            row.SetField(index, *number);
        } else if (const int64_t* count = std::get_if<int64_t>(&value)) {
          row.SetField(index, GIntBig(*count));
        } else {
          row.SetField(index, std::get<std::string>(value).c_str());
        }
      }
      if (target->CreateFeature(&row) != OGRERR_NONE) fail(file.path());
    }
  }

  std::array<double, 3> place(const std::array<double, 3>& p) const {
    return {p[0] + where.origin[0], p[1] + where.origin[1], p[2] + where.origin[2]};
  }

  QuietGdal quiet;
  AtomicFile file;
  GeoReference where;
  OGRSpatialReference crs;
  GDALDatasetUniquePtr data;
};

GeoPackage::GeoPackage(const std::string& path, const GeoReference& where, bool overwrite)
    : impl_(std::make_unique<Impl>(path, where, overwrite)) {}
GeoPackage::~GeoPackage() = default;

void GeoPackage::add_points(const std::string& layer, const std::vector<VectorFeature>& features) {
  for (const VectorFeature& feature : features)
    LGIW_VALIDATE(feature.points.size() == 1, "a point of layer '" + layer + "' has no single place",
                  text("it has %zu points", feature.points.size()), "give it one");
  impl_->add(layer, wkbPoint25D, features);
}

void GeoPackage::add_lines(const std::string& layer, const std::vector<VectorFeature>& features) {
  impl_->add(layer, wkbLineString25D, features);
}

void GeoPackage::add_polygons(const std::string& layer, const RasterGrid& grid, const std::vector<uint8_t>& classes,
                              const std::vector<std::string>& names) {
  expect_size(grid, classes.size(), impl_->file.path());
  const GDALDatasetUniquePtr raster = memory_raster(placed(grid, impl_->where), GDT_Byte, classes.data(), "");
  const GDALDatasetUniquePtr pieces(
      GetGDALDriverManager()->GetDriverByName("Memory")->Create("", 0, 0, 0, GDT_Unknown, nullptr));
  OGRLayer* found = pieces->CreateLayer("pieces", nullptr, wkbPolygon, nullptr);
  OGRFieldDefn value("class", OFTInteger);
  found->CreateField(&value);
  // The raster is its own mask: class 0 gets no polygon.
  GDALRasterBand* band = raster->GetRasterBand(1);
  if (GDALPolygonize(band, band, OGRLayer::ToHandle(found), 0, nullptr, nullptr, nullptr) != CE_None)
    fail(impl_->file.path());
  std::map<int, OGRMultiPolygon> shapes;
  for (const auto& feature : *found)
    shapes[feature->GetFieldAsInteger(0)].addGeometryDirectly(feature->StealGeometry());

  OGRLayer* target = impl_->layer(layer, wkbMultiPolygon);
  OGRFieldDefn fields[] = {{"class", OFTInteger}, {"name", OFTString}, {"area_m2", OFTReal}};
  for (OGRFieldDefn& field : fields)
    if (target->CreateField(&field) != OGRERR_NONE) fail(impl_->file.path());
  for (const auto& [number, shape] : shapes) {
    OGRFeature row(target->GetLayerDefn());
    row.SetField(0, number);
    if (std::size_t(number) <= names.size()) row.SetField(1, names[std::size_t(number) - 1].c_str());
    row.SetField(2, shape.get_Area());
    row.SetGeometry(&shape);
    if (target->CreateFeature(&row) != OGRERR_NONE) fail(impl_->file.path());
  }
}

void GeoPackage::commit() {
  CPLErrorReset();
  impl_->data.reset();
  if (CPLGetLastErrorType() >= CE_Failure) fail(impl_->file.path());
  impl_->file.commit();
}

}  // namespace lgiw
