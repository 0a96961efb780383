// Neighbours on the CPU. A tile is the particles of one cell; whatever lies within the kernel's support of the box
// around them is copied side by side, with the fields that the pass reads. The pair loops then run over contiguous
// memory and over 2.6 candidates per real neighbour in 3-D, where cells as wide as the support give 6.4; the copy is
// shared by the 15 or so particles of the tile.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

#include "solver/copy_near.hh"
#include "solver/grid.hh"
#include "solver/parameters.hh"

namespace lgiw {

/// Memory of one thread for the copies. Bytes: the backend's array of unsigned char.
template <class Bytes>
struct TileMemory {
  static constexpr int phases = 4;
  Bytes copies;            // grows to what the fullest tile needs
  Ranges ranges[phases];   // of the particles in the rows of cells near it
  std::vector<int> index;  // of the copied particles, where sums go back to them

  void* take(std::size_t bytes) {
    if (bytes > copies.size()) copies = Bytes(bytes + bytes / 2);
    return copies.data();
  }
};

/// Which cells may hold something near a box.
template <class Machine, class T, int D>
class NearCells {
 public:
  NearCells(const Grid<T, D>& grid, T h)
      : grid_(grid), reach_(T(2 * reach_in_supports) * h), steps_(double(reach_) * grid.inverse_width[0]) {
    assert(steps_ < std::sqrt(2.0));  // mark()
  }

  T reach() const { return reach_; }

  NearBox<T, D> box_of(const T* const* x, int begin, int end) const {
    NearBox<T, D> box;
    for (int k = 0; k < D; ++k) {
      box.low[k] = box.high[k] = x[k][begin];
      for (int i = begin + 1; i < end; ++i) {
        box.low[k] = smallest(box.low[k], x[k][i]);
        box.high[k] = largest(box.high[k], x[k][i]);
      }
    }
    box.reach2 = reach_ * reach_;
    return box;
  }
  /// Writes the box of tile t, of the particles [begin, end) at x, and its rows.
  void find_tile(const TileTable<T, D>& tiles, int t, const T* const* x, int begin, int end) const {
    const NearBox<T, D> box = tiles.box[t] = box_of(x, begin, end);
    std::pair<int, int>* const rows = tiles.rows + std::ptrdiff_t(t) * tiles.most_rows;
    int count = 0;
    const Slabs along(*this, box, grid_.order[0]), across(*this, box, grid_.order[1]);
    const auto in_plane = [&](double square, int before) {
      for (int b = across.first; b <= across.last; b += abreast) {
        // Their roots beside each other: one after the other they would take as long as the copies.
        double rest[abreast];
        int first[abreast], last[abreast];
#pragma omp simd
        for (int k = 0; k < abreast; ++k) {
          rest[k] = square - across.square(b + k);
          const double chord = std::sqrt(rest[k] > 0 ? rest[k] : 0.0);
          first[k] = along.held(along.low - chord), last[k] = along.held(along.high + chord) + 1;
        }
        for (int k = 0; k < abreast && b + k <= across.last; ++k) {
          if (rest[k] <= 0) continue;
          const int row = before + (b + k) * across.stride;
          if (count < tiles.most_rows)
            rows[count++] = {row + first[k], row + last[k]};
          else
            rows[count - 1].second = row + last[k];  // more cells than need be, none too few
        }
      }
    };
    const double square = steps_ * steps_;
    if constexpr (D == 2) {
      in_plane(square, 0);
    } else {
      const Slabs slowest(*this, box, grid_.order[2]);
      for (int c = slowest.first; c <= slowest.last; ++c) {
        const double rest = square - slowest.square(c);
        if (rest > 0) in_plane(rest, c * slowest.stride);
      }
    }
    tiles.row_count[t] = count;
  }
  /// Sets near[c] to 1 for every cell c within whose reach a phase has particles (the first in cell b is start[b]), to
  /// 0 for most others; `spare` is as long. A pass skips a phase where a tile lies in a cell of the latter.
  void mark(const int* start, unsigned char* near, unsigned char* spare) const {
    const int cells = grid_.cells;
    unsigned char *from = near, *to = spare;
#pragma omp parallel for schedule(static) if (cells > few_cells)
    for (int c = 0; c < cells; ++c) from[c] = start[c + 1] > start[c];
    // The end of a row marks the beginning of the next one for nothing, which does no harm.
    const auto widen = [&](const int* strides, int n) {
#pragma omp parallel for schedule(static) if (cells > few_cells)
      for (int begin = 0; begin < cells; begin += block) {
        const int end = std::min(cells, begin + block);
        const unsigned char* const in = from;
        unsigned char* const out = to;
        std::memcpy(out + begin, in + begin, std::size_t(end - begin));
        for (int k = 0; k < n; ++k) {
          const int by = strides[k];
#pragma GCC ivdep
          for (int c = std::max(begin, by); c < end; ++c) out[c] = out[c] | in[c - by];
          const int last = std::min(end, cells - by);
#pragma GCC ivdep
          for (int c = begin; c < last; ++c) out[c] = out[c] | in[c + by];
        }
      }
      std::swap(from, to);
    };
    for (int k = 0; k < D; ++k) widen(&grid_.stride[k], 1);
    // What is two cells away along one axis and at most one along the others; two and two is further than the reach.
    if (steps_ > 1) widen(grid_.stride, D);
    if (from != near) std::memcpy(near, from, std::size_t(cells));
  }
  /// No cell near a tile has a number larger than that of the tile by more than this.
  int furthest() const {
    int sum = 0;
    for (int k = 0; k < D; ++k) sum += (int(steps_) + 1) * grid_.stride[k];
    return sum;
  }

