// What an explicit step may not exceed.
#pragma once

namespace lgiw {

/// Largest delta c dt / h of a step with density or stress diffusion (delta the coefficient, c the wave speed).
/// Measured (docs/stability.md): leapfrog runs at 0.3 and breaks at 0.4. Verlet's central difference in time feeds on
/// what diffuses, the more the more neighbours there are: it breaks at once at 0.03; a dam break gains in 2-D a third
/// of the energy that it releases at 0.02, 1 % at 0.01, in 3-D 7 % at 0.01, 1 % at 0.0083 and 0.2 % at 0.0067.
constexpr double diffusive_limit(bool verlet) { return verlet ? 0.0065 : 0.3; }

/// The same of alpha c dt / h with artificial viscosity: Verlet runs at 0.1 and gains energy at 0.2; leapfrog runs at
/// 1, the largest CFL number, and no limit was found.
constexpr double viscous_limit(bool verlet) { return verlet ? 0.1 : 1; }

}  // namespace lgiw
