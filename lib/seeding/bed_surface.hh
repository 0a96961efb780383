// The bed as the seeding sees it, and the map cells that particles stand in.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "case/case.hh"
#include "terrain/terrain_model.hh"

namespace lgiw {

/// Map cells of dp x dp over the domain, with a rim of `rim` cells outside for walls; in 2-D one row and no rim in y.
/// The domain is that of the terrain, of a DEM out to the edges of its outermost cells; its east and north sides lie at
/// the multiple of dp nearest to the window's, so that the lattice fits.
struct MapCells {
  double x_low = 0, y_low = 0, dp = 1;
  int64_t nx = 1, ny = 1;  // inside the domain
  int64_t rim = 0, rim_y = 0;
  bool two_d = false;
  double east_moved = 0, north_moved = 0;  // m

  int64_t width() const { return nx + 2 * rim; }
  int64_t count() const { return width() * (ny + 2 * rim_y); }
  /// Column (i, j) of running index n, row by row from the south-west corner of the rim; inside for 0 <= i < nx.
  std::array<int64_t, 2> cell(int64_t n) const { return {n % width() - rim, n / width() - rim_y}; }
  int64_t index(int64_t i, int64_t j) const { return (j + rim_y) * width() + i + rim; }
  bool inside(int64_t i, int64_t j) const { return i >= 0 && i < nx && j >= 0 && j < ny; }
  double x(int64_t i) const { return x_low + (double(i) + 0.5) * dp; }
  double y(int64_t j) const { return two_d ? 0.0 : y_low + (double(j) + 0.5) * dp; }
  double x_high() const { return x_low + double(nx) * dp; }
  double y_high() const { return two_d ? 0.0 : y_low + double(ny) * dp; }
};

/// Throws InputError for more columns than fit into memory.
MapCells map_cells(const Case& c, const TerrainModel& model);

/// Height of the bed (or of the ground) at any point, in local coordinates; outside the domain that of the nearest
/// point inside. Rasters are bilinear. The profile of an analytic scene is taken as it is given, with its vertical
/// steps, which a raster would smear: steps, and stretches steeper than 8 : 1 within less than dp, are moved to the
/// nearest side of a map cell, where the columns of wall particles can follow them exactly.
class BedSurface {
 public:
  BedSurface(const Case& c, const TerrainModel& model, const MapCells& cells);

  double height(double x, double y) const;
  /// Central differences over +-dp/2: what is smaller than the particles see is smoothed. Stays clear of cell sides, so
  /// that a step there is no slope.
  std::array<double, 2> gradient(double x, double y) const;
  double lowest() const { return lowest_; }
  double highest() const { return highest_; }

 private:
  const HeightField* field_ = nullptr;  // of the model, which must outlive this
  std::vector<Point2> profile_;         // analytic scenes
  double x_min_, x_max_, y_min_, y_max_, half_width_;
  bool two_d_;
  double lowest_ = 0, highest_ = 0;
};

}  // namespace lgiw
