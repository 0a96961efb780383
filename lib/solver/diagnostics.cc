#include "solver/diagnostics.hh"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "base/ordered_blocks.hh"

namespace lgiw {
namespace {

struct Sums {
  double mass = 0, kinetic = 0, potential = 0, max_speed2 = 0;
  std::array<double, 3> momentum{}, moment{};
  int64_t below_bed = 0;
  void add(const Sums& o) {
    mass += o.mass, kinetic += o.kinetic, potential += o.potential, below_bed += o.below_bed;
    max_speed2 = std::max(max_speed2, o.max_speed2);
    for (std::size_t k = 0; k < 3; ++k) momentum[k] += o.momentum[k], moment[k] += o.moment[k];
  }
};

Sums sum_up(const ModelParameters& p, const std::vector<double>& x, const std::vector<float>& v,
            const std::vector<unsigned char>& lost, double mass, const HeightField& bed) {
  return over_blocks<Sums>(lost.size(), [&](std::size_t begin, std::size_t end) {
    Sums s;
    for (std::size_t i = begin; i < end; ++i) {
      // What has left keeps the height where it did, so that its leaving creates no energy.
      for (std::size_t k = 0; k < 3; ++k) s.potential -= mass * p.gravity[k] * x[3 * i + k];
      if (lost[i]) continue;
      s.mass += mass;
      double v2 = 0;
      for (std::size_t k = 0; k < 3; ++k) {
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
  });
}

/// Values of which the order does not matter.
struct Values {
  std::vector<double> list;
  void add(const Values& o) { list.insert(list.end(), o.list.begin(), o.list.end()); }
};
/// The value that all but a thousandth do not exceed, of value(i) for i in [0, n); negative ones do not count. 0 where
/// none does.
template <class Value>
double percentile_999(std::size_t n, const Value& value) {
  // Of many, only those are put in order that begin with the same bits as it: exponent and four bits of the fraction,
  // which order like the numbers.
  constexpr std::size_t kinds = 1 << 15, few = too_few_to_share;
  const auto kind = [](double v) { return std::size_t(std::bit_cast<uint64_t>(v + 0.0) >> 48); };  // no -0
  const auto rank = [](std::size_t count) { return std::size_t(0.999 * double(count - 1)); };
  std::size_t wanted = 0, before = 0;  // kind of the percentile; values of lower kinds
  std::size_t count = 0;
  if (n > few) {
    std::vector<std::size_t> counts(kinds, 0);
#pragma omp parallel
    {
      std::vector<std::size_t> mine(kinds, 0);
#pragma omp for schedule(static)
      for (std::size_t i = 0; i < n; ++i) {
        const double v = value(i);
        if (v >= 0) ++mine[kind(v)];
      }
#pragma omp critical(lgiw_percentile)
      for (std::size_t k = 0; k < kinds; ++k) counts[k] += mine[k];
    }
    count = std::accumulate(counts.begin(), counts.end(), std::size_t(0));
    if (count == 0) return 0;
    while (before + counts[wanted] <= rank(count)) before += counts[wanted++];
  }
  std::vector<double> list = over_blocks<Values>(n, [&](std::size_t begin, std::size_t end) {
                               Values of_block;
                               for (std::size_t i = begin; i < end; ++i) {
                                 const double v = value(i);
                                 if (v >= 0 && (n <= few || kind(v) == wanted)) of_block.list.push_back(v);
                               }
                               return of_block;
                             }).list;
  if (n <= few) count = list.size();
  if (count == 0) return 0;
  const auto at = list.begin() + long(rank(count) - before);
  std::nth_element(list.begin(), at, list.end());
  return *at;
}

/// A sum of one number a particle.
struct Sum {
  double value = 0;
  void add(const Sum& o) { value += o.value; }
};
/// Energy of an isotropic elastic body under the stresses [n,6]: sum V ((1 + nu) s:s - nu tr(s)^2) / 2E.
double elastic_energy(const ModelParameters& p, const ParticleState& s, double volume) {
  const Sum sum = over_blocks<Sum>(s.soil_lost.size(), [&](std::size_t begin, std::size_t end) {
    Sum of_block;
    for (std::size_t i = begin; i < end; ++i) {
      if (s.soil_lost[i]) continue;
      double square = 0, trace = 0;
      for (std::size_t c = 0; c < 6; ++c) {
        const double stress = s.soil_stress[6 * i + c];
        square += (c < 3 ? 1 : 2) * stress * stress;
        if (c < 3) trace += stress;
      }
      of_block.value += (1 + p.poisson_ratio) * square - p.poisson_ratio * trace * trace;
    }
    return of_block;
  });
  return volume * sum.value / (2 * p.young_modulus);
}

/// Soil particles by cells at least `reach` wide, over the box of the soil.
class SoilCells {
 public:
  SoilCells(const ParticleState& s, double reach) : width_(reach) {
    const Box box = over_blocks<Box>(s.soil_lost.size(), [&](std::size_t begin, std::size_t end) {
      Box of_block;
      for (std::size_t i = begin; i < end; ++i)
        if (!s.soil_lost[i]) of_block.add(&s.soil_x[3 * i], &s.soil_x[3 * i]);
      return of_block;
    });
    low_ = box.low, high_ = box.high;
    if (!(low_[0] <= high_[0])) return;
    // A grain flung far must not make a grid larger than the particles.
    const double most = double(s.soil_lost.size() + s.water_lost.size()) + 1000;
    for (;; width_ *= 1.25) {
      double cells = 1;
      for (std::size_t k = 0; k < 3; ++k) cells *= double(n_[k] = int64_t((high_[k] - low_[k]) / width_) + 1);
      if (cells <= most) break;
    }
    end_.assign(std::size_t(n_[0] * n_[1] * n_[2]), 0);
    const std::size_t n = s.soil_lost.size();
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < n; ++i) {
      if (s.soil_lost[i]) continue;
      uint32_t& count = end_[cell(s, i)];
#pragma omp atomic
      ++count;
    }
    uint32_t sum = 0;
    for (uint32_t& end : end_) {
      const uint32_t count = end;
      end = sum;
      sum += count;
    }
    order_.resize(sum);
    // The fill moves each beginning to its end. In no order within a cell: they are counted only.
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < n; ++i) {
      if (s.soil_lost[i]) continue;
      uint32_t &free = end_[cell(s, i)], at;
#pragma omp atomic capture
      at = free++;
      order_[at] = uint32_t(i);
    }
  }

  /// Calls f(j) for the soil particles j in the cells around x.
  template <class F>
  void near(const double* x, const F& f) const {
    int64_t from[3], to[3];
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(x[k] > low_[k] - width_ && x[k] < high_[k] + width_)) return;
      const int64_t at = int64_t(std::floor((x[k] - low_[k]) / width_));
      from[k] = std::max<int64_t>(at - 1, 0), to[k] = std::min(at + 1, n_[k] - 1);
    }
    for (int64_t c = from[2]; c <= to[2]; ++c)
      for (int64_t b = from[1]; b <= to[1]; ++b) {
        const int64_t row = (c * n_[1] + b) * n_[0];
        if (from[0] > to[0]) continue;
        const uint32_t end = end_[std::size_t(row + to[0])];
        for (uint32_t q = row + from[0] > 0 ? end_[std::size_t(row + from[0] - 1)] : 0; q < end; ++q) f(order_[q]);
      }
  }

