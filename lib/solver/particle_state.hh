// Makes a ParticleState of what the solver holds in its own order: by all threads, and compiled once for all
// processors.
#pragma once

#include <cstddef>
#include <vector>

namespace lgiw {

/// to[width * id[i] + k] = values[k][i] for i in [0, n); 0 where values[k] is null. `id` names each of the n once. For
/// the types and widths that particle_state.cc lists.
template <std::size_t width, class To, class From>
void bring_by_id(const unsigned* id, std::size_t n, const From* const (&values)[width], std::vector<To>& to);
/// lost[id[i]]: 1 for those from `there` on.
void lost_by_id(const unsigned* id, std::size_t n, std::size_t there, std::vector<unsigned char>& lost);
/// Pressures (Pa) at the excess densities (kg/m3) of water of `density` (kg/m3) and `sound_speed` (m/s).
void pressures_at(const std::vector<float>& excess, double density, double sound_speed, std::vector<float>& pressure);

}  // namespace lgiw
