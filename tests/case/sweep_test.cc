// A sweep: which runs it makes, how they are called, and what is refused where.
#include "case/sweep.hh"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.hh"
#include "case/case.hh"

namespace lgiw {
namespace {

const std::string base = R"(name: canyon
particle_spacing: 10
terrain:
  sources: [{file: dem.tif}]
water:
  level: 740
  seed: [390700, 3795400]
slide:
  polygon: [[391000, 3796000], [391500, 3796000], [391500, 3796500]]
  depth: 40
soil: {friction_angle: 25}  # of the rubble
)";

using Lines = std::vector<std::string>;

Lines names(const Sweep& sweep) {
  Lines all;
  for (const SweepRun& run : sweep.runs) all.push_back(run.name);
  return all;
}

std::string message_of(const std::string& text, const Lines& overrides = {}) {
  try {
    parse_sweep(text, "s.yaml", base, "c.yaml", overrides);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Sweep, OfTwoListsIsEveryCombination) {
  const Sweep sweep = parse_sweep("soil.friction_angle: [26, 28]\nwater.level: [735, 740]\nparticle_spacing: 20\n",
                                  "s.yaml", base, "c.yaml", {"slide.depth=30"});
  EXPECT_EQ(sweep.keys, (Lines{"soil.friction_angle", "water.level"}));
  EXPECT_EQ(names(sweep), (Lines{"friction_angle=26,level=735", "friction_angle=26,level=740",
                                 "friction_angle=28,level=735", "friction_angle=28,level=740"}));
  const SweepRun& last = sweep.runs.back();
  EXPECT_EQ(last.overrides, (Lines{"particle_spacing=20", "soil.friction_angle=28", "water.level=740"}));
  EXPECT_EQ(last.inputs, (Lines{"28", "740"}));
  const Case c = parse_case(last.case_text, "run");
  EXPECT_EQ(c.dp, 20);
  EXPECT_EQ(c.soil.friction_angle, 28);
  EXPECT_EQ(c.water.level, 740);
  EXPECT_EQ(c.slide.surface.depth, 30) << "--set counts below the sweep";
}

TEST(Sweep, RunsOfItsOwnAreCombinedWithItsLists) {
  const Sweep sweep = parse_sweep(R"(
runs:
  - {name: as_it_is}
  - {name: deep, slide.depth: null, slide.slbl: {max_depth: 60}}
  - {slide.depth: 20}
water.level: [735, 740]
)",
                                  "s.yaml", base, "c.yaml");
  EXPECT_EQ(names(sweep), (Lines{"as_it_is,level=735", "as_it_is,level=740", "deep,level=735", "deep,level=740",
                                 "depth=20,level=735", "depth=20,level=740"}));
  EXPECT_EQ(sweep.keys, (Lines{"slide.depth", "slide.slbl", "water.level"}));
  EXPECT_EQ(sweep.runs[0].inputs, (Lines{"40", "", "735"})) << "the case's own value where the run sets none";
  EXPECT_EQ(sweep.runs[2].inputs, (Lines{"", "{max_depth: 60}", "735"}));
  EXPECT_EQ(parse_case(sweep.runs[3].case_text, "run").slide.surface.slbl->max_depth, 60);
}

TEST(Sweep, NamesAreFoldersThatTellTheKeysApart) {
  EXPECT_EQ(names(parse_sweep("soil.density: [1900]\nwater.density: [1000]\n", "s", base, "c")),
            Lines{"soil.density=1900,water.density=1000"});
  EXPECT_EQ(
      names(parse_sweep("terrain.sources.0.file: [a/b.tif]\nslide.velocity: [[0, 0, 0], [1, 0, 0]]\n", "s", base, "c")),
      (Lines{"terrain.sources.0.file=a-b.tif,velocity=1", "terrain.sources.0.file=a-b.tif,velocity=2"}));
}

// The text of the case as it is run is what make compares: words that change nothing change no text.
TEST(Sweep, CommentsAndOtherRunsLeaveACaseTextAsItIs) {
  const auto text = [](const std::string& sweep, const std::string& of) {
    return parse_sweep(sweep, "s.yaml", of, "c.yaml").runs.front().case_text;
  };
  const std::string before = text("water.level: [735]\n", base);
  EXPECT_EQ(text("# more\nwater.level: [735, 741]\n", "# a comment\n" + base), before);
  EXPECT_NE(text("water.level: [736]\n", base), before);
}

TEST(Sweep, RefusesInOneLineWithItsPlace) {
  EXPECT_EQ(message_of("water.level: [735]\nsoil.friction_angel: [26, 28]\n"),
            "s.yaml:2: unknown key \"friction_angel\" (soil has no such key) did you mean \"friction_angle\"?");
  EXPECT_EQ(
      message_of("soil.friction_angle:\n  - 26\n  - 95\n"),
      "s.yaml:3: soil.friction_angle is 95 (it must be 0 or at least 2 and at most 60 degrees) the default is 30");
  EXPECT_EQ(message_of("soil: {friction_angle: [26, 28]}\n"),
            "s.yaml:1: soil is a mapping of keys (keys of a sweep are dotted) write soil.friction_angle: [values]");
  EXPECT_EQ(message_of("water.level: [735, 735]\n"),
            "s.yaml: two runs are called level=735 (each has a folder of its own) leave one out, or name them in runs");
  EXPECT_EQ(message_of("water.level: 735\n"),
            "s.yaml: nothing is swept (no key has a list of values) write soil.friction_angle: [26, 28, 30]");
  EXPECT_EQ(message_of(""),
            "s.yaml:1: the sweep is empty (it names keys of the case and lists of their values) write "
            "soil.friction_angle: [26, 28, 30]");
  EXPECT_EQ(message_of("runs: [{water.level: 735}]\nwater.level: [740]\n"),
            "s.yaml:1: water.level is given twice (runs and the sweep itself both set it) leave one of them out");
  EXPECT_EQ(
      message_of("runs: [{name: ../up, water.level: 735}]\n"),
      "s.yaml:1: \"../up\" is no name of a run (it names a folder) write a letter, then letters, digits and _ . -");
  EXPECT_EQ(message_of("name: [a, b]\n"),
            "s.yaml:1: name is no key to sweep (it names the case, not a run) name a run in runs: - {name: ..., key: "
            "value}");
  EXPECT_EQ(message_of("water.level: [735\n").rfind("s.yaml:", 0), 0u);
  EXPECT_EQ(message_of("water.level: []\n"),
            "s.yaml:1: water.level has no values (an empty list makes no runs) give it some");
  std::string many = "water.level: [1";
  for (int k = 2; k <= 40; ++k) many += ", " + std::to_string(k);
  EXPECT_EQ(
      message_of(many + "]\nparticle_spacing" + many.substr(11) + "]\n"),
      "s.yaml: more than 1000 runs (every value is run with every other) shorten the lists, or name the runs one by "
      "one in runs");
  EXPECT_EQ(message_of("water.level: [735]\n", {"soil.frction=3"}).rfind("--set soil.frction=3: ", 0), 0u)
      << "an unsound case is not the sweep's fault";
}

TEST(Sweep, CasesAndSweepsOfThePipelineAreSound) {
  int cases = 0, sweeps = 0;
  for (const auto& folder : std::filesystem::directory_iterator(LGIW_SOURCE_DIR "/pipelines")) {
    const std::string path = folder.path().string();
    if (!std::filesystem::exists(path + "/case.yaml")) continue;
    EXPECT_NO_THROW(read_case(path + "/case.yaml")) << path;
    ++cases;
    if (!std::filesystem::exists(path + "/sweep.yaml")) continue;
    EXPECT_NO_THROW(EXPECT_GT(read_sweep(path + "/sweep.yaml", path + "/case.yaml").runs.size(), 1u)) << path;
    ++sweeps;
  }
  EXPECT_GE(cases, 4);
  EXPECT_GE(sweeps, 1);
}

}  // namespace
}  // namespace lgiw
