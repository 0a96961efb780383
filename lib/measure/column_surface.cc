#include "measure/column_surface.hh"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/error.hh"

namespace lgiw {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr float nan_float = std::numeric_limits<float>::quiet_NaN();

/// Wendland C2 (physics.md section 1), support 2h.
struct MeasuringKernel {
  MeasuringKernel(int dimension, double h)
      : radius(2 * h),
        alpha(dimension == 2 ? 7 / (4 * std::numbers::pi * h * h) : 21 / (16 * std::numbers::pi * h * h * h)) {}
  double operator()(double r) const {
    const double u = r / radius;
    if (u >= 1) return 0;
    const double t = (1 - u) * (1 - u);
    return alpha * t * t * (4 * u + 1);
  }
  double radius, alpha;
};

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define LGIW_WIDEST_VECTORS __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define LGIW_WIDEST_VECTORS
#endif

/// sum_j (1 - u)^4 (4 u + 1), u = |r - r_j| scale, over n particles.
LGIW_WIDEST_VECTORS float kernel_sum(const float* x, const float* y, const float* z, std::size_t n, float px, float py,
                                     float pz, float scale) {
  float total = 0;
#pragma omp simd reduction(+ : total)
  for (std::size_t k = 0; k < n; ++k) {
    const float dx = x[k] - px, dy = y[k] - py, dz = z[k] - pz;
    const float r = std::sqrt(dx * dx + dy * dy + dz * dz) * scale, u = r < 1.0f ? r : 1.0f;
    const float t = (1 - u) * (1 - u);
    total += t * t * (4 * u + 1);
  }
  return total;
}

/// sum_k of a table a line, at (bed[k] + offset) scale, held within [0, last] and linear between the entries; a bed of
/// NaN counts as at 0.
LGIW_WIDEST_VECTORS float table_sum(const float* bed, const int* table, const float* tables, std::size_t n,
                                    float offset, float scale, int last) {
  float total = 0;
#pragma omp simd reduction(+ : total)
  for (std::size_t k = 0; k < n; ++k) {
    const float raw = (bed[k] + offset) * scale, above = raw > 0.0f ? raw : 0.0f;
    const float u = above < float(last) ? above : float(last);
    const int at = int(u), i = at < last ? at : last - 1;
    const float low = tables[table[k] + i];
    total += low + (u - float(i)) * (tables[table[k] + i + 1] - low);
  }
  return total;
}

/// Columns of bins over the map and the kernel's reach around it, wide enough that the sums over one are long.
struct BinGrid {
  BinGrid(const SurfaceMap& map, int dimension, double h) : edge(2 * h) {
    x0 = map.x0 - 2 * h;
    nx = std::size_t(std::ceil((double(map.nx - 1) * map.dx + 4 * h) / edge)) + 1;
    if (dimension == 3) {
      y0 = map.y0 - 2 * h;
      ny = std::size_t(std::ceil((double(map.ny - 1) * map.dx + 4 * h) / edge)) + 1;
    }
  }
  bool flat() const { return ny == 1; }  // 2-D: all y in one row

  double edge, x0 = 0, y0 = 0;
  std::size_t nx = 0, ny = 1;
};

/// Particles of one phase sorted by bin, and from the top down in a bin.
class PhaseBins {
 public:
  PhaseBins(const ColumnParticles& particles, std::size_t first, std::size_t count, const BinGrid& grid) : grid_(grid) {
    start_.assign(grid.nx * grid.ny + 1, 0);
    const auto bin_of = [&](std::size_t p) -> int64_t {
      const float* r = particles.xyz + 3 * p;
      if (particles.lost && particles.lost[p]) return -1;
      if (!std::isfinite(r[2])) return -1;
      const double u = (r[0] - grid.x0) / grid.edge, v = grid.flat() ? 0 : (r[1] - grid.y0) / grid.edge;
      if (!(u >= 0 && u < double(grid.nx) && v >= 0 && v < double(grid.ny))) return -1;
      return int64_t(v) * int64_t(grid.nx) + int64_t(u);
    };
    std::vector<int64_t> bin(count);
#pragma omp parallel for
    for (std::size_t k = 0; k < count; ++k) bin[k] = bin_of(first + k);
    for (int64_t b : bin)
      if (b >= 0) ++start_[b + 1];
    for (std::size_t b = 0; b + 1 < start_.size(); ++b) start_[b + 1] += start_[b];
    std::vector<std::size_t> order(start_.back()), next(start_.begin(), start_.end() - 1);
    for (std::size_t k = 0; k < count; ++k)
      if (bin[k] >= 0) order[next[bin[k]]++] = first + k;

    x_.resize(order.size()), y_.resize(order.size()), z_.resize(order.size());
    if (particles.velocity) speed_.resize(order.size());
#pragma omp parallel for schedule(dynamic, 256)
    for (std::size_t b = 0; b < start_.size() - 1; ++b) {
      // The index as second key: equal heights keep one order, whatever sort does.
      std::sort(order.begin() + start_[b], order.begin() + start_[b + 1], [&](std::size_t p, std::size_t q) {
        const float zp = particles.xyz[3 * p + 2], zq = particles.xyz[3 * q + 2];
        return zp != zq ? zp > zq : p < q;
      });
      for (std::size_t k = start_[b]; k < start_[b + 1]; ++k) {
        const float* r = particles.xyz + 3 * order[k];
        x_[k] = r[0], y_[k] = grid.flat() ? 0 : r[1], z_[k] = r[2];
        if (!particles.velocity) continue;
        const float* v = particles.velocity + 3 * order[k];
        speed_[k] = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
      }
    }
  }

