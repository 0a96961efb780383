// lgiw-run from a particles file to a run file: contents, manners, failures.
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>

#include "base/error.hh"
#include "files/run_file.hh"
#include "gtest/gtest.h"
#include "run_scenes.hh"
#include "solver/runner.hh"

namespace lgiw::test {
namespace {

using nlohmann::json;

const std::string quiet = " -q --backend cpu --no-provenance ";

class Run : public testing::Test {
 protected:
  static void SetUpTestSuite() { shop = std::make_unique<Workshop>(); }
  static void TearDownTestSuite() { shop.reset(); }
  /// The particles of `slide` or `dam`, and their run; made when first asked for.
  static void particles(const std::string& name) {
    if (exists(name + ".h5")) return;
    ASSERT_TRUE(make_particles(*shop, name, name == "dam" ? dam_case : slide_case));
  }
  static void scene(const std::string& name) {
    particles(name);
    if (!exists(name + "-run.h5"))
      expect_quiet_success(shop->run("lgiw-run " + name + ".h5 -o " + name + "-run.h5" + quiet + "--summary " + name +
                                     ".json --diagnostics " + name + ".csv --xmf " + name + ".xmf"),
                           name);
  }
  static json summary(const std::string& name) { return json::parse(read_bytes(*shop / (name + ".json"))); }
  static bool exists(const std::string& name) { return fs::exists(*shop / name); }
  /// What a run that must not have started leaves: nothing of the name `name`.h5.
  static void expect_no_trace(const std::string& name) {
    EXPECT_FALSE(exists(name + ".h5"));
    EXPECT_FALSE(exists("." + name + ".partial.h5"));
    EXPECT_FALSE(exists(name + ".h5.checkpoint"));
  }

