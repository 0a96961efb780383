// make sensitivity on a small flume: variants in folders of their own, the table, and the line in the case's summary.
#include <cmath>
#include <nlohmann/json.hpp>

#include "tool_runner.hh"

namespace lgiw::test {
namespace {

using nlohmann::json;

// The flume of pipeline_test.cc, shorter, with a bank at its far end.
const std::string flume = R"(name: flume
dimension: 2
particle_spacing: 0.01
terrain:
  profile: [[-0.3, 0.3], [0, 0], [0.3, 0], [0.6, 0.3]]
water:
  level: 0.15
slide:
  bodies:
    - [[-0.15, 0.15], [-0.15, 0.25], [-0.25, 0.25]]
soil: {friction_angle: 25, young_modulus: 1e6, density: 1900}
output: {end_time: 0.8, frame_interval: 0.1}
gauges:
  - {name: near, x: 0.1}
  - {name: far, x: 0.35}
sections:
  - {name: A, points: [[-0.2, 0], [0.59, 0]]}
)";

class Sensitivity : public testing::Test {
 protected:
  Sensitivity() {
    fs::create_directory(shop / "flume");
    write_bytes(shop / "flume/case.yaml", flume);
  }
  Outcome make(const std::string& goals) {
    return shop.run("env -u MAKEFLAGS -u MAKELEVEL make -j 2 -C '" LGIW_SOURCE_DIR "/pipelines' BIN='" LGIW_BIN_DIR
                    "' CASE_DIR='" +
                    (shop / "flume").string() + "' out='" + (shop / "out").string() + "' " + goals);
  }
  json result(const std::string& file) { return json::parse(read_bytes(shop / ("out/" + file))); }
  std::string summary_line() {
    const std::string text = read_bytes(shop / "out/summary.txt");
    const std::size_t at = text.find("uncertainty");
    return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
  }
  Workshop shop;
};

TEST_F(Sensitivity, OfAFlumeVariesAngleLevelAndSpacing) {
  const Outcome alone = make((shop / "out/summary.txt").string());
  ASSERT_EQ(alone.status, 0) << alone.err << alone.out;
  EXPECT_NE(summary_line().find("not studied; type make -C pipelines CASE_DIR="), std::string::npos) << summary_line();

  const Outcome outcome = make("sensitivity");
  ASSERT_EQ(outcome.status, 0) << outcome.err << outcome.out;
  const json plan = result("sensitivity/plan.json");
  EXPECT_DOUBLE_EQ(plan["steps"]["friction_angle_deg"], 2);
  // The flume is 0.15 m deep: 2 % of that, since a metre is too much.
  EXPECT_NEAR(plan["steps"]["level_m"].get<double>(), 0.003, 1e-6);
  EXPECT_EQ(plan["variants"]["friction_low"], json::array({"soil.friction_angle=23"}));
  EXPECT_EQ(plan["variants"]["dp_x1.5"], json::array({"particle_spacing=0.015"}));
  EXPECT_EQ(plan["variants"].size(), 5u);

  const json study = result("sensitivity/sensitivity.json");
  ASSERT_EQ(study["rows"].size(), 4u) << study["rows"];
  const json base = result("summary.json");
  for (const json& row : study["rows"]) {
    const std::string name = row["quantity"];
    double largest = 0;
    std::string dominates;
    for (const char* source : {"friction", "level", "numerical"}) {
      ASSERT_TRUE(row[source].is_number()) << row;
      if (row[source].get<double>() > largest) largest = row[source].get<double>(), dominates = source;
    }
    // One of those that are alike, where two are: both may add a particle to a volume.
    EXPECT_EQ(row[row["dominates"].get<std::string>()], largest) << row << dominates;
    EXPECT_GT(largest, 0) << row;
    EXPECT_EQ(row["basis"], "spread") << row;
    if (name != "max_wave_height_m") {
      EXPECT_DOUBLE_EQ(row["value"], base[name].get<double>()) << row;
    }
    // The changes are those of the variants' own runs.
    if (name == "immersed_volume_m3")
      for (const std::string variant : {"friction_low", "friction_high", "level_low", "level_high", "dp_x1.5"}) {
        const json changed = result("sensitivity/" + variant + "/summary.json");
        EXPECT_NEAR(row["changes"][variant].get<double>(), changed[name].get<double>() - base[name].get<double>(),
                    1e-12);
        EXPECT_EQ(changed["parameters"]["friction_angle_deg"], variant == "friction_low"    ? 23
                                                               : variant == "friction_high" ? 27
                                                                                            : 25);
      }
  }
  EXPECT_NE(read_bytes(shop / "out/sensitivity/sensitivity.txt").find("wave height (m)"), std::string::npos);
  EXPECT_EQ(read_bytes(shop / "out/sensitivity/sensitivity.csv").substr(0, 27), "\"quantity\",\"unit\",\"value\",\"");
  EXPECT_NE(summary_line().find("dominated by: wave height"), std::string::npos) << summary_line();

  // Nothing is run again; another step reruns its variants alone.
  const auto date = [&](const std::string& file) { return fs::last_write_time(shop / ("out/sensitivity/" + file)); };
  const auto friction = date("friction_low/run.h5"), level = date("level_low/run.h5"),
             study_date = date("sensitivity.json");
  ASSERT_EQ(make("sensitivity").status, 0);
  EXPECT_EQ(date("friction_low/run.h5"), friction);
  EXPECT_EQ(date("sensitivity.json"), study_date);
  const Outcome again = make("sensitivity FRICTION_STEP=1 DP_FACTORS='1.5 2.25'");
  ASSERT_EQ(again.status, 0) << again.err << again.out;
  EXPECT_EQ(date("level_low/run.h5"), level);
  EXPECT_NE(date("friction_low/run.h5"), friction);
  EXPECT_EQ(result("sensitivity/convergence.json")["particle_spacing_m"].size(), 3u);
}

TEST_F(Sensitivity, WithoutASlideHasNoFrictionVariants) {
  std::string text = flume;
  const std::size_t slide = text.find("slide:"), output = text.find("output:");
  // A water body above the level falls, so that something moves; the level does not move it.
  text = text.substr(0, slide) + text.substr(output);
  text.replace(text.find("  level: 0.15"), 13,
               "  level: 0.15\n  bodies: [[[-0.15, 0.15], [0, 0], [0.3, 0], [0.4, 0.1], [0.4, 0.2], [-0.2, 0.2]]]");
  write_bytes(shop / "flume/case.yaml", text);
  const Outcome outcome = make("sensitivity");
  ASSERT_EQ(outcome.status, 0) << outcome.err << outcome.out;
  EXPECT_EQ(result("sensitivity/plan.json")["variants"].size(), 1u);
  EXPECT_EQ(result("sensitivity/sensitivity.json")["rows"][0]["dominates"], "numerical");
}

}  // namespace
}  // namespace lgiw::test
