// What the threads of a CUDA warp wait for while they look for neighbours, counted on the host: a warp is as slow as
// its slowest thread, row by row. Says how often a warp looks at a candidate and computes a pair, for cells of several
// widths and lists of several lengths, in water at rest. Ends with 1 where the neighbours found are not those there
// are.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <random>
#include <vector>

#include "solver/grid.hh"
#include "solver/machine.hh"

namespace {

using namespace lgiw;
constexpr int warp = 32;
constexpr double size = 44;  // of the cube, in particle spacings
using Place = Vec<float, 3>;

/// Particles in cells of 2h / reach, sorted as a device sorts them.
struct Scene {
  double h;
  Grid<float, 3> grid;
  std::vector<Place> x;
  std::vector<int> start;

  Scene(double spacings, int reach) : h(spacings) {
    const double low[3] = {0, 0, 0}, high[3] = {size, size, size};
    grid = Grid<float, 3>(low, high, 2 * h * reach_in_supports / reach * (1 + 1e-6), reach);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> off(-0.35f, 0.35f);
    for (int a = 0; a < int(size); ++a)
      for (int b = 0; b < int(size); ++b)
        for (int c = 0; c < int(size); ++c) {
          Place p;
          p.c[0] = float(a) + 0.5f + off(random), p.c[1] = float(b) + 0.5f + off(random);
          p.c[2] = float(c) + 0.5f + off(random);
          x.push_back(p);
        }
    std::stable_sort(x.begin(), x.end(), [&](const Place& p, const Place& q) { return grid.cell(p) < grid.cell(q); });
    std::vector<int> key(x.size());
    std::transform(x.begin(), x.end(), key.begin(), [&](const Place& p) { return grid.cell(p); });
    start.resize(std::size_t(grid.cells) + 1);
    for (int k = 0; k < CellStart::runs(grid.cells); ++k)
      CellStart{key.data(), int(x.size()), grid.cells, start.data()}(k);
  }
  bool near(int i, int j) const {
    const Place r = x[std::size_t(i)] - x[std::size_t(j)];
    return double(dot(r, r)) < 4 * h * h * reach_in_supports * reach_in_supports;
  }
  bool inside(int i) const {  // far from the surface, where neighbours are fewer
    const auto far = [&](float c) { return c > 2 * h && c < size - 2 * h; };
    const Place& p = x[std::size_t(i)];
    return far(p.c[0]) && far(p.c[1]) && far(p.c[2]);
  }
};

struct Count {
  double warps = 0, looks = 0, pairs = 0, neighbours = 0;
};

/// One warp from particle `first` on. list 0: whatever is near is computed at once.
void count(const Scene& s, int first, int list, Count& sum) {
  std::array<int, warp> j, end, listed{};
  std::array<Grid<float, 3>::Row, warp> row;
  for (int lane = 0; lane < warp; ++lane) row[lane] = s.grid.first_row(s.grid.cell(s.x[std::size_t(first + lane)]));
  const int rows = s.grid.rows();
  sum.warps += 1;
  for (int k = 0; k <= rows; ++k) {
    j.fill(0), end.fill(0);
    for (int lane = 0; lane < warp && k < rows; ++lane) {
      s.grid.particles(s.start.data(), row[lane], j[lane], end[lane]);
      s.grid.to_next(row[lane]);
    }
    for (;;) {
      for (bool more = true; more;) {  // an iteration of the loop over candidates, for all lanes
        bool computes = false;
        more = false;
        for (int lane = 0; lane < warp; ++lane) {
          if (j[lane] == end[lane] || (list > 0 && listed[lane] == list)) continue;
          more = true;
          if (s.near(first + lane, j[lane]++)) ++listed[lane], ++sum.neighbours, computes = true;
        }
        sum.looks += more;
        if (list == 0) sum.pairs += computes;
      }
      const int most = *std::max_element(listed.begin(), listed.end());
      if (list > 0 && (most == list || k == rows)) sum.pairs += most, listed.fill(0);
      if (j == end) break;
    }
  }
}

}  // namespace

int main() {
  std::printf("%6s %12s %6s %12s %12s %12s\n", "h/dp", "cells, h", "list", "neighbours", "looks", "pairs");
  bool all_found = true;
  for (const double spacings : {1.5, 2.0})
    for (const int reach : {1, 2}) {
      const Scene scene(spacings, reach);
      for (const int list : {0, 16, CudaDevice::list, 64}) {
        Count sum;
        double there = 0;
        for (int first = 0; first + warp <= int(scene.x.size()); first += 61 * warp) {
          bool inside = true;
          for (int lane = 0; lane < warp; ++lane) inside = inside && scene.inside(first + lane);
          if (!inside) continue;
          count(scene, first, list, sum);
          for (int lane = 0; lane < warp; ++lane)
            for (int i = 0; i < int(scene.x.size()); ++i) there += scene.near(first + lane, i);
        }
        all_found = all_found && sum.warps > 0 && sum.neighbours == there;
        std::printf("%6.1f %12.1f %6d %12.0f %12.0f %12.0f\n", spacings, 2.0 / reach, list,
                    sum.neighbours / sum.warps / warp, sum.looks / sum.warps, sum.pairs / sum.warps);
      }
    }
  return all_found ? 0 : 1;
}