  static std::unique_ptr<Workshop> shop;
};
std::unique_ptr<Workshop> Run::shop;

TEST_F(Run, FramesSurfacesAndDiagnosticsAreThoseAskedFor) {
  scene("slide");
  const RunReader run((*shop / "slide-run.h5").string());
  ASSERT_EQ(run.frame_count(), 5u);            // 0, 0.1 ... 0.4 s
  ASSERT_EQ(run.surface_times().size(), 21u);  // 0, 0.02 ... 0.4 s
  const auto rows = run.diagnostics();
  ASSERT_EQ(rows.at("time").size(), 21u);
  EXPECT_EQ(run.surface_times(), rows.at("time"));
  for (std::size_t k = 0; k < 5; ++k) {
    // Outputs come with the first step that reaches their time.
    EXPECT_GE(run.frame_time(k), 0.1 * double(k));
    EXPECT_LT(run.frame_time(k), 0.1 * double(k) + 2e-3);
    EXPECT_EQ(run.frame_time(k), run.surface_times()[5 * k]);
  }
  const ParticleData before = read_particles((*shop / "slide.h5").string());
  const ParticleCounts& counts = run.header().particles.counts;
  EXPECT_EQ(counts.water, before.header.counts.water);
  EXPECT_EQ(counts.soil, before.header.counts.soil);
  const Frame first = run.frame(0);
  for (std::size_t i = 0; i < before.water.points.size(); ++i)
    EXPECT_EQ(first.points[i], float(before.water.points[i]));
  for (std::size_t i = 0; i < before.soil.points.size(); ++i) {
    EXPECT_EQ(first.points[before.water.points.size() + i], float(before.soil.points[i]));
    EXPECT_EQ(run.header().initial_soil[i], float(before.soil.points[i]));
  }
  for (float v : first.velocity) EXPECT_EQ(v, 0);
  for (std::size_t i = 0; i < before.water.size(); ++i)
    EXPECT_NEAR(first.pressure[i], before.water.pressure[i], 0.1 + 1e-3 * before.water.pressure[i]);
  for (std::size_t i = std::size_t(counts.water); i < first.pressure.size(); ++i) EXPECT_EQ(first.pressure[i], 0);

  // The soil has gone down, by as much as its centre of mass says, and plastic strain is the soil's alone.
  const Frame last = run.frame(4);
  double fall = 0, strain = 0;
  for (std::size_t i = std::size_t(counts.water); i < last.lost.size(); ++i) {
    fall += double(first.points[3 * i + 2]) - double(last.points[3 * i + 2]);
    strain = std::max(strain, double(last.adps[i]));
  }
  fall /= double(counts.soil);
  EXPECT_GT(fall, 0.03);
  EXPECT_LT(fall, 0.5 * 9.81 * 0.4 * 0.4);  // free fall
  EXPECT_NEAR(rows.at("soil_z").front() - rows.at("soil_z").back(), fall, 1e-6);
  EXPECT_GT(strain, 0.2);
  EXPECT_NEAR(rows.at("max_adps").back(), strain, 1e-6);
  EXPECT_TRUE(std::all_of(last.adps.begin(), last.adps.begin() + counts.water, [](float a) { return a == 0; }));
  const double mass = 0.02 * 0.02 * (1000 * double(counts.water) + 2000 * double(counts.soil));
  for (double m : rows.at("mass")) EXPECT_NEAR(m, mass, 1e-9 * mass);

  // Maxima are those of the surfaces, no less.
  const std::vector<float> elevation = run.maximum("elevation");
  std::vector<float> highest(elevation.size(), NAN);
  for (std::size_t k = 0; k < 21; ++k) {
    const std::vector<float> surface = run.water_surface(k);
    for (std::size_t i = 0; i < surface.size(); ++i) highest[i] = std::fmax(highest[i], surface[i]);
  }
  for (std::size_t i = 0; i < highest.size(); ++i)
    EXPECT_TRUE(elevation[i] == highest[i] || (std::isnan(elevation[i]) && std::isnan(highest[i]))) << i;
  EXPECT_GT(*std::max_element(elevation.begin(), elevation.end(),
                              [](float a, float b) { return !(a >= b) && !std::isnan(b); }),
            0.41f);
  for (const char* name : {"depth", "speed", "arrival", "soil_speed"})
    EXPECT_EQ(run.maximum(name).size(), elevation.size()) << name;
}

TEST_F(Run, SummaryHasWhatTheRunKnows) {
  scene("slide");
  const json s = summary("slide");
  const RunReader run((*shop / "slide-run.h5").string());
  const ParticleHeader particles = read_particle_header((*shop / "slide.h5").string());
  EXPECT_EQ(s.at("case"), "slide");
  EXPECT_EQ(s.at("particles").at("water"), particles.counts.water);
  EXPECT_EQ(s.at("particles").at("soil"), particles.counts.soil);
  EXPECT_EQ(s.at("particles").at("wall"), particles.counts.wall);
  EXPECT_EQ(s.at("particles").at("left_out"), particles.counts.wall_left_out);
  const auto rows = run.diagnostics();
  EXPECT_EQ(s.at("steps"), int64_t(rows.at("step").back()));
  EXPECT_EQ(s.at("end_time_s"), rows.at("time").back());
  EXPECT_GT(s.at("wall_time_s"), 0);
  const double rate = s.at("particle_steps_per_s"), seconds = s.at("wall_time_s");
  EXPECT_NEAR(rate * seconds, double(s.at("steps")) * double(particles.counts.total()), 1e-6 * rate * seconds);
  EXPECT_TRUE(s.at("left_out").is_array());
  EXPECT_EQ(s.at("mass_error"), 0);
  EXPECT_EQ(s.at("lost").at("water"), 0);
  const auto largest = [&](const char* name) { return *std::max_element(rows.at(name).begin(), rows.at(name).end()); };
  EXPECT_EQ(s.at("density_error"), largest("max_density_error"));
  EXPECT_LT(s.at("density_error"), 0.02);
  EXPECT_EQ(s.at("max_soil_speed_m_s"), largest("max_soil_speed"));
  EXPECT_EQ(s.at("max_water_speed_m_s"), largest("max_water_speed"));
  EXPECT_EQ(s.at("threads"), 2);

  // What an accuracy table needs.
  EXPECT_EQ(s.at("dimension"), 2);
  EXPECT_EQ(s.at("particle_spacing_m"), 0.02);
  EXPECT_EQ(s.at("h_over_dp"), 1.5);
  EXPECT_EQ(s.at("kernel"), "wendland");
  EXPECT_EQ(s.at("scheme"), "lgiw");
  EXPECT_EQ(s.at("precision"), "mixed");
  EXPECT_EQ(s.at("integrator"), "leapfrog");
  EXPECT_EQ(s.at("cfl"), 0.6);
  EXPECT_EQ(s.at("device"), "CPU");
  EXPECT_FALSE(std::string(s.at("version")).empty());
  EXPECT_GT(s.at("peak_memory_bytes"), s.at("bytes"));
  EXPECT_GT(s.at("set_up_time_s"), 0);
  // 28 or so in a plane full of particles, pi 3^2, walls counted; fewer at the free surface.
  EXPECT_GT(s.at("neighbours_per_particle"), 20);
  EXPECT_LT(s.at("neighbours_per_particle"), 30);
  EXPECT_GT(s.at("stepping_time_s"), 0);
  EXPECT_LT(s.at("stepping_time_s"), s.at("wall_time_s"));
  EXPECT_GT(s.at("stepping_particle_steps_per_s"), s.at("particle_steps_per_s"));
  const auto& dt = s.at("time_step_s");
  EXPECT_NEAR(double(dt.at("mean")) * double(s.at("steps")), s.at("end_time_s"), 1e-9);
  EXPECT_LE(dt.at("smallest"), *std::min_element(rows.at("time_step").begin(), rows.at("time_step").end() - 1));
  EXPECT_LE(dt.at("smallest"), dt.at("mean"));
  double limited = 0;
  for (const auto& [name, share] : s.at("time_step_limited_by").items()) limited += double(share);
  EXPECT_NEAR(limited, 1, 1e-12);

  // The error budget, from the table of diagnostics.
  const auto& budget = s.at("error_budget");
  EXPECT_EQ(budget.at("mass_residual"), 0);
  EXPECT_EQ(budget.at("density_error_p999"), largest("density_error_p999"));
  EXPECT_EQ(budget.at("mach_number"), largest("mach_number"));
  EXPECT_EQ(budget.at("interpenetrating"), largest("interpenetrating"));
  EXPECT_EQ(budget.at("momentum_residual"), largest("momentum_residual"));
  EXPECT_LT(budget.at("momentum_residual"), 1e-5);
  EXPECT_EQ(rows.at("interpenetrating").front(), 0);
  const std::vector<double>& total = rows.at("total_energy");
  double lowest = total.front(), rise = 0;
  for (std::size_t k = 0; k < total.size(); ++k) {
    EXPECT_NEAR(total[k],
                rows.at("kinetic_energy")[k] + rows.at("potential_energy")[k] + rows.at("compression_energy")[k] +
                    rows.at("elastic_energy")[k],
                1e-9 * std::fabs(total[k]));
    rise = std::max(rise, total[k] - lowest), lowest = std::min(lowest, total[k]);
  }
  EXPECT_LT(total.back(), total.front());
  EXPECT_EQ(budget.at("energy_rise_J"), rise);
  EXPECT_GT(budget.at("energy_released_J"), 0);
  EXPECT_LT(budget.at("energy_created"), 0.01);
  EXPECT_EQ(s.at("resolution").at("gauge_depth_particles").at("G1"), 20);
  EXPECT_TRUE(s.at("warnings").is_array());

  // In the file, without provenance, only what is the same in every run.
  const json kept = json::parse(run.summary());
  for (const char* name : {"wall_time_s", "particle_steps_per_s", "threads", "phase_seconds", "stepping_time_s",
                           "set_up_time_s", "peak_memory_bytes", "device", "version"})
    EXPECT_FALSE(kept.contains(name)) << name;
  for (const auto& [name, value] : kept.items()) EXPECT_EQ(value, s.at(name)) << name;

  const std::string table = read_bytes(*shop / "slide.csv");
  EXPECT_EQ(table.compare(0, 5, "time,"), 0);
  EXPECT_EQ(lines(table), 22);
}

TEST_F(Run, EqualRunsAreEqualInEveryByte) {
  scene("slide");
  const std::string once = read_bytes(*shop / "slide-run.h5");
  const auto again = [&](const std::string& options) {
    expect_quiet_success(shop->run("lgiw-run slide.h5 -o again.h5 -O" + quiet + options), options);
    return read_bytes(*shop / "again.h5");
  };
  EXPECT_TRUE(again("") == once) << "two runs";
  EXPECT_TRUE(again("--threads 1") == once) << "one thread and two";
  // Checkpoints, which flush the file at moments that depend on the clock, leave no trace but their interval in the
  // case.
  const std::string rare = again("--set output.checkpoint_interval=900");
  const std::string often = again("--set output.checkpoint_interval=0.1");
  ASSERT_EQ(rare.size(), often.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < rare.size(); ++i) different += rare[i] != often[i];
  // "900" against "0.1", and the checksum (4 bytes) that HDF5 keeps of the header with the case.
  EXPECT_LE(different, 7u);
}

TEST_F(Run, EndsAtTheEndTimeWithAFrame) {
  particles("slide");
  // 0.07 s is no multiple of 0.02 s, nor of 0.05 s.
  expect_quiet_success(
      shop->run("lgiw-run slide.h5 -o odd.h5" + quiet +
                "--set output.end_time=0.07 --set output.frame_interval=0.05 --set output.surface_interval=0.025"),
      "");
  const RunReader run((*shop / "odd.h5").string());
  ASSERT_EQ(run.frame_count(), 3u);
  EXPECT_NEAR(run.frame_time(1), 0.05, 1e-3);
  EXPECT_NEAR(run.frame_time(2), 0.07, 1e-3);
  ASSERT_EQ(run.surface_times().size(), 4u);
  EXPECT_NEAR(run.surface_times()[3], 0.07, 1e-3);
}

TEST_F(Run, WaveArrivesLaterFartherAndNeverBeforeRitter) {
  scene("dam");
  const RunReader run((*shop / "dam-run.h5").string());
  const SurfaceMap& map = run.header().map;
  ASSERT_EQ(map.nx, 150u);
  const std::vector<float> arrival = run.maximum("arrival"), elevation = run.maximum("elevation"),
                           depth = run.maximum("depth");
  const double front = 2 * std::sqrt(9.81 * 0.2);  // of a dam break on a frictionless dry bed
  std::size_t wet = 0;
  float before = 0;
  for (std::size_t i = 22; i < map.nx; ++i) {  // dry at the start, the edge of the column left aside
    const double x = map.x0 + double(i) * map.dx;
    EXPECT_EQ(std::isnan(arrival[i]), i > 22 && !(depth[i] > 0.0025f)) << x;
    EXPECT_EQ(std::isnan(elevation[i]), std::isnan(depth[i])) << x;
    if (std::isnan(arrival[i])) continue;
    ++wet;
    EXPECT_GE(arrival[i], before) << x;
    // The surface of particles stands up to a kernel's reach ahead of them.
    EXPECT_GE(arrival[i], (x - 0.2 - 3 * 0.01) / front) << x;
    EXPECT_LT(elevation[i], 0.2f) << x;
    before = arrival[i];
  }
  EXPECT_GT(wet, 60u);  // beyond x = 0.82 m in 0.6 s
  EXPECT_LT(wet, std::size_t((0.6 * front + 0.03) / 0.01));
  EXPECT_TRUE(std::isnan(arrival.back()));  // 1.5 m away
  EXPECT_NEAR(elevation[5], 0.2, 0.01);     // where the column stood
}

TEST_F(Run, PressureGaugesAreRecordedAtEverySurface) {
  scene("dam");
  const RunReader run((*shop / "dam-run.h5").string());
  ASSERT_EQ(run.header().pressure_gauges, (std::vector<std::string>{"P1", "P2"}));
  const std::vector<float> wall = run.pressure(0), dry = run.pressure(1);
  ASSERT_EQ(wall.size(), run.surface_times().size());
  EXPECT_NEAR(wall[0], 9810 * 0.15, 0.01 * 9810 * 0.2);  // hydrostatic at the start
  EXPECT_LT(wall.back(), 0.5f * wall[0]);                // the column has gone down
  // Far away there is water only once the wave is there.
  const std::vector<float> arrival = run.maximum("arrival");
  const SurfaceMap& map = run.header().map;
  const float there = arrival[std::size_t(std::lround((0.5 - map.x0) / map.dx))];
  ASSERT_TRUE(std::isfinite(there));
  for (std::size_t k = 0; k < dry.size(); ++k) {
    EXPECT_TRUE(std::isfinite(dry[k]));
    if (run.surface_times()[k] > double(there) - 0.05) break;
    EXPECT_EQ(dry[k], 0) << run.surface_times()[k];
  }
  const Outcome refused = shop->run("lgiw-run dam.h5 -o new.h5 --set gauges.1.z=5");
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(lines(refused.err), 1) << refused.err;
  EXPECT_NE(refused.err.find("pressure gauge P1 lies outside the domain (its z of 5"), std::string::npos)
      << refused.err;
  expect_no_trace("new");
}

TEST_F(Run, WarningsAreOneLineEachInTheLogAndInTheSummary) {
  particles("dam");
  // Water whose sound travels at 8 m/s: its front runs at 2 to 3 m/s.
  const Outcome run = shop->run(
      "lgiw-run dam.h5 -o soft.h5 --backend cpu --summary soft.json --set water.sound_speed=8 --set "
      "output.end_time=0.3");
  ASSERT_EQ(run.status, 0) << run.err;
  const json s = summary("soft");
  EXPECT_GT(s.at("error_budget").at("mach_number"), 0.1);
  EXPECT_GT(s.at("error_budget").at("density_error_p999"), 0.01);
  ASSERT_GE(s.at("warnings").size(), 2u);
  std::size_t said = 0;
  for (std::size_t at = run.err.find("lgiw-run: warning: "); at != std::string::npos;
       at = run.err.find("lgiw-run: warning: ", at + 1))
    ++said;
  EXPECT_EQ(said, s.at("warnings").size()) << run.err;
  for (const std::string warning : s.at("warnings"))
    EXPECT_NE(run.err.find("lgiw-run: warning: " + warning + "\n"), std::string::npos) << warning;
  EXPECT_NE(run.err.find("lgiw-run: error budget: mass 0"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("lgiw-run: resolution: water 20 deep, gauge G1 in 20"), std::string::npos) << run.err;
  // What is known beforehand is said beforehand.
  const json plan = json::parse(shop->run("lgiw-run dam.h5 --dry-run --set gauges.0.x=0.205").out);
  EXPECT_TRUE(plan.at("warnings").empty());
  EXPECT_EQ(plan.at("resolution").at("water_depth_particles"), 20);
  EXPECT_NE(std::string(plan.at("expected_error")).find("pressure"), std::string::npos);
}

TEST_F(Run, WhatLeavesThroughAnOpenSideIsCountedAndTheRunGoesOn) {
  std::string near = dam_case;
  near.replace(near.find("[1.5, 0]"), 8, "[0.6, 0]");
  ASSERT_TRUE(make_particles(*shop, "near", near));
  expect_quiet_success(
      shop->run("lgiw-run near.h5 -o near-run.h5 --summary near.json" + quiet + "--set output.end_time=1"), "");
  const json s = summary("near");
  const RunReader run((*shop / "near-run.h5").string());
  const Frame last = run.frame(run.frame_count() - 1);
  const auto lost = std::count(last.lost.begin(), last.lost.end(), 1);
  EXPECT_GT(lost, 100);
  EXPECT_LT(lost, 400);
  EXPECT_EQ(s.at("lost").at("water"), lost);
  EXPECT_NEAR(s.at("mass_error"), double(lost) / 400, 1e-12);
  EXPECT_NEAR(run.diagnostics().at("mass").back(), 0.1 * double(400 - lost),
              1e-9);  // 0.01 m x 0.01 m x 1000 kg/m3 each
  for (std::size_t i = 0; i < last.lost.size(); ++i)
    if (last.lost[i]) {
      EXPECT_NEAR(last.points[3 * i], 0.6, 1e-6);  // where it left
      EXPECT_EQ(last.velocity[3 * i], 0);
    }
}

TEST_F(Run, NothingSeepsThroughTheWallsOfATank) {
  // A column that breaks, climbs the far wall and falls back: thin sheets and drops at every wall.
  std::string tank = dam_case;
  tank.replace(tank.find("[1.5, 0]"), 8, "[0.6, 0]");
  tank.replace(tank.find(", sides: {east: open}"), 21, ", wall_top: 1");
  ASSERT_TRUE(make_particles(*shop, "tank", tank));
  for (const char* walls : {"free_slip", "no_slip"}) {
    expect_quiet_success(shop->run("lgiw-run tank.h5 -o tank-run.h5 -O --summary tank.json" + quiet +
                                   "--set output.end_time=2.4 --set water.walls=" + walls),
                         "");
    const json s = summary("tank");
    EXPECT_EQ(s.at("lost").at("water"), 0) << walls;
    const auto below = RunReader((*shop / "tank-run.h5").string()).diagnostics().at("below_bed");
    EXPECT_EQ(*std::max_element(below.begin(), below.end()), 0) << walls;
  }
}

// 0.3 sqrt(dp / g) = 0.01354 s, of which 7 make a frame interval nearly.
TEST_F(Run, SurfacesAreTakenAsOftenAsTheSpacingResolves) {
  particles("slide");
  ASSERT_EQ(shop->run("lgiw-run slide.h5 -o often.h5" + quiet + "--set output.surface_interval=auto").status, 0);
  const RunReader run((*shop / "often.h5").string());
  const std::vector<double> times = run.surface_times();
  ASSERT_EQ(times.size(), 29u);
  for (std::size_t k = 0; k < times.size(); ++k) EXPECT_NEAR(times[k], 0.1 / 7 * double(k), 0.001);
  for (std::size_t k = 0; k < run.frame_count(); ++k) EXPECT_EQ(run.frame_time(k), times[7 * k]);
}

TEST_F(Run, DivergenceNamesParticlePlaceAndLastGoodState) {
  // At 20 m/s into water whose sound travels at 12 m/s.
  std::string fast = slide_case;
  fast.replace(fast.find("slide: {"), 8, "slide: {velocity: [20, -20], ");
  ASSERT_TRUE(make_particles(*shop, "fast", fast));
  const Outcome bad = shop->run("lgiw-run fast.h5 -o bad.h5" + quiet +
                                "--set water.sound_speed=12 --set numerics.retakes=0 --set output.end_time=0.2 " +
                                "--set output.checkpoint_interval=1e-6 --set output.frame_interval=0.2" +
                                " --set output.surface_interval=0.2");
  EXPECT_EQ(bad.status, 1);
  EXPECT_EQ(lines(bad.err), 1) << bad.err;
  for (const char* part :
       {"lgiw-run: the run diverged at t = 0.", "water particle ", " at x ", " has velocity (", "density ",
        "the last good state is bad.h5.checkpoint", ".bad.partial.h5", "raise water.sound_speed"})
    EXPECT_NE(bad.err.find(part), std::string::npos) << part << " is not in " << bad.err;
  EXPECT_FALSE(exists("bad.h5"));
  EXPECT_TRUE(exists("bad.h5.checkpoint"));
  // The frames up to there can be looked at.
  const RunReader run((*shop / ".bad.partial.h5").string());
  EXPECT_EQ(run.frame_count(), 1u);
  EXPECT_EQ(run.summary(), "");

  // A place that a person finds: inside the domain, within the water.
  const double x = std::atof(bad.err.c_str() + bad.err.find(" at x ") + 6),
               z = std::atof(bad.err.c_str() + bad.err.find(", z ") + 4);
  EXPECT_GT(x, 0.4);
  EXPECT_LT(x, 2.51);
  EXPECT_GT(z, -0.01);
  EXPECT_LT(z, 0.5);

  // A new run with the same name does not take the old state for its own.
  const Outcome refused = shop->run("lgiw-run fast.h5 -o bad.h5" + quiet);
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("bad.h5.checkpoint exists"), std::string::npos) << refused.err;
  const Outcome anew = shop->run("lgiw-run fast.h5 -o bad.h5 -O" + quiet + "--set water.sound_speed=0.2");
  EXPECT_EQ(anew.status, 1);
  EXPECT_EQ(anew.err.find("last good state"), std::string::npos) << anew.err;
  EXPECT_FALSE(exists("bad.h5.checkpoint"));
}

/// What is left out for a scene changes nothing else: water moves to the bit alike with and without soil out of reach.
TEST_F(Run, WaterDoesNotKnowOfSoilThatItNeverMeets) {
  const std::string alone = R"(name: water
dimension: 2
particle_spacing: 0.02
terrain: {profile: [[0, 0.5], [0.01, 0], [1, 0], [1.4, 0.4], [3, 0.4], [3.01, 1]], wall_top: 1}
water: {level: 0.3, sound_speed: 40, bodies: [[[0.01, 0], [0.5, 0], [0.5, 0.3], [0.01, 0.3]]]}
output: {end_time: 0.4, frame_interval: 0.1, surface_interval: 0.05}
)";
  const std::string soil = R"(slide: {bodies: [[[2.5, 0.4], [3.0, 0.4], [3.0, 0.6], [2.5, 0.6]]]}
soil: {young_modulus: 1.0e+6, friction_angle: 30, cohesion: 2000}
)";
  ASSERT_TRUE(make_particles(*shop, "alone", alone));
  ASSERT_TRUE(make_particles(*shop, "both", alone + soil));
  for (const std::string name : {"alone", "both"})
    expect_quiet_success(
        shop->run("lgiw-run " + name + ".h5 -o " + name + "-run.h5 --summary " + name + ".json" + quiet), "");
  const RunReader with((*shop / "both-run.h5").string()), without((*shop / "alone-run.h5").string());
  ASSERT_EQ(with.frame_count(), 5u);
  ASSERT_EQ(without.frame_count(), 5u);
  const std::size_t n = without.header().particles.counts.water;
  ASSERT_EQ(with.header().particles.counts.water, n);
  ASSERT_GT(with.header().particles.counts.soil, 100u);
  for (std::size_t k = 0; k < 5; ++k) {
    const Frame a = with.frame(k), b = without.frame(k);
    EXPECT_EQ(a.time, b.time);
    for (std::size_t i = 0; i < 3 * n; ++i) {
      ASSERT_EQ(a.points[i], b.points[i]) << "frame " << k << ", component " << i;
      ASSERT_EQ(a.velocity[i], b.velocity[i]) << "frame " << k << ", component " << i;
    }
    for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(a.pressure[i], b.pressure[i]) << "frame " << k << ", particle " << i;
  }
  // And it costs nothing: no array of soil is held.
  EXPECT_LT(double(summary("alone").at("bytes")), 0.7 * double(summary("both").at("bytes")));
  EXPECT_NE(summary("alone").at("left_out").dump().find("soil (stress, Adps, soil and interface kernels)"),
            std::string::npos);
}

