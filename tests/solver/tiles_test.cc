// Which cells a pass of the CPU may skip, and in which rows of cells one of a device looks.
#include "solver/tiles.hh"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "solver/openmp_backend.hh"

namespace lgiw {
namespace {

constexpr double h = 0.3;

template <int D>
struct Cells {
  Grid<float, D> grid;
  NearCells<Cpu<LGIW_LANES>, float, D> near;
  std::vector<int> start;
  std::vector<unsigned char> marks, spare;

  explicit Cells(const std::array<double, 3>& size)
      : grid(std::array<double, 3>{}.data(), size.data(), OpenMpBackend<Cpu<LGIW_LANES>>::cell_width(h, D)),
        near(grid, float(h)),
        marks(std::size_t(grid.cells)),
        spare(marks) {}
  /// Marks the cells near particles at x.
  void mark(const std::vector<Vec<float, D>>& x) {
    start.assign(std::size_t(grid.cells) + 1, 0);
    for (const auto& p : x) ++start[std::size_t(grid.cell(p)) + 1];
    for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
    near.mark(start.data(), marks.data(), spare.data());
  }
};

template <int D>
std::vector<Vec<float, D>> anywhere(std::size_t n, const std::array<double, 3>& size, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Vec<float, D>> x(n);
  for (auto& p : x)
    for (int k = 0; k < D; ++k) p.c[k] = std::uniform_real_distribution<float>(0, float(size[std::size_t(k)]))(random);
  return x;
}

/// Cells within whose reach a particle is are marked: no pair of particles is missed.
template <int D>
void expect_all_pairs_marked() {
  const std::array<double, 3> size{20, 9, 5};
  Cells<D> cells(size);
  const auto phase = anywhere<D>(20, size, 1), others = anywhere<D>(20000, size, 2);
  cells.mark(phase);
  int met = 0, skipped = 0;
  for (const auto& q : others) {
    const bool marked = cells.marks[std::size_t(cells.grid.cell(q))] == 1;
    skipped += !marked;
    for (const auto& p : phase) {
      if (dot(q - p, q - p) >= cells.near.reach() * cells.near.reach()) continue;
      ++met;
      EXPECT_TRUE(marked);
    }
  }
  EXPECT_GT(met, 100);
  EXPECT_GT(skipped, 5000);
}

TEST(Tiles, MarkAllCellsWithinReach) {
  expect_all_pairs_marked<2>();
  expect_all_pairs_marked<3>();
}

/// The rows of a tile hold every particle within reach of its box, also where particles lie beyond the grid, whose
/// outer cells they are counted to.
template <int D>
void expect_rows_hold_what_is_near() {
  const std::array<double, 3> size{8, 5, 4};
  Cells<D> cells(size);
  auto x = anywhere<D>(4000, {8, 5, 4}, 3);
  for (std::size_t i = 0; i < 200; ++i) x[i].c[i % D] = i % 2 ? float(size[i % D]) + 0.4f : -0.4f;
  std::sort(x.begin(), x.end(), [&](const auto& a, const auto& b) { return cells.grid.cell(a) < cells.grid.cell(b); });
  cells.mark(x);
  std::vector<float> place[D];
  const float* places[D];
  for (int k = 0; k < D; ++k) {
    for (const auto& p : x) place[k].push_back(p.c[k]);
    places[k] = place[k].data();
  }
  const float reach2 = cells.near.reach() * cells.near.reach();
  int tiles = 0, near = 0, beyond = 0;
  for (int c = 0; c < cells.grid.cells; ++c) {
    const int begin = cells.start[std::size_t(c)], end = cells.start[std::size_t(c) + 1];
    if (begin == end) continue;
    int row_count = -1;
    std::pair<int, int> rows[TileTable<float, D>::most_rows];
    NearBox<float, D> box;
    cells.near.find_tile(TileTable<float, D>{1, &c, &row_count, rows, &box}, 0, places, begin, end);
    ASSERT_GT(row_count, 0);
    ASSERT_LE(row_count, (TileTable<float, D>::most_rows));
    for (int k = 1; k < row_count; ++k) ASSERT_GE(rows[k].first, rows[k - 1].second) << "a cell in two rows";
    ++tiles;
    for (const auto& p : x) {
      float d2 = 0;
      for (int k = 0; k < D; ++k) {
        const float d = std::max({box.low[k] - p.c[k], p.c[k] - box.high[k], 0.0f});
        d2 += d * d;
      }
      const int cell = cells.grid.cell(p);
      const bool held =
          std::any_of(rows, rows + row_count, [&](const auto& r) { return cell >= r.first && cell < r.second; });
      if (d2 < reach2) {
        ++near;
        ASSERT_TRUE(held) << "cell " << cell << " of tile " << c;
      } else {
        beyond += !held;
      }
    }
  }
  EXPECT_GT(tiles, 50);
  EXPECT_GT(beyond, near) << "rows that hold everything";
}
TEST(Tiles, RowsHoldWhatIsNear) {
  expect_rows_hold_what_is_near<2>();
  expect_rows_hold_what_is_near<3>();
}

/// The rows of a particle on a device hold every particle within reach of it, once.
template <class T, int D>
void expect_device_rows_hold_what_is_near(int edge, int split) {
  SCOPED_TRACE(testing::Message() << D << "-D, cells " << edge << " times within reach, along rows " << split);
  const std::array<double, 3> low{-3, 1e4, 50}, size{5, 3, 4};
  std::array<double, 3> high;
  for (std::size_t k = 0; k < 3; ++k) high[k] = low[k] + size[k];
  const Grid<T, D> grid(low.data(), high.data(), Grid<T, D>::reach_of_device(h) / edge, edge, split);
  std::vector<Vec<T, D>> x;
  for (const auto& p : anywhere<D>(3000, size, 5)) {
    Vec<T, D> moved;
    for (int k = 0; k < D; ++k) moved.c[k] = T(low[std::size_t(k)] + double(p.c[k]));
    x.push_back(moved);
  }
  std::sort(x.begin(), x.end(), [&](const auto& a, const auto& b) { return grid.cell(a) < grid.cell(b); });
  std::vector<int> start(std::size_t(grid.cells) + 1);
  for (const auto& p : x) ++start[std::size_t(grid.cell(p)) + 1];
  for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];