 private:
  static constexpr int few_cells = 100000;  // too few to share among threads
  static constexpr int block = 4096;        // of cells, which stay in the nearest cache
  static constexpr int abreast = 8;         // rows of cells

  /// The box and what is near it along one axis, in widths of a cell.
  struct Slabs {
    double low, high;
    int n, stride, first, last;
    Slabs(const NearCells& near, const NearBox<T, D>& box, int k)
        : low((double(box.low[k]) - near.grid_.low[k]) * near.grid_.inverse_width[k]),
          high((double(box.high[k]) - near.grid_.low[k]) * near.grid_.inverse_width[k]),
          n(near.grid_.n[k]),
          stride(near.grid_.stride[k]),
          first(held(low - near.steps_)),
          last(held(high + near.steps_)) {}
    int held(double u) const {
      const double above = u > 0 ? u : 0.0, most = n - 1;
      return int(above < most ? above : most);
    }
    /// Of the distance of slab c from the box.
    double square(int c) const {
      const double above = c - high, below = low - c - 1, d = above > below ? above : below;
      return d > 0 ? d * d : 0;
    }
  };

  const Grid<T, D> grid_;
  T reach_;
  double steps_;  // reach in widths of a cell
};

/// Fields of one phase and their copies.
template <class Tr>
struct CopiedPhase {
  using T = typename Tr::T;
  static constexpr int D = Tr::D, most_fields = 32;
  int* n = nullptr;  // of the view that holds the copies
  const int* start = nullptr;
  const unsigned char* cells_near = nullptr;
  int fields = 0;
  T** slot[most_fields];  // pointers of the view
  const T* from[most_fields];
  int reciprocal = -1;  // the field of which copies hold 1 / (offset + value)
  T offset = 0;

