// Pressure gauges and the error budget, by hand.
#include "solver/diagnostics.hh"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "cloud.hh"
#include "gtest/gtest.h"
#include "physics/water.hh"
#include "solver/error_budget.hh"
#include "solver/water_pressure.hh"

namespace lgiw::test {
namespace {

/// Still water, 1 m deep, 2 m wide, on the lattice that seeding uses.
struct Basin {
  ModelParameters p;
  ParticleState s;
  explicit Basin(int dimension, double dp) {
    p.dimension = dimension, p.dp = dp, p.h = 1.5 * dp, p.sound_speed = 60;
    const EquationOfState<double> eos(p.water_density, p.sound_speed);
    const int n = int(std::lround(1 / dp)), rows = dimension == 3 ? 2 * n : 1;
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < rows; ++j)
        for (int i = 0; i < 2 * n; ++i) {
          const double z = (k + 0.5) * dp, pressure = 1000 * 9.81 * (1 - z);
          s.water_x.insert(s.water_x.end(), {(i + 0.5) * dp, dimension == 3 ? (j + 0.5) * dp : 0, z});
          s.water_pressure.push_back(float(pressure));
          s.water_excess.push_back(float(eos.excess(pressure)));
        }
    s.water_v.assign(s.water_x.size(), 0);
    s.water_lost.assign(s.water_pressure.size(), 0);
  }
};

TEST(PressureGauge, HydrostaticPressureInTheOpenAtWallsAndInCorners) {
  for (int dimension : {2, 3}) {
    const Basin basin(dimension, dimension == 2 ? 0.025 : 0.05);
    const double y = 1;
    const std::vector<std::array<double, 3>> at{{1, y, 0.5},  {1.013, y, 0.207}, {0, y, 0.31},
                                                {0, y, 0},    {0.7, y, 0},       {2, y, 0.6},
                                                {1, y, 0.95}, {1, y, 1.2},       {-0.4, y, 0.3}};
    const std::vector<float> pressure = water_pressures(basin.p, basin.s, at);
    for (std::size_t k = 0; k < 7; ++k)
      EXPECT_NEAR(pressure[k], 9810 * (1 - at[k][2]), 0.002 * 9810) << k << " in " << dimension << "-D";
    EXPECT_EQ(pressure[7], 0) << "above the water";
    EXPECT_EQ(pressure[8], 0) << "behind the wall";
  }
}

TEST(PressureGauge, SprayIsNoPressureAndLostWaterIsNone) {
  Basin basin(2, 0.025);
  // One particle 0.5 dp from the gauge, at q = 1/3: dp^2 W = dp^2 7/(4 pi h^2) (5/6)^4 (5/3) = 0.1990 < 0.2.
  ParticleState& s = basin.s;
  std::fill(s.water_lost.begin(), s.water_lost.end(), 1);
  s.water_lost[0] = 0;
  s.water_pressure[0] = 5000, s.water_excess[0] = 0;
  EXPECT_EQ(water_pressures(basin.p, s, {{0.025, 0, 0.0125}})[0], 0);
  // Right on the gauge the share is 0.2476, and the pressure the particle's own.
  EXPECT_EQ(water_pressures(basin.p, s, {{0.0125, 0, 0.0125}})[0], 5000);
  s.water_lost[0] = 1;
  EXPECT_EQ(water_pressures(basin.p, s, {{0.0125, 0, 0.0125}})[0], 0);
}

double value(const DiagnosticsRow& row, const std::string& name) {
  for (const auto& [key, number] : row)
    if (key == name) return number;
  ADD_FAILURE() << "no column " << name;
  return NAN;
}

/// Two particles of water and two of soil, dp 0.1 m, in 2-D: masses 10 and 20 kg.
struct Four {
  ModelParameters p;
  ParticleState s;
  StepState st;
  Four() {
    p.dimension = 2, p.dp = 0.1, p.h = 0.15, p.sound_speed = 50;
    p.soil_density = 2000, p.young_modulus = 1e6, p.poisson_ratio = 0.25;
    s.water_x = {0, 0, 1, 1, 0, 2}, s.water_v = {3, 0, 4, 0, 0, 0};
    s.water_excess = {10, -2}, s.water_pressure = {0, 0}, s.water_lost = {0, 0};
    s.soil_x = {2, 0, 0.5, 3, 0, -0.5}, s.soil_v = {0, 0, -1, 2, 0, 0};
    s.soil_stress = {-1000, -1000, -2000, 0, 0, 500, 0, 0, 0, 0, 0, 0}, s.soil_adps = {0, 0}, s.soil_lost = {0, 0};
  }
};

TEST(Diagnostics, EnergiesByHand) {
  const Four four;
  const DiagnosticsRow row = diagnose(four.p, four.s, four.st, {});
  EXPECT_NEAR(value(row, "mass"), 60, 1e-12);
  EXPECT_NEAR(value(row, "momentum_x"), 10 * 3 + 20 * 2, 1e-9);
  EXPECT_NEAR(value(row, "momentum_z"), 10 * 4 - 20 * 1, 1e-9);
  // 10 kg at 5 m/s, 20 kg at 1 and at 2 m/s.
  EXPECT_NEAR(value(row, "kinetic_energy"), 125 + 10 + 40, 1e-9);
  EXPECT_NEAR(value(row, "potential_energy"), 9.81 * (10 * 1 + 10 * 2 + 20 * 0.5 - 20 * 0.5), 1e-9);
  // m c2/2 (drho/rho0)2: 10 * 2500 / 2 * (1e-4 + 4e-6)
  EXPECT_NEAR(value(row, "compression_energy"), 12500 * 1.04e-4, 1e-7);
  // s:s = 1e6 + 1e6 + 4e6 + 2 * 0.25e6 = 6.5e6, tr2 = 16e6: V (1.25 * 6.5e6 - 0.25 * 16e6) / 2E = 0.01 * 4.125e6 / 2e6
  EXPECT_NEAR(value(row, "elastic_energy"), 0.020625, 1e-9);
  EXPECT_NEAR(value(row, "total_energy"), 175 + 294.3 + 1.3 + 0.020625, 1e-4 * 470);
  EXPECT_NEAR(value(row, "mach_number"), 5 / 50., 1e-9);
  EXPECT_NEAR(value(row, "max_density_error"), 0.01, 1e-9);
}

TEST(Diagnostics, UniaxialStrainStoresHalfStressTimesStrain) {
  // Confined compression by eps: sigma_v = M eps, sigma_h = nu / (1 - nu) sigma_v, M = E (1 - nu) / ((1 + nu)(1 - 2
  // nu)).
  Four four;
  const double nu = 0.25, modulus = 1e6 * 0.75 / (1.25 * 0.5), eps = 1e-3, vertical = -modulus * eps;
  const float side = float(vertical * nu / (1 - nu));
  four.s.soil_stress = {side, side, float(vertical), 0, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_NEAR(value(diagnose(four.p, four.s, four.st, {}), "elastic_energy"), 0.01 * 0.5 * modulus * eps * eps, 1e-8);
}

TEST(Diagnostics, WhatHasLeftKeepsItsHeightAndNothingElse) {
  Four four;
  const double before = value(diagnose(four.p, four.s, four.st, {}), "potential_energy");
  four.s.water_lost[0] = 1, four.s.soil_lost[0] = 1;
  const DiagnosticsRow row = diagnose(four.p, four.s, four.st, {});
  EXPECT_EQ(value(row, "potential_energy"), before);
  EXPECT_NEAR(value(row, "mass"), 30, 1e-12);
  EXPECT_NEAR(value(row, "kinetic_energy"), 40, 1e-9);
  EXPECT_NEAR(value(row, "compression_energy"), 12500 * 4e-6, 1e-7);
  EXPECT_EQ(value(row, "elastic_energy"), 0);
}

TEST(Diagnostics, PercentileOfTheDensityErrorPassesOverOneInAThousand) {
  Basin basin(2, 0.02);  // 5000 particles
  std::fill(basin.s.water_excess.begin(), basin.s.water_excess.end(), 2.f);
  for (int i = 0; i < 4; ++i) basin.s.water_excess[std::size_t(100 + i)] = -90;
  const DiagnosticsRow row = diagnose(basin.p, basin.s, {}, {});
  EXPECT_NEAR(value(row, "max_density_error"), 0.09, 1e-8);
  EXPECT_NEAR(value(row, "density_error_p999"), 0.002, 1e-9);
}

/// Of so many particles that all threads share the work.
TEST(Diagnostics, DoNotDependOnTheNumberOfThreads) {
  ModelParameters p;
  p.dimension = 3, p.dp = 0.05, p.young_modulus = 1e6, p.poisson_ratio = 0.25;
  ParticleState s;
  std::mt19937 random(3);
  std::lognormal_distribution<float> any(0, 1);
  std::uniform_real_distribution<float> inside(0, 2);
  const std::size_t n = 50000;
  const auto many = [&](auto& values, std::size_t width) {
    values.resize(width * n);
    for (auto& v : values) v = any(random);
  };
  s.water_x.resize(3 * n), s.soil_x.resize(3 * n);
  for (auto& x : s.water_x) x = inside(random);
  for (auto& x : s.soil_x) x = inside(random);
  many(s.water_v, 3), many(s.water_excess, 1), many(s.water_pressure, 1);
  many(s.soil_v, 3), many(s.soil_stress, 6), many(s.soil_adps, 1);
  s.water_lost.assign(n, 0), s.soil_lost.assign(n, 0);
  for (std::size_t i = 0; i < n; i += 7) s.water_lost[i] = s.soil_lost[i + 3] = 1;

  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const DiagnosticsRow one = diagnose(p, s, {}, {});
  omp_set_num_threads(3);
  const DiagnosticsRow three = diagnose(p, s, {}, {});
  omp_set_num_threads(before);
  EXPECT_EQ(one, three);
  EXPECT_GT(value(one, "interpenetrating"), 100);

  std::vector<double> errors, speeds;
  for (std::size_t i = 0; i < n; ++i) {
    const float* v = &s.soil_v[3 * i];
    if (!s.water_lost[i]) errors.push_back(s.water_excess[i] / p.water_density);
    if (!s.soil_lost[i]) speeds.push_back(std::hypot(double(v[0]), double(v[1]), double(v[2])));
  }
  const auto percentile = [](std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    return values[std::size_t(0.999 * double(values.size() - 1))];
  };
  EXPECT_EQ(value(one, "density_error_p999"), percentile(errors));
  EXPECT_EQ(value(one, "max_density_error"), errors.back());
  EXPECT_EQ(value(one, "max_soil_speed"), percentile(speeds));
  EXPECT_NEAR(value(one, "mass"), p.dp * p.dp * p.dp * (p.water_density + p.soil_density) * double(speeds.size()),
              1e-6);
}

/// A lattice of n^D particles; those for which `soil` says so are soil.
template <class F>
ParticleState lattice(const ModelParameters& p, int n, const F& soil) {
  ParticleState s;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < (p.dimension == 3 ? n : 1); ++j)
      for (int i = 0; i < n; ++i) {
        auto& x = soil(i, j, k) ? s.soil_x : s.water_x;
        x.insert(x.end(), {i * p.dp, j * p.dp, k * p.dp});
      }
  s.water_lost.assign(s.water_x.size() / 3, 0), s.soil_lost.assign(s.soil_x.size() / 3, 0);
  return s;
}

TEST(Interpenetration, CountsWhatIsEnclosedAndNothingAtRest) {
  for (int dimension : {2, 3}) {
    ModelParameters p;
    p.dimension = dimension, p.dp = 0.5;
    const auto count = [&](const auto& soil) { return interpenetrating(p, lattice(p, 9, soil)); };
    EXPECT_EQ(count([](int, int, int k) { return k < 4; }), 0) << "a plane bed";
    EXPECT_EQ(count([](int i, int j, int k) { return i < 4 && j < 4 && k < 4; }), 0) << "a block's corner in water";
    EXPECT_EQ(count([](int i, int j, int k) { return !(i < 4 && j < 4 && k < 4); }), 0) << "water in a soil corner";
    EXPECT_EQ(count([](int i, int, int k) { return k < i; }), 0) << "a slope of 45 degrees";
    const int mid = dimension == 3 ? 4 : 0;
    EXPECT_EQ(count([=](int i, int j, int k) { return i == 4 && j == mid && k == 4; }), 1) << "a grain in the water";
    EXPECT_EQ(count([=](int i, int j, int k) { return !(i == 4 && j == mid && k == 4); }), 1) << "a drop in the soil";
    EXPECT_EQ(count([=](int i, int j, int k) { return !((i == 4 || i == 5) && j == mid && k == 4); }), 2)
        << "two drops";
    EXPECT_EQ(count([=](int i, int j, int k) { return k < 4 || (k == 6 && j == mid && i % 4 == 2); }), 2)
        << "two grains off a bed";
  }
  // A particle on its own, far away, makes no large grid, and one that is lost does not count.
  ModelParameters p;
  p.dimension = 2, p.dp = 0.5;
  ParticleState s = lattice(p, 9, [](int i, int, int k) { return i == 4 && k == 4; });
  s.soil_x.insert(s.soil_x.end(), {1e6, 0, 1e6}), s.soil_lost.push_back(0);
  EXPECT_EQ(interpenetrating(p, s), 1);
  s.soil_lost[0] = 1;
  EXPECT_EQ(interpenetrating(p, s), 0);
}

TEST(InternalForces, CancelAndLeaveTheStateAsItIs) {
  for (int dimension : {2, 3}) {
    CloudOptions o;
    o.dimension = dimension;
    Cloud scene = cloud(o);
    const auto simulation = make_cpu_simulation(scene.p, scene.in, NumberType::double_);
    std::vector<double> water, soil, water_after, soil_after;
    simulation->download_accelerations(water, soil);
    double net = 0, sum = 0;
    for (std::size_t i = 0; i < water.size(); i += 3) net += water[i];
    for (std::size_t i = 0; i < soil.size(); i += 3) net += soil[i];
    const InternalForces f = simulation->internal_forces();
    for (double component : f.net) sum += std::fabs(component);
    EXPECT_LT(sum, 1e-12 * f.sum);
    EXPECT_GT(std::fabs(net), 1e-6 * f.sum) << "the walls push";
    EXPECT_GT(f.sum, 0);
    simulation->download_accelerations(water_after, soil_after);
    EXPECT_EQ(water, water_after);
    EXPECT_EQ(soil, soil_after);
    const auto single = make_cpu_simulation(scene.p, scene.in, NumberType::mixed);
    const InternalForces g = single->internal_forces();
    EXPECT_LT(std::hypot(g.net[0], g.net[1], g.net[2]), 1e-5 * g.sum);
  }
}

TEST(TimeSteps, SmallestAndWhatLimitedThem) {
  Cloud scene = cloud({});
  const auto simulation = make_cpu_simulation(scene.p, scene.in, NumberType::double_);
  double smallest = 1e300, time = 0;
  int64_t limited[4] = {};
  for (int k = 0; k < 20; ++k) {
    const StepState before = simulation->state();
    smallest = std::min(smallest, before.dt), ++limited[before.limit], time += before.dt;
    simulation->advance(1, 1);
  }
  const StepState st = simulation->state();
  EXPECT_EQ(st.step, 20);
  EXPECT_EQ(st.smallest_dt, smallest);
  EXPECT_NEAR(st.time, time, 1e-15);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(st.limited[k], limited[k]);
}

TEST(TimeSteps, DiffusionHasALimitOfItsOwn) {
  // Far below the acoustic one: delta c dt / h is at most 0.3 (leapfrog) and 0.0065 (Verlet), times the share asked
  // for.
  for (const bool verlet : {false, true}) {
    Cloud scene = cloud({});
    scene.p.verlet = verlet, scene.p.cfl = 1, scene.p.density_diffusion = 40, scene.p.stress_diffusion = 0;
    const auto simulation = make_cpu_simulation(scene.p, scene.in, NumberType::double_);
    const double limit = (verlet ? 0.0065 : 0.3) * scene.p.h / (40 * scene.p.sound_speed);
    EXPECT_NEAR(simulation->state().dt, limit, 1e-12 * limit);
    EXPECT_EQ(simulation->state().limit, 3);
    simulation->limit_time_step(0.25);
    EXPECT_NEAR(simulation->state().dt, 0.25 * limit, 1e-12 * limit);
    simulation->advance(1, 1);
    EXPECT_NEAR(simulation->state().dt, 0.25 * limit, 1e-12 * limit);
    simulation->limit_time_step(1);
    EXPECT_NEAR(simulation->state().dt, limit, 1e-12 * limit);
  }
}

/// Rows with total, kinetic and potential energy alone.
DiagnosticsRow energies(double kinetic, double potential, double rest = 0) {
  return {{"kinetic_energy", kinetic}, {"potential_energy", potential}, {"total_energy", kinetic + potential + rest}};
}

TEST(ErrorBudget, EnergyCreatedIsTheLargestRiseOverWhatIsReleased) {
  Extremes e;
  accumulate(energies(0, 1000), e);
  accumulate(energies(300, 600), e);     // 900
  accumulate(energies(200, 610, 5), e);  // 815
  accumulate(energies(100, 727, 0), e);  // 827: 12 more
  accumulate(energies(50, 500, 0), e);   // 550
  accumulate(energies(50, 505, 0), e);   // 5 more
  EXPECT_EQ(e.at("energy_created"), 12);
  EXPECT_EQ(e.at("energy_released"), 500);
  EXPECT_EQ(e.at("last_kinetic_energy"), 50);
  ModelParameters p;
  p.dimension = 2, p.dp = 0.1;
  ParticleHeader header;
  header.counts = {10, 0, 0, 0};  // 100 kg, which fall by dp: 98.1 J
  const ErrorBudget b = error_budget(p, header, e);
  EXPECT_NEAR(b.energy_floor, 98.1, 1e-7);
  EXPECT_NEAR(*b.energy_created, 12.0 / 500, 1e-12);
  EXPECT_FALSE(b.mach_number);
  EXPECT_FALSE(b.interpenetrating);
  // At rest: a rise of a microjoule over a release of nanojoules is no creation to speak of.
  Extremes rest;
  accumulate(energies(0, 1000), rest);
  accumulate(energies(1e-9, 1000.000001), rest);
  EXPECT_NEAR(*error_budget(p, header, rest).energy_created, 1.001e-6 / 98.1, 1e-11);
  // Bodies that move as prescribed do work.
  header.bodies.emplace_back();
  EXPECT_FALSE(error_budget(p, header, e).energy_created);
}

TEST(ErrorBudget, MassResidualIsWhatHasLeft) {
  Extremes e;
  accumulate({{"total_energy", 0}, {"potential_energy", 0}, {"kinetic_energy", 0}, {"lost_water", 3}, {"lost_soil", 1}},
             e);
  ModelParameters p;
  p.dimension = 2, p.dp = 0.1, p.soil_density = 2000;
  ParticleHeader header;
  header.counts = {60, 20, 0, 0};
  EXPECT_NEAR(error_budget(p, header, e).mass_residual, (3 * 1000. + 1 * 2000) / (60 * 1000 + 20 * 2000), 1e-12);
}

bool mentions(const std::vector<std::string>& lines, const std::string& part) {
  for (const std::string& line : lines)
    if (line.find(part) != std::string::npos) return true;
  return false;
}

TEST(Warnings, OnePerLimitAndNoneBelow) {
  ErrorBudget b;
  b.mach_number = 0.1, b.density_error_p999 = 0.01, b.density_error = 0.5, b.energy_created = 0.01;
  b.interpenetrating = 10, b.interpenetrating_share = 0.05;
  EXPECT_TRUE(warnings_of(b).empty()) << "at the limits";
  const auto expect_one = [](const ErrorBudget& budget, const std::string& part) {
    const auto lines = warnings_of(budget);
    ASSERT_EQ(lines.size(), 1u) << part;
    EXPECT_TRUE(mentions(lines, part)) << lines[0];
  };
  ErrorBudget one = b;
  one.mach_number = 0.13;
  expect_one(one, "the Mach number of the water reached 0.13, above 0.1");
  one = b, one.density_error_p999 = 0.021;
  expect_one(one, "the density error of the water (99.9th percentile) reached 2.1 %, above 1 %");
  one = b, one.energy_created = 0.03;
  expect_one(one, "energy was created: 3 % of what was released, above 1 %");
  one = b, one.interpenetrating = 30, one.interpenetrating_share = 0.06;
  expect_one(one, "30 particles were enclosed by the other phase, 6 % of the smaller one, above 5 %");
  EXPECT_TRUE(warnings_of(ErrorBudget{}).empty());

  Resolution r;
  r.slide_median = 8, r.slide_tenth = 2, r.deepest_water = 3;
  r.gauges = {{"G1", 4}, {"G2", 40}};
  EXPECT_TRUE(warnings_of(r).empty());
  r.slide_median = 7;
  ASSERT_EQ(warnings_of(r).size(), 1u);
  EXPECT_TRUE(mentions(warnings_of(r), "the slide is 7 particles thick (median)"));
  r.slide_median.reset(), r.gauges[0].particles = 3;
  ASSERT_EQ(warnings_of(r).size(), 1u);
  EXPECT_TRUE(mentions(warnings_of(r), "gauge G1 stands in 3 particles of water"));
}

TEST(Resolution, CountsColumnsOfParticles) {
  // Soil columns of 1, 2 ... 10 particles; water 6 deep under one gauge, none under another.
  ParticleData data;
  data.header.dimension = 2, data.header.dp = 0.5, data.header.origin = {100, 0, 0};
  const auto add = [](ParticleBlock& block, double x, int n) {
    for (int k = 0; k < n; ++k)
      block.points.insert(block.points.end(), {x, 0, 0.5 * k + 0.25}), block.volume.push_back(0.25f);
  };
  for (int i = 0; i < 10; ++i) add(data.soil, 0.25 + 0.5 * i, i + 1);
  for (int i = 10; i < 14; ++i) add(data.water, 0.25 + 0.5 * i, i - 4);  // 6, 7, 8, 9
  Case c;
  c.dimension = 2;
  c.gauges = {{"G1", 105.3, 0}, {"dry", 103, 0}, {"P1", 105.3, 0, GaugeQuantity::pressure, 0.1}};
  const Resolution r = resolution_of(c, data);
  EXPECT_EQ(*r.slide_median, 5);
  EXPECT_EQ(*r.slide_tenth, 1);
  EXPECT_EQ(*r.deepest_water, 9);
  ASSERT_EQ(r.gauges.size(), 1u);
  EXPECT_EQ(r.gauges[0].name, "G1");
  EXPECT_EQ(r.gauges[0].particles, 6);
  EXPECT_EQ(text_of(r),
            "resolution: slide 5 particles thick (median; a tenth of it 1 or fewer), water 9 deep, gauge G1 in 6");
}

}  // namespace
}  // namespace lgiw::test
