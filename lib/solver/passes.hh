// The passes over particles that make a time step. Each is a functor over one particle's index that gathers from its
// neighbours; the backends differ only in how they run it for all indices. Inner loops hold no branch on the phase: a
// phase or feature that the scene lacks is skipped outside them.
#pragma once

#include "solver/held.hh"
#include "solver/parameters.hh"
#include "solver/simulation.hh"

namespace lgiw {

#if defined(__CUDA_ARCH__)
#define LGIW_ROLLED _Pragma("unroll 1")
#else
#define LGIW_ROLLED
#endif

/// Numbers of particles, of which each thread has its own: on a device in shared memory, where those of threads side by
/// side lie side by side. Places in it are counted in steps.
template <class Machine>
class NearList {
 public:
  static constexpr int size = Machine::list;
#if defined(__CUDA_ARCH__)
  static constexpr int step = Machine::block;
  __device__ __forceinline__ NearList() : first_(int(threadIdx.x)), end_(first_) {}
#else
  static constexpr int step = 1;
  LGIW_FN NearList() {}
#endif
  LGIW_FN int first() const { return first_; }
  LGIW_FN int end() const { return end_; }
  LGIW_FN bool has_room(int for_how_many) const { return end_ <= first_ + (size - for_how_many) * step; }
  /// Takes `j` if `near`: without a branch, as some thread of a warp always takes one.
  LGIW_FN void add(int j, bool near) {
    numbers()[end_] = j;
    end_ += near ? step : 0;
  }
  LGIW_FN int operator[](int place) { return numbers()[place]; }
  LGIW_FN void clear() { end_ = first_; }

 private:
#if defined(__CUDA_ARCH__)
  static __device__ __forceinline__ int* numbers() {
    __shared__ int of_block[size * Machine::block];
    return of_block;
  }
  int first_, end_;
#else
  LGIW_FN int* numbers() { return numbers_; }
  int first_ = 0, end_ = 0, numbers_[size];
#endif
};

template <class Tr>
struct Pass {
  using Types = Tr;
  using T = typename Tr::T;
  using P = typename Tr::P;
  static constexpr int D = Tr::D, S = Tr::S;
  using V = Vec<T, D>;
  Grid<T, D> grid;
  Parameters<Tr> parameters;
  WaterView<Tr> water;
  SoilView<Tr> soil;
  WallView<Tr> wall;
  BodyView<Tr> bodies;
  Near<Tr> copies;  // empty where a pass looks among all particles
  const StepState* state;
  bool stepping;  // part of a step; else the present state is evaluated whatever the time

  /// Where it is to look for neighbours of particle i: on a device.
  using Cell = InCell<T, D>;
  template <class View>
  LGIW_FN Cell cell_of([[maybe_unused]] const View& view, [[maybe_unused]] int i) const {
    if constexpr (Tr::tiles)
      return {};
    else
      return grid.in_cell(load(view.x, i));
  }
  template <class Fields>
  static LGIW_FN V load(const Fields& a, int i) {
    V r;
    for (int k = 0; k < D; ++k) r.c[k] = a[k][i];
    return r;
  }
  static LGIW_FN void store(T* const* a, int i, const V& v) {
    for (int k = 0; k < D; ++k) a[k][i] = v.c[k];
  }
  /// Velocity relative to wall particle j.
  template <class Walls>
  static LGIW_FN V relative(const V& v, const Walls& b, int j) {
    if constexpr (Walls::moving)
      return v - load(b.own_v, j);
    else
      return v;
  }
  static LGIW_FN Stress<T, D> load_stress(const T* const* a, int i) {
    Stress<T, D> r;
    for (int k = 0; k < S; ++k) r.c[k] = a[k][i];
    return r;
  }
  static LGIW_FN void store_stress(T* const* a, int i, const Stress<T, D>& s) {
    for (int k = 0; k < S; ++k) a[k][i] = s.c[k];
  }
  /// Calls f(j, r, r2) for the particles j of a phase near x (whose cell is given): r = x - x_j, r2 = |r|^2, and `view`
  /// is one of nearby(). Those beyond the kernel's support may come too, and x itself with r = 0: every pair law is
  /// zero for them.
  ///
  /// On the CPU the particles near a tile have been copied side by side (tiles.hh), and all of them are computed, so
  /// that the loop vectorises.
  template <class View, class F>
  LGIW_FN void for_each_near(const View& view, [[maybe_unused]] const Cell& cell, const V& x, const F& f) const {
    if constexpr (Tr::tiles) {
#if !defined(__CUDACC__)
#pragma GCC ivdep
#endif
      for (int j = 0; j < view.n; ++j) {
        const V r = x - load(view.x, j);
        f(j, r, dot(r, r));
      }
    } else {
      for_each_listed(view, cell, x, f);
    }
  }
  /// The same on a device, without those beyond reach. A thread first lists who is near, then computes them: what
  /// one thread of a warp computes all others wait for, and each has other neighbours among its candidates.
  template <class View, class F>
  LGIW_FN void for_each_listed(const View& view, const Cell& cell, const V& x, const F& f) const {
    using Machine = typename Tr::Machine;
    constexpr int stroke = View::at_a_stroke;
    const T reach = T(2 * reach_in_supports) * parameters.h, far2 = reach * reach;
    NearList<Machine> list;
    NearRows<T, D> rows(grid, cell);
    const int last = rows.count();
    LGIW_ROLLED
    for (int k = 0; k <= last; ++k) {  // the last one computes what is left
      int j = 0, end = 0;
      if (k < last) rows.next(view.start, j, end);
      for (;;) {
        LGIW_ROLLED
        for (; j < end && list.has_room(stroke); j += stroke) {
          LGIW_COMPONENTS
          for (int m = 0; m < stroke; ++m) {
            const V r = x - view.at(j + m);
            list.add(j + m, (j + m < end) & (dot(r, r) < far2));
          }
        }
        if (!Machine::any_beside(!list.has_room(stroke)) && k < last) break;
        LGIW_ROLLED
        for (int place = list.first(); place < list.end(); place += list.step) {
          const int near = list[place];
          const V r = x - view.hold(near);
          f(near, r, dot(r, r));
        }
        list.clear();
        if (!Machine::any_beside(j < end)) break;
      }
    }
  }
  static LGIW_FN void add(T* const* a, int i, T s, const V& v) {
    for (int k = 0; k < D; ++k) a[k][i] += s * v.c[k];
  }
  /// True where it is known beforehand that neither water nor soil is near: on the CPU.
  LGIW_FN bool nothing_near() const {
    if constexpr (Tr::tiles)
      return copies.water.n == 0 && copies.soil.n == 0;
    else
      return false;
  }
  /// The phases among which a pass finds its neighbours: copies of what is near a tile, or all particles, of which it
  /// holds one at a time.
  LGIW_FN decltype(auto) nearby() const {
    if constexpr (Tr::tiles)
      return static_cast<const Near<Tr>&>(copies);
    else
      return HeldNear<Tr>{HeldWater<Tr>(water), HeldSoil<Tr>(soil), HeldWall<Tr>(wall), HeldBodies<Tr>(bodies)};
  }

  template <bool of_bodies>
  LGIW_FN const auto& walls() const {
    if constexpr (of_bodies)
      return bodies;
    else
      return wall;
  }

