// Pressure of the water at a point: what a pressure gauge reads.
#pragma once

#include <array>
#include <vector>

#include "solver/simulation.hh"

namespace lgiw {

/// Pressure at `points` (local, m; y is not used in 2-D), Pa, [points]. Shepard average over the water within 2h with
/// the hydrostatic term, p = sum V_j (p_j + rho_j g.(x - x_j)) W / sum V_j W, as the walls see it (physics.md section
/// 8), so that a gauge may lie on a wall. 0 where water fills less than 0.8 / 2^D of the kernel: D walls that meet at
/// right angles leave it 2^-D, and less than four fifths of that is spray, whose weak compressibility says nothing
/// about pressure. The result does not depend on the number of threads.
std::vector<float> water_pressures(const ModelParameters& p, const ParticleState& s,
                                   const std::vector<std::array<double, 3>>& points);

}  // namespace lgiw
