// Runs the passes with OpenMP on host memory.
#pragma once

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <type_traits>
#include <vector>

#include "solver/backend_array.hh"
#include "solver/passes.hh"
#include "solver/rearrangement.hh"
#include "solver/tiles.hh"

namespace lgiw {

/// Machine: machine.hh.
template <class Machine>
struct OpenMpBackend {
  static constexpr bool on_host = true;
  static constexpr int steps_per_check = 1;

  /// Width of the cells, which are the tiles: about 16 particles in 3-D and 11 in 2-D. Wider ones have more candidates
  /// per neighbour, narrower ones share a copy among fewer particles (docs/performance.md).
  static double cell_width(double h, int dimension) { return (dimension == 2 ? 2.2 : 1.7) * h; }
  template <class T, int D>
  static Grid<T, D> grid(const double* low, const double* high, double h, double) {
    return Grid<T, D>(low, high, cell_width(h, D));
  }

  /// Aligned for vector loads.
  struct Memory {
    static void* take(std::size_t bytes) { return ::operator new(bytes, std::align_val_t(64)); }
    static void give(void* data) { ::operator delete(data, std::align_val_t(64)); }
  };
  template <class T>
  using Array = BackendArray<T, Memory>;
  template <class T>
  using HostArray = Array<T>;
  using Tile = TileMemory<Array<unsigned char>>;

  template <class T>
  void upload(const Array<T>& to, const T* from) {
    if (to.size()) std::memcpy(to.data(), from, to.size() * sizeof(T));
  }
  template <class T>
  void download(T* to, const Array<T>& from) const {
    if (from.size()) download(to, from, 0, from.size());
  }
  /// n values from `first` on.
  template <class T>
  void download(T* to, const Array<T>& from, std::size_t first, std::size_t n) const {
    std::memcpy(to, from.data() + first, n * sizeof(T));
  }
  template <class T>
  void zero(const Array<T>& a) {
    if (a.size()) std::memset(static_cast<void*>(a.data()), 0, a.size() * sizeof(T));
  }

  template <class F>
  void for_each(int n, const F& f) {
    if constexpr (requires { f.block(0, 0); }) {
#pragma omp parallel for schedule(dynamic, 1)
      for (int begin = 0; begin < n; begin += F::block_size) f.block(begin, std::min(n, begin + F::block_size));
    } else {
#pragma omp parallel for schedule(dynamic, 128)
      for (int i = 0; i < n; ++i) f(i);
    }
  }
  template <class F>
  void single(const F& f) {
    f(0);
  }
  /// Runs a pass that looks at neighbours for all particles of `own`.
  template <class View, class F>
  void for_each_near(const View& own, const F& f) {
    over_tiles(own, f, [](F& pass, int i) { pass(i); });
  }
  /// The same, and raises *limits to the largest that f returned.
  template <class T, class View, class F>
  void for_each_near_limits(const View& own, const F& f, Limits<T>* limits) {
    LargestLimits<T> found(*limits);
    over_tiles(own, f, [&](F& pass, int i) { found.add(pass(i)); });
  }
  /// Runs a pass over the pairs of the phase `own`, each pair once: its sums start from zero. Raises *limits where the
  /// pass returns some.
  ///
  /// What a tile adds to later ones would be lost where two threads add at a time. The cells are therefore cut into
  /// slabs as thick as the furthest neighbour: a slab adds to itself and the next, every other slab can be worked on at
  /// a time, and sums are in the same order whatever the number of threads.
  template <class T, class View, class F>
  void for_each_pair(const View& own, const F& f, Limits<T>* limits) {
    constexpr bool limiting = !std::is_void_v<std::invoke_result_t<const F&, int>>;
    const int* start = own.start;
    const auto& tiles = *own.tiles;
    const int cells = f.grid.cells;
    LargestLimits<T> found(*limits);
    prepare_memory();
#pragma omp parallel
    {
      F pass = f;
      PairNeighbourhood<typename F::Types, Tile> near(pass, memory_[omp_get_thread_num()]);
      const int thickness = near.cells().furthest(), slabs = (cells + thickness - 1) / thickness;
      const auto begin_of = [&](int s) { return int(std::min(int64_t(cells), int64_t(s) * thickness)); };
#pragma omp single nowait
      order_slabs(slabs, [&](int s) { return start[begin_of(s + 1)] - start[begin_of(s)]; });
#pragma omp for schedule(static)
      for (int i = 0; i < own.n; ++i) near.clear_sums(i);
      for (const std::vector<int>& turn : slabs_)
#pragma omp for schedule(dynamic, 1)
        for (int k = 0; k < int(turn.size()); ++k) {
          const int end = begin_of(turn[k] + 1);
          int t = int(std::lower_bound(tiles.cell, tiles.cell + tiles.n, begin_of(turn[k])) - tiles.cell);
          for (; t < tiles.n && tiles.cell[t] < end; ++t) {
            near.look(tiles, t);
            for (int i = start[tiles.cell[t]]; i < start[tiles.cell[t] + 1]; ++i)
              if constexpr (limiting)
                found.add(pass(i));
              else
                pass(i);
            near.give_back();
          }
        }
    }
  }

