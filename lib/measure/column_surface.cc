#include "measure/column_surface.hh"

#include <omp.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "base/error.hh"
#include "base/ordered_blocks.hh"

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

constexpr int lanes = 16;  // floats in the widest vectors

/// Particles beside each other in memory, as seen from the vertical through (px, py).
struct Run {
  const float *x, *y, *z;
  int n;
  float px, py;
};

struct KernelSums {
  float value = 0, slope = 0;
};

/// The sum of w = (1 - u)^4 (4 u + 1), u = |r - r_j| scale, over all particles of the runs as seen from height pz, and
/// a twentieth of its derivative by pz over scale^2. What follows a run in memory, up to a full vector, is read and
/// counts nothing.
LGIW_WIDEST_VECTORS KernelSums kernel_sums(const Run* runs, std::size_t count, float pz, float scale) {
  // In parts, since to add up the lanes takes longer than the particles of a run.
  float value[lanes] = {}, slope[lanes] = {};
  for (std::size_t i = 0; i < count; ++i) {
    const Run& run = runs[i];
    for (int begin = 0; begin < run.n; begin += lanes) {
      const float *x = run.x + begin, *y = run.y + begin, *z = run.z + begin;
      const float px = run.px, py = run.py;
      const int left = run.n - begin;
#pragma omp simd
      for (int k = 0; k < lanes; ++k) {
        const float dx = x[k] - px, dy = y[k] - py, dz = z[k] - pz;
        const float r = std::sqrt(dx * dx + dy * dy + dz * dz) * scale, u = (k < left) & (r < 1.0f) ? r : 1.0f;
        const float t = (1 - u) * (1 - u) * (1 - u);
        value[k] += t * (1 - u) * (4 * u + 1);
        slope[k] += t * dz;
      }
    }
  }
  float whole_value = 0, whole_slope = 0;
#pragma omp simd reduction(+ : whole_value, whole_slope)
  for (int k = 0; k < lanes; ++k) whole_value += value[k], whole_slope += slope[k];
  return {whole_value, whole_slope};
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

/// Largest of value[k] where |x - px| and |y - py| are at most `reach`; 0 without any.
LGIW_WIDEST_VECTORS float largest_within(const float* x, const float* y, const float* value, std::size_t n, float px,
                                         float py, float reach) {
  float largest = 0;
#pragma omp simd reduction(max : largest)
  for (std::size_t k = 0; k < n; ++k) {
    const bool within = (std::abs(x[k] - px) <= reach) & (std::abs(y[k] - py) <= reach);
    const float here = within ? value[k] : 0.0f;
    largest = here > largest ? here : largest;
  }
  return largest;
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
  explicit PhaseBins(const BinGrid& grid) : grid_(grid) {}

  void fill(const ColumnParticles& particles, std::size_t first, std::size_t count) {
    start_.assign(grid_.nx * grid_.ny + 1, 0);
    const auto bin_of = [&](std::size_t p) -> int64_t {
      const float* r = particles.xyz + 3 * p;
      if (particles.lost && particles.lost[p]) return -1;
      if (!std::isfinite(r[2])) return -1;
      const double u = (r[0] - grid_.x0) / grid_.edge, v = grid_.flat() ? 0 : (r[1] - grid_.y0) / grid_.edge;
      if (!(u >= 0 && u < double(grid_.nx) && v >= 0 && v < double(grid_.ny))) return -1;
      return int64_t(v) * int64_t(grid_.nx) + int64_t(u);
    };
    bin_.resize(count);
#pragma omp parallel for
    for (std::size_t k = 0; k < count; ++k) bin_[k] = bin_of(first + k);
    const bool together = count > too_few_to_share && omp_get_max_threads() > 1;
    /// What was counted so far. An atomic sum costs more than a plain one.
    const auto count_on = [together](std::size_t& sum) {
      std::size_t before;
      if (together) {
#pragma omp atomic capture
        before = sum++;
      } else {
        before = sum++;
      }
      return before;
    };
#pragma omp parallel for schedule(static) if (together)
    for (std::size_t k = 0; k < count; ++k)
      if (bin_[k] >= 0) count_on(start_[std::size_t(bin_[k]) + 1]);
    low_ = {grid_.nx, grid_.ny}, high_ = {0, 0};
    for (std::size_t b = 0; b + 1 < start_.size(); ++b) {
      if (start_[b + 1] > 0) {
        const std::size_t i = b % grid_.nx, j = b / grid_.nx;
        low_ = {std::min(low_[0], i), std::min(low_[1], j)}, high_ = {std::max(high_[0], i), std::max(high_[1], j)};
      }
      start_[b + 1] += start_[b];
    }
    // Numbers that sort like the height, from the top, and then like the index, which leaves one order only.
    order_.resize(start_.back());
    next_.assign(start_.begin(), start_.end() - 1);
#pragma omp parallel for schedule(static) if (together)
    for (std::size_t k = 0; k < count; ++k)
      if (bin_[k] >= 0)
        order_[count_on(next_[std::size_t(bin_[k])])] =
            uint64_t(descending(particles.xyz[3 * (first + k) + 2])) << 32 | k;

    for (auto* values : {&x_, &y_, &z_}) values->resize(order_.size() + lanes);
    if (particles.velocity) square_speed_.resize(order_.size());
#pragma omp parallel for schedule(dynamic, 256)
    for (std::size_t b = 0; b < start_.size() - 1; ++b) {
      std::sort(order_.begin() + start_[b], order_.begin() + start_[b + 1]);
      for (std::size_t k = start_[b]; k < start_[b + 1]; ++k) {
        const std::size_t p = first + uint32_t(order_[k]);
        const float* r = particles.xyz + 3 * p;
        x_[k] = r[0], y_[k] = grid_.flat() ? 0 : r[1], z_[k] = r[2];
        if (!particles.velocity) continue;
        const float* v = particles.velocity + 3 * p;
        square_speed_[k] = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
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
    const std::size_t i0 = std::max(low_[0], clamped((x - reach - grid_.x0) / grid_.edge, grid_.nx));
    const std::size_t i1 = std::min(high_[0], clamped((x + reach - grid_.x0) / grid_.edge, grid_.nx));
    const std::size_t j0 = grid_.flat() ? 0 : std::max(low_[1], clamped((y - reach - grid_.y0) / grid_.edge, grid_.ny));
    const std::size_t j1 =
        grid_.flat() ? 0 : std::min(high_[1], clamped((y + reach - grid_.y0) / grid_.edge, grid_.ny));
    for (std::size_t j = j0; j <= j1; ++j)
      for (std::size_t i = i0; i <= i1; ++i) {
        const std::size_t b = j * grid_.nx + i;
        if (start_[b] < start_[b + 1]) visit(start_[b], start_[b + 1]);
      }
  }

  /// The particles [begin, end) as seen from (x, y).
  Run run(std::size_t begin, std::size_t end, double x, double y) const {
    return {x_.data() + begin, y_.data() + begin, z_.data() + begin, int(end - begin), float(x), float(y)};
  }

  /// Largest speed at or below `top` within `reach` of (x, y) in x and in y.
  float largest_speed(double x, double y, double reach, double top) const {
    float largest = 0;
    visit(x, y, reach, [&](std::size_t begin, std::size_t end) {
      while (begin < end && z_[begin] > top) ++begin;
      largest = std::max(largest, largest_within(x_.data() + begin, y_.data() + begin, square_speed_.data() + begin,
                                                 end - begin, float(x), grid_.flat() ? 0 : float(y), float(reach)));
    });
    return std::sqrt(largest);
  }

  double z(std::size_t k) const { return z_[k]; }

 private:
  /// The larger the height, the smaller the number.
  static uint32_t descending(float z) {
    const uint32_t bits = std::bit_cast<uint32_t>(z + 0.0f);  // no -0
    return bits >> 31 ? bits : ~bits & 0x7fffffffu;
  }

  const BinGrid grid_;
  std::array<std::size_t, 2> low_{}, high_{};  // bins with particles lie between these
  std::vector<std::size_t> start_;
  std::vector<float> x_, y_, z_, square_speed_;
  // While it is filled; kept for the next time: memory new from the system costs page faults.
  std::vector<int64_t> bin_;
  std::vector<uint64_t> order_;
  std::vector<std::size_t> next_;
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

/// The fraction of the kernel that lies below the bed, at every height above every node of a map. It is found by the
/// midpoint rule over vertical lines through the kernel, each with a table of the integral of W up to a height. The bed
/// stays while the particles move: the fractions above a node are computed where they are first wanted, and kept.
class BedFractions {
 public:
  struct Sample {
    double fraction = 0, slope = 0;  // derivative by z
  };

  BedFractions(const ColumnParticles& particles, const SurfaceMap& map, const HeightField& bed)
      : kernel_(particles.dimension, particles.h),
        spacing_(particles.h / 12),
        low_(particles.wall_low),
        high_(particles.wall_high),
        map_(map),
        bed_(bed),
        profiles_(map.size()) {
    if (particles.dimension == 2) low_[1] = -infinity, high_[1] = infinity;
    make_lines(particles.dimension);
    find_tops();
  }

  Sample at(std::size_t node, double z) {
    Profile& profile = profiles_[node];
    const double down = (profile.top - z) / spacing_;
    if (!(down > 0)) return {};
    if (profile.fraction.empty()) compute(node);
    // A cubic through the four values around z.
    const std::vector<float>& f = profile.fraction;
    const std::size_t last = f.size() - 1, k = std::min(std::size_t(down), last), k1 = std::min(k + 1, last);
    const double f0 = k ? f[k - 1] : 0, f1 = f[k], f2 = f[k1], f3 = f[std::min(k + 2, last)];
    const double t = std::min(down - double(k), 1.0);
    const double a = f2 - f0 / 3 - f1 / 2 - f3 / 6, b = (f0 + f2) / 2 - f1, c = (f1 - f2) / 2 + (f3 - f0) / 6;
    return {((c * t + b) * t + a) * t + f1, -((3 * c * t + 2 * b) * t + a) / spacing_};
  }

  /// Above it nothing is below the bed; -infinity without a bed.
  double top(std::size_t node) const { return profiles_[node].top; }

 private:
  static constexpr int intervals = 256;
  struct Line {
    double dx, dy;
  };
  struct Profile {
    float top = -std::numeric_limits<float>::infinity();
    std::vector<float> fraction;  // from the top down to 1/2, where all searches have ended
  };

  void make_lines(int dimension) {
    const int n = dimension == 2 ? 16 : 8;  // lines per radius
    const double radius = kernel_.radius, spacing = radius / n;
    std::vector<int> table_of(2 * n * n + 1, -1);  // by (2i+1)^2 + (2j+1)^2 over four: lines alike share a table
    double whole = 0;
    for (int j = dimension == 2 ? 0 : -n; j < (dimension == 2 ? 1 : n); ++j)
      for (int i = -n; i < n; ++i) {
        const double dx = (i + 0.5) * spacing, dy = dimension == 2 ? 0 : (j + 0.5) * spacing;
        const double rho2 = dx * dx + dy * dy;
        if (rho2 >= radius * radius) continue;
        const int a = 2 * i + 1, b = dimension == 2 ? 0 : 2 * j + 1, key = (a * a + b * b) / 4;
        if (table_of[key] < 0) {
          table_of[key] = int(tables_.size() / (intervals + 1));
          add_table(rho2);
        }
        lines_.push_back({dx, dy});
        table_.push_back(table_of[key] * (intervals + 1));
        whole += tables_[std::size_t(table_.back()) + intervals];
      }
    for (float& value : tables_) value = float(value / whole);  // a point deep in the bed has fraction 1
  }

  void add_table(double rho2) {
    const double radius = kernel_.radius, step = 2 * radius / intervals;
    const auto w = [&](double s) { return kernel_(std::sqrt(rho2 + s * s)); };
    double total = 0;
    tables_.push_back(0);
    for (int i = 0; i < intervals; ++i) {  // Simpson
      const double s = -radius + i * step;
      total += step / 6 * (w(s) + 4 * w(s + step / 2) + w(s + step));
      tables_.push_back(float(total));
    }
  }

  /// From the highest bed of square tiles: most nodes lie so far above the bed that its heights need not be asked for.
  void find_tops() {
    if (bed_.empty()) return;
    const double radius = kernel_.radius;
    const std::size_t size = std::max<std::size_t>(1, std::size_t(radius / bed_.dx));
    const std::size_t nx = (bed_.nx + size - 1) / size, ny = (bed_.ny + size - 1) / size;
    std::vector<double> highest(nx * ny, -infinity);
    for (std::size_t j = 0; j < bed_.ny; ++j)
      for (std::size_t i = 0; i < bed_.nx; ++i) {
        double& z = highest[(j / size) * nx + i / size];
        if (bed_.at(i, j) > z) z = bed_.at(i, j);  // not where it is NaN
      }
    const auto tile = [&](double u, std::size_t n) { return std::size_t(std::clamp(u, 0.0, double(n - 1))) / size; };
#pragma omp parallel for
    for (std::size_t node = 0; node < profiles_.size(); ++node) {
      const double x = map_.x(node), y = map_.y(node);
      double top = -infinity;
      for (std::size_t j = tile(std::floor((y - radius - bed_.y0) / bed_.dx), bed_.ny);
           j <= tile(std::ceil((y + radius - bed_.y0) / bed_.dx), bed_.ny); ++j)
        for (std::size_t i = tile(std::floor((x - radius - bed_.x0) / bed_.dx), bed_.nx);
             i <= tile(std::ceil((x + radius - bed_.x0) / bed_.dx), bed_.nx); ++i)
          top = std::max(top, highest[j * nx + i]);
      profiles_[node].top = float(top + radius);
    }
  }

  void compute(std::size_t node) {
    Profile& profile = profiles_[node];
    const double x = map_.x(node), y = map_.y(node), origin = profile.top - kernel_.radius;
    std::vector<float> heights;  // from the origin, for small numbers
    float lowest = 0, highest = -std::numeric_limits<float>::infinity();
    for (const Line& line : lines_) {
      heights.push_back(
          float(bed_.height(folded(x + line.dx, low_[0], high_[0]), folded(y + line.dy, low_[1], high_[1])) - origin));
      if (heights.back() < lowest) lowest = heights.back();
      if (heights.back() > highest) highest = heights.back();  // not where it is NaN
    }
    const double bottom = lowest - kernel_.radius;  // below it everything is that has a bed
    const float scale = float(intervals / (2 * kernel_.radius));
    for (double z = kernel_.radius;; z -= spacing_) {
      const float offset = float(kernel_.radius - z);
      profile.fraction.push_back(highest + offset <= 0 ? 0.0f
                                                       : table_sum(heights.data(), table_.data(), tables_.data(),
                                                                   heights.size(), offset, scale, intervals));
      if (profile.fraction.back() >= 0.5f || z < bottom) break;
    }
    profile.fraction.shrink_to_fit();  // it stays, above every node that was ever wet
  }

  MeasuringKernel kernel_;
  double spacing_;
  std::array<double, 2> low_, high_;
  SurfaceMap map_;
  const HeightField& bed_;
  std::vector<float> tables_;
  std::vector<int> table_;  // where that of a line begins
  std::vector<Line> lines_;
  std::vector<Profile> profiles_;
};

/// The filled fractions along the vertical through one node. Evaluations near each other are cheap: the windows of
/// particles within the kernel's reach slide along with z.
class Column {
 public:
  /// Of the phase whose surface is wanted, of the other phase, and of what lies below the bed.
  struct Fractions {
    double own = 0, other = 0, bed = 0, slope = 0;  // slope: derivative of all by z
    double filled() const { return own + other + bed; }
  };

  Column(const ColumnParticles& particles, BedFractions& bed)
      : radius_(2 * particles.h),
        weight_(std::pow(particles.dp, particles.dimension) * MeasuringKernel(particles.dimension, particles.h).alpha),
        bed_(bed) {}

  /// Moves to a node, whose images are at all pairs of x and y. `other` may be null.
  void place(std::size_t node, const std::vector<double>& x, const std::vector<double>& y, const PhaseBins& own,
             const PhaseBins* other) {
    node_ = node;
    windows_.clear();
    add_windows(x, y, own);
    n_own_ = windows_.size();
    lowest_ = infinity;
    for (const Window& w : windows_) lowest_ = std::min(lowest_, own.z(w.end - 1));
    if (other && !windows_.empty()) add_windows(x, y, *other);
  }

  /// Whether no particle of the own phase is near.
  bool empty() const { return windows_.empty(); }
  /// Below it there is nothing of the own phase.
  double floor() const { return lowest_ - radius_; }
  double reach() const { return radius_; }
  double bed_top() const { return bed_.top(node_) - radius_; }

  Fractions at(double z) {
    const KernelSums own = sums(0, n_own_, z), other = sums(n_own_, windows_.size(), z);
    const BedFractions::Sample bed = bed_.at(node_, z);
    Fractions f;
    f.own = weight_ * own.value, f.other = weight_ * other.value, f.bed = bed.fraction;
    f.slope = 20 * weight_ / (radius_ * radius_) * (own.slope + other.slope) + bed.slope;
    return f;
  }

  /// Height of the highest particle at or below z; -infinity without any.
  double next_particle(double z) const {
    double next = -infinity;
    for (const Window& w : windows_) {
      std::size_t k = w.begin;
      while (k < w.end && w.bins->z(k) > z) ++k;
      if (k < w.end) next = std::max(next, w.bins->z(k));
    }
    return next;
  }

 private:
  struct Window {
    const PhaseBins* bins;
    double x, y;
    std::size_t begin, end, first, last;  // the bin; in it, what lies within reach

    /// What lies beyond the reach counts nothing, so the end moves by full vectors and never back.
    void slide(double z, double reach) {
      while (first < end && bins->z(first) >= z + reach) ++first;
      while (first > begin && bins->z(first - 1) < z + reach) --first;
      last = std::max(last, first);
      while (last < end && bins->z(last) > z - reach) last = std::min(last + lanes, end);
    }
  };

  KernelSums sums(std::size_t first, std::size_t last, double z) {
    runs_.clear();
    for (std::size_t k = first; k < last; ++k) {
      Window& w = windows_[k];
      w.slide(z, radius_);
      if (w.first < w.last) runs_.push_back(w.bins->run(w.first, w.last, w.x, w.y));
    }
    if (runs_.empty()) return {};
    return kernel_sums(runs_.data(), runs_.size(), float(z), float(1 / radius_));
  }

  void add_windows(const std::vector<double>& x, const std::vector<double>& y, const PhaseBins& bins) {
    for (double yi : y)
      for (double xi : x)
        bins.visit(xi, yi, radius_, [&](std::size_t begin, std::size_t end) {
          windows_.push_back({&bins, xi, yi, begin, end, begin, begin});
        });
  }

  double radius_, weight_;
  BedFractions& bed_;
  std::size_t node_ = 0;
  double lowest_ = infinity;
  std::vector<Window> windows_;  // first those of the own phase
  std::size_t n_own_ = 0;
  std::vector<Run> runs_;
};

/// A height and what is filled there.
struct Level {
  double z = 0;
  Column::Fractions f;
};

/// The height at which 1/2 is filled, with the part that is of the own phase; less is filled at `upper`, not less at
/// `lower`.
std::pair<double, double> crossing(Column& column, Level upper, Level lower, double dp) {
  for (int k = 0;; ++k) {
    const double width = upper.z - lower.z, rise = upper.f.filled() - lower.f.filled(), chord = rise / width;
    const double t = (0.5 - lower.f.filled()) / rise;
    const auto alike = [&](double slope) { return slope < chord / 2 && slope > chord * 2; };
    double z = lower.z + t * width;
    const bool smooth = alike(upper.f.slope) && alike(lower.f.slope);
    if (smooth)  // the cubic z(filled) with the values and slopes of both ends
      z += t * (1 - t) * rise * ((1 - t) * (1 / lower.f.slope - 1 / chord) - t * (1 / upper.f.slope - 1 / chord));
    // It is exact within 1e-5 dp between ends so near, and so is Newton's step below.
    if ((smooth && width < 0.1 * dp) || width < 1e-5 * dp || k == 40)
      return {z, lower.f.own + (z - lower.z) / width * (upper.f.own - lower.f.own)};
    if (k % 3 == 2) z = (upper.z + lower.z) / 2;
    const Level here{z, column.at(z)};
    const double newton = (0.5 - here.f.filled()) / here.f.slope;
    if (alike(here.f.slope) && std::abs(newton) < 3e-3 * dp) return {z + newton, here.f.own};
    (here.f.filled() < 0.5 ? upper : lower) = here;
  }
}

/// Surfaces of the columns before, of which the next is expected in line.
class Neighbours {
 public:
  void add(double z) { before_ = last_, last_ = z; }
  /// NaN where there is none.
  double guess(double dp) const { return std::abs(last_ - before_) < dp / 2 ? 2 * last_ - before_ : last_; }

 private:
  double last_ = nan_value, before_ = nan_value;
};

/// The highest height at which the filled fraction rises downwards through 1/2 and more than half of it is of the
/// column's own phase; NaN where there is none. A good guess, which may be NaN, saves evaluations.
double highest_surface(Column& column, double dp, double guess) {
  if (column.empty()) return nan_value;
  // Where the surface should be by the slope, and a little beyond, so that it lies between; dp/2 at most.
  const auto step = [&](const Column::Fractions& f) {
    return f.slope < 0 ? std::min(dp / 2, 1.1 * std::abs((f.filled() - 0.5) / f.slope) + 0.015 * dp) : dp / 2;
  };
  const double highest = column.next_particle(infinity);
  const double start = guess > highest && guess < highest + dp / 2 ? guess : highest + dp / 2;
  Level upper{start, column.at(start)};
  // Above all particles what is filled only falls with the height: either no surface lies higher, or one does at most.
  while (upper.f.filled() >= 0.5 && upper.f.own > 0.25) {
    const Level lower = upper;
    upper.z += step(lower.f);
    upper.f = column.at(upper.z);
    if (upper.f.filled() >= 0.5) continue;
    const auto [z, own] = crossing(column, upper, lower, dp);
    if (own > 0.25) return z;
    upper = lower;
    break;
  }
  // The bed's part only grows downwards, and where it is a quarter the phase cannot be more than half of 1/2.
  while (upper.z > column.floor() && upper.f.bed < 0.25) {
    Level lower;
    if (upper.f.own + upper.f.other == 0 && upper.f.bed == 0) {
      lower.z = std::max({column.next_particle(upper.z - column.reach()), column.bed_top(), column.floor()}) + dp;
      lower.z = std::min(lower.z, upper.z - dp / 2);
    } else {
      lower.z = upper.z - (upper.f.filled() < 0.5 ? step(upper.f) : dp / 2);
    }
    lower.f = column.at(lower.z);
    if (upper.f.filled() < 0.5 && lower.f.filled() >= 0.5) {
      const auto [z, own] = crossing(column, upper, lower, dp);
      if (own > 0.25) return z;
    }
    upper = lower;
  }
  return nan_value;
}

}  // namespace

/// What depends on the scene alone, and memory for what does not.
struct ColumnSurfaceMap::Scene {
  Scene(const ColumnParticles& particles, const SurfaceMap& map, const HeightField& bed)
      : fractions(particles, map, bed),
        water(BinGrid(map, particles.dimension, particles.h)),
        soil(BinGrid(map, particles.dimension, particles.h)) {
    const bool flat = particles.dimension == 2;
    for (std::size_t i = 0; i < map.nx; ++i)
      x_images.push_back(images(map.x(i), particles.wall_low[0], particles.wall_high[0], 2 * particles.h));
    for (std::size_t j = 0; j < map.ny; ++j)
      y_images.push_back(images(map.y(j * map.nx), flat ? -infinity : particles.wall_low[1],
                                flat ? infinity : particles.wall_high[1], 2 * particles.h));
  }

  BedFractions fractions;
  PhaseBins water, soil;
  std::vector<std::vector<double>> x_images, y_images;
  ColumnSurfaces result;
};

ColumnSurfaceMap::ColumnSurfaceMap(const SurfaceMap& map, const HeightField& bed) : map_(map), bed_(bed) {
  LGIW_EXPECT(map.nx > 0 && map.ny > 0 && map.dx > 0);
}
ColumnSurfaceMap::~ColumnSurfaceMap() = default;

const ColumnSurfaces& ColumnSurfaceMap::operator()(const ColumnParticles& particles) {
  LGIW_EXPECT(particles.dp > 0 && particles.h > 0);
  if (!scene_) scene_ = std::make_unique<Scene>(particles, map_, bed_);
  const double dp = particles.dp;
  PhaseBins &water = scene_->water, &soil = scene_->soil;
  water.fill(particles, 0, particles.n_water);
  soil.fill(particles, particles.n_water, particles.n_soil);

  ColumnSurfaces& result = scene_->result;
  const auto clear = [&](std::vector<float>& values, bool wanted) {
    values.assign(wanted ? map_.size() : 0, nan_float);
  };
  clear(result.water, true), clear(result.depth, true), clear(result.soil, particles.n_soil);
  clear(result.speed, particles.velocity), clear(result.soil_speed, particles.velocity && particles.n_soil);
  const double reach = std::max(map_.dx, particles.h) / 2;  // at least h/2: a wet column holds a particle

  // Guesses go from node to node within a block of a row, so that they do not depend on the threads.
  constexpr std::size_t block = 64;
  const std::size_t blocks = (map_.nx + block - 1) / block;
#pragma omp parallel
  {
    Column column(particles, scene_->fractions);
#pragma omp for schedule(dynamic, 1)
    for (std::size_t b = 0; b < blocks * map_.ny; ++b) {
      const std::size_t j = b / blocks, first = b % blocks * block;
      Neighbours soil_before, water_before;
      for (std::size_t i = first; i < std::min(map_.nx, first + block); ++i) {
        const std::size_t node = j * map_.nx + i;
        const double x = map_.x(node), y = map_.y(node);
        const std::vector<double>&xi = scene_->x_images[i], &yi = scene_->y_images[j];
        double soil_z = nan_value;
        if (particles.n_soil) {
          column.place(node, xi, yi, soil, nullptr);
          soil_z = highest_surface(column, dp, soil_before.guess(dp));
          soil_before.add(soil_z);
          result.soil[node] = float(soil_z);
          if (particles.velocity && !std::isnan(soil_z))
            result.soil_speed[node] = soil.largest_speed(x, y, reach, soil_z + dp / 2);
        }
        if (!particles.n_water) continue;
        column.place(node, xi, yi, water, particles.n_soil ? &soil : nullptr);
        const double water_z = highest_surface(column, dp, water_before.guess(dp));
        water_before.add(water_z);
        if (std::isnan(water_z)) continue;
        result.water[node] = float(water_z);
        double base = bed_.empty() ? nan_value : bed_.height(x, y);
        if (soil_z < water_z && !(soil_z < base)) base = soil_z;
        result.depth[node] = float(std::max(0.0, water_z - base));
        if (particles.velocity) result.speed[node] = water.largest_speed(x, y, reach, water_z + dp / 2);
      }
    }
  }
  return result;
}

ColumnSurfaces column_surfaces(const ColumnParticles& particles, const SurfaceMap& map, const HeightField& bed) {
  return ColumnSurfaceMap(map, bed)(particles);
}

ColumnParticles column_particles(const ParticleHeader& header) {
  ColumnParticles columns;
  columns.dimension = header.dimension, columns.dp = header.dp, columns.h = 1.5 * header.dp;
  columns.n_water = std::size_t(header.counts.water), columns.n_soil = std::size_t(header.counts.soil);
  for (std::size_t side = 0; side < 4; ++side) {
    if (header.sides[side] == Side::open || (side >= 2 && header.dimension == 2)) continue;
    (side % 2 ? columns.wall_high : columns.wall_low)[side / 2] =
        side % 2 ? header.high[side / 2] : header.low[side / 2];
  }
  return columns;
}

ColumnParticles column_particles(const ParticleHeader& header, const Frame& frame) {
  ColumnParticles columns = column_particles(header);
  columns.xyz = frame.points.data(), columns.velocity = frame.velocity.data(), columns.lost = frame.lost.data();
  return columns;
}

}  // namespace lgiw
