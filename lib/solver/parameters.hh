// The model's constants in the number type of the kernels, and views of the fields that the passes read and write.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include "physics/gradient_correction.hh"
#include "physics/interface.hh"
#include "physics/kernel.hh"
#include "physics/soil.hh"
#include "physics/time_step.hh"
#include "physics/water.hh"
#include "solver/copy_near.hh"
#include "solver/grid.hh"
#include "solver/machine.hh"
#include "solver/setup.hh"

namespace lgiw {

/// Chosen at compile time: P number type of positions in time, T of everything else, D the dimension, K the kernel, and
/// for which machine.
template <class P_, class T_, int D_, template <class, int> class K_, class Machine_>
struct Traits {
  using P = P_;
  using T = T_;
  static constexpr int D = D_;
  static constexpr int S = StressSize<D_>::value;
  using Machine = Machine_;
  static constexpr bool tiles = Machine::tiles;
  /// Passes over the pairs of a phase compute each pair once, for both sides (tiles.hh).
  static constexpr bool pairs_once = tiles && D_ == 3;
  using Kernel = K_<T_, D_>;
};

template <class Tr>
struct Parameters {
  using T = typename Tr::T;
  static constexpr int D = Tr::D;
  typename Tr::Kernel kernel;
  T dp, h, volume;  // volume = dp^D
  Vec<T, D> gravity;
  // Water.
  EquationOfState<T> eos;
  WaterContinuity<T, D> continuity;
  ArtificialViscosity<T, D> water_viscosity;
  bool water_slips;  // along walls: they resist only water that comes at them
  T water_mass;
  bool density_diffusion;
  ParticleShifting<T, D> shifting;
  // Soil.
  SoilMaterial<T> soil;
  RateStrength<T> soil_rate;
  ArtificialViscosity<T, D> soil_viscosity;
  T soil_density, soil_mass, stress_diffusion;  // 2 delta h c_s, 0: left out
  Stress<T, D> static_stress_dry,
      static_stress_wet;                           // -d(stress)/d(g.x): rho_s kappa, above and below still water level
  T pore_gradient, pore_share, still_water_level;  // share of the pore water in the growth of stress with depth
  T artificial_stress, inverse_w_dp;               // epsilon / rho_s^2, 1 / W(dp)
  bool return_mapping, wall_viscosity, coulomb_walls, corrected_strain_rate;
  // Interface.
  InterfacePair<T> interface;
  T velocity_factor, mass_ratio;  // xi, m_w / m_s
  bool image_gravity;
  // Domain.
  double low[D], high[D];
  double side_at[4], side_top[4];  // z up to which there is a wall
  int absorbing[4];
  double absorbing_width;
  T absorbing_rate, settle_rate, soil_settle_rate;
  T speed_limit;  // faster than this is a failed state
  // Time step.
  double cfl, fastest_wave, slowest_viscous;  // c, h / (alpha c) limit
  double diffusive_step, viscous_step;        // s: limits of stability whatever the CFL number
  bool verlet;

