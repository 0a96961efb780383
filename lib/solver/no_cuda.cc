// Stands in for the CUDA backend in builds without it.
#include "base/error.hh"
#include "solver/simulation.hh"

namespace lgiw {

bool cuda_available(std::string* why) {
  if (why) *why = "this build has no CUDA backend";
  return false;
}

std::unique_ptr<Simulation> make_cuda_simulation(const ModelParameters&, const InitialParticles&, NumberType) {
  throw BackendError(
      "--backend cuda is not possible (this build has no CUDA backend) rebuild where nvcc is, or use --backend cpu");
}

}  // namespace lgiw
