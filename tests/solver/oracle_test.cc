// The solver against a plain O(N^2) evaluation of physics.md, in double precision, on disordered particles of all
// phases.
#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <cstdlib>

#include "base/error.hh"
#include "cloud.hh"
#include "physics/gradient_correction.hh"
#include "physics/interface.hh"
#include "physics/kernel.hh"
#include "physics/soil.hh"
#include "solver/simulation.hh"

namespace lgiw {
namespace {

using test::Cloud;
using test::cloud;
using Options = test::CloudOptions;

/// What physics.md says, term by term, with sums over everything.
template <int D>
class Oracle {
 public:
  using V = Vec<double, D>;
  using S = Stress<double, D>;
  ModelParameters p;
  std::vector<V> xw, vw, xs, vs, xb, nb, vb, ab, xb0, nb0;
  std::vector<double> ew, volume_b;
  std::vector<int> kind_b, body_b;
  std::vector<S> sigma;

  explicit Oracle(const Cloud& c) : p(c.p) {
    read(c.in.water_x, xw), read(c.in.soil_x, xs), read(c.in.wall_x, xb), read(c.in.wall_normal, nb);
    read(c.in.water_v, vw), read(c.in.soil_v, vs);
    ew.assign(c.in.water_excess.begin(), c.in.water_excess.end());
    volume_b.assign(c.in.wall_volume.begin(), c.in.wall_volume.end());
    kind_b.assign(c.in.wall_kind.begin(), c.in.wall_kind.end());
    body_b.assign(c.in.wall_body.begin(), c.in.wall_body.end());
    body_b.resize(xb.size(), 0);
    xb0 = xb, nb0 = nb;
    move_bodies(0, 0);
    sigma = stresses(c.in.soil_stress);
    for (int k = 0; k < D; ++k) g[k] = p.gravity[axis(k)];
    volume = std::pow(p.dp, D), mw = p.water_density * volume, ms = p.soil_density * volume;
  }
  static std::vector<S> stresses(const std::vector<float>& values) {
    static constexpr int plane[4] = {0, 2, 5, 1};
    std::vector<S> out(values.size() / 6);
    for (std::size_t i = 0; i < out.size(); ++i)
      for (int c = 0; c < S::size; ++c) out[i].c[c] = values[6 * i + (D == 2 ? plane[c] : c)];
    return out;
  }
  static int axis(int k) { return D == 2 && k == 1 ? 2 : k; }
  template <class T>
  static void read(const std::vector<T>& values, std::vector<V>& out) {
    out.resize(values.size() / 3);
    for (std::size_t i = 0; i < out.size(); ++i)
      for (int k = 0; k < D; ++k) out[i][k] = values[3 * i + axis(k)];
  }

  V g;
  double volume, mw, ms;

  /// Where a point of the body is at time t, pitched about its pivot in the plane of `ahead`.
  V body_point(const V& start, double t, bool direction) const {
    const PrescribedMotion& m = p.bodies[0];
    const auto moved = test::body_motion(t);
    std::array<double, 3> arm{}, out{};
    for (int k = 0; k < D; ++k) arm[axis(k)] = start[k] - (direction ? 0 : m.pivot[axis(k)]);
    const double along = arm[0] * m.ahead[0] + arm[1] * m.ahead[1], across = arm[1] * m.ahead[0] - arm[0] * m.ahead[1];
    const std::complex<double> turned =
        std::complex<double>(along, arm[2]) * std::polar(1.0, -moved[3]);  // pitch lowers what is ahead
    out[0] = turned.real() * m.ahead[0] - across * m.ahead[1];
    out[1] = turned.real() * m.ahead[1] + across * m.ahead[0];
    out[2] = turned.imag();
    V result;
    for (int k = 0; k < D; ++k) result[k] = out[axis(k)] + (direction ? 0 : m.pivot[axis(k)] + moved[axis(k)]);
    return result;
  }
  /// Bodies at time t, with the velocity of the time `middle`; derivatives are differences.
  void move_bodies(double t, double middle) {
    vb.assign(xb.size(), V{}), ab.assign(xb.size(), V{});
    const double e = 1e-4;
    for (std::size_t b = 0; b < xb.size(); ++b) {
      if (!body_b[b]) continue;
      xb[b] = body_point(xb0[b], t, false), nb[b] = body_point(nb0[b], t, true);
      vb[b] = (0.5 / e) * (body_point(xb0[b], middle + e, false) - body_point(xb0[b], middle - e, false));
      const V later = body_point(xb0[b], t + e, false) - xb[b], earlier = xb[b] - body_point(xb0[b], t - e, false);
      ab[b] = (1 / (e * e)) * (later - earlier);
    }
  }

