#include "operators.hh"

#include <array>
#include <cmath>
#include <cstdio>
#include <random>

#include "physics/gradient_correction.hh"
#include "physics/kernel.hh"
#include "physics/water.hh"

namespace lgiw::validation {
namespace {

constexpr double k0 = 2 * pi;  // of the fields: one wave over the unit square

/// Manufactured fields at a point of the unit square.
double pressure(double x, double z) { return std::sin(k0 * x) * std::cos(k0 * z); }
std::array<double, 2> pressure_gradient(double x, double z) {
  return {k0 * std::cos(k0 * x) * std::cos(k0 * z), -k0 * std::sin(k0 * x) * std::sin(k0 * z)};
}
std::array<double, 2> velocity(double x, double z) {
  return {std::sin(k0 * x) * std::cos(k0 * z), std::cos(k0 * x) + std::sin(2 * k0 * z)};
}
/// xx, zz, xz of the strain rate.
std::array<double, 3> strain_rate(double x, double z) {
  return {k0 * std::cos(k0 * x) * std::cos(k0 * z), 2 * k0 * std::cos(2 * k0 * z),
          (-k0 * std::sin(k0 * x) * std::sin(k0 * z) - k0 * std::sin(k0 * x)) / 2};
}

/// Particles of a periodic unit square, a cell of the lattice each, displaced by up to `jitter` dp in x and z.
struct Lattice {
  int n;
  double dp;
  std::vector<double> x, z;
  Lattice(int side, double jitter) : n(side), dp(1.0 / side), x(std::size_t(side * side)), z(x.size()) {
    std::mt19937 random(12345);
    std::uniform_real_distribution<double> displacement(-jitter * dp, jitter * dp);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const std::size_t k = std::size_t(j * n + i);
        x[k] = (i + 0.5) * dp + displacement(random), z[k] = (j + 0.5) * dp + displacement(random);
      }
  }
  /// Calls law(j, r) for the neighbours of i within `reach`, r = x_i - x_j across the periodic edges.
  template <class Law>
  void neighbours(int i, double reach, const Law& law) const {
    const int cells = int(std::ceil(reach / dp)) + 1, ci = i % n, cj = i / n;
    for (int b = -cells; b <= cells; ++b)
      for (int a = -cells; a <= cells; ++a) {
        const int j = (cj + b + n) % n * n + (ci + a + n) % n;
        if (j == i) continue;
        Vec<double, 2> r;
        r.c[0] = std::remainder(x[std::size_t(i)] - x[std::size_t(j)], 1.0);
        r.c[1] = std::remainder(z[std::size_t(i)] - z[std::size_t(j)], 1.0);
        if (dot(r, r) < reach * reach) law(j, r);
      }
  }
};

enum Operator { gradient, divergence, plain_strain_rate, corrected_strain_rate, operators };
const char* const operator_names[operators] = {"gradient of pressure (sum of p_i + p_j)", "divergence of velocity",
                                               "strain rate, plain", "strain rate, corrected"};

/// Relative L2 errors of all operators.
std::array<double, operators> errors(const Lattice& lattice, double h) {
  const Wendland<double, 2> kernel(h);
  const double volume = lattice.dp * lattice.dp;
  const WaterContinuity<double, 2> continuity{volume, 0, {}};  // density 1
  std::array<double, operators> wrong{}, norm{};
  for (int i = 0; i < lattice.n * lattice.n; ++i) {
    const double x = lattice.x[std::size_t(i)], z = lattice.z[std::size_t(i)];
    const std::array<double, 2> v = velocity(x, z);
    double g[2] = {0, 0}, div = 0, l[4] = {0, 0, 0, 0};
    MomentMatrix<double, 2> moment;
    lattice.neighbours(i, 2 * h, [&](int j, const Vec<double, 2>& r) {
      const double xj = lattice.x[std::size_t(j)], zj = lattice.z[std::size_t(j)];
      const double f = kernel.gradient(std::sqrt(dot(r, r)));
      const std::array<double, 2> vj = velocity(xj, zj);
      Vec<double, 2> difference;
      for (int a = 0; a < 2; ++a) {
        difference.c[a] = v[std::size_t(a)] - vj[std::size_t(a)];
        g[a] += volume * (pressure(x, z) + pressure(xj, zj)) * f * r.c[a];
        for (int b = 0; b < 2; ++b) l[2 * a + b] -= volume * difference.c[a] * f * r.c[b];
      }
      div -= continuity(r, difference, f);
      moment.add(volume * f, r);
    });
    const auto add = [&](Operator o, double measured, double exact, double weight = 1) {
      wrong[o] += weight * (measured - exact) * (measured - exact), norm[o] += weight * exact * exact;
    };
    const std::array<double, 2> gp = pressure_gradient(x, z);
    const std::array<double, 3> e = strain_rate(x, z);
    for (int a = 0; a < 2; ++a) add(gradient, g[a], gp[std::size_t(a)]);
    add(divergence, div, e[0] + e[1]);
    for (Operator o : {plain_strain_rate, corrected_strain_rate}) {
      if (o == corrected_strain_rate) correct_gradient(l, moment);
      add(o, l[0], e[0]), add(o, l[3], e[1]), add(o, (l[1] + l[2]) / 2, e[2], 2);
    }
  }
  std::array<double, operators> result{};
  for (std::size_t o = 0; o < operators; ++o) result[o] = std::sqrt(wrong[o] / norm[o]);
  return result;
}

std::string text(const char* format, double value) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

}  // namespace

std::vector<Row> operator_rows() {
  const std::vector<int> sides{20, 40, 80, 160};
  std::vector<Row> rows;
  for (double jitter : {0.0, 0.1, 0.3})
    for (double h : {1.5, 2.0}) {
      std::vector<std::array<double, operators>> all;
      for (int n : sides) all.push_back(errors(Lattice(n, jitter), h / n));
      for (std::size_t o = 0; o < operators; ++o) {
        const std::string where = text(", displaced by up to %g dp", jitter) + text(", h / dp = %g", h);
        Row row;
        row.case_name = "operators", row.unit = "-", row.reference = 0;
        row.quantity = "L2 error of the " + std::string(operator_names[o]) + where;
        for (std::size_t k = 0; k < sides.size(); ++k) {
          row.measured = row.error = all[k][o];
          row.dp = 1.0 / sides[k], row.particles = std::size_t(sides[k] * sides[k]);
          rows.push_back(row);
        }
        row.quantity = "observed order of the " + std::string(operator_names[o]) + where;
        row.measured = std::log2(all[all.size() - 2][o] / all.back()[o]);
        row.relative = false, row.reference = std::nan(""), row.error = std::nan("");
        if (o == corrected_strain_rate) {
          row.reference = 1, row.bar = 0;
          row.error = std::min(0.0, row.measured - 1);
        }
        rows.push_back(row);
      }
    }
  return rows;
}

}  // namespace lgiw::validation
