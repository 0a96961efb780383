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

/// Where a particle is in a grid: its cell, and how far into it, in widths of a cell from 0 to 1: along the rows first.
template <class T, int D>
struct InCell {
  int cell;
  T at[D];
};

template <class T, int D>
struct Grid {
  double low[D];
  double inverse_width[D];
  int n[D];
  int order[D], stride[D];  // axes from the first to the last numbered; cells between neighbours along each axis
  int cells;                // the product of n; also the key of particles that have left the domain
  int edge;                 // no particle lies in so many cells along the edges; along the rows `split` times as many
  int split;                // so many times are cells narrower along the rows

  Grid() = default;
  /// Covers the box from `low_corner` to `high_corner` with edge + 1 cells of `width` to spare on each side, so that
  /// whatever lies within `edge` widths of a particle, walls included, lies inside the grid.
  Grid(const double* low_corner, const double* high_corner, double width, int edge_ = 1, int split_ = 1)
      : edge(edge_), split(split_) {
    const auto length = [&](int k) { return std::ceil((high_corner[k] - low_corner[k]) / width); };
    for (int k = 0; k < D; ++k) order[k] = k;
    for (int k = 1; k < D; ++k)
      for (int m = k; m > 0 && length(order[m]) < length(order[m - 1]); --m) std::swap(order[m], order[m - 1]);
    double total = 1;
    for (int k = 0; k < D; ++k) {
      const double w = k == order[0] ? width / split : width;
      inverse_width[k] = 1 / w;
      low[k] = low_corner[k] - (edge + 1) * width;
      n[k] = int(std::ceil((high_corner[k] - low_corner[k]) / w)) + 2 * (edge + 1) * (k == order[0] ? split : 1);
      total *= n[k];
    }
    cells = total < 2.0e9 ? int(total) : -1;
    for (int k = 0, step = 1; k < D && cells > 0; step *= n[order[k++]]) stride[order[k]] = step;
  }

  /// Cells along the edges of axis k without particles.
  LGIW_FN int at_edge(int k) const { return k == order[0] ? edge * split : edge; }
  LGIW_FN int coordinate(double x, int k) const { return held(int((x - low[k]) * inverse_width[k]), k); }
  template <class P>
  LGIW_FN int cell(const Vec<P, D>& x) const {
    int c = 0;
    for (int k = 0; k < D; ++k) c += coordinate(double(x[k]), k) * stride[k];
    return c;
  }
  template <class P>
  LGIW_FN InCell<T, D> in_cell(const Vec<P, D>& x) const {
    InCell<T, D> in;
    T at[D];
    in.cell = 0;
    for (int k = 0; k < D; ++k) {
      const double u = (double(x[k]) - low[k]) * inverse_width[k];
      const int c = held(int(u), k);
      at[k] = smallest(T(1), largest(T(0), T(u - c)));
      in.cell += c * stride[k];
    }
    for (int k = 0; k < D; ++k) {
      in.at[k] = at[0];
      for (int axis = 1; axis < D; ++axis) in.at[k] = order[k] == axis ? at[axis] : in.at[k];
    }
    return in;
  }
  /// The grid of a device, whose passes look through the rows of cells within reach. Cells of half the reach, and half
  /// of that along the rows, have 0.6 of the candidates of cells as wide as the reach (bench/warp_count.cc), but there
  /// are sixteen times as many: not where a domain is so empty that they would outnumber the particles by more than
  /// `most_cells_a_particle`.
  static Grid of_device(const double* low_corner, const double* high_corner, double h, double particles) {
    const double reach = reach_of_device(h);
    for (int split : {2, 1}) {
      const Grid fine(low_corner, high_corner, reach / 2, 2, split);
      if (fine.cells > 0 && fine.cells <= most_cells_a_particle * particles + 1e5) return fine;
    }
    return Grid(low_corner, high_corner, reach, 1);
  }
  /// Something more than the reach itself, for the rounding of places in a cell.
  static double reach_of_device(double h) { return 2 * h * reach_in_supports * (1 + 1e-5); }
  static constexpr double most_cells_a_particle = 16;  // 64 bytes a phase

 private:
  LGIW_FN int held(int c, int k) const {
    const int first = at_edge(k), last = n[k] - 1 - first;
    return c < first ? first : (c > last ? last : c);
  }
};

/// The rows of cells near a particle, one after the other; of each only what lies within `edge` widths of it.
template <class T, int D>
class NearRows {
 public:
  LGIW_FN NearRows(const Grid<T, D>& grid, const InCell<T, D>& in)
      : in_(in), edge_(grid.edge), split_(T(grid.split)), beside_(-edge_), plane_(D == 2 ? 0 : -edge_) {
    for (int k = 0; k < D - 1; ++k) stride_[k] = grid.stride[grid.order[k + 1]];
    row_ = in.cell - edge_ * stride_[0] + plane_ * stride_[D - 2];
  }
  /// How many there are.
  LGIW_FN int count() const { return D == 2 ? 2 * edge_ + 1 : (2 * edge_ + 1) * (2 * edge_ + 1); }
  /// The particles [begin, end) of the next one; start[c] is the first in cell c.
  LGIW_FN void next(const int* start, int& begin, int& end) {
    begin = end = 0;
    const T across = gap(beside_, in_.at[1]), over = D == 2 ? T(0) : gap(plane_, in_.at[D - 1]);
    const T rest = T(edge_ * edge_) - across * across - over * over;
    if (rest > 0) {
      const T chord = split_ * square_root(rest);
      begin = start[row_ + int(std::floor(in_.at[0] - chord))];
      end = start[row_ + int(std::floor(in_.at[0] + chord)) + 1];
    }
    row_ += stride_[0];
    if (++beside_ <= edge_) return;
    beside_ = -edge_, ++plane_;
    row_ += stride_[D - 2] - (2 * edge_ + 1) * stride_[0];
  }

 private:
  /// Between a place in a cell and the cells that are `away` from it along an axis, in widths.
  static LGIW_FN T gap(int away, T at) { return largest(T(0), largest(T(away) - at, at - T(away + 1))); }

  InCell<T, D> in_;
  int edge_;
  T split_;
  int beside_, plane_, row_, stride_[D - 1];
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
