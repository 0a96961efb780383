#include "solver/simulation.hh"

#include <string>

#include "base/error.hh"
#include "solver/cpu_simulation.hh"

namespace lgiw {
namespace {

/// The pair loops are compiled for one instruction set; say so before the first of them meets an older processor.
void check_processor() {
#if defined(__x86_64__)
  const std::string arch = LGIW_CPU_ARCH;
  bool able = true;
  if (arch == "x86-64-v3") able = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (arch == "x86-64-v4") able = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl");
  if (!able)
    throw BackendError("--backend cpu is not possible (this processor lacks the instructions of " + arch +
                       ") configure the build with -DLGIW_CPU_ARCH=x86-64");
#endif
}

}  // namespace

std::unique_ptr<Simulation> make_cpu_simulation(const ModelParameters& p, const InitialParticles& particles,
                                                NumberType type) {
  check_processor();
  const bool plane = p.dimension == 2;
  switch (type) {
    case NumberType::single_:
      return plane ? make_cpu<float, float, 2>(p, particles, type) : make_cpu<float, float, 3>(p, particles, type);
    case NumberType::double_:
      return plane ? make_cpu<double, double, 2>(p, particles, type) : make_cpu<double, double, 3>(p, particles, type);
    default:
      return plane ? make_cpu<double, float, 2>(p, particles, type) : make_cpu<double, float, 3>(p, particles, type);
  }
}

}  // namespace lgiw
