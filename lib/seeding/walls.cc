#include "seeding/walls.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lgiw {

namespace {

constexpr double layer_tolerance = 0.25;  // of a layer, see Walls
constexpr double overshoot_layers = 8;    // of dp: walls above the top of soil at rest

/// Elevation that water may run up to, as reachable_nodes() has it for terrain; in a laboratory tank as far above the
/// still water as the tank is deep.
double runup_level(const Case& c, const TerrainModel& model, double highest_fluid) {
  double allowance = c.terrain.runup_allowance;
  if (allowance <= 0) {
    allowance = c.terrain.profile.empty() ? 0.5 * (highest_fluid - model.still_water_level) : model.max_water_depth;
    allowance = std::max(allowance, 10 * c.dp);
  }
  return model.still_water_level + allowance;
}

}  // namespace

Walls::Walls(const Case& c, const TerrainModel& model, const MapCells& cells, const BedSurface& bed, double z_phase,
             double highest_fluid)
    : cells_(cells),
      bed_(bed),
      thickness_(2 * c.numerics.h_over_dp * c.dp),
      z_phase_(z_phase),
      soil_margin_(overshoot_layers * c.dp),
      side_wall_{c.terrain.west != Side::open, c.terrain.east != Side::open,
                 c.terrain.south != Side::open && !cells.two_d, c.terrain.north != Side::open && !cells.two_d} {
  const bool analytic = !c.terrain.profile.empty();
  side_top_ = std::isnan(highest_fluid) ? bed.highest() : highest_fluid + soil_margin_;
  if (c.water.present && !std::isnan(model.still_water_level))
    side_top_ =
        analytic ? std::max(side_top_, runup_level(c, model, highest_fluid)) : runup_level(c, model, highest_fluid);
  if (c.water.present && !c.water.bodies.empty())  // a body of water that falls may splash up to twice its height
    side_top_ = std::max(side_top_, highest_fluid + (highest_fluid - bed.lowest()));
  if (c.terrain.wall_top != 0) side_top_ = c.terrain.wall_top - model.origin[2], fixed_top_ = true;

  halo_ = cells.rim + 1;
  const int64_t halo_y = cells.two_d ? 0 : halo_, width = cells.width() + 2 * halo_;
  const int64_t rows = cells.ny + 2 * (cells.rim_y + halo_y);
  centre_.resize(std::size_t(width * rows));
#pragma omp parallel for schedule(static)
  for (int64_t row = 0; row < rows; ++row)
    for (int64_t k = 0; k < width; ++k) {
      const double x = cells.x(k - halo_ - cells.rim), y = cells.y(row - halo_y - cells.rim_y);
      const std::array<double, 2> slope = bed.gradient(x, y);
      centre_[std::size_t(row * width + k)] = {bed.height(x, y), {float(slope[0]), float(slope[1])}};
    }

  reachable_.assign(std::size_t(cells.nx * cells.ny), 1);
  if (analytic) {
    for (int64_t i = 0; i < cells.nx; ++i) {
      // Sloshing does not climb higher than the side walls; the profile is the same for all y.
      double lowest = std::numeric_limits<double>::infinity();
      visit_surface(cells.x(i), cells.y(0), thickness_,
                    [&](double, double, double z) { lowest = std::min(lowest, z); });
      if (lowest > side_top_)
        for (int64_t j = 0; j < cells.ny; ++j) reachable_[std::size_t(j * cells.nx + i)] = 0;
    }
    return;
  }
  const std::vector<uint8_t> nodes = reachable_nodes(model, c);
  const HeightField& f = model.ground;
  const auto nearest = [&](double at, double start, std::size_t count) {
    return std::size_t(std::clamp(std::llround((at - start) / f.dx), 0LL, (long long)(count)-1));
  };
  for (int64_t j = 0; j < cells.ny; ++j)
    for (int64_t i = 0; i < cells.nx; ++i)
      reachable_[std::size_t(j * cells.nx + i)] =
          nodes[nearest(cells.y(j), f.y0, f.ny) * f.nx + nearest(cells.x(i), f.x0, f.nx)];
}

