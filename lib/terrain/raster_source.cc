#include "terrain/raster_source.hh"

#include <gdal_alg.h>
#include <gdal_utils.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include "base/error.hh"

namespace lgiw::detail {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using Transformation = std::unique_ptr<OGRCoordinateTransformation>;

Transformation transformation(const OGRSpatialReference& from, const OGRSpatialReference& to, const std::string& what) {
  Transformation result(OGRCreateCoordinateTransformation(&from, &to));
  if (!result)
    throw InputError(what + ": cannot be brought into the case's CRS", QuietGdal::message(),
                     "check the CRS of the raster and terrain.crs");
  return result;
}

/// A UTM zone for the middle of a source, "EPSG:32611"; "" when that cannot be told.
std::string utm_zone(const std::array<double, 2>& middle, const OGRSpatialReference& crs) {
  OGRSpatialReference degrees;
  degrees.SetWellKnownGeogCS("WGS84");
  degrees.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  Transformation to_degrees(OGRCreateCoordinateTransformation(&crs, &degrees));
  double x = middle[0], y = middle[1];
  if (!to_degrees || !to_degrees->Transform(1, &x, &y) || !(std::abs(x) <= 180 && std::abs(y) <= 84)) return "";
  return text("EPSG:%d", (y < 0 ? 32700 : 32600) + std::clamp(int(std::floor((x + 180) / 6)) + 1, 1, 60));
}

std::array<double, 2> at_pixel(const std::array<double, 6>& geo, double column, double row) {
  return {geo[0] + column * geo[1] + row * geo[2], geo[3] + column * geo[4] + row * geo[5]};
}

/// Throws unless `crs` measures in metres on a plane.
void require_metric(const OGRSpatialReference& crs, const std::string& problem_start, const std::string& zone) {
  const std::string suggestion =
      "set terrain.crs to a projected CRS in metres" + (zone.empty() ? "" : ", e.g. " + zone);
  LGIW_VALIDATE(!crs.IsGeographic() && !crs.IsGeocentric(), problem_start + " is in degrees",
                "particles and rasters need metres; sources in degrees are reprojected to the case's CRS", suggestion);
  LGIW_VALIDATE(crs.IsProjected() || crs.IsLocal(), problem_start + " is not a projected CRS",
                "particles and rasters need metres on a plane", suggestion);
  const char* unit = nullptr;
  const double metres = crs.GetLinearUnits(&unit);
  LGIW_VALIDATE(std::abs(metres - 1) < 1e-9, problem_start + text(" measures in %s", unit ? unit : "another unit"),
                text("its unit is %.9g m; everything here is in metres", metres), suggestion);
  const char* projection = crs.GetAttrValue("PROJECTION");
  LGIW_VALIDATE(!projection || std::string(projection).rfind("Mercator", 0) != 0, problem_start + " is a Mercator map",
                "its metres grow with latitude: lengths, areas and volumes would be wrong", suggestion);
}

Spikes find_spikes(std::vector<double>& values, int columns, int rows, double threshold, bool remove) {
  Spikes found;
  std::vector<std::pair<std::size_t, double>> replacements;
  std::vector<double> neighbours;
  int64_t worst_index = 0;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const std::size_t index = std::size_t(row) * columns + column;
      const double z = values[index];
      if (std::isnan(z)) continue;
      neighbours.clear();
      for (int r = std::max(0, row - 1); r <= std::min(rows - 1, row + 1); ++r)
        for (int c = std::max(0, column - 1); c <= std::min(columns - 1, column + 1); ++c) {
          const double other = values[std::size_t(r) * columns + c];
          if ((r != row || c != column) && !std::isnan(other)) neighbours.push_back(other);
        }
      // Beside a void or a corner too little is known to call a cell a spike.
      const std::size_t count = neighbours.size();
      if (count < 3) continue;
      std::sort(neighbours.begin(), neighbours.end());
      const double above = z - neighbours[count - 1], below = z - neighbours[0];
      const double excess = above > threshold ? above : below < -threshold ? below : 0;
      if (excess == 0) continue;
      ++found.count;
      if (std::abs(excess) > std::abs(found.worst)) found.worst = excess, worst_index = int64_t(index);
      replacements.emplace_back(index, 0.5 * (neighbours[(count - 1) / 2] + neighbours[count / 2]));
    }
  if (remove)
    for (const auto& [index, z] : replacements) values[index] = z;
  found.x = double(worst_index % columns), found.y = double(worst_index / columns);
  return found;
}

