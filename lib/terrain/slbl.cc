#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hh"
#include "terrain/slide_body.hh"

namespace lgiw::detail {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// The highest surface below which nothing is seen from the cells outside at more than `max_slope`, distances along the
/// 8 directions of the grid; -infinity without that limit.
std::vector<double> lower_bound(const HeightField& ground, const std::vector<uint8_t>& inside,
                                const SlideSurface::Slbl& parameters) {
  std::vector<double> bound(ground.z.size(), -HUGE_VAL);
  if (parameters.max_slope > 0) {
    const double drop = ground.dx * std::tan(parameters.max_slope * degree);
    const int64_t nx = int64_t(ground.nx);
    const int64_t steps[] = {-1, 1, -nx, nx, -nx - 1, -nx + 1, nx - 1, nx + 1};
    for (std::size_t k = 0; k < bound.size(); ++k)
      if (!inside[k]) bound[k] = ground.z[k];
    for (bool changed = true; changed;) {
      changed = false;
      // There and back, so that a bound crosses the slide within one round.
      for (std::size_t n = 0; n < 2 * bound.size(); ++n) {
        const std::size_t k = n < bound.size() ? n : 2 * bound.size() - 1 - n;
        if (!inside[k]) continue;
        for (int s = 0; s < 8; ++s) {
          const double z = bound[std::size_t(int64_t(k) + steps[s])] - drop * (s < 4 ? 1 : std::numbers::sqrt2);
          if (z > bound[k]) bound[k] = z, changed = true;
        }
      }
    }
  }
  for (std::size_t k = 0; k < bound.size(); ++k) {
    if (parameters.max_depth > 0) bound[k] = std::max(bound[k], ground.z[k] - parameters.max_depth);
    bound[k] = std::min(bound[k], ground.z[k]);
  }
  return bound;
}

}  // namespace

std::vector<double> sloping_local_base_level(const HeightField& ground, const std::vector<uint8_t>& inside,
                                             const SlideSurface::Slbl& parameters, double tolerance) {
  const int64_t nx = int64_t(ground.nx);
  std::vector<std::size_t> cells;
  std::size_t i0 = ground.nx, i1 = 0, j0 = ground.ny, j1 = 0;
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (std::size_t k = 0; k < inside.size(); ++k) {
    if (!inside[k]) continue;
    cells.push_back(k);
    const std::size_t i = k % ground.nx, j = k / ground.nx;
    LGIW_EXPECT(i > 0 && j > 0 && i + 1 < ground.nx && j + 1 < ground.ny);
    i0 = std::min(i0, i), i1 = std::max(i1, i), j0 = std::min(j0, j), j1 = std::max(j1, j);
    low = std::min(low, ground.z[k]), high = std::max(high, ground.z[k]);
  }
  std::vector<double> z = ground.z;
  if (cells.empty()) return z;
  const std::vector<double> bound = lower_bound(ground, inside, parameters);
  const bool eight = parameters.neighbours == 8;
  const double extent = double(std::min(i1 - i0, j1 - j0) + 2);
  const double relaxation = 2 / (1 + std::sin(std::numbers::pi / extent));  // optimal for a rectangle of that width
  const double accuracy = std::max(1e-4 * std::abs(tolerance), 1e-9 * (high - low + std::abs(high))) * (2 - relaxation);
  const int64_t most_sweeps = 1000 + 100 * int64_t(extent);
  for (int64_t sweep = 0;; ++sweep) {
    if (sweep == most_sweeps)
      throw WorkError("the sloping local base level does not converge",
                      text("after %lld sweeps", static_cast<long long>(sweep)),
                      "simplify the slide's polygon or change slbl.tolerance");
    double largest = 0;
    for (const std::size_t k : cells) {
      const double* c = &z[k];
      double mean = c[-1] + c[1] + c[-nx] + c[nx];
      if (eight) mean = 0.5 * (mean + c[-nx - 1] + c[-nx + 1] + c[nx - 1] + c[nx + 1]);
      const double wanted = z[k] + relaxation * (0.25 * mean - tolerance - z[k]);
      const double next = std::clamp(wanted, bound[k], ground.z[k]);
      largest = std::max(largest, std::abs(next - z[k]));
      z[k] = next;
    }
    if (largest <= accuracy) return z;
  }
}

double automatic_tolerance(const HeightField& ground, const std::vector<uint8_t>& inside,
                           const SlideSurface::Slbl& parameters) {
  // Mean downhill direction, then the slide's extents along and across it.
  const double dx = ground.dx;
  double slope_x = 0, slope_y = 0;
  for (std::size_t k = 0; k < inside.size(); ++k) {
    if (!inside[k]) continue;
    slope_x += ground.z[k + 1] - ground.z[k - 1];
    slope_y += ground.z[k + ground.nx] - ground.z[k - ground.nx];
  }
  const double norm = std::hypot(slope_x, slope_y);
  const double ux = norm > 0 ? slope_x / norm : 1, uy = norm > 0 ? slope_y / norm : 0;
  double along[2] = {HUGE_VAL, -HUGE_VAL}, across[2] = {HUGE_VAL, -HUGE_VAL};
  for (std::size_t k = 0; k < inside.size(); ++k) {
    if (!inside[k]) continue;
    const double x = double(k % ground.nx) * dx, y = double(k / ground.nx) * dx;
    const double s = ux * x + uy * y, t = ux * y - uy * x;
    along[0] = std::min(along[0], s), along[1] = std::max(along[1], s);
    across[0] = std::min(across[0], t), across[1] = std::max(across[1], t);
  }
  // Between the cells around the slide, which stay where they are: two spacings more than between its outermost cells.
  const double length = along[1] - along[0] + 2 * dx, width = across[1] - across[0] + 2 * dx;
  const double depth = parameters.max_depth > 0 ? parameters.max_depth : 0.1 * length;
  const double factor = parameters.neighbours == 8 ? 3 : 2;
  return factor * depth * dx * dx * (1 / (length * length) + 1 / (width * width));
}

}  // namespace lgiw::detail
