#include "solver/cpu_simulation_impl.hh"

namespace lgiw {
template std::unique_ptr<Simulation> make_cpu<float, float, 2>(const ModelParameters&, const InitialParticles&,
                                                               NumberType);
}  // namespace lgiw