  double w(double r) const {
    return p.cubic_kernel ? CubicSpline<double, D>(p.h).value(r) : Wendland<double, D>(p.h).value(r);
  }
  double f(double r) const {
    return p.cubic_kernel ? CubicSpline<double, D>(p.h).gradient(r) : Wendland<double, D>(p.h).gradient(r);
  }
  double pressure(double e) const {
    return p.sound_speed * p.sound_speed * p.water_density / 7 * (std::pow(1 + e / p.water_density, 7) - 1);
  }
  double density(double pressure) const {
    return p.water_density * std::pow(1 + 7 * pressure / (p.sound_speed * p.sound_speed * p.water_density), 1.0 / 7);
  }
  double mu(const V& r, const V& v) const { return p.h * dot(v, r) / (dot(r, r) + 0.01 * p.h * p.h); }
  double viscosity(const V& r, const V& v, double alpha_c, double rho) const {
    return dot(v, r) < 0 ? -alpha_c * mu(r, v) / rho : 0;
  }
  /// Between water and wall: only what is along the wall's normal where water slips.
  double wall_viscosity(const V& r, const V& v, const V& n, double alpha_c, double rho) const {
    if (!p.water_slips) return viscosity(r, v, alpha_c, rho);
    const double approach = dot(v, n) * dot(n, r);
    return approach < 0 ? -alpha_c * p.h * approach / (dot(r, r) + 0.01 * p.h * p.h) / rho : 0;
  }
  double soil_c() const { return SoilMaterial<double>::wave_speed(p.young_modulus, p.poisson_ratio, p.soil_density); }

  double water_image(const V& x, const V& gravity) const {
    double top = 0, bottom = 0;
    for (std::size_t j = 0; j < xw.size(); ++j) {
      const V r = x - xw[j];
      const double rho = p.water_density + ew[j], weight = mw / rho * w(std::sqrt(dot(r, r)));
      top += weight * (pressure(ew[j]) + rho * dot(gravity, r));
      bottom += weight;
    }
    return bottom > 0 ? top / bottom : 0;
  }
  S at_rest(double z) const {  // rho_s kappa
    const bool wet = p.pore_gradient > 0 && z < p.still_water_level;
    const double across = wet ? p.k0 + (1 - p.k0) * p.water_density / p.soil_density : p.k0, g2 = dot(g, g);
    S s{};
    if (g2 == 0) return s;
    for (int a = 0; a < D; ++a)
      for (int b = a; b < D; ++b)
        s.c[stress_index<D>(a, b)] = p.soil_density * ((a == b ? across : 0) + (1 - across) * g[a] * g[b] / g2);
    if (D == 2) s.c[3] = p.soil_density * across;
    return s;
  }
  S wall_stress(std::size_t b) const {
    S mean{};
    V offset{};
    double bottom = 0;
    for (std::size_t j = 0; j < xs.size(); ++j) {
      const V r = xb[b] - xs[j];
      const double weight = w(std::sqrt(dot(r, r)));
      for (int c = 0; c < S::size; ++c) mean.c[c] += weight * sigma[j].c[c];
      add_scaled(offset, weight, r), bottom += weight;
    }
    if (bottom == 0) return mean;
    for (int c = 0; c < S::size; ++c) mean.c[c] /= bottom;
    offset = (1 / bottom) * offset;
    const S rest = at_rest(xb[b][D - 1]);
    const double along = dot(g, nb[b]) * dot(offset, nb[b]), across = dot(g, offset) - along;
    const double pore = std::max(0.0, p.pore_gradient * (p.still_water_level - (xb[b][D - 1] - offset[D - 1])));
    const double pore_growth = pore > 0 ? p.pore_gradient / size(g) * along : 0;
    const double growth = p.soil_density * along - pore_growth, pressure = -dot(nb[b], apply(mean, nb[b])) - pore;
    double share = 0;  // of the growth, in the manner of a layer
    if (!slips(b) && growth > 0 && pressure > 0) share = std::min(1.0, 5 * pressure / growth);
    S sum{};
    for (int c = 0; c < S::size; ++c) {
      const double normal = D == 2 ? (c == 2 ? 0 : 1) : (c < 3 ? 1 : 0);
      const double effective = mean.c[c] + normal * pore;
      sum.c[c] = mean.c[c] + share * (pressure > 0 ? growth / pressure * effective : 0) - share * pore_growth * normal -
                 ((1 - share) * along + across) * rest.c[c];
    }
    return slips(b) ? reflect(sum, nb[b]) : sum;
  }
  static double size(const V& v) { return std::sqrt(dot(v, v)); }
  bool rubs(std::size_t b) const { return kind_b[b] == 0 ? p.coulomb_bed : p.coulomb_sides; }
  bool slips(std::size_t b) const { return rubs(b) || (kind_b[b] == 0 ? p.free_slip_bed : p.free_slip_sides); }
  V wall_velocity(std::size_t b) const {
    V sum{};
    double bottom = 0;
    for (std::size_t j = 0; j < xs.size(); ++j) {
      const V r = xb[b] - xs[j];
      const double weight = w(std::sqrt(dot(r, r)));
      add_scaled(sum, weight, vs[j]), bottom += weight;
    }
    if (bottom == 0) return sum;
    V mean = (1 / bottom) * sum;
    if (!slips(b)) return 2.0 * vb[b] - mean;
    add_scaled(mean, -2 * dot(mean - vb[b], nb[b]), nb[b]);
    return mean;
  }
  /// Force coefficient of an interface pair: a_w = coefficient (x_w - x_s).
  double interface(std::size_t iw, std::size_t is) const {
    const V r = xw[iw] - xs[is];
    const double d = std::sqrt(dot(r, r)), rho_w = p.water_density + ew[iw];
    const double ps = water_image(xs[is], p.image_gravity ? g : V{}), rho_s = density(ps);
    const double phi = pressure(ew[iw]) / (rho_w * rho_w) + ps / (rho_s * rho_s) +
                       viscosity(r, vw[iw] - vs[is], p.water_alpha * p.sound_speed, 0.5 * (rho_w + rho_s));
    double repulsion = 0;
    if (d < p.dp) {
      const double eta = 2 * d / p.h;
      const double shape = eta <= 2.0 / 3
                               ? 2.0 / 3
                               : (eta < 1 ? 2 * eta - 1.5 * eta * eta : (eta < 2 ? 0.5 * (2 - eta) * (2 - eta) : 0));
      repulsion = 0.01 * p.sound_speed * p.sound_speed * (1 - d / p.dp) * shape / (d * d);
    }
    return -mw * phi * f(d) + repulsion;
  }