  /// Bins that a square of half-width `reach` about (x, y) touches, handed to visit(begin, end).
  template <class Visit>
  void visit(double x, double y, double reach, const Visit& visit) const {
    const auto clamped = [](double u, std::size_t n) { return std::size_t(std::clamp(u, 0.0, double(n - 1))); };
    const auto outside = [&](double u, double u0, std::size_t n) {
      return u + reach < u0 || u - reach > u0 + grid_.edge * double(n);
    };
    if (outside(x, grid_.x0, grid_.nx) || (!grid_.flat() && outside(y, grid_.y0, grid_.ny))) return;
    const std::size_t i0 = clamped((x - reach - grid_.x0) / grid_.edge, grid_.nx);
    const std::size_t i1 = clamped((x + reach - grid_.x0) / grid_.edge, grid_.nx);
    const std::size_t j0 = grid_.flat() ? 0 : clamped((y - reach - grid_.y0) / grid_.edge, grid_.ny);
    const std::size_t j1 = grid_.flat() ? 0 : clamped((y + reach - grid_.y0) / grid_.edge, grid_.ny);
    for (std::size_t j = j0; j <= j1; ++j)
      for (std::size_t i = i0; i <= i1; ++i) {
        const std::size_t b = j * grid_.nx + i;
        if (start_[b] < start_[b + 1]) visit(start_[b], start_[b + 1]);
      }
  }

  /// sum_j W(r - r_j) over the particles [begin, end).
  double sum(const MeasuringKernel& kernel, std::size_t begin, std::size_t end, double x, double y, double z) const {
    return kernel.alpha * kernel_sum(x_.data() + begin, y_.data() + begin, z_.data() + begin, end - begin, float(x),
                                     float(y), float(z), float(1 / kernel.radius));
  }

  /// Largest speed at or below `top` within `reach` of (x, y) in x and in y.
  float largest_speed(double x, double y, double reach, double top) const {
    float largest = 0;
    visit(x, y, reach, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        if (z_[k] <= top && std::abs(x_[k] - x) <= reach && (grid_.flat() || std::abs(y_[k] - y) <= reach))
          largest = std::max(largest, speed_[k]);
    });
    return largest;
  }

  double z(std::size_t k) const { return z_[k]; }

 private:
  const BinGrid& grid_;
  std::vector<std::size_t> start_;
  std::vector<float> x_, y_, z_, speed_;
};

/// Coordinates of x and its mirror images in the walls from which particles between the walls are seen. A point on a
/// wall is its own image and stands there twice.
std::vector<double> images(double x, double low, double high, double reach) {
  std::vector<double> result{x};
  const auto add = [&](double image) {
    if (image > low - reach && image < high + reach) result.push_back(image);
  };
  if (std::isfinite(low) && std::isfinite(high) && high > low) {
    const double period = 2 * (high - low);
    const int n = int(std::ceil(reach / period)) + 1;
    for (int k = -n; k <= n; ++k) {
      if (k != 0) add(x + k * period);
      add(2 * low - x + k * period);
    }
  } else if (std::isfinite(low)) {
    add(2 * low - x);
  } else if (std::isfinite(high)) {
    add(2 * high - x);
  }
  return result;
}

/// x brought back between the walls by mirroring.
double folded(double x, double low, double high) {
  for (int k = 0; k < 64; ++k) {
    if (x < low) {
      x = 2 * low - x;
    } else if (x > high) {
      x = 2 * high - x;
    } else {
      break;
    }
  }
  return x;
}

