// Kernels, viscosity, constitutive law, and copies with their pair loop, compiled once for each instruction set
// (LGIW_LANES).
#include "kernels.hh"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "physics/interface.hh"
#include "physics/kernel.hh"
#include "physics/soil.hh"
#include "physics/water.hh"
#include "solver/machine.hh"

// From here on, for the processor (machine.hh says what may follow).
#if LGIW_LANES == 16
#pragma GCC target("arch=x86-64-v4,prefer-vector-width=512")
#elif LGIW_LANES == 8
#pragma GCC target("arch=x86-64-v3")
#endif

#include "solver/copy_near.hh"

namespace lgiw {
namespace {

using T = float;
constexpr int D = 3;
using V = Vec<T, D>;
constexpr T dp = 0.01f, h = 1.5f * dp;
constexpr int batch = 4096;  // fits into the second cache with all fields

std::vector<T> uniform(std::size_t n, T low, T high, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<T> out(n);
  // Not std::uniform_real_distribution: its code would be compiled for this processor alone.
  for (T& x : out) x = low + (high - low) * T(random() % 65536) / 65536;
  return out;
}

/// Ends the benchmark with an error where a result is no number or all are zero: then something else was timed.
void judge(benchmark::State& state, const std::vector<T>& out) {
  T sum = 0;
  for (const T x : out) sum += std::fabs(x);
  if (!(sum > 0 && sum < T(1e30))) state.SkipWithError("the results are wrong");
}

// Half of the candidates of a tile are out of reach.
template <class Kernel>
void kernel_gradient(benchmark::State& state) {
  const Kernel kernel(h);
  const std::vector<T> r = uniform(batch, 0, 4 * h, 1);
  std::vector<T> square(batch), out(batch);
  for (int j = 0; j < batch; ++j) square[j] = r[j] * r[j];
  for (auto _ : state) {
    T* to = out.data();
    const T* r2 = square.data();
#pragma GCC ivdep
    for (int j = 0; j < batch; ++j) to[j] = kernel.gradient(Distance<T>(r2[j]));
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * batch);
  judge(state, out);
}

void artificial_viscosity(benchmark::State& state) {
  const ArtificialViscosity<T, D> law(0.05, 30, h);
  const std::vector<T> vr = uniform(batch, -0.01f, 0.01f, 1), r2 = uniform(batch, 0, 4 * h * h, 2),
                       rho = uniform(batch, 990, 1010, 3);
  std::vector<T> out(batch);
  for (auto _ : state) {
    T* to = out.data();
    const T *a = vr.data(), *b = r2.data(), *c = rho.data();
#pragma GCC ivdep
    for (int j = 0; j < batch; ++j) to[j] = law(a[j], b[j], c[j]).pi;
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * batch);
  judge(state, out);
}

/// Elastic increment of a velocity gradient, and the return to the cone, which half of the particles need.
void constitutive_law(benchmark::State& state) {
  const SoilMaterial<T> soil(1e6, 0.3, 0.5, 0, 0, Cone::plane_strain);
  constexpr int S = Stress<T, D>::size;
  std::vector<T> stress[S], next[S], l[D * D];
  for (int c = 0; c < S; ++c) {
    stress[c] = c < D ? uniform(batch, -1000, -500, 1 + unsigned(c)) : uniform(batch, -270, 270, 1 + unsigned(c));
    next[c].resize(batch);
  }
  for (int k = 0; k < D * D; ++k) l[k] = uniform(batch, -1, 1, 10 + unsigned(k));
  std::vector<T> adps(batch);
  for (auto _ : state) {
    for (int i = 0; i < batch; ++i) {
      Stress<T, D> sigma;
      T gradient[D * D];
      for (int c = 0; c < S; ++c) sigma.c[c] = stress[c][i];
      for (int k = 0; k < D * D; ++k) gradient[k] = l[k][i];
      const Stress<T, D> increment = elastic_increment(soil, sigma, gradient, T(1e-4));
      for (int c = 0; c < S; ++c) sigma.c[c] += increment.c[c];
      adps[i] = return_mapping(soil, sigma, T(100));
      for (int c = 0; c < S; ++c) next[c][i] = sigma.c[c];
    }
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * batch);
  int yielding = 0;
  for (const T x : adps) yielding += x > 0;
  state.counters["yielding"] = double(yielding) / batch;
  judge(state, next[0]), judge(state, adps);
}

/// A jittered lattice around the tile of 2.5 dp in its middle, with the eight fields that forces on water read.
struct Surroundings {
  static constexpr int fields = 8, across = 11;  // x, y, z, u, v, w, excess, p / rho^2
  std::vector<T> field[fields], copy[fields];
  const T* from[fields];
  T* to[fields];
  NearBox<T, D> box;
  int n = across * across * across;

