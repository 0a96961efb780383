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
    // What has left keeps the height where it did, so that its leaving creates no energy.
    for (int k = 0; k < 3; ++k) s.potential -= mass * p.gravity[k] * x[3 * i + k];
    if (lost[i]) continue;
    s.mass += mass;
    double v2 = 0;
    for (int k = 0; k < 3; ++k) {
      const double u = v[3 * i + k], q = x[3 * i + k];
      v2 += u * u;
      s.momentum[k] += mass * u;
      s.moment[k] += mass * q;
    }
    s.kinetic += 0.5 * mass * v2;
    s.max_speed2 = std::max(s.max_speed2, v2);
    if (!bed.empty() && x[3 * i + 2] < bed.height(x[3 * i], x[3 * i + 1]) - 0.5 * p.dp) ++s.below_bed;
  }
  return s;
}

/// The value that all but a thousandth do not exceed; reorders `values`.
double percentile_999(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto at = values.begin() + long(0.999 * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Energy of an isotropic elastic body under the stresses [n,6]: sum V ((1 + nu) s:s - nu tr(s)^2) / 2E.
double elastic_energy(const ModelParameters& p, const ParticleState& s, double volume) {
  double sum = 0;
  for (std::size_t i = 0; i < s.soil_lost.size(); ++i) {
    if (s.soil_lost[i]) continue;
    double square = 0, trace = 0;
    for (int c = 0; c < 6; ++c) {
      const double stress = s.soil_stress[6 * i + c];
      square += (c < 3 ? 1 : 2) * stress * stress;
      if (c < 3) trace += stress;
    }
    sum += (1 + p.poisson_ratio) * square - p.poisson_ratio * trace * trace;
  }
  return volume * sum / (2 * p.young_modulus);
}

/// Soil particles by cells at least `reach` wide, over the box of the soil.
class SoilCells {
 public:
  SoilCells(const ParticleState& s, double reach) : width_(reach) {
    for (std::size_t i = 0; i < s.soil_lost.size(); ++i)
      for (int k = 0; k < 3 && !s.soil_lost[i]; ++k)
        low_[k] = std::min(low_[k], s.soil_x[3 * i + k]), high_[k] = std::max(high_[k], s.soil_x[3 * i + k]);
    if (!(low_[0] <= high_[0])) return;
    // A grain flung far must not make a grid larger than the particles.
    const double most = 4.0 * double(s.soil_lost.size() + s.water_lost.size()) + 1000;
    for (;; width_ *= 1.25) {
      double cells = 1;
      for (int k = 0; k < 3; ++k) cells *= n_[k] = int64_t((high_[k] - low_[k]) / width_) + 1;
      if (cells <= most) break;
    }
    start_.assign(std::size_t(n_[0] * n_[1] * n_[2]) + 1, 0);
    for (std::size_t i = 0; i < s.soil_lost.size(); ++i)
      if (!s.soil_lost[i]) ++start_[cell(s, i) + 1];
    for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    order_.resize(start_.back());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t i = 0; i < s.soil_lost.size(); ++i)
      if (!s.soil_lost[i]) order_[next[cell(s, i)]++] = i;
  }

  /// Calls f(j) for the soil particles j in the cells around x.
  template <class F>
  void near(const double* x, const F& f) const {
    int64_t from[3], to[3];
    for (int k = 0; k < 3; ++k) {
      if (!(x[k] > low_[k] - width_ && x[k] < high_[k] + width_)) return;
      const int64_t at = int64_t(std::floor((x[k] - low_[k]) / width_));
      from[k] = std::max<int64_t>(at - 1, 0), to[k] = std::min(at + 1, n_[k] - 1);
    }
    for (int64_t c = from[2]; c <= to[2]; ++c)
      for (int64_t b = from[1]; b <= to[1]; ++b) {
        const int64_t row = (c * n_[1] + b) * n_[0];
        if (from[0] > to[0]) continue;
        for (std::size_t q = start_[std::size_t(row + from[0])]; q < start_[std::size_t(row + to[0]) + 1]; ++q)
          f(order_[q]);
      }
  }

 private:
  std::size_t cell(const ParticleState& s, std::size_t i) const {
    int64_t at[3];
    for (int k = 0; k < 3; ++k) at[k] = std::min(int64_t((s.soil_x[3 * i + k] - low_[k]) / width_), n_[k] - 1);
    return std::size_t((at[2] * n_[1] + at[1]) * n_[0] + at[0]);
  }
  double width_;
  std::array<double, 3> low_{1e300, 1e300, 1e300}, high_{-1e300, -1e300, -1e300};
  std::array<int64_t, 3> n_{};
  std::vector<std::size_t> start_, order_;
};

}  // namespace

