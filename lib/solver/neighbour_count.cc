#include "solver/neighbour_count.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace lgiw {
namespace {

constexpr std::size_t most_asked = 100000;

/// Cells as wide as the reach, as a sorted list of those that are not empty: a domain may be large and sparse.
class Cells {
 public:
  Cells(const std::vector<double>& xyz, double reach) : xyz_(xyz), reach_(reach) {
    list_.reserve(xyz.size() / 3);
    for (std::size_t k = 0; k < 3; ++k) low_[k] = xyz[k];
    for (std::size_t i = 0; i < xyz.size(); ++i) low_[i % 3] = std::min(low_[i % 3], xyz[i]);
    for (std::size_t i = 0; i < xyz.size() / 3; ++i) list_.emplace_back(key(cell(i)), i);
    std::sort(list_.begin(), list_.end());
  }
  int64_t neighbours(std::size_t i) const {
    const std::array<int64_t, 3> c = cell(i);
    int64_t count = 0;
    for (int64_t z = c[2] - 1; z <= c[2] + 1; ++z)
      for (int64_t y = c[1] - 1; y <= c[1] + 1; ++y) {
        const int64_t last = key({c[0] + 1, y, z});
        auto at = std::lower_bound(list_.begin(), list_.end(), std::pair(key({c[0] - 1, y, z}), std::size_t(0)));
        for (; at != list_.end() && at->first <= last; ++at) count += at->second != i && near(i, at->second);
      }
    return count;
  }

 private:
  std::array<int64_t, 3> cell(std::size_t i) const {
    std::array<int64_t, 3> c;
    for (std::size_t k = 0; k < 3; ++k) c[k] = 1 + int64_t(std::floor((xyz_[3 * i + k] - low_[k]) / reach_));
    return c;
  }
  /// One number of 21 bits an axis, x last: a row of cells is a range.
  static int64_t key(const std::array<int64_t, 3>& c) { return ((c[2] << 21) + c[1]) * (int64_t(1) << 21) + c[0]; }
  bool near(std::size_t i, std::size_t j) const {
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double d = xyz_[3 * i + k] - xyz_[3 * j + k];
      square += d * d;
    }
    return square < reach_ * reach_;
  }

  const std::vector<double>& xyz_;
  double reach_;
  std::array<double, 3> low_{};
  std::vector<std::pair<int64_t, std::size_t>> list_;  // cell, particle
};

}  // namespace

double mean_neighbours(const std::vector<double>& xyz, std::size_t moving, double reach) {
  if (moving == 0) return 0;
  const Cells cells(xyz, reach);
  const std::size_t stride = (moving + most_asked - 1) / most_asked;
  int64_t sum = 0, asked = 0;
  for (std::size_t i = 0; i < moving; i += stride, ++asked) sum += cells.neighbours(i);
  return double(sum) / double(asked);
}

}  // namespace lgiw
