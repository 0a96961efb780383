#include "terrain/gdal_support.hh"

#include <cpl_error.h>

#include <cstdarg>
#include <cstdio>
#include <limits>
#include <mutex>

#include "base/error.hh"

namespace lgiw::detail {

std::string text(const char* form, ...) {
  va_list arguments, again;
  va_start(arguments, form);
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, form, arguments);
  va_end(arguments);
  std::string result(std::size_t(length), '\0');
  std::vsnprintf(result.data(), result.size() + 1, form, again);
  va_end(again);
  return result;
}

std::string at_key(const Case& c, const std::string& key) {
  const std::string place = c.where(key);
  return place.empty() ? "" : place + ": ";
}

namespace {

/// A case may come from a stranger: the files that it names are files; they open no connection and start no program.
void register_drivers() {
  GDALAllRegister();
  // By configuration, so that a later GDALAllRegister() does not bring them back; it would warn of those that are not
  // there.
  std::string skipped = CPLGetConfigOption("GDAL_SKIP", "");
  for (char& c : skipped) c = c == ' ' ? ',' : c;
  for (const char* name :
       {"AmigoCloud", "Carto",    "CSW",           "DAAS",       "EEDA",         "EEDAI",     "Elasticsearch",
        "GMLAS",      "GPSBabel", "HTTP",          "GeoRaster",  "MSSQLSpatial", "MongoDBv3", "MySQL",
        "NGW",        "OAPIF",    "OCI",           "ODBC",       "OGCAPI",       "OGR_OGDI",  "PGeo",
        "PLMOSAIC",   "PLSCENES", "PostGISRaster", "PostgreSQL", "Rasterlite",   "STACIT",    "STACTA",
        "WCS",        "WFS",      "WMS",           "WMTS"})
    if (GDALGetDriverByName(name)) skipped.append(skipped.empty() ? "" : ",").append(name);
  CPLSetConfigOption("GDAL_SKIP", skipped.c_str());
  // The only name that /vsicurl/ and its like would open.
  CPLSetConfigOption("CPL_VSIL_CURL_ALLOWED_FILENAME", "none");
  // What drivers fetch for themselves, such as schemas, has to go through this.
  CPLSetConfigOption("GDAL_HTTP_PROXY", "none://none");
  GDALAllRegister();
}

}  // namespace

QuietGdal::QuietGdal() {
  static std::once_flag registered;
  std::call_once(registered, register_drivers);
  CPLPushErrorHandler(CPLQuietErrorHandler);
  CPLErrorReset();
}

QuietGdal::~QuietGdal() { CPLPopErrorHandler(); }

std::string QuietGdal::message() {
  const std::string last = CPLGetLastErrorMsg();
  return last.empty() ? "GDAL gives no reason" : "GDAL: " + last;
}

GDALDatasetUniquePtr memory_raster(const RasterGrid& grid, GDALDataType type, const void* values,
                                   const std::string& crs_wkt) {
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("MEM");
  GDALDatasetUniquePtr data(driver->Create("", int(grid.nx), int(grid.ny), 1, type, nullptr));
  if (!data)
    throw WorkError(text("cannot hold a raster of %zu x %zu cells", grid.nx, grid.ny), QuietGdal::message(),
                    "cut the window or choose a larger dp");
  double geo[6] = {grid.x0 - 0.5 * grid.dx, grid.dx, 0, grid.y0 + (double(grid.ny) - 0.5) * grid.dx, 0, -grid.dx};
  data->SetGeoTransform(geo);
  if (!crs_wkt.empty()) {
    const OGRSpatialReference crs = crs_from_wkt(crs_wkt);
    data->SetSpatialRef(&crs);
  }
  GDALRasterBand* band = data->GetRasterBand(1);
  if (GDALDataTypeIsFloating(type)) band->SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
  if (values) {
    const auto row = GSpacing(std::size_t(GDALGetDataTypeSizeBytes(type)) * grid.nx);
    auto* last_row = const_cast<char*>(static_cast<const char*>(values)) + GSpacing(grid.ny - 1) * row;
    if (band->RasterIO(GF_Write, 0, 0, int(grid.nx), int(grid.ny), last_row, int(grid.nx), int(grid.ny), type, 0, -row,
                       nullptr) != CE_None)
      throw WorkError("cannot fill a raster in memory", QuietGdal::message(), "report this");
  }
  return data;
}

OGRSpatialReference crs_from_wkt(const std::string& wkt) {
  OGRSpatialReference crs;
  crs.importFromWkt(wkt.c_str());
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return crs;
}

std::string wkt_of(const OGRSpatialReference& crs) {
  char* wkt = nullptr;
  const char* options[] = {"FORMAT=WKT2_2019", "MULTILINE=NO", nullptr};
  crs.exportToWkt(&wkt, options);
  std::string result = wkt ? wkt : "";
  CPLFree(wkt);
  return result;
}

}  // namespace lgiw::detail