  /// True once the target time is reached or a step has failed: what a device still has queued then changes nothing.
  /// Not within the step that fails, of which all particles are to be looked at: the smallest id is told.
  LGIW_FN bool idle() const { return !(state->time < state->target) || state->stopped; }
  /// Part of a step that a device still had queued: the forces of the last step remain, which depend on its length
  /// where walls rub. A host queues none.
  LGIW_FN bool superfluous() const {
    if constexpr (Tr::tiles)
      return false;
    else
      return stepping && idle();
  }
  /// Half the step in which the particles have just moved, where rates are taken after the motion (leapfrog). Rates
  /// need r_ij at the time of v_ij, half a step ago: r - half v. With the later r each pair adds v_ij^2 dt / 2, and
  /// what turns at omega loses density by omega^2 dt a second: drops that spin burst, eddies suck.
  LGIW_FN T half_step() const { return parameters.verlet ? T(0) : T(0.5 * state->dt); }
  static LGIW_FN V earlier(const V& r, const V& v, T half) { return r - half * v; }
  LGIW_FN T pore_pressure(T z) const {
    return largest(T(0), parameters.pore_gradient * (parameters.still_water_level - z));
  }
};

/// Keeps the smallest id of a particle whose state has failed.
LGIW_FN void note_failure(unsigned* failed, unsigned id) {
#if defined(__CUDA_ARCH__)
  atomicMin(failed, id);
#else
#pragma omp critical(lgiw_failed_particle)
  if (id < *failed) *failed = id;
#endif
}

/// Largest values that limit the time step.
template <class T>
struct Limits {
  T acceleration2 = 0, mu = 0;  // |a|^2, |mu_ij|
};

// ---------------------------------------------------------------------------------------------------------------------
// Motion

/// Advances velocity and position, marks what has left the domain, finds states that have failed, and sets the sort
/// key. Leapfrog: v^{n+1/2} = v^{n-1/2} + (dt_n + dt_{n-1})/2 a^n, r^{n+1} = r^n + dt_n v^{n+1/2}. Verlet: physics.md
/// section 9.
template <class Tr, bool is_water>
struct Motion : Pass<Tr> {
  using B = Pass<Tr>;
  using T = typename Tr::T;
  using P = typename Tr::P;
  static constexpr int D = Tr::D;
  int* lost;         // counter in the state
  unsigned* failed;  // smallest failed id

  /// |x| < limit, written so that it also holds under -ffinite-math-only: a NaN or infinity has the largest exponent.
  static LGIW_FN bool sound(double x, double limit) {
    union {
      double d;
      unsigned long long u;
    } bits{x};
    return (((bits.u >> 52) & 0x7ff) != 0x7ff) & (x < limit) & (x > -limit);
  }

  /// What is the same for all particles in a step.
  struct Manner {
    bool held, verlet, euler, settling, shifted;
  };
  LGIW_FN Manner manner() const {
    const StepState& st = *this->state;
    return {!is_water && st.settling == int(Settling::water), this->parameters.verlet, st.euler_countdown == 0,
            st.settling != 0, is_water && this->parameters.shifting.strength > 0};
  }
  /// What a step makes of a particle. Numbers instead of truth values, of which GCC makes no vectors: 0 where it is
  /// sound, and where it is inside.
  struct Moved {
    Vec<T, D> v;
    Vec<double, D> x;
    double unsound, outside;
  };
  template <class View, class How>
  LGIW_FN Moved moved(const View& w, int i, const StepState& st, const How& how) const {
    const auto& p = this->parameters;
    Moved to;
    to.unsound = to.outside = 0;
    double speed2 = 0;
    const double z = double(w.position[D - 1][i]);
    LGIW_COMPONENTS
    for (int k = 0; k < D; ++k) {
      T v = w.v[k][i];
      const T a = w.a[k][i];
      double dx;
      if (how.held) {
        v = 0, dx = 0;
      } else if (how.verlet) {
        const T next = how.euler ? v + T(st.dt) * a : w.v_previous[k][i] + T(st.dt + st.dt_previous) * a;
        dx = st.dt * double(v) + 0.5 * st.dt * st.dt * double(a);
        v = next;
      } else {
        v += T(0.5 * (st.dt + st.dt_previous)) * a;
        if (how.settling) v *= T(1 / (1 + st.dt * double(is_water ? p.settle_rate : p.soil_settle_rate)));
        dx = st.dt * double(v);
      }
      if constexpr (is_water) {
        if (how.shifted) dx += st.dt * double(w.shift[k][i]);
      }
      const P position = P(double(w.position[k][i]) + dx);
      double x = double(position);
      to.unsound = sound(x, 1e12) ? to.unsound : 1;
      bool inside = within(k, x);
      if (k < D - 1) {
        // Nothing passes the walls along the sides of the domain: what the pressure of thin, slow sheets lets through
        // stays at their surface.
        const bool below = (x < p.low[k]) & (z < p.side_top[2 * k]);
        const bool above = (x > p.high[k]) & (z < p.side_top[2 * k + 1]);
        x = below ? p.low[k] : (above ? p.high[k] : x);
        v = below | above ? T(0) : v;
        inside = inside | below | above;
      }
      speed2 += double(v) * double(v);
      to.outside = inside ? to.outside : 1;
      to.v.c[k] = v, to.x.c[k] = x;
    }
    to.unsound = sound(speed2, double(p.speed_limit) * double(p.speed_limit)) ? to.unsound : 1;
    return to;
  }
  LGIW_FN bool within(int k, double x) const {
    return (x >= this->parameters.low[k]) & (x <= this->parameters.high[k]);
  }
  LGIW_FN int key_of(const Vec<double, D>& x) const {
    Vec<T, D> rounded;  // the passes look for their cell with positions in T
    LGIW_COMPONENTS
    for (int k = 0; k < D; ++k) rounded.c[k] = T(x.c[k]);
    return this->grid.cell(rounded);
  }

  LGIW_FN const auto& own() const {
    if constexpr (is_water)
      return this->water;
    else
      return this->soil;
  }
  LGIW_FN void operator()(int i) const {
    const auto& p = this->parameters;
    const auto& w = own();
    if (this->idle()) return;
    if (i >= w.start[this->grid.cells]) {  // lost earlier: stays where it was last
      w.key[i] = this->grid.cells;
      return;
    }
    const Manner how = manner();
    const Moved to = moved(w, i, *this->state, how);
    bool inside = true;
    for (int k = 0; k < D; ++k) {
      if (how.verlet && !how.held) w.v_previous[k][i] = w.v[k][i];
      w.v[k][i] = to.v.c[k];
      inside = inside && within(k, to.x.c[k]);
      if (inside) w.position[k][i] = P(to.x.c[k]);
    }
    if (to.unsound > 0) {
      note_failure(failed, w.id[i]);
      w.key[i] = this->grid.cells;
    } else if (to.outside > 0) {
      for (int k = 0; k < D; ++k) {
        const double x = to.x.c[k], edge = x < p.low[k] ? p.low[k] : (x > p.high[k] ? p.high[k] : x);
        w.position[k][i] = P(edge);
        w.v[k][i] = 0;
      }
      count_lost();
      w.key[i] = this->grid.cells;
    } else {
      w.key[i] = key_of(to.x);
    }
  }

  LGIW_FN void count_lost() const {
#if defined(__CUDA_ARCH__)
    atomicAdd(lost, 1);
#else
#pragma omp atomic
    ++*lost;
#endif
  }

#if !defined(__CUDACC__)
  /// On a host: the particles [begin, end), of which there are at most block_size. Nearly all of them remain in the
  /// domain, which takes no branch: they are moved side by side, the others as above.
  static constexpr int block_size = 256;
  void block(int begin, int end) const {
    const Manner how = manner();
    const bool usual = !(this->idle() || how.held || how.settling || how.shifted || (how.verlet && how.euler));
    const int active = own().start[this->grid.cells], last = usual ? (end < active ? end : active) : begin;
    double left[block_size];
    if (how.verlet)
      move_usual<true>(begin, last, left);
    else
      move_usual<false>(begin, last, left);
    for (int i = begin; i < end; ++i)
      if (i >= last || left[i - begin] > 0) (*this)(i);
  }

