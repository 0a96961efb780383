#include "solver/water_pressure.hh"

#include <cmath>

#include "physics/kernel.hh"

namespace lgiw {
namespace {

template <class Kernel>
float water_pressure(const ModelParameters& p, const ParticleState& s, const std::array<double, 3>& at) {
  const Kernel kernel(p.h);
  const double mass = p.water_density * std::pow(p.dp, p.dimension), reach2 = 4 * p.h * p.h;
  double filled = 0, sum = 0;
  for (std::size_t i = 0; i < s.water_lost.size(); ++i) {
    const double dz = at[2] - s.water_x[3 * i + 2];
    if (s.water_lost[i] || dz * dz >= reach2) continue;
    const double dx = at[0] - s.water_x[3 * i], dy = p.dimension == 3 ? at[1] - s.water_x[3 * i + 1] : 0.0;
    const double r2 = dx * dx + dy * dy + dz * dz;
    if (r2 >= reach2) continue;
    const double rho = p.water_density + s.water_excess[i], weight = mass / rho * kernel.value(std::sqrt(r2));
    filled += weight;
    sum += weight * (s.water_pressure[i] + rho * (p.gravity[0] * dx + p.gravity[1] * dy + p.gravity[2] * dz));
  }
  return filled >= 0.8 / (1 << p.dimension) ? float(sum / filled) : 0.f;
}

}  // namespace

std::vector<float> water_pressures(const ModelParameters& p, const ParticleState& s,
                                   const std::vector<std::array<double, 3>>& points) {
  std::vector<float> pressures;
  for (const auto& at : points) {
    if (p.dimension == 2)
      pressures.push_back(p.cubic_kernel ? water_pressure<CubicSpline<double, 2>>(p, s, at)
                                         : water_pressure<Wendland<double, 2>>(p, s, at));
    else
      pressures.push_back(p.cubic_kernel ? water_pressure<CubicSpline<double, 3>>(p, s, at)
                                         : water_pressure<Wendland<double, 3>>(p, s, at));
  }
  return pressures;
}

}  // namespace lgiw
