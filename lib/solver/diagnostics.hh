// Sums and extremes of a state: the error budget of a run that needs no reference.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "files/height_field.hh"
#include "solver/simulation.hh"

namespace lgiw {

/// One row of the diagnostics table, in the order of its columns; SI units.
/// time_step s; mass kg (of what has not left); momentum_x/y/z kg m/s; kinetic_energy, potential_energy (above z = 0),
/// compression_energy (of the water) J; with water: max_water_speed m/s, max_density_error |rho/rho0 - 1|, lost_water;
/// with soil: max_soil_speed (99.9th percentile: one loose grain is no slide), mean_soil_speed, max_adps, soil_x/y/z
/// (centre of mass, local), lost_soil; below_bed: particles more than dp/2 below the bed.
std::vector<std::pair<std::string, double>> diagnose(const ModelParameters& p, const ParticleState& s,
                                                     const StepState& st, const HeightField& bed);

}  // namespace lgiw