/// The fraction of the kernel that lies below the bed, by the midpoint rule over vertical lines through the kernel: for
/// each line a table of the integral of W up to a height, by the height relative to the point.
class BedFraction {
 public:
  BedFraction(int dimension, const MeasuringKernel& kernel) : radius_(kernel.radius) {
    const int n = dimension == 2 ? 16 : 8;  // lines per radius
    const double spacing = radius_ / n;
    std::vector<int> table_of(2 * n * n + 1, -1);  // by (2i+1)^2 + (2j+1)^2 over four: lines alike share a table
    double whole = 0;
    for (int j = dimension == 2 ? 0 : -n; j < (dimension == 2 ? 1 : n); ++j)
      for (int i = -n; i < n; ++i) {
        const double dx = (i + 0.5) * spacing, dy = dimension == 2 ? 0 : (j + 0.5) * spacing;
        const double rho2 = dx * dx + dy * dy;
        if (rho2 >= radius_ * radius_) continue;
        const int a = 2 * i + 1, b = dimension == 2 ? 0 : 2 * j + 1, key = (a * a + b * b) / 4;
        if (table_of[key] < 0) {
          table_of[key] = int(tables_.size() / (intervals + 1));
          add_table(kernel, rho2);
        }
        lines_.push_back({dx, dy});
        table_.push_back(table_of[key] * (intervals + 1));
        whole += tables_[std::size_t(table_.back()) + intervals];
      }
    for (float& value : tables_) value = float(value / whole);  // a point deep in the bed has fraction 1
  }

  struct Line {
    double dx, dy;
  };
  const std::vector<Line>& lines() const { return lines_; }

  /// Fraction at height z where the bed under line k is at origin + bed[k] (NaN: none).
  double operator()(const std::vector<float>& bed, double origin, double z) const {
    return table_sum(bed.data(), table_.data(), tables_.data(), bed.size(), float(origin - z + radius_),
                     float(intervals / (2 * radius_)), intervals);
  }

 private:
  static constexpr int intervals = 256;

  void add_table(const MeasuringKernel& kernel, double rho2) {
    const double step = 2 * radius_ / intervals;
    const auto w = [&](double s) { return kernel(std::sqrt(rho2 + s * s)); };
    double total = 0;
    tables_.push_back(0);
    for (int i = 0; i < intervals; ++i) {  // Simpson
      const double s = -radius_ + i * step;
      total += step / 6 * (w(s) + 4 * w(s + step / 2) + w(s + step));
      tables_.push_back(float(total));
    }
  }

  double radius_;
  std::vector<float> tables_;
  std::vector<int> table_;  // where that of a line begins
  std::vector<Line> lines_;
};

/// Lowest and highest bed in the surroundings of a node, from the extremes of square tiles: most nodes lie so far above
/// the bed that the fraction below it need not be asked for.
class BedRange {
 public:
  BedRange(const HeightField& bed, double reach) : bed_(bed) {
    if (bed.empty()) return;
    tile_ = std::max<std::size_t>(1, std::size_t(reach / bed.dx));
    nx_ = (bed.nx + tile_ - 1) / tile_, ny_ = (bed.ny + tile_ - 1) / tile_;
    low_.assign(nx_ * ny_, infinity), high_.assign(nx_ * ny_, -infinity);
    for (std::size_t j = 0; j < bed.ny; ++j)
      for (std::size_t i = 0; i < bed.nx; ++i) {
        const double z = bed.at(i, j);
        if (std::isnan(z)) continue;
        double& low = low_[(j / tile_) * nx_ + i / tile_];
        double& high = high_[(j / tile_) * nx_ + i / tile_];
        low = std::min(low, z), high = std::max(high, z);
      }
  }

  /// (lowest, highest) within `reach` of (x, y), or a little beyond; (infinity, -infinity) without a bed.
  std::array<double, 2> around(double x, double y, double reach) const {
    std::array<double, 2> range{infinity, -infinity};
    if (bed_.empty()) return range;
    const auto tile = [&](double u, std::size_t n) { return std::size_t(std::clamp(u, 0.0, double(n - 1))) / tile_; };
    const std::size_t i0 = tile(std::floor((x - reach - bed_.x0) / bed_.dx), bed_.nx);
    const std::size_t i1 = tile(std::ceil((x + reach - bed_.x0) / bed_.dx), bed_.nx);
    const std::size_t j0 = tile(std::floor((y - reach - bed_.y0) / bed_.dx), bed_.ny);
    const std::size_t j1 = tile(std::ceil((y + reach - bed_.y0) / bed_.dx), bed_.ny);
    for (std::size_t j = j0; j <= j1; ++j)
      for (std::size_t i = i0; i <= i1; ++i) {
        range[0] = std::min(range[0], low_[j * nx_ + i]);
        range[1] = std::max(range[1], high_[j * nx_ + i]);
      }
    return range;
  }

