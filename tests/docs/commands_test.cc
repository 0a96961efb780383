// The commands that cookbook and tutorial print, run as they stand against small scenes.
#include <regex>

#include "bowl.hh"
#include "tool_runner.hh"

namespace lgiw::test {
namespace {

/// Blocks of a document that begin with ```sh and nothing more; those marked `sh long` are runs of real cases.
std::vector<std::string> commands_of(const std::string& document) {
  std::ifstream file(LGIW_SOURCE_DIR "/docs/" + document);
  std::vector<std::string> blocks;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("```", 0) == 0) {
      inside = line == "```sh";
      if (inside) blocks.emplace_back();
    } else if (inside) {
      blocks.back() += line + "\n";
    }
  }
  return blocks;
}

/// Runs a block in `folder` with the same rules as the pipeline's recipes, the home folder and `programs` in the
/// workshop.
Outcome run_block(const Workshop& shop, const std::string& block, const std::string& folder) {
  write_bytes(shop / "block.sh", "cd '" + folder + "'\n" + block);
  return shop.run("env HOME=\"$PWD\" PATH=\"$PWD/programs:$PATH\" LC_ALL=C.UTF-8 bash -eu -o pipefail block.sh");
}

TEST(Commands, OfTheCookbookRunAndPrint) {
  const Workshop shop;
  fs::create_directories(shop / "demo");
  // The slide moves, and the water with it.
  write_bytes(shop / "demo/case.yaml", replaced(replaced(bowl_case, "end_time: 1\n", "end_time: 4\n"),
                                                "friction_angle: 20", "friction_angle: 5"));
  write_bytes(shop / "demo/dem.asc", ascii_grid());
  const std::string out = (shop / "out/demo").string();
  const Outcome made = shop.run("env -u MAKEFLAGS -u MAKELEVEL make -C '" LGIW_SOURCE_DIR
                                "/pipelines' BIN='" LGIW_BIN_DIR "' CASE_DIR='" +
                                (shop / "demo").string() + "' out='" + out + "' '" + out + "/summary.txt'");
  ASSERT_EQ(made.status, 0) << made.err;
  // The other machine is a folder of this one.
  fs::create_directories(shop / "programs");
  fs::create_directories(shop / "big");
  write_bytes(shop / "programs/ssh", "#!/bin/bash\ncd ~/\"$1\"\nshift\n\"$@\"\n");
  write_bytes(shop / "programs/scp", "#!/bin/bash\ncp \"${2/#big:/$HOME/big/}\" \"${3/#big:/$HOME/big/}\"\n");
  ASSERT_EQ(shop.run("chmod +x programs/ssh programs/scp").status, 0);

  const std::vector<std::string> blocks = commands_of("cookbook.md");
  ASSERT_GT(blocks.size(), 10u);
  const std::regex silent("timeout|scp|ogr2ogr -f GeoJSON");
  for (const std::string& block : blocks) {
    const Outcome outcome = run_block(shop, block, out);
    EXPECT_EQ(outcome.status, 0) << block << outcome.err << outcome.out;
    EXPECT_EQ(outcome.err, "") << block;
    EXPECT_EQ(outcome.out.empty(), std::regex_search(block, silent)) << block;
  }
  for (const char* file :
       {"slow.h5", "big.run.h5", "inundation.geojson", "shore_runup.shp", "max_depth.asc", "depth.kml"})
    EXPECT_TRUE(fs::exists(shop / "out/demo" / file)) << file;
}

TEST(Commands, OfTheTutorialMakeTheCaseItTellsOf) {
  const Workshop shop;
  std::string printed;
  for (const std::string& block : commands_of("tutorial.md")) {
    const Outcome outcome = run_block(shop, block, LGIW_SOURCE_DIR);
    EXPECT_EQ(outcome.status, 0) << block << outcome.err;
    printed += outcome.out;
  }
  std::ifstream file(LGIW_SOURCE_DIR "/docs/tutorial.md");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  // Level and depth, volume, thickness: what the text says and what the tools print.
  for (const char* heights : {"1486.6", "1485.6", "1599.1"})
    EXPECT_NE(printed.find(heights), std::string::npos) << heights;
  EXPECT_NE(text.find("1487, 1486 and 1599 m"), std::string::npos);
  std::smatch volume;
  ASSERT_TRUE(std::regex_search(printed, volume, std::regex("soil +[0-9]+ particles +([0-9.e+]+) m3"))) << printed;
  EXPECT_NEAR(std::stod(volume[1]), 2.08e6, 0.01e6);
  EXPECT_NE(text.find("2.08 million m3"), std::string::npos);
  EXPECT_NE(printed.find("slide 4 particles thick (median), water 7.99 deep"), std::string::npos) << printed;
  EXPECT_NE(text.find("slide 4 particles thick (median), water 7.99 deep"), std::string::npos);
}

/// The case that is kept is the one that the tutorial leads to.
TEST(Commands, TheTutorialsCaseIsTheOneInPipelines) {
  const Workshop shop;
  const std::string dry_run = "dem2particles '" LGIW_SOURCE_DIR "/pipelines/tirol/case.yaml' --dry-run";
  const Outcome outcome = shop.run(dry_run);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::smatch volume;
  ASSERT_TRUE(std::regex_search(outcome.out, volume, std::regex("soil +[0-9]+ particles +([0-9.e+]+) m3")))
      << outcome.out;
  EXPECT_NEAR(std::stod(volume[1]), 2.07e6, 0.03e6);
}

}  // namespace
}  // namespace lgiw::test