std::array<int64_t, 2> Walls::subdivision(const std::array<double, 2>& gradient, bool two_d) {
  const auto parts = [](double slope) {
    return std::max<int64_t>(1, int64_t(std::ceil(std::sqrt(1 + slope * slope) - 0.25 - 1e-9)));
  };
  return {parts(gradient[0]), two_d ? 1 : parts(gradient[1])};
}

/// Calls visit(dx, dy, z) for points of the surface around (x, y): of each map cell within `reach` its centre and its
/// nearest point, whose height follows from the slope within the cell. So planes stay planes and steps steps.
template <class Visit>
void Walls::visit_surface(double x, double y, double reach, const Visit& visit) const {
  const double dp = cells_.dp, half = 0.5 * dp;
  const int64_t halo_y = cells_.two_d ? 0 : halo_, width = cells_.width() + 2 * halo_;
  const int64_t rows = cells_.ny + 2 * (cells_.rim_y + halo_y);
  const int64_t shift = halo_ + cells_.rim, shift_y = halo_y + cells_.rim_y;
  const auto range = [&](double at, double start, int64_t offset, int64_t count) {
    const int64_t low = int64_t(std::floor((at - reach - start) / dp)) + offset;
    const int64_t high = int64_t(std::floor((at + reach - start) / dp)) + offset;
    return std::pair{std::max<int64_t>(0, low), std::min(count - 1, high)};
  };
  const auto [i_low, i_high] = range(x, cells_.x_low, shift, width);
  const auto [j_low, j_high] = cells_.two_d ? std::pair<int64_t, int64_t>{0, 0} : range(y, cells_.y_low, shift_y, rows);
  for (int64_t j = j_low; j <= j_high; ++j) {
    const double dy = cells_.y(j - shift_y) - y, near_y = dy - std::clamp(dy, -half, half);
    for (int64_t i = i_low; i <= i_high; ++i) {
      const double dx = cells_.x(i - shift) - x, near_x = dx - std::clamp(dx, -half, half);
      const Cell& cell = centre_[std::size_t(j * width + i)];
      if (near_x * near_x + near_y * near_y >= reach * reach) continue;
      visit(near_x, near_y, cell.height + cell.slope[0] * (near_x - dx) + cell.slope[1] * (near_y - dy));
      if (dx * dx + dy * dy < reach * reach) visit(dx, dy, cell.height);
    }
  }
}

/// Lowest elevation over (x, y) that is nearer than the wall's thickness to a point of the surface.
double Walls::bottom(double x, double y, double height) const {
  double lowest = height - thickness_;
  visit_surface(x, y, thickness_, [&](double dx, double dy, double z) {
    lowest = std::min(lowest, z - std::sqrt(std::max(0.0, thickness_ * thickness_ - dx * dx - dy * dy)));
  });
  return lowest;
}

/// Normal of a particle of which the open space beside a cliff is clearly nearer than the surface above it (`depth`
/// across the bed): the direction to that space, averaged with weights that favour the nearest. Else `otherwise`.
std::array<double, 3> Walls::towards_open_space(const std::array<double, 3>& p, double depth,
                                                const std::array<double, 3>& otherwise) const {
  std::array<double, 3> sum{0, 0, 0};
  double nearest = depth;
  visit_surface(p[0], p[1], thickness_ + cells_.dp, [&](double dx, double dy, double z) {
    const double dz = std::max(0.0, z - p[2]), square = dx * dx + dy * dy + dz * dz;
    if (square <= 0) return;
    const double distance = std::sqrt(square), weight = 1 / (square * square * square * square);
    nearest = std::min(nearest, distance);
    sum[0] += weight * dx / distance, sum[1] += weight * dy / distance, sum[2] += weight * dz / distance;
  });
  const double length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
  if (nearest > 0.8 * depth || length <= 0) return otherwise;
  return {sum[0] / length, sum[1] / length, sum[2] / length};
}

