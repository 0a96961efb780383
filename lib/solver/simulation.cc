#include "solver/simulation.hh"

#include "solver/cpu_simulation.hh"

namespace lgiw {

std::unique_ptr<Simulation> make_cpu_simulation(const ModelParameters& p, const InitialParticles& particles, NumberType type) {
  const bool plane = p.dimension == 2;
  switch (type) {
    case NumberType::single_:
      return plane ? make_cpu<float, float, 2>(p, particles, type) : make_cpu<float, float, 3>(p, particles, type);
    case NumberType::double_:
      return plane ? make_cpu<double, double, 2>(p, particles, type) : make_cpu<double, double, 3>(p, particles, type);
    default:
      return plane ? make_cpu<double, float, 2>(p, particles, type) : make_cpu<double, float, 3>(p, particles, type);
  }
}

}  // namespace lgiw
