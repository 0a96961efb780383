// Prescribed rigid motion against hand figures.
#include <gtest/gtest.h>

#include "physics/rigid_motion.hh"

namespace lgiw {
namespace {

const double pivot[3] = {10, 0, 5};

TEST(RigidMotion, RestsBeforeAndAfterItsTable) {
  const MotionRow rows[2] = {{0, {0, 0, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 0}},
                             {2, {2, 0, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 0}}};
  for (double t : {-1.0, 2.0, 3.0}) {
    const RigidState s = rigid_state(rows, 2, pivot, t);
    EXPECT_EQ(s.pivot[0], t < 0 ? 10 : 12);
    EXPECT_EQ(s.velocity[0], 0);
    EXPECT_EQ(s.acceleration[0], 0);
  }
  EXPECT_NEAR(rigid_state(rows, 2, pivot, 0.5).pivot[0], 10.5, 1e-14);
  EXPECT_NEAR(rigid_state(rows, 2, pivot, 0.5).velocity[0], 1, 1e-14);
}

// x = t^3: cubic, so the place and velocity of the table are exact between its rows; the acceleration 6 t is linear.
TEST(RigidMotion, RepeatsACubic) {
  MotionRow rows[4];
  for (int k = 0; k < 4; ++k) {
    const double t = 0.3 * k * k;
    rows[k] = {t, {t * t * t, 0, 0, 0}, {3 * t * t, 0, 0, 0}, {6 * t, 0, 0, 0}};
  }
  for (double t : {0.1, 0.3, 0.77, 2.5}) {
    const RigidState s = rigid_state(rows, 4, pivot, t);
    EXPECT_NEAR(s.pivot[0], 10 + t * t * t, 1e-12);
    EXPECT_NEAR(s.velocity[0], 3 * t * t, 1e-12);
    EXPECT_NEAR(s.acceleration[0], 6 * t, 1e-12);
  }
}

// Pitched by 90 degrees towards +x, what was 2 m ahead is 2 m below, and what was 1 m above is 1 m ahead.
TEST(RigidMotion, APositivePitchLowersTheSideAhead) {
  const double quarter = std::acos(-1.0) / 2;
  const MotionRow rows[1] = {{0, {0, 0, 0, quarter}, {0, 0, 0, 0}, {0, 0, 0, 0}}};
  RigidState s = rigid_state(rows, 1, pivot, 1);
  const double arm[3] = {2, 3, 1};
  double place[3], v[3], a[3], n[3];
  s.spin = 0.5, s.spin_rate = 0;
  rigid_point(s, 1, 0, arm, place, v, a);
  EXPECT_NEAR(place[0], 11, 1e-14);
  EXPECT_NEAR(place[1], 3, 1e-14);
  EXPECT_NEAR(place[2], 3, 1e-14);
  // relative to the pivot it is now at (1, -2): v = spin (z, -x), a = -spin^2 (x, z)
  EXPECT_NEAR(v[0], 0.5 * -2, 1e-14);
  EXPECT_NEAR(v[2], -0.5 * 1, 1e-14);
  EXPECT_NEAR(a[0], -0.25 * 1, 1e-14);
  EXPECT_NEAR(a[2], -0.25 * -2, 1e-14);
  const double up[3] = {0, 0, 1};
  rigid_direction(s, 1, 0, up, n);
  EXPECT_NEAR(n[0], 1, 1e-14);
  EXPECT_NEAR(n[2], 0, 1e-14);
}

}  // namespace
}  // namespace lgiw