bool Walls::reachable(int64_t i, int64_t j) const {
  i = std::clamp<int64_t>(i, 0, cells_.nx - 1), j = std::clamp<int64_t>(j, 0, cells_.ny - 1);
  return reachable_[std::size_t(j * cells_.nx + i)] != 0;
}

int64_t Walls::column(int64_t i, int64_t j, std::vector<WallParticle>& particles) const {
  const std::size_t before = particles.size();
  bed_column(i, j, particles);
  if (!cells_.inside(i, j)) side_column(i, j, particles);
  if (reachable(i, j)) return 0;
  const int64_t left_out = int64_t(particles.size() - before);
  particles.resize(before);
  return left_out;
}

void Walls::bed_column(int64_t i, int64_t j, std::vector<WallParticle>& particles) const {
  const double dp = cells_.dp, dz_tolerance = layer_tolerance;
  const std::array<int64_t, 2> parts = subdivision(bed_.gradient(cells_.x(i), cells_.y(j)), cells_.two_d);
  const double step_x = dp / double(parts[0]), step_y = dp / double(parts[1]);
  const int64_t plain_layers = int64_t(std::ceil(thickness_ / dp - 1e-9));
  for (int64_t b = 0; b < parts[1]; ++b)
    for (int64_t a = 0; a < parts[0]; ++a) {
      const double x = cells_.x(i) + (double(a) + 0.5) * step_x - 0.5 * dp;
      const double y = cells_.two_d ? 0.0 : cells_.y(j) + (double(b) + 0.5) * step_y - 0.5 * dp;
      const double height = bed_.height(x, y);
      const std::array<double, 2> slope = bed_.gradient(x, y);
      const double stretch = std::sqrt(1 + slope[0] * slope[0] + slope[1] * slope[1]);
      const int64_t layers =
          std::max(plain_layers, int64_t(std::ceil((height - bottom(x, y, height)) / (dp * stretch) - dz_tolerance)));
      const std::array<double, 3> normal{-slope[0] / stretch, -slope[1] / stretch, 1 / stretch};
      const double volume = step_x * (cells_.two_d ? 1.0 : step_y) * dp * stretch;
      for (int64_t k = 0; k < layers; ++k) {
        const double depth = (double(k) + 0.5) * dp;
        const std::array<double, 3> p{x, y, height - depth * stretch};
        particles.push_back({p, layers > plain_layers ? towards_open_space(p, depth, normal) : normal, volume, 0});
      }
    }
}

void Walls::side_column(int64_t i, int64_t j, std::vector<WallParticle>& particles) const {
  std::array<double, 3> normal{0, 0, 0};
  if (i < 0 && side_wall_[0]) normal[0] = 1;
  if (i >= cells_.nx && side_wall_[1]) normal[0] = -1;
  if (j < 0 && side_wall_[2]) normal[1] = 1;
  if (j >= cells_.ny && side_wall_[3]) normal[1] = -1;
  const double length = std::hypot(normal[0], normal[1]);
  if (length == 0) return;
  normal[0] /= length, normal[1] /= length;

  const double dp = cells_.dp, x = cells_.x(i), y = cells_.y(j), foot = bed_.height(x, y);
  // Soil can reach banks above the water's run-up: there the wall follows the bed.
  const double top = fixed_top_ ? side_top_ : std::max(side_top_, foot + soil_margin_);
  const double area = cells_.two_d ? dp : dp * dp;
  const int64_t first = int64_t(std::ceil((foot - z_phase_) / dp - 0.5 - 1e-6));
  for (int64_t k = first;; ++k) {
    const double centre = z_phase_ + (double(k) + 0.5) * dp;
    if (centre >= top) break;
    const double low = k == first ? foot : centre - 0.5 * dp, high = centre + 0.5 * dp;
    particles.push_back({{x, y, 0.5 * (low + high)}, normal, area * (high - low), 1});
  }
}

}  // namespace lgiw