 private:
  template <bool by_verlet>
  struct Usual {
    static constexpr bool held = false, verlet = by_verlet, euler = false, settling = false, shifted = false;
  };
  /// Moves those that remain, and marks the others, which are left as they are.
  template <bool verlet>
  void move_usual(int begin, int end, double* left) const {
    const Motion self = *this;  // nothing that is written here can change it, as the compiler sees
    const StepState st = *this->state;
    const auto& w = self.own();
#pragma omp simd
    for (int i = begin; i < end; ++i) {
      const Moved to = self.moved(w, i, st, Usual<verlet>());
      const double amiss = to.unsound + to.outside;
      const bool remains = amiss == 0;
      left[i - begin] = amiss;
      Vec<double, D> x;
      LGIW_COMPONENTS
      for (int k = 0; k < D; ++k) {
        const T v = w.v[k][i];
        if (verlet) w.v_previous[k][i] = remains ? v : w.v_previous[k][i];
        w.v[k][i] = remains ? to.v.c[k] : v;
        w.position[k][i] = remains ? P(to.x.c[k]) : w.position[k][i];
        x.c[k] = remains ? to.x.c[k] : self.parameters.low[k];
      }
      w.key[i] = self.key_of(x);
    }
  }
#endif
};

/// Where the bodies are at the end of a step, once a step. Rates use the velocity with which the particles move
/// meanwhile: that of the middle of the step with leapfrog, that of its end with Verlet. Bodies wait while the scene
/// settles.
template <class Tr>
struct BodyStates : Pass<Tr> {
  const MotionRow* rows;
  const int* first;      // [bodies + 1]: rows of each
  const double* pivots;  // [bodies][3]
  RigidState* now;       // [bodies][2]: at the end of the step, and at the time of the velocity
  int n_bodies;
  bool moving_on;  // false: at the time of the state itself

  LGIW_FN void operator()(int) const {
    const StepState& st = *this->state;
    if (moving_on && this->idle()) return;
    const double end = st.settling ? 0 : st.time + (moving_on ? st.dt : 0);
    const double middle = moving_on && !st.settling && !this->parameters.verlet ? st.time + 0.5 * st.dt : end;
    for (int b = 0; b < n_bodies; ++b) {
      const MotionRow* table = rows + first[b];
      const int n = first[b + 1] - first[b];
      now[2 * b] = rigid_state(table, n, pivots + 3 * b, end);
      now[2 * b + 1] = rigid_state(table, n, pivots + 3 * b, middle);
      for (int k = 0; k < 2 && st.settling; ++k) stop(now[2 * b + k]);
    }
  }
  static LGIW_FN void stop(RigidState& s) {
    for (int k = 0; k < 3; ++k) s.velocity[k] = s.acceleration[k] = 0;
    s.spin = s.spin_rate = 0;
  }
};

/// Places the particles of the bodies.
template <class Tr>
struct BodyMotion : Pass<Tr> {
  using B = Pass<Tr>;
  using T = typename Tr::T;
  static constexpr int D = Tr::D;
  const RigidState* now;
  const double* ahead;  // [bodies][2]
  bool moving_on;

  LGIW_FN void operator()(int i) const {
    if (moving_on && this->idle()) return;
    const auto& b = this->bodies;
    const int body = b.body[i];
    const RigidState &end = now[2 * body], &middle = now[2 * body + 1];
    const double ahead_x = ahead[2 * body], ahead_y = ahead[2 * body + 1];
    double arm[3] = {0, 0, 0}, normal[3] = {0, 0, 0}, place[3], velocity[3], acceleration[3], direction[3], unused[3];
    for (int k = 0; k < D; ++k) arm[axis(k)] = double(b.arm[k][i]);
    rigid_point(middle, ahead_x, ahead_y, arm, place, velocity, unused);
    rigid_point(end, ahead_x, ahead_y, arm, place, unused, acceleration);
    Vec<T, D> x;
    for (int k = 0; k < D; ++k) {
      x.c[k] = b.place[k][i] = T(place[axis(k)]);
      b.own_v[k][i] = T(velocity[axis(k)]);
      b.own_a[k][i] = T(acceleration[axis(k)]);
    }
    if (b.direction[0]) {  // where a phase needs the normals
      for (int k = 0; k < D; ++k) normal[axis(k)] = double(b.own_normal[k][i]);
      rigid_direction(end, ahead_x, ahead_y, normal, direction);
      for (int k = 0; k < D; ++k) b.direction[k][i] = T(direction[axis(k)]);
    }
    b.key[i] = inside(place) ? this->grid.cell(x) : this->grid.cells;  // beyond the grid nothing is near it
  }
  static LGIW_FN int axis(int k) { return D == 2 && k == 1 ? 2 : k; }
  LGIW_FN bool inside(const double* place) const {
    for (int k = 0; k < D; ++k) {
      const double cell = (place[axis(k)] - this->grid.low[k]) * this->grid.inverse_width[k];
      const int edge = this->grid.at_edge(k);
      if (!(cell >= edge && cell < this->grid.n[k] - edge)) return false;
    }
    return true;
  }
};

// ---------------------------------------------------------------------------------------------------------------------
// Rates: density of water, stress of soil

/// Continuity of two water particles: what each adds to the rate of the other one. `diffusion` compiles in that of
/// density, which alone needs the densities.
template <bool diffusion, class Tr, class Water>
LGIW_FN void continuity_of_pair(const WaterContinuity<typename Tr::T, Tr::D>& continuity, typename Tr::T rho0,
                                const Vec<typename Tr::T, Tr::D>& r, const Vec<typename Tr::T, Tr::D>& v_ij,
                                typename Tr::T f, typename Tr::T e_i, const Water& w, int j, typename Tr::T& mine,
                                typename Tr::T& other) {
  using T = typename Tr::T;
  if constexpr (diffusion) {
    const T e_j = w.excess[j];
    T inverse_j;
    if constexpr (Tr::tiles)
      inverse_j = w.inverse_density[j];
    else
      inverse_j = 1 / (rho0 + e_j);
    mine = continuity(r, v_ij, f, e_i, e_j, inverse_j);
    other = continuity(T(-1) * r, T(-1) * v_ij, f, e_j, e_i, 1 / (rho0 + e_i));
  } else {
    mine = other = continuity(r, v_ij, f);
  }
}
/// What it reads of neighbours, with their velocities. A division for each candidate of a tile saves one for each of
/// its pairs.
template <class Tr, class F>
void continuity_reads(const Parameters<Tr>& p, WaterView<Tr>& w, F&& f) {
  f(w, w.v);
  if (!p.density_diffusion) return;
  f(w, w.excess), f.reciprocal(w, w.inverse_density, w.excess, p.eos.rho0);
}

/// The term p / rho^2 of water of excess density e.
template <class Tr>
LGIW_FN typename Tr::T pressure_term(const Parameters<Tr>& p, typename Tr::T e) {
  const typename Tr::T rho = p.eos.rho0 + e;
  return p.eos.pressure(e) / (rho * rho);
}
/// Whether it is water still: not half or twice the reference density.
template <class Tr>
LGIW_FN bool is_water_still(const Parameters<Tr>& p, typename Tr::T e) {
  return Motion<Tr, true>::sound(double(e), 0.5 * double(p.eos.rho0));
}
/// Gives a water particle its new density, and the pressure that follows from it. Half or twice the reference density
/// is no water any more: `failed` is told.
template <class Tr>
LGIW_FN void store_density(const Parameters<Tr>& p, const WaterView<Tr>& w, int i, typename Tr::T* to,
                           typename Tr::T next, unsigned* failed) {
  if (!is_water_still(p, next)) {
    note_failure(failed, w.id[i]);
    next = w.excess[i];
  }
  to[i] = next;
  w.term[i] = pressure_term(p, next);
}

/// Leapfrog: continuity of a water particle over water. A pass of its own where each pair is computed once: it leaves
/// the sums in excess_next.
template <class Tr>
struct WaterPairRates : Pass<Tr> {
  using B = Pass<Tr>;
  using T = typename Tr::T;
  using V = typename B::V;

