// The tools one after the other, on a 2-D flume and on a 3-D bowl.
#include <cmath>
#include <nlohmann/json.hpp>

#include "bowl.hh"
#include "tool_runner.hh"

namespace lgiw::test {
namespace {

// A wedge of soil of 0.1 x 0.1 m / 2 just above the water on a slope of 45 degrees, and 1 m of flat bed under 0.15 m of
// water.
const std::string flume_case = R"(name: flume
dimension: 2
particle_spacing: 0.01
terrain:
  profile: [[-0.3, 0.3], [0, 0], [1, 0]]
water:
  level: 0.15
slide:
  bodies:
    - [[-0.15, 0.15], [-0.15, 0.25], [-0.25, 0.25]]
soil:
  friction_angle: 25
  cohesion: 20
  young_modulus: 1e6
  density: 1900
output:
  end_time: 0.5
  frame_interval: 0.05
gauges:
  - {name: near, x: 0.2}
  - {name: far, x: 0.8}
)";

std::vector<std::string> flume_commands(const std::string& flags) {
  return {
      "dem2particles case.yaml -o particles.h5" + flags,
      "lgiw-run particles.h5 -o run.h5 --backend cpu --summary run.json --diagnostics diagnostics.csv --xmf run.xmf" +
          flags,
      "gauges run.h5 -o gauges.csv --long --peaks peaks.csv --netcdf gauges.nc --summary gauges.json" + flags,
      "deposit-volume run.h5 -o slide.csv --profiles profiles.csv --summary slide.json" + flags,
      "impulse-wave run.h5 -o impulse.csv --summary impulse.json" + flags};
}

std::vector<std::string> bowl_commands(const std::string& flags) {
  return {
      "dem2particles case.yaml -o particles.h5" + flags,
      "lgiw-run particles.h5 -o run.h5 --backend cpu --summary run.json --diagnostics diagnostics.csv --xmf run.xmf" +
          flags,
      "gauges run.h5 -o gauges.csv --peaks peaks.csv --netcdf gauges.nc --maps . --runup runup.csv --thresholds 1,2 "
      "--summary gauges.json" +
          flags,
      "deposit-volume run.h5 -o slide.csv --thickness thickness.tif --profiles profiles.csv --summary slide.json" +
          flags,
      "impulse-wave run.h5 -o impulse.csv --summary impulse.json" + flags};
}

void write_flume(const Workshop& workshop) { write_bytes(workshop / "case.yaml", flume_case); }

void write_bowl(const Workshop& workshop) {
  write_bytes(workshop / "case.yaml", bowl_case);
  write_bytes(workshop / "dem.asc", ascii_grid());
}

void run_all(const Workshop& workshop, const std::vector<std::string>& commands) {
  for (const std::string& command : commands) expect_quiet_success(workshop.run(command), command);
}

nlohmann::json json_in(const Workshop& workshop, const std::string& name) {
  return nlohmann::json::parse(read_bytes(workshop / name));
}

/// The flume with a rigid wedge that runs 0.2 m down the slope within half a second, through make: there is a wave and
/// no deposit.
TEST(Pipeline, ARigidSlideThrowsAWaveAndLeavesNoDeposit) {
  const Workshop workshop;
  fs::create_directory(workshop / "rigid");
  std::string text = flume_case;
  const std::size_t soil = text.find("soil:"), output = text.find("output:");
  text.replace(soil, output - soil, "");
  text.insert(text.find("output:"), "  motion: {file: motion.csv}\n");
  write_bytes(workshop / "rigid/case.yaml", text);
  std::string motion = "t_s,dx_m,dz_m\n";
  for (int k = 0; k <= 10; ++k) {
    const double t = 0.05 * k, way = 0.2 * (3 * t * t / 0.25 - 2 * t * t * t / 0.125);
    motion += std::to_string(t) + "," + std::to_string(way * std::sqrt(0.5)) + "," +
              std::to_string(-way * std::sqrt(0.5)) + "\n";
  }
  write_bytes(workshop / "rigid/motion.csv", motion);
  const std::string out = (workshop / "out").string();
  const Outcome outcome = workshop.run("env -u MAKEFLAGS -u MAKELEVEL make -C '" LGIW_SOURCE_DIR
                                       "/pipelines' BIN='" LGIW_BIN_DIR "' CASE_DIR='" +
                                       (workshop / "rigid").string() + "' out='" + out + "' '" + out + "/summary.txt'");
  ASSERT_EQ(outcome.status, 0) << outcome.err << outcome.out;
  const auto summary = json_in(workshop, "out/summary.json");
  EXPECT_EQ(summary["particles"]["soil"], 0);
  EXPECT_TRUE(summary["slide_volume_m3"].is_null());
  EXPECT_FALSE(fs::exists(workshop / "out/slide.csv"));
  const auto& near = summary["gauges"][0];
  EXPECT_EQ(near["name"], "near");
  EXPECT_GT(near["max_height_m"].get<double>(), 0.005);
  EXPECT_LT(near["max_height_m"].get<double>(), 0.06);
}

TEST(Pipeline, FlumeSlideThrowsAWaveThatTheNearGaugeSeesFirst) {
  const Workshop workshop;
  write_flume(workshop);
  run_all(workshop, flume_commands(" -q"));

  const auto run = json_in(workshop, "run.json"), gauges = json_in(workshop, "gauges.json"),
             slide = json_in(workshop, "slide.json"), impulse = json_in(workshop, "impulse.json")["impulse_wave"];
  // Areas: 1 x 0.15 + 0.15^2 / 2 of water, 0.1^2 / 2 of soil, in particles of 0.01^2.
  EXPECT_NEAR(run["particles"]["water"].get<double>(), 1612.5, 0.01 * 1612.5);
  EXPECT_NEAR(run["particles"]["soil"].get<double>(), 50, 2);
  EXPECT_GT(run["particles"]["wall"].get<int>(), 0);
  EXPECT_EQ(run["mass_error"].get<double>(), 0);
  EXPECT_LT(run["density_error"].get<double>(), 0.02);
  EXPECT_GT(run["steps"].get<int>(), 0);
  EXPECT_NEAR(run["end_time_s"].get<double>(), 0.5, 1e-3);
  EXPECT_GT(run["particle_steps_per_s"].get<double>(), 0);

  // Long waves run at sqrt(9.81 x 0.15) = 1.21 m/s: 0.2 m are passed within the run, 0.8 m are not.
  ASSERT_EQ(gauges["gauges"].size(), 2u);
  const auto &near = gauges["gauges"][0], &far = gauges["gauges"][1];
  EXPECT_EQ(near["name"], "near");
  EXPECT_GT(near["arrival_s"].get<double>(), 0.2 / 1.21);
  EXPECT_LT(near["arrival_s"].get<double>(), 0.5);
  EXPECT_TRUE(far["arrival_s"].is_null());
  EXPECT_GT(near["max_height_m"].get<double>(), 0.01);
  EXPECT_LT(near["max_height_m"].get<double>(), 0.05);  // the slide's centre fell 0.1 m at first
  EXPECT_NEAR(far["max_height_m"].get<double>(), 0, 0.001);
  EXPECT_EQ(gauges["still_water_level_m"].get<double>(), 0.15);

  // On a slope steeper than its friction angle all of the wedge goes, and nearly all is under water at the end.
  const double soil = slide["soil_volume_m3"].get<double>();
  EXPECT_NEAR(soil, 0.005, 0.0002);
  EXPECT_NEAR(slide["slide_volume_m3"].get<double>() + slide["unmoved_volume_m3"].get<double>() +
                  slide["lost_soil_volume_m3"].get<double>(),
              soil, 1e-9);
  EXPECT_GT(slide["slide_volume_m3"].get<double>(), 0.9 * soil);
  EXPECT_GT(slide["immersed_volume_m3"].get<double>(), 0.8 * soil);
  EXPECT_LE(slide["immersed_volume_m3"].get<double>(), soil);
  EXPECT_LT(slide["max_slide_speed_m_s"].get<double>(), std::sqrt(2 * 9.81 * 0.25));  // free fall from its top
  EXPECT_EQ(slide["deposit"]["direction_deg"].get<double>(), 90);

  // The wedge is 0.1 m high and slides from rest: its centre falls 0.1 m at most on its way.
  const auto& impact = impulse["slide"];
  EXPECT_NEAR(impact["volume_m3"].get<double>(), slide["immersed_volume_m3"].get<double>(), 0.1 * soil);
  EXPECT_GT(impact["speed_m_s"].get<double>(), 0.3);
  EXPECT_LT(impact["speed_m_s"].get<double>(), std::sqrt(2 * 9.81 * 0.1));
  EXPECT_NEAR(impact["slope_deg"].get<double>(), 45, 10);
  EXPECT_GT(impact["thickness_m"].get<double>(), 0.02);
  EXPECT_LT(impact["thickness_m"].get<double>(), 0.1 * std::sqrt(2));
  EXPECT_DOUBLE_EQ(impact["still_water_depth_m"].get<double>(), 0.15);
  EXPECT_EQ(impulse["places"][1]["name"], "near");
  const auto& crest = impulse["places"][1]["estimates"][0];
  EXPECT_EQ(crest["quantity"], "first_crest_m");
  EXPECT_GT(crest["predicted"].get<double>(), crest["simulated"].get<double>() / 3);
  EXPECT_LT(crest["predicted"].get<double>(), crest["simulated"].get<double>() * 3);
}

TEST(Pipeline, TheSummaryOfMakeHasTheEmpiricalCrossCheck) {
  const Workshop workshop;
  fs::create_directory(workshop / "flume");
  write_bytes(workshop / "flume/case.yaml", flume_case);
  const std::string out = (workshop / "out").string();
  const Outcome outcome = workshop.run("env -u MAKEFLAGS -u MAKELEVEL make -C '" LGIW_SOURCE_DIR
                                       "/pipelines' BIN='" LGIW_BIN_DIR "' CASE_DIR='" +
                                       (workshop / "flume").string() + "' out='" + out + "' '" + out + "/summary.txt'");
  ASSERT_EQ(outcome.status, 0) << outcome.err << outcome.out;
  EXPECT_GT(read_bytes(workshop / "out/impulse.csv").size(), 0u);
  const std::string summary = read_bytes(workshop / "out/summary.txt");
  EXPECT_NE(summary.find("  empirical        VAW 254, P 0."), std::string::npos) << summary;
  EXPECT_NE(summary.find("limits of its tests broken: F 0."), std::string::npos) << summary;
  EXPECT_NE(summary.find(" (simulated 0.0"), std::string::npos) << summary;
}

TEST(Pipeline, BowlLeavesEveryOutput) {
  const Workshop workshop;
  write_bowl(workshop);
  run_all(workshop, bowl_commands(" -q"));
  for (const char* name :
       {"particles.h5",  "run.h5",        "run.json",      "diagnostics.csv", "run.xmf",        "gauges.csv",
        "peaks.csv",     "gauges.nc",     "runup.csv",     "gauges.json",     "ground.tif",     "max_elevation.tif",
        "max_depth.tif", "max_speed.tif", "arrival.tif",   "arrival_1m.tif",  "arrival_2m.tif", "hazard.tif",
        "wave.gpkg",     "slide.csv",     "thickness.tif", "profiles.csv",    "slide.json",     "impulse.csv",
        "impulse.json"})
    EXPECT_GT(read_bytes(workshop / name).size(), 0u) << name;
  EXPECT_EQ(workshop.contents().size(), 27u) << "and nothing besides the case and its DEM";
}

void expect_same_bytes(const std::function<void(const Workshop&)>& write_inputs,
                       const std::vector<std::string>& commands) {
  const Workshop first, second;
  for (const Workshop* workshop : {&first, &second}) write_inputs(*workshop), run_all(*workshop, commands);
  auto a = first.contents(), b = second.contents();
  for (auto* files : {&a, &b}) files->erase("run.json");  // it tells the wall time
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [name, bytes] : a) EXPECT_TRUE(b.count(name) && b.at(name) == bytes) << name << " differs";
}