  V water_force(std::size_t i) const {  // N, without gravity
    V a{};
    const double rho_i = p.water_density + ew[i], pi_i = pressure(ew[i]), ac = p.water_alpha * p.sound_speed;
    for (std::size_t j = 0; j < xw.size(); ++j) {
      if (j == i) continue;
      const V r = xw[i] - xw[j];
      const double rho_j = p.water_density + ew[j];
      const double sum = pi_i / (rho_i * rho_i) + pressure(ew[j]) / (rho_j * rho_j) +
                         viscosity(r, vw[i] - vw[j], ac, 0.5 * (rho_i + rho_j));
      add_scaled(a, -mw * sum * f(std::sqrt(dot(r, r))), r);
    }
    for (std::size_t b = 0; b < xb.size(); ++b) {
      const V r = xw[i] - xb[b];
      if (dot(r, r) >= 4 * p.h * p.h) continue;
      const double pb = water_image(xb[b], g - ab[b]), rho_b = density(pb), m = mw * volume_b[b] / volume;
      const double sum = std::max(0.0, pi_i / (rho_i * rho_i) + pb / (rho_b * rho_b)) +
                         wall_viscosity(r, vw[i] - vb[b], nb[b], ac, 0.5 * (rho_i + rho_b));
      add_scaled(a, -m * sum * f(std::sqrt(dot(r, r))), r);
    }
    for (std::size_t j = 0; j < xs.size(); ++j) {
      const V r = xw[i] - xs[j];
      if (dot(r, r) < 4 * p.h * p.h) add_scaled(a, interface(i, j), r);
    }
    return mw * a;
  }
  V soil_force(std::size_t i) const {
    V a{};
    const double rho2 = p.soil_density * p.soil_density, ac = p.soil_alpha * soil_c();
    for (std::size_t j = 0; j < xs.size(); ++j) {
      if (j == i) continue;
      const V r = xs[i] - xs[j];
      const double d = std::sqrt(dot(r, r));
      S sum;
      for (int c = 0; c < S::size; ++c) sum.c[c] = (sigma[i].c[c] + sigma[j].c[c]) / rho2;
      if (p.artificial_stress > 0) {
        const double fn = std::pow(w(d) / w(p.dp), 2.55);
        const S ri = artificial_stress(sigma[i], p.artificial_stress / rho2),
                rj = artificial_stress(sigma[j], p.artificial_stress / rho2);
        for (int c = 0; c < S::size; ++c) sum.c[c] += fn * (ri.c[c] + rj.c[c]);
      }
      add_scaled(a, ms * f(d), apply(sum, r));
      add_scaled(a, -ms * f(d) * viscosity(r, vs[i] - vs[j], ac, p.soil_density), r);
    }
    for (std::size_t b = 0; b < xb.size(); ++b) {
      const V r = xs[i] - xb[b];
      if (dot(r, r) >= 4 * p.h * p.h || rubs(b)) continue;
      const S image = wall_stress(b);
      S sum;
      for (int c = 0; c < S::size; ++c) sum.c[c] = (sigma[i].c[c] + image.c[c]) / rho2;
      const double m = p.soil_density * volume_b[b], d = std::sqrt(dot(r, r));
      add_scaled(a, m * f(d), apply(sum, r));
      V v = vs[i] - vb[b];
      if (slips(b)) v = dot(v, nb[b]) * nb[b];
      if (p.wall_viscosity) add_scaled(a, -m * f(d) * viscosity(r, v, ac, p.soil_density), r);
    }
    for (std::size_t j = 0; j < xw.size(); ++j) {
      const V r = xw[j] - xs[i];
      if (dot(r, r) < 4 * p.h * p.h) add_scaled(a, -mw / ms * interface(j, i), r);
    }
    add_scaled(a, 1.0, contact(i, a));
    return ms * a;
  }
  /// Acceleration by Coulomb walls in the first instant, when the others give a and gravity.
  V contact(std::size_t i, V a) const {
    V pressure{}, normal{};
    double weight = 0;
    for (std::size_t b = 0; b < xb.size(); ++b) {
      const V r = xs[i] - xb[b], n = nb[b];
      if (dot(r, r) >= 4 * p.h * p.h || !rubs(b)) continue;
      const S image = wall_stress(b);
      const double toward = -p.soil_density * volume_b[b] * f(size(r)) * dot(r, n);
      double push = -(dot(n, apply(sigma[i], n)) + dot(n, apply(image, n))) / (p.soil_density * p.soil_density);
      if (p.wall_viscosity) push += viscosity(r, dot(vs[i] - vb[b], n) * n, p.soil_alpha * soil_c(), p.soil_density);
      add_scaled(pressure, toward * push, n), add_scaled(normal, toward, n), weight += toward;
    }
    V none{};
    if (weight <= 0) return none;
    normal = (1 / size(normal)) * normal;
    const double force = dot(pressure, normal);
    if (force <= 0) return none;
    for (int k = 0; k < D; ++k) a[k] += g[k] + pressure[k];
    add_scaled(a, -dot(a, normal), normal);
    add_scaled(pressure, -std::min(1.0, p.bed_friction * force / size(a)), a);
    return pressure;
  }
  /// r when v was: half a step before the end with leapfrog.
  V earlier(const V& r, const V& v, double dt) const { return r - (p.verlet ? 0 : 0.5 * dt) * v; }
  double density_rate(std::size_t i, double dt) const {
    double rate = 0, at_walls = 0;
    for (std::size_t j = 0; j < xw.size(); ++j) {
      if (j == i) continue;
      const V r = earlier(xw[i] - xw[j], vw[i] - vw[j], dt);
      const double fr = f(std::sqrt(dot(r, r))), c = p.sound_speed;
      rate += mw * dot(vw[i] - vw[j], r) * fr;
      const double hydrostatic = -p.water_density * dot(g, r) / (c * c);
      rate += 2 * p.density_diffusion * p.h * c * mw / (p.water_density + ew[j]) * (ew[j] - ew[i] - hydrostatic) * -fr;
    }
    for (std::size_t b = 0; b < xb.size(); ++b) {
      const V r = earlier(xw[i] - xb[b], vw[i] - vb[b], dt);
      at_walls += mw * volume_b[b] / volume * dot(vw[i] - vb[b], r) * f(std::sqrt(dot(r, r)));
    }
    if (ew[i] > 0 || at_walls > 0) rate += at_walls;
    for (std::size_t j = 0; j < xs.size(); ++j) {
      const V r = earlier(xw[i] - xs[j], vw[i] - vs[j], dt);
      rate += mw * p.velocity_factor * dot(vw[i] - vs[j], r) * f(std::sqrt(dot(r, r)));
    }
    return rate;
  }
  S new_stress(std::size_t i, double dt, double* adps) const {
    double l[D * D] = {};
    S smoothing{};
    MomentMatrix<double, D> moment;
    auto add = [&](const V& r, const V& v_ji, double weight) {
      const double w = weight * f(size(r));
      moment.add(w, r);
      for (int a = 0; a < D; ++a)
        for (int b = 0; b < D; ++b) l[a * D + b] += w * v_ji[a] * r[b];
    };
    const S rest = at_rest(xs[i][D - 1]);
    for (std::size_t j = 0; j < xs.size(); ++j) {
      if (j == i) continue;
      const V r = earlier(xs[i] - xs[j], vs[i] - vs[j], dt);
      add(r, vs[j] - vs[i], volume);
      for (int c = 0; c < S::size; ++c)
        smoothing.c[c] += 2 * p.stress_diffusion * p.h * soil_c() * volume *
                          (sigma[j].c[c] - sigma[i].c[c] - dot(g, r) * rest.c[c]) * -f(std::sqrt(dot(r, r)));
    }
    for (std::size_t b = 0; b < xb.size(); ++b)
      if (dot(xs[i] - xb[b], xs[i] - xb[b]) < 4 * p.h * p.h)
        add(earlier(xs[i] - xb[b], vs[i] - vb[b], dt), wall_velocity(b) - vs[i], volume_b[b]);
    if (p.corrected_strain_rate) correct_gradient(l, moment);
    const SoilMaterial<double> m(p.young_modulus, p.poisson_ratio, p.friction, p.cohesion, p.dilatancy,
                                 Cone::plane_strain);
    S d = elastic_increment(m, sigma[i], l, dt), s = sigma[i];
    for (int c = 0; c < S::size; ++c) d.c[c] += dt * smoothing.c[c];
    const double pore = std::max(0.0, p.pore_gradient * (p.still_water_level - xs[i][D - 1]));
    if (!p.return_mapping) {
      *adps = rate_form_update(m, s, d, l, dt, pore);
      return s;
    }
    for (int c = 0; c < S::size; ++c) s.c[c] += d.c[c];
    *adps = return_mapping(m, s, pore);
    return s;
  }
};

template <class V>
double size(const V& v) {
  return std::sqrt(dot(v, v));
}

/// Runs f with each of the instruction sets that the processor has.
template <class F>
void with_all_instructions(F&& f) {
  for (const std::string& name : cpu_instruction_sets()) {
    SCOPED_TRACE(name);
    ::setenv("LGIW_INSTRUCTIONS", name.c_str(), 1);
    f();
  }
  ::unsetenv("LGIW_INSTRUCTIONS");
}

template <int D>
void compare_forces_once(const Options& o) {
  const Cloud c = cloud(o);
  const Oracle<D> oracle(c);
  const auto simulation = make_cpu_simulation(c.p, c.in, NumberType::double_);
  std::vector<double> water, soil;
  simulation->download_accelerations(water, soil);
  ASSERT_EQ(water.size(), c.in.water_x.size());
  double scale = 0;
  for (std::size_t i = 0; i < oracle.xs.size(); ++i) scale = std::max(scale, size(oracle.soil_force(i)));
  for (std::size_t i = 0; i < oracle.xw.size(); ++i) {
    const auto expected = oracle.water_force(i);
    for (int k = 0; k < D; ++k)
      EXPECT_NEAR(water[3 * i + Oracle<D>::axis(k)], expected[k], 1e-9 * scale) << "water " << i;
  }
  for (std::size_t i = 0; i < oracle.xs.size(); ++i) {
    const auto expected = oracle.soil_force(i);
    for (int k = 0; k < D; ++k)
      EXPECT_NEAR(soil[3 * i + Oracle<D>::axis(k)], expected[k], 1e-9 * scale) << "soil " << i;
  }
}
template <int D>
void compare_forces(const Options& o) {
  with_all_instructions([&] { compare_forces_once<D>(o); });
}
TEST(Oracle, Forces2D) { compare_forces<2>({}); }
TEST(Oracle, Forces3D) { compare_forces<3>({3}); }
TEST(Oracle, ForcesBesideAMovingBody2D) { compare_forces<2>({2, true, false, false, true, true, true}); }
TEST(Oracle, ForcesBesideAMovingBody3D) { compare_forces<3>({3, true, false, false, true, true, true}); }
TEST(Oracle, ForcesAtCoulombWalls2D) { compare_forces<2>({.coulomb = true}); }
TEST(Oracle, ForcesAtCoulombWalls3D) { compare_forces<3>({.dimension = 3, .coulomb = true}); }
TEST(Oracle, ForcesOfThePaper2D) { compare_forces<2>({2, true, true, true}); }
TEST(Oracle, ForcesOfThePaper3D) { compare_forces<3>({3, true, true, true}); }

/// One step: positions and velocities move by the oracle's forces, then densities and stresses by the oracle's rates
/// there.
template <int D>
void compare_step_once(const Options& o) {
  Cloud c = cloud(o);
  const auto simulation = make_cpu_simulation(c.p, c.in, NumberType::double_);
  const double dt = simulation->state().dt;
  std::vector<double> water_f, soil_f;
  simulation->download_accelerations(water_f, soil_f);
  simulation->advance(1, 1);
  EXPECT_EQ(simulation->state().step, 1);
  EXPECT_NEAR(simulation->state().time, dt, 1e-15);
  ParticleState s;
  simulation->download(s);

  // v^{1/2} = v^0 + dt/2 a, r^1 = r^0 + dt v^{1/2}
  Oracle<D> oracle(c);
  auto move = [&](std::vector<typename Oracle<D>::V>& x, std::vector<typename Oracle<D>::V>& v,
                  const std::vector<double>& force, double m, const std::vector<double>& moved) {
    for (std::size_t i = 0; i < x.size(); ++i)
      for (int k = 0; k < D; ++k) {
        v[i][k] += 0.5 * dt * (force[3 * i + Oracle<D>::axis(k)] / m + oracle.g[k]);
        x[i][k] += dt * v[i][k];
        EXPECT_NEAR(moved[3 * i + Oracle<D>::axis(k)], x[i][k], 1e-12);
      }
  };
  move(oracle.xw, oracle.vw, water_f, oracle.mw, s.water_x);
  move(oracle.xs, oracle.vs, soil_f, oracle.ms, s.soil_x);
  oracle.move_bodies(dt, 0.5 * dt);
  for (std::size_t i = 0; i < oracle.xw.size(); ++i)
    EXPECT_NEAR(s.water_excess[i], oracle.ew[i] + dt * oracle.density_rate(i, dt), 1e-5) << i;
  const auto stress = Oracle<D>::stresses(s.soil_stress);
  int plastic = 0;
  for (std::size_t i = 0; i < oracle.xs.size(); ++i) {
    double adps = 0;
    const auto expected = oracle.new_stress(i, dt, &adps);
    for (int k = 0; k < StressSize<D>::value; ++k) EXPECT_NEAR(stress[i].c[k], expected.c[k], 0.01) << i;
    EXPECT_NEAR(s.soil_adps[i], adps, 1e-9 + 1e-5 * adps);
    plastic += adps > 0;
  }
  EXPECT_GT(plastic, 0);  // or the test would not see the return mapping
  EXPECT_LT(plastic, int(oracle.xs.size()));
}
template <int D>
void compare_step(const Options& o) {
  with_all_instructions([&] { compare_step_once<D>(o); });
}
TEST(Oracle, Step2D) { compare_step<2>({}); }
TEST(Oracle, Step3D) { compare_step<3>({3}); }
TEST(Oracle, StepWithCorrectedStrainRate2D) { compare_step<2>({.corrected = true}); }
TEST(Oracle, StepWithCorrectedStrainRate3D) { compare_step<3>({.dimension = 3, .corrected = true}); }
TEST(Oracle, StepBesideAMovingBody2D) { compare_step<2>({2, true, false, false, true, true, true}); }
TEST(Oracle, StepBesideAMovingBody3D) { compare_step<3>({3, true, false, false, true, true, true}); }

/// Two steps with Verlet: rates of the place and time that a step starts from, an Euler step and then one from the
/// state before the last.
template <int D>
void compare_verlet_steps_once(const Options& o) {
  using Known = Oracle<D>;
  Cloud c = cloud(o);
  const auto simulation = make_cpu_simulation(c.p, c.in, NumberType::double_);
  const Known before(c);
  ParticleState s;
  double dt[2];
  dt[0] = simulation->state().dt;
  std::vector<double> water_f, soil_f;
  simulation->download_accelerations(water_f, soil_f);
  simulation->advance(1, 1);
  simulation->download(s);
  for (std::size_t i = 0; i < before.xw.size(); ++i) {
    EXPECT_NEAR(s.water_excess[i], before.ew[i] + dt[0] * before.density_rate(i, dt[0]), 1e-5) << i;
    for (int k = 0; k < D; ++k) {
      const double a = water_f[3 * i + Known::axis(k)] / before.mw + before.g[k], v = before.vw[i][k];
      EXPECT_NEAR(s.water_x[3 * i + Known::axis(k)], before.xw[i][k] + dt[0] * v + 0.5 * dt[0] * dt[0] * a, 1e-12);
      EXPECT_NEAR(s.water_v[3 * i + Known::axis(k)], v + dt[0] * a, 1e-6);
    }
  }
  const auto stress = Known::stresses(s.soil_stress);
  for (std::size_t i = 0; i < before.xs.size(); ++i) {
    double adps = 0;
    const auto expected = before.new_stress(i, dt[0], &adps);
    for (int k = 0; k < StressSize<D>::value; ++k) EXPECT_NEAR(stress[i].c[k], expected.c[k], 0.01) << i;
  }

  Known now(c);
  now.read(s.water_x, now.xw), now.read(s.water_v, now.vw), now.read(s.soil_x, now.xs), now.read(s.soil_v, now.vs);
  now.ew.assign(s.water_excess.begin(), s.water_excess.end());
  now.move_bodies(dt[0], dt[0]);
  dt[1] = simulation->state().dt;
  // What a run asks for between two steps leaves the rates alone.
  simulation->internal_forces();
  simulation->advance(1, 1);
  EXPECT_EQ(simulation->state().step, 2);
  simulation->download(s);
  double largest = 0;
  for (std::size_t i = 0; i < now.xw.size(); ++i) {
    const double change = (dt[0] + dt[1]) * now.density_rate(i, dt[1]);
    EXPECT_NEAR(s.water_excess[i], before.ew[i] + change, 1e-5) << i;
    largest = std::max(largest, std::abs(change));
  }
  EXPECT_GT(largest, 0.1);
}
template <int D>
void compare_verlet_steps(const Options& o) {
  with_all_instructions([&] { compare_verlet_steps_once<D>(o); });
}
TEST(Oracle, VerletSteps2D) { compare_verlet_steps<2>({.verlet = true}); }
TEST(Oracle, VerletSteps3D) { compare_verlet_steps<3>({.dimension = 3, .verlet = true}); }
TEST(Oracle, VerletStepsBesideAMovingBody2D) { compare_verlet_steps<2>({.bodies = true, .verlet = true}); }
TEST(Oracle, VerletStepsBesideAMovingBody3D) {
  compare_verlet_steps<3>({.dimension = 3, .bodies = true, .verlet = true});
}
TEST(Oracle, VerletStepsOfThePaper2D) { compare_verlet_steps<2>({.cubic = true, .paper = true, .verlet = true}); }
TEST(Oracle, VerletStepsOfThePaper3D) {
  compare_verlet_steps<3>({.dimension = 3, .cubic = true, .paper = true, .verlet = true});
}

/// Shifting moves a particle, and changes nothing else of it, by -A h |v| grad C dt in the bulk.
template <int D>
void compare_shifting() {
  Cloud c = cloud({D, true, false, false, true, true, true});
  const auto plain = make_cpu_simulation(c.p, c.in, NumberType::double_);
  c.p.shifting = 2;
  const auto shifted = make_cpu_simulation(c.p, c.in, NumberType::double_);
  const Oracle<D> oracle(c);
  using V = typename Oracle<D>::V;
  const double dt = plain->state().dt;
  ASSERT_EQ(shifted->state().dt, dt);
  plain->advance(1, 1), shifted->advance(1, 1);
  ParticleState a, b;
  plain->download(a), shifted->download(b);
  EXPECT_EQ(a.water_v, b.water_v);
  EXPECT_EQ(a.soil_x, b.soil_x);
  int within = 0, kept = 0;
  for (std::size_t i = 0; i < oracle.xw.size(); ++i) {
    V gradient{};
    double divergence = 0;
    auto add = [&](const V& x, double volume) {
      const V r = oracle.xw[i] - x;
      const double d = std::sqrt(dot(r, r));
      if (d == 0 || d >= 2 * c.p.h) return;
      add_scaled(gradient, volume * oracle.f(d), r);
      divergence -= volume * oracle.f(d) * d * d;
    };
    for (const V& x : oracle.xw) add(x, oracle.volume);
    for (const V& x : oracle.xs) add(x, oracle.volume);
    for (std::size_t j = 0; j < oracle.xb.size(); ++j) add(oracle.xb[j], oracle.volume_b[j]);
    const double fade = std::clamp((divergence - D) * (D == 2 ? 2 : 4) + 1, 0.0, 1.0);
    within += fade > 0.5, kept += fade == 0;
    for (int k = 0; k < D; ++k) {
      const double moved = b.water_x[3 * i + Oracle<D>::axis(k)] - a.water_x[3 * i + Oracle<D>::axis(k)];
      EXPECT_NEAR(moved, -dt * 2 * c.p.h * size(oracle.vw[i]) * fade * gradient[k], 1e-12) << "water " << i;
    }
  }
  EXPECT_GT(within, 10);
  EXPECT_GT(kept, 10);
}
TEST(Oracle, Shifting2D) { compare_shifting<2>(); }
TEST(Oracle, Shifting3D) { compare_shifting<3>(); }

/// Without walls and gravity the forces of all pairs, across the interface too, cancel to round-off.
template <int D>
void compare_momentum(bool paper) {
  const Cloud c = cloud({D, false, paper, paper, false});
  const auto simulation = make_cpu_simulation(c.p, c.in, NumberType::double_);
  std::vector<double> water, soil;
  simulation->download_accelerations(water, soil);
  double across = 0;
  for (int k : {0, 1, 2}) {
    double sum = 0, sizes = 0, water_sum = 0;
    for (std::size_t i = k; i < water.size(); i += 3)
      sum += water[i], sizes += std::fabs(water[i]), water_sum += water[i];
    for (std::size_t i = k; i < soil.size(); i += 3) sum += soil[i], sizes += std::fabs(soil[i]);
    EXPECT_NEAR(sum, 0, 1e-12 * sizes + 1e-30) << "axis " << k;
    across = std::max(across, std::fabs(water_sum));
  }
  EXPECT_GT(across, 1);  // N: the phases do push each other
}
TEST(Momentum, IsConservedIn2D) { compare_momentum<2>(false); }
TEST(Momentum, IsConservedIn3D) { compare_momentum<3>(false); }
TEST(Momentum, IsConservedByThePapersChoices) { compare_momentum<2>(true); }

/// Rates belong to the middle of the step: taken with places half a step later, a drop of three particles that turns in
/// the air (a dam break's spray) lost density in every turn, faster and faster, until it burst.
TEST(Rates, ADropThatTurnsInTheAirKeepsItsDensity) {
  ModelParameters p;
  p.dimension = 2, p.dp = 0.005, p.h = 0.0075, p.gravity = {0, 0, 0};
  p.sound_speed = 34, p.water_alpha = 0.05, p.density_diffusion = 0.1, p.cfl = 0.4;
  p.low = {-1, -1, -1}, p.high = {1, 1, 1};
  InitialParticles in;
  const double radius = 0.0017, spin = 300;
  for (int k = 0; k < 3; ++k) {
    const double angle = 2 * M_PI * k / 3;
    in.water_x.insert(in.water_x.end(), {radius * std::cos(angle), 0, radius * std::sin(angle)});
    for (double v : {-spin * radius * std::sin(angle), 0.0, spin * radius * std::cos(angle)})
      in.water_v.push_back(float(v));
    in.water_excess.push_back(0);
  }
  for (const NumberType type : {NumberType::mixed, NumberType::double_}) {
    const auto simulation = make_cpu_simulation(p, in, type);
    ParticleState s;
    simulation->advance(0.05, 1000000);
    simulation->download(s);
    const float early = s.water_excess[0];
    simulation->advance(0.5, 1000000);
    simulation->download(s);
    EXPECT_EQ(simulation->state().failed_water, UINT32_MAX);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(s.water_excess[std::size_t(k)], early, 0.5);  // kg/m3
    const double distance = std::hypot(s.water_x[0] - s.water_x[3], s.water_x[2] - s.water_x[5]);
    EXPECT_NEAR(distance, std::sqrt(3) * radius, 0.1 * radius);
  }
}

void compare_number_types(const Options& o) {
  const Cloud c = cloud(o);
  std::vector<ParticleState> s(3);
  for (int t = 0; t < 3; ++t) {
    const auto simulation = make_cpu_simulation(c.p, c.in, NumberType(t));
    simulation->advance(1e9, 100);
    simulation->download(s[t]);
  }
  for (int t : {0, 1})
    for (std::size_t i = 0; i < s[2].water_x.size(); ++i) EXPECT_NEAR(s[t].water_x[i], s[2].water_x[i], 2e-4 * c.p.dp);
}
TEST(NumberTypes, AgreeWithDoubleOverAHundredSteps) {
  with_all_instructions([] { compare_number_types({3}); });
  with_all_instructions([] { compare_number_types({2}); });
}
/// Float forces of the packed neighbours against the doubles of the oracle: a lane that is lost or doubled is a whole
/// pair, rounding is not.
TEST(NumberTypes, SinglePrecisionForcesAreThoseOfTheOracleToRounding) {
  for (int dimension : {2, 3})
    with_all_instructions([&] {
      const Cloud c = cloud({dimension});
      std::vector<double> exact_water, exact_soil, water, soil;
      make_cpu_simulation(c.p, c.in, NumberType::double_)->download_accelerations(exact_water, exact_soil);
      make_cpu_simulation(c.p, c.in, NumberType::mixed)->download_accelerations(water, soil);
      const auto compare = [](const std::vector<double>& a, const std::vector<double>& b) {
        double scale = 0;
        for (double x : b) scale = std::max(scale, std::fabs(x));
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 2e-5 * scale) << i;
      };
      compare(water, exact_water), compare(soil, exact_soil);
    });
}
TEST(Instructions, ThatAreUnknownAreRefused) {
  const Cloud c = cloud({2});
  ::setenv("LGIW_INSTRUCTIONS", "sse9", 1);
  EXPECT_THROW(make_cpu_simulation(c.p, c.in, NumberType::mixed), InputError);
  ::unsetenv("LGIW_INSTRUCTIONS");
  EXPECT_FALSE(cpu_instruction_sets().empty());
}

}  // namespace
}  // namespace lgiw
