// Compiled once per number type and dimension (cuda_simulation_<type>_<d>d.cu).
#pragma once

#include "solver/simulation.hh"

namespace lgiw {

template <class P, class T, int D>
std::unique_ptr<Simulation> make_cuda(const ModelParameters& p, const InitialParticles& particles, NumberType type);

}  // namespace lgiw