  template <class U>
  void add(U*& field) {
    if (!field) return;
    slot[fields] = const_cast<T**>(&field);
    from[fields++] = field;
  }
  template <class U, int size>
  void add(U* (&list)[size]) {
    for (int k = 0; k < size; ++k) add(list[k]);
  }
  void add_reciprocal(T*& field, const T* of, T plus) {
    reciprocal = fields, offset = plus;
    slot[fields] = &field;
    from[fields++] = of;
  }
  /// Finds the ranges of particles near a tile, in cells from number `from` on, but for empty ones, and counts them.
  static std::size_t particles_near(const TileTable<T, D>& tiles, int t, int from, const int* start, Ranges& ranges) {
    ranges.clear();
    std::size_t count = 0;
    const std::pair<int, int>* const rows = tiles.rows + std::ptrdiff_t(t) * tiles.most_rows;
    for (int k = 0; k < tiles.row_count[t]; ++k) {
      if (rows[k].second <= from) continue;
      const int begin = start[std::max(rows[k].first, from)], end = start[rows[k].second];
      if (begin == end) continue;
      ranges.push_back({begin, end});
      count += std::size_t(end - begin);
    }
    return count;
  }
  static std::size_t whole_vectors(std::size_t n) { return (n + widest_lanes - 1) / widest_lanes * widest_lanes; }
  /// Copies from the one at `end` up to whole vectors: particles beyond everyone's support. Makes reciprocals.
  int fill_up(T* const* copies, int end, const NearBox<T, D>& box, T reach) const {
    const int whole = int(whole_vectors(std::size_t(end)));
    for (int f = 0; f < fields; ++f) {
      const T value = f == 0 ? box.low[0] - 2 * reach : (f < D ? box.low[f] : T(0));
      for (int j = end; j < whole; ++j) copies[f][j] = value;
    }
    if (reciprocal >= 0) {
      T* const values = copies[reciprocal];
#pragma GCC ivdep
      for (int j = 0; j < whole; ++j) values[j] = 1 / (offset + values[j]);
    }
    return whole;
  }
};

/// What a pass finds near the tile it works on: fills its copies.
template <class Tr, class Memory>
class Neighbourhood {
 public:
  using T = typename Tr::T;
  static constexpr int D = Tr::D;

  template <class Pass>
  Neighbourhood(Pass& pass, Memory& memory) : near_(pass.grid, pass.parameters.h), memory_(memory) {
    pass.copies.water = pass.water, pass.copies.soil = pass.soil, pass.copies.wall = pass.wall;
    pass.copies.bodies = pass.bodies;
    pass.reads(*this);
    clear();
  }
  /// Called by reads(): fields of a phase that are to be copied, besides the places. Those that the scene lacks are
  /// null.
  template <class View, class... Fields>
  void operator()(View& view, Fields&... fields) {
    Phase* phase = nullptr;
    for (int k = 0; k < phases_; ++k)
      if (phase_[k].n == &view.n) phase = &phase_[k];
    if (!phase) {
      if (!view.n) return;
      phase = &phase_[phases_++];
      phase->n = &view.n, phase->start = view.start, phase->cells_near = view.cells_near;
      phase->add(view.x);
    }
    (phase->add(fields), ...);
  }
  /// The same, where copies are to hold 1 / (offset + of) in `field`.
  template <class View>
  void reciprocal(View& view, T*& field, const T* of, T offset) {
    for (int k = 0; k < phases_; ++k)
      if (phase_[k].n == &view.n) phase_[k].add_reciprocal(field, of, offset);
  }
  void clear() {
    for (int k = 0; k < phases_; ++k) *phase_[k].n = 0;
  }
  /// Copies what lies near a tile.
  void look(const TileTable<T, D>& tiles, int t) {
    clear();
    const int cell = tiles.cell[t];
    const auto absent = [&](const Phase& phase) { return phase.cells_near && !phase.cells_near[cell]; };
    if (std::all_of(phase_.begin(), phase_.begin() + phases_, absent)) return;
    const NearBox<T, D>& box = tiles.box[t];
    std::size_t room[phases], total = 0;
    for (int k = 0; k < phases_; ++k) {
      room[k] = 0;
      if (absent(phase_[k])) continue;
      room[k] =
          Phase::whole_vectors(Phase::particles_near(tiles, t, 0, phase_[k].start, memory_.ranges[k])) + widest_lanes;
      total += room[k] * phase_[k].fields;
    }
    T* to = static_cast<T*>(memory_.take(total * sizeof(T)));
    for (int k = 0; k < phases_; ++k) {
      Phase& phase = phase_[k];
      if (absent(phase)) continue;
      T* copies[Phase::most_fields];
      for (int f = 0; f < phase.fields; ++f, to += room[k]) *phase.slot[f] = copies[f] = to;
      const int n = copy_near<Tr::Machine::lanes>(box, phase.fields, phase.from, memory_.ranges[k], copies, 0);
      *phase.n = phase.fill_up(copies, n, box, near_.reach());
    }
  }