  const T reach = T(2 * reach_in_supports) * T(h);
  std::size_t near = 0, looked_at = 0;
  for (const auto& p : x) {
    std::vector<int> held(x.size(), 0);
    NearRows<T, D> rows(grid, grid.in_cell(p));
    for (int k = rows.count(); k > 0; --k) {
      int begin, end;
      rows.next(start.data(), begin, end);
      ASSERT_TRUE(0 <= begin && begin <= end && end <= int(x.size()));
      for (int j = begin; j < end; ++j) ++held[std::size_t(j)], ++looked_at;
    }
    for (std::size_t j = 0; j < x.size(); ++j) {
      const bool is_near = dot(p - x[j], p - x[j]) < reach * reach;
      near += is_near;
      ASSERT_LE(held[j], 1);
      ASSERT_TRUE(held[j] == 1 || !is_near) << j;
    }
  }
  EXPECT_GT(near, 30 * x.size());
  // All of the rows of a cell would be 6.4 times as many (cells as wide as the reach), or 3.7 (half as wide).
  EXPECT_LT(double(looked_at), (edge == 1 ? 5 : 3) * double(near)) << "rows that hold too much";
}
TEST(Tiles, RowsOfADeviceHoldWhatIsNear) {
  for (const auto& [edge, split] : {std::pair(2, 2), std::pair(2, 1), std::pair(1, 1), std::pair(3, 2)}) {
    expect_device_rows_hold_what_is_near<float, 2>(edge, split);
    expect_device_rows_hold_what_is_near<float, 3>(edge, split);
    expect_device_rows_hold_what_is_near<double, 2>(edge, split);
    expect_device_rows_hold_what_is_near<double, 3>(edge, split);
  }
}

template <int D>
std::ptrdiff_t marked_around_one() {
  Cells<D> cells({9, 9, 9});
  Vec<float, D> middle;
  for (float& c : middle.c) c = 4.5f;
  cells.mark({middle});
  return std::count(cells.marks.begin(), cells.marks.end(), 1);
}

/// In 3-D cells are narrower than the reach: five along an axis, but not both of two axes.
TEST(Tiles, MarkFewOthers) {
  EXPECT_EQ(marked_around_one<2>(), 9);
  EXPECT_EQ(marked_around_one<3>(), 27 + 6 * 9);
}

/// More cells than one thread takes, particles at the corners, and marks of before that are wrong.
TEST(Tiles, MarkLargeDomains) {
  const std::array<double, 3> size{60, 50, 20};
  Cells<3> cells(size);
  ASSERT_GT(cells.grid.cells, 200000);
  auto phase = anywhere<3>(50, size, 3);
  for (int corner = 0; corner < 8; ++corner) {
    Vec<float, 3> p;
    for (int k = 0; k < 3; ++k) p.c[k] = corner >> k & 1 ? float(size[std::size_t(k)]) : 0.f;
    phase.push_back(p);
  }
  std::fill(cells.marks.begin(), cells.marks.end(), 1);
  cells.mark(phase);
  EXPECT_LT(std::count(cells.marks.begin(), cells.marks.end(), 1), 58 * 82);
  for (const auto& p : phase) {
    const int c = cells.grid.cell(p);
    for (int k = 0; k < 3; ++k)
      for (int by : {-2, 2}) EXPECT_EQ(cells.marks.at(std::size_t(c + by * cells.grid.stride[k])), 1);
  }
}

}  // namespace
}  // namespace lgiw
