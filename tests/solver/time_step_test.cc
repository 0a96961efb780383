// The time step that dem2particles tells beforehand is the one that the solver takes.
#include <gtest/gtest.h>

#include "../tools/tool_runner.hh"
#include "case_run.hh"
#include "seeding/run_estimate.hh"

namespace lgiw::test {
namespace {

/// Expects the run's first step, at rest, to be that of the estimate but for what flow adds; returns what limits it.
int compare_first_step(const std::string& yaml) {
  const CaseRun run(yaml);
  const double sound_speed = run.data.header.sound_speed, height = run.p.soil_height;
  const StepState first = run.simulation->state();
  const StepEstimate expected = estimate_step(run.c, sound_speed, height, 0, 0);
  EXPECT_NEAR(first.dt, expected.dt, 1e-6 * expected.dt) << yaml;  // h in single precision
  EXPECT_EQ(first.limit, expected.limit) << yaml;
  const double told = estimate_run(run.c, run.data.header.counts, sound_speed, height, 1e6).time_step;
  EXPECT_LE(told, 1.000001 * first.dt) << yaml;
  EXPECT_GE(told, 0.9 * first.dt) << yaml;
  return first.limit;
}

TEST(TimeStep, IsTheOneThatTheEstimateTellsWithEitherIntegrator) {
  const std::string head = "name: n\ndimension: 2\nparticle_spacing: 0.02\n";
  const std::string tank = head + "terrain: {profile: [[0, 0], [0.4, 0]]}\nwater: {level: 0.2";
  const std::string heap = head +
                           "terrain: {profile: [[0, 0], [1, 0]]}\n"
                           "slide: {bodies: [[[0, 0], [0.2, 0], [0.2, 0.1], [0, 0.1]]]}\n"
                           "soil: {friction_angle: 30, young_modulus: 2e4";
  const std::string both = read_bytes(LGIW_TEST_DATA "/slide.yaml") + "numerics: {integrator: ";
  enum { acoustic, force, viscous, diffusive };
  for (const char* integrator : {"leapfrog", "verlet"}) {
    const bool verlet = integrator[0] == 'v';
    // At Verlet's default CFL number the acoustic limit hides the viscous one.
    const std::string tail =
        "}\nnumerics: {integrator: " + std::string(verlet ? "verlet, cfl: 0.2" : "leapfrog") + "}\n";
    EXPECT_EQ(compare_first_step(tank + tail), verlet ? diffusive : acoustic);
    EXPECT_EQ(compare_first_step(tank + ", density_diffusion: 0, viscosity_alpha: 0.9" + tail),
              verlet ? viscous : acoustic);
    EXPECT_EQ(compare_first_step(heap + tail), verlet ? diffusive : acoustic);
    EXPECT_EQ(compare_first_step(heap + ", stress_diffusion: 0" + tail), verlet ? viscous : acoustic);
    EXPECT_EQ(compare_first_step(heap + ", viscosity_alpha: 2" + tail), viscous);
    EXPECT_EQ(compare_first_step(both + integrator + "}\n"), verlet ? diffusive : acoustic);
  }
}

}  // namespace
}  // namespace lgiw::test
