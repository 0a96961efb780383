// The time stepping itself, once for every backend: a step is a list of named, timed phases.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "base/error.hh"
#include "solver/particle_state.hh"
#include "solver/passes.hh"
#include "solver/simulation.hh"

namespace lgiw {

/// Functors that are no physics: bookkeeping.
template <class Tr>
struct FinishStep {
  Parameters<Tr> parameters;
  const Limits<typename Tr::T>* limits;
  StepState* state;
  bool advance;
  LGIW_FN void operator()(int) const {
    if (advance && (state->failed_water & state->failed_soil) != UINT32_MAX) state->stopped = 1;
    if (advance && (!(state->time < state->target) || state->stopped)) return;
    finish_step(parameters, *limits, advance, *state);
  }
};
template <class T>
struct ResetLimits {
  Limits<T>* limits;
  LGIW_FN void operator()(int) const { *limits = Limits<T>{}; }
};
/// First keys, before any motion.
template <class Tr, class View>
struct SetKeys : Pass<Tr> {
  View view;
  LGIW_FN void operator()(int i) const {
    Vec<typename Tr::T, Tr::D> x;
    for (int k = 0; k < Tr::D; ++k) x.c[k] = typename Tr::T(view.position[k][i]);
    view.key[i] = this->grid.cell(x);
  }
};
/// Term p/rho^2 from the density.
template <class Tr>
struct SetTerms : Pass<Tr> {
  LGIW_FN void operator()(int i) const { this->water.term[i] = pressure_term(this->parameters, this->water.excess[i]); }
};
/// On a device: what passes read of a neighbour at a stroke. View: of water or soil.
template <class Tr, class View>
struct SetFours : Pass<Tr> {
  using T = typename Tr::T;
  static constexpr int D = Tr::D;
  View view;
  const T *with_place, *with_velocity;  // null: 0
  LGIW_FN void operator()(int i) const {
    Four<T> place{}, motion{};
    for (int k = 0; k < D; ++k) place.c[k] = T(view.position[k][i]), motion.c[k] = view.v[k][i];
    if (with_place) place.c[D] = with_place[i];
    if (with_velocity) motion.c[D] = with_velocity[i];
    view.place[i] = place, view.motion[i] = motion;
  }
};
template <class Tr>
struct SetArtificialStress : Pass<Tr> {
  using B = Pass<Tr>;
  LGIW_FN void operator()(int i) const {
    B::store_stress(this->soil.artificial, i,
                    artificial_stress(B::load_stress(this->soil.stress, i), this->parameters.artificial_stress));
  }
};

template <class Backend, class Tr>
class ParticleSimulation final : public Simulation {
  using T = typename Tr::T;
  using P = typename Tr::P;
  static constexpr int D = Tr::D, S = Tr::S;
  /// Passes read places and velocities in fours (parameters.hh), or places in an array of their own where they are in
  /// another precision.
  static constexpr bool in_fours = !Tr::tiles;
  static constexpr bool two_positions = !in_fours && !std::is_same_v<T, P>;
  template <class U>
  using Array = typename Backend::template Array<U>;
  using Tiles = typename Backend::template Tiles<T, D>;

  /// Where a sort gathers to before the arrays are swapped.
  struct Spare {
    Array<T> t;
    Array<P> p;
    Array<unsigned> id;
    Array<int> number, order;
    template <class U>
    Array<U>& of(const Array<U>&) {
      if constexpr (std::is_same_v<U, T>)
        return t;
      else if constexpr (std::is_same_v<U, P>)
        return p;
      else if constexpr (std::is_same_v<U, int>)
        return number;
      else
        return id;
    }
    template <class F>
    void all(F&& f) {
      f(t, ""), f(p, ""), f(id, ""), f(number, ""), f(order, "");
    }
  };
  struct Water {
    Spare spare;
    Array<P> position[D];
    Array<T> x[D], v[D], a[D], excess, excess_next, density_rate, term, v_previous[D], excess_previous, shift[D];
    Array<Four<T>> place, motion;
    Array<unsigned> id;
    Array<int> key, start;
    Tiles tiles;
    /// Fields that follow the particles through a sort; the others are recomputed before they are read.
    template <class F>
    void carried(F&& f) {
      for (auto& q : position) f(q, "position");
      for (auto& q : v) f(q, "velocity");
      for (auto& q : v_previous) f(q, "previous velocity");
      f(excess, "density"), f(excess_previous, "previous density"), f(term, "pressure"), f(id, "id");
    }
    template <class F>
    void scratch(F&& f) {
      if (two_positions)
        for (auto& q : x) f(q, "rounded position");
      for (auto& q : a) f(q, "acceleration");
      for (auto& q : shift) f(q, "shifting");
      f(excess_next, "next density"), f(density_rate, "density rate"), f(key, "cell"), f(start, "cell starts");
      f(place, "places"), f(motion, "motions");
      tiles.all(f);
    }
  };
  struct Soil {
    Spare spare;
    Array<P> position[D];
    Array<T> x[D], v[D], a[D], stress[S], stress_next[S], adps, image_term, image_excess, artificial[S], v_previous[D],
        stress_previous[S];
    Array<Four<T>> place, motion;
    Array<unsigned> id;
    Array<int> key, start;
    Tiles tiles;
    template <class F>
    void carried(F&& f) {
      for (auto& q : position) f(q, "position");
      for (auto& q : v) f(q, "velocity");
      for (auto& q : v_previous) f(q, "previous velocity");
      for (auto& q : stress) f(q, "stress");
      for (auto& q : stress_previous) f(q, "previous stress");
      for (auto& q : artificial) f(q, "artificial stress");
      f(adps, "Adps"), f(id, "id");
    }
    template <class F>
    void scratch(F&& f) {
      if (two_positions)
        for (auto& q : x) f(q, "rounded position");
      for (auto& q : a) f(q, "acceleration");
      for (auto& q : stress_next) f(q, "next stress");
      f(image_term, "image pressure"), f(image_excess, "image density"), f(key, "cell"), f(start, "cell starts");
      f(place, "places"), f(motion, "motions");
      tiles.all(f);
    }
  };
  struct Wall {
    Array<T> x[D], normal[D], weight, slip, friction, term, excess, v[D], stress[S];
    Array<Four<T>> place;  // instead of x and weight
    Array<unsigned> id;
    Array<int> start;
    Tiles tiles;
    template <class F>
    void all(F&& f) {
      for (auto& q : x) f(q, "position");
      for (auto& q : normal) f(q, "normal");
      f(place, "places"), f(weight, "volume"), f(slip, "slip"), f(friction, "friction"), f(term, "image pressure"),
          f(excess, "image density");
      for (auto& q : v) f(q, "image velocity");
      for (auto& q : stress) f(q, "image stress");
      f(id, "id"), f(start, "cell starts");
      tiles.all(f);
    }
  };
  /// Particles of the bodies that move as prescribed; few, and sorted anew in every step.
  struct Bodies {
    Spare spare;
    Array<T> x[D], v[D], a[D], arm[D], normal[D], own_normal[D], weight, slip, friction, term, excess, image_v[D],
        stress[S];
    Array<int> body;
    Array<unsigned> id;
    Array<int> key, start;
    Tiles tiles;
    Array<MotionRow> rows;
    Array<int> first_row;
    Array<double> pivot, ahead;
    Array<RigidState> now;
    template <class F>
    void carried(F&& f) {
      for (auto& q : x) f(q, "position");
      for (auto& q : v) f(q, "velocity");
      for (auto& q : a) f(q, "acceleration");
      for (auto& q : arm) f(q, "arm");
      for (auto& q : normal) f(q, "normal");
      for (auto& q : own_normal) f(q, "normal at pitch 0");
      f(weight, "volume"), f(slip, "slip"), f(friction, "friction"), f(body, "body"), f(id, "id");
    }
    template <class F>
    void scratch(F&& f) {
      f(term, "image pressure"), f(excess, "image density");
      for (auto& q : image_v) f(q, "image velocity");
      for (auto& q : stress) f(q, "image stress");
      f(key, "cell"), f(start, "cell starts"), f(rows, "motion"), tiles.all(f);
      f(first_row, "first rows"), f(pivot, "pivots"), f(ahead, "directions"), f(now, "places");
    }
  };

