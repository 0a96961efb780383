// A raster of elevations or thicknesses, placed in the case's CRS. Internal to lib/terrain.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/provenance.hh"
#include "terrain/gdal_support.hh"

namespace lgiw::detail {

/// More cells than this are never held at once (0.3 GB as double); a finer source is averaged while it is read.
inline constexpr int64_t max_cells = 40'000'000;

/// x_min, y_min, x_max, y_max
using Extent = std::array<double, 4>;
std::string describe(const Extent& extent);

struct Spikes {
  int64_t count = 0;
  double threshold = 0;  // m, between the cells as read
  double worst = 0;      // m above (+) or below (-) the nearest of its neighbours in height
  double x = 0, y = 0;   // of the worst, source CRS
};

/// One band of a raster that GDAL opens.
class RasterSource {
 public:
  /// Opens and checks; `what` names it in messages, e.g. "terrain source 'dem.tif'". Hashes the files it consists of.
  RasterSource(const std::string& path, std::string what, Provenance& provenance);

  const std::string& what() const { return what_; }
  bool has_crs() const { return !crs_.IsEmpty(); }
  const OGRSpatialReference& crs() const { return crs_; }
  std::array<double, 2> middle() const;  // source CRS
  double cells() const { return double(data_->GetRasterXSize()) * data_->GetRasterYSize(); }

  /// Finds extent and pixel in the case's CRS. A source without a CRS is taken to have the case's (returns true then).
  bool place(const OGRSpatialReference& case_crs);
  const Extent& extent() const { return extent_; }  // of the pixels' outer edges, case CRS
  double pixel() const { return pixel_; }           // m in the case's CRS; the smaller side
  bool is_aligned() const { return aligned_; }      // north-up or south-up with square pixels in the case's CRS
  /// Centre of any one cell of an aligned source, case CRS.
  std::array<double, 2> anchor() const { return {geo_[0] + 0.5 * geo_[1], geo_[3] + 0.5 * geo_[5]}; }

  /// Values at the nodes of `grid` (case CRS), row 0 in the south; NaN where the source has none. Cells that coincide
  /// with nodes are handed over as they are; everything else goes through GDAL's warper (bilinear). Cells that stand
  /// out from all of their neighbours by more than `spike_threshold` (0: not looked for) are counted in `spikes` and,
  /// with `remove_spikes`, replaced by the median of their neighbours. `void_value` replaces no-data before resampling.
  std::vector<double> sample(const RasterGrid& grid, double spike_threshold, bool remove_spikes, Spikes* spikes,
                             double void_value);

  /// Where a place in the source's CRS lies in the case's.
  std::array<double, 2> to_case(double x, double y) const;

 private:
  struct Window {
    int column = 0, row = 0, columns = 0, rows = 0;  // in the source
    int factor = 1;                                  // cells averaged, a side
    RasterGrid shape() const;
  };
  Window window_around(const RasterGrid& grid) const;
  std::vector<double> read(const Window& window) const;  // top row first, as stored

  std::string what_;
  GDALDatasetUniquePtr data_;
  std::array<double, 6> geo_{};
  OGRSpatialReference crs_, case_crs_;
  bool same_crs_ = false, aligned_ = false;
  double pixel_ = 0;
  Extent extent_{};
};

/// The CRS that `terrain.crs` names. Throws InputError unless it is projected (or local) in metres.
OGRSpatialReference case_crs_from_text(const Case& c, const RasterSource& first_source);
/// The CRS of the first source, for a case that names none.
OGRSpatialReference case_crs_from_source(const RasterSource& source);

/// The largest window without missing values: column and row ranges {i0, j0, i1, j1}, inclusive; all 0 with i1 < i0
/// when there is none.
struct CellRange {
  std::size_t i0 = 1, j0 = 1, i1 = 0, j1 = 0;
};
CellRange largest_valid_range(const std::vector<double>& values, std::size_t nx, std::size_t ny);

/// Interpolates the NaN of `values` from their surroundings: inverse distance weights (GDALFillNodata), then, for voids
/// of up to half a million cells in all, relaxed to Laplace's equation, so that a plane comes out as a plane and a
/// filled cell is neither a hill nor a hollow. The edge of the grid has no gradient across it.
void fill_voids(std::vector<double>& values, const RasterGrid& grid);

/// Distance, in cells, from each node to the nearest one where `values` is NaN, up to `limit`.
std::vector<float> distance_to_void(const std::vector<double>& values, const RasterGrid& grid, double limit);

}  // namespace lgiw::detail