 private:
  const HeightField& bed_;
  std::size_t tile_ = 1, nx_ = 0, ny_ = 0;
  std::vector<double> low_, high_;
};

/// The filled fractions along the vertical through one node. Evaluations near each other are cheap: the windows of
/// particles within the kernel's reach slide along with z.
class Column {
 public:
  struct Fractions {
    double water = 0, soil = 0, bed = 0;
  };

  Column(const ColumnParticles& particles, const MeasuringKernel& kernel, const HeightField& bed,
         const BedRange& bed_range, const BedFraction& bed_fraction)
      : kernel_(kernel),
        volume_(std::pow(particles.dp, particles.dimension)),
        low_(particles.wall_low),
        high_(particles.wall_high),
        bed_(bed),
        bed_range_(bed_range),
        bed_fraction_(bed_fraction) {
    if (particles.dimension == 2) low_[1] = -infinity, high_[1] = infinity;
  }

  /// Moves to the node at (x, y). `water` and `soil` may be null.
  void place(double x, double y, const PhaseBins* water, const PhaseBins* soil) {
    x_ = x, y_ = y;
    windows_.clear();
    for (double yi : images(y, low_[1], high_[1], kernel_.radius))
      for (double xi : images(x, low_[0], high_[0], kernel_.radius))
        for (const PhaseBins* bins : {water, soil})
          if (bins)
            bins->visit(xi, yi, kernel_.radius, [&](std::size_t begin, std::size_t end) {
              windows_.push_back({bins, bins == water, xi, yi, begin, end, begin, begin});
            });
    if (windows_.empty()) return;
    floor_ = infinity;
    for (const Window& w : windows_) floor_ = std::min(floor_, w.bins->z(w.end - 1));
    const auto [lowest, highest] = bed_range_.around(x, y, kernel_.radius);
    if (lowest < infinity) floor_ = std::max(floor_, lowest);  // below the lowest bed in reach everything is filled
    bed_top_ = highest;
    bed_heights_.clear();
  }

  bool empty() const { return windows_.empty(); }
  double floor() const { return floor_ - kernel_.radius; }
  double bed_top() const { return bed_top_; }

  Fractions at(double z) {
    Fractions f;
    for (Window& w : windows_) {
      w.slide(z, kernel_.radius);
      if (w.first == w.last) continue;
      (w.is_water ? f.water : f.soil) += volume_ * w.bins->sum(kernel_, w.first, w.last, w.x, w.y, z);
    }
    if (bed_top_ > z - kernel_.radius) {
      if (bed_heights_.empty()) sample_bed();
      f.bed = bed_fraction_(bed_heights_, bed_top_, z);
    }
    return f;
  }

  /// Height of the highest particle below the reach of the last evaluation; at the start, the highest of all.
  double next_particle() const {
    double z = -infinity;
    for (const Window& w : windows_)
      if (w.last < w.end) z = std::max(z, w.bins->z(w.last));
    return z;
  }

 private:
  struct Window {
    const PhaseBins* bins;
    bool is_water;
    double x, y;
    std::size_t begin, end, first, last;  // the bin; in it, what lies within reach

    void slide(double z, double reach) {
      while (first < end && bins->z(first) >= z + reach) ++first;
      while (first > begin && bins->z(first - 1) < z + reach) --first;
      last = std::max(last, first);
      while (last < end && bins->z(last) > z - reach) ++last;
      while (last > first && bins->z(last - 1) <= z - reach) --last;
    }
  };

  void sample_bed() {
    for (const BedFraction::Line& line : bed_fraction_.lines())
      bed_heights_.push_back(float(
          bed_.height(folded(x_ + line.dx, low_[0], high_[0]), folded(y_ + line.dy, low_[1], high_[1])) - bed_top_));
  }

  MeasuringKernel kernel_;
  double volume_;
  std::array<double, 2> low_, high_;
  const HeightField& bed_;
  const BedRange& bed_range_;
  const BedFraction& bed_fraction_;
  double x_ = 0, y_ = 0, bed_top_ = 0, floor_ = 0;
  std::vector<float> bed_heights_;  // under the lines of the fraction, from bed_top_; empty until they are wanted
  std::vector<Window> windows_;
};