 public:
  ParticleSimulation(const ModelParameters& m, const InitialParticles& in, NumberType type, Backend backend = {})
      : backend_(std::move(backend)),
        model_(m),
        type_(type),
        n_water_(int(in.n_water())),
        n_soil_(int(in.n_soil())),
        n_wall_(int(in.n_wall()) - in.n_moving()),
        n_bodies_(in.n_moving()),
        p_(m, n_water_ > 0, n_soil_ > 0) {
    double low[D], high[D];
    for (int k = 0; k < D; ++k) low[k] = p_.low[k], high[k] = p_.high[k];
    for (std::size_t i = 0; i < in.n_wall(); ++i)  // the grid holds the walls, which reach beyond the domain
      for (int k = 0; k < D; ++k) {
        const double x = in.wall_x[3 * i + axis(k)];
        low[k] = std::min(low[k], x), high[k] = std::max(high[k], x);
      }
    grid_ = Backend::template grid<T, D>(low, high, m.h, double(n_water_) + n_soil_ + double(in.n_wall()));
    LGIW_VALIDATE(grid_.cells > 0, "the domain needs more than 2 000 000 000 cells",
                  "cells are as wide as a few particles", "use a coarser particle spacing or a smaller window");
    state_ = Array<StepState>(1);
    limits_ = Array<Limits<T>>(1);
    StepState st;
    backend_.upload(state_, &st);
    if (n_water_) fill_water(in);
    if (n_soil_) fill_soil(in);
    if (n_wall_) fill_wall(in);
    if (n_bodies_) fill_bodies(in), move_bodies(false);
    sort_phases();
    evaluate();
    finish(false);
  }

  StepState advance(double target, int64_t max_steps) override {
    StepState st = state();
    st.target = target;
    backend_.upload(state_, &st);
    int64_t done = 0;
    while (st.time < st.target && done < max_steps && (st.failed_water & st.failed_soil) == UINT32_MAX) {
      // No more than will be needed, for those beyond cost what others do.
      const double left = std::max(1.0, std::ceil((st.target - st.time) / st.dt));
      const int64_t batch = std::min<int64_t>(
          max_steps - done, left < Backend::steps_per_check ? int64_t(left) : Backend::steps_per_check);
      for (int64_t k = 0; k < batch; ++k) step();
      const int64_t before = st.step;
      st = state();
      done += st.step - before;
    }
    return st;
  }
  StepState state() const override {
    StepState st;
    backend_.download(&st, state_);
    return st;
  }

  void limit_time_step(double share) override {
    StepState st = state();
    st.dt *= share / st.share, st.share = share;
    backend_.upload(state_, &st);
  }

  void settle(Settling mode) override {
    StepState st = state();
    StepState fresh;
    fresh.settling = int32_t(mode), fresh.share = st.share;
    fresh.lost_water = st.lost_water, fresh.lost_soil = st.lost_soil;
    backend_.upload(state_, &fresh);
    for (auto& q : water_.v) backend_.zero(q);
    for (auto& q : water_.v_previous) backend_.zero(q);
    for (auto& q : soil_.v) backend_.zero(q);
    for (auto& q : soil_.v_previous) backend_.zero(q);
    if (n_water_ && p_.verlet) copy(water_.excess_previous, water_.excess);
    for (int c = 0; c < S && n_soil_ && p_.verlet; ++c) copy(soil_.stress_previous[c], soil_.stress[c]);
    if (n_bodies_) move_bodies(false), sort_phase(bodies_);
    if (n_water_) set_fours(water_);
    if (n_soil_) set_fours(soil_);
    evaluate();
    finish(false);
  }

