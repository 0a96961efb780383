// The cell grid that finds neighbours. Cells are numbered along the shortest side of the domain first and along the
// longest last: a row of them is a contiguous range of the particles of a phase, sorted by cell, and neighbours lie
// close to each other in memory. Where cells are as wide as the kernel's support, the neighbours of a particle lie in
// 3 (2-D) or 9 (3-D) rows of three.
#pragma once

#include <utility>

#include "physics/vec.hh"

namespace lgiw {

template <class T, int D>
struct Grid {
  static constexpr int rows = D == 2 ? 3 : 9;
  double low[D];
  double inverse_width;
  int n[D];
  int order[D], stride[D];  // axes from the first to the last numbered; cells between neighbours along each axis
  int cells;                // the product of n; also the key of particles that have left the domain

  Grid() = default;
  /// Covers the box from `low_corner` to `high_corner` with two cells to spare on each side, so that the neighbouring
  /// rows of any particle, walls included, lie inside the grid.
  Grid(const double* low_corner, const double* high_corner, double width) {
    inverse_width = 1 / width;
    double total = 1;
    for (int k = 0; k < D; ++k) {
      low[k] = low_corner[k] - 2 * width;
      n[k] = int(std::ceil((high_corner[k] - low_corner[k]) / width)) + 4;
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
    return c < 1 ? 1 : (c > n[k] - 2 ? n[k] - 2 : c);
  }
  template <class P>
  LGIW_FN int cell(const Vec<P, D>& x) const {
    int c = 0;
    for (int k = 0; k < D; ++k) c += coordinate(double(x[k]), k) * stride[k];
    return c;
  }
  /// Particles [begin, end) in the k-th row of three cells around `cell`; `start` has cells + 1 entries.
  LGIW_FN void row(const int* start, int cell, int k, int& begin, int& end) const {
    const int c = cell + (k % 3 - 1) * stride[order[1]] + (D == 2 ? 0 : (k / 3 - 1) * stride[order[D - 1]]);
    begin = start[c - 1];
    end = start[c + 2];
  }
};

/// Writes start[c], the index of the first of n sorted keys that is not less than c, by bisection: cells + 1 threads
/// need nothing of each other, however many empty cells lie between two particles, and neighbouring threads read the
/// same keys.
struct CellStart {
  const int* key;
  int n;
  int* start;
  LGIW_FN void operator()(int c) const {
    int first = 0, count = n;
    while (count > 0) {
      const int half = count / 2;
      if (key[first + half] < c)
        first += half + 1, count -= half + 1;
      else
        count = half;
    }
    start[c] = first;
  }
};

}  // namespace lgiw
