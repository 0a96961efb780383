// dem2particles as a user runs it.
#include <nlohmann/json.hpp>

#include "../tools/bowl.hh"
#include "../tools/tool_runner.hh"
#include "files/particle_file.hh"
#include "scene.hh"

namespace lgiw::test {
namespace {

const std::string slide = R"(
name: slide
dimension: 2
particle_spacing: 0.01
terrain: {profile: [[-0.3, 0.3], [0.15, -0.15], [1, -0.15]]}
water: {level: 0}
slide: {bodies: [[[-0.1, 0.1], [0, 0], [0, 0.1]]]}
output: {end_time: 2, frame_interval: 0.1}
)";

TEST(Tool, WritesWhatTheLibraryMakes) {
  const Workshop shop;
  write_bytes(shop / "case.yaml", slide);
  expect_quiet_success(shop.run("dem2particles -q case.yaml -o p.h5"), "dem2particles");
  const ParticleData file = read_particles((shop / "p.h5").string());
  const Scene s = seeded(slide);
  EXPECT_EQ(file.water.points, s.data.water.points);
  EXPECT_EQ(file.water.pressure, s.data.water.pressure);
  EXPECT_EQ(file.soil.points, s.data.soil.points);
  EXPECT_EQ(file.soil.stress, s.data.soil.stress);
  EXPECT_EQ(file.wall.points, s.data.wall.points);
  EXPECT_EQ(file.wall.normal, s.data.wall.normal);
  EXPECT_EQ(file.wall.kind, s.data.wall.kind);
  EXPECT_EQ(file.header.sound_speed, s.data.header.sound_speed);
  EXPECT_NEAR(file.header.sound_speed, 20 * std::sqrt(9.81 * 0.15), 1e-3);
  EXPECT_EQ(file.header.case_text, slide);
  EXPECT_NE(file.header.provenance.find("case.yaml"), std::string::npos);
  EXPECT_EQ(shop.contents().size(), 2u);  // and no temporary file
}

TEST(Tool, RerunsAreByteIdentical) {
  const Workshop shop;
  write_bytes(shop / "case.yaml", slide);
  shop.run("dem2particles -q case.yaml -o a.h5 --no-provenance");
  shop.run("dem2particles -q case.yaml -o b.h5 --no-provenance");
  EXPECT_FALSE(read_bytes(shop / "a.h5").empty());
  EXPECT_EQ(read_bytes(shop / "a.h5"), read_bytes(shop / "b.h5"));
}

TEST(Tool, DryRunTellsAndWritesNothing) {
  const Workshop shop;
  write_bytes(shop / "case.yaml", slide);
  const Outcome outcome = shop.run("dem2particles -q case.yaml --dry-run --json --rate 1e6");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(shop.contents().size(), 1u);
  const auto j = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(j["case"], "slide");
  const Scene s = seeded(slide);
  EXPECT_EQ(j["particles"]["water"], s.data.header.counts.water);
  EXPECT_EQ(j["particles"]["soil"], s.data.header.counts.soil);
  EXPECT_EQ(j["particles"]["wall"], s.data.header.counts.wall);
  EXPECT_NEAR(j["soil"]["volume_between_surfaces"], 0.005, 2e-5);
  EXPECT_NEAR(j["water"]["volume"], 0.85 * 0.15 + 0.15 * 0.15 / 2, 1e-3);
  EXPECT_NEAR(j["run"]["run_time_s"].get<double>(),
              j["run"]["steps"].get<double>() * j["particles"]["total"].get<double>() / 1e6, 1e-6);
  const Outcome text = shop.run("dem2particles case.yaml --dry-run");
  EXPECT_NE(text.out.find("lgiw-run: about"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("left out where neither water nor soil can get"), std::string::npos);
}

TEST(Tool, OverridesReachTheParticles) {
  const Workshop shop;
  write_bytes(shop / "case.yaml", slide);
  const Outcome outcome = shop.run("dem2particles -q - --dry-run --json --set particle_spacing=0.005 < case.yaml");
  EXPECT_EQ(outcome.status, 2);  // the runner's stdin is empty: not a case
  const Outcome set = shop.run("dem2particles -q case.yaml --dry-run --json --set particle_spacing=0.005");
  ASSERT_EQ(set.status, 0) << set.err;
  EXPECT_EQ(nlohmann::json::parse(set.out)["particle_spacing"], 0.005);
}

TEST(Tool, RefusesBeforeAnyWork) {
  const Workshop shop;
  write_bytes(shop / "case.yaml", slide);
  write_bytes(shop / "old.h5", "old");
  const auto before = shop.contents();
  const std::vector<std::pair<std::string, std::string>> refused{
      {"dem2particles case.yaml", "no output is named"},
      {"dem2particles case.yaml -o old.h5", "--overwrite"},
      {"dem2particles case.yaml -o missing/p.h5", "missing"},
      {"dem2particles none.yaml -o p.h5", "none.yaml"},
      {"dem2particles case.yaml -o p.h5 --rate -3", "--rate"},
      {"dem2particles case.yaml -o p.h5 --set particle_spacing=0.2", "there is no soil"},
      {"dem2particles case.yaml -o p.h5 --set particle_spacing=1e-9", "at least 1e-05"},
      {"dem2particles case.yaml -o p.h5 --set particle_spacing=1e-5 --set terrain.profile=[[-1e3,1e3],[1e3,0]]",
       "terrain nodes"},
      {"dem2particles case.yaml -o p.h5 --set slide=null --set water.level=-0.2", "water.level"},
  };
  for (const auto& [command, message] : refused) {
    const Outcome outcome = shop.run(command);
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_EQ(outcome.err.rfind("dem2particles: ", 0), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << command << "\n" << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "") << command;
    EXPECT_EQ(shop.contents(), before) << command;
  }
  EXPECT_EQ(shop.run("dem2particles -q case.yaml -o old.h5 -O").status, 0);
}

TEST(Tool, RefusesToOverwriteInputsAndGaugesBeyondTheTerrain) {
  const Workshop shop;
  write_bytes(shop / "dem.asc", ascii_grid());
  write_bytes(shop / "bowl.yaml", bowl_case);
  const auto before = shop.contents();
  const std::vector<std::pair<std::string, std::string>> refused{
      {"-O -o dem.asc", "dem.asc is an input"},
      {"-O -o bowl.yaml", "bowl.yaml is an input"},
      {"-o p.h5 --set 'gauges=[{name: far, x: 600000, y: 3700000}]'",
       "gauge far at x = 600000, y = 3700000 lies outside"},
      {"-o p.h5 --set 'sections=[{name: far, points: [[0, 0], [1, 1]]}]'", "section far at x = 0, y = 0 lies outside"}};
  for (const auto& [arguments, message] : refused) {
    const Outcome outcome = shop.run("dem2particles -q bowl.yaml --set terrain.window=null " + arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << arguments << "\n" << outcome.err;
    EXPECT_EQ(shop.contents(), before) << arguments;
  }
  EXPECT_EQ(read_bytes(shop / "dem.asc"), ascii_grid());
}

TEST(Tool, ToldStepsIncludeThoseOfSoilThatSettles) {
  const Workshop shop;
  write_bytes(shop / "case.yaml", slide);
  const auto steps = [&](const std::string& command) {
    return double(nlohmann::json::parse(shop.run(command).out)["steps"]);
  };
  const std::string settled = " --set soil.initial_stress=settled";
  expect_quiet_success(shop.run("dem2particles -q case.yaml -o p.h5" + settled), "dem2particles");
  const nlohmann::json told = nlohmann::json::parse(shop.run("dem2particles case.yaml --dry-run --json" + settled).out);
  EXPECT_NEAR(double(told["run"]["steps"]), steps("lgiw-run p.h5 --dry-run"), 0.1 * double(told["run"]["steps"]))
      << "but for soil that does not lie in columns";
  const nlohmann::json held = nlohmann::json::parse(shop.run("dem2particles case.yaml --dry-run --json").out);
  EXPECT_GT(double(told["run"]["steps"]), double(held["run"]["steps"]));
}

}  // namespace
}  // namespace lgiw::test
