// How the SPH operators converge on disordered particles: manufactured fields on jittered, periodic lattices.
#pragma once

#include <vector>

#include "row.hh"

namespace lgiw::validation {

/// Relative L2 errors of pressure gradient, velocity divergence and strain rate (plain and corrected) on lattices of 20
/// to 160 particles a side that are displaced by up to a share of the spacing, and the observed orders between the two
/// finest. In double precision, 2-D, Wendland C2 with h = 1.5 and 2 dp, through the laws of lib/physics.
std::vector<Row> operator_rows();

}  // namespace lgiw::validation
