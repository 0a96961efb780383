// The sort of each step: particles by cell.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "kernels.hh"
#include "solver/openmp_backend.hh"

namespace lgiw {
namespace {

using Backend = OpenMpBackend<Cpu<4>>;

/// 15 particles a cell, as in 3-D. In order: as they were sorted a step ago, but for one in a hundred that has changed
/// its cell; else as they come from a file that knows no cells.
void sort(benchmark::State& state, bool in_order) {
  const int n = int(state.range(0)), cells = n / 15;
  std::mt19937 random(7);
  std::uniform_int_distribution<int> any(0, cells - 1);
  std::vector<int> key(n);
  for (int& k : key) k = any(random);
  if (in_order) {
    std::sort(key.begin(), key.end());
    for (int i = 0; i < n; i += 100) key[i] = std::min(cells - 1, key[i] + 1);
  }
  Backend backend;
  const Backend::Array<int> keys(n), order(n), start(cells + 1);
  backend.upload(keys, key.data());
  for (auto _ : state) {
    backend.sort_by_cell(keys, cells, order.data(), start, nullptr, nullptr);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * n);
  for (int k = 1; k < n; ++k)
    if (key[order.data()[k - 1]] > key[order.data()[k]]) return state.SkipWithError("not sorted");
}

}  // namespace

void register_sort() {
  for (const bool in_order : {true, false})
    benchmark::RegisterBenchmark(in_order ? "sort_by_cell/in_order" : "sort_by_cell/random", sort, in_order)
        ->Arg(10000)
        ->Arg(200000)
        ->Arg(1000000)
        ->UseRealTime()
        ->Unit(benchmark::kMicrosecond);
}

}  // namespace lgiw