/// A solver whose step beyond a time fails as long as its time step is more than a share of the usual one.
class Faulty final : public Simulation {
 public:
  /// `fault` is called after every advance.
  Faulty(std::unique_ptr<Simulation> inner, std::function<void(StepState&)> fault)
      : inner_(std::move(inner)), fault_(std::move(fault)) {}
  StepState advance(double target, int64_t max_steps) override {
    StepState st = inner_->advance(target, max_steps);
    fault_(st);
    return st;
  }
  StepState state() const override { return inner_->state(); }
  void limit_time_step(double share) override { inner_->limit_time_step(share); }
  void settle(Settling mode) override { inner_->settle(mode); }
  void download(ParticleState& out) const override { inner_->download(out); }
  void download_walls(std::vector<float>& p, std::vector<float>& s) const override { inner_->download_walls(p, s); }
  void download_bodies(std::vector<double>& x, std::vector<unsigned>& id) const override {
    inner_->download_bodies(x, id);
  }
  void download_accelerations(std::vector<double>& water, std::vector<double>& soil) const override {
    inner_->download_accelerations(water, soil);
  }
  InternalForces internal_forces() override { return inner_->internal_forces(); }
  std::vector<RawArray> save() const override { return inner_->save(); }
  void restore(const std::vector<RawArray>& arrays) override { inner_->restore(arrays); }
  std::vector<PhaseTime> timings() const override { return inner_->timings(); }
  PhaseBytes bytes() const override { return inner_->bytes(); }
  std::string description() const override { return inner_->description(); }
  std::string device() const override { return inner_->device(); }
  bool leaves_host_free() const override { return elsewhere_; }
  std::vector<std::string> left_out() const override { return inner_->left_out(); }
  /// From now on as if it stepped on a device.
  Faulty& step_elsewhere() {
    elsewhere_ = true;
    return *this;
  }

