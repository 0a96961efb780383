// From a case and its particles to the numbers that a simulation is made from.
#pragma once

#include "case/case.hh"
#include "files/particle_file.hh"
#include "solver/setup.hh"
#include "solver/simulation.hh"

namespace lgiw {

/// Model parameters of a case, automatic values worked out:
/// - artificial viscosity of the soil: alpha c_s = 3 sqrt(g H), H the greatest height of a column of soil (physics.md
///   section 3: run-out depends on that product, 2 to 6 sqrt(g H) being its useful range);
/// - absorbing sides: damping rate 9 sqrt(g d)/width at the side, d the greatest water depth: a long wave that crosses
/// the zone
///   twice is left with exp(-3) of its height;
/// - settling: damping rate sqrt(g/dp) of the water, pi c_s/L of the soil, critical for the slowest elastic wave of a
/// body
///   of length L; its time, where the soil settles and none is given, 5 L/c_s: exp(-7) of such waves are left.
ModelParameters make_model(const Case& c, const ParticleData& data);
InitialParticles make_particles(const Case& c, const ParticleData& data);
/// A motion with its first and second derivatives, differences of the table: second order between its rows.
PrescribedMotion prescribed_motion(const BodyMotion& motion);
NumberType number_type(Precision precision);

}  // namespace lgiw