  template <class F>
  void reads(F&& f) {
    continuity_reads(this->parameters, this->copies.water, f);
  }
  template <class F>
  void sums(F&& f) {
    f(this->copies.water.excess_next);
  }
  LGIW_FN void operator()(int i) const {
    const auto& w = this->water;
    w.excess_next[i] += over_water(i, this->cell_of(w, i), B::load(w.x, i), B::load(w.v, i));
  }
  LGIW_FN T over_water(int i, const typename B::Cell& cell, const V& x, const V& v) const {
    return this->parameters.density_diffusion ? over_water<true>(i, cell, x, v) : over_water<false>(i, cell, x, v);
  }
  template <bool diffusion>
  LGIW_FN T over_water(int i, const typename B::Cell& cell, const V& x, const V& v) const {
    const auto& w = this->nearby().water;
    const auto kernel = this->parameters.kernel;
    const auto continuity = this->parameters.continuity;
    const T e_i = this->water.excess[i], half = this->half_step(), rho0 = this->parameters.eos.rho0;
    T rate = 0;
    this->for_each_near(w, cell, x, [&](int j, const V& now, T) LGIW_INLINE {
      const V v_ij = v - B::load(w.v, j), r = B::earlier(now, v_ij, half);
      const T f = kernel.gradient(Distance<T>(dot(r, r)));
      T mine, other;
      continuity_of_pair<diffusion, Tr>(continuity, rho0, r, v_ij, f, e_i, w, j, mine, other);
      rate += mine;
      if constexpr (Tr::pairs_once) w.excess_next[j] += other;
    });
    return rate;
  }
};

/// Leapfrog: continuity of a water particle over water, walls and soil, and its new density.
template <class Tr>
struct WaterRates : WaterPairRates<Tr> {
  using B = Pass<Tr>;
  using T = typename Tr::T;
  using V = typename B::V;
  static constexpr int D = Tr::D;
  unsigned* failed;

  template <class F>
  void reads(F&& f) {
    auto& near = this->copies;
    if (!Tr::pairs_once) WaterPairRates<Tr>::reads(f);
    f(near.wall, near.wall.weight), f(near.soil, near.soil.v);
    f(near.bodies, near.bodies.weight, near.bodies.own_v);
  }

  template <class Walls>
  LGIW_FN T over_walls(const Walls& b, const typename B::Cell& cell, const V& x, const V& v) const {
    const auto& p = this->parameters;
    const T half = this->half_step();
    T rate = 0;
    this->for_each_near(b, cell, x, [&](int j, const V& now, T) LGIW_INLINE {
      const V v_ib = B::relative(v, b, j), r = B::earlier(now, v_ib, half);
      rate += b.weight[j] * p.continuity(r, v_ib, p.kernel.gradient(Distance<T>(dot(r, r))));
    });
    return rate;
  }

  LGIW_FN void operator()(int i) const {
    const auto& p = this->parameters;
    const auto& w = this->water;
    if (this->idle() || i >= w.start[this->grid.cells]) {
      w.excess_next[i] = w.excess[i];
      return;
    }
    const auto cell = this->cell_of(w, i);
    const V x = B::load(w.x, i), v = B::load(w.v, i);
    T rate = Tr::pairs_once ? w.excess_next[i] : this->over_water(i, cell, x, v);
    T at_walls = 0;
    if (this->wall.n) at_walls += over_walls(this->nearby().wall, cell, x, v);
    if (this->bodies.n) at_walls += over_walls(this->nearby().bodies, cell, x, v);
    rate += compression_by_walls(at_walls, w.excess[i]);
    if (this->soil.n) {
      const T half = this->half_step();
      T sum = 0;
      const auto& s = this->nearby().soil;
      this->for_each_near(s, cell, x, [&](int j, const V& now, T) LGIW_INLINE {
        const V v_ws = v - B::load(s.v, j), r = B::earlier(now, v_ws, half);
        sum += p.continuity(r, v_ws, p.kernel.gradient(Distance<T>(dot(r, r))));
      });
      rate += p.velocity_factor * sum;
    }
    store_density(p, w, i, w.excess_next, w.excess[i] + T(this->state->dt) * rate, failed);
  }
};

/// Verlet: the new density of a water particle. The rate comes with the forces, which are taken at the same places
/// and velocities.
template <class Tr>
struct WaterDensity : Pass<Tr> {
  using T = typename Tr::T;
  unsigned* failed;

  LGIW_FN void operator()(int i) const {
    const auto& w = this->water;
    if (this->idle() || i >= w.start[this->grid.cells]) return;
    const StepState& st = *this->state;
    const T rate = w.density_rate[i], now = w.excess[i];
    const T next =
        st.euler_countdown == 0 ? now + T(st.dt) * rate : w.excess_previous[i] + T(st.dt + st.dt_previous) * rate;
    w.excess_previous[i] = now;
    store_density(this->parameters, w, i, w.excess, next, failed);
  }

#if !defined(__CUDACC__)
  /// On a host: the particles [begin, end), of which there are at most block_size, side by side where they are water
  /// still, the others as above.
  static constexpr int block_size = 256;
  void block(int begin, int end) const {
    if (this->idle()) return;
    const WaterDensity self = *this;  // nothing that is written here can change it, as the compiler sees
    const auto& w = self.water;
    const StepState st = *this->state;
    const bool euler = st.euler_countdown == 0;
    const T step = T(euler ? st.dt : st.dt + st.dt_previous);
    const int active = w.start[this->grid.cells], last = end < active ? end : active;
    T amiss[block_size];
    T any = 0;
#pragma omp simd reduction(+ : any)
    for (int i = begin; i < last; ++i) {
      const T now = w.excess[i], before = w.excess_previous[i];
      const T next = (euler ? now : before) + step * w.density_rate[i];
      const T term = pressure_term(self.parameters, next);
      const bool sound = is_water_still(self.parameters, next);
      amiss[i - begin] = sound ? T(0) : T(1);
      any += amiss[i - begin];
      w.excess_previous[i] = sound ? now : before;
      w.excess[i] = sound ? next : now;
      w.term[i] = sound ? term : w.term[i];
    }
    for (int i = begin; i < last && any > 0; ++i)
      if (amiss[i - begin] > 0) (*this)(i);
  }
#endif
};

/// Velocity images at the walls, or at the bodies, for the soil's velocity gradient: 2 v_wall - v_mean on rough walls,
/// the mirror image on slipping ones.
template <class Tr, bool of_bodies>
struct WallVelocities : Pass<Tr> {
  using B = Pass<Tr>;
  using T = typename Tr::T;
  using V = typename B::V;
  static constexpr int D = Tr::D;

  template <class F>
  void reads(F&& f) {
    f(this->copies.soil, this->copies.soil.v);
  }

  LGIW_FN void operator()(int i) const {
    const auto& s = this->nearby().soil;
    const auto& b = B::template walls<of_bodies>();
    const auto cell = this->cell_of(b, i);
    const V x = B::load(b.x, i);
    V sum{};
    T weight = 0;
    this->for_each_near(s, cell, x, [&](int j, const V&, T r2) LGIW_INLINE {
      const T w = this->parameters.kernel.value(square_root(r2));
      weight += w;
      add_scaled(sum, w, B::load(s.v, j));
    });
    V image{};
    if (weight > 0) {
      const V mean = B::relative((1 / weight) * sum, b, i), n = B::load(b.normal, i);
      const T slip = b.slip[i], normal = dot(mean, n);
      // slip 0: -mean; slip 1: mean - 2 (mean.n) n; both relative to the wall
      for (int k = 0; k < D; ++k) image.c[k] = (2 * slip - 1) * mean.c[k] - 2 * slip * normal * n.c[k];
      if constexpr (of_bodies) add_scaled(image, T(1), B::load(b.own_v, i));
    }
    B::store(b.v, i, image);
  }
};

/// Velocity gradient and stress diffusion of a soil particle, and its new stress.
template <class Tr>
struct SoilRates : Pass<Tr> {
  using B = Pass<Tr>;
  using T = typename Tr::T;
  using V = typename B::V;
  static constexpr int D = Tr::D, S = Tr::S;

  template <class F>
  void reads(F&& f) {
    auto& near = this->copies;
    f(near.soil, near.soil.v), f(near.wall, near.wall.weight, near.wall.v);
    f(near.bodies, near.bodies.weight, near.bodies.v, near.bodies.own_v);
    if (this->parameters.stress_diffusion > 0) f(near.soil, near.soil.stress);
  }

