// Georeferenced outputs: rasters as Cloud Optimized GeoTIFF, vectors as GeoPackage. Reruns are byte-identical.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace lgiw {

/// A node-registered grid in local coordinates, row 0 in the south. Converts from whatever has nx, ny, x0, y0 and dx
/// (SurfaceMap, HeightField).
struct RasterGrid {
  std::size_t nx = 0, ny = 0;
  double x0 = 0, y0 = 0, dx = 1;
  RasterGrid() = default;
  RasterGrid(std::size_t nx_, std::size_t ny_, double x0_, double y0_, double dx_)
      : nx(nx_), ny(ny_), x0(x0_), y0(y0_), dx(dx_) {}
  template <class Grid>
  requires requires(const Grid& g) { g.nx, g.ny, g.x0, g.y0, g.dx; }
  RasterGrid(const Grid& g) : nx(g.nx), ny(g.ny), x0(g.x0), y0(g.y0), dx(g.dx) {}
  std::size_t size() const { return nx * ny; }
};

/// Where local coordinates lie: case CRS = local + origin. An empty WKT (analytic scenes) writes files without a CRS.
/// origin[2] is not added to raster values. The attribution, where there is one, goes into the TIFF tag Copyright and
/// into the GeoPackage's metadata item ATTRIBUTION. Converts from whatever has all three (ParticleHeader).
struct GeoReference {
  std::array<double, 3> origin{0, 0, 0};
  std::string crs_wkt, attribution;
  GeoReference() = default;
  GeoReference(const std::array<double, 3>& origin_, std::string crs_wkt_, std::string attribution_ = "")
      : origin(origin_), crs_wkt(std::move(crs_wkt_)), attribution(std::move(attribution_)) {}
  template <class Header>
  requires requires(const Header& h) { h.origin, h.crs_wkt, h.attribution; }
  GeoReference(const Header& h) : GeoReference(h.origin, h.crs_wkt, h.attribution) {}
};

/// Writes `values` [ny,nx] (row 0 in the south; NaN is no-data) as a one-band float32 Cloud Optimized GeoTIFF whose
/// cells are centred on the nodes; unit (e.g. "m", "m/s") and band description are set. The file appears whole or not
/// at all. Throws InputError when it exists and `overwrite` is false, WorkError when it cannot be written.
void write_geotiff(const std::string& path, const RasterGrid& grid, const std::vector<float>& values,
                   const GeoReference& where, const std::string& unit, const std::string& description, bool overwrite);

using AttributeValue = std::variant<double, int64_t, std::string>;
using Attributes = std::vector<std::pair<std::string, AttributeValue>>;

/// A point or a polyline in local coordinates: points [n,3]; origin is added to all three.
struct VectorFeature {
  std::vector<std::array<double, 3>> points;
  Attributes attributes;  // all features of a layer have the same names and types; NaN is written as NULL
};

/// A GeoPackage written layer by layer: nothing appears at `path` before commit().
/// Throws InputError when the file exists and `overwrite` is false, WorkError when it cannot be written.
class GeoPackage {
 public:
  GeoPackage(const std::string& path, const GeoReference& where, bool overwrite);
  ~GeoPackage();
  GeoPackage(const GeoPackage&) = delete;
  GeoPackage& operator=(const GeoPackage&) = delete;

  /// PointZ and LineStringZ layers. A line of fewer than two points is an error of the caller (InputError).
  void add_points(const std::string& layer, const std::vector<VectorFeature>& features);
  void add_lines(const std::string& layer, const std::vector<VectorFeature>& features);
  /// One MultiPolygon feature for every value > 0 in `classes` [ny,nx] (a mask is a single class 1), in the order of
  /// the values: the outline of the cells of that value, 4-connected. Attributes: class, area_m2 and, where `names` has
  /// an entry for it (names[value - 1]), name.
  void add_polygons(const std::string& layer, const RasterGrid& grid, const std::vector<uint8_t>& classes,
                    const std::vector<std::string>& names = {});
  void commit();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lgiw
