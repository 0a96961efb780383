// Neighbours on the CPU. A tile is the particles of one cell; whatever lies within the kernel's support of the box
// around them is copied side by side, with the fields that the pass reads. The pair loops then run over contiguous
// memory and over 2.6 candidates per real neighbour in 3-D, where cells as wide as the support give 6.4; the copy is
// shared by the 15 or so particles of the tile.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "solver/copy_near.hh"
#include "solver/grid.hh"
#include "solver/parameters.hh"

namespace lgiw {

/// Memory of one thread for the copies. Bytes: the backend's array of unsigned char.
template <class Bytes>
struct TileMemory {
  Bytes copies;                           // grows to what the fullest tile needs
  std::vector<std::pair<int, int>> rows;  // of cells, [first, last)

  void* take(std::size_t bytes) {
    if (bytes > copies.size()) copies = Bytes(bytes + bytes / 2);
    return copies.data();
  }
};

/// What a pass finds near the tile it works on: fills its copies.
template <class Tr, class Memory>
class Neighbourhood {
 public:
  using T = typename Tr::T;
  static constexpr int D = Tr::D;

  template <class Pass>
  Neighbourhood(Pass& pass, Memory& memory)
      : grid_(pass.grid), memory_(memory), reach_(T(2 * margin) * pass.parameters.h) {
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
      phase->n = &view.n, phase->start = view.start, phase->fields = 0;
      add(*phase, view.x);
    }
    (add(*phase, fields), ...);
  }
  void clear() {
    for (int k = 0; k < phases_; ++k) *phase_[k].n = 0;
  }
  /// Copies what lies near the particles [begin, end) at x.
  void look(const T* const* x, int begin, int end) {
    const NearBox<T, D> box = box_of(x, begin, end);
    find_rows(box);
    std::size_t room[phases], total = 0;
    for (int k = 0; k < phases_; ++k) {
      std::size_t candidates = 0;
      for (const auto& [first, last] : memory_.rows) candidates += phase_[k].start[last] - phase_[k].start[first];
      room[k] = (candidates / widest_lanes + 2) * widest_lanes;
      total += room[k] * phase_[k].fields;
    }
    T* to = static_cast<T*>(memory_.take(total * sizeof(T)));
    for (int k = 0; k < phases_; ++k) {
      Phase& phase = phase_[k];
      T* copies[most_fields];
      for (int f = 0; f < phase.fields; ++f, to += room[k]) *phase.slot[f] = copies[f] = to;
      int n = 0;
      for (const auto& [first, last] : memory_.rows)
        n = copy_near<Tr::Machine::lanes>(box, phase.fields, phase.from, phase.start[first], phase.start[last], copies,
                                          n);
      *phase.n = fill_up(phase, copies, n, box);
    }
  }

 private:
  static constexpr int phases = 4, most_fields = 32;
  // Rates are taken half a step ago: pairs that have just left the support still count.
  static constexpr double margin = 1.005;
  struct Phase {
    int* n;
    const int* start;
    int fields;
    T** slot[most_fields];
    const T* from[most_fields];
  };

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
  /// Up to whole vectors: particles beyond everyone's support.
  int fill_up(const Phase& phase, T* const* copies, int n, const NearBox<T, D>& box) const {
    const int whole = (n + widest_lanes - 1) / widest_lanes * widest_lanes;
    for (int f = 0; f < phase.fields; ++f) {
      const T value = f == 0 ? box.low[0] - 2 * reach_ : (f < D ? box.low[f] : T(0));
      for (int j = n; j < whole; ++j) copies[f][j] = value;
    }
    return whole;
  }

  template <class U>
  void add(Phase& phase, U*& field) {
    if (!field) return;
    phase.slot[phase.fields] = const_cast<T**>(&field);
    phase.from[phase.fields++] = field;
  }
  template <class U, int size>
  void add(Phase& phase, U* (&fields)[size]) {
    for (int k = 0; k < size; ++k) add(phase, fields[k]);
  }

  /// Ranges of cells [first, last) that hold everything near the box.
  void find_rows(const NearBox<T, D>& box) {
    auto& rows = memory_.rows;
    rows.clear();
    const double width = 1 / grid_.inverse_width, reach = double(reach_);
    int first[D], last[D];
    for (int k = 1; k < D; ++k)
      first[k] = coordinate(double(box.low[k]) - reach, k), last[k] = coordinate(double(box.high[k]) + reach, k);
    const auto distance = [&](int c, int k) {  // of a slab of cells from the box
      const double low = grid_.low[k] + c * width;
      return std::max({0.0, low - double(box.high[k]), double(box.low[k]) - low - width});
    };
    const auto row = [&](double square, int before) {
      if (square >= reach * reach) return;
      const double chord = std::sqrt(reach * reach - square);
      rows.push_back({before + coordinate(double(box.low[0]) - chord, 0),
                      before + coordinate(double(box.high[0]) + chord, 0) + 1});
    };
    for (int c = first[D - 1]; c <= last[D - 1]; ++c) {
      const double d = distance(c, D - 1);
      if constexpr (D == 2) {
        row(d * d, c * grid_.n[0]);
      } else {
        for (int b = first[1]; b <= last[1]; ++b) {
          const double e = distance(b, 1);
          row(d * d + e * e, (c * grid_.n[1] + b) * grid_.n[0]);
        }
      }
    }
  }
  int coordinate(double x, int k) const {
    const double c = (x - grid_.low[k]) * grid_.inverse_width;
    return c < 0 ? 0 : (c >= grid_.n[k] - 1 ? grid_.n[k] - 1 : int(c));
  }

  const Grid<T, D> grid_;
  Memory& memory_;
  T reach_;
  int phases_ = 0;
  std::vector<Phase> phase_ = std::vector<Phase>(phases);
};

}  // namespace lgiw
