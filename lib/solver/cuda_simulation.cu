#include "base/error.hh"
#include "solver/cuda_simulation.hh"

namespace lgiw {

namespace {

__global__ void probe() {}

}  // namespace

bool cuda_available(std::string* why) {
  // Any error means that there is nothing to run on: no driver answers with cudaErrorInsufficientDriver, a device for
  // which this build has no code with cudaErrorNoKernelImageForDevice.
  int count = 0;
  cudaFuncAttributes attributes;
  cudaError_t status = cudaGetDeviceCount(&count);
  if (status == cudaSuccess && count > 0) status = cudaFuncGetAttributes(&attributes, probe);
  if (status == cudaSuccess && count > 0) return true;
  if (why) *why = status == cudaSuccess ? "no device" : cudaGetErrorString(status);
  return false;
}

std::unique_ptr<Simulation> make_cuda_simulation(const ModelParameters& p, const InitialParticles& particles,
                                                 NumberType type) {
  std::string why;
  if (!cuda_available(&why))
    throw BackendError("--backend cuda is not possible (no CUDA device: " + why + ") use --backend cpu");
  const bool plane = p.dimension == 2;
  switch (type) {
    case NumberType::single_:
      return plane ? make_cuda<float, float, 2>(p, particles, type) : make_cuda<float, float, 3>(p, particles, type);
    case NumberType::double_:
      return plane ? make_cuda<double, double, 2>(p, particles, type)
                   : make_cuda<double, double, 3>(p, particles, type);
    default:
      return plane ? make_cuda<double, float, 2>(p, particles, type) : make_cuda<double, float, 3>(p, particles, type);
  }
}

}  // namespace lgiw
