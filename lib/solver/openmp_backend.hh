// Runs the passes with OpenMP on host memory.
#pragma once

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <new>
#include <vector>

#include "solver/backend_array.hh"
#include "solver/passes.hh"

namespace lgiw {

struct OpenMpBackend {
  static constexpr bool on_host = true;
  static constexpr int steps_per_check = 1;

  /// Aligned for vector loads.
  struct Memory {
    static void* take(std::size_t bytes) { return ::operator new(bytes, std::align_val_t(64)); }
    static void give(void* data) { ::operator delete(data, std::align_val_t(64)); }
  };
  template <class T>
  using Array = BackendArray<T, Memory>;

  template <class T>
  void upload(const Array<T>& to, const T* from) {
    if (to.size()) std::memcpy(to.data(), from, to.size() * sizeof(T));
  }
  template <class T>
  void download(T* to, const Array<T>& from) const {
    if (from.size()) std::memcpy(to, from.data(), from.size() * sizeof(T));
  }
  template <class T>
  void zero(const Array<T>& a) {
    if (a.size()) std::memset(static_cast<void*>(a.data()), 0, a.size() * sizeof(T));
  }

  template <class F>
  void for_each(int n, const F& f) {
#pragma omp parallel for schedule(dynamic, 128)
    for (int i = 0; i < n; ++i) f(i);
  }
  template <class F>
  void single(const F& f) {
    f(0);
  }
  /// Runs f and raises *limits to the largest that it returned.
  template <class T, class F>
  void for_each_limits(int n, const F& f, Limits<T>* limits) {
    T acceleration2 = 0, mu = 0;
#pragma omp parallel for schedule(dynamic, 128) reduction(max : acceleration2, mu)
    for (int i = 0; i < n; ++i) {
      const Limits<T> l = f(i);
      acceleration2 = largest(acceleration2, l.acceleration2);
      mu = largest(mu, l.mu);
    }
    limits->acceleration2 = largest(limits->acceleration2, acceleration2);
    limits->mu = largest(limits->mu, mu);
  }

  /// Stable counting sort by key: order[k] is the old index of the k-th particle, start[c] the first of cell c.
  void sort_by_cell(const Array<int>& key, int cells, const Array<int>& order, const Array<int>& start) {
    const int n = int(key.size());
    int* s = start.data();
    std::memset(s, 0, start.size() * sizeof(int));
    for (int i = 0; i < n; ++i) ++s[key.data()[i]];
    int sum = 0;
    for (int c = 0; c <= cells; ++c) {
      const int count = s[c];
      s[c] = sum;
      sum += count;
    }
    for (int i = 0; i < n; ++i) order.data()[s[key.data()[i]]++] = i;
    for (int c = cells; c > 0; --c) s[c] = s[c - 1];  // the fill moved each start to the next one's place
    s[0] = 0;
  }
  template <class T>
  void gather(const Array<T>& to, const Array<T>& from, const Array<int>& order) {
    const int n = int(from.size());
    T* out = to.data();
    const T* in = from.data();
    const int* o = order.data();
#pragma omp parallel for schedule(static)
    for (int i = 0; i < n; ++i) out[i] = in[o[i]];
  }
  double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }
  void wait() const {}
  std::string name() const { return "CPU"; }
};

}  // namespace lgiw
