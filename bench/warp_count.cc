// What the threads of a CUDA warp wait for while they look for neighbours, counted on the host: a warp is as slow as
// its slowest thread, row by row. Says how often a warp looks at a candidate and computes a pair, for cells of several
// widths, lists of several lengths and one or four candidates at a stroke, in water at rest. Ends with 1 where the
// neighbours found are not those there are.
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

/// Particles sorted as a device sorts them, in cells of which `edge` are as wide as the reach, and narrower along the
/// rows by `split`.
struct Scene {
  double h;
  Grid<float, 3> grid;
  std::vector<Place> x;
  std::vector<int> start;

  Scene(double spacings, int edge, int split) : h(spacings) {
    const double low[3] = {0, 0, 0}, high[3] = {size, size, size};
    grid = Grid<float, 3>(low, high, Grid<float, 3>::reach_of_device(h) / edge, edge, split);
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
  double warps = 0, rows = 0, looks = 0, pairs = 0, neighbours = 0;
};

/// One warp from particle `first` on, whose threads look at `stroke` candidates at a stroke (Pass::for_each_listed).
void count(const Scene& s, int first, int list, int stroke, Count& sum) {
  std::array<int, warp> j, end, listed{};
  std::vector<NearRows<float, 3>> near;
  for (int lane = 0; lane < warp; ++lane) near.emplace_back(s.grid, s.grid.in_cell(s.x[std::size_t(first + lane)]));
  const int rows = near[0].count();
  sum.warps += 1, sum.rows += rows;
  for (int k = 0; k <= rows; ++k) {
    j.fill(0), end.fill(0);
    for (int lane = 0; lane < warp && k < rows; ++lane) near[lane].next(s.start.data(), j[lane], end[lane]);
    for (;;) {
      for (bool more = true; more;) {  // an iteration of the loop over candidates, for all lanes
        more = false;
        for (int lane = 0; lane < warp; ++lane) {
          if (j[lane] >= end[lane] || listed[lane] > list - stroke) continue;
          more = true;
          for (int m = 0; m < stroke; ++m, ++j[lane])
            if (j[lane] < end[lane] && s.near(first + lane, j[lane])) ++listed[lane], ++sum.neighbours;
        }
        sum.looks += more ? stroke : 0;
      }
      const int most = *std::max_element(listed.begin(), listed.end());
      if (most > list - stroke || k == rows) sum.pairs += most, listed.fill(0);
      bool done = true;
      for (int lane = 0; lane < warp; ++lane) done = done && j[lane] >= end[lane];
      if (done) break;
    }
  }
}

}  // namespace

int main() {
  std::printf("%6s %15s %15s %6s %7s %12s %6s %12s %12s\n", "h/dp", "across rows, h", "along rows, h", "list", "stroke",
              "neighbours", "rows", "looks", "pairs");
  bool all_found = true;
  for (const double spacings : {1.5, 2.0})
    for (const auto& [edge, split] : {std::pair(1, 1), std::pair(2, 1), std::pair(2, 2), std::pair(3, 1)}) {
      const Scene scene(spacings, edge, split);
      for (const auto& [list, stroke] :
           {std::pair(CudaDevice::list, 1), std::pair(CudaDevice::list, 4), std::pair(48, 4)}) {
        Count sum;
        double there = 0;
        for (int first = 0; first + warp <= int(scene.x.size()); first += 61 * warp) {
          bool inside = true;
          for (int lane = 0; lane < warp; ++lane) inside = inside && scene.inside(first + lane);
          if (!inside) continue;
          count(scene, first, list, stroke, sum);
          for (int lane = 0; lane < warp; ++lane)
            for (int i = 0; i < int(scene.x.size()); ++i) there += scene.near(first + lane, i);
        }
        all_found = all_found && sum.warps > 0 && sum.neighbours == there;
        std::printf("%6.1f %15.2f %15.2f %6d %7d %12.0f %6.0f %12.0f %12.0f\n", spacings, 2.0 / edge,
                    2.0 / edge / split, list, stroke, sum.neighbours / sum.warps / warp, sum.rows / sum.warps,
                    sum.looks / sum.warps, sum.pairs / sum.warps);
      }
    }
  return all_found ? 0 : 1;
}
