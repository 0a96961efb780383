// The CPU solver, compiled once per number type, dimension and instruction set (cpu_simulation.cc), which keeps each
// translation unit short.
#pragma once

#include "solver/simulation.hh"

namespace lgiw {

/// lanes: floats in a vector of the instruction set; 4, 8 (AVX2 and FMA) or 16 (AVX-512).
template <class P, class T, int D, int lanes>
std::unique_ptr<Simulation> make_cpu(const ModelParameters& p, const InitialParticles& particles, NumberType type);

}  // namespace lgiw