/// Solves Laplace's equation in `voids` by successive over-relaxation.
void relax(std::vector<double>& values, const RasterGrid& grid, const std::vector<std::size_t>& voids) {
  const std::size_t nx = grid.nx, ny = grid.ny;
  // As if all were one square hole; holes that are smaller converge no slower than that.
  const double extent = std::sqrt(double(voids.size())) + 1;
  const double factor = 2 / (1 + std::sin(std::numbers::pi / (2 * extent)));
  for (int sweep = 0; sweep < 100 + 10 * int(extent); ++sweep) {
    double largest = 0;
    for (const std::size_t k : voids) {
      const std::size_t i = k % nx, j = k / nx;
      double sum = 0, count = 0;
      if (i > 0) sum += values[k - 1], ++count;
      if (i + 1 < nx) sum += values[k + 1], ++count;
      if (j > 0) sum += values[k - nx], ++count;
      if (j + 1 < ny) sum += values[k + nx], ++count;
      const double change = factor * (sum / count - values[k]);
      values[k] += change;
      largest = std::max(largest, std::abs(change));
    }
    if (largest < 1e-4 * (2 - factor)) return;  // 0.1 mm
  }
}

}  // namespace

std::string describe(const Extent& e) { return text("x %.8g to %.8g, y %.8g to %.8g", e[0], e[2], e[1], e[3]); }

RasterSource::RasterSource(const std::string& path, std::string what, Provenance& provenance) : what_(std::move(what)) {
  // GDAL's own names ("/vsizip/...", "NETCDF:file:variable") are not files; for these GDAL has the word.
  data_.reset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR));
  LGIW_VALIDATE(data_, what_ + ": cannot be read as a raster", QuietGdal::message(),
                "name a file that gdalinfo understands");
  LGIW_VALIDATE(data_->GetRasterCount() >= 1, what_ + ": has no bands", "GDAL finds only subdatasets in it",
                "name one of the subdatasets that gdalinfo lists");
  GDALRasterBand* band = data_->GetRasterBand(1);
  const GDALColorInterp colour = band->GetColorInterpretation();
  LGIW_VALIDATE(
      colour != GCI_RedBand && colour != GCI_PaletteIndex && !GDALDataTypeIsComplex(band->GetRasterDataType()),
      what_ + ": is a picture or holds complex numbers", "a terrain raster has elevations in its first band",
      "name the elevation model itself");
  LGIW_VALIDATE(data_->GetGeoTransform(geo_.data()) == CE_None, what_ + ": has no georeference",
                "it does not say where its pixels lie", "add a geotransform, e.g. with gdal_translate -a_ullr");
  const double determinant = geo_[1] * geo_[5] - geo_[2] * geo_[4];
  LGIW_VALIDATE(std::isfinite(determinant) && determinant != 0, what_ + ": has a degenerate georeference",
                "its pixels have no area", "repair the geotransform, e.g. with gdal_translate -a_ullr");
  std::string unit = band->GetUnitType();
  std::transform(unit.begin(), unit.end(), unit.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  // "meters above mean sea level", too.
  const bool metres = unit.empty() || unit == "m" || unit == "m." || unit == "mtr" || unit.rfind("metre", 0) == 0 ||
                      unit.rfind("meter", 0) == 0;
  LGIW_VALIDATE(metres, what_ + ": has elevations in '" + band->GetUnitType() + "'", "everything here is in metres",
                "convert it, e.g. with gdal_calc.py, or mend its unit with gdal_edit.py -units m");
  if (const OGRSpatialReference* crs = data_->GetSpatialRef()) crs_ = *crs;
  if (!crs_.IsEmpty()) {
    const double vertical_unit = crs_.IsCompound() ? crs_.GetTargetLinearUnits("VERT_CS") : 1;
    LGIW_VALIDATE(std::abs(vertical_unit - 1) < 1e-9, what_ + ": its vertical CRS is not in metres",
                  text("its unit is %.9g m; everything here is in metres", vertical_unit),
                  "convert it, e.g. with gdalwarp to a metric vertical CRS");
    crs_.StripVertical();
    crs_.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  }
  // PROJ takes off turn after turn from degrees, for ever where a turn is less than their rounding.
  const int columns = data_->GetRasterXSize(), rows = data_->GetRasterYSize();
  const bool in_degrees = crs_.IsGeographic();
  for (int corner = 0; corner < 4; ++corner) {
    const auto [x, y] = at_pixel(geo_, corner % 2 * columns, corner / 2 * rows);
    LGIW_VALIDATE(std::hypot(x, y) <= (in_degrees ? 1000 : 1e9),
                  what_ + text(": one of its corners lies at %.8g, %.8g", x, y),
                  in_degrees ? "it is in degrees, and that is more than a turn" : "no map is that wide",
                  "repair the geotransform, e.g. with gdal_translate -a_ullr");
  }
  std::vector<std::string> files{path};
  char** list = data_->GetFileList();
  for (char** file = list; file && *file; ++file) files.push_back(*file);
  CSLDestroy(list);
  std::sort(files.begin() + 1, files.end());
  for (std::size_t k = 0; k < files.size(); ++k)
    if (std::find(files.begin(), files.begin() + k, files[k]) == files.begin() + k &&
        std::filesystem::is_regular_file(files[k]))
      provenance.add_input(files[k]);
}

