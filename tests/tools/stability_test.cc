// The stability matrix: what it makes of points that pass, that break a criterion and that are refused.
#include <nlohmann/json.hpp>

#include "tool_runner.hh"

namespace lgiw::test {
namespace {

using nlohmann::json;

const std::string tools =
    "DEM2PARTICLES='" LGIW_BIN_DIR "/dem2particles' LGIW_RUN='" LGIW_BIN_DIR "/lgiw-run' TIME_LIMIT=100 ";
const std::string run_point = "'" LGIW_SOURCE_DIR "/pipelines/stability/run-point' ";

/// A column of water of 20 m that breaks, 1 s of it, as a point of the matrix.
json dam_point(const std::string& id, double sound_speed) {
  return json{{"id", id},
              {"axis", "sound"},
              {"value", sound_speed},
              {"scene", "dam"},
              {"rest", false},
              {"variant", "2-D"},
              {"dimension", 2},
              {"expect", "pass"},
              {"case", json::parse(R"({"name": "point", "dimension": 2, "particle_spacing": 2,
                "terrain": {"profile": [[0, 0], [60, 0]], "wall_top": 40},
                "water": {"level": 20, "bodies": [[[0, 0], [20, 0], [20, 20], [0, 20]]]},
                "output": {"end_time": 1, "frame_interval": 0.2}, "numerics": {"retakes": 0}})")}};
}

json row_of(const Workshop& shop, const std::string& id) {
  const Outcome outcome = shop.run(tools + run_point + id + " matrix.json out");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return json::parse(read_bytes(shop / ("out/" + id + "/row.json")));
}

TEST(Stability, PointsAreJudgedAndTheLimitOfTheTimeStepIsSought) {
  Workshop shop;
  json sound = dam_point("1", 280), slow = dam_point("2", 280), refused = dam_point("3", 280),
       wrong = dam_point("4", 280);
  slow["case"]["water"]["sound_speed"] = 40;
  refused["expect"] = "refused", refused["case"]["gravity"] = {0, 0, 0};
  wrong["expect"] = "refused";
  write_bytes(shop / "matrix.json", json{sound, slow, refused, wrong}.dump());

  const json passed = row_of(shop, "1");
  EXPECT_EQ(passed.at("pass"), true) << passed;
  EXPECT_EQ(passed.at("criterion"), "all");
  EXPECT_EQ(passed.at("dt_limited_by"), "acoustic");
  EXPECT_GE(passed.at("largest_stable_cfl"), 0.6) << "larger steps were tried";
  EXPECT_GT(passed.at("dt_s"), 0);

  const json compressed = row_of(shop, "2");
  EXPECT_EQ(compressed.at("pass"), false) << compressed;
  EXPECT_NE(compressed.at("criterion").get<std::string>().find("density error"), std::string::npos) << compressed;
  EXPECT_NE(compressed.at("announced").get<std::string>().find("raise water.sound_speed"), std::string::npos);
  EXPECT_TRUE(compressed.at("largest_stable_cfl").is_null()) << "no smaller step makes water stiffer";

  EXPECT_EQ(row_of(shop, "3").at("pass"), true) << "one line and exit 2, as it should be";
  const json ran = row_of(shop, "4");
  EXPECT_EQ(ran.at("pass"), false);
  EXPECT_EQ(ran.at("criterion"), "not refused");
}

TEST(Stability, TheMatrixIsATableAndAFigure) {
  Workshop shop;
  const Outcome outcome = shop.run("env -u MAKEFLAGS -u MAKELEVEL make -C '" LGIW_SOURCE_DIR
                                   "/pipelines' BIN='" LGIW_BIN_DIR "' stability_out='" +
                                   (shop / "").string() + "' stability AXES='^degenerate' VARIANTS='^2-D$'");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("empty reservoir"), std::string::npos) << outcome.out;
  const std::string csv = read_bytes(shop / "stability.csv");
  EXPECT_EQ(csv.compare(0, 40, "\"axis\",\"value\",\"scene\",\"variant\",\"dimensi"), 0) << csv.substr(0, 60);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);  // the header and six points
  EXPECT_EQ(read_bytes(shop / "stability.png").compare(1, 3, "PNG"), 0);
}

}  // namespace
}  // namespace lgiw::test