 private:
  std::unique_ptr<Simulation> inner_;
  std::function<void(StepState&)> fault_;
  bool elsewhere_ = false;
};

/// Steps for 0.02 s after `time` fail above `share` of the time step.
bool fails(const StepState& st, double time, double share) {
  return st.time > time && st.time < time + 0.02 && st.share > share;
}

/// Runs slide.h5 of the shop with steps after 0.13 s that fail above `share` of the time step; the lines of its log.
std::vector<std::string> run_faulty(const Workshop& shop, const std::string& output, double share,
                                    std::string* summary) {
  const ParticleData data = read_particles((shop / "slide.h5").string());
  const Case c = parse_case(data.header.case_text, "slide");
  std::vector<std::string> log;
  RunOptions options;
  options.output = (shop / output).string(), options.overwrite = true, options.provenance = false;
  options.log = [&](const std::string& line) { log.push_back(line); };
  options.wrap = [&](std::unique_ptr<Simulation> solver) {
    return std::make_unique<Faulty>(std::move(solver), [share](StepState& st) {
      if (fails(st, 0.13, share)) st.failed_water = 7;
    });
  };
  *summary = run_case(c, data, options);
  return log;
}

TEST_F(Run, AFailedStretchIsTakenAgainWithASmallerTimeStep) {
  particles("slide");
  std::string text;
  const std::vector<std::string> log = run_faulty(*shop, "faulty.h5", 0.3, &text);
  const json s = json::parse(text);
  EXPECT_EQ(s.at("failed_steps_retaken"), 1) << "one failure, overcome with a quarter of the step";
  const auto said = [&](const std::string& part) {
    return std::count_if(log.begin(), log.end(),
                         [&](const auto& line) { return line.find(part) != std::string::npos; });
  };
  EXPECT_EQ(said("a step failed at t = 0.1"), 2);
  EXPECT_EQ(said("with 1/2 of the time step"), 1);
  EXPECT_EQ(said("with 1/4 of the time step"), 1);
  EXPECT_NE(s.at("warnings").dump().find("with 1/4 of the time step"), std::string::npos) << s.at("warnings");

  // Nothing of the stretches that were given up is left, and nothing is missing.
  const RunReader run((*shop / "faulty.h5").string());
  ASSERT_EQ(run.surface_times().size(), 21u);
  EXPECT_EQ(run.frame_count(), 5u);
  const auto rows = run.diagnostics();
  ASSERT_EQ(rows.at("time").size(), 21u);
  for (std::size_t k = 1; k < 21; ++k) {
    EXPECT_NEAR(run.surface_times()[k], 0.02 * double(k), 0.001);
    EXPECT_GT(rows.at("step")[k], rows.at("step")[k - 1]);
  }
  const auto& steps = rows.at("time_step");
  EXPECT_LT(*std::min_element(steps.begin(), steps.end()), 0.3 * steps.front());
  EXPECT_GT(steps.back(), 0.9 * steps.front()) << "the smaller step does not last";
  // The wave is that of a run without failures, but for the rounding of other steps.
  scene("slide");
  const RunReader usual((*shop / "slide-run.h5").string());
  const auto a = run.water_surface(20), b = usual.water_surface(20);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!std::isnan(a[i]) && !std::isnan(b[i])) {
      EXPECT_NEAR(a[i], b[i], 0.01) << i;
    }
}

