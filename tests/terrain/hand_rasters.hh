// Rasters drawn by hand, and the errors that they provoke.
#pragma once

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "base/error.hh"
#include "terrain/terrain_model.hh"

namespace lgiw::test {

/// A folder that goes away with the test.
class Scratch {
 public:
  Scratch() {
    static int count = 0;
    folder_ = std::filesystem::temp_directory_path() /
              ("lgiw-terrain-" + std::to_string(getpid()) + "-" + std::to_string(count++));
    std::filesystem::create_directories(folder_);
  }
  ~Scratch() { std::filesystem::remove_all(folder_); }
  std::string operator()(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

/// ESRI ASCII grid; `rows` from the north, lower left corner at (x, y).
inline std::string write_asc(const std::string& path, double x, double y, double cell,
                             const std::vector<std::vector<double>>& rows, double nodata = -9999) {
  std::ofstream file(path);
  file.precision(15);
  file << "ncols " << rows[0].size() << "\nnrows " << rows.size() << "\nxllcorner " << x << "\nyllcorner " << y
       << "\ncellsize " << cell << "\nNODATA_value " << nodata << "\n";
  for (const auto& row : rows) {
    for (const double z : row) file << z << ' ';
    file << '\n';
  }
  return path;
}

/// Rows from the north of z(x, y) at cell centres.
inline std::vector<std::vector<double>> rows_of(int nx, int ny, double x, double y, double cell,
                                                const std::function<double(double, double)>& z) {
  std::vector<std::vector<double>> rows(ny, std::vector<double>(nx));
  for (int row = 0; row < ny; ++row)
    for (int column = 0; column < nx; ++column)
      rows[row][column] = z(x + (column + 0.5) * cell, y + (ny - row - 0.5) * cell);
  return rows;
}

/// GeoTIFF of any geotransform and CRS; `rows` in stored order.
inline std::string write_tif(const std::string& path, std::array<double, 6> geo, const std::string& crs,
                             const std::vector<std::vector<double>>& rows, GDALDataType type = GDT_Float64,
                             int bands = 1) {
  GDALAllRegister();
  GDALDatasetUniquePtr data(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
      path.c_str(), int(rows[0].size()), int(rows.size()), bands, type, nullptr));
  data->SetGeoTransform(geo.data());
  if (!crs.empty()) {
    OGRSpatialReference reference;
    reference.SetFromUserInput(crs.c_str());
    data->SetSpatialRef(&reference);
  }
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const auto* values = const_cast<double*>(rows[row].data());
    EXPECT_EQ(CE_None, data->GetRasterBand(1)->RasterIO(GF_Write, 0, int(row), int(rows[0].size()), 1,
                                                        const_cast<double*>(values), int(rows[0].size()), 1,
                                                        GDT_Float64, 0, 0, nullptr));
  }
  return path;
}

/// A case of these sources in UTM 11N, with neither water nor slide.
inline Case raster_case(const std::vector<std::string>& files, double dp = 1) {
  Case c;
  c.name = "test";
  c.dp = dp;
  c.terrain.crs = "EPSG:32611";
  for (const std::string& file : files) {
    TerrainSource source;
    source.file = file;
    c.terrain.sources.push_back(source);
  }
  return c;
}

inline TerrainModel build(const Case& c) {
  Provenance provenance;
  return build_terrain(c, provenance);
}

/// The one-line error of `call`; a test failure when there is none.
inline std::string error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  ADD_FAILURE() << "no InputError";
  return "";
}

inline std::string error_of(const Case& c) {
  return error_of([&] { build(c); });
}

#define EXPECT_HAS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

}  // namespace lgiw::test