  template <bool diffusion, bool corrected>
  LGIW_FN void over_soil(const typename B::Cell& cell, const V& x, const V& v, const Stress<T, D>& sigma,
                         const Stress<T, D>& at_rest, T* l, Stress<T, D>& smoothing, MomentMatrix<T, D>& moment) const {
    const auto& s = this->nearby().soil;
    const auto& p = this->parameters;
    const T half = this->half_step();
    this->for_each_near(s, cell, x, [&](int j, const V& now, T) LGIW_INLINE {
      const V v_ji = B::load(s.v, j) - v, r = B::earlier(now, v_ji, -half);
      const T f = p.kernel.gradient(Distance<T>(dot(r, r)));
      LGIW_COMPONENTS
      for (int ab = 0; ab < D * D; ++ab) l[ab] += v_ji.c[ab / D] * (f * r.c[ab % D]);
      if constexpr (corrected) moment.add(f, r);
      if constexpr (diffusion) {
        const T g = dot(p.gravity, r);
        LGIW_COMPONENTS
        for (int c = 0; c < S; ++c) smoothing.c[c] -= (s.stress[c][j] - sigma.c[c] - g * at_rest.c[c]) * f;
      }
    });
  }

  template <bool corrected, class Walls>
  LGIW_FN void over_walls(const Walls& walls, const typename B::Cell& cell, const V& x, const V& v, T* l,
                          MomentMatrix<T, D>& moment) const {
    const T half = this->half_step();
    this->for_each_near(walls, cell, x, [&](int j, const V& now, T) LGIW_INLINE {
      const V v_ji = B::load(walls.v, j) - v, r = B::earlier(now, B::relative(v, walls, j), half);
      const T f = walls.weight[j] * this->parameters.kernel.gradient(Distance<T>(dot(r, r)));
      LGIW_COMPONENTS
      for (int ab = 0; ab < D * D; ++ab) l[ab] += v_ji.c[ab / D] * (f * r.c[ab % D]);
      if constexpr (corrected) moment.add(f, r);
    });
  }

  template <bool corrected>
  LGIW_FN void velocity_gradient(const typename B::Cell& cell, const V& x, const V& v, const Stress<T, D>& sigma,
                                 T pore, T* l, Stress<T, D>& smoothing) const {
    const auto& p = this->parameters;
    MomentMatrix<T, D> moment;
    if (p.stress_diffusion > 0)
      over_soil<true, corrected>(cell, x, v, sigma, pore > 0 ? p.static_stress_wet : p.static_stress_dry, l, smoothing,
                                 moment);
    else
      over_soil<false, corrected>(cell, x, v, sigma, p.static_stress_dry, l, smoothing, moment);
    if (this->wall.n) over_walls<corrected>(this->nearby().wall, cell, x, v, l, moment);
    if (this->bodies.n) over_walls<corrected>(this->nearby().bodies, cell, x, v, l, moment);
    for (int k = 0; k < D * D; ++k) l[k] *= p.volume;
    if constexpr (corrected) {
      moment.scale(p.volume);
      correct_gradient(l, moment);
    }
  }

  LGIW_FN void operator()(int i) const {
    const auto& p = this->parameters;
    const auto& s = this->soil;
    const StepState& st = *this->state;
    const Stress<T, D> sigma = B::load_stress(s.stress, i);
    if (this->idle() || i >= s.start[this->grid.cells] || st.settling == int(Settling::water)) {
      B::store_stress(s.stress_next, i, sigma);
      return;
    }
    const auto cell = this->cell_of(s, i);
    const V x = B::load(s.x, i), v = B::load(s.v, i);
    const T pore = this->pore_pressure(x.c[D - 1]);
    T l[D * D];
    for (int k = 0; k < D * D; ++k) l[k] = 0;
    Stress<T, D> smoothing;
    for (int k = 0; k < S; ++k) smoothing.c[k] = 0;
    if (p.corrected_strain_rate)
      velocity_gradient<true>(cell, x, v, sigma, pore, l, smoothing);
    else
      velocity_gradient<false>(cell, x, v, sigma, pore, l, smoothing);
    const bool euler = !p.verlet || st.euler_countdown == 0;
    const T dt = T(euler ? st.dt : st.dt + st.dt_previous);
    Stress<T, D> increment = elastic_increment(p.soil, sigma, l, dt);
    for (int k = 0; k < S; ++k) increment.c[k] += dt * p.stress_diffusion * p.volume * smoothing.c[k];
    Stress<T, D> next = euler ? sigma : B::load_stress(s.stress_previous, i);
    T adps = 0;
    if (p.return_mapping || st.settling) {
      for (int k = 0; k < S; ++k) next.c[k] += increment.c[k];
      // Elastic while settling: a slope that is to fail must not creep away before t = 0.
      if (!st.settling)
        adps = p.soil_rate.extra_alpha > 0 ? return_mapping(p.soil, p.soil_rate, next, pore, dt)
                                           : return_mapping(p.soil, next, pore);
    } else {
      adps = rate_form_update(p.soil, next, increment, l, dt, pore);
    }
    s.adps[i] += euler ? adps : T(st.dt) / dt * adps;
    if (p.verlet) B::store_stress(s.stress_previous, i, sigma);
    B::store_stress(s.stress_next, i, next);
    if (p.artificial_stress > 0) B::store_stress(s.artificial, i, lgiw::artificial_stress(next, p.artificial_stress));
  }
};

// ---------------------------------------------------------------------------------------------------------------------
// Images: the state of a phase seen where the other phase or a wall is (Adami et al. 2012; physics.md sections 7, 8)

/// Pressure of the surrounding water at x: sum V (p + rho g.(x - x_w)) W / sum V W; 0 where there is none. g is gravity
/// less the acceleration of the wall there (Adami et al. 2012, Eq. 27).
template <class Tr>
struct WaterImage : Pass<Tr> {
  using B = Pass<Tr>;
  using T = typename Tr::T;
  using V = typename B::V;
  static constexpr int D = Tr::D;

  template <class F>
  void reads(F&& f) {
    f(this->copies.water, this->copies.water.excess, this->copies.water.term);
  }

  LGIW_FN T pressure(const typename B::Cell& cell, const V& x, const V& g) const {
    const auto& w = this->nearby().water;
    const auto& p = this->parameters;
    T weight = 0, sum = 0;
    V moment{};
    this->for_each_near(w, cell, x, [&](int j, const V& r, T r2) LGIW_INLINE {
      const T rho = p.eos.rho0 + w.excess[j];
      const T kernel = p.kernel.value(square_root(r2));
      weight += kernel / rho;           // V_w = m_w / rho_w; the mass cancels
      sum += kernel * rho * w.term[j];  // V p = m rho (p / rho^2)
      add_scaled(moment, kernel, r);    // V rho = m
    });
    if (!(weight > 0)) return 0;
    return (sum + dot(g, moment)) / weight;
  }
};

/// Water pressure and soil stress at a particle of a wall or body.
template <class Tr, bool of_bodies>
struct WallImages : WaterImage<Tr> {
  using B = Pass<Tr>;
  using T = typename Tr::T;
  using V = typename B::V;
  static constexpr int D = Tr::D, S = Tr::S;

  template <class F>
  void reads(F&& f) {
    WaterImage<Tr>::reads(f), f(this->copies.soil, this->copies.soil.stress);
  }

  LGIW_FN void operator()(int i) const {
    const auto& p = this->parameters;
    const auto& b = B::template walls<of_bodies>();
    if (this->nothing_near()) return clear(b, i);
    const auto cell = this->cell_of(b, i);
    const V x = B::load(b.x, i);
    if (this->water.n) {
      V g = p.gravity;
      if constexpr (of_bodies) add_scaled(g, T(-1), B::load(b.own_a, i));
      const T pressure = this->pressure(cell, x, g);
      const T excess = p.eos.excess(pressure), rho = p.eos.rho0 + excess;
      b.excess[i] = excess;
      b.term[i] = pressure / (rho * rho);
    }
    if (this->soil.n) B::store_stress(b.stress, i, soil_stress(i, cell, x));
  }

  /// What follows where nothing is near, as for most walls of a dry bank.
  template <class Walls>
  LGIW_FN void clear(const Walls& b, int i) const {
    if (this->water.n) b.excess[i] = b.term[i] = 0;
    for (int c = 0; c < S && this->soil.n; ++c) b.stress[c][i] = 0;
  }

