#include "solver/particle_state.hh"

#include "base/ordered_blocks.hh"
#include "physics/water.hh"

namespace lgiw {

template <std::size_t width, class To, class From>
void bring_by_id(const unsigned* id, std::size_t n, const From* const (&values)[width], std::vector<To>& to) {
  to.resize(width * n);
#pragma omp parallel for schedule(static) if (n > too_few_to_share)
  for (std::size_t i = 0; i < n; ++i) {
    To* const row = to.data() + width * id[i];
    for (std::size_t k = 0; k < width; ++k) row[k] = values[k] ? To(values[k][i]) : To(0);
  }
}

void lost_by_id(const unsigned* id, std::size_t n, std::size_t there, std::vector<unsigned char>& lost) {
  lost.assign(n, 0);
  for (std::size_t i = there; i < n; ++i) lost[id[i]] = 1;
}

void pressures_at(const std::vector<float>& excess, double density, double sound_speed, std::vector<float>& pressure) {
  const EquationOfState<double> eos(density, sound_speed);
  const std::size_t n = excess.size();
  pressure.resize(n);
#pragma omp parallel for schedule(static) if (n > too_few_to_share)
  for (std::size_t i = 0; i < n; ++i) pressure[i] = float(eos.pressure(double(excess[i])));
}

#define LGIW_BY_ID(width, To, From) \
  template void bring_by_id(const unsigned*, std::size_t, const From* const(&)[width], std::vector<To>&);
LGIW_BY_ID(1, float, float)
LGIW_BY_ID(1, float, double)
LGIW_BY_ID(3, float, float)
LGIW_BY_ID(3, float, double)
LGIW_BY_ID(3, double, float)
LGIW_BY_ID(3, double, double)
LGIW_BY_ID(6, float, float)
LGIW_BY_ID(6, float, double)
#undef LGIW_BY_ID

}  // namespace lgiw
