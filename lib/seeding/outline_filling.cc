#include "seeding/outline_filling.hh"

#include <algorithm>
#include <cmath>

namespace lgiw {

namespace {

constexpr int strips = 32;              // of a column of soil, for its area
constexpr double most_rounding = 0.75;  // of a particle: how far a column's count may be from its height

}  // namespace

OutlineFilling::OutlineFilling(const MapCells& cells, const BedSurface& bed, const PhaseColumns& columns)
    : soil_(std::size_t(cells.nx)), rigid_(columns.outlines().size()) {
  for (std::size_t k = 0; k < columns.outlines().size(); ++k) {
    const Outline& outline = columns.outlines()[k];
    if (outline.rigid())
      rigid_[k] = tile_polygon(outline.polygon, cells.dp, [&](double x) { return bed.height(x, cells.y(0)); });
    else
      fill_soil(cells, bed, columns, int(k));
  }
}

void OutlineFilling::fill_soil(const MapCells& cells, const BedSurface& bed, const PhaseColumns& columns, int outline) {
  const double dp = cells.dp, y = cells.y(0);
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const Point2& p : columns.outlines()[std::size_t(outline)].polygon)
    low = std::min(low, p[0]), high = std::max(high, p[0]);
  low = std::max(low, cells.x_low), high = std::min(high, cells.x_high());
  if (high <= low) return;
  const auto count = std::max<int64_t>(1, std::llround((high - low) / dp));
  const double width = (high - low) / double(count);
  std::vector<PhaseInterval> column;
  // The stretches of this body over x.
  const auto stretches = [&](double x) {
    columns.at(x, y, bed.height(x, y), column);
    std::erase_if(column, [outline](const PhaseInterval& s) { return s.outline != outline; });
  };
  std::vector<SoilPoint> points;
  double area = 0, owed = 0;  // owed: particles, by the columns so far
  for (int64_t n = 0; n < count; ++n) {
    const double west = low + double(n) * width;
    double strip_area = 0;
    for (int s = 0; s < strips; ++s) {
      stretches(west + (s + 0.5) * width / strips);
      for (const PhaseInterval& piece : column) strip_area += (piece.high - piece.low) * width / strips;
    }
    area += strip_area, owed += strip_area / (dp * dp);
    const double x = west + 0.5 * width;
    stretches(x);
    for (const PhaseInterval& piece : column) {
      const double height = piece.high - piece.low, layers = height * width / (dp * dp);
      const double least = std::max(0.0, std::ceil(layers - most_rounding)), most = std::floor(layers + most_rounding);
      const double wanted = column.size() > 1 ? layers : owed;  // several stretches share what is owed by height
      const double number = std::clamp(std::round(wanted), least, std::max(least, most));
      owed -= number;
      for (double k = 0; k < number; ++k) points.push_back({x, piece.low + (k + 0.5) * height / number, 0});
    }
  }
  for (SoilPoint& p : points) {
    p.area = area / double(points.size());
    const auto i = int64_t(std::floor((p.x - cells.x_low) / dp));
    soil_[std::size_t(std::clamp<int64_t>(i, 0, cells.nx - 1))].push_back(p);
  }
}

}  // namespace lgiw