  Surroundings() {
    for (int f = 0; f < fields; ++f) {
      field[f] = f < D ? uniform(n, -0.1f * dp, 0.1f * dp, 1 + unsigned(f)) : uniform(n, -0.5f, 0.5f, 1 + unsigned(f));
      copy[f].resize(n + 2 * widest_lanes);
      from[f] = field[f].data(), to[f] = copy[f].data();
    }
    for (int j = 0; j < n; ++j) {
      field[0][j] += T(j % across - across / 2) * dp;
      field[1][j] += T(j / across % across - across / 2) * dp;
      field[2][j] += T(j / across / across - across / 2) * dp;
    }
    for (int k = 0; k < D; ++k) box.low[k] = -1.25f * dp, box.high[k] = 1.25f * dp;
    box.reach2 = 4 * h * h;
  }
  /// In rows of the lattice, as rows of cells are.
  int look() {
    ranges.clear();
    for (int row = 0; row < across * across; ++row) ranges.push_back({row * across, (row + 1) * across});
    return copy_near<LGIW_LANES>(box, fields, from, ranges, to, 0);
  }
  Ranges ranges;
};

void copies_of_a_tile(benchmark::State& state) {
  Surroundings around;
  int near = 0;
  for (auto _ : state) {
    near = around.look();
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * around.n);
  state.counters["near"] = near;
  judge(state, around.copy[0]);
}

/// The forces of water on one particle by all candidates of its tile: what most of the time of a step goes into.
void pair_loop_of_water(benchmark::State& state) {
  Surroundings around;
  const int near = around.look(), whole = (near + widest_lanes - 1) / widest_lanes * widest_lanes;
  for (int f = 0; f < Surroundings::fields; ++f)
    for (int j = near; j < whole; ++j) around.to[f][j] = f == 0 ? T(-1) : T(0);  // beyond reach
  const Wendland<T, D> kernel(h);
  const ArtificialViscosity<T, D> viscosity(0.05, 30, h);
  const T rho0 = 1000;
  std::vector<T> out(D + 1);
  V x{{0, 0, 0}}, v{{0, 0, 0}};
  for (auto _ : state) {
    V a{};
    T mu_max = 0;
    benchmark::DoNotOptimize(x), benchmark::DoNotOptimize(v);
    T* const* c = around.to;
#pragma GCC ivdep
    for (int j = 0; j < whole; ++j) {
      const V r{{x.c[0] - c[0][j], x.c[1] - c[1][j], x.c[2] - c[2][j]}};
      const V v_ij{{v.c[0] - c[3][j], v.c[1] - c[4][j], v.c[2] - c[5][j]}};
      const T r2 = dot(r, r);
      const auto viscous = viscosity(dot(v_ij, r), r2, rho0 + T(0.5) * c[6][j]);
      const T f = kernel.gradient(Distance<T>(r2));
      mu_max = largest(mu_max, f < 0 ? std::fabs(viscous.mu) : T(0));
      add_scaled(a, -(c[7][j] + viscous.pi) * f, r);
    }
    for (int k = 0; k < D; ++k) out[k] = a.c[k];
    out[D] = mu_max;
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * whole);
  state.counters["candidates"] = whole;
  judge(state, out);
}

}  // namespace

template <int lanes>
void register_kernels(const char* instruction_set) {
  const std::string set = instruction_set;
  const auto add = [&set](const char* name, void (*f)(benchmark::State&)) {
    benchmark::RegisterBenchmark((std::string(name) + "/" + set).c_str(), f);
  };
  add("kernel_gradient/wendland", kernel_gradient<Wendland<T, D>>);
  add("kernel_gradient/cubic", kernel_gradient<CubicSpline<T, D>>);
  add("artificial_viscosity", artificial_viscosity);
  add("constitutive_law", constitutive_law);
  add("copies_of_a_tile", copies_of_a_tile);
  add("pair_loop_of_water", pair_loop_of_water);
}
template void register_kernels<LGIW_LANES>(const char*);

}  // namespace lgiw
