// Compiled once per number type and dimension (cpu_simulation_<type>.cc) to keep each translation unit short.
#pragma once

#include "solver/simulation.hh"

namespace lgiw {

template <class P, class T, int D>
std::unique_ptr<Simulation> make_cpu(const ModelParameters& p, const InitialParticles& particles, NumberType type);

}  // namespace lgiw
