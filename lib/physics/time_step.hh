// What an explicit step may not exceed.
#pragma once

namespace lgiw {

/// Largest delta c dt / h of a step with density or stress diffusion (delta the coefficient, c the wave speed). Measured
/// (docs/stability.md): leapfrog runs at 0.3 and breaks at 0.4; Verlet runs at 0.02 and breaks at 0.03, since its
/// central difference in time feeds on what diffuses.
constexpr double diffusive_limit(bool verlet) { return verlet ? 0.02 : 0.3; }

}  // namespace lgiw