  /// Stable counting sort by key: order[k] is the old index of the k-th particle, start[c] the first of cell c. Needs
  /// no memory of others.
  void sort_by_cell(const Array<int>& key, int cells, int* order, const Array<int>& start, int*, int*) {
    const int n = int(key.size()), threads = omp_get_max_threads();
    // A count of all cells a thread; not where the domain is so empty, or the scene so small, that these cost more.
    if (threads > 1 && n > 20000 && int64_t(cells) * threads < 4 * int64_t(n))
      return sort_by_cell_in_parallel(key.data(), n, cells, order, start.data());
    int* s = start.data();
    std::memset(s, 0, start.size() * sizeof(int));
    for (int i = 0; i < n; ++i) ++s[key.data()[i]];
    int sum = 0;
    for (int c = 0; c <= cells; ++c) {
      const int count = s[c];
      s[c] = sum;
      sum += count;
    }
    for (int i = 0; i < n; ++i) order[s[key.data()[i]]++] = i;
    for (int c = cells; c > 0; --c) s[c] = s[c - 1];  // the fill moved each start to the next one's place
    s[0] = 0;
  }
  /// The same by several threads, and the same result: each counts and places a contiguous share of the particles.
  void sort_by_cell_in_parallel(const int* key, int n, int cells, int* order, int* start) {
    const int width = cells + 1;  // key `cells` counts too
    std::vector<int> sums;
#pragma omp parallel
    {
      const int threads = omp_get_num_threads(), me = omp_get_thread_num();
      const auto share = [&](int of, int k) { return int(int64_t(of) * k / threads); };
#pragma omp single
      {
        counts_.resize(std::size_t(threads) * width);
        sums.assign(threads + 1, 0);
      }
      int* mine = counts_.data() + std::size_t(me) * width;
      std::fill(mine, mine + width, 0);
      for (int i = share(n, me); i < share(n, me + 1); ++i) ++mine[key[i]];
#pragma omp barrier
      const int first = share(width, me), last = share(width, me + 1);
      int sum = 0;
      for (int t = 0; t < threads; ++t)
        for (int c = first; c < last; ++c) sum += counts_[std::size_t(t) * width + c];
      sums[me + 1] = sum;
#pragma omp barrier
      int next = 0;
      for (int t = 0; t <= me; ++t) next += sums[t];
      for (int c = first; c < last; ++c) {
        start[c] = next;
        for (int t = 0; t < threads; ++t) {
          int& count = counts_[std::size_t(t) * width + c];
          const int here = count;
          count = next, next += here;
        }
      }
#pragma omp barrier
      for (int i = share(n, me); i < share(n, me + 1); ++i) order[mine[key[i]]++] = i;
    }
  }
  /// What all passes want to know of a phase after a sort: its tiles, and which cells it is near to (NearCells::mark).
  template <class T, int D>
  class Tiles {
   public:
    const TileTable<T, D>* table() const { return &table_; }
    const unsigned char* cells_near() const { return near_.data(); }
    template <class F>
    void all(F&& f) {
      f(cell_, "tiles"), f(row_count_, "rows of tiles"), f(rows_, "cells near tiles"), f(box_, "boxes of tiles");
      f(near_, "cells near the phase");
    }

   private:
    friend OpenMpBackend;
    /// n of them, with something to spare where there were fewer so far.
    void hold(int n) {
      if (std::size_t(n) > cell_.size()) {
        const std::size_t room = std::size_t(n) + std::size_t(n) / 8;
        cell_ = Array<int>(room), row_count_ = Array<int>(room), box_ = Array<NearBox<T, D>>(room);
        rows_ = Array<std::pair<int, int>>(room * std::size_t(TileTable<T, D>::most_rows));
      }
      table_ = {n, cell_.data(), row_count_.data(), rows_.data(), box_.data()};
    }