std::array<double, 2> RasterSource::middle() const {
  return at_pixel(geo_, 0.5 * data_->GetRasterXSize(), 0.5 * data_->GetRasterYSize());
}

bool RasterSource::place(const OGRSpatialReference& case_crs) {
  case_crs_ = case_crs;
  const bool assumed = !has_crs();
  const int columns = data_->GetRasterXSize(), rows = data_->GetRasterYSize();
  if (assumed) {
    const auto corner = at_pixel(geo_, 0, 0), opposite = at_pixel(geo_, columns, rows);
    const bool like_degrees = std::abs(corner[0]) <= 360 && std::abs(opposite[0]) <= 360 && std::abs(corner[1]) <= 90 &&
                              std::abs(opposite[1]) <= 90 && std::abs(geo_[1]) < 0.1 && case_crs.IsProjected();
    LGIW_VALIDATE(!like_degrees, what_ + ": has no CRS and its coordinates look like degrees",
                  text("from %g, %g with pixels of %g", corner[0], corner[1], geo_[1]),
                  "give it its CRS, e.g. with gdal_edit.py -a_srs EPSG:4326");
    crs_ = case_crs;
  }
  // Names and authorities of the same CRS differ from file to file (ESRI's .prj above all): numbers decide.
  const Transformation forward = transformation(crs_, case_crs_, what_);
  const double side = std::sqrt(std::abs(geo_[1] * geo_[5] - geo_[2] * geo_[4]));
  extent_ = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  same_crs_ = !crs_.IsGeographic();
  constexpr int steps = 20;  // along each edge, since straight edges come out curved
  for (int a = 0; a <= steps; ++a)
    for (int b = 0; b <= steps; ++b) {
      if (a % steps && b % steps) continue;
      const auto [x, y] = at_pixel(geo_, double(columns) * a / steps, double(rows) * b / steps);
      double u = x, v = y;
      LGIW_VALIDATE(forward->Transform(1, &u, &v) && std::isfinite(u) && std::isfinite(v),
                    what_ + ": cannot be brought into the case's CRS",
                    text("its edge point %.8g, %.8g has no image", x, y),
                    "check the CRS of the raster and terrain.crs");
      if (same_crs_ && std::hypot(u - x, v - y) > 1e-3 * side) same_crs_ = false;
      extent_ = {std::min(extent_[0], u), std::min(extent_[1], v), std::max(extent_[2], u), std::max(extent_[3], v)};
    }
  const double width = std::hypot(geo_[1], geo_[4]), height = std::hypot(geo_[2], geo_[5]);
  if (same_crs_) {
    const auto first = at_pixel(geo_, 0, 0);
    extent_ = {first[0], first[1], first[0], first[1]};
    for (const auto& [c, r] : {std::pair{columns, 0}, std::pair{0, rows}, std::pair{columns, rows}}) {
      const auto [x, y] = at_pixel(geo_, c, r);
      extent_ = {std::min(extent_[0], x), std::min(extent_[1], y), std::max(extent_[2], x), std::max(extent_[3], y)};
    }
    pixel_ = std::min(width, height);
    aligned_ = geo_[2] == 0 && geo_[4] == 0 && geo_[1] > 0 && std::abs(width - height) < 1e-6 * width;
  } else {
    // The metric size of the pixel in the middle.
    const double c = 0.5 * columns, r = 0.5 * rows;
    double x[3], y[3];
    for (int k = 0; k < 3; ++k) {  // the pixel's corner and its two neighbours
      const auto [u, v] = at_pixel(geo_, c + (k == 1), r + (k == 2));
      x[k] = u, y[k] = v;
    }
    LGIW_VALIDATE(forward->Transform(3, x, y), what_ + ": cannot be brought into the case's CRS", QuietGdal::message(),
                  "check the CRS of the raster and terrain.crs");
    pixel_ = std::min(std::hypot(x[1] - x[0], y[1] - y[0]), std::hypot(x[2] - x[0], y[2] - y[0]));
    LGIW_VALIDATE(pixel_ > 0 && std::isfinite(pixel_), what_ + ": cannot be brought into the case's CRS",
                  "its pixels have no size there", "check the CRS of the raster and terrain.crs");
  }
  return assumed;
}

