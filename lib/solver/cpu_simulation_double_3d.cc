#include "solver/cpu_simulation_impl.hh"

namespace lgiw {
template std::unique_ptr<Simulation> make_cpu<double, double, 3>(const ModelParameters&, const InitialParticles&,
                                                                 NumberType);
}  // namespace lgiw
