#include "solver/cuda_simulation_impl.cuh"

namespace lgiw {
template std::unique_ptr<Simulation> make_cuda<double, float, 2>(const ModelParameters&, const InitialParticles&,
                                                                 NumberType);
}  // namespace lgiw
