// A raster of heights in local metric coordinates: the bed (under everything that moves) or the ground.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace lgiw {

/// Node-registered grid: z[j*nx + i] is the height at (x0 + i*dx, y0 + j*dx), row 0 in the south. Bilinear between
/// nodes. 2-D scenes have ny == 1. NaN marks cells without terrain.
struct HeightField {
  std::size_t nx = 0, ny = 0;
  double x0 = 0, y0 = 0, dx = 1;
  std::vector<double> z;

  double& at(std::size_t i, std::size_t j) { return z[j * nx + i]; }
  double at(std::size_t i, std::size_t j) const { return z[j * nx + i]; }
  double x_max() const { return x0 + (nx - 1) * dx; }
  double y_max() const { return y0 + (ny ? ny - 1 : 0) * dx; }
  bool empty() const { return z.empty(); }

  /// Height at (x, y); outside, the nearest edge value. NaN where a corner is NaN, and of an empty field.
  double height(double x, double y) const { return sample(x, y, nullptr); }
  /// Height and gradient (dz/dx, dz/dy) of the bilinear patch at (x, y).
  double sample(double x, double y, double* gradient) const {
    if (empty()) {
      if (gradient) gradient[0] = gradient[1] = NAN;
      return NAN;
    }
    const double u = std::clamp((x - x0) / dx, 0.0, double(nx - 1));
    const std::size_t i = std::min<std::size_t>(nx >= 2 ? nx - 2 : 0, std::size_t(u));
    const double a = u - double(i);
    const std::size_t i1 = nx >= 2 ? i + 1 : i;
    if (ny < 2) {
      const double z0 = at(i, 0), z1 = at(i1, 0);
      if (gradient) gradient[0] = (z1 - z0) / dx, gradient[1] = 0;
      return z0 + a * (z1 - z0);
    }
    const double v = std::clamp((y - y0) / dx, 0.0, double(ny - 1));
    const std::size_t j = std::min<std::size_t>(ny - 2, std::size_t(v));
    const double b = v - double(j);
    const double z00 = at(i, j), z10 = at(i1, j), z01 = at(i, j + 1), z11 = at(i1, j + 1);
    if (gradient) {
      gradient[0] = ((1 - b) * (z10 - z00) + b * (z11 - z01)) / dx;
      gradient[1] = ((1 - a) * (z01 - z00) + a * (z11 - z10)) / dx;
    }
    return (1 - b) * ((1 - a) * z00 + a * z10) + b * ((1 - a) * z01 + a * z11);
  }
};

}  // namespace lgiw
