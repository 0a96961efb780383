// Pressure, density and stress of the particles at time zero (physics.md sections 2, 6 and 10).
#pragma once

#include <array>

#include "case/case.hh"

namespace lgiw {

/// Magnitude of the vertical component of gravity, m/s2. Hydrostatic states are layered along z also where a laboratory
/// scene tilts gravity: the tilt is then part of what the run has to balance.
double vertical_gravity(const Case& c);

/// Sound speed of the water, m/s: the case's own, or else ten times the largest speed to be expected, so that density
/// varies by 1 % at most (physics.md section 2). That speed is the larger of 2 sqrt(g d), the dam-break speed over the
/// deepest water d = max_depth (which makes 20 sqrt(g d)), and the speed with which the slide enters after its centre
/// has fallen drop_height (m, above the still water) along a slope of 45 degrees against its friction, sqrt(2 g H (1 -
/// tan phi)), or its initial speed, or that of the fastest rigid body (body_speed, m/s); this one capped at 3 sqrt(g
/// d): water shallower than the slide is fast only splashes. Returns 0 without water.
double water_sound_speed(const Case& c, double max_depth, double drop_height, double body_speed = 0);

/// Density at pressure p (Pa) of the Tait equation p = c^2 rho0/7 ((rho/rho0)^7 - 1), kg/m3.
double water_density(double pressure, double reference_density, double sound_speed);

/// K0 state of total stress (Pa, tension positive; xx yy zz xy yz xz) at `depth` below the top of its soil column:
/// sigma_zz = -(top_pressure + rho_s g depth), sigma_xx = sigma_yy = -[K0 (-sigma_zz - p_f) + p_f], K0 = 1 - sin phi.
/// The effective vertical stress is never tensile.
std::array<double, 6> k0_stress(const Case& c, double depth, double top_pressure, double pore_pressure);

}  // namespace lgiw
