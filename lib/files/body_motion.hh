// Rigid bodies that move as prescribed: slides of the laboratory, pistons, gates.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace lgiw {

/// Where a rigid body is at each time. A point that stands at p at t = 0 stands at time t at pivot + displacement(t) +
/// R (p - pivot), R the rotation by pitch(t) about the horizontal axis through the pivot that is perpendicular to the
/// heading. Between the times displacement and pitch are interpolated by whoever moves the body; before the first and
/// after the last the body rests there.
struct BodyMotion {
  std::string name;
  std::array<double, 3> pivot{};  // m, local coordinates, at t = 0
  double heading = 90;            // degrees clockwise from north: the direction in plan in which it pitches; 90: +x
  std::vector<double> time;       // s, strictly rising, the first at or before 0
  std::vector<double> pitch;      // rad; > 0 lowers the side towards the heading, which increases the dip of a slide
  std::vector<std::array<double, 3>> displacement;  // m, of the pivot
};

/// Reads time, displacement and pitch from a CSV file (csv_table.hh) with one of these headers (the pitch may be left
/// out, and is 0): t_s,dx_m,dz_m,pitch_deg or t_s,dx_m,dy_m,dz_m,pitch_deg. Name, pivot and heading stay as they are by
/// default.
///
/// Throws InputError, of a row with `path:line`, for what is no such table, another header, missing numbers, times that
/// do not rise or begin after 0, and motions that are not at rest at the place at t = 0: displacement and pitch must
/// pass through 0 there, since the case says where the body is at t = 0. With dimension 2 also for a dy_m that is not
/// 0.
BodyMotion read_motion_csv(const std::string& path, int dimension);

/// What is wrong with a motion ("" where nothing is): numbers that are not finite, lists of different lengths or empty,
/// times that do not rise or begin after 0, no name.
std::string fault_of(const BodyMotion& motion);

}  // namespace lgiw
