// The benchmarks of speed, on scenes so coarse that they take a second: their records and tables, not how fast anything
// is.
#include <cmath>
#include <nlohmann/json.hpp>

#include "tool_runner.hh"

namespace lgiw::test {
namespace {

using nlohmann::json;

class Bench : public testing::Test {
 protected:
  std::string make(const std::string& goal) {
    const Outcome outcome = shop.run("env -u MAKEFLAGS -u MAKELEVEL make -C '" LGIW_SOURCE_DIR
                                     "/pipelines' BIN='" LGIW_BIN_DIR "' bench_out='" +
                                     (shop / "out").string() + "' " + goal);
    EXPECT_EQ(outcome.status, 0) << goal << "\n" << outcome.err;
    return outcome.out;
  }
  json result(const std::string& file) { return json::parse(read_bytes(shop / ("out/" + file))); }
  Workshop shop;
};

TEST_F(Bench, RecordsTellWhatRanWhereAndWhatTheTimeWentInto) {
  const std::string table = make("bench SCENES='water-2d soil-3d' SPACING=4 ROUNDS=1");
  const json scenes = result("bench.json");
  ASSERT_EQ(scenes.size(), 2u);
  for (const json& scene : scenes) {
    EXPECT_EQ(scene.at("device"), "CPU");
    EXPECT_EQ(scene.at("threads"), 2);
    EXPECT_FALSE(scene.at("instructions").get<std::string>().empty());
    EXPECT_GT(scene.at("particle_steps_per_s"), 0);
    EXPECT_GT(scene.at("bytes_per_particle"), 40);
    double sum = 0;
    for (const auto& [phase, share] : scene.at("wall_time_shares").items()) sum += double(share);
    EXPECT_NEAR(sum, 1, 1e-9);
    EXPECT_GT(scene.at("wall_time_shares").at("start-up and output"), 0);
    EXPECT_NE(table.find(scene.at("scene").get<std::string>()), std::string::npos);
  }
  // Spheres and circles of 3 and 2.82 spacings hold 112 and 24 others, less at free surfaces.
  EXPECT_EQ(scenes[0].at("scene"), "soil-3d");
  EXPECT_NEAR(double(scenes[0].at("neighbours_per_particle")), 100, 20);
  EXPECT_NEAR(double(scenes[1].at("neighbours_per_particle")), 21, 4);
}

TEST_F(Bench, ScalingComparesSizesAndThreadsAndLeavesOutWhatMemoryDoesNotHold) {
  const std::string tables =
      make("bench-scaling SCALING_SCENES=water-3d SIZES='1e4 2e4 1e15' THREADS='1 2' SCALING_SECONDS=0.1 ROUNDS=2");
  const json scaling = result("scaling.json");
  const json& sizes = scaling.at("sizes").at(0);
  ASSERT_EQ(sizes.at("runs").size(), 2u);
  EXPECT_NEAR(double(sizes.at("runs")[0].at("total")), 1e4, 1e3);
  EXPECT_NEAR(double(sizes.at("runs")[1].at("total")), 2e4, 2e3);
  const double first = sizes.at("runs")[0].at("ns_per_particle_step"),
               second = sizes.at("runs")[1].at("ns_per_particle_step");
  EXPECT_NEAR(double(sizes.at("spread")), std::max(first, second) / std::min(first, second) - 1, 1e-9);
  EXPECT_EQ(sizes.at("within_bar"), double(sizes.at("spread")) <= 0.15);
  const auto speed = [&](const std::string& run) -> double {
    return result("scaling/water-3d." + run + ".json").at("stepping_particle_steps_per_s");
  };
  const double rounds[] = {speed("sizes.1e4.1"), speed("sizes.1e4.2")};
  EXPECT_NEAR(1e9 / first, std::max(rounds[0], rounds[1]), 1e-6 * rounds[0]);
  EXPECT_NEAR(double(sizes.at("runs")[0].at("rounds_differ_by")),
              std::max(rounds[0], rounds[1]) / std::min(rounds[0], rounds[1]) - 1, 1e-9);
  const json& threads = scaling.at("threads").at(0).at("runs");
  ASSERT_EQ(threads.size(), 2u);
  EXPECT_EQ(threads[0].at("efficiency"), 1);
  EXPECT_NEAR(double(threads[1].at("efficiency")),
              double(threads[1].at("particle_steps_per_s")) / double(threads[0].at("particle_steps_per_s")) / 2, 1e-9);
  EXPECT_NE(tables.find("water-3d: cost per particle-step differs by"), std::string::npos) << tables;

  make("bench-scaling SCALING_SCENES=water-3d SIZES=1e4 SCALING_SECONDS=0.1 ROUNDS=1 BENCH_FLAGS='--threads 1'");
  EXPECT_EQ(result("scaling.json").at("sizes").size(), 1u);
  EXPECT_TRUE(result("scaling.json").at("threads").empty());
}

TEST_F(Bench, APartOfABarIsExtrapolatedAndSaysSo) {
  const json summary = {{"particles", {{"water", 90}, {"soil", 10}, {"wall", 20}, {"left_out", 5}}},
                        {"particle_spacing_m", 2},
                        {"device", "CPU"},
                        {"threads", 2},
                        {"model", "CPU, AVX2 instructions, mixed precision, 3-D, Wendland C2"},
                        {"steps", 50},
                        {"end_time_s", 6},
                        {"wall_time_s", 30},
                        {"set_up_time_s", 2},
                        {"stepping_time_s", 28},
                        {"stepping_particle_steps_per_s", 2e6},
                        {"neighbours_per_particle", 100},
                        {"phase_seconds", {{"sort", 8}, {"diagnostics", 1}}}};
  write_bytes(shop / "run.json", summary.dump());
  const auto record = [&](const std::string& end) {
    const std::string folder = LGIW_SOURCE_DIR "/pipelines/bench";
    const Outcome outcome =
        shop.run("jq -L '" + folder + "' --arg name any --argjson end_time " + end +
                 " --argjson bar '{\"bar_s\": 600, \"bar\": \"ten minutes\", \"note\": \"\"}' -f '" + folder +
                 "/bars.jq' run.json");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return json::parse(outcome.out);
  };
  const json part = record("60"), whole = record("6");
  EXPECT_EQ(part.at("extrapolated"), true);
  EXPECT_EQ(part.at("whole_s"), 300);
  EXPECT_EQ(part.at("times_the_bar"), 0.5);
  EXPECT_EQ(part.at("model_time_within_bar_s"), 120);
  EXPECT_EQ(part.at("instructions"), "AVX2");
  EXPECT_EQ(part.at("wall_time_shares").at("sort"), 0.25);
  EXPECT_EQ(whole.at("extrapolated"), false);
  EXPECT_EQ(whole.at("whole_s"), 30);

  write_bytes(shop / "bars.json", json::array({part}).dump());
  const Outcome table = shop.run("jq -r -L '" LGIW_SOURCE_DIR "/pipelines/bench' -f '" LGIW_SOURCE_DIR
                                 "/pipelines/bench/bars-table.jq' bars.json");
  EXPECT_NE(table.out.find("5 min, EXTRAPOLATED"), std::string::npos) << table.out << table.err;
}

TEST_F(Bench, OnAGpuNeedsWhatWasPreparedAndADevice) {
  const std::string script = LGIW_SOURCE_DIR "/pipelines/bench-gpu";
  EXPECT_EQ(shop.run(script).status, 2);
  EXPECT_EQ(shop.run(script + " run '" + (shop / "nowhere").string() + "'").status, 2);

  if (shop.run("lgiw-run --version").out.find("CUDA backend: yes") != std::string::npos)
    GTEST_SKIP() << "a CUDA device is at hand";
  const std::string prepared =
      "mkdir -p ready/particles && xz -1 -c '" LGIW_BIN_DIR
      "/lgiw-run' > ready/lgiw-run.xz && "
      "dem2particles '" LGIW_SOURCE_DIR
      "/pipelines/validation/viroulet/case.yaml' -q -o small.h5 --set particle_spacing=0.02 && "
      "mv small.h5 ready/particles/small-coupled-2d.h5 && xz ready/particles/small-coupled-2d.h5";
  expect_quiet_success(shop.run(prepared), prepared);
  const Outcome outcome = shop.run(script + " run '" + (shop / "ready").string() + "'");
  EXPECT_EQ(outcome.status, 3) << outcome.out << outcome.err;
  EXPECT_NE(outcome.err.find("THERE IS NO CUDA DEVICE HERE"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(shop / "ready/results/gpu.json"));
}

// The numbers that huangtian/README.md promises: a spur of 115 m and trapezoidal section, 40 million m3, beside 175 m
// of water.
TEST_F(Bench, TheStandInForHuangtianHoldsTheSlideAndTheLakeOfItsReadme) {
  fs::copy(LGIW_SOURCE_DIR "/pipelines/huangtian", shop / "huangtian", fs::copy_options::recursive);
  const Outcome computed =
      shop.run("awk -f huangtian/terrain/gorge.awk > gorge.asc && mv gorge.asc huangtian/terrain/");
  ASSERT_EQ(computed.status, 0) << computed.err;
  const Outcome outcome = shop.run("dem2particles huangtian/case.yaml --dry-run --json -q");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json j = json::parse(outcome.out);
  EXPECT_EQ(j.at("particle_spacing"), 7.5);
  EXPECT_NEAR(double(j.at("soil").at("volume")), 64.0e6, 0.3e6);
  EXPECT_NEAR(double(j.at("particles").at("total")), 1.16e6, 0.01e6);
  EXPECT_NEAR(double(j.at("particles").at("left_out")), 0.24e6, 0.01e6);
  const Outcome lowest = shop.run(
      "awk 'NR > 5 {for (k = 1; k <= NF; ++k) if (!n++ || $k < low) low = $k} END {print low}' "
      "huangtian/terrain/gorge.asc");
  EXPECT_NEAR(1160 - std::stod(lowest.out), 175, 0.1);
}

}  // namespace
}  // namespace lgiw::test