TEST(Pipeline, FlumeRerunIsByteIdentical) { expect_same_bytes(write_flume, flume_commands(" -q --no-provenance")); }
TEST(Pipeline, BowlRerunIsByteIdentical) { expect_same_bytes(write_bowl, bowl_commands(" -q --no-provenance")); }

TEST(Pipeline, CaseComesThroughAPipeAndTablesLeaveThroughOne) {
  const Workshop workshop;
  write_flume(workshop);
  const std::string seed = "sh -c 'dem2particles - -o particles.h5 -q --set output.end_time=0.05 <case.yaml'";
  const std::string go = "lgiw-run particles.h5 -o run.h5 -q --backend cpu";
  expect_quiet_success(workshop.run(seed), seed);
  expect_quiet_success(workshop.run(go), go);
  const Outcome gauges = workshop.run("gauges run.h5 -q --no-provenance");
  expect_quiet_success(gauges, "gauges");
  EXPECT_EQ(gauges.out.rfind("time_s,near,far\n0,", 0), 0u) << gauges.out;
  const Outcome slide = workshop.run("deposit-volume run.h5 -q --no-provenance");
  expect_quiet_success(slide, "deposit-volume");
  EXPECT_EQ(slide.out.rfind("time_s,slide_volume_m3,immersed_volume_m3,", 0), 0u) << slide.out;
}

TEST(Pipeline, RunWithoutADeviceSaysSoAndExits3) {
  const Workshop workshop;
  write_flume(workshop);
  expect_quiet_success(workshop.run("dem2particles case.yaml -o particles.h5 -q --set output.end_time=0.05"),
                       "dem2particles");
  const Outcome outcome = workshop.run("CUDA_VISIBLE_DEVICES= lgiw-run particles.h5 -o run.h5 --backend cuda -q");
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.err.rfind("lgiw-run: ", 0), 0u) << outcome.err;
  EXPECT_FALSE(fs::exists(workshop / "run.h5"));
}

}  // namespace
}  // namespace lgiw::test
