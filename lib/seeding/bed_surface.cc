#include "seeding/bed_surface.hh"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.hh"

namespace lgiw {

namespace {

constexpr double most_columns = 2e8;  // about 4 GB
constexpr double steepest_slope = 8;  // of a profile, within less than dp; beyond it is a step

std::vector<Point2> local_profile(const Case& c, const TerrainModel& model, const MapCells& cells) {
  std::vector<Point2> points = c.terrain.profile;
  for (Point2& p : points) p[0] -= model.origin[0], p[1] -= model.origin[2];
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    Point2 &a = points[k], &b = points[k + 1];
    const double run = b[0] - a[0], rise = std::abs(b[1] - a[1]);
    if (run >= c.dp || rise <= steepest_slope * run) continue;
    const double middle = 0.5 * (a[0] + b[0]);
    const double side = cells.x_low + std::round((middle - cells.x_low) / c.dp) * c.dp;
    a[0] = b[0] = side;
  }
  for (std::size_t k = 1; k < points.size(); ++k) points[k][0] = std::max(points[k][0], points[k - 1][0]);
  return points;
}

}  // namespace

MapCells map_cells(const Case& c, const TerrainModel& model) {
  MapCells cells;
  cells.dp = c.dp;
  cells.two_d = c.dimension == 2;
  // The nodes of a DEM are the centres of its cells: the outermost cells belong to the domain as wholes.
  const double half = c.terrain.profile.empty() ? 0.5 * model.bed.dx : 0.0;
  const double x_high = model.domain[2] + half, y_high = model.domain[3] + half;
  cells.x_low = model.domain[0] - half, cells.y_low = model.domain[1] - half;
  cells.east_moved = cells.x_low + c.dp * std::round((x_high - cells.x_low) / c.dp) - x_high;
  cells.north_moved = cells.two_d ? 0 : cells.y_low + c.dp * std::round((y_high - cells.y_low) / c.dp) - y_high;
  const auto cells_between = [&](double low, double high) {
    return std::max<int64_t>(1, std::llround((high - low) / c.dp));
  };
  cells.nx = cells_between(cells.x_low, x_high);
  cells.ny = cells.two_d ? 1 : cells_between(cells.y_low, y_high);
  cells.rim = int64_t(std::ceil(2 * c.numerics.h_over_dp - 1e-9));
  cells.rim_y = cells.two_d ? 0 : cells.rim;
  if (cells.two_d) cells.y_low = 0;
  const double columns = double(cells.nx) * double(cells.ny);
  LGIW_VALIDATE(columns < most_columns, "particle_spacing " + std::to_string(c.dp) + " m is too small for this terrain",
                "the map alone has " + std::to_string(int64_t(columns)) + " columns of particles, at most " +
                    std::to_string(int64_t(most_columns)) + " can be held",
                "Choose a larger spacing or a smaller terrain.window");
  return cells;
}

BedSurface::BedSurface(const Case& c, const TerrainModel& model, const MapCells& cells)
    : field_(&model.bed),
      x_min_(cells.x_low),
      x_max_(cells.x_high()),
      y_min_(cells.y_low),
      y_max_(cells.y_high()),
      half_width_(0.5 * c.dp * (1 - 1e-6)),
      two_d_(cells.two_d) {
  const bool carved = c.slide.present && c.slide.bodies.empty();  // then the bed is the slide's failure surface
  if (!c.terrain.profile.empty() && !carved) {
    profile_ = local_profile(c, model, cells);
    const auto by_height = [](const Point2& a, const Point2& b) { return a[1] < b[1]; };
    const auto [low, high] = std::minmax_element(profile_.begin(), profile_.end(), by_height);
    lowest_ = (*low)[1], highest_ = (*high)[1];
    return;
  }
  LGIW_VALIDATE(!model.bed.empty(), "no terrain", "the case has neither rasters nor a profile",
                "Give terrain.sources or terrain.profile.");
  const auto [low, high] = std::minmax_element(model.bed.z.begin(), model.bed.z.end());
  lowest_ = *low, highest_ = *high;
}

double BedSurface::height(double x, double y) const {
  x = std::clamp(x, x_min_, x_max_);
  if (profile_.empty()) return field_->height(x, std::clamp(y, y_min_, y_max_));
  const auto after =
      std::upper_bound(profile_.begin(), profile_.end(), x, [](double value, const Point2& p) { return value < p[0]; });
  if (after == profile_.begin()) return profile_.front()[1];
  if (after == profile_.end()) {
    // At the end of the profile; a step there belongs to the wall beyond it.
    std::size_t last = profile_.size() - 1;
    while (last > 0 && profile_[last - 1][0] >= profile_.back()[0]) --last;
    return profile_[last][1];
  }
  const Point2 &a = *(after - 1), &b = *after;
  return a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]);
}

std::array<double, 2> BedSurface::gradient(double x, double y) const {
  const double w = half_width_;
  const double along_x = (height(x + w, y) - height(x - w, y)) / (2 * w);
  if (two_d_ || !profile_.empty()) return {along_x, 0};
  return {along_x, (height(x, y + w) - height(x, y - w)) / (2 * w)};
}

}  // namespace lgiw
