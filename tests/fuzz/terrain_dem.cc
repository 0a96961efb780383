// A terrain raster of odd sizes, places, coordinate systems and heights, as GDAL hands it over, under a case with the
// keys that read it.
#include <cpl_vsi.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <limits>
#include <vector>

#include "fuzzing.hh"
#include "terrain/terrain_model.hh"

namespace {

using namespace lgiw;

double height(fuzz::Script& script, double x, double y) {
  const uint8_t choice = script.byte();
  if (choice < 240) return 80 + (x * x + y * y) / 900 + choice / 16;
  const double odd[] = {NAN, HUGE_VAL, -HUGE_VAL, -9999, 0, 1e30, -1e30, 1e-30, 3e38, -12001, 9001, 110, 109.999};
  return odd[(choice - 240) % 13];
}

/// 500000, 3700000 in the middle, 20 m a cell, unless the script wants it otherwise.
void write_raster(const std::string& path, fuzz::Script& script) {
  const int nx = 1 + script.byte() % 32, ny = 1 + script.byte() % 32;
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  const GDALDataType types[] = {GDT_Float32, GDT_Float64, GDT_Int16, GDT_Byte, GDT_UInt32, GDT_CFloat32};
  const GDALDatasetUniquePtr data(driver->Create(path.c_str(), nx, ny, 1, types[script.byte() % 6], nullptr));
  if (!data) return;
  double geo[6] = {500000 - 10.0 * nx, 20, 0, 3700000 + 10.0 * ny, 0, -20};
  const uint8_t odd = script.byte();
  if (odd < 12) geo[odd % 6] = script.real();
  if (odd >= 12 && odd < 20) geo[5] = 20;
  if (odd != 21) data->SetGeoTransform(geo);
  const char* systems[] = {"EPSG:32611", "EPSG:4326", "EPSG:2229", "EPSG:3857", "EPSG:4978", "EPSG:32633", "EPSG:5041"};
  const uint8_t system = script.byte();
  if (system < 250) {
    OGRSpatialReference crs;
    if (crs.SetFromUserInput(systems[system < 180 ? 0 : system % 7]) == OGRERR_NONE) data->SetSpatialRef(&crs);
  }
  GDALRasterBand* band = data->GetRasterBand(1);
  if (script.byte() % 4 == 0) band->SetNoDataValue(script.real());
  std::vector<double> values;
  for (int row = 0; row < ny; ++row)
    for (int column = 0; column < nx; ++column)
      values.push_back(height(script, 20.0 * column - 10.0 * nx, 20.0 * row - 10.0 * ny));
  if (band->RasterIO(GF_Write, 0, 0, nx, ny, values.data(), nx, ny, GDT_Float64, 0, 0, nullptr) != CE_None) return;
}

}  // namespace

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  static const bool ready = [] {
    GDALAllRegister();
    CPLPushErrorHandler(CPLQuietErrorHandler);
    return true;
  }();
  (void)ready;
  static const fuzz::Folder folder;
  fuzz::Script script(data, size);
  std::string text = "name: bowl\nparticle_spacing: 20\nterrain:\n";
  const uint8_t keys = script.byte(), slide = script.byte();
  if (keys & 1) text += "  crs: EPSG:32611\n";
  if (keys & 2) text += "  voids: fill\n";
  if (keys & 4) text += "  spikes: remove\n";
  if (keys & 8) text += "  window: [499900, 3699900, 500100, 3700100]\n";
  if (keys & 16) text += "  sides: {west: open, north: absorbing}\n";
  text += "  sources: [{file: a.tif}" + std::string(keys & 32 ? ", {file: b.tif, blend: 50, vertical_shift: 1}" : "") +
          "]\n";
  if (!(keys & 64)) text += "water: {level: 110, seed: [500000, 3700000]}\n";
  if ((keys & 64) || (slide & 1)) {
    text += "slide:\n  polygon: [[500020, 3699940], [500060, 3699940], [500060, 3700060], [500020, 3700060]]\n";
    const char* surfaces[] = {"depth: 30",
                              "base_elevation: 90",
                              "slbl: {}",
                              "slbl: {max_depth: 20, neighbours: 8}",
                              "plane: {point: [500040, 3700000, 100], dip: 20, dip_direction: 270}",
                              "before: a.tif\n  after: b.tif",
                              "thickness: b.tif",
                              "failure_surface: b.tif"};
    text += std::string("  ") + surfaces[slide / 2 % 8] + "\n";
  }
  write_raster(folder / "a.tif", script);
  if ((keys & 32) || slide / 2 % 8 >= 5) write_raster(folder / "b.tif", script);
  Case c;
  if (fuzz::accepted([&] { c = parse_case(text, "case.yaml"); })) {
    c.path = folder / "case.yaml";
    fuzz::accepted([&] {
      Provenance provenance;
      const TerrainModel model = build_terrain(c, provenance);
      reachable_nodes(model, c);
    });
  }
  return 0;
}