 private:
  struct Box {
    std::array<double, 3> low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    void add(const double* from, const double* to) {
      for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], from[k]), high[k] = std::max(high[k], to[k]);
    }
    void add(const Box& o) { add(o.low.data(), o.high.data()); }
  };

  std::size_t cell(const ParticleState& s, std::size_t i) const {
    int64_t at[3];
    for (int k = 0; k < 3; ++k) at[k] = std::min(int64_t((s.soil_x[3 * i + k] - low_[k]) / width_), n_[k] - 1);
    return std::size_t((at[2] * n_[1] + at[1]) * n_[0] + at[0]);
  }
  double width_;
  std::array<double, 3> low_{}, high_{};
  std::array<int64_t, 3> n_{};
  std::vector<uint32_t> end_, order_;  // of the particles of each cell; their numbers
};

}  // namespace

int64_t interpenetrating(const ModelParameters& p, const ParticleState& s) {
  const double reach = 1.5 * p.dp;
  const int enclosed = p.dimension == 2 ? 6 : 14;
  const SoilCells cells(s, reach);
  std::vector<int> water_near(s.soil_lost.size(), 0);
  int64_t count = 0;
#pragma omp parallel for schedule(dynamic, 4096) reduction(+ : count)
  for (std::size_t i = 0; i < s.water_lost.size(); ++i) {
    if (s.water_lost[i]) continue;
    int soil_near = 0;
    const double* x = &s.water_x[3 * i];
    cells.near(x, [&](std::size_t j) {
      double r2 = 0;
      for (std::size_t k = 0; k < 3; ++k) r2 += (x[k] - s.soil_x[3 * j + k]) * (x[k] - s.soil_x[3 * j + k]);
      if (!(r2 < reach * reach)) return;
      ++soil_near;
      int& near = water_near[j];
#pragma omp atomic
      ++near;
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
    const double stiffness = 0.5 * p.water_density * volume * p.sound_speed * p.sound_speed;
    const auto strain = [&](std::size_t i) { return s.water_excess[i] / p.water_density; };
    const auto error_of = [&](std::size_t i) { return s.water_lost[i] ? -1 : std::fabs(strain(i)); };
    struct Strains {
      double energy = 0, largest = 0;
      void add(const Strains& o) { energy += o.energy, largest = std::max(largest, o.largest); }
    };
    const Strains strains = over_blocks<Strains>(s.water_lost.size(), [&](std::size_t begin, std::size_t end) {
      Strains of_block;
      for (std::size_t i = begin; i < end; ++i)
        if (!s.water_lost[i]) of_block.add({stiffness * strain(i) * strain(i), error_of(i)});
      return of_block;
    });
    total += strains.energy;
    row.emplace_back("compression_energy", strains.energy);
    row.emplace_back("max_water_speed", std::sqrt(w.max_speed2));
    row.emplace_back("mach_number", std::sqrt(w.max_speed2) / p.sound_speed);
    row.emplace_back("max_density_error", strains.largest);
    row.emplace_back("density_error_p999", percentile_999(s.water_lost.size(), error_of));
    row.emplace_back("lost_water", st.lost_water);
  }
  if (soil) {
    const auto speed_of = [&](std::size_t i) {
      const float* v = &s.soil_v[3 * i];
      return s.soil_lost[i] ? -1 : std::hypot(double(v[0]), double(v[1]), double(v[2]));
    };
    struct Slide {
      double speeds = 0, adps = 0;
      int64_t there = 0;
      void add(const Slide& o) { speeds += o.speeds, adps = std::max(adps, o.adps), there += o.there; }
    };
    const Slide slide = over_blocks<Slide>(s.soil_lost.size(), [&](std::size_t begin, std::size_t end) {
      Slide of_block;
      for (std::size_t i = begin; i < end; ++i)
        if (!s.soil_lost[i]) of_block.add({speed_of(i), double(s.soil_adps[i]), 1});
      return of_block;
    });
    row.emplace_back("max_soil_speed", percentile_999(s.soil_lost.size(), speed_of));
    row.emplace_back("mean_soil_speed", slide.there ? slide.speeds / double(slide.there) : 0);
    row.emplace_back("max_adps", slide.adps);
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
