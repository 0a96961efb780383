// How many neighbours particles have: what a particle-step costs, and what a search for neighbours is measured by.
#pragma once

#include <cstddef>
#include <vector>

namespace lgiw {

/// Particles nearer than `reach` to one of the first `moving` of xyz ([n,3]), itself left out, on average: over all of
/// them, or over some 100,000 spread evenly among more. 0 where none moves.
double mean_neighbours(const std::vector<double>& xyz, std::size_t moving, double reach);

}  // namespace lgiw