  Parameters() = default;
  Parameters(const ModelParameters& p, bool water, bool with_soil)
      : kernel(p.h), dp(T(p.dp)), h(T(p.h)), volume(T(std::pow(p.dp, D))), eos(p.water_density, p.sound_speed) {
    const double axis_gravity[3] = {p.gravity[0], p.gravity[1], p.gravity[2]};
    double g[D], g2 = 0;
    for (int k = 0; k < D; ++k) g[k] = axis_gravity[D == 2 && k == 1 ? 2 : k], g2 += g[k] * g[k];
    const double c = p.sound_speed, v = std::pow(p.dp, D);
    for (int k = 0; k < D; ++k) {
      gravity[k] = T(g[k]);
      continuity.static_gradient[k] = T(water ? p.water_density * g[k] / (c * c) : 0);
      low[k] = p.low[D == 2 && k == 1 ? 2 : k];
      high[k] = p.high[D == 2 && k == 1 ? 2 : k];
    }
    water_mass = T(p.water_density * v);
    continuity.mass = water_mass;
    density_diffusion = p.density_diffusion > 0;
    shifting = ParticleShifting<T, D>(water ? p.shifting : 0, p.h);
    continuity.diffusion = T(2 * p.density_diffusion * p.h * c);
    water_viscosity = ArtificialViscosity<T, D>(p.water_alpha, c, p.h);
    water_slips = p.water_slips;

    const double cs =
        with_soil ? SoilMaterial<double>::wave_speed(p.young_modulus, p.poisson_ratio, p.soil_density) : 0;
    soil = SoilMaterial<T>(p.young_modulus, p.poisson_ratio, p.friction, p.cohesion, p.dilatancy, Cone(p.cone));
    if (p.friction_fast > 0) {
      const auto with_friction = [&p](double friction) {
        return SoilMaterial<double>(p.young_modulus, p.poisson_ratio, friction, p.cohesion, p.dilatancy, Cone(p.cone));
      };
      soil_rate = RateStrength<T>(with_friction(p.friction), with_friction(p.friction_fast), p.inertial_number,
                                  p.grain_diameter, p.grain_density);
    }
    soil_viscosity = ArtificialViscosity<T, D>(p.soil_alpha, cs, p.h);
    soil_density = T(p.soil_density), soil_mass = T(p.soil_density * v);
    stress_diffusion = T(2 * p.stress_diffusion * p.h * cs);
    const double across_wet =
        p.pore_gradient > 0 && p.soil_density > 0 ? p.k0 + (1 - p.k0) * p.water_density / p.soil_density : p.k0;
    static_stress_dry = static_stress(p.soil_density, p.k0, g, g2);
    static_stress_wet = static_stress(p.soil_density, across_wet, g, g2);
    pore_gradient = T(p.pore_gradient);
    pore_share = T(p.pore_gradient > 0 && p.soil_density > 0 ? p.pore_gradient / (p.soil_density * std::sqrt(g2)) : 0);
    still_water_level = T(water ? p.still_water_level : 0);
    artificial_stress = T(with_soil ? p.artificial_stress / (p.soil_density * p.soil_density) : 0);
    inverse_w_dp = 1 / kernel.value(dp);
    return_mapping = p.return_mapping, wall_viscosity = p.wall_viscosity,
    coulomb_walls = p.coulomb_bed || p.coulomb_sides;
    corrected_strain_rate = p.corrected_strain_rate;

    interface.water_mass = water_mass;
    interface.repulsion = SoftRepulsion<T>(p.repulsion, c, p.dp, p.h);
    velocity_factor = T(p.velocity_factor);
    mass_ratio = with_soil ? T(p.water_density / p.soil_density) : T(0);
    image_gravity = p.image_gravity;

    for (int s = 0; s < 4; ++s) absorbing[s] = p.absorbing[s], side_at[s] = p.side_at[s], side_top[s] = p.side_top[s];
    absorbing_width = p.absorbing_width;
    absorbing_rate = T(p.absorbing_rate), settle_rate = T(p.settle_rate);
    soil_settle_rate = T(p.soil_settle_rate);
    fastest_wave = std::max(water ? c : 0.0, cs);
    speed_limit = T(2 * fastest_wave);
    const double alpha_c = std::max(water ? p.water_alpha * c : 0.0, p.soil_alpha * cs);
    slowest_viscous = alpha_c > 0 ? p.h / alpha_c : 1e30;
    cfl = p.cfl, verlet = p.verlet;
    viscous_step = viscous_limit(verlet) * slowest_viscous;
    const double delta_c = std::max(water ? p.density_diffusion * c : 0.0, p.stress_diffusion * cs);
    diffusive_step = delta_c > 0 ? diffusive_limit(verlet) * p.h / delta_c : 1e30;
  }