/// As many OpenMP threads as that while it lives.
class Threads {
 public:
  explicit Threads(int count) { omp_set_num_threads(count); }
  ~Threads() { omp_set_num_threads(before_); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

 private:
  const int before_ = omp_get_max_threads();
};

/// Where the outputs of a run are made: between its steps, by one of its threads, or by the host while a device steps.
enum class Outputs { between, beside, on_host };

/// Runs slide.h5 of the shop with a solver that fails where `fault` says so; the bytes of the run.
std::string run_with(const Workshop& shop, const std::string& output, Outputs outputs,
                     const std::function<void(StepState&)>& fault, bool resume = false,
                     double checkpoint_interval = 1e9) {
  const ParticleData data = read_particles((shop / "slide.h5").string());
  Case c = parse_case(data.header.case_text, "slide");
  c.output.checkpoint_interval = checkpoint_interval;
  RunOptions options;
  options.output = (shop / output).string(), options.provenance = false, options.resume = resume;
  options.wrap = [&](std::unique_ptr<Simulation> solver) {
    auto faulty = std::make_unique<Faulty>(std::move(solver), fault);
    if (outputs == Outputs::on_host) faulty->step_elsewhere();
    return faulty;
  };
  const Threads threads(outputs == Outputs::between ? 1 : 3);
  run_case(c, data, options);
  EXPECT_EQ(omp_get_max_threads(), outputs == Outputs::between ? 1 : 3) << "all threads are given back";
  return read_bytes(options.output);
}

TEST_F(Run, OutputsMadeWhileTheSolverStepsOnAreTheSame) {
  particles("slide");
  const auto sound = [](StepState&) {};
  const std::string bytes = run_with(*shop, "between.h5", Outputs::between, sound);
  EXPECT_TRUE(run_with(*shop, "beside.h5", Outputs::beside, sound) == bytes);
  EXPECT_TRUE(run_with(*shop, "on-host.h5", Outputs::on_host, sound) == bytes);
  // With a checkpoint after every stroke, and stretches that are taken again.
  const auto failing = [](StepState& st) {
    if (fails(st, 0.13, 0.3)) st.failed_water = 7;
  };
  const std::string again = run_with(*shop, "between-again.h5", Outputs::between, failing, false, 0);
  EXPECT_TRUE(run_with(*shop, "beside-again.h5", Outputs::beside, failing, false, 0) == again);
  EXPECT_TRUE(run_with(*shop, "on-host-again.h5", Outputs::on_host, failing, false, 0) == again);
}
TEST_F(Run, AKilledRunWhoseOutputsAreMadeMeanwhileGoesOnToTheSame) {
  particles("slide");
  const auto sound = [](StepState&) {};
  const std::string whole = run_with(*shop, "whole.h5", Outputs::between, sound);
  const auto dying = [](StepState& st) {
    if (st.time > 0.2) throw std::runtime_error("killed");
  };
  for (const Outputs outputs : {Outputs::beside, Outputs::on_host}) {
    const std::string name = outputs == Outputs::beside ? "killed-beside.h5" : "killed-on-host.h5";
    const int before = omp_get_max_threads();
    EXPECT_THROW(run_with(*shop, name, outputs, dying, false, 0), std::runtime_error);
    EXPECT_EQ(omp_get_max_threads(), before);
    EXPECT_TRUE(run_with(*shop, name, outputs, sound, true) == whole);
  }
}
TEST_F(Run, AnOutputThatFailsMeanwhileStopsTheRun) {
  particles("slide");
  const ParticleData data = read_particles((*shop / "slide.h5").string());
  // Sound as slow as the water.
  const Case c = parse_case(data.header.case_text, "slide", {"water.sound_speed=2"});
  RunOptions options;
  options.output = (*shop / "soft.h5").string(), options.provenance = false;
  std::vector<std::string> said;
  for (const int count : {1, 3}) {
    const Threads threads(count);
    options.overwrite = true;
    try {
      run_case(c, data, options);
    } catch (const WorkError& e) {
      said.push_back(e.what());
    }
  }
  ASSERT_EQ(said.size(), 2u);
  EXPECT_NE(said[0].find("the water is compressed by"), std::string::npos) << said[0];
  EXPECT_EQ(said[1], said[0]);
}

TEST_F(Run, AStepThatFailsWhileTheSceneSettlesIsTakenAgainSettling) {
  particles("slide");
  const ParticleData data = read_particles((*shop / "slide.h5").string());
  const Case c = parse_case(data.header.case_text, "slide",
                            {"numerics.settle_time=0.1", "output.end_time=0.02", "output.frame_interval=0.02"});
  RunOptions options;
  options.output = (*shop / "settled.h5").string(), options.provenance = false;
  int failures = 0;
  options.wrap = [&](std::unique_ptr<Simulation> solver) {
    return std::make_unique<Faulty>(std::move(solver), [&](StepState& st) {
      if (st.settling && fails(st, 0.05, 0.7)) st.failed_water = 7, ++failures;
    });
  };
  const json s = json::parse(run_case(c, data, options));
  EXPECT_EQ(failures, 1);
  EXPECT_EQ(s.at("failed_steps_retaken"), 1);
  const RunReader run(options.output);
  // The soil is held while the water settles.
  const Frame first = run.frame(0);
  for (std::size_t i = 0; i < data.soil.points.size(); ++i)
    EXPECT_NEAR(first.points[data.water.points.size() + i], data.soil.points[i], 1e-3 * data.header.dp) << i;
  const auto rows = run.diagnostics();
  for (const double step : rows.at("time_step"))
    EXPECT_GT(step, 0.7 * rows.at("time_step").front()) << "the smaller step does not last beyond settling";
}

TEST_F(Run, ARunKilledAfterAStepWasTakenAgainGoesOnAndStillSaysSo) {
  particles("slide");
  const ParticleData data = read_particles((*shop / "slide.h5").string());
  Case c = parse_case(data.header.case_text, "slide");
  RunOptions options;
  options.output = (*shop / "killed.h5").string(), options.provenance = false;
  c.output.checkpoint_interval = 0;
  // Of the step that fails at 0.13 s a state from before the last checkpoint is kept; the run ends before another one.
  options.wrap = [&](std::unique_ptr<Simulation> solver) {
    return std::make_unique<Faulty>(std::move(solver), [&](StepState& st) {
      if (st.time > 0.12) c.output.checkpoint_interval = 1e9;
      if (st.share < 1) throw std::runtime_error("killed");
      if (fails(st, 0.13, 0.7)) st.failed_water = 7;
    });
  };
  EXPECT_THROW(run_case(c, data, options), std::runtime_error);
  options.resume = true;
  options.wrap = {};
  const json s = json::parse(run_case(c, data, options));
  EXPECT_EQ(s.at("failed_steps_retaken"), 1);
  EXPECT_NE(s.at("warnings").dump().find("with 1/2 of the time step"), std::string::npos) << s.at("warnings");
  const RunReader run(options.output);
  ASSERT_EQ(run.surface_times().size(), 21u);
  for (std::size_t k = 1; k < 21; ++k) EXPECT_NEAR(run.surface_times()[k], 0.02 * double(k), 0.001);
}

TEST_F(Run, AFileMadeDuringTheRunIsNotOverwritten) {
  particles("dam");
  const ParticleData data = read_particles((*shop / "dam.h5").string());
  const Case c = parse_case(data.header.case_text, "dam");
  RunOptions options;
  options.output = (*shop / "taken.h5").string(), options.provenance = false;
  options.progress = [&](double, const std::string&) { write_bytes(options.output, "precious"); };
  try {
    run_case(c, data, options);
    FAIL() << "it was written";
  } catch (const WorkError& e) {
    EXPECT_NE(
        std::string(e.what()).find("taken.h5 was not written (another program created it meanwhile) the whole run"),
        std::string::npos)
        << e.what();
  }
  EXPECT_EQ(read_bytes(options.output), "precious");
  EXPECT_EQ(RunReader((*shop / ".taken.partial.h5").string()).header().particles.counts.water,
            data.header.counts.water);
}

TEST_F(Run, WhatTheParticlesWereMadeFromCannotBeChangedAndInputsAreNotOverwritten) {
  particles("dam"), particles("slide");
  write_bytes(*shop / "dam.yaml", dam_case);
  std::string deeper = dam_case;
  const std::size_t level = deeper.find("level: ");
  ASSERT_NE(level, std::string::npos);
  deeper.insert(level + 7, "0");
  deeper.replace(level + 7, deeper.find_first_of(",}\n", level) - level - 7, "0.123");
  write_bytes(*shop / "deeper.yaml", deeper);
  fs::copy(*shop / "dam.h5", *shop / "same.h5");
  const auto refused = [&](const std::string& arguments, const std::string& why) {
    const Outcome outcome = shop->run("lgiw-run " + arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(why), std::string::npos) << arguments << ": " << outcome.err;
  };
  refused("dam.h5 -o no.h5 --case deeper.yaml", "(water.level is not what the particles were made with)");
  refused("slide.h5 -o no.h5 --set 'water={level: -0.01}'", "the case does not fit slide.h5 (water.level is not what ");
  refused("dam.h5 -o no.h5 --set gravity=[0,0,-1.6]", "(gravity is not what the particles were made with)");
  refused("slide.h5 -o no.h5 --set soil.density=2345", "(soil.density is not what the particles were made with)");
  refused("dam.h5 -o no.h5 --summary none/s.json", "none/s.json cannot be written");
  refused("dam.h5 -o no.h5 --summary no.h5", "no.h5 is named twice");
  refused("same.h5 -O -o same.h5", "same.h5 is an input");
  refused("dam.h5 -O -o no.h5 --summary dam.h5", "dam.h5 is an input");
  refused("dam.h5 -O -o no.h5 --case dam.yaml --xmf dam.yaml", "dam.yaml is an input");
  EXPECT_EQ(read_bytes(*shop / "same.h5"), read_bytes(*shop / "dam.h5"));
  expect_no_trace("no");
  EXPECT_EQ(shop->run("lgiw-run dam.h5 --dry-run --case dam.yaml").status, 0);
  // What a scheme brings with it, and what a sensitivity study varies.
  for (const char* varied : {"soil.pore_pressure=none", "soil.friction_angle=25", "numerics.scheme=huang2023"})
    EXPECT_EQ(shop->run(std::string("lgiw-run slide.h5 --dry-run --set ") + varied).status, 0) << varied;
}

TEST_F(Run, StepsThatFailHoweverSmallStopTheRun) {
  particles("slide");
  std::string text;
  try {
    run_faulty(*shop, "hopeless.h5", 0, &text);
    FAIL() << "it ran";
  } catch (const WorkError& e) {
    EXPECT_NE(std::string(e.what()).find("the run diverged at t = 0.1"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("also with 1/8 of the time step"), std::string::npos) << e.what();
  }
  EXPECT_FALSE(exists("hopeless.h5"));
  EXPECT_EQ(RunReader((*shop / ".hopeless.partial.h5").string()).surface_times().size(), 7u) << "up to the failure";
}

TEST_F(Run, WaterThatIsCompressedStopsTheRun) {
  std::string fast = slide_case;
  fast.replace(fast.find("slide: {"), 8, "slide: {velocity: [20, -20], ");
  ASSERT_TRUE(make_particles(*shop, "swift", fast));
  const Outcome bad = shop->run("lgiw-run swift.h5 -o swift-run.h5 --set water.sound_speed=25" + quiet);
  EXPECT_EQ(bad.status, 1);
  EXPECT_EQ(lines(bad.err), 1) << bad.err;
  for (const char* part : {"lgiw-run: the water is compressed by ", " its sound at 25 m/s", ".swift-run.partial.h5",
                           "set water.sound_speed to ten times"})
    EXPECT_NE(bad.err.find(part), std::string::npos) << part << " is not in " << bad.err;
  EXPECT_FALSE(exists("swift-run.h5"));
}

TEST_F(Run, CudaWithoutADeviceIsExitThreeAndAutoFallsBack) {
  particles("dam");
  const Outcome version = shop->run("lgiw-run --version");
  if (version.out.find("CUDA backend: yes") != std::string::npos) GTEST_SKIP() << "a CUDA device is at hand";
  const Outcome cuda = shop->run("lgiw-run dam.h5 -o cuda.h5 --backend cuda");
  EXPECT_EQ(cuda.status, 3);
  EXPECT_EQ(lines(cuda.err), 1) << cuda.err;
  EXPECT_NE(cuda.err.find("CUDA"), std::string::npos);
  expect_no_trace("cuda");
  const Outcome fallback = shop->run(
      "lgiw-run dam.h5 -o auto.h5 --set output.end_time=0.01 --set output.frame_interval=0.01 --set "
      "output.surface_interval=0.01");
  EXPECT_EQ(fallback.status, 0);
  EXPECT_NE(fallback.err.find("lgiw-run: no CUDA device ("), std::string::npos) << fallback.err;
  EXPECT_NE(fallback.err.find("running on the CPU"), std::string::npos);
  EXPECT_TRUE(exists("auto.h5"));
}

TEST_F(Run, DryRunPrintsAPlanAndWritesNothing) {
  scene("slide");
  const auto before = shop->contents();
  const Outcome dry = shop->run("lgiw-run slide.h5 -o dry.h5 --dry-run --rate 1e6");
  EXPECT_EQ(dry.status, 0);
  EXPECT_EQ(dry.err, "");
  EXPECT_EQ(shop->contents().size(), before.size());
  const json plan = json::parse(dry.out), s = summary("slide");
  EXPECT_EQ(plan.at("particles"), s.at("particles"));
  EXPECT_EQ(plan.at("left_out"), s.at("left_out"));
  EXPECT_EQ(plan.at("solver_bytes"), s.at("bytes"));
  EXPECT_GT(plan.at("memory_bytes"), 0.9 * double(s.at("peak_memory_bytes")));
  EXPECT_GT(plan.at("disk_bytes_at_most").at("run"), fs::file_size(*shop / "slide-run.h5"));
  EXPECT_NEAR(double(plan.at("steps")), double(s.at("steps")), 0.2 * double(s.at("steps")));
  const double total = double(s.at("particles").at("water")) + double(s.at("particles").at("soil")) +
                       double(s.at("particles").at("wall"));
  EXPECT_NEAR(plan.at("estimated_run_time_s"), 0.4 / double(plan.at("time_step_s")) * total / 1e6, 1e-9);
}

TEST_F(Run, SoundSpeedCanBeOverridden) {
  particles("dam");
  const auto steps = [&](const std::string& options) {
    return double(json::parse(shop->run("lgiw-run dam.h5 --dry-run " + options).out).at("time_step_s"));
  };
  const double automatic = read_particle_header((*shop / "dam.h5").string()).sound_speed;
  EXPECT_NEAR(steps("--set water.sound_speed=100") / steps(""), automatic / 100, 1e-9);
}

TEST_F(Run, ExistingOutputsAreRefused) {
  scene("dam");
  const std::string before = read_bytes(*shop / "dam-run.h5");
  for (const std::string call : {"-o dam-run.h5", "-o new.h5 --summary dam.json", "-o new.h5 --diagnostics dam.csv",
                                 "-o new.h5 --xmf dam.xmf"}) {
    const Outcome refused = shop->run("lgiw-run dam.h5 " + call);
    EXPECT_EQ(refused.status, 2) << call;
    EXPECT_EQ(lines(refused.err), 1) << refused.err;
    EXPECT_NE(refused.err.find(" exists (it would be overwritten) pass -O"), std::string::npos) << refused.err;
  }
  EXPECT_TRUE(read_bytes(*shop / "dam-run.h5") == before);
  expect_no_trace("new");
}

TEST_F(Run, BadParticlesFilesAreOneLineAndNoTrace) {
  particles("dam"), scene("slide");
  const std::string good = read_bytes(*shop / "dam.h5");
  write_bytes(*shop / "truncated.h5", good.substr(0, good.size() / 2));
  write_bytes(*shop / "text.h5", "x,y,z\n1,2,3\n");
  write_bytes(*shop / "empty.h5", "");
  write_bytes(*shop / "nan.h5", good);
  h5::File::open_write((*shop / "nan.h5").string())
      .write_slab("/VTKHDF/Points", std::vector<double>{NAN}.data(), {7, 0}, {1, 1});
  for (const auto& [name, why] : {std::pair{"truncated", "truncated.h5"}, std::pair{"text", "not an HDF5 file"},
                                  std::pair{"empty", "not an HDF5 file"}, std::pair{"nan", "Points"},
                                  std::pair{"missing", "No such file"}, std::pair{"slide-run", "lgiw-run 1"}}) {
    const Outcome refused = shop->run(std::string("lgiw-run ") + name + ".h5 -o new.h5");
    EXPECT_EQ(refused.status, 2) << name;
    EXPECT_EQ(lines(refused.err), 1) << refused.err;
    EXPECT_NE(refused.err.find(why), std::string::npos) << refused.err;
    expect_no_trace("new");
  }
}

// Water alone: no stress is held. In bytes, what a coupled scene holds for its soil particles beyond what water has.
TEST_F(Run, WaterAloneHoldsNoStress) {
  scene("dam"), scene("slide");
  const json water = summary("dam"), both = summary("slide");
  const auto left_out = [](const json& s, const std::string& start) -> std::string {
    for (const std::string line : s.at("left_out"))
      if (line.compare(0, start.size(), start) == 0) return line;
    return "";
  };
  const double n_water = water.at("particles").at("water"), n_wall = water.at("particles").at("wall");
  // Mixed precision, plane strain: 4 stresses, their next values, their spare ones, and Adps, 4 bytes each.
  char bytes[32];
  std::snprintf(bytes, sizeof bytes, "%.1f MiB", (n_water + n_wall) * (3 * 4 + 1) * 4 / (1 << 20));
  EXPECT_EQ(left_out(water, "soil "), std::string("soil (stress, Adps, soil and interface kernels): ") + bytes);
  EXPECT_EQ(left_out(both, "soil "), "");
  EXPECT_NE(left_out(both, "stress and Adps of water particles: "), "");
  EXPECT_NE(left_out(both, "Coulomb"), "");

  // By particle. Water: 2 positions of 8; rounded position, velocity and acceleration of 2; density, next density,
  // pressure of 1, id and cell; to sort, one number of each kind and the order. Walls: position 2, volume, 2 images,
  // id.
  const double water_bytes = 2 * 8 + 4 * (3 * 2 + 3) + 2 * 4 + (4 + 8 + 4 + 4), wall_bytes = 4 * (2 + 1 + 2) + 4;
  const double rest = double(water.at("bytes")) - n_water * water_bytes - n_wall * wall_bytes;  // where cells start
  EXPECT_GE(rest, 0);
  const double cells = std::ceil((1.5 + 0.06) / 0.03 + 4) * std::ceil(2.0 / 0.03 + 4);
  EXPECT_LT(rest, 2 * 4 * (cells + 1));
  // Walls of a coupled scene hold 4 stresses, 2 velocities, 2 normals and slip besides, and the soil 4 stresses twice
  // and Adps.
  const double soil_bytes = 2 * 8 + 4 * (3 * 2 + 2 * 4 + 1 + 2) + 2 * 4 + (4 + 8 + 4 + 4),
               wall_more = 4 * (4 + 2 + 2 + 1);
  const double expected = double(both.at("particles").at("water")) * water_bytes +
                          double(both.at("particles").at("soil")) * soil_bytes +
                          double(both.at("particles").at("wall")) * (wall_bytes + wall_more);
  const double both_cells = std::ceil((2.5 + 0.12) / 0.06 + 4) * std::ceil(3.0 / 0.06 + 4);
  // Tiles, of four particles or more on average: cell, number of rows, five rows and box, and an eighth to spare.
  // Stress of the water, 13 numbers a particle, would be more.
  const double tile_bytes = 1.125 * (4 + 4 + 5 * 2 * 4 + 5 * 4);
  const double particles = double(both.at("particles").at("water")) + double(both.at("particles").at("soil")) +
                           double(both.at("particles").at("wall"));
  ASSERT_LT(tile_bytes * particles / 4, 13 * 4 * double(both.at("particles").at("water")));
  EXPECT_GE(double(both.at("bytes")), expected);
  EXPECT_LT(double(both.at("bytes")), expected + 3 * 4 * (both_cells + 1) + tile_bytes * particles / 4);
}

}  // namespace
}  // namespace lgiw::test
