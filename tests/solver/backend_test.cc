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

/// Sorts n random keys of 0 ... cells with so many threads, against the standard library.
void check_sort(int n, int cells, int threads) {
  SCOPED_TRACE(std::to_string(n) + " keys, " + std::to_string(cells) + " cells, " + std::to_string(threads) +
               " threads");
  std::mt19937 random(7);
  std::uniform_int_distribution<int> any(0, cells);  // `cells` itself: left the domain
  std::vector<int> key(n), expected(n);
  for (int& k : key) k = any(random);
  std::iota(expected.begin(), expected.end(), 0);
  std::stable_sort(expected.begin(), expected.end(), [&](int a, int b) { return key[a] < key[b]; });

  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Backend backend;
  const Backend::Array<int> keys(n), order(n), start(cells + 1);
  backend.upload(keys, key.data());
  for (int round = 0; round < 2; ++round) backend.sort_by_cell(keys, cells, order, start);
  omp_set_num_threads(before);
  ASSERT_TRUE(std::equal(expected.begin(), expected.end(), order.data()));
  int first = 0;
  for (int c = 0; c <= cells; ++c) {
    while (first < n && key[expected[first]] < c) ++first;
    ASSERT_EQ(start.data()[c], first) << "cell " << c;
  }
}

TEST(Sort, IsStableWithAnyNumberOfThreads) {
  for (int threads : {1, 2, 3, 8}) {
    check_sort(50000, 1000, threads);   // in parallel where there are threads
    check_sort(50000, 90000, threads);  // too empty a domain for that
    check_sort(500, 30, threads);
    check_sort(25000, 1, threads);
  }
}

// What a device's threads do where the CPU counts.
TEST(CellStart, OfEachCellByItself) {
  const int cells = 1000;
  for (const std::vector<int>& key :
       {std::vector<int>{}, {0}, {cells}, {0, 0, 0, cells}, {3, 3, 500, 500, 500, 501, 999, cells, cells}}) {
    std::vector<int> start(cells + 1, -1);
    const CellStart write{key.data(), int(key.size()), start.data()};
    for (int c = cells; c >= 0; --c) write(c);
    for (int c = 0; c <= cells; ++c)
      ASSERT_EQ(start[c], std::count_if(key.begin(), key.end(), [&](int k) { return k < c; })) << "cell " << c;
  }
}

}  // namespace
}  // namespace lgiw
