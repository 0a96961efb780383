// Sums and extremes of a state: the error budget of a run that needs no reference.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "files/height_field.hh"
#include "solver/simulation.hh"

namespace lgiw {

using DiagnosticsRow = std::vector<std::pair<std::string, double>>;

/// One row of the diagnostics table, in the order of its columns; SI units.
/// time_step s; mass kg (of what has not left); momentum_x/y/z kg m/s; kinetic_energy, potential_energy (above z = 0;
/// of what has left, where it left), compression_energy (of the water), elastic_energy (of the soil) J, and their sum
/// total_energy; with water: max_water_speed m/s, mach_number (of it), max_density_error |rho/rho0 - 1| and
/// density_error_p999, its 99.9th percentile, lost_water; with soil: max_soil_speed (99.9th percentile: one loose grain
/// is no slide), mean_soil_speed, max_adps, soil_x/y/z (centre of mass, local), lost_soil; with both: interpenetrating
/// (see below); below_bed: particles more than dp/2 below the bed.
DiagnosticsRow diagnose(const ModelParameters& p, const ParticleState& s, const StepState& st, const HeightField& bed);

/// Particles of soil and water that are enclosed by the other phase: that have within 1.5 dp at least three quarters of
/// the neighbours there on the full lattice (2-D: 6 of 8, 3-D: 14 of 18) from it. At rest there are none: along a plane
/// interface a particle has 3 or 5 such neighbours, in the corner of a block 5 or 12.
int64_t interpenetrating(const ModelParameters& p, const ParticleState& s);

}  // namespace lgiw