std::array<double, 2> RasterSource::to_case(double x, double y) const {
  if (!same_crs_) transformation(crs_, case_crs_, what_)->Transform(1, &x, &y);
  return {x, y};
}

RasterGrid RasterSource::Window::shape() const {
  return RasterGrid(std::size_t((columns + factor - 1) / factor), std::size_t((rows + factor - 1) / factor), 0, 0, 1);
}

RasterSource::Window RasterSource::window_around(const RasterGrid& grid) const {
  double low_x = grid.x0 - grid.dx, low_y = grid.y0 - grid.dx;
  double high_x = grid.x0 + double(grid.nx) * grid.dx, high_y = grid.y0 + double(grid.ny) * grid.dx;
  if (!same_crs_) {
    const Transformation backward = transformation(case_crs_, crs_, what_);
    double a, b, c, d;
    LGIW_VALIDATE(backward->TransformBounds(low_x, low_y, high_x, high_y, &a, &b, &c, &d, 21),
                  what_ + ": the window has no image in its CRS", QuietGdal::message(),
                  "check terrain.window and terrain.crs");
    low_x = a, low_y = b, high_x = c, high_y = d;
  }
  double inverse[6];
  LGIW_VALIDATE(GDALInvGeoTransform(const_cast<double*>(geo_.data()), inverse),
                what_ + ": has a degenerate georeference", "its pixels have no area",
                "repair the geotransform, e.g. with gdal_translate -a_ullr");
  double columns[2] = {HUGE_VAL, -HUGE_VAL}, rows[2] = {HUGE_VAL, -HUGE_VAL};
  for (double x : {low_x, high_x})
    for (double y : {low_y, high_y}) {
      const double c = inverse[0] + x * inverse[1] + y * inverse[2], r = inverse[3] + x * inverse[4] + y * inverse[5];
      columns[0] = std::min(columns[0], c), columns[1] = std::max(columns[1], c);
      rows[0] = std::min(rows[0], r), rows[1] = std::max(rows[1], r);
    }
  constexpr double margin = 3;  // pixels for the resampling kernel
  const double n_columns = data_->GetRasterXSize(), n_rows = data_->GetRasterYSize();
  const double c0 = std::clamp(std::floor(columns[0] - margin), 0.0, n_columns);
  const double c1 = std::clamp(std::ceil(columns[1] + margin), 0.0, n_columns);
  const double r0 = std::clamp(std::floor(rows[0] - margin), 0.0, n_rows);
  const double r1 = std::clamp(std::ceil(rows[1] + margin), 0.0, n_rows);
  Window window{int(c0), int(r0), int(std::max(0.0, c1 - c0)), int(std::max(0.0, r1 - r0)), 1};
  // Twice the limit: the bounding box of a turned window is larger than the window.
  while (double(window.columns) * window.rows > 2.0 * double(max_cells) * window.factor * window.factor)
    ++window.factor;
  return window;
}

