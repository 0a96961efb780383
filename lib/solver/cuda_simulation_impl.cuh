#pragma once

#include "solver/cuda_backend.cuh"
#include "solver/cuda_simulation.hh"
#include "solver/particle_simulation.hh"

namespace lgiw {

template <class P, class T, int D>
std::unique_ptr<Simulation> make_cuda(const ModelParameters& p, const InitialParticles& particles, NumberType type) {
  if (p.cubic_kernel)
    return std::make_unique<ParticleSimulation<CudaBackend, Traits<P, T, D, CubicSpline, CudaDevice>>>(p, particles, type);
  return std::make_unique<ParticleSimulation<CudaBackend, Traits<P, T, D, Wendland, CudaDevice>>>(p, particles, type);
}

}  // namespace lgiw
