#include "solver/diagnostics.hh"

#include <algorithm>
#include <array>
#include <cmath>

namespace lgiw {
namespace {

struct Sums {
  double mass = 0, kinetic = 0, potential = 0, max_speed2 = 0;
  std::array<double, 3> momentum{}, moment{};
  int64_t below_bed = 0;
};

Sums sum_up(const ModelParameters& p, const std::vector<double>& x, const std::vector<float>& v,
            const std::vector<unsigned char>& lost, double mass, const HeightField& bed) {
  Sums s;
  const std::size_t n = x.size() / 3;
  for (std::size_t i = 0; i < n; ++i) {
    if (lost[i]) continue;
    s.mass += mass;
    double v2 = 0;
    for (int k = 0; k < 3; ++k) {
      const double u = v[3 * i + k], q = x[3 * i + k];
      v2 += u * u;
      s.momentum[k] += mass * u;
      s.moment[k] += mass * q;
      s.potential -= mass * p.gravity[k] * q;
    }
    s.kinetic += 0.5 * mass * v2;
    s.max_speed2 = std::max(s.max_speed2, v2);
    if (!bed.empty() && x[3 * i + 2] < bed.height(x[3 * i], x[3 * i + 1]) - 0.5 * p.dp) ++s.below_bed;
  }
  return s;
}

}  // namespace

std::vector<std::pair<std::string, double>> diagnose(const ModelParameters& p, const ParticleState& s,
                                                     const StepState& st, const HeightField& bed) {
  const double volume = std::pow(p.dp, p.dimension);
  const bool water = !s.water_x.empty(), soil = !s.soil_x.empty();
  const Sums w = sum_up(p, s.water_x, s.water_v, s.water_lost, p.water_density * volume, bed);
  const Sums e = sum_up(p, s.soil_x, s.soil_v, s.soil_lost, p.soil_density * volume, bed);
  std::vector<std::pair<std::string, double>> row;
  row.emplace_back("step", double(st.step));
  row.emplace_back("time_step", st.dt);
  row.emplace_back("limited_by", st.limit);
  row.emplace_back("mass", w.mass + e.mass);
  const char* axes[3] = {"momentum_x", "momentum_y", "momentum_z"};
  for (int k = 0; k < 3; ++k)
    if (k != 1 || p.dimension == 3) row.emplace_back(axes[k], w.momentum[k] + e.momentum[k]);
  row.emplace_back("kinetic_energy", w.kinetic + e.kinetic);
  row.emplace_back("potential_energy", w.potential + e.potential);
  if (water) {
    // Work of compressing rho0 dp^D from rho0 to rho: m int p/rho^2 drho, to second order in the compression.
    double compression = 0, error = 0;
    for (std::size_t i = 0; i < s.water_excess.size(); ++i) {
      if (s.water_lost[i]) continue;
      const double strain = s.water_excess[i] / p.water_density;
      compression += 0.5 * p.water_density * volume * p.sound_speed * p.sound_speed * strain * strain;
      error = std::max(error, std::fabs(strain));
    }
    row.emplace_back("compression_energy", compression);
    row.emplace_back("max_water_speed", std::sqrt(w.max_speed2));
    row.emplace_back("max_density_error", error);
    row.emplace_back("lost_water", st.lost_water);
  }
  if (soil) {
    std::vector<double> speeds;
    double adps = 0, mean = 0;
    for (std::size_t i = 0; i < s.soil_adps.size(); ++i) {
      if (s.soil_lost[i]) continue;
      const double u = std::hypot(double(s.soil_v[3 * i]), double(s.soil_v[3 * i + 1]), double(s.soil_v[3 * i + 2]));
      speeds.push_back(u);
      mean += u;
      adps = std::max(adps, double(s.soil_adps[i]));
    }
    double fast = 0;
    if (!speeds.empty()) {
      const auto at = speeds.begin() + long(0.999 * double(speeds.size() - 1));
      std::nth_element(speeds.begin(), at, speeds.end());
      fast = *at;
      mean /= double(speeds.size());
    }
    row.emplace_back("max_soil_speed", fast);
    row.emplace_back("mean_soil_speed", mean);
    row.emplace_back("max_adps", adps);
    const char* centre[3] = {"soil_x", "soil_y", "soil_z"};
    for (int k = 0; k < 3; ++k) row.emplace_back(centre[k], e.mass > 0 ? e.moment[k] / e.mass : 0);
    row.emplace_back("lost_soil", st.lost_soil);
  }
  row.emplace_back("below_bed", double(w.below_bed + e.below_bed));
  return row;
}

}  // namespace lgiw