 private:
  using Phase = CopiedPhase<Tr>;
  static constexpr int phases = Memory::phases;

  const NearCells<typename Tr::Machine, T, D> near_;
  Memory& memory_;
  int phases_ = 0;
  std::vector<Phase> phase_ = std::vector<Phase>(phases);
};

/// What a pass over the pairs of one phase finds near a tile and has not met before: the tile itself, whose particles
/// look at each other from either side, and then those of later cells near it, each pair once. What the tile adds to
/// the latter is gathered beside the copies and handed back by give_back(); what it adds to itself there is dropped.
template <class Tr, class Memory>
class PairNeighbourhood {
 public:
  using T = typename Tr::T;
  static constexpr int D = Tr::D;

  template <class Pass>
  PairNeighbourhood(Pass& pass, Memory& memory) : near_(pass.grid, pass.parameters.h), memory_(memory) {
    pass.copies.water = pass.water, pass.copies.soil = pass.soil;
    pass.reads(*this);
    pass.sums([&](auto& field) { sums_.add(field); });
  }
  template <class View, class... Fields>
  void operator()(View& view, Fields&... fields) {
    phase_.n = &view.n, phase_.start = view.start;
    if (phase_.fields == 0) phase_.add(view.x);
    (phase_.add(fields), ...);
  }
  template <class View>
  void reciprocal(View&, T*& field, const T* of, T offset) {
    phase_.add_reciprocal(field, of, offset);
  }
  const NearCells<typename Tr::Machine, T, D>& cells() const { return near_; }
  /// Copies what lies near a tile.
  void look(const TileTable<T, D>& tiles, int t) {
    const int cell = tiles.cell[t], begin = phase_.start[cell], end = phase_.start[cell + 1];
    const NearBox<T, D>& box = tiles.box[t];
    const std::size_t candidates =
        std::size_t(end - begin) + Phase::particles_near(tiles, t, cell + 1, phase_.start, memory_.ranges[0]);
    const std::size_t room = Phase::whole_vectors(candidates) + widest_lanes;
    T* to = static_cast<T*>(memory_.take(room * (phase_.fields + sums_.fields) * sizeof(T)));
    if (memory_.index.size() < room) memory_.index.resize(room);
    T* copies[Phase::most_fields];
    for (int f = 0; f < phase_.fields; ++f, to += room) *phase_.slot[f] = copies[f] = to;
    for (int f = 0; f < phase_.fields; ++f)
      for (int i = begin; i < end; ++i) copies[f][i - begin] = phase_.from[f][i];
    first_ = last_ = end - begin;
    last_ = copy_near<Tr::Machine::lanes>(box, phase_.fields, phase_.from, memory_.ranges[0], copies, last_,
                                          memory_.index.data());
    *phase_.n = phase_.fill_up(copies, last_, box, near_.reach());
    for (int f = 0; f < sums_.fields; ++f, to += room) {
      *sums_.slot[f] = to;
      std::fill(to, to + *phase_.n, T(0));
    }
  }
  void clear_sums(int i) const {
    for (int f = 0; f < sums_.fields; ++f) sum(f)[i] = 0;
  }
  void give_back() const {
    const int* index = memory_.index.data();
    for (int f = 0; f < sums_.fields; ++f) {
      T* to = sum(f);
      const T* from = *sums_.slot[f];
      for (int j = first_; j < last_; ++j) to[index[j]] += from[j];
    }
  }

 private:
  using Phase = CopiedPhase<Tr>;

  /// The field of the phase itself that the f-th sum goes to.
  T* sum(int f) const { return const_cast<T*>(sums_.from[f]); }

  const NearCells<typename Tr::Machine, T, D> near_;
  Memory& memory_;
  int first_ = 0, last_ = 0;  // copies of later cells [first_, last_)
  std::vector<Phase> lists_ = std::vector<Phase>(2);
  Phase &phase_ = lists_[0], &sums_ = lists_[1];  // what is copied, and what comes back
};

}  // namespace lgiw