int64_t interpenetrating(const ModelParameters& p, const ParticleState& s) {
  const double reach = 1.5 * p.dp;
  const int enclosed = p.dimension == 2 ? 6 : 14;
  const SoilCells cells(s, reach);
  std::vector<int> water_near(s.soil_lost.size(), 0);
  int64_t count = 0;
  for (std::size_t i = 0; i < s.water_lost.size(); ++i) {
    if (s.water_lost[i]) continue;
    int soil_near = 0;
    const double* x = &s.water_x[3 * i];
    cells.near(x, [&](std::size_t j) {
      double r2 = 0;
      for (int k = 0; k < 3; ++k) r2 += (x[k] - s.soil_x[3 * j + k]) * (x[k] - s.soil_x[3 * j + k]);
      if (r2 < reach * reach) ++soil_near, ++water_near[j];
    });
    if (soil_near >= enclosed) ++count;
  }
  for (int n : water_near)
    if (n >= enclosed) ++count;
  return count;
}

DiagnosticsRow diagnose(const ModelParameters& p, const ParticleState& s, const StepState& st, const HeightField& bed) {
  const double volume = std::pow(p.dp, p.dimension);
  const bool water = !s.water_x.empty(), soil = !s.soil_x.empty();
  const Sums w = sum_up(p, s.water_x, s.water_v, s.water_lost, p.water_density * volume, bed);
  const Sums e = sum_up(p, s.soil_x, s.soil_v, s.soil_lost, p.soil_density * volume, bed);
  DiagnosticsRow row;
  row.emplace_back("step", double(st.step));
  row.emplace_back("time_step", st.dt);
  row.emplace_back("limited_by", st.limit);
  row.emplace_back("mass", w.mass + e.mass);
  const char* axes[3] = {"momentum_x", "momentum_y", "momentum_z"};
  for (int k = 0; k < 3; ++k)
    if (k != 1 || p.dimension == 3) row.emplace_back(axes[k], w.momentum[k] + e.momentum[k]);
  row.emplace_back("kinetic_energy", w.kinetic + e.kinetic);
  row.emplace_back("potential_energy", w.potential + e.potential);
  double total = w.kinetic + e.kinetic + w.potential + e.potential;
  if (soil) {
    const double elastic = elastic_energy(p, s, volume);
    row.emplace_back("elastic_energy", elastic);
    total += elastic;
  }
  if (water) {
    // Work of compressing rho0 dp^D from rho0 to rho: m int p/rho^2 drho, to second order in the compression.
    double compression = 0, error = 0;
    std::vector<double> errors;
    errors.reserve(s.water_excess.size());
    for (std::size_t i = 0; i < s.water_excess.size(); ++i) {
      if (s.water_lost[i]) continue;
      const double strain = s.water_excess[i] / p.water_density;
      compression += 0.5 * p.water_density * volume * p.sound_speed * p.sound_speed * strain * strain;
      error = std::max(error, std::fabs(strain));
      errors.push_back(std::fabs(strain));
    }
    total += compression;
    row.emplace_back("compression_energy", compression);
    row.emplace_back("max_water_speed", std::sqrt(w.max_speed2));
    row.emplace_back("mach_number", std::sqrt(w.max_speed2) / p.sound_speed);
    row.emplace_back("max_density_error", error);
    row.emplace_back("density_error_p999", percentile_999(errors));
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
    if (!speeds.empty()) mean /= double(speeds.size());
    row.emplace_back("max_soil_speed", percentile_999(speeds));
    row.emplace_back("mean_soil_speed", mean);
    row.emplace_back("max_adps", adps);
    const char* centre[3] = {"soil_x", "soil_y", "soil_z"};
    for (int k = 0; k < 3; ++k) row.emplace_back(centre[k], e.mass > 0 ? e.moment[k] / e.mass : 0);
    row.emplace_back("lost_soil", st.lost_soil);
  }
  row.emplace_back("total_energy", total);
  if (water && soil) row.emplace_back("interpenetrating", double(interpenetrating(p, s)));
  row.emplace_back("below_bed", double(w.below_bed + e.below_bed));
  return row;
}

}  // namespace lgiw