  /// Stress of the soil near x, continued to x. On rough walls the effective stress is continued along the normal as
  /// that of a layer grows with depth that rests, slides or flows: all components alike, shear with pressure. The
  /// static increase alone has no shear, and thin layers feel too little friction. Without enough pressure to continue,
  /// the static increase takes over.
  LGIW_FN Stress<T, D> soil_stress(int i, const typename B::Cell& cell, const V& x) const {
    const auto& p = this->parameters;
    const auto& s = this->nearby().soil;
    Stress<T, D> sum;
    for (int c = 0; c < S; ++c) sum.c[c] = 0;
    T weight = 0;
    V offset{};
    this->for_each_near(s, cell, x, [&](int j, const V& r, T r2) LGIW_INLINE {
      const T kernel = p.kernel.value(square_root(r2));
      weight += kernel;
      add_scaled(offset, kernel, r);
      for (int c = 0; c < S; ++c) sum.c[c] += kernel * s.stress[c][j];
    });
    if (!(weight > 0)) return sum;
    const auto& b = B::template walls<of_bodies>();
    const V n = B::load(b.normal, i);
    for (int c = 0; c < S; ++c) sum.c[c] /= weight;
    offset = (1 / weight) * offset;
    T moment = dot(p.gravity, offset);
    if (b.slip[i] == 0) {
      const T pore = this->pore_pressure(x.c[D - 1] - offset.c[D - 1]), share = pore > 0 ? p.pore_share : T(0);
      const T along = dot(p.gravity, n) * dot(offset, n), growth = p.soil_density * along * (1 - share);
      const T pressure = -dot(n, apply(sum, n)) - pore;
      if (growth > 0 && pressure > 0) {
        const T continued = smallest(T(1), pressure / (T(least_pressure) * growth));
        const T factor = 1 + continued * growth / pressure;
        for (int c = 0; c < S; ++c) sum.c[c] *= factor;
        add_isotropic(sum, (factor - 1) * pore - continued * share * p.soil_density * along);
        moment -= continued * along;
      }
    }
    const Stress<T, D>& at_rest = this->pore_pressure(x.c[D - 1]) > 0 ? p.static_stress_wet : p.static_stress_dry;
    for (int c = 0; c < S; ++c) sum.c[c] -= moment * at_rest.c[c];
    return b.slip[i] > 0 ? reflect(sum, n) : sum;
  }
  static constexpr double least_pressure = 0.2;  // of its increase, from which it is continued
};

/// Water pressure at a soil particle, Eq. (12) with the hydrostatic term that it lacks.
template <class Tr>
struct SoilImages : WaterImage<Tr> {
  using B = Pass<Tr>;
  using T = typename Tr::T;
  using V = typename B::V;

  LGIW_FN void operator()(int i) const {
    const auto& s = this->soil;
    const auto& p = this->parameters;
    T pressure = 0;
    if (i < s.start[this->grid.cells]) {
      const V g = p.image_gravity ? p.gravity : V{};
      pressure = this->pressure(this->cell_of(s, i), B::load(s.x, i), g);
    }
    const T excess = p.eos.excess(pressure), rho = p.eos.rho0 + excess;
    s.image_excess[i] = excess;
    s.image_term[i] = pressure / (rho * rho);
  }
};

/// Velocity of the shifting of a water particle.
template <class Tr>
struct WaterShift : Pass<Tr> {
  using B = Pass<Tr>;
  using T = typename Tr::T;
  using V = typename B::V;
  static constexpr int D = Tr::D;

  template <class F>
  void reads(F&& f) {
    auto& near = this->copies;
    f(near.water), f(near.soil), f(near.wall, near.wall.weight), f(near.bodies, near.bodies.weight);
  }

  LGIW_FN void operator()(int i) const {
    const auto& w = this->water;
    V shift{};
    if (i < w.start[this->grid.cells] && !this->state->settling) {
      const auto cell = this->cell_of(w, i);
      const V x = B::load(w.x, i), v = B::load(w.v, i);
      V gradient{};
      T divergence = 0;
      const auto of = [&](const auto& view, const auto& volume) {
        this->for_each_near(view, cell, x, [&](int j, const V& r, T r2) LGIW_INLINE {
          const T f = volume(view, j) * this->parameters.kernel.gradient(Distance<T>(r2));
          add_scaled(gradient, f, r);
          divergence -= f * r2;
        });
      };
      const T one = this->parameters.volume;
      const auto same = [&](const auto&, int) { return one; };
      const auto weighted = [&](const auto& walls, int j) { return one * walls.weight[j]; };
      of(this->nearby().water, same);
      if (this->soil.n) of(this->nearby().soil, same);
      if (this->wall.n) of(this->nearby().wall, weighted);
      if (this->bodies.n) of(this->nearby().bodies, weighted);
      shift = this->parameters.shifting(gradient, divergence, square_root(dot(v, v)));
    }
    B::store(w.shift, i, shift);
  }
};

// ---------------------------------------------------------------------------------------------------------------------
// Forces

/// Damping towards rest near absorbing sides, 1/s: a quadratic ramp over the absorbing width.
template <class Tr>
LGIW_FN typename Tr::T absorbing_rate(const Parameters<Tr>& p, double x, double y) {
  using T = typename Tr::T;
  double depth = 0;  // 0 at the inner edge of the zone, 1 at the side
  const double distance[4] = {x - p.side_at[0], p.side_at[1] - x, y - p.side_at[2], p.side_at[3] - y};
  for (int s = 0; s < 4; ++s)
    if (p.absorbing[s]) depth = largest(depth, 1 - distance[s] / p.absorbing_width);
  return p.absorbing_rate * T(depth * depth);
}

/// Acceleration of a water particle by water, per unit of mass. A pass of its own where each pair is computed
/// once: it leaves the sums in a. `rates` (Verlet): the sums of continuity, too, in density_rate, which saves a second
/// search for the same pairs and their kernel.
template <class Tr, bool rates>
struct WaterPairForces : Pass<Tr> {
  using B = Pass<Tr>;
  using T = typename Tr::T;
  using V = typename B::V;

  template <class F>
  void reads(F&& f) {
    auto& w = this->copies.water;
    if (rates && this->parameters.density_diffusion)
      continuity_reads(this->parameters, w, f), f(w, w.term);
    else
      f(w, w.v, w.excess, w.term);
  }
  template <class F>
  void sums(F&& f) {
    f(this->copies.water.a);
    if (rates) f(this->copies.water.density_rate);
  }
  LGIW_FN Limits<T> operator()(int i) const {
    const auto& w = this->water;
    T mu_max = 0, rate = 0;
    B::add(w.a, i, T(1), over_water(i, this->cell_of(w, i), B::load(w.x, i), B::load(w.v, i), mu_max, rate));
    if (rates) w.density_rate[i] += rate;
    return {T(0), mu_max};
  }
  LGIW_FN V over_water(int i, const typename B::Cell& cell, const V& x, const V& v, T& mu_max, T& rate) const {
    if constexpr (rates)
      if (this->parameters.density_diffusion) return over_water<true>(i, cell, x, v, mu_max, rate);
    return over_water<false>(i, cell, x, v, mu_max, rate);
  }
  template <bool diffusion>
  LGIW_FN V over_water(int i, const typename B::Cell& cell, const V& x, const V& v, T& mu_max, T& rate) const {
    const auto& w = this->nearby().water;
    const auto continuity = this->parameters.continuity;
    const auto kernel = this->parameters.kernel;
    const auto viscosity = this->parameters.water_viscosity;
    const T rho0 = this->parameters.eos.rho0, term_i = this->water.term[i], e_i = this->water.excess[i],
            rho_i = rho0 + e_i;
    V a{};
    T mu = 0, sum = 0;
    this->for_each_near(w, cell, x, [&](int j, const V& r, T r2) LGIW_INLINE {
      const V v_ij = v - B::load(w.v, j);
      const auto viscous = viscosity(dot(v_ij, r), r2, T(0.5) * (rho_i + rho0 + w.excess[j]));
      const T f = kernel.gradient(Distance<T>(r2));
      mu = largest(mu, f < 0 ? std::fabs(viscous.mu) : T(0));
      const T push = -(term_i + w.term[j] + viscous.pi) * f;
      add_scaled(a, push, r);
      if constexpr (Tr::pairs_once) B::add(w.a, j, -push, r);
      if constexpr (rates) {
        T mine, other;
        continuity_of_pair<diffusion, Tr>(continuity, rho0, r, v_ij, f, e_i, w, j, mine, other);
        sum += mine;
        if constexpr (Tr::pairs_once) w.density_rate[j] += other;
      }
    });
    mu_max = largest(mu_max, mu);
    rate += sum;
    return a;
  }
};

/// Acceleration of a water particle; `rates`: and the rate of its density.
template <class Tr, bool rates>
struct WaterForces : WaterPairForces<Tr, rates> {
  using B = Pass<Tr>;
  using T = typename Tr::T;
  using V = typename B::V;
  static constexpr int D = Tr::D;