std::vector<double> RasterSource::read(const Window& window) const {
  const RasterGrid shape = window.shape();
  std::vector<double> values(shape.size());
  GDALRasterBand* band = data_->GetRasterBand(1);
  GDALRasterIOExtraArg extra;
  INIT_RASTERIO_EXTRA_ARG(extra);
  extra.eResampleAlg = GRIORA_Average;
  CPLErrorReset();
  const int columns = int(shape.nx), rows = int(shape.ny);
  const bool read = band->RasterIO(GF_Read, window.column, window.row, window.columns, window.rows, values.data(),
                                   columns, rows, GDT_Float64, 0, 0, &extra) == CE_None;
  LGIW_VALIDATE(read, what_ + ": cannot be read to its end", QuietGdal::message(),
                "the file is damaged or truncated; fetch it again");
  int has_void = FALSE;
  const double declared = band->GetNoDataValue(&has_void);
  const bool single = band->GetRasterDataType() == GDT_Float32;
  const double scale = band->GetScale(), offset = band->GetOffset();
  // A band of alpha is the mask of every type; GDAL itself takes it for one where it holds bytes.
  GDALRasterBand* mask_band = band->GetMaskFlags() & GMF_PER_DATASET ? band->GetMaskBand() : nullptr;
  for (int k = 2; k <= data_->GetRasterCount() && !mask_band; ++k)
    if (data_->GetRasterBand(k)->GetColorInterpretation() == GCI_AlphaBand) mask_band = data_->GetRasterBand(k);
  std::vector<uint8_t> mask;
  if (mask_band) {
    mask.resize(values.size());
    const bool masked = mask_band->RasterIO(GF_Read, window.column, window.row, window.columns, window.rows,
                                            mask.data(), columns, rows, GDT_Byte, 0, 0, nullptr) == CE_None;
    LGIW_VALIDATE(masked, what_ + ": its mask cannot be read", QuietGdal::message(), "fetch the file again");
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    double& z = values[k];
    const bool is_void = has_void && (z == declared || (single && float(z) == float(declared)));
    if (is_void || (!mask.empty() && mask[k] == 0)) {
      z = nan;
      continue;
    }
    if (std::isnan(z)) continue;
    // Lower than any sea floor that a wave comes from, but not than all of them.
    const bool usual_void = z == -9999;
    z = z * scale + offset;
    if (usual_void || !(z > -12000 && z < 9000)) {
      const auto [x, y] = at_pixel(geo_, window.column + (double(k % shape.nx) + 0.5) * window.factor,
                                   window.row + (double(k / shape.nx) + 0.5) * window.factor);
      throw InputError(what_ + text(": has %g m at %.8g, %.8g", z, x, y),
                       usual_void ? "most rasters mean no-data by it, and this one does not declare it"
                                  : "no place on Earth is so high or low; this looks like no-data that is not declared",
                       text("declare it, e.g. with gdal_edit.py -a_nodata %g", z));
    }
  }
  return values;
}

