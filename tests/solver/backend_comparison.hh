// Scenes that together need every pass, and a backend's results in them against the CPU's.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "cloud.hh"

namespace lgiw::test {

struct Scene {
  const char* name;
  Cloud cloud;
  bool settling = false;
  /// Plastic or not is decided by a threshold (the rate form of huang2023): in single precision rounding decides
  /// otherwise for some particle sooner or later, and what follows differs by a thousandth.
  bool by_threshold = false;
};
inline Cloud with(Cloud c, void (*change)(ModelParameters&)) {
  change(c.p);
  return c;
}
inline void by_verlet(ModelParameters& p) { p.verlet = true, p.cfl = 0.1; }
inline void shifting(ModelParameters& p) { p.shifting = 2; }
inline Cloud without_water(Cloud c) {
  c.in.water_x.clear(), c.in.water_v.clear(), c.in.water_excess.clear();
  return c;
}
inline Cloud without_soil(Cloud c) {
  c.in.soil_x.clear(), c.in.soil_v.clear(), c.in.soil_stress.clear();
  return c;
}
/// A narrow domain, which particles leave.
inline Cloud leaving(Cloud c) {
  c.p.high[2] = 1.15;
  for (std::size_t i = 2; i < c.in.water_v.size(); i += 3) c.in.water_v[i] += 1;
  return c;
}
inline std::vector<Scene> scenes(int dimension) {
  CloudOptions o, paper, bodies, open, rubbing;
  for (CloudOptions* each : {&o, &paper, &bodies, &open, &rubbing}) each->dimension = dimension;
  paper.paper = bodies.bodies = true, paper.cubic = dimension == 2, open.walls = false,
  rubbing.coulomb = rubbing.corrected = true;
  return {{"defaults", cloud(o)},
          {"the paper's choices", cloud(paper), false, true},
          {"a moving body", cloud(bodies)},
          {"no walls", cloud(open)},
          {"Coulomb friction, corrected gradients", cloud(rubbing)},
          {"Verlet", with(cloud(o), by_verlet)},
          {"Verlet and a moving body", with(cloud(bodies), by_verlet)},
          {"shifting", with(cloud(o), shifting)},
          {"soil alone", without_water(cloud(o))},
          {"water alone", without_soil(cloud(o))},
          {"leaving", leaving(cloud(o))},
          {"settling", cloud(o), true}};
}

template <class Values>
double largest_of(const Values& values) {
  double most = 0;
  for (auto v : values) most = std::max(most, std::fabs(double(v)));
  return most;
}
template <class Values>
void expect_near(const Values& a, const Values& b, double tolerance, const char* what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::fabs(double(a[i]) - double(b[i])));
  EXPECT_LE(most, tolerance) << what << ", whose largest is " << largest_of(a);
}

/// Everything that is told of the scene after 50 steps (10 in single precision where thresholds decide), by the CPU and
/// by `device`, which has just been made. The two add the same terms in another order: `tolerance` is what rounding may
/// grow to, relative to the largest of each field and to dp for places.
inline void expect_the_same_as_the_cpu(const Scene& scene, NumberType type, std::unique_ptr<Simulation> device,
                                       double tolerance) {
  SCOPED_TRACE(scene.name);
  const Cloud& c = scene.cloud;
  const auto cpu = make_cpu_simulation(c.p, c.in, type);
  for (Simulation* s : {cpu.get(), device.get()}) {
    if (scene.settling) s->settle(Settling::all), s->advance(1e9, 10), s->settle(Settling::off);
    s->advance(1e9, scene.by_threshold && type != NumberType::double_ ? 10 : 50);
  }
  const StepState s = cpu->state(), t = device->state();
  EXPECT_EQ(s.step, t.step);
  EXPECT_NEAR(s.time, t.time, std::min(tolerance, 1e-6) * s.time);
  EXPECT_EQ(s.lost_water, t.lost_water);
  EXPECT_EQ(s.lost_soil, t.lost_soil);
  ParticleState a, b;
  cpu->download(a), device->download(b);
  const auto near = [&](const auto& x, const auto& y, const char* what) {
    expect_near(x, y, tolerance * largest_of(x), what);
  };
  expect_near(a.water_x, b.water_x, tolerance * c.p.dp, "water");
  expect_near(a.soil_x, b.soil_x, tolerance * c.p.dp, "soil");
  // The rest comes as floats.
  tolerance = std::max(tolerance, 3e-7);
  near(a.water_v, b.water_v, "velocity of water"), near(a.soil_v, b.soil_v, "velocity of soil");
  near(a.water_pressure, b.water_pressure, "pressure"), near(a.soil_stress, b.soil_stress, "stress");
  near(a.soil_adps, b.soil_adps, "Adps");
  EXPECT_EQ(a.water_lost, b.water_lost);
  EXPECT_EQ(a.soil_lost, b.soil_lost);
  std::vector<float> pressure[2], stress[2];
  cpu->download_walls(pressure[0], stress[0]), device->download_walls(pressure[1], stress[1]);
  near(pressure[0], pressure[1], "pressure at walls"), near(stress[0], stress[1], "stress at walls");
  std::vector<double> place[2], water[2], soil[2];
  std::vector<unsigned> id[2];
  cpu->download_bodies(place[0], id[0]), device->download_bodies(place[1], id[1]);
  std::vector<double> by_id[2];
  for (int k = 0; k < 2; ++k) {  // each is sorted by the cells of its backend
    by_id[k].assign(c.in.wall_x.size(), 0);
    for (std::size_t i = 0; i < id[k].size(); ++i)
      for (std::size_t m = 0; m < 3; ++m) by_id[k][3 * id[k][i] + m] = place[k][3 * i + m];
  }
  near(by_id[0], by_id[1], "bodies");
  cpu->download_accelerations(water[0], soil[0]), device->download_accelerations(water[1], soil[1]);
  near(water[0], water[1], "forces on water"), near(soil[0], soil[1], "forces on soil");
  const InternalForces f = cpu->internal_forces(), g = device->internal_forces();
  EXPECT_NEAR(f.sum, g.sum, tolerance * f.sum);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(f.net[k], g.net[k], tolerance * f.sum) << k;
}

}  // namespace lgiw::test
