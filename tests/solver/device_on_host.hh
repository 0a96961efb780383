// What a device backend is to the solver, on the host: it runs the passes as a CUDA device does, where there is none.
#pragma once

#include <sys/mman.h>
#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#else
#define ASAN_POISON_MEMORY_REGION(address, bytes) (void(address), void(bytes))
#define ASAN_UNPOISON_MEMORY_REGION(address, bytes) (void(address), void(bytes))
#endif

#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "solver/backend_array.hh"
#include "solver/passes.hh"
#include "solver/rearrangement.hh"

namespace lgiw::test {

/// Stands in for CudaBackend (solver/cuda_backend.cuh): the passes look among all particles in rows of cells, a step
/// after the other is queued without a look at the clock, and what one thread does is in no order with the others:
/// here in one that `seed` shuffles. The memory cannot be touched but by a pass or a copy, and holds NaN until it is
/// written; a sanitizer sees what lies outside of an array. Launches, atomics and CUB remain CUDA's own.
class DeviceOnHost {
 public:
  static constexpr bool on_host = false;
  static constexpr int steps_per_check = 16;
  template <class T, int D>
  static Grid<T, D> grid(const double* low, const double* high, double h, double particles) {
    const double reach = Grid<T, D>::reach_of_device(h);
    if (cells() == Cells::even) return Grid<T, D>(low, high, reach / 2, 2, 1);
    return Grid<T, D>::of_device(low, high, h, cells() == Cells::wide ? -1e9 : particles);
  }
  /// Which cells devices made from now on take: those of a domain that is rather or nearly empty.
  enum class Cells { usual, even, wide };
  static Cells& cells() {
    static Cells which = Cells::usual;
    return which;
  }

  explicit DeviceOnHost(unsigned seed = 1) : random_(seed) {}

  struct Memory {
    static void* take(std::size_t bytes) { return arena().take(bytes); }
    static void give(void*) { arena().give(); }
  };
  template <class T>
  using Array = BackendArray<T, Memory>;
  template <class T, int D>
  using Tiles = NoTiles<T, D>;
  struct HostMemory {
    static void* take(std::size_t bytes) { return ::operator new(bytes); }
    static void give(void* data) { ::operator delete(data); }
  };
  template <class T>
  using HostArray = BackendArray<T, HostMemory>;

  template <class T>
  void upload(const Array<T>& to, const T* from) {
    const Open open;
    if (to.size()) std::memcpy(static_cast<void*>(to.data()), from, to.size() * sizeof(T));
  }
  template <class T>
  void download(T* to, const Array<T>& from) const {
    download(to, from, 0, from.size());
  }
  template <class T>
  void download(T* to, const Array<T>& from, std::size_t first, std::size_t n) const {
    const Open open;
    if (n) std::memcpy(static_cast<void*>(to), from.data() + first, n * sizeof(T));
  }
  template <class T>
  void zero(const Array<T>& a) {
    const Open open;
    if (a.size()) std::memset(static_cast<void*>(a.data()), 0, a.size() * sizeof(T));
  }

  template <class F>
  void for_each(int n, const F& f) {
    const Open open;
    for (int i : any_order(n)) f(i);
  }
  template <class F>
  void single(const F& f) {
    const Open open;
    f(0);
  }
  template <class View, class F>
  void for_each_near(const View& own, const F& f) {
    for_each(own.n, f);
  }
  template <class T, class View, class F>
  void for_each_near_limits(const View& own, const F& f, Limits<T>* limits) {
    const Open open;
    for (int i : any_order(own.n)) {
      const Limits<T> mine = f(i);
      limits->acceleration2 = std::max(limits->acceleration2, mine.acceleration2);
      limits->mu = std::max(limits->mu, mine.mu);
    }
  }
  void sort_by_cell(const Array<int>& key, int cells, int* order, const Array<int>& start, int* spare,
                    int* other_spare) {
    const Open open;
    ++sorts();
    int *const keys = key.data(), n = int(key.size());
    std::memset(spare, 0xff, sizeof(int) * std::size_t(n));  // it may be used as memory
    std::memset(other_spare, 0xff, sizeof(int) * std::size_t(n));
    std::iota(order, order + n, 0);
    std::stable_sort(order, order + n, [&](int a, int b) { return keys[a] < keys[b]; });
    std::sort(keys, keys + n);
    const CellStart write_start{keys, n, cells, start.data()};
    for (int k : any_order(CellStart::runs(cells))) write_start(k);
  }
  void rearrange(std::size_t n, const int* order, const std::vector<Rearrangement>& moves) {
    const Open open;
    for (const Rearrangement& move : moves)
      move.with_types([&](auto* to, const auto* from) {
        for (int i : any_order(int(n)))
          to[i] = std::remove_pointer_t<decltype(to)>(from[move.gathers() ? order[i] : i]);
      });
  }
  /// How often any such device has sorted a phase.
  static int& sorts() {
    static int count = 0;
    return count;
  }
  double now() { return 0; }
  std::string name() const { return "a device on the host"; }
  std::string instructions() const { return ""; }
  std::size_t bytes() const { return 0; }

 private:
  class Arena {
   public:
    Arena() : data_(static_cast<char*>(mmap(nullptr, size, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0))) {
      if (data_ == MAP_FAILED) throw std::runtime_error("no address space");
    }
    void* take(std::size_t bytes) {
      char* const at = data_ + used_;
      used_ += (bytes + 511) / 256 * 256;  // aligned as cudaMalloc does, with room between
      if (used_ > size) throw std::runtime_error("too many arrays for this test");
      ++arrays_;
      allow(true);
      std::memset(at, 0xff, bytes);  // NaN
      allow(false);
      ASAN_POISON_MEMORY_REGION(at + bytes, std::size_t(data_ + used_ - at) - bytes);
      return at;
    }
    /// Nothing is used twice until all is given back.
    void give() {
      if (--arrays_ > 0) return;
      ASAN_UNPOISON_MEMORY_REGION(data_, used_);
      madvise(data_, used_, MADV_DONTNEED);
      used_ = 0;
    }
    void allow(bool access) const { mprotect(data_, used_, access ? PROT_READ | PROT_WRITE : PROT_NONE); }

   private:
    static constexpr std::size_t size = std::size_t(1) << 30;  // of address space
    char* data_;
    std::size_t used_ = 0;
    int arrays_ = 0;
  };
  static Arena& arena() {
    static Arena it;
    return it;
  }
  struct Open {
    Open() { arena().allow(true); }
    ~Open() { arena().allow(false); }
    Open(const Open&) = delete;
    Open& operator=(const Open&) = delete;
  };
  const std::vector<int>& any_order(int n) {
    order_.resize(std::size_t(n));
    std::iota(order_.begin(), order_.end(), 0);
    std::shuffle(order_.begin(), order_.end(), random_);
    return order_;
  }

  std::mt19937 random_;
  std::vector<int> order_;
};

}  // namespace lgiw::test