/// The highest height at which the filled fraction rises downwards through 1/2 and `share` of the fractions is more
/// than half of it; NaN where there is none.
template <class Share>
double highest_surface(Column& column, double dp, const Share& share) {
  if (column.empty()) return nan_value;
  const auto excess = [&](double z) {
    const Column::Fractions f = column.at(z);
    return f.water + f.soil + f.bed - 0.5;
  };
  const double step = dp / 2;
  // No surface lies a whole dp above all particles; should the bed fill this place, the search starts above it.
  double upper = column.next_particle() + dp;
  double f_upper = excess(upper);
  while (f_upper >= 0) f_upper = excess(upper += step);
  while (upper > column.floor()) {
    double lower = upper - step;
    if (f_upper == -0.5) {
      lower = std::min(lower, std::max({column.next_particle(), column.bed_top(), column.floor()}) + dp);
    }
    double f_lower = excess(lower);
    if (f_upper < 0 && f_lower >= 0) {
      // Illinois' false position; the fraction is all but linear here.
      double a = upper, fa = f_upper, b = lower, fb = f_lower, z = b;
      for (int k = 0; k < 40 && std::abs(a - b) > 1e-4 * dp && fb != 0; ++k) {
        z = (a * fb - b * fa) / (fb - fa);
        const double f = excess(z);
        if (std::abs(f) < 1e-6) break;
        if ((f < 0) == (fb < 0)) {
          fa /= 2;
        } else {
          a = b, fa = fb;
        }
        b = z, fb = f;
      }
      const Column::Fractions f = column.at(z);
      if (share(f) > 0.5 * (f.water + f.soil + f.bed)) return z;
      f_lower = excess(lower);  // slides the windows back
    }
    upper = lower, f_upper = f_lower;
  }
  return nan_value;
}

}  // namespace

ColumnSurfaces column_surfaces(const ColumnParticles& particles, const SurfaceMap& map, const HeightField& bed) {
  LGIW_EXPECT(particles.dp > 0 && particles.h > 0 && map.nx > 0 && map.ny > 0 && map.dx > 0);
  const MeasuringKernel kernel(particles.dimension, particles.h);
  const double dp = particles.dp;
  const BinGrid grid(map, particles.dimension, particles.h);
  const PhaseBins water(particles, 0, particles.n_water, grid);
  const PhaseBins soil(particles, particles.n_water, particles.n_soil, grid);
  const BedFraction bed_fraction(particles.dimension, kernel);
  const BedRange bed_range(bed, kernel.radius);

  ColumnSurfaces result;
  result.water.assign(map.size(), nan_float);
  result.depth.assign(map.size(), nan_float);
  if (particles.n_soil) result.soil.assign(map.size(), nan_float);
  if (particles.velocity) result.speed.assign(map.size(), nan_float);
  if (particles.velocity && particles.n_soil) result.soil_speed.assign(map.size(), nan_float);
  const double reach = std::max(map.dx, particles.h) / 2;  // at least h/2: a wet column holds a particle

#pragma omp parallel
  {
    Column column(particles, kernel, bed, bed_range, bed_fraction);
#pragma omp for schedule(dynamic, 64)
    for (std::size_t node = 0; node < map.size(); ++node) {
      const double x = map.x0 + double(node % map.nx) * map.dx, y = map.y0 + double(node / map.nx) * map.dx;
      double soil_z = nan_value;
      if (particles.n_soil) {
        column.place(x, y, nullptr, &soil);
        soil_z = highest_surface(column, dp, [](const Column::Fractions& f) { return f.soil; });
        result.soil[node] = float(soil_z);
        if (particles.velocity && !std::isnan(soil_z))
          result.soil_speed[node] = soil.largest_speed(x, y, reach, soil_z + dp / 2);
      }
      if (!particles.n_water) continue;
      column.place(x, y, &water, particles.n_soil ? &soil : nullptr);
      const double water_z = highest_surface(column, dp, [](const Column::Fractions& f) { return f.water; });
      if (std::isnan(water_z)) continue;
      result.water[node] = float(water_z);
      double base = bed.empty() ? nan_value : bed.height(x, y);
      if (soil_z < water_z && !(soil_z < base)) base = soil_z;
      result.depth[node] = float(std::max(0.0, water_z - base));
      if (particles.velocity) result.speed[node] = water.largest_speed(x, y, reach, water_z + dp / 2);
    }
  }
  return result;
}

}  // namespace lgiw
