// Runs the passes on a CUDA device. Holds launches and memory only; the physics is in lib/physics and
// lib/solver/passes.hh.
#pragma once

#include <cub/device/device_radix_sort.cuh>

#include <chrono>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include "base/error.hh"
#include "solver/backend_array.hh"
#include "solver/passes.hh"
#include "solver/rearrangement.hh"

namespace lgiw {

inline void check_cuda(cudaError_t status, const char* what) {
  if (status == cudaSuccess) return;
  const std::string why = cudaGetErrorString(status);
  if (status == cudaErrorMemoryAllocation)
    throw WorkError("the CUDA device has too little memory", std::string(what) + ": " + why,
                    "use a coarser particle spacing, single precision or --backend cpu");
  throw WorkError("the CUDA device failed", std::string(what) + ": " + why, "run again, or use --backend cpu");
}

template <class F>
__global__ void run_each(int n, F f) {
  const int i = int(blockIdx.x) * int(blockDim.x) + int(threadIdx.x);
  if (i < n) f(i);
}
template <class F>
__global__ void run_once(F f) {
  f(0);
}

/// Limits are never negative, so that their bits order like integers and a maximum is one integer atomic.
__device__ inline void raise(float* to, float value) { atomicMax(reinterpret_cast<int*>(to), __float_as_int(value)); }
__device__ inline void raise(double* to, double value) {
  atomicMax(reinterpret_cast<long long*>(to), __double_as_longlong(value));
}
template <class T, class F>
__global__ void run_limits(int n, F f, Limits<T>* limits) {
  const int i = int(blockIdx.x) * int(blockDim.x) + int(threadIdx.x);
  Limits<T> mine;
  if (i < n) mine = f(i);
  for (int lane = 16; lane > 0; lane /= 2) {
    mine.acceleration2 = largest(mine.acceleration2, __shfl_xor_sync(0xffffffffu, mine.acceleration2, lane));
    mine.mu = largest(mine.mu, __shfl_xor_sync(0xffffffffu, mine.mu, lane));
  }
  if ((threadIdx.x & 31) == 0) {
    raise(&limits->acceleration2, mine.acceleration2);
    raise(&limits->mu, mine.mu);
  }
}
/// Fields of one width that are moved side by side.
struct Moves {
  static constexpr int most = 16;
  int count = 0;
  void* to[most];
  const void* from[most];

  /// Whether it can be moved beside the others: none comes from where one goes to.
  bool takes(const Rearrangement& move) const {
    for (int k = 0; k < count; ++k)
      if (to[k] == move.from() || from[k] == move.to() || to[k] == move.to()) return false;
    return count < most;
  }
  void add(const Rearrangement& move) { to[count] = move.to(), from[count++] = move.from(); }
};
template <class Word>
__global__ void rearrange_kernel(int n, Moves moves, const int* order) {
  const int i = int(blockIdx.x) * int(blockDim.x) + int(threadIdx.x);
  if (i >= n) return;
  const int from = order ? order[i] : i;
  for (int k = 0; k < moves.count; ++k)
    static_cast<Word*>(moves.to[k])[i] = static_cast<const Word*>(moves.from[k])[from];
}
static __global__ void iota_kernel(int n, int* to) {
  const int i = int(blockIdx.x) * int(blockDim.x) + int(threadIdx.x);
  if (i < n) to[i] = i;
}

struct CudaBackend {
  static constexpr bool on_host = false;
  // The host looks at the clock of the run only so often; steps queued beyond the target change nothing (Pass::idle).
  static constexpr int steps_per_check = 16;
  static constexpr int block = CudaDevice::block;

  template <class T, int D>
  static Grid<T, D> grid(const double* low, const double* high, double h, double particles) {
    return Grid<T, D>::of_device(low, high, h, particles);
  }

  struct Memory {
    static void* take(std::size_t bytes) {
      void* data = nullptr;
      check_cuda(cudaMalloc(&data, bytes), "memory for particles");
      return data;
    }
    static void give(void* data) { cudaFree(data); }
  };
  template <class T>
  using Array = BackendArray<T, Memory>;
  template <class T, int D>
  using Tiles = NoTiles<T, D>;
  /// Of the host, to which a device copies at full speed: the system must not move it meanwhile. Where it will not hold
  /// that much still, copies are slower.
  struct HostMemory {
    static void* take(std::size_t bytes) {
      void* const data = ::operator new(bytes, std::align_val_t(page));
      if (cudaHostRegister(data, bytes, cudaHostRegisterDefault) != cudaSuccess) cudaGetLastError();
      return data;
    }
    static void give(void* data) {
      if (cudaHostUnregister(data) != cudaSuccess) cudaGetLastError();
      ::operator delete(data, std::align_val_t(page));
    }
    static constexpr std::size_t page = 4096;
  };
  template <class T>
  using HostArray = BackendArray<T, HostMemory>;