  template <class F>
  void reads(F&& f) {
    auto& near = this->copies;
    if (!Tr::pairs_once) WaterPairForces<Tr, rates>::reads(f);
    f(near.wall, near.wall.weight, near.wall.excess, near.wall.term);
    f(near.bodies, near.bodies.weight, near.bodies.excess, near.bodies.term, near.bodies.own_v);
    if (this->parameters.water_slips) f(near.wall, near.wall.normal), f(near.bodies, near.bodies.normal);
    f(near.soil, near.soil.v, near.soil.image_excess, near.soil.image_term);
  }

  template <bool slips, class Walls>
  LGIW_FN void over_walls(const Walls& b, const typename B::Cell& cell, const V& x, const V& v, T term_i, T rho_i, V& a,
                          T& rate) const {
    const auto& p = this->parameters;
    T sum = 0;
    this->for_each_near(b, cell, x, [&](int j, const V& r, T r2) LGIW_INLINE {
      const V v_ib = B::relative(v, b, j);
      T vr;
      if constexpr (slips)
        vr = approach_to_wall(v_ib, r, B::load(b.normal, j), T(1));
      else
        vr = dot(v_ib, r);
      const T f = b.weight[j] * p.kernel.gradient(Distance<T>(r2));
      const T rho_mean = T(0.5) * (rho_i + p.eos.rho0 + b.excess[j]);
      const T push = push_of_wall(term_i, b.term[j]) + p.water_viscosity(vr, r2, rho_mean).pi;
      add_scaled(a, -push * f, r);
      if constexpr (rates) sum += p.continuity(r, v_ib, f);
    });
    rate += sum;
  }
  template <bool slips>
  LGIW_FN void over_all_walls(const typename B::Cell& cell, const V& x, const V& v, T term_i, T rho_i, V& a,
                              T& rate) const {
    if (this->wall.n) over_walls<slips>(this->nearby().wall, cell, x, v, term_i, rho_i, a, rate);
    if (this->bodies.n) over_walls<slips>(this->nearby().bodies, cell, x, v, term_i, rho_i, a, rate);
  }

  LGIW_FN Limits<T> operator()(int i) const {
    const auto& p = this->parameters;
    const auto& w = this->water;
    if (this->superfluous() || i >= w.start[this->grid.cells]) return {};
    const auto cell = this->cell_of(w, i);
    const V x = B::load(w.x, i), v = B::load(w.v, i);
    const T term_i = w.term[i], rho_i = p.eos.rho0 + w.excess[i], rho0 = p.eos.rho0;
    T mu_max = 0, rate = 0, at_walls = 0;
    V a = Tr::pairs_once ? B::load(w.a, i) : this->over_water(i, cell, x, v, mu_max, rate);
    if (p.water_slips)
      over_all_walls<true>(cell, x, v, term_i, rho_i, a, at_walls);
    else
      over_all_walls<false>(cell, x, v, term_i, rho_i, a, at_walls);
    a = p.water_mass * a;
    if constexpr (rates)
      rate += (Tr::pairs_once ? w.density_rate[i] : T(0)) + compression_by_walls(at_walls, w.excess[i]);
    if (this->soil.n) {
      const auto& s = this->nearby().soil;
      T sum = 0;
      this->for_each_near(s, cell, x, [&](int j, const V& r, T r2) LGIW_INLINE {
        const V v_ij = v - B::load(s.v, j);
        const Distance<T> distance(r2);
        const auto viscous = p.water_viscosity(dot(v_ij, r), r2, T(0.5) * (rho_i + rho0 + s.image_excess[j]));
        const T f = p.kernel.gradient(distance);
        mu_max = largest(mu_max, f < 0 ? std::fabs(viscous.mu) : T(0));
        add_scaled(a, p.interface(distance, f, viscous.pi, term_i, s.image_term[j]), r);
        if constexpr (rates) sum += p.continuity(r, v_ij, f);
      });
      if constexpr (rates) rate += p.velocity_factor * sum;
    }
    for (int k = 0; k < D; ++k) a.c[k] += p.gravity.c[k];
    if (p.absorbing_rate > 0) add_scaled(a, -absorbing_rate(p, double(x.c[0]), D == 3 ? double(x.c[1]) : 0.0), v);
    B::store(w.a, i, a);
    if constexpr (rates) w.density_rate[i] = rate;
    return {dot(a, a), mu_max};
  }
};

/// Acceleration of a soil particle by soil, per unit of mass. A pass of its own where each pair is computed once:
/// it leaves the sums in a.
template <class Tr>
struct SoilPairForces : Pass<Tr> {
  using B = Pass<Tr>;
  using T = typename Tr::T;
  using V = typename B::V;
  static constexpr int D = Tr::D, S = Tr::S;

  template <class F>
  void reads(F&& f) {
    auto& s = this->copies.soil;
    f(s, s.v, s.stress, s.artificial);
  }
  template <class F>
  void sums(F&& f) {
    f(this->copies.soil.a);
  }
  LGIW_FN Limits<T> operator()(int i) const {
    const auto& s = this->soil;
    T mu_max = 0;
    B::add(s.a, i, T(1), over_soil(i, this->cell_of(s, i), B::load(s.x, i), B::load(s.v, i), mu_max));
    return {T(0), mu_max};
  }
  LGIW_FN V over_soil(int i, const typename B::Cell& cell, const V& x, const V& v, T& mu_max) const {
    return this->parameters.artificial_stress > 0 ? over_soil<true>(i, cell, x, v, mu_max)
                                                  : over_soil<false>(i, cell, x, v, mu_max);
  }
  template <bool artificial>
  LGIW_FN V over_soil(int i, const typename B::Cell& cell, const V& x, const V& v, T& mu_max) const {
    const auto& s = this->nearby().soil;
    const auto kernel = this->parameters.kernel;
    const auto viscosity = this->parameters.soil_viscosity;
    const T rho = this->parameters.soil_density, inverse_rho2 = 1 / (rho * rho);
    const T inverse_w_dp = this->parameters.inverse_w_dp;
    const Stress<T, D> sigma = B::load_stress(this->soil.stress, i);
    const Stress<T, D> own = artificial ? B::load_stress(this->soil.artificial, i) : Stress<T, D>{};
    V a{};
    T mu = 0;
    this->for_each_near(s, cell, x, [&](int j, const V& r, T r2) LGIW_INLINE {
      const V v_ij = v - B::load(s.v, j);
      const auto viscous = viscosity(dot(v_ij, r), r2, rho);
      const Distance<T> distance(r2);
      const T f = kernel.gradient(distance);
      mu = largest(mu, f < 0 ? std::fabs(viscous.mu) : T(0));
      Stress<T, D> sum;
      LGIW_COMPONENTS
      for (int c = 0; c < S; ++c) sum.c[c] = (sigma.c[c] + s.stress[c][j]) * inverse_rho2;
      if constexpr (artificial) {
        const T ratio = kernel.value(distance.r) * inverse_w_dp;
        const T weight = std::pow(ratio, T(2.55));  // F^n, n = 2.55
        LGIW_COMPONENTS
        for (int c = 0; c < S; ++c) sum.c[c] += weight * (own.c[c] + s.artificial[c][j]);
      }
      V force = f * apply(sum, r);
      add_scaled(force, -f * viscous.pi, r);
      add_scaled(a, T(1), force);
      if constexpr (Tr::pairs_once) B::add(s.a, j, T(-1), force);
    });
    mu_max = largest(mu_max, mu);
    return a;
  }
};

/// Acceleration of a soil particle. `coulomb` compiles in walls with Coulomb friction.
template <class Tr, bool coulomb>
struct SoilForces : SoilPairForces<Tr> {
  using B = Pass<Tr>;
  using T = typename Tr::T;
  using V = typename B::V;
  static constexpr int D = Tr::D, S = Tr::S;

