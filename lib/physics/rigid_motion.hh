// Prescribed motion of rigid bodies: a table of displacement and pitch, and from it where a point of the body is and
// how it moves.
#pragma once

#include "physics/vec.hh"

namespace lgiw {

/// A row of a motion table: time in s, the pivot's displacement in m, pitch in rad, and their first and second time
/// derivatives.
struct MotionRow {
  double time;
  double value[4], rate[4], rate2[4];  // x, y, z, pitch
};

/// A body's state at one time, as a point of it needs it.
struct RigidState {
  double pivot[3], velocity[3], acceleration[3];
  double cosine, sine, spin, spin_rate;
};

/// The state between two rows of a table: cubic Hermite in value and rate, so that the velocity is continuous and the
/// derivative of the place; the second derivative, which would jump, is interpolated linearly instead. Before the first
/// row and after the last one the body rests.
LGIW_FN RigidState rigid_state(const MotionRow* rows, int n, const double* pivot, double time) {
  double value[4], rate[4] = {0, 0, 0, 0}, rate2[4] = {0, 0, 0, 0};
  if (time < rows[0].time || n == 1) {
    for (int k = 0; k < 4; ++k) value[k] = rows[0].value[k];
  } else if (time >= rows[n - 1].time) {
    for (int k = 0; k < 4; ++k) value[k] = rows[n - 1].value[k];
  } else {
    int low = 0, high = n - 1;
    while (high - low > 1) {
      const int middle = (low + high) / 2;
      if (rows[middle].time <= time)
        low = middle;
      else
        high = middle;
    }
    const MotionRow &a = rows[low], &b = rows[high];
    const double span = b.time - a.time, s = (time - a.time) / span, s2 = s * s, s3 = s2 * s;
    for (int k = 0; k < 4; ++k) {
      const double rise = b.value[k] - a.value[k];
      value[k] = a.value[k] + (3 * s2 - 2 * s3) * rise + span * ((s3 - 2 * s2 + s) * a.rate[k] + (s3 - s2) * b.rate[k]);
      rate[k] = (6 * s - 6 * s2) * rise / span + (3 * s2 - 4 * s + 1) * a.rate[k] + (3 * s2 - 2 * s) * b.rate[k];
      rate2[k] = (1 - s) * a.rate2[k] + s * b.rate2[k];
    }
  }
  RigidState state;
  for (int k = 0; k < 3; ++k) {
    state.pivot[k] = pivot[k] + value[k];
    state.velocity[k] = rate[k], state.acceleration[k] = rate2[k];
  }
  state.cosine = std::cos(value[3]), state.sine = std::sin(value[3]);
  state.spin = rate[3], state.spin_rate = rate2[3];
  return state;
}

/// Place, velocity and acceleration of a point of a body. `arm` is its place relative to the pivot at pitch 0; the body
/// pitches in the vertical plane of the unit vector (ahead_x, ahead_y), and a positive pitch lowers the side ahead.
LGIW_FN void rigid_point(const RigidState& b, double ahead_x, double ahead_y, const double* arm, double* place,
                         double* velocity, double* acceleration) {
  const double along = arm[0] * ahead_x + arm[1] * ahead_y;
  const double a = along * b.cosine + arm[2] * b.sine, z = -along * b.sine + arm[2] * b.cosine;
  const double ahead[2] = {ahead_x, ahead_y};
  for (int k = 0; k < 2; ++k) {
    place[k] = b.pivot[k] + arm[k] + (a - along) * ahead[k];
    velocity[k] = b.velocity[k] + b.spin * z * ahead[k];
    acceleration[k] = b.acceleration[k] + (b.spin_rate * z - b.spin * b.spin * a) * ahead[k];
  }
  place[2] = b.pivot[2] + z;
  velocity[2] = b.velocity[2] - b.spin * a;
  acceleration[2] = b.acceleration[2] - b.spin_rate * a - b.spin * b.spin * z;
}

/// A direction of the body turned with it.
LGIW_FN void rigid_direction(const RigidState& b, double ahead_x, double ahead_y, const double* direction,
                             double* out) {
  const double along = direction[0] * ahead_x + direction[1] * ahead_y;
  const double a = along * b.cosine + direction[2] * b.sine;
  out[0] = direction[0] + (a - along) * ahead_x;
  out[1] = direction[1] + (a - along) * ahead_y;
  out[2] = -along * b.sine + direction[2] * b.cosine;
}

}  // namespace lgiw
