// One variant of the CPU solver. The build defines LGIW_P and LGIW_T (number types of positions and of all else),
// LGIW_D (the dimension) and LGIW_LANES.
#include "solver/cpu_simulation.hh"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <new>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/error.hh"
#include "physics/gradient_correction.hh"
#include "physics/interface.hh"
#include "physics/kernel.hh"
#include "physics/rigid_motion.hh"
#include "physics/soil.hh"
#include "physics/water.hh"
#include "solver/backend_array.hh"
#include "solver/grid.hh"
#include "solver/machine.hh"

// From here on, for the processor (machine.hh says what may follow).
#if LGIW_LANES == 16
#pragma GCC target("arch=x86-64-v4,prefer-vector-width=512")
#elif LGIW_LANES == 8
#pragma GCC target("arch=x86-64-v3")
#endif

#include "solver/openmp_backend.hh"
#include "solver/particle_simulation.hh"

namespace lgiw {

template <class P, class T, int D, int lanes>
std::unique_ptr<Simulation> make_cpu(const ModelParameters& p, const InitialParticles& particles, NumberType type) {
  using Machine = Cpu<lanes>;
  if (p.cubic_kernel)
    return std::make_unique<ParticleSimulation<OpenMpBackend<Machine>, Traits<P, T, D, CubicSpline, Machine>>>(
        p, particles, type);
  return std::make_unique<ParticleSimulation<OpenMpBackend<Machine>, Traits<P, T, D, Wendland, Machine>>>(p, particles,
                                                                                                          type);
}
template std::unique_ptr<Simulation> make_cpu<LGIW_P, LGIW_T, LGIW_D, LGIW_LANES>(const ModelParameters&,
                                                                                  const InitialParticles&, NumberType);

}  // namespace lgiw