  void download(ParticleState& out) const override { begin_download(out)(); }
  std::function<void()> begin_download(ParticleState& out) const override {
    std::function<void()> water = [] {}, soil = [] {};
    if (n_water_) {
      const std::size_t n = std::size_t(n_water_), there = std::size_t(active(water_.start));
      const auto* const id = staged(water_.id, staged_.water_id);
      const auto position = staged_vectors(water_.position, staged_.water_position);
      const auto velocity = staged_vectors(water_.v, staged_.water_v);
      const Fields<T, 1> excess{{staged(water_.excess, staged_.water_excess)}};
      water = [=, &out, density = model_.water_density, sound_speed = model_.sound_speed] {
        bring_by_id(id, n, position.of, out.water_x), bring_by_id(id, n, velocity.of, out.water_v);
        bring_by_id(id, n, excess.of, out.water_excess);
        pressures_at(out.water_excess, density, sound_speed, out.water_pressure);
        lost_by_id(id, n, there, out.water_lost);
      };
    }
    if (n_soil_) {
      const std::size_t n = std::size_t(n_soil_), there = std::size_t(active(soil_.start));
      const auto* const id = staged(soil_.id, staged_.soil_id);
      const auto position = staged_vectors(soil_.position, staged_.soil_position);
      const auto velocity = staged_vectors(soil_.v, staged_.soil_v);
      const Fields<T, 1> adps{{staged(soil_.adps, staged_.soil_adps)}};
      Fields<T, 6> stress;
      for (int c = 0; c < S; ++c) stress.of[stress_axis(c)] = staged(soil_.stress[c], staged_.soil_stress[c]);
      soil = [=, &out] {
        bring_by_id(id, n, position.of, out.soil_x), bring_by_id(id, n, velocity.of, out.soil_v);
        bring_by_id(id, n, adps.of, out.soil_adps), bring_by_id(id, n, stress.of, out.soil_stress);
        lost_by_id(id, n, there, out.soil_lost);
      };
    }
    const auto bring = [water, soil] { water(), soil(); };
    if (!Backend::on_host) return bring;
    bring();  // what is read where it lies changes with the next step
    return [] {};
  }
  void download_walls(std::vector<float>& pressure, std::vector<float>& stress) const override {
    pressure.clear(), stress.clear();
    const std::size_t n = std::size_t(n_wall_) + n_bodies_;
    if (n_water_) pressure.assign(n, 0.f);
    if (n_soil_) stress.assign(6 * n, 0.f);
    const auto collect = [&](const auto& walls, int count) {
      if (!count) return;
      const auto id = readable(walls.id);
      if (n_water_) {
        const auto term = readable(walls.term), excess = readable(walls.excess);
        for (int i = 0; i < count; ++i) {
          const double rho = model_.water_density + double(excess[i]);
          pressure[id[i]] = float(double(term[i]) * rho * rho);
        }
      }
      for (int c = 0; c < S && n_soil_; ++c) {
        const auto values = readable(walls.stress[c]);
        for (int i = 0; i < count; ++i) stress[6 * std::size_t(id[i]) + stress_axis(c)] = float(values[i]);
      }
    };
    collect(wall_, n_wall_), collect(bodies_, n_bodies_);
  }
  void download_bodies(std::vector<double>& x, std::vector<unsigned>& wall_id) const override {
    x.clear(), wall_id.clear();
    if (!n_bodies_) return;
    wall_id = host(bodies_.id);
    x.assign(3 * wall_id.size(), 0.0);
    for (int k = 0; k < D; ++k) {
      const auto values = readable(bodies_.x[k]);
      for (std::size_t i = 0; i < wall_id.size(); ++i) x[3 * i + axis(k)] = double(values[i]);
    }
  }
  void download_accelerations(std::vector<double>& water, std::vector<double>& soil) const override {
    if (n_water_) forces(water, water_, double(p_.water_mass));
    if (n_soil_) forces(soil, soil_, double(p_.soil_mass));
  }
  InternalForces internal_forces() override {
    // What the next step reads is put back: copies cost less than a second pass.
    std::vector<std::vector<T>> kept;
    for (int k = 0; k < D; ++k) kept.push_back(host(water_.a[k])), kept.push_back(host(soil_.a[k]));
    Limits<T> limits;
    backend_.download(&limits, limits_);
    const T absorbing = p_.absorbing_rate;
    p_.absorbing_rate = 0, without_walls_ = true;
    compute_forces<false>();
    InternalForces out;
    std::vector<double> water, soil;
    download_accelerations(water, soil);
    const auto add = [&](const auto& phase, const std::vector<double>& force) {
      const auto id = readable(phase.id);
      for (int i = 0, n = active(phase.start); i < n; ++i) {
        double square = 0;
        for (int k = 0; k < 3; ++k) {
          const double f = force[3 * std::size_t(id[i]) + k];
          out.net[k] += f, square += f * f;
        }
        out.sum += std::sqrt(square);
      }
    };
    if (n_water_) add(water_, water);
    if (n_soil_) add(soil_, soil);
    p_.absorbing_rate = absorbing, without_walls_ = false;
    for (int k = 0; k < D; ++k) {
      if (n_water_) backend_.upload(water_.a[k], kept[2 * std::size_t(k)].data());
      if (n_soil_) backend_.upload(soil_.a[k], kept[2 * std::size_t(k) + 1].data());
    }
    backend_.upload(limits_, &limits);
    return out;
  }

  std::vector<RawArray> save() const override {
    std::vector<RawArray> out;
    auto& self = const_cast<ParticleSimulation&>(*this);
    self.restart_arrays([&](auto& array, const std::string& name) {
      using U = std::remove_pointer_t<decltype(array.data())>;
      RawArray raw{name, std::vector<unsigned char>(array.size() * sizeof(U))};
      backend_.download(reinterpret_cast<U*>(raw.bytes.data()), array);
      out.push_back(std::move(raw));
    });
    return out;
  }
  void restore(const std::vector<RawArray>& arrays) override {
    std::size_t next = 0;
    restart_arrays([&](auto& array, const std::string& name) {
      using U = std::remove_pointer_t<decltype(array.data())>;
      LGIW_VALIDATE(
          next < arrays.size() && arrays[next].name == name && arrays[next].bytes.size() == array.size() * sizeof(U),
          "the checkpoint does not fit this run", "array '" + name + "' is missing or has another size",
          "resume with the case, particles and precision that wrote it");
      backend_.upload(array, reinterpret_cast<const U*>(arrays[next].bytes.data()));
      ++next;
    });
    if (n_water_) follow_order(water_);
    if (n_soil_) follow_order(soil_);
    if (n_bodies_) follow_order(bodies_);
  }

