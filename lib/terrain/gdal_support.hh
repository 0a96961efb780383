// What the terrain room needs of GDAL besides its own classes. Internal to lib/terrain.
#pragma once

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "case/case.hh"
#include "terrain/geo_output.hh"

namespace lgiw::detail {

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string text(const char* form, ...);

/// "case.yaml:12: " for the start of a message about `key`; "" for a case that was not read from a file.
std::string at_key(const Case& c, const std::string& key);

/// While alive, GDAL keeps quiet on stderr; message() is its last complaint. Registers the drivers.
class QuietGdal {
 public:
  QuietGdal();
  ~QuietGdal();
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
  static std::string message();
};

/// A band in memory, north-up, on `grid` (case coordinates), values row 0 in the south; NaN is no-data for floating
/// types.
GDALDatasetUniquePtr memory_raster(const RasterGrid& grid, GDALDataType type, const void* values,
                                   const std::string& crs_wkt);

/// Reads a band of a north-up dataset of the size of `grid` back, row 0 in the south.
template <class T>
std::vector<T> read_north_up(GDALDataset& data, const RasterGrid& grid, GDALDataType type) {
  std::vector<T> values(grid.size());
  // A negative line spacing turns the rows around.
  const auto row = GSpacing(sizeof(T) * grid.nx);
  T* last_row = values.data() + (grid.ny - 1) * grid.nx;
  if (data.GetRasterBand(1)->RasterIO(GF_Read, 0, 0, int(grid.nx), int(grid.ny), last_row, int(grid.nx), int(grid.ny),
                                      type, 0, -row, nullptr) != CE_None)
    values.clear();
  return values;
}

/// x-east, y-north order whatever the authority says.
OGRSpatialReference crs_from_wkt(const std::string& wkt);

/// WKT on one line.
std::string wkt_of(const OGRSpatialReference& crs);

}  // namespace lgiw::detail