std::vector<double> RasterSource::sample(const RasterGrid& grid, double spike_threshold, bool remove_spikes,
                                         Spikes* spikes, double void_value) {
  std::vector<double> result(grid.size(), void_value);
  const Window window = window_around(grid);
  if (window.columns == 0 || window.rows == 0) return result;
  std::vector<double> native = read(window);
  RasterGrid shape = window.shape();
  if (spike_threshold > 0) {
    // Of neighbours; cells that are averages of several lie further apart than the source's own.
    const double threshold = spike_threshold * window.factor;
    const Spikes found = find_spikes(native, int(shape.nx), int(shape.ny), threshold, remove_spikes);
    if (spikes) {
      *spikes = found;
      spikes->threshold = threshold;
      const auto place =
          at_pixel(geo_, window.column + (found.x + 0.5) * window.factor, window.row + (found.y + 0.5) * window.factor);
      const auto [x, y] = to_case(place[0], place[1]);
      spikes->x = x, spikes->y = y;
    }
  }
  if (!std::isnan(void_value))
    for (double& z : native)
      if (std::isnan(z)) z = void_value;

  const double column = (grid.x0 - geo_[0]) / geo_[1] - 0.5, row = (grid.y0 - geo_[3]) / geo_[5] - 0.5;
  const bool coincide = aligned_ && window.factor == 1 && std::abs(grid.dx - pixel_) < 1e-9 * pixel_ &&
                        std::abs(column - std::round(column)) < 1e-3 && std::abs(row - std::round(row)) < 1e-3;
  if (coincide) {
    const int step = geo_[5] < 0 ? -1 : 1;  // of the stored row for one row north
    for (std::size_t j = 0; j < grid.ny; ++j)
      for (std::size_t i = 0; i < grid.nx; ++i) {
        const int64_t c = std::llround(column) + int64_t(i) - window.column;
        const int64_t r = std::llround(row) + step * int64_t(j) - window.row;
        if (c >= 0 && r >= 0 && c < int64_t(shape.nx) && r < int64_t(shape.ny))
          result[j * grid.nx + i] = native[std::size_t(r) * shape.nx + std::size_t(c)];
      }
    return result;
  }

  // memory_raster() takes the south row first and sets a north-up transform: hand the rows over as they are stored.
  GDALDatasetUniquePtr source(GetGDALDriverManager()->GetDriverByName("MEM")->Create("", int(shape.nx), int(shape.ny),
                                                                                     1, GDT_Float64, nullptr));
  const auto first = at_pixel(geo_, window.column, window.row);
  // The last block of an averaged window may reach beyond it: GDAL stretches, so the cell size follows from the counts.
  const double wide = double(window.columns) / double(shape.nx), high = double(window.rows) / double(shape.ny);
  double geo[6] = {first[0], geo_[1] * wide, geo_[2] * high, first[1], geo_[4] * wide, geo_[5] * high};
  source->SetGeoTransform(geo);
  source->SetSpatialRef(same_crs_ ? &case_crs_ : &crs_);
  GDALRasterBand* band = source->GetRasterBand(1);
  band->SetNoDataValue(nan);
  bool done = band->RasterIO(GF_Write, 0, 0, int(shape.nx), int(shape.ny), native.data(), int(shape.nx), int(shape.ny),
                             GDT_Float64, 0, 0, nullptr) == CE_None;
  native = {};
  const std::string crs = wkt_of(case_crs_);
  std::vector<std::string> words = {"-of",
                                    "MEM",
                                    "-ot",
                                    "Float64",
                                    "-r",
                                    "bilinear",
                                    "-et",
                                    "0",
                                    "-srcnodata",
                                    "nan",
                                    "-dstnodata",
                                    "nan",
                                    "-t_srs",
                                    crs,
                                    "-te",
                                    text("%.17g", grid.x0 - 0.5 * grid.dx),
                                    text("%.17g", grid.y0 - 0.5 * grid.dx),
                                    text("%.17g", grid.x0 + (double(grid.nx) - 0.5) * grid.dx),
                                    text("%.17g", grid.y0 + (double(grid.ny) - 0.5) * grid.dx),
                                    "-ts",
                                    text("%zu", grid.nx),
                                    text("%zu", grid.ny)};
  // Left alone, GDAL takes a turned source for a finer one and smooths it.
  if (grid.dx < 1.5 * pixel_ * window.factor) words.insert(words.end(), {"-wo", "XSCALE=1", "-wo", "YSCALE=1"});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  GDALWarpAppOptions* options = GDALWarpAppOptionsNew(arguments.data(), nullptr);
  GDALDatasetH input = source.get();
  int misused = 0;
  GDALDatasetUniquePtr warped(
      options ? static_cast<GDALDataset*>(GDALDataset::FromHandle(GDALWarp("", nullptr, 1, &input, options, &misused)))
              : nullptr);
  GDALWarpAppOptionsFree(options);
  if (warped) result = read_north_up<double>(*warped, grid, GDT_Float64);
  done = done && warped && result.size() == grid.size();
  if (!done) throw WorkError(what_ + ": cannot be resampled", QuietGdal::message(), "check its CRS and georeference");
  if (!std::isnan(void_value))
    for (double& z : result)
      if (std::isnan(z)) z = void_value;
  return result;
}