  template <class F>
  void reads(F&& f) {
    auto& near = this->copies;
    if (!Tr::pairs_once) SoilPairForces<Tr>::reads(f);
    f(near.wall, near.wall.normal, near.wall.slip, near.wall.weight, near.wall.stress, near.wall.friction);
    f(near.bodies, near.bodies.normal, near.bodies.slip, near.bodies.weight, near.bodies.stress, near.bodies.friction,
      near.bodies.own_v);
    f(near.water, near.water.v, near.water.excess, near.water.term);
  }

  LGIW_FN Limits<T> operator()(int i) const {
    const auto& p = this->parameters;
    const auto& s = this->soil;
    if (this->superfluous() || i >= s.start[this->grid.cells]) return {};
    const auto cell = this->cell_of(s, i);
    const V x = B::load(s.x, i), v = B::load(s.v, i);
    const Stress<T, D> sigma = B::load_stress(s.stress, i);
    T mu_max = 0;
    V a = Tr::pairs_once ? B::load(s.a, i) : this->over_soil(i, cell, x, v, mu_max);
    WallForce walls{};
    if (this->wall.n) of_walls(this->nearby().wall, cell, x, v, sigma, walls);
    if (this->bodies.n) of_walls(this->nearby().bodies, cell, x, v, sigma, walls);
    add_scaled(a, T(1), walls.force);
    a = p.soil_mass * a;
    if (this->water.n) {
      const auto& w = this->nearby().water;
      const T image_term = s.image_term[i], rho_image = p.eos.rho0 + s.image_excess[i], rho0 = p.eos.rho0;
      V sum{};
      this->for_each_near(w, cell, x, [&](int j, const V& r, T r2) LGIW_INLINE {
        // the law is written for water minus soil: odd in r
        const V v_ij = v - B::load(w.v, j);
        const Distance<T> distance(r2);
        const T viscous = p.water_viscosity(dot(v_ij, r), r2, T(0.5) * (rho_image + rho0 + w.excess[j])).pi;
        add_scaled(sum, p.interface(distance, p.kernel.gradient(distance), viscous, w.term[j], image_term), r);
      });
      add_scaled(a, p.mass_ratio, sum);
    }
    for (int k = 0; k < D; ++k) a.c[k] += p.gravity.c[k];
    if constexpr (coulomb) touch(i, walls, a);
    B::store(s.a, i, a);
    return {dot(a, a), mu_max};
  }

  /// Forces of walls per unit of soil mass.
  struct WallForce {
    V force;                   // of rough and slipping walls
    V pressure, normal, slip;  // of Coulomb walls: force along their normals; normals and velocity relative to them,
    T weight, friction;  // and coefficient of friction, times weight: sums of the kernel gradient along the normals
  };
  template <class Walls>
  LGIW_FN void of_walls(const Walls& b, const typename B::Cell& cell, const V& x, const V& v, const Stress<T, D>& sigma,
                        WallForce& sum) const {
    const auto& p = this->parameters;
    const T inverse_rho2 = 1 / (p.soil_density * p.soil_density);
    const T viscosity_on = p.wall_viscosity ? T(1) : T(0);
    this->for_each_near(b, cell, x, [&](int j, const V& r, T r2) LGIW_INLINE {
      const V n = B::load(b.normal, j), v_ib = B::relative(v, b, j);
      const T slip = b.slip[j];
      const T vr = approach_to_wall(v_ib, r, n, slip);
      const T f = b.weight[j] * p.kernel.gradient(Distance<T>(r2));
      const T viscous = viscosity_on * p.soil_viscosity(vr, r2, p.soil_density).pi;
      Stress<T, D> stress;
      for (int c = 0; c < S; ++c) stress.c[c] = (sigma.c[c] + b.stress[c][j]) * inverse_rho2;
      if constexpr (coulomb) {
        const T touching = b.friction[j] > 0 ? T(1) : T(0), weight = -touching * f * dot(r, n);
        add_scaled(sum.pressure, weight * (viscous - dot(n, apply(stress, n))), n);
        add_scaled(sum.normal, weight, n);
        add_scaled(sum.slip, weight, v_ib);
        sum.weight += weight, sum.friction += weight * b.friction[j];
        add_scaled(sum.force, 1 - touching, f * apply(stress, r));
        add_scaled(sum.force, -(1 - touching) * f * viscous, r);
      } else {
        V force = f * apply(stress, r);
        add_scaled(force, -f * viscous, r);
        add_scaled(sum.force, T(1), force);
      }
    });
  }

  /// Contact with Coulomb walls, physics.md section 8: adds their pressure, along the normals of the walls and never
  /// adhesive, to the acceleration `a` by all else, and then the friction that would bring the particle to rest
  /// relative to the wall within the next step, or what the pressure allows of it. Along a plane nothing else acts,
  /// whatever its angle to the lattice of particles.
  LGIW_FN void touch(int i, const WallForce& walls, V& a) const {
    const auto& p = this->parameters;
    const StepState& st = *this->state;
    const T length2 = dot(walls.normal, walls.normal);
    if (!(length2 > 0) || !(walls.weight > 0)) return;
    const V n = (1 / square_root(length2)) * walls.normal;
    const T pressure = p.soil_mass * dot(walls.pressure, n);
    if (!(pressure > 0)) return;
    add_scaled(a, p.soil_mass, walls.pressure);
    // The velocity that the acceleration is going to change, and over which time.
    const bool from_previous = p.verlet && st.euler_countdown != 1;
    V slip = (1 / walls.weight) * walls.slip;
    if (from_previous) {
      add_scaled(slip, T(1), B::load(this->soil.v_previous, i));
      add_scaled(slip, T(-1), B::load(this->soil.v, i));
    }
    const T dt = T(from_previous ? 2 * st.dt : st.dt);
    V stop = T(-1) * a;
    if (dt > 0) add_scaled(stop, -1 / dt, slip);
    add_scaled(stop, -dot(stop, n), n);
    const T size = square_root(dot(stop, stop)), limit = walls.friction / walls.weight * pressure;
    add_scaled(a, size > limit ? limit / size : T(1), stop);
  }
};

// ---------------------------------------------------------------------------------------------------------------------

/// The new time step, Eq. (21) with the soil's wave speed and a viscous limit, and the step's bookkeeping. `advance`: a
/// step has just been completed; else (start, after settling) only dt is set.
template <class Tr>
LGIW_FN void finish_step(const Parameters<Tr>& p, const Limits<typename Tr::T>& limits, bool advance, StepState& st) {
  const double h = double(p.h);
  const double acoustic = h / (p.fastest_wave + double(limits.mu));
  const double a = std::sqrt(double(limits.acceleration2));
  const double force = a > 0 ? std::sqrt(h / a) : 1e30;
  double dt = acoustic;
  int limit = 0;
  if (force < dt) dt = force, limit = 1;
  if (p.slowest_viscous < dt) dt = p.slowest_viscous, limit = 2;
  if (advance) {
    st.time += st.dt;
    ++st.step;
    ++st.limited[st.limit];
    if (st.dt < st.smallest_dt) st.smallest_dt = st.dt;
    st.dt_previous = st.dt;
    st.euler_countdown = st.euler_countdown == 0 ? 40 : st.euler_countdown - 1;
  }
  st.dt = p.cfl * st.share * dt;
  // Limits of stability itself, whatever the CFL number.
  if (st.share * p.viscous_step < st.dt) st.dt = st.share * p.viscous_step, limit = 2;
  if (st.share * p.diffusive_step < st.dt) st.dt = st.share * p.diffusive_step, limit = 3;
  st.limit = limit;
}

}  // namespace lgiw