  std::vector<PhaseTime> timings() const override {
    std::vector<PhaseTime> out;
    for (const auto& [name, seconds] : times_) out.push_back({name, seconds});
    std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.seconds > b.seconds; });
    return out;
  }
  PhaseBytes bytes() const override {
    PhaseBytes sum;
    const auto to = [](int64_t& total) {
      return [&total](const auto& q, const char*) { total += int64_t(q.size() * sizeof(*q.data())); };
    };
    const auto of = [&](auto& phase, int64_t& total) {
      phase.carried(to(total)), phase.scratch(to(total)), phase.spare.all(to(total));
    };
    auto& self = const_cast<ParticleSimulation&>(*this);
    of(self.water_, sum.water), of(self.soil_, sum.soil), of(self.bodies_, sum.wall);
    self.wall_.all(to(sum.wall));
    sum.shared = int64_t(backend_.bytes());
    return sum;
  }
  std::string device() const override { return backend_.name(); }
  bool leaves_host_free() const override { return !Backend::on_host; }
  std::string description() const override {
    const char* number = type_ == NumberType::single_ ? "single" : (type_ == NumberType::mixed ? "mixed" : "double");
    const std::string instructions = backend_.instructions();
    return backend_.name() + (instructions.empty() ? "" : ", " + instructions) + ", " + number + " precision, " +
           std::to_string(D) + "-D, " + (model_.cubic_kernel ? "cubic spline" : "Wendland C2");
  }
  std::vector<std::string> left_out() const override;

 private:
  static int axis(int k) { return D == 2 && k == 1 ? 2 : k; }
  static int stress_axis(int c) {  // our component -> xx yy zz xy yz xz; 2-D: xx zz xz and yy out of plane
    constexpr int plane[4] = {0, 2, 5, 1};
    return D == 2 ? plane[c] : c;
  }

  void fill_water(const InitialParticles& in) {
    const std::size_t n = n_water_;
    std::vector<P> position(n);
    for (int k = 0; k < D; ++k) {
      for (std::size_t i = 0; i < n; ++i) position[i] = P(in.water_x[3 * i + axis(k)]);
      put(water_.position[k], position);
      if (two_positions) water_.x[k] = Array<T>(n);
      const std::vector<T> v = component(in.water_v, n, k);
      put(water_.v[k], v);
      if (p_.verlet) put(water_.v_previous[k], v);
      water_.a[k] = zeros<T>(n);
      if (p_.shifting.strength > 0) water_.shift[k] = zeros<T>(n);
    }
    make_fours(water_, n);
    std::vector<T> excess(in.water_excess.begin(), in.water_excess.end());
    put(water_.excess, excess);
    if (p_.verlet) put(water_.excess_previous, excess);
    (p_.verlet ? water_.density_rate : water_.excess_next) = zeros<T>(n), water_.term = zeros<T>(n);
    put(water_.id, ids(n));
    water_.key = zeros<int>(n), water_.start = zeros<int>(grid_.cells + 1);
    SetTerms<Tr> terms;
    fill(terms);
    backend_.for_each(n_water_, terms);
    set_keys(pass<SetKeys<Tr, WaterView<Tr>>>(), water_view(), n_water_);
  }
  void fill_soil(const InitialParticles& in) {
    const std::size_t n = n_soil_;
    std::vector<P> position(n);
    for (int k = 0; k < D; ++k) {
      for (std::size_t i = 0; i < n; ++i) position[i] = P(in.soil_x[3 * i + axis(k)]);
      put(soil_.position[k], position);
      if (two_positions) soil_.x[k] = Array<T>(n);
      const std::vector<T> v = component(in.soil_v, n, k);
      put(soil_.v[k], v);
      if (p_.verlet) put(soil_.v_previous[k], v);
      soil_.a[k] = zeros<T>(n);
    }
    make_fours(soil_, n);
    std::vector<T> stress(n);
    for (int c = 0; c < S; ++c) {
      for (std::size_t i = 0; i < n; ++i) stress[i] = T(in.soil_stress[6 * i + stress_axis(c)]);
      put(soil_.stress[c], stress);
      if (p_.verlet) put(soil_.stress_previous[c], stress);
      soil_.stress_next[c] = zeros<T>(n);
      if (p_.artificial_stress > 0) soil_.artificial[c] = zeros<T>(n);
    }
    soil_.adps = zeros<T>(n);
    if (n_water_) soil_.image_term = zeros<T>(n), soil_.image_excess = zeros<T>(n);
    put(soil_.id, ids(n));
    soil_.key = zeros<int>(n), soil_.start = zeros<int>(grid_.cells + 1);
    if (p_.artificial_stress > 0) {
      SetArtificialStress<Tr> set;
      fill(set);
      backend_.for_each(n_soil_, set);
    }
    set_keys(pass<SetKeys<Tr, SoilView<Tr>>>(), soil_view(), n_soil_);
  }
  /// Indices in the particles file of the wall particles that stand still, or that move.
  static std::vector<unsigned> wall_ids(const InitialParticles& in, bool moving) {
    std::vector<unsigned> out;
    for (std::size_t i = 0; i < in.n_wall(); ++i)
      if ((!in.wall_body.empty() && in.wall_body[i] > 0) == moving) out.push_back(unsigned(i));
    return out;
  }
  /// Soil needs the normals of walls; water does where it slips along them.
  bool needs_normals() const { return n_soil_ || (n_water_ && p_.water_slips); }
  /// What walls and bodies have in common, in the order of `id`.
  template <class Walls>
  void fill_common(const InitialParticles& in, const std::vector<unsigned>& id, Walls& walls, Array<T>* image_v) {
    const std::size_t n = id.size();
    std::vector<T> value(n);
    const auto x = [&](std::size_t i, int k) { return T(in.wall_x[3 * std::size_t(id[i]) + axis(k)]); };
    const auto weight = [&](std::size_t i) { return T(in.wall_volume[id[i]] / double(p_.volume)); };
    if constexpr (in_fours && std::is_same_v<Walls, Wall>) {
      std::vector<Four<T>> place(n + fours_to_spare, Four<T>{});
      for (std::size_t i = 0; i < n; ++i) {
        for (int k = 0; k < D; ++k) place[i].c[k] = x(i, k);
        place[i].c[D] = weight(i);
      }
      put(walls.place, place);
    } else {
      for (int k = 0; k < D; ++k) {
        for (std::size_t i = 0; i < n; ++i) value[i] = x(i, k);
        put(walls.x[k], value);
      }
      for (std::size_t i = 0; i < n; ++i) value[i] = weight(i);
      put(walls.weight, value);
    }
    put(walls.id, id);
    if (n_water_) walls.term = zeros<T>(n), walls.excess = zeros<T>(n);
    for (int k = 0; k < D && needs_normals(); ++k) {
      for (std::size_t i = 0; i < n; ++i) value[i] = T(in.wall_normal[3 * std::size_t(id[i]) + axis(k)]);
      put(walls.normal[k], value);
    }
    if (n_soil_) {
      const auto at_side = [&](std::size_t i) { return in.wall_kind[id[i]] == 1; };
      const auto rubs = [&](std::size_t i) { return at_side(i) ? model_.coulomb_sides : model_.coulomb_bed; };
      for (std::size_t i = 0; i < n; ++i)
        value[i] = rubs(i) || (at_side(i) ? model_.free_slip_sides : model_.free_slip_bed) ? T(1) : T(0);
      put(walls.slip, value);
      for (std::size_t i = 0; i < n; ++i) value[i] = T(rubs(i) ? model_.bed_friction : 0);
      if (p_.coulomb_walls) put(walls.friction, value);
      for (int k = 0; k < D; ++k) image_v[k] = zeros<T>(n);
      for (auto& q : walls.stress) q = zeros<T>(n);
    }
  }
  void fill_wall(const InitialParticles& in) {
    // These never move: they are sorted here, once, on the host.
    std::vector<unsigned> id = wall_ids(in, false);
    std::vector<int> key(in.n_wall());
    for (unsigned i : id) {
      Vec<T, D> x;
      for (int k = 0; k < D; ++k) x.c[k] = T(in.wall_x[3 * std::size_t(i) + axis(k)]);
      key[i] = grid_.cell(x);
    }
    std::stable_sort(id.begin(), id.end(), [&](unsigned a, unsigned b) { return key[a] < key[b]; });
    std::vector<int> start(grid_.cells + 1, 0);
    for (unsigned i : id) ++start[key[i] + 1];
    for (int c = 0; c < grid_.cells; ++c) start[c + 1] += start[c];
    put(wall_.start, start);
    fill_common(in, id, wall_, wall_.v);
    find_tiles(wall_, wall_.x);
  }
  template <class Phase>
  void make_fours(Phase& phase, std::size_t n) {
    if constexpr (in_fours)
      phase.place = zeros<Four<T>>(n + fours_to_spare), phase.motion = zeros<Four<T>>(n + fours_to_spare);
  }
  /// After a sort and whenever what is in them has changed.
  void set_fours(Water& water) {
    if constexpr (in_fours) {
      auto set = pass<SetFours<Tr, WaterView<Tr>>>();
      set.view = water_view(), set.with_place = water.term.data(), set.with_velocity = water.excess.data();
      backend_.for_each(n_water_, set);
    }
  }
  void set_fours(Soil& soil) {
    if constexpr (in_fours) {
      auto set = pass<SetFours<Tr, SoilView<Tr>>>();
      set.view = soil_view(), set.with_place = soil.image_term.data(), set.with_velocity = soil.image_excess.data();
      backend_.for_each(n_soil_, set);
    }
  }
  void set_fours(Bodies&) {}
  /// Before any pass looks for or at a phase whose particles are at x.
  template <class Phase, class U>
  void find_tiles([[maybe_unused]] Phase& phase, [[maybe_unused]] const Array<U>* x) {
    if constexpr (Tr::tiles) {
      const T* places[D];
      for (int k = 0; k < D; ++k) places[k] = x[k].data();
      backend_.find_tiles(grid_, p_.h, places, phase.start, phase.tiles);
    }
  }
  template <class Phase>
  void find_tiles(Phase& phase) {
    if constexpr (two_positions || std::is_same_v<Phase, Bodies>)
      find_tiles(phase, phase.x);
    else
      find_tiles(phase, phase.position);
  }
  void fill_bodies(const InitialParticles& in) {
    const std::vector<unsigned> id = wall_ids(in, true);
    const std::size_t n = id.size(), bodies = model_.bodies.size();
    fill_common(in, id, bodies_, bodies_.image_v);
    std::vector<int> body(n), first{0};
    std::vector<MotionRow> rows;
    std::vector<double> pivot, ahead;
    for (const PrescribedMotion& motion : model_.bodies) {
      rows.insert(rows.end(), motion.rows.begin(), motion.rows.end());
      first.push_back(int(rows.size()));
      pivot.insert(pivot.end(), motion.pivot.begin(), motion.pivot.end());
      ahead.insert(ahead.end(), motion.ahead.begin(), motion.ahead.end());
    }
    for (std::size_t i = 0; i < n; ++i) body[i] = in.wall_body[id[i]] - 1;
    std::vector<T> value(n);
    for (int k = 0; k < D; ++k) {
      for (std::size_t i = 0; i < n; ++i)
        value[i] = T(in.wall_x[3 * std::size_t(id[i]) + axis(k)] - model_.bodies[body[i]].pivot[axis(k)]);
      put(bodies_.arm[k], value);
      bodies_.v[k] = zeros<T>(n), bodies_.a[k] = zeros<T>(n);
      if (needs_normals()) put(bodies_.own_normal[k], host(bodies_.normal[k]));
    }
    put(bodies_.body, body), put(bodies_.rows, rows), put(bodies_.first_row, first);
    put(bodies_.pivot, pivot), put(bodies_.ahead, ahead);
    bodies_.now = Array<RigidState>(2 * bodies);
    bodies_.key = zeros<int>(n), bodies_.start = zeros<int>(grid_.cells + 1);
  }
  /// Bodies to the end of the step, or (`on` false) to the time of the state.
  void move_bodies(bool on) {
    auto states = pass<BodyStates<Tr>>();
    states.rows = bodies_.rows.data(), states.first = bodies_.first_row.data();
    states.pivots = bodies_.pivot.data(), states.now = bodies_.now.data();
    states.n_bodies = int(model_.bodies.size()), states.moving_on = on;
    backend_.single(states);
    auto motion = pass<BodyMotion<Tr>>();
    motion.now = bodies_.now.data(), motion.ahead = bodies_.ahead.data(), motion.moving_on = on;
    backend_.for_each(n_bodies_, motion);
  }

  // One step. Leapfrog moves first and takes the rates at the new place; Verlet takes all rates where the forces are,
  // those of the water together with them, a step before they are used.
  void step() {
    stepping_ = true;
    if (p_.verlet) {
      rates();
      motion();
    } else {
      motion();
      rates();
    }
    evaluate();
    finish(true);
    stepping_ = false;
  }
  void motion() {
    if (n_water_)
      timed("motion", [&] {
        Motion<Tr, true> f;
        fill(f);
        f.lost = &state_.data()->lost_water, f.failed = &state_.data()->failed_water;
        backend_.for_each(n_water_, f);
      });
    if (n_soil_)
      timed("motion", [&] {
        Motion<Tr, false> f;
        fill(f);
        f.lost = &state_.data()->lost_soil, f.failed = &state_.data()->failed_soil;
        backend_.for_each(n_soil_, f);
      });
    if (n_bodies_) timed("motion", [&] { move_bodies(true); });
    timed("sort", [&] { sort_phases(); });
  }
  void rates() {
    if (n_soil_ && n_wall_) run<WallVelocities<Tr, false>>("images", wall_view());
    if (n_soil_ && n_bodies_) run<WallVelocities<Tr, true>>("images", body_view());
    if (n_water_)
      timed("water rates", [&] {
        if (p_.verlet) {
          backend_.for_each(n_water_, failing<WaterDensity<Tr>>());
        } else {
          pairs<WaterPairRates<Tr>>(water_view());
          backend_.for_each_near(water_view(), failing<WaterRates<Tr>>());
          water_.excess.swap(water_.excess_next);
          set_fours(water_);
        }
      });
    if (n_soil_) {
      run<SoilRates<Tr>>("soil rates", soil_view());
      for (int c = 0; c < S; ++c) soil_.stress[c].swap(soil_.stress_next[c]);
    }
  }
  /// Images and forces for the present positions, velocities, densities and stresses.
  void evaluate() {
    if (n_wall_ && (n_water_ || n_soil_)) run<WallImages<Tr, false>>("images", wall_view());
    if (n_bodies_ && (n_water_ || n_soil_)) run<WallImages<Tr, true>>("images", body_view());
    if (n_soil_ && n_water_) {
      run<SoilImages<Tr>>("images", soil_view());
      timed("images", [&] { set_fours(soil_); });
    }
    if (n_water_ && p_.shifting.strength > 0) run<WaterShift<Tr>>("shifting", water_view());
    if (p_.verlet)
      compute_forces<true>();
    else
      compute_forces<false>();
  }
  template <bool rates>
  void compute_forces() {
    backend_.single(ResetLimits<T>{limits_.data()});
    if (n_water_) {
      timed("water forces", [&] { pairs<WaterPairForces<Tr, rates>>(water_view()); });
      run_limits<WaterForces<Tr, rates>>("water forces", water_view());
    }
    if (n_soil_) {
      timed("soil forces", [&] { pairs<SoilPairForces<Tr>>(soil_view()); });
      if (p_.coulomb_walls)
        run_limits<SoilForces<Tr, true>>("soil forces", soil_view());
      else
        run_limits<SoilForces<Tr, false>>("soil forces", soil_view());
    }
  }
  void finish(bool advance) { backend_.single(FinishStep<Tr>{p_, limits_.data(), state_.data(), advance}); }

  void sort_phases() {
    if (n_water_) sort_phase(water_);
    if (n_soil_) sort_phase(soil_);
    if (n_bodies_) sort_phase(bodies_);
  }
  /// What is made of the particles in their sorted order before any pass reads them.
  template <class Phase>
  void follow_order(Phase& phase) {
    backend_.rearrange(phase.key.size(), nullptr, rounding(phase));
    finish_order(phase);
  }
  template <class Phase>
  void finish_order(Phase& phase) {
    set_fours(phase);
    find_tiles(phase);
  }
  /// Positions as the passes read them.
  template <class Phase>
  std::vector<Rearrangement> rounding(const Phase& phase) {
    std::vector<Rearrangement> moves;
    if constexpr (two_positions && !std::is_same_v<Phase, Bodies>)
      for (int k = 0; k < D; ++k) moves.push_back(Rearrangement::rounded(phase.x[k].data(), phase.position[k].data()));
    return moves;
  }
  template <class Phase>
  void sort_phase(Phase& phase) {
    if constexpr (in_fours && !std::is_same_v<Phase, Bodies>)
      sort_within_fours(phase);
    else
      sort_by_swapping(phase);
    finish_order(phase);
  }
  /// Each field is gathered to where the one before it was.
  template <class Phase>
  void sort_by_swapping(Phase& phase) {
    Spare& spare = phase.spare;
    const auto sized = [n = phase.key.size()](auto& q) -> auto& {
      if (q.size() != n) q = std::remove_reference_t<decltype(q)>(n);
      return q;
    };
    // Before a field has been gathered, what it goes to is free.
    int* const order = sized(spare.order).data();
    static_assert(sizeof(T) >= sizeof(int));
    backend_.sort_by_cell(phase.key, grid_.cells, order, phase.start, reinterpret_cast<int*>(sized(spare.t).data()),
                          reinterpret_cast<int*>(sized(spare.id).data()));
    std::vector<Rearrangement> moves;
    phase.carried([&](auto& q, const char*) {
      if (!q.size()) return;
      auto& to = sized(spare.of(q));
      moves.push_back(Rearrangement::gathered(to.data(), q.data()));
      q.swap(to);
    });
    for (const Rearrangement& rounded : rounding(phase)) moves.push_back(rounded);
    backend_.rearrange(phase.key.size(), order, moves);
  }
  /// Fields are gathered into the memory of the fours, which are made anew afterwards, and copied back: no memory is
  /// needed besides.
  template <class Phase>
  void sort_within_fours(Phase& phase) {
    const std::size_t n = phase.key.size(), room = n * sizeof(Four<T>);
    unsigned char* const memory[2] = {reinterpret_cast<unsigned char*>(phase.place.data()),
                                      reinterpret_cast<unsigned char*>(phase.motion.data())};
    int* const order = reinterpret_cast<int*>(memory[1] + room - n * sizeof(int));
    const std::size_t ends[2] = {room, room - n * sizeof(int)};
    backend_.sort_by_cell(phase.key, grid_.cells, order, phase.start, reinterpret_cast<int*>(memory[0]),
                          reinterpret_cast<int*>(memory[0] + n * sizeof(int)));
    std::vector<Rearrangement> there, back;
    std::size_t used[2] = {0, 0};
    const auto carry_out = [&] {
      there.insert(there.end(), back.begin(), back.end());
      backend_.rearrange(n, order, there);
      there.clear(), back.clear();
      used[0] = used[1] = 0;
    };
    phase.carried([&](auto& q, const char*) {
      if (!q.size()) return;
      using U = std::remove_pointer_t<decltype(q.data())>;
      const std::size_t bytes = n * sizeof(U);
      const auto start_in = [&](int m) { return (used[m] + sizeof(U) - 1) / sizeof(U) * sizeof(U); };
      const auto fits = [&](int m) { return start_in(m) + bytes <= ends[m]; };
      if (!fits(0) && !fits(1)) carry_out();
      const int m = fits(0) ? 0 : 1;
      U* const to = reinterpret_cast<U*>(memory[m] + start_in(m));
      used[m] = start_in(m) + bytes;
      there.push_back(Rearrangement::gathered(to, q.data()));
      back.push_back(Rearrangement::copied(q.data(), to));
    });
    carry_out();
  }

  // Plumbing.
  template <class U>
  Array<U> zeros(std::size_t n) {
    Array<U> a(n);
    backend_.zero(a);
    return a;
  }
  template <class U>
  void put(Array<U>& to, const std::vector<U>& from) {
    to = Array<U>(from.size());
    backend_.upload(to, from.data());
  }
  template <class U>
  void copy(Array<U>& to, const Array<U>& from) {
    std::vector<U> values = host(from);
    backend_.upload(to, values.data());
  }
  template <class U>
  std::vector<U> host(const Array<U>& from) const {
    std::vector<U> values(from.size());
    backend_.download(values.data(), from);
    return values;
  }
  /// The values of an array, until it changes: a copy only where the host cannot read it as it is.
  template <class U>
  class Readable {
   public:
    Readable(const Backend& backend, const Array<U>& from) : values_(from.data()), size_(from.size()) {
      if constexpr (!Backend::on_host) {
        copy_.resize(size_);
        backend.download(copy_.data(), from);
        values_ = copy_.data();
      }
    }
    Readable(const Readable&) = delete;
    Readable& operator=(const Readable&) = delete;
    const U& operator[](std::size_t i) const { return values_[i]; }
    std::size_t size() const { return size_; }

   private:
    std::vector<U> copy_;
    const U* values_;
    std::size_t size_;
  };
  template <class U>
  Readable<U> readable(const Array<U>& from) const {
    return Readable<U>(backend_, from);
  }
  /// How many particles are still there.
  int active(const Array<int>& start) const {
    int n;
    backend_.download(&n, start, std::size_t(grid_.cells), 1);
    return n;
  }
  /// Component k of interleaved vectors; zeros where there are none.
  static std::vector<T> component(const std::vector<float>& values, std::size_t n, int k) {
    std::vector<T> out(n, T(0));
    if (!values.empty())
      for (std::size_t i = 0; i < n; ++i) out[i] = T(values[3 * i + axis(k)]);
    return out;
  }
  static std::vector<unsigned> ids(std::size_t n) {
    std::vector<unsigned> id(n);
    for (std::size_t i = 0; i < n; ++i) id[i] = unsigned(i);
    return id;
  }
  template <class Keys, class View>
  void set_keys(Keys keys, const View& view, int n) {
    keys.view = view;
    backend_.for_each(n, keys);
  }
  template <class F>
  F pass() {
    F f;
    fill(f);
    return f;
  }
  /// A pass over water that may find a failed state.
  template <class F>
  F failing() {
    F f = pass<F>();
    f.failed = &state_.data()->failed_water;
    return f;
  }
  /// A pass over neighbours, for all particles of `own`.
  template <class F, class View>
  void run(const char* phase, const View& own) {
    timed(phase, [&] { backend_.for_each_near(own, pass<F>()); });
  }
  template <class F, class View>
  void run_limits(const char* phase, const View& own) {
    timed(phase, [&] { backend_.template for_each_near_limits<T>(own, pass<F>(), limits_.data()); });
  }
  /// The sums of a pass over the pairs of one phase, where each is computed once.
  template <class F, class View>
  void pairs([[maybe_unused]] const View& own) {
    if constexpr (Tr::pairs_once) backend_.template for_each_pair<T>(own, pass<F>(), limits_.data());
  }
  template <class F>
  void timed(const char* phase, F&& f) {
    const double start = backend_.now();
    f();
    times_[phase] += backend_.now() - start;
  }

  void fill(Pass<Tr>& f) {
    f.grid = grid_;
    f.parameters = p_;
    f.water = water_view();
    f.soil = soil_view();
    f.wall = wall_view();
    f.bodies = body_view();
    f.state = state_.data();
    f.stepping = stepping_;
  }
  static OfFours<T> component_of(const Array<Four<T>>& fours, int k) { return {fours.data()->c + k}; }
  WaterView<Tr> water_view() const {
    WaterView<Tr> w;
    w.n = n_water_;
    if (!w.n) return w;
    for (int k = 0; k < D; ++k) {
      w.position[k] = water_.position[k].data();
      if constexpr (in_fours)
        w.x[k] = component_of(water_.place, k);
      else if constexpr (two_positions)
        w.x[k] = water_.x[k].data();
      else
        w.x[k] = water_.position[k].data();
      w.shift[k] = water_.shift[k].data();
      w.v[k] = water_.v[k].data(), w.a[k] = water_.a[k].data(), w.v_previous[k] = water_.v_previous[k].data();
    }
    w.place = water_.place.data(), w.motion = water_.motion.data();
    w.start = water_.start.data(), w.cells_near = water_.tiles.cells_near(), w.tiles = water_.tiles.table(),
    w.excess = water_.excess.data(), w.excess_next = water_.excess_next.data(),
    w.density_rate = water_.density_rate.data();
    w.term = water_.term.data(), w.id = water_.id.data(), w.key = water_.key.data();
    w.excess_previous = water_.excess_previous.data();
    return w;
  }
  SoilView<Tr> soil_view() const {
    SoilView<Tr> s;
    s.n = n_soil_;
    if (!s.n) return s;
    for (int k = 0; k < D; ++k) {
      s.position[k] = soil_.position[k].data();
      if constexpr (in_fours)
        s.x[k] = component_of(soil_.place, k);
      else if constexpr (two_positions)
        s.x[k] = soil_.x[k].data();
      else
        s.x[k] = soil_.position[k].data();
      s.v[k] = soil_.v[k].data(), s.a[k] = soil_.a[k].data(), s.v_previous[k] = soil_.v_previous[k].data();
    }
    for (int c = 0; c < S; ++c) {
      s.stress[c] = soil_.stress[c].data(), s.stress_next[c] = soil_.stress_next[c].data();
      s.artificial[c] = soil_.artificial[c].data(), s.stress_previous[c] = soil_.stress_previous[c].data();
    }
    s.place = soil_.place.data(), s.motion = soil_.motion.data();
    s.start = soil_.start.data(), s.cells_near = soil_.tiles.cells_near(), s.tiles = soil_.tiles.table(),
    s.adps = soil_.adps.data(), s.id = soil_.id.data(), s.key = soil_.key.data();
    s.image_term = soil_.image_term.data(), s.image_excess = soil_.image_excess.data();
    return s;
  }
  WallView<Tr> wall_view() const {
    WallView<Tr> b;
    b.n = without_walls_ ? 0 : n_wall_;
    if (!b.n) return b;
    for (int k = 0; k < D; ++k) {
      if constexpr (in_fours)
        b.x[k] = component_of(wall_.place, k);
      else
        b.x[k] = wall_.x[k].data();
      b.normal[k] = wall_.normal[k].data(), b.v[k] = wall_.v[k].data();
    }
    b.place = wall_.place.data();
    for (int c = 0; c < S; ++c) b.stress[c] = wall_.stress[c].data();
    b.start = wall_.start.data(), b.cells_near = wall_.tiles.cells_near(), b.tiles = wall_.tiles.table();
    b.weight = wall_.weight.data(), b.slip = wall_.slip.data();
    b.friction = wall_.friction.data();
    b.term = wall_.term.data(), b.excess = wall_.excess.data(), b.id = wall_.id.data();
    return b;
  }

  BodyView<Tr> body_view() const {
    BodyView<Tr> b;
    b.n = without_walls_ ? 0 : n_bodies_;
    if (!b.n) return b;
    const Bodies& m = bodies_;
    for (int k = 0; k < D; ++k) {
      b.x[k] = b.place[k] = m.x[k].data(), b.normal[k] = b.direction[k] = m.normal[k].data();
      b.v[k] = m.image_v[k].data(), b.own_v[k] = m.v[k].data(), b.own_a[k] = m.a[k].data();
      b.arm[k] = m.arm[k].data(), b.own_normal[k] = m.own_normal[k].data();
    }
    for (int c = 0; c < S; ++c) b.stress[c] = m.stress[c].data();
    b.start = m.start.data(), b.cells_near = m.tiles.cells_near(), b.tiles = m.tiles.table(),
    b.weight = m.weight.data(), b.slip = m.slip.data();
    b.friction = m.friction.data();
    b.term = m.term.data(), b.excess = m.excess.data(), b.id = m.id.data();
    b.body = m.body.data(), b.key = m.key.data();
    return b;
  }

  // Into the order of the particles file.
  template <class U, std::size_t width>
  struct Fields {
    const U* of[width] = {};
  };
  template <class U>
  using OnHost = typename Backend::template HostArray<U>;
  /// Of a device: copies of the fields that begin_download() is to bring into order, kept for the next time.
  struct Staged {
    OnHost<unsigned> water_id, soil_id;
    OnHost<P> water_position[D], soil_position[D];
    OnHost<T> water_v[D], soil_v[D], water_excess, soil_adps, soil_stress[S];
  };
  /// Values that the host can read: until the next step, or on a device until they are staged again.
  template <class U>
  const U* staged(const Array<U>& from, OnHost<U>& copy) const {
    if constexpr (Backend::on_host) {
      return from.data();
    } else {
      if (copy.size() != from.size()) copy = OnHost<U>(from.size());
      backend_.download(copy.data(), from);
      return copy.data();
    }
  }
  template <class U>
  Fields<U, 3> staged_vectors(const Array<U> (&from)[D], OnHost<U> (&copy)[D]) const {
    Fields<U, 3> fields;
    for (int k = 0; k < D; ++k) fields.of[axis(k)] = staged(from[k], copy[k]);
    return fields;
  }
  template <class Phase>
  void forces(std::vector<double>& out, const Phase& phase, double mass) const {
    const auto id = readable(phase.id);
    std::vector<std::unique_ptr<Readable<T>>> a;
    out.assign(3 * id.size(), 0.0);
    for (int k = 0; k < D; ++k) a.push_back(std::make_unique<Readable<T>>(backend_, phase.a[k]));
    for (std::size_t i = 0, there = active(phase.start); i < there; ++i)  // no pass touches what is lost
      for (int k = 0; k < D; ++k)
        out[3 * std::size_t(id[i]) + axis(k)] = mass * (double((*a[k])[i]) - double(p_.gravity.c[k]));
  }

  /// Everything that a step reads from the one before, in the sorted order, so that a resumed run repeats the same
  /// sums.
  template <class F>
  void restart_arrays(F&& f) {
    f(state_, "state");
    water_.carried([&](auto& q, const char* name) {
      if (q.size()) f(q, std::string("water ") + name);
    });
    for (auto& q : water_.a)
      if (q.size()) f(q, "water acceleration");
    for (auto& q : water_.shift)
      if (q.size()) f(q, "water shifting");
    if (n_water_ && p_.verlet) f(water_.density_rate, "water density rate");
    if (n_water_) f(water_.start, "water cell starts");
    soil_.carried([&](auto& q, const char* name) {
      if (q.size()) f(q, std::string("soil ") + name);
    });
    for (auto& q : soil_.a)
      if (q.size()) f(q, "soil acceleration");
    if (n_soil_) f(soil_.start, "soil cell starts");
    bodies_.carried([&](auto& q, const char* name) {
      if (q.size()) f(q, std::string("body ") + name);
    });
    if (n_bodies_) f(bodies_.start, "body cell starts");
  }

  static constexpr std::size_t fours_to_spare = 4;  // passes look at four of them at a stroke, beyond the last, too

  mutable Backend backend_;
  mutable Staged staged_;
  ModelParameters model_;
  NumberType type_;
  int n_water_, n_soil_, n_wall_, n_bodies_;  // n_wall_: those that stand still; n_bodies_: those that move
  bool without_walls_ = false;                // while internal_forces() looks
  bool stepping_ = false;                     // within step()
  Parameters<Tr> p_;
  Grid<T, D> grid_;
  Water water_;
  Soil soil_;
  Wall wall_;
  Bodies bodies_;
  Array<StepState> state_;
  Array<Limits<T>> limits_;
  std::map<std::string, double> times_;
};