OGRSpatialReference case_crs_from_text(const Case& c, const RasterSource& first_source) {
  const std::string what = at_key(c, "terrain.crs") + "terrain.crs '" + c.terrain.crs + "'";
  OGRSpatialReference crs;
  LGIW_VALIDATE(crs.SetFromUserInput(c.terrain.crs.c_str()) == OGRERR_NONE, what + " is not a CRS",
                QuietGdal::message(), "name one like EPSG:32611");
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  crs.StripVertical();
  require_metric(crs, what, first_source.has_crs() ? utm_zone(first_source.middle(), first_source.crs()) : "");
  return crs;
}

OGRSpatialReference case_crs_from_source(const RasterSource& source) {
  LGIW_VALIDATE(source.has_crs(), source.what() + ": names no CRS",
                "its coordinates could be in metres of any zone or in degrees",
                "set terrain.crs if it is in the case's CRS, or put a .prj beside it");
  require_metric(source.crs(), source.what() + ": its CRS", utm_zone(source.middle(), source.crs()));
  return source.crs();
}

CellRange largest_valid_range(const std::vector<double>& values, std::size_t nx, std::size_t ny) {
  // Largest rectangle under a histogram, row by row: height[i] counts valid cells from this row southward.
  CellRange best;
  std::size_t best_area = 0;
  std::vector<std::size_t> height(nx + 1, 0), stack;
  for (std::size_t j = 0; j < ny; ++j) {
    for (std::size_t i = 0; i < nx; ++i) height[i] = std::isnan(values[j * nx + i]) ? 0 : height[i] + 1;
    stack.clear();
    for (std::size_t i = 0; i <= nx; ++i) {  // height[nx] == 0 closes what is open
      while (!stack.empty() && height[stack.back()] >= height[i]) {
        const std::size_t tall = height[stack.back()];
        stack.pop_back();
        const std::size_t left = stack.empty() ? 0 : stack.back() + 1;
        if (tall * (i - left) > best_area) best_area = tall * (i - left), best = {left, j + 1 - tall, i - 1, j};
      }
      stack.push_back(i);
    }
  }
  return best;
}

void fill_voids(std::vector<double>& values, const RasterGrid& grid) {
  std::vector<uint8_t> valid(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) valid[k] = !std::isnan(values[k]);
  // GDALFillNodata works in float: relative to the first valid value little is lost, and valid cells are not touched.
  const auto datum = values[std::size_t(std::find(valid.begin(), valid.end(), 1) - valid.begin())];
  std::vector<float> relative(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) relative[k] = valid[k] ? float(values[k] - datum) : 0.0f;
  const GDALDatasetUniquePtr target = memory_raster(grid, GDT_Float32, relative.data(), "");
  const GDALDatasetUniquePtr mask = memory_raster(grid, GDT_Byte, valid.data(), "");
  char option[] = "TEMP_FILE_DRIVER=MEM";
  char* options[] = {option, nullptr};
  const double reach = double(std::max(grid.nx, grid.ny));
  if (GDALFillNodata(target->GetRasterBand(1), mask->GetRasterBand(1), reach, 0, 3, options, nullptr, nullptr) !=
      CE_None)
    throw WorkError("cannot fill the voids of the terrain", QuietGdal::message(), "cut them off with terrain.window");
  relative = read_north_up<float>(*target, grid, GDT_Float32);
  std::vector<std::size_t> voids;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (!valid[k]) values[k] = datum + relative[k], voids.push_back(k);
  if (voids.size() <= 500'000) relax(values, grid, voids);
}

std::vector<float> distance_to_void(const std::vector<double>& values, const RasterGrid& grid, double limit) {
  std::vector<uint8_t> valid(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) valid[k] = !std::isnan(values[k]);
  const GDALDatasetUniquePtr source = memory_raster(grid, GDT_Byte, valid.data(), "");
  const GDALDatasetUniquePtr target = memory_raster(grid, GDT_Float32, nullptr, "");
  std::string words[] = {"VALUES=0", "DISTUNITS=PIXEL", text("MAXDIST=%.17g", limit), text("NODATA=%.17g", limit)};
  char* options[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
  if (GDALComputeProximity(source->GetRasterBand(1), target->GetRasterBand(1), options, nullptr, nullptr) != CE_None)
    throw WorkError("cannot find the edge of a terrain source", QuietGdal::message(),
                    "set its blend to a larger width");
  return read_north_up<float>(*target, grid, GDT_Float32);
}

}  // namespace lgiw::detail