    TileTable<T, D> table_;
    Array<int> cell_, row_count_;
    Array<std::pair<int, int>> rows_;
    Array<NearBox<T, D>> box_;
    Array<unsigned char> near_;
  };
  /// x: where the particles of the phase are; start[c] is the first in cell c.
  template <class T, int D>
  void find_tiles(const Grid<T, D>& grid, T h, const T* const* x, const Array<int>& start, Tiles<T, D>& tiles) {
    const NearCells<Machine, T, D> cells(grid, h);
    if (tiles.near_.size() != std::size_t(grid.cells)) tiles.near_ = Array<unsigned char>(std::size_t(grid.cells));
    marks_.resize(tiles.near_.size());
    cells.mark(start.data(), tiles.near_.data(), marks_.data());

    // Each thread looks through a share of the cells.
    const int* const first = start.data();
    TileTable<T, D>& table = tiles.table_;
#pragma omp parallel
    {
      const int threads = omp_get_num_threads(), me = omp_get_thread_num();
      const auto share = [&](int k) { return int(int64_t(grid.cells) * k / threads); };
#pragma omp single
      counts_.assign(std::size_t(threads) + 1, 0);
      int mine = 0;
      for (int c = share(me); c < share(me + 1); ++c) mine += first[c + 1] > first[c];
      counts_[std::size_t(me) + 1] = mine;
#pragma omp barrier
#pragma omp single
      {
        for (int k = 0; k < threads; ++k) counts_[std::size_t(k) + 1] += counts_[std::size_t(k)];
        tiles.hold(counts_[std::size_t(threads)]);
      }
      int at = counts_[std::size_t(me)];
      for (int c = share(me); at < counts_[std::size_t(me) + 1]; ++c)
        if (first[c + 1] > first[c]) table.cell[at++] = c;
#pragma omp barrier
#pragma omp for schedule(static)
      for (int t = 0; t < table.n; ++t) cells.find_tile(table, t, x, first[table.cell[t]], first[table.cell[t] + 1]);
    }
  }
  /// Carries out moves of n values each, those that gather by `order`. One parallel region for all of them: to begin
  /// and end one takes as long as to gather a field of 20,000 values.
  void rearrange(std::size_t n, const int* order, const std::vector<Rearrangement>& moves) {
    if (moves.empty()) return;
#pragma omp parallel
    {
      const std::size_t threads = std::size_t(omp_get_num_threads()), me = std::size_t(omp_get_thread_num());
      const std::size_t begin = n * me / threads, end = n * (me + 1) / threads;
      for (const Rearrangement& move : moves) {
        move.with_types([&](auto* to, const auto* from) {
          const auto each = [&](const auto& index) {
            for (std::size_t i = begin; i < end; ++i) to[i] = std::remove_pointer_t<decltype(to)>(from[index(i)]);
          };
          if (move.gathers())
            each([&](std::size_t i) { return std::size_t(order[i]); });
          else
            each([](std::size_t i) { return i; });
        });
        // What was gathered from is written next; what is rounded is each thread's own.
        if (move.gathers()) {
#pragma omp barrier
        }
      }
    }
  }
  /// A thread takes a few hundred particles at a time, whole tiles.
  template <class View, class F, class Run>
  void over_tiles(const View& own, const F& f, const Run& run) {
    const int* start = own.start;
    const auto& tiles = *own.tiles;
    const int active = start[f.grid.cells], share = std::clamp(tiles.n / (16 * omp_get_max_threads()), 4, 32);
    prepare_memory();
#pragma omp parallel
    {
      F pass = f;
      Neighbourhood<typename F::Types, Tile> near(pass, memory_[omp_get_thread_num()]);
#pragma omp for schedule(dynamic, share) nowait
      for (int t = 0; t < tiles.n; ++t) {
        near.look(tiles, t);
        for (int i = start[tiles.cell[t]]; i < start[tiles.cell[t] + 1]; ++i) run(pass, i);
      }
      near.clear();
#pragma omp for schedule(static) nowait
      for (int i = active; i < own.n; ++i) run(pass, i);  // those that have left the domain
    }
  }
  /// Of its own; without what grows with the number of threads.
  std::size_t bytes() const { return marks_.size(); }
  double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }
  void wait() const {}
  std::string name() const { return "CPU"; }
  std::string instructions() const {
    return Machine::lanes == 16 ? "AVX-512 instructions"
                                : (Machine::lanes == 8 ? "AVX2 instructions" : "baseline instructions");
  }

 private:
  /// The largest limits that the threads find.
  template <class T>
  class LargestLimits {
   public:
    explicit LargestLimits(Limits<T>& to) : to_(to), found_(omp_get_max_threads()) {}
    ~LargestLimits() {
      for (const Found& l : found_) raise(to_, l);
    }
    void add(const Limits<T>& l) { raise(found_[omp_get_thread_num()], l); }

   private:
    struct alignas(64) Found : Limits<T> {};  // a cache line a thread: they write all the time
    static void raise(Limits<T>& to, const Limits<T>& l) {
      to.acceleration2 = largest(to.acceleration2, l.acceleration2), to.mu = largest(to.mu, l.mu);
    }
    Limits<T>& to_;
    std::vector<Found> found_;
  };
  /// The slabs that are worked on at a time, even ones first, then odd ones; those with most particles first, so that
  /// no thread is left with one at the end.
  template <class Size>
  void order_slabs(int slabs, const Size& size) {
    for (int odd = 0; odd < 2; ++odd) {
      std::vector<int>& turn = slabs_[odd];
      turn.clear();
      for (int s = odd; s < slabs; s += 2)
        if (size(s) > 0) turn.push_back(s);
      std::sort(turn.begin(), turn.end(), [&](int a, int b) {
        const int of_a = size(a), of_b = size(b);
        return of_a != of_b ? of_a > of_b : a < b;
      });
    }
  }
  void prepare_memory() {
    while (int(memory_.size()) < omp_get_max_threads()) memory_.emplace_back();
  }

  std::vector<Tile> memory_;          // one a thread
  std::vector<int> counts_;           // of the sort
  std::vector<int> slabs_[2];         // of cells, in the order in which pairs are computed
  std::vector<unsigned char> marks_;  // of cells
};

}  // namespace lgiw