template <class Backend, class Tr>
std::vector<std::string> ParticleSimulation<Backend, Tr>::left_out() const {
  std::vector<std::string> out;
  auto mebibytes = [](double bytes) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f MiB", bytes / (1 << 20));
    return std::string(text);
  };
  const double t = sizeof(T), soil = n_soil_, water = n_water_, wall = n_wall_;
  // A code with one set of arrays for all particles would hold the soil's fields for every water and wall particle.
  const double soil_fields = (3 * S + 1) * t;
  if (!n_soil_)
    out.push_back("soil (stress, Adps, soil and interface kernels): " + mebibytes((water + wall) * soil_fields));
  if (!n_water_)
    out.push_back("water (density, pressure, water and interface kernels): " + mebibytes((soil + wall) * 3 * t));
  if (n_soil_ && n_water_) out.push_back("stress and Adps of water particles: " + mebibytes(water * soil_fields));
  if (D == 2)
    out.push_back("the y direction (velocity, acceleration, two shear stresses): " +
                  mebibytes(((water + soil) * 3 + soil * 4) * t));
  if (n_water_ && !p_.density_diffusion) out.push_back("density diffusion: its part of the pair loop");
  if (n_water_ && !(p_.shifting.strength > 0))
    out.push_back("particle shifting: its pass and " + mebibytes(water * D * t));
  if (n_soil_ && !(p_.stress_diffusion > 0)) out.push_back("stress diffusion: its part of the pair loop");
  if (n_soil_ && !(p_.artificial_stress > 0)) out.push_back("artificial stress: " + mebibytes(soil * S * t));
  if (!p_.verlet)
    out.push_back("previous step's fields (Verlet): " + mebibytes((water * (D + 1) + soil * (D + S)) * t));
  if (n_soil_ && n_water_ && !(p_.interface.repulsion.strength > 0))
    out.push_back("interface repulsion: its part of the pair loop");
  if (n_soil_ && !p_.coulomb_walls) out.push_back("Coulomb friction at walls");
  if (!n_wall_) out.push_back("walls");
  if (!n_bodies_) out.push_back("moving bodies");
  return out;
}

}  // namespace lgiw
