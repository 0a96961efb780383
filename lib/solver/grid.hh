// The cell grid that finds neighbours. Cells are numbered along the shortest side of the domain first and along the
// longest last: a row of them is a contiguous range of the particles of a phase, sorted by cell, and neighbours lie
// close to each other in memory.
#pragma once

#include <utility>

#include "physics/vec.hh"

namespace lgiw {

/// How far to look for neighbours, in supports of the kernel: rates are taken where particles were half a step ago, so
/// that pairs that have just left the support still count.
constexpr double reach_in_supports = 1.005;

template <class T, int D>
struct Grid {
  double low[D];
  double inverse_width;
  int n[D];
  int order[D], stride[D];  // axes from the first to the last numbered; cells between neighbours along each axis
  int cells;                // the product of n; also the key of particles that have left the domain
  int margin;               // no particle lies in so many cells along the edges: those of a row

  Grid() = default;
  /// Covers the box from `low_corner` to `high_corner` with cells_margin + 1 cells to spare on each side, so that the
  /// rows of any particle, walls included, lie inside the grid.
  Grid(const double* low_corner, const double* high_corner, double width, int cells_margin = 1) : margin(cells_margin) {
    inverse_width = 1 / width;
    double total = 1;
    for (int k = 0; k < D; ++k) {
      low[k] = low_corner[k] - (margin + 1) * width;
      n[k] = int(std::ceil((high_corner[k] - low_corner[k]) / width)) + 2 * (margin + 1);
      total *= n[k];
    }
    cells = total < 2.0e9 ? int(total) : -1;
    for (int k = 0; k < D; ++k) order[k] = k;
    for (int k = 1; k < D; ++k)
      for (int m = k; m > 0 && n[order[m]] < n[order[m - 1]]; --m) std::swap(order[m], order[m - 1]);
    for (int k = 0, step = 1; k < D && cells > 0; step *= n[order[k++]]) stride[order[k]] = step;
  }

  LGIW_FN int coordinate(double x, int k) const {
    const int c = int((x - low[k]) * inverse_width);
    return c < margin ? margin : (c > n[k] - 1 - margin ? n[k] - 1 - margin : c);
  }
  template <class P>
  LGIW_FN int cell(const Vec<P, D>& x) const {
    int c = 0;
    for (int k = 0; k < D; ++k) c += coordinate(double(x[k]), k) * stride[k];
    return c;
  }
  /// The grid of a device, whose passes look through all cells within reach. Cells of half the reach have fewer
  /// candidates than cells as wide as the reach, by a third (bench/warp_count.cc), but there are eight times as many:
  /// not where a domain is so empty that they would outnumber the particles by more than `most_cells_a_particle`.
  static Grid of_device(const double* low_corner, const double* high_corner, double h, double particles) {
    const double reach = 2 * h * reach_in_supports * (1 + 1e-6);
    const Grid fine(low_corner, high_corner, reach / 2, 2);
    if (fine.cells > 0 && fine.cells <= most_cells_a_particle * particles + 1e5) return fine;
    return Grid(low_corner, high_corner, reach, 1);
  }
  static constexpr double most_cells_a_particle = 16;  // 64 bytes a phase

  /// The rows of 2 margin + 1 cells around a cell, of which there are rows(), one after the other.
  struct Row {
    int middle;      // cell
    int beside = 0;  // rows before it in its plane
  };
  LGIW_FN int rows() const { return D == 2 ? 2 * margin + 1 : (2 * margin + 1) * (2 * margin + 1); }
  LGIW_FN Row first_row(int cell) const {
    return {cell - margin * (stride[order[1]] + (D == 2 ? 0 : stride[order[D - 1]]))};
  }
  LGIW_FN void to_next(Row& row) const {
    row.middle += stride[order[1]];
    if (++row.beside <= 2 * margin) return;
    row.beside = 0;
    row.middle += stride[order[D - 1]] - (2 * margin + 1) * stride[order[1]];
  }
  /// Its particles [begin, end); `start` has cells + 1 entries.
  LGIW_FN void particles(const int* start, const Row& row, int& begin, int& end) const {
    begin = start[row.middle - margin];
    end = start[row.middle + margin + 1];
  }
};

/// Writes start[c], the index of the first of n sorted keys that is not less than c, for `run` cells c from run * k on:
/// by bisection for the first, then one after the other. Threads need nothing of each other, however many empty cells
/// lie between two particles.
struct CellStart {
  static constexpr int run = 32;
  const int* key;
  int n, cells;
  int* start;
  /// How many there are.
  static int runs(int cells) { return cells / run + 1; }
  LGIW_FN void operator()(int k) const {
    int first = 0, count = n;
    while (count > 0) {
      const int half = count / 2;
      if (key[first + half] < run * k)
        first += half + 1, count -= half + 1;
      else
        count = half;
    }
    for (int c = run * k; c < run * (k + 1) && c <= cells; ++c) {
      while (first < n && key[first] < c) ++first;
      start[c] = first;
    }
  }
};

}  // namespace lgiw