 private:
  /// rho kappa: weight along gravity 1, across it `across`; the out-of-plane stress of 2-D is across.
  static Stress<T, D> static_stress(double density, double across, const double* g, double g2) {
    Stress<T, D> s;
    for (int k = 0; k < Stress<T, D>::size; ++k) s.c[k] = 0;
    if (g2 == 0) return s;
    for (int a = 0; a < D; ++a)
      for (int b = a; b < D; ++b)
        s.c[stress_index<D>(a, b)] = T(density * ((a == b ? across : 0) + (1 - across) * g[a] * g[b] / g2));
    if (D == 2) s.c[3] = T(density * across);
    return s;
  }
};

/// Four values of a particle side by side, which a device loads at a stroke.
template <class T>
struct alignas(16) Four {
  T c[4];
};
/// One component of what is kept in fours.
template <class T>
struct OfFours {
  const T* first = nullptr;
  LGIW_FN const T& operator[](int i) const { return first[4 * std::ptrdiff_t(i)]; }
};
/// Places of particles as the passes read them: on a device in fours, whose last value is something else.
template <class Tr>
using Places = std::conditional_t<Tr::tiles, const typename Tr::T*, OfFours<typename Tr::T>>;

/// Fields of a phase as the kernels see them. `x` is the position in T; `position` in P is the one that is integrated.
template <class Tr>
struct WaterView {
  static constexpr int D = Tr::D;
  using T = typename Tr::T;
  int n = 0;
  const int* start = nullptr;                 // [cells + 1]
  const unsigned char* cells_near = nullptr;  // [cells] 0: no particle of this phase is near; null: not known
  const TileTable<T, D>* tiles = nullptr;     // on the CPU
  Four<T>* place = nullptr;                   // on a device: where it is, and its term
  Four<T>* motion = nullptr;                  // and its velocity and excess
  Places<Tr> x[D] = {};
  typename Tr::P* position[D] = {};
  T* v[D] = {};
  T* a[D] = {};
  T* excess = nullptr;           // rho - rho0
  T* excess_next = nullptr;      // leapfrog: sums of continuity, then the new density
  T* density_rate = nullptr;     // Verlet: where the forces were taken
  T* term = nullptr;             // p / rho^2
  T* inverse_density = nullptr;  // of copies only (tiles.hh)
  unsigned* id = nullptr;
  T* v_previous[D] = {};  // Verlet only
  T* excess_previous = nullptr;
  T* shift[D] = {};  // velocity of the shifting, where switched on
  int* key = nullptr;
};

template <class Tr>
struct SoilView {
  static constexpr int D = Tr::D;
  using T = typename Tr::T;
  int n = 0;
  const int* start = nullptr;
  const unsigned char* cells_near = nullptr;
  const TileTable<T, D>* tiles = nullptr;  // on the CPU
  Four<T>* place = nullptr;                // on a device: where it is, and its image_term
  Four<T>* motion = nullptr;               // and its velocity and image_excess
  Places<Tr> x[D] = {};
  typename Tr::P* position[D] = {};
  T* v[D] = {};
  T* a[D] = {};
  T* stress[Tr::S] = {};
  T* stress_next[Tr::S] = {};
  T* adps = nullptr;
  T* image_term = nullptr;  // p/rho^2 and excess density of the water image (coupled scenes)
  T* image_excess = nullptr;
  T* artificial[Tr::S] = {};  // R of Eq. (7), where switched on
  unsigned* id = nullptr;
  T* v_previous[D] = {};
  T* stress_previous[Tr::S] = {};
  int* key = nullptr;
};

/// X: how their places are kept.
template <class Tr, class X = Places<Tr>>
struct WallView {
  static constexpr int D = Tr::D;
  static constexpr bool moving = false;
  using T = typename Tr::T;
  int n = 0;
  const int* start = nullptr;
  const unsigned char* cells_near = nullptr;
  const TileTable<T, D>* tiles = nullptr;  // on the CPU
  Four<T>* place = nullptr;                // on a device: where it is, and its weight
  X x[D] = {};
  const T* normal[D] = {};
  const T* weight = nullptr;    // V_b / dp^D
  const T* slip = nullptr;      // 1 where soil slips, freely or against friction
  const T* friction = nullptr;  // coefficient of Coulomb walls, 0 elsewhere; where there are any
  T* term = nullptr;            // water: p/rho^2 and excess density
  T* excess = nullptr;
  T* v[D] = {};  // soil: image velocity, image stress
  T* stress[Tr::S] = {};
  unsigned* id = nullptr;
};

/// Wall particles of the bodies that move as prescribed.
template <class Tr>
struct BodyView : WallView<Tr, const typename Tr::T*> {
  static constexpr int D = Tr::D;
  static constexpr bool moving = true;
  using T = typename Tr::T;
  T* own_v[D] = {};  // velocity and acceleration of the body there
  T* own_a[D] = {};
  T* place[D] = {};  // x, n of WallView, to be written
  T* direction[D] = {};
  const T* arm[D] = {};  // relative to the pivot at pitch 0
  const T* own_normal[D] = {};
  const int* body = nullptr;
  int* key = nullptr;
};

/// Copies of the particles near a tile, with the fields that a pass reads of them (its reads()).
template <class Tr, bool = Tr::tiles>
struct Near {};
template <class Tr>
struct Near<Tr, true> {
  WaterView<Tr> water;
  SoilView<Tr> soil;
  WallView<Tr> wall;
  BodyView<Tr> bodies;
};

}  // namespace lgiw
