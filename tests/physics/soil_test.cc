#include "physics/soil.hh"

#include <gtest/gtest.h>

#include "physics/kernel.hh"

namespace lgiw {
namespace {

constexpr double degree = pi / 180;
using S2 = Stress<double, 2>;
using S3 = Stress<double, 3>;

TEST(DruckerPrager, ConstantsOfTheTable) {
  const double phi = 25 * degree, psi = 5 * degree, c = 1000;
  const SoilMaterial<double> associated(1e6, 0.3, phi, c, 0, Cone::plane_strain_associated);
  EXPECT_NEAR(associated.alpha_phi, std::tan(phi) / std::sqrt(9 + 12 * std::pow(std::tan(phi), 2)), 1e-15);
  const SoilMaterial<double> exact(1e6, 0.3, phi, c, 0, Cone::plane_strain);
  EXPECT_NEAR(exact.alpha_phi, std::sin(phi) / 3, 1e-15);
  EXPECT_NEAR(exact.k_c, c * std::cos(phi), 1e-12);
  const SoilMaterial<double> dilatant(1e6, 0.3, phi, c, psi, Cone::plane_strain);
  const double a = std::tan(psi) / std::sqrt(9 + 12 * std::pow(std::tan(psi), 2)), b = std::sqrt(1 - 3 * a * a);
  EXPECT_NEAR(dilatant.alpha_phi, std::sin(phi) / (3 * (b + a * std::sin(phi))), 1e-15);
  // With psi = phi the exact constants are the associated ones.
  const SoilMaterial<double> same(1e6, 0.3, phi, c, phi, Cone::plane_strain);
  EXPECT_NEAR(same.alpha_phi, associated.alpha_phi, 1e-12);
  EXPECT_NEAR(same.k_c, associated.k_c, 1e-9);
  const SoilMaterial<double> cone(1e6, 0.3, phi, c, 0, Cone::compression);
  EXPECT_NEAR(cone.alpha_phi, 2 * std::sin(phi) / (std::sqrt(3.0) * (3 - std::sin(phi))), 1e-15);
}

/// Shears a plane-strain element at constant vertical stress ratio until it flows; returns the mobilised friction
/// angle.
double mobilised_friction(Cone cone, double phi) {
  const SoilMaterial<double> m(1e7, 0.3, phi, 0, 0, cone);
  S2 s{{-1e5, -1e5, 0, -1e5}};
  const double l[4] = {0, 0.01, 0.01, 0};  // pure shear at constant volume
  for (int k = 0; k < 20000; ++k) {
    const S2 d = elastic_increment(m, s, l, 0.01);
    for (int c = 0; c < 4; ++c) s.c[c] += d.c[c];
    return_mapping(m, s, 0.0);
  }
  const double radius = std::hypot(0.5 * (s.c[0] - s.c[1]), s.c[2]), centre = 0.5 * (s.c[0] + s.c[1]);
  return std::asin(radius / -centre) / degree;
}
TEST(DruckerPrager, ExactPlaneStrainConstantsMobiliseTheFrictionAngle) {
  EXPECT_NEAR(mobilised_friction(Cone::plane_strain, 25 * degree), 25, 0.05);
  EXPECT_NEAR(mobilised_friction(Cone::plane_strain_associated, 25 * degree), 24.2, 0.1);  // physics.md section 4
  EXPECT_NEAR(mobilised_friction(Cone::plane_strain_associated, 35 * degree), 33.0, 0.1);
  EXPECT_NEAR(mobilised_friction(Cone::compression, 25 * degree), 34.6, 0.1);
}

TEST(ReturnMapping, ElasticStressIsLeftAlone) {
  const SoilMaterial<double> m(1e6, 0.3, 30 * degree, 0, 0, Cone::plane_strain);
  S3 s{{-1000, -1000, -1100, 10, 0, 0}};
  const S3 before = s;
  EXPECT_EQ(return_mapping(m, s, 0.0), 0);
  for (int c = 0; c < 6; ++c) EXPECT_EQ(s.c[c], before.c[c]);
}
TEST(ReturnMapping, EndsOnTheConeAlongTheFlowDirection) {
  const SoilMaterial<double> m(1e6, 0.3, 30 * degree, 100, 10 * degree, Cone::plane_strain);
  S3 s{{-1000, -4000, -900, 700, -300, 200}};
  const Deviator<double, 3> trial(s);
  const double f = yield_function(m, trial.i1, trial.root_j2, 0.0);
  ASSERT_GT(f, 0);
  const double adps = return_mapping(m, s, 0.0);
  const Deviator<double, 3> now(s);
  EXPECT_NEAR(yield_function(m, now.i1, now.root_j2, 0.0), 0, 1e-9 * std::fabs(now.i1));
  const double lambda = f / (m.shear + 9 * m.bulk * m.alpha_phi * m.alpha_psi);
  EXPECT_NEAR(now.i1, trial.i1 - 9 * m.bulk * m.alpha_psi * lambda, 1e-8);
  EXPECT_NEAR(adps, lambda * std::sqrt(1.0 / 3 + 2 * m.alpha_psi * m.alpha_psi), 1e-15);
}
TEST(ReturnMapping, TensionOfDrySandGoesToTheApex) {
  const SoilMaterial<double> m(1e6, 0.3, 30 * degree, 0, 0, Cone::plane_strain);
  S2 s{{500, 400, 100, 300}};
  const Deviator<double, 2> trial(s);
  const double adps = return_mapping(m, s, 0.0);
  for (double c : s.c) EXPECT_NEAR(c, 0, 1e-9);
  const double shear = trial.root_j2 / m.shear, volume = trial.i1 / (3 * m.bulk);
  EXPECT_NEAR(adps, std::sqrt(2.0 / 3 * (0.5 * shear * shear + volume * volume / 3)), 1e-15);
}
TEST(ReturnMapping, PorePressureTakesStrengthAway) {
  const SoilMaterial<double> m(1e6, 0.3, 30 * degree, 0, 0, Cone::plane_strain);
  S2 dry{{-1000, -2000, 0, -1500}}, wet = dry;
  EXPECT_EQ(return_mapping(m, dry, 0.0), 0);
  EXPECT_GT(return_mapping(m, wet, 1200.0), 0);
  const Deviator<double, 2> now(wet);
  EXPECT_NEAR(now.root_j2, -m.alpha_phi * (now.i1 + 3600), 1e-9);
}
TEST(ReturnMapping, UndrainedClayHasNoApex) {
  const SoilMaterial<double> m(1e6, 0.3, 0, 5000, 0, Cone::plane_strain);
  S2 s{{8000, 9000, 20000, 8000}};
  return_mapping(m, s, 0.0);
  const Deviator<double, 2> now(s);
  EXPECT_NEAR(now.root_j2, 5000, 1e-6);
  EXPECT_NEAR(now.i1, 25000, 1e-6);
}

/// Shears an element at the rate gamma (1/s) and constant mean pressure until it flows, in steps of dt; returns
/// sqrt(J2)/p.
double steady_mu(double gamma, double pressure, double dt, double dilatancy = 0) {
  const auto soil = [&](double phi) {
    return SoilMaterial<double>(1e7, 0.3, phi, 0, dilatancy * degree, Cone::plane_strain);
  };
  const SoilMaterial<double> m = soil(25 * degree);
  const RateStrength<double> rate(m, soil(36 * degree), 0.279, 0.001, 2650);
  S2 s{{-pressure, -pressure, 0, -pressure}};
  for (double strain = 0; strain < 0.1; strain += gamma * dt) {
    const double l[4] = {0, gamma, 0, 0};
    const S2 d = elastic_increment(m, s, l, dt);
    for (int c = 0; c < 4; ++c) s.c[c] += d.c[c];
    return_mapping(m, rate, s, 0.0, dt);
    add_isotropic(s, -pressure - trace(s) / 3);  // dilatancy would raise it
  }
  return Deviator<double, 2>(s).root_j2 / pressure;
}
TEST(RateStrength, SimpleShearGivesMuOfI) {
  for (double gamma : {0.1, 3.0, 30.0, 1000.0})
    for (double pressure : {200.0, 5000.0})
      for (double dt : {1e-5, 1e-3}) {
        if (gamma * dt > 0.01) continue;  // it would be sheared through in a few steps
        const double i = gamma * 0.001 * std::sqrt(2650 / pressure);
        const double slow = std::sin(25 * degree), fast = std::sin(36 * degree);
        EXPECT_NEAR(steady_mu(gamma, pressure, dt), slow + (fast - slow) / (0.279 / i + 1), 5e-4)
            << gamma << " /s, " << pressure << " Pa, " << dt << " s";
      }
}
TEST(RateStrength, IsTheRateIndependentMappingWhenSlowAndTheFastSoilInOneStep) {
  const auto soil = [](double phi, double psi) {
    return SoilMaterial<double>(1e7, 0.3, phi * degree, 300, psi * degree, Cone::plane_strain);
  };
  for (double psi : {0.0, 8.0}) {
    const SoilMaterial<double> m = soil(25, psi), fast = soil(36, psi);
    const RateStrength<double> rate(m, fast, 0.279, 0.001, 2650);
    const S2 trial{{-1e4, -3e4, 9e3, -2e4}};
    S2 expected = trial, s = trial;
    const double adps = return_mapping(m, expected, 0.0);
    ASSERT_GT(adps, 0);
    EXPECT_NEAR(return_mapping(m, rate, s, 0.0, 1e9), adps, 1e-6 * adps);
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(s.c[c], expected.c[c], 1e-2);
    s = trial;  // infinitely fast: on the cone of the fast soil's alpha_phi, along the slow one's flow direction
    return_mapping(m, rate, s, 0.0, 1e-12);
    const Deviator<double, 2> now(s);
    EXPECT_NEAR(now.root_j2, m.k_c - fast.alpha_phi * now.i1, 1e-6 * now.root_j2);
  }
}
TEST(RateStrength, TensionGoesToTheApexAsWithout) {
  const SoilMaterial<double> m(1e6, 0.3, 30 * degree, 0, 0, Cone::plane_strain);
  const SoilMaterial<double> fast(1e6, 0.3, 40 * degree, 0, 0, Cone::plane_strain);
  S2 s{{500, 400, 100, 300}};
  EXPECT_GT(return_mapping(m, RateStrength<double>(m, fast, 0.279, 0.001, 2650), s, 0.0, 1e-4), 0);
  for (double c : s.c) EXPECT_NEAR(c, 0, 1e-9);
}

TEST(Elasticity, ConfinedCompressionAndPlaneStrain) {
  const double e = 1e6, nu = 0.3;
  const SoilMaterial<double> m(e, nu, 0.5, 0, 0, Cone::plane_strain);
  const double l[4] = {0, 0, 0, -0.01};
  const S2 d = elastic_increment(m, S2{{0, 0, 0, 0}}, l, 0.1);
  const double confined = e * (1 - nu) / ((1 + nu) * (1 - 2 * nu)), across = confined * nu / (1 - nu);
  EXPECT_NEAR(d.c[1], -0.001 * confined, 1e-9);
  EXPECT_NEAR(d.c[0], -0.001 * across, 1e-9);
  EXPECT_NEAR(d.c[3], -0.001 * across, 1e-9);  // out of plane
  EXPECT_NEAR(SoilMaterial<double>::wave_speed(e, nu, 2000), std::sqrt(confined / 2000), 1e-12);
}
TEST(Elasticity, RigidRotationTurnsTheStress) {
  const SoilMaterial<double> m(1e6, 0.3, 0.5, 0, 0, Cone::plane_strain);
  S3 s{{-1000, -3000, -500, 0, 0, 0}};
  const int steps = 20000;
  const double w = pi / 2 / steps;  // a quarter turn about z
  const double l[9] = {0, -w, 0, w, 0, 0, 0, 0, 0};
  for (int k = 0; k < steps; ++k) {
    const S3 d = elastic_increment(m, s, l, 1.0);
    for (int c = 0; c < 6; ++c) s.c[c] += d.c[c];
  }
  EXPECT_NEAR(s.c[0], -3000, 1);
  EXPECT_NEAR(s.c[1], -1000, 1);
  EXPECT_NEAR(s.c[3], 0, 1);
  EXPECT_NEAR(s.c[2], -500, 1e-9);
}

TEST(RateForm, ConvergesToTheReturnMapping) {
  const SoilMaterial<double> m(1e7, 0.3, 25 * degree, 500, 0, Cone::plane_strain);
  const double l[4] = {0.002, 0.01, 0.004, -0.003};
  auto end = [&](bool rate, int steps) {
    S2 s{{-1e5, -1.5e5, 0, -1.2e5}};
    double adps = 0;
    for (int k = 0; k < steps; ++k) {
      const double dt = 2.0 / steps;
      const S2 d = elastic_increment(m, s, l, dt);
      if (rate) {
        adps += rate_form_update(m, s, d, l, dt, 0.0);
      } else {
        for (int c = 0; c < 4; ++c) s.c[c] += d.c[c];
        adps += return_mapping(m, s, 0.0);
      }
    }
    return std::make_pair(s, adps);
  };
  const auto [s1, a1] = end(true, 100000);
  const auto [s2, a2] = end(false, 100000);
  EXPECT_GT(a2, 1e-3);
  EXPECT_NEAR(a1, a2, 0.01 * a2);
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(s1.c[c], s2.c[c], 2e-3 * std::fabs(trace(s2)));
}

/// At the tip of the cone the deviator is what rounding has left, and so must not give the direction of plastic flow.
TEST(RateForm, DoesNotFollowRoundingAtTheApex) {
  const SoilMaterial<double> m(2e6, 0.3, 25 * degree, 50, 5 * degree, Cone::plane_strain);
  const double tip = m.k_c / m.alpha_phi / 3, rounding = 1e-10, l[4] = {0.1, 0.3, 0.2, 0.05};
  S2 one{{tip + rounding, tip - rounding, rounding, tip}}, other{{tip - rounding, tip + rounding, -rounding, tip}};
  const S2 increment = elastic_increment(m, one, l, 1e-4);
  const double adps = rate_form_update(m, one, increment, l, 1e-4, 0.0);
  EXPECT_NEAR(rate_form_update(m, other, increment, l, 1e-4, 0.0), adps, 1e-12);
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(one.c[c], other.c[c], 1e-6) << c;
}

TEST(ArtificialStress, OpposesTensilePrincipalStressesOnly) {
  const double scale = 0.5;
  const S2 plane = artificial_stress(S2{{300, -100, 0, 50}}, scale);
  EXPECT_NEAR(plane.c[0], -150, 1e-12);
  EXPECT_NEAR(plane.c[1], 0, 1e-12);
  // The same principal stresses turned by 30 degrees in 3-D.
  const double c = std::cos(30 * degree), s = std::sin(30 * degree);
  const S3 turned =
      artificial_stress(S3{{300 * c * c - 100 * s * s, 300 * s * s - 100 * c * c, -20, 400 * c * s, 0, 0}}, scale);
  EXPECT_NEAR(turned.c[0], -150 * c * c, 1e-9);
  EXPECT_NEAR(turned.c[1], -150 * s * s, 1e-9);
  EXPECT_NEAR(turned.c[3], -150 * c * s, 1e-9);
  EXPECT_NEAR(turned.c[2], 0, 1e-9);
}
TEST(Tensor, ReflectionInAMirror) {
  const Vec<double, 3> n{{1, 0, 0}};
  const S3 r = reflect(S3{{1, 2, 3, 4, 5, 6}}, n);
  const double expected[6] = {1, 2, 3, -4, 5, -6};
  for (int c = 0; c < 6; ++c) EXPECT_NEAR(r.c[c], expected[c], 1e-14);
}

}  // namespace
}  // namespace lgiw
