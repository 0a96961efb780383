// What the CPU backend does besides running passes.
#include "solver/openmp_backend.hh"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "solver/grid.hh"

namespace lgiw {
namespace {

using Backend = OpenMpBackend<Cpu<4>>;

/// Sorts n keys of 0 ... cells with so many threads, and lets a field follow, against the standard library: the share
/// `stirred` of the keys is random, the others are in order.
void check_sort(int n, int cells, int threads, double stirred) {
  SCOPED_TRACE(std::to_string(n) + " keys, " + std::to_string(cells) + " cells, " + std::to_string(threads) +
               " threads, " + std::to_string(stirred) + " of the keys random");
  std::mt19937 random(7);
  std::uniform_int_distribution<int> any(0, cells);  // `cells` itself: left the domain
  std::vector<int> key(n), expected(n);
  for (int& k : key) k = any(random);
  std::sort(key.begin(), key.end());
  std::uniform_real_distribution<double> chance(0, 1);
  for (int& k : key)
    if (chance(random) < stirred) k = any(random);
  std::iota(expected.begin(), expected.end(), 0);
  std::stable_sort(expected.begin(), expected.end(), [&](int a, int b) { return key[a] < key[b]; });

  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Backend backend;
  const Backend::Array<int> keys(n), order(n), start(cells + 1);
  backend.upload(keys, key.data());
  const Backend::Array<double> field(n), moved(n);
  const Backend::Array<float> rounded(n);
  const Backend::Array<double> copied(n);
  for (int round = 0; round < 2; ++round) {
    backend.sort_by_cell(keys, cells, order.data(), start, nullptr, nullptr);
    // There and back, as fields follow a sort: the second goes to where the first came from.
    for (int i = 0; i < n; ++i) field.data()[i] = 0.1 * i + round, moved.data()[i] = -1;
    backend.rearrange(
        std::size_t(n), order.data(),
        {Rearrangement::gathered(moved.data(), field.data()), Rearrangement::gathered(field.data(), moved.data()),
         Rearrangement::rounded(rounded.data(), field.data()), Rearrangement::copied(copied.data(), field.data())});
    for (int k = 0; k < n; ++k) {
      ASSERT_EQ(moved.data()[k], 0.1 * expected[k] + round) << k;
      ASSERT_EQ(field.data()[k], 0.1 * expected[expected[k]] + round) << k;
      ASSERT_EQ(rounded.data()[k], float(field.data()[k])) << k;
      ASSERT_EQ(copied.data()[k], field.data()[k]) << k;
    }
  }
  omp_set_num_threads(before);
  ASSERT_TRUE(std::equal(expected.begin(), expected.end(), order.data()));
  int first = 0;
  for (int c = 0; c <= cells; ++c) {
    while (first < n && key[expected[first]] < c) ++first;
    ASSERT_EQ(start.data()[c], first) << "cell " << c;
  }
}

TEST(Sort, IsStableAndFollowedWithAnyNumberOfThreads) {
  for (int threads : {1, 2, 3, 8})
    for (double stirred : {0.0, 0.01, 0.2, 1.0}) {
      check_sort(50000, 1000, threads, stirred);   // in parallel where there are threads
      check_sort(50000, 90000, threads, stirred);  // too empty a domain for that
      check_sort(500, 30, threads, stirred);
      check_sort(25000, 1, threads, stirred);
      check_sort(1, 5, threads, stirred);
    }
}

// What a device's threads do where the CPU counts.
TEST(CellStart, OfEachRunOfCellsByItself) {
  for (const int cells : {1, CellStart::run - 1, CellStart::run, 1000, 32 * CellStart::run})
    for (const std::vector<int>& key :
         {std::vector<int>{}, {0}, {cells}, {0, 0, 0, cells}, {3, 3, 500, 500, 500, 501, 999, cells, cells}}) {
      std::vector<int> start(std::size_t(cells) + 2, -1);
      const CellStart write{key.data(), int(key.size()), cells, start.data()};
      for (int k = CellStart::runs(cells) - 1; k >= 0; --k) write(k);
      for (int c = 0; c <= cells; ++c)
        ASSERT_EQ(start[c], std::count_if(key.begin(), key.end(), [&](int other) { return other < c; }))
            << "cell " << c << " of " << cells;
      ASSERT_EQ(start[cells + 1], -1);
    }
}

}  // namespace
}  // namespace lgiw
