// A rigid block on planes: do walls and their friction depend on how they lie to the lattice of particles?
#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>

#include "case_run.hh"

namespace lgiw::test {
namespace {

constexpr double g = 9.81;

struct Slide {
  double acceleration, speed;  // along the plane, of the centre in the last three quarters of the time; at the end
};
/// A block of strong soil, 1 m x 0.25 m, on a plane `dip` degrees steep under gravity that leans by `lean` degrees
/// more: on the plane it is steep by their sum. What a code that knows no lattice does depends on the sum alone.
Slide block(double dip, double lean, double friction, const std::string& bed = "coulomb") {
  const double c = std::cos(dip * pi / 180), s = std::sin(dip * pi / 180), length = 4;
  std::ostringstream yaml;
  yaml.precision(12);
  const auto point = [&](double along, double up) {
    yaml << "[" << along * c + up * s << ", " << -along * s + up * c << "]";
  };
  yaml << "name: block\ndimension: 2\nparticle_spacing: 0.05\ngravity: [" << g * std::sin(lean * pi / 180) << ", 0, "
       << -g * std::cos(lean * pi / 180) << "]\nterrain: {profile: [[0, 0], ";
  point(length, 0);
  yaml << "], sides: {west: open, east: open}}\nslide: {bodies: [[";
  point(0.8, 0), yaml << ", ", point(1.8, 0), yaml << ", ", point(1.8, 0.25), yaml << ", ", point(0.8, 0.25);
  yaml << "]]}\nsoil: {density: 2000, friction_angle: 45, cohesion: 50000, young_modulus: 2e6, bed: " << bed;
  if (bed == "coulomb") yaml << ", bed_friction_angle: " << friction;
  yaml << "}\noutput: {end_time: 0.5}\n";
  CaseRun run(yaml.str());
  double st = 0, sv = 0, stt = 0, stv = 0, v = 0;
  const int first = 5, last = 20;
  for (int k = first; k <= last; ++k) {
    const double t = 0.025 * k;
    const ParticleState state = run.at(t);
    const double n = double(state.soil_v.size() / 3);
    v = 0;
    for (std::size_t i = 0; i < state.soil_v.size(); i += 3) v += (state.soil_v[i] * c - state.soil_v[i + 2] * s) / n;
    st += t, sv += v, stt += t * t, stv += t * v;
  }
  EXPECT_EQ(run.simulation->state().lost_soil, 0);
  const double n = last - first + 1;
  const Slide result{(n * stv - st * sv) / (n * stt - st * st), v};
  std::printf("measured: block, %s, delta %.0f, plane at %.0f degrees, gravity %.0f: %.3f m/s2\n", bed.c_str(),
              friction, dip, lean, result.acceleration);
  return result;
}
double expected(double steep, double friction) {
  return g * (std::sin(steep * pi / 180) - std::tan(friction * pi / 180) * std::cos(steep * pi / 180));
}

TEST(BlockOnAPlane, SlidesAsCoulombSaysWhateverTheLattice) {
  for (double dip : {0.0, 17.0, 35.0, 52.0})
    EXPECT_NEAR(block(dip, 35 - dip, 20).acceleration, expected(35, 20), 0.03 * expected(35, 20)) << dip;
}
TEST(BlockOnAPlane, SlidesOnSteeperAndGentlerPlanes) {
  for (double dip : {25.0, 60.0})
    EXPECT_NEAR(block(dip, 0, 15).acceleration, expected(dip, 15), 0.03 * expected(dip, 15)) << dip;
}
TEST(BlockOnAPlane, StandsWhereFrictionHoldsIt) {
  for (double dip : {0.0, 15.0, 33.0}) EXPECT_LT(std::fabs(block(dip, 15 - dip, 20).speed), 0.01) << dip;
}

}  // namespace
}  // namespace lgiw::test