  template <class T>
  void upload(const Array<T>& to, const T* from) {
    if (to.size())
      check_cuda(cudaMemcpy(to.data(), from, to.size() * sizeof(T), cudaMemcpyHostToDevice), "copy to the device");
  }
  template <class T>
  void download(T* to, const Array<T>& from) const {
    if (from.size()) download(to, from, 0, from.size());
  }
  /// n values from `first` on.
  template <class T>
  void download(T* to, const Array<T>& from, std::size_t first, std::size_t n) const {
    check_cuda(cudaMemcpy(to, from.data() + first, n * sizeof(T), cudaMemcpyDeviceToHost), "copy from the device");
  }
  template <class T>
  void zero(const Array<T>& a) {
    if (a.size()) check_cuda(cudaMemset(a.data(), 0, a.size() * sizeof(T)), "clearing memory");
  }

  static int blocks(int n) { return (n + block - 1) / block; }
  static void launched(const char* what) { check_cuda(cudaGetLastError(), what); }
  template <class F>
  void for_each(int n, const F& f) {
    if (n == 0) return;
    run_each<<<blocks(n), block>>>(n, f);
    launched("a pass");
  }
  template <class F>
  void single(const F& f) {
    run_once<<<1, 1>>>(f);
    launched("bookkeeping");
  }
  template <class View, class F>
  void for_each_near(const View& own, const F& f) {
    for_each(own.n, f);
  }
  template <class T, class View, class F>
  void for_each_near_limits(const View& own, const F& f, Limits<T>* limits) {
    if (own.n == 0) return;
    run_limits<T><<<blocks(own.n), block>>>(own.n, f, limits);
    launched("a pass");
  }

  /// Stable radix sort by key, to and fro between the arrays and the memory of two as long that hold nothing now; CUB
  /// would take as much besides. The keys come out sorted as well; Motion sets them anew before the next sort.
  void sort_by_cell(const Array<int>& key, int cells, int* order, const Array<int>& start, int* spare,
                    int* other_spare) {
    const int n = int(key.size());
    if (n == 0) return;
    cub::DoubleBuffer<int> keys(key.data(), spare), orders(order, other_spare);
    iota_kernel<<<blocks(n), block>>>(n, orders.Current());
    int bits = 1;
    while (bits < 31 && (cells >> bits) > 0) ++bits;
    std::size_t bytes = 0;
    check_cuda(cub::DeviceRadixSort::SortPairs(nullptr, bytes, keys, orders, n, 0, bits), "sort");
    if (work_.size() < bytes) work_ = Array<unsigned char>(bytes);
    check_cuda(cub::DeviceRadixSort::SortPairs(work_.data(), bytes, keys, orders, n, 0, bits), "sort");
    take_back(n, key.data(), keys.Current()), take_back(n, order, orders.Current());
    for_each(CellStart::runs(cells), CellStart{key.data(), n, cells, start.data()});
  }
  /// Carries out moves of n values each, those that gather by `order`: those at a time that do not depend on each
  /// other.
  void rearrange(std::size_t n, const int* order, const std::vector<Rearrangement>& moves) {
    if (n == 0) return;
    for (std::size_t k = 0; k < moves.size();) {
      const Rearrangement& first = moves[k];
      Moves beside;
      while (k < moves.size() && moves[k].gathers() == first.gathers() && moves[k].width() == first.width() &&
             beside.takes(moves[k]))
        beside.add(moves[k++]);
      const int* const by = first.gathers() ? order : nullptr;
      if (first.width() == sizeof(double))
        rearrange_kernel<double><<<blocks(int(n)), block>>>(int(n), beside, by);
      else
        rearrange_kernel<int><<<blocks(int(n)), block>>>(int(n), beside, by);
      launched("sort");
    }
  }
  /// Phases are timed by what the host waits for: with queued launches the shares are those of launching, unless the
  /// environment has LGIW_TIME_PHASES, which lets the host wait for each phase and the device for the host.
  double now() {
    if (waits_for_phases_) wait();
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
  void wait() const { check_cuda(cudaDeviceSynchronize(), "a step"); }
  std::string name() const {
    cudaDeviceProp p;
    int device = 0;
    if (cudaGetDevice(&device) != cudaSuccess || cudaGetDeviceProperties(&p, device) != cudaSuccess) return "CUDA";
    return std::string("CUDA, ") + p.name;
  }
  std::string instructions() const { return ""; }
  /// Of its own.
  std::size_t bytes() const { return work_.size(); }

 private:
  /// Where the sort has ended in the other array.
  static void take_back(int n, int* to, const int* sorted) {
    if (sorted != to)
      check_cuda(cudaMemcpyAsync(to, sorted, std::size_t(n) * sizeof(int), cudaMemcpyDeviceToDevice), "sort");
  }

  Array<unsigned char> work_;
  bool waits_for_phases_ = std::getenv("LGIW_TIME_PHASES") != nullptr;
};

}  // namespace lgiw
