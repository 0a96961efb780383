// make sweep on small scenes: runs in folders of their own, one table, maps of the worst of all; a run that fails sinks
// no other, and an edit reruns what it touches. TERRAIN= and SITE= put a case on maps of the user's own.
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "bowl.hh"
#include "tool_runner.hh"

namespace lgiw::test {
namespace {

using nlohmann::json;

class Sweep : public testing::Test {
 protected:
  Sweep() {
    fs::create_directories(shop / "bowl");
    write_bytes(shop / "bowl/case.yaml", replaced(replaced(bowl_case, "end_time: 1", "end_time: 2"), "- file: dem.asc",
                                                  "- {file: dem.asc, attribution: Survey office}"));
    write_bytes(shop / "bowl/dem.asc", ascii_grid());
  }
  Outcome make(const std::string& goals) {
    return shop.run("env -u MAKEFLAGS -u MAKELEVEL -u called_from make -C '" LGIW_SOURCE_DIR
                    "/pipelines' BIN='" LGIW_BIN_DIR "' CASE_DIR='" +
                    (shop / "bowl").string() + "' OUT='" + (shop / "out").string() + "' " + goals);
  }
  json sweep() { return json::parse(read_bytes(shop / "out/sweep/sweep.json")); }
  auto date(const std::string& file) { return fs::last_write_time(shop / ("out/" + file)); }
  /// The values of a raster, row by row from the north; NaN is no-data.
  std::vector<double> raster(const std::string& name) {
    const Outcome outcome = shop.run("gdal_translate -q -of XYZ 'out/" + name + "' /vsistdout/");
    EXPECT_EQ(outcome.status, 0) << name << outcome.err;
    std::istringstream rows(outcome.out);
    std::vector<double> values;
    for (std::string x, y, z; rows >> x >> y >> z;) values.push_back(std::stod(z));
    return values;
  }
  Workshop shop;
};

TEST_F(Sweep, GathersItsRunsMarksWhatFailsAndRerunsWhatAnEditTouches) {
  // The third lake would stand above all of the terrain.
  write_bytes(shop / "bowl/sweep.yaml", "water.level: [110, 120, 500]\nsoil.friction_angle: [16]\n");
  const Outcome first = make("sweep -j 2");
  EXPECT_NE(first.status, 0) << "a run failed";
  const std::vector<std::string> names{"level=110,friction_angle=16", "level=120,friction_angle=16",
                                       "level=500,friction_angle=16"};
  EXPECT_NE(first.out.find("sweep: " + names[0] + " (--threads " +
                           std::to_string(std::max(std::stoi(shop.run("nproc").out) / 2, 1)) + ")"),
            std::string::npos)
      << first.out;
  json result = sweep();
  ASSERT_EQ(result["runs"].size(), 3u);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(result["runs"][k]["name"], names[k]);
  EXPECT_EQ(result["runs"][1]["inputs"]["water.level"], 120);
  EXPECT_NE(result["runs"][2]["error"].get<std::string>().find("dem2particles: "), std::string::npos)
      << result["runs"][2];
  for (int k = 0; k < 2; ++k) {
    const json own = json::parse(read_bytes(shop / ("out/sweep/" + names[k] + "/summary.json")));
    EXPECT_EQ(result["runs"][k]["runup_m"], own["runup_m"]);
    EXPECT_EQ(own["still_water_level_m"], k == 0 ? 110 : 120);
  }
  const std::string text = read_bytes(shop / "out/sweep/sweep.txt");
  EXPECT_NE(text.find("Sweep of bowl: 3 runs, 1 of them failed"), std::string::npos) << text;
  EXPECT_TRUE(std::regex_search(text, std::regex("level=500,friction_angle=16 +500 .*FAILED"))) << text;
  EXPECT_NE(text.find("failed:  level=500,friction_angle=16: dem2particles: "), std::string::npos) << text;
  const std::string csv = read_bytes(shop / "out/sweep/sweep.csv");
  EXPECT_EQ(csv.rfind("\"run\",\"water.level\",\"soil.friction_angle\",\"status\",\"max_height_m\",\"runup_m\"", 0),
            0u);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);

  // The envelope by hand, from the two runs' own maps.
  const auto low = raster("sweep/" + names[0] + "/max_elevation.tif"),
             high = raster("sweep/" + names[1] + "/max_elevation.tif");
  const auto low_class = raster("sweep/" + names[0] + "/hazard.tif"),
             high_class = raster("sweep/" + names[1] + "/hazard.tif");
  const auto height = raster("sweep/envelope_height.tif"), worst = raster("sweep/envelope_hazard.tif"),
             above = raster("sweep/share_above_1m.tif"), far_above = raster("sweep/share_above_3m.tif");
  ASSERT_EQ(height.size(), low.size());
  int wet = 0, differ = 0;
  for (std::size_t n = 0; n < low.size(); ++n) {
    EXPECT_EQ(std::isnan(height[n]), std::isnan(low[n]) && std::isnan(high[n]));
    if (!std::isnan(height[n])) {
      EXPECT_NEAR(height[n], std::fmax(low[n] - 110, high[n] - 120), 1e-3);
    }
    EXPECT_EQ(worst[n], std::max(low_class[n], high_class[n]));
    const double expected = ((low_class[n] > 1) + (high_class[n] > 1)) / 2.0;
    if (worst[n] > 0) {
      EXPECT_EQ(above[n], expected);
      EXPECT_EQ(far_above[n], ((low_class[n] > 2) + (high_class[n] > 2)) / 2.0);
    } else {
      EXPECT_TRUE(std::isnan(above[n]));
    }
    wet += worst[n] > 0, differ += expected == 0.5;
  }
  EXPECT_GT(wet, 50);
  EXPECT_GT(differ, 0);
  const json info = json::parse(shop.run("gdalinfo -json out/sweep/share_above_1m.tif").out);
  EXPECT_NE(info["coordinateSystem"]["wkt"].get<std::string>().find("32611"), std::string::npos);
  EXPECT_EQ(info["metadata"]["IMAGE_STRUCTURE"]["LAYOUT"], "COG");
  EXPECT_EQ(info["metadata"][""]["TIFFTAG_COPYRIGHT"], "Survey office");
  EXPECT_NE(info["bands"][0]["description"].get<std::string>().find("share of 2 runs"), std::string::npos);
  EXPECT_EQ(json::parse(shop.run("gdalinfo -json out/sweep/envelope_height.tif").out)["bands"][0]["unit"], "m");
  for (const char* style :
       {"envelope_height", "envelope_hazard", "envelope_arrival", "share_above_1m", "share_above_3m"})
    EXPECT_NE(read_bytes(shop / ("out/sweep/" + std::string(style) + ".qml")).find("<qgis"), std::string::npos)
        << style;
  for (const char* figure : {"sweep.png", "sweep-map.png"})
    EXPECT_GT(read_bytes(shop / ("out/sweep/" + std::string(figure))).size(), 5000u) << figure;

  // Less of the lakes, a comment in the case and one more angle: only what is new is run.
  const auto before = date("sweep/" + names[0] + "/run.h5");
  write_bytes(shop / "bowl/case.yaml", "# words\n" + read_bytes(shop / "bowl/case.yaml"));
  write_bytes(shop / "bowl/sweep.yaml", "water.level: [110]\nsoil.friction_angle: [16, 24]\n");
  const Outcome second = make("sweep");
  ASSERT_EQ(second.status, 0) << second.err << second.out;
  EXPECT_EQ(date("sweep/" + names[0] + "/run.h5"), before);
  result = sweep();
  ASSERT_EQ(result["runs"].size(), 2u);
  for (const json& run : result["runs"]) EXPECT_FALSE(run.contains("error")) << run;
  const auto maps = date("sweep/envelope_height.tif"), figure = date("sweep/sweep.png");
  const Outcome third = make("sweep");
  ASSERT_EQ(third.status, 0) << third.err << third.out;
  EXPECT_EQ(date("sweep/envelope_height.tif"), maps);
  EXPECT_EQ(date("sweep/sweep.png"), figure);
  // An edit of the case's own values touches all of them.
  write_bytes(shop / "bowl/case.yaml", replaced(read_bytes(shop / "bowl/case.yaml"), "end_time: 2", "end_time: 1"));
  ASSERT_EQ(make("sweep").status, 0);
  EXPECT_GT(date("sweep/" + names[0] + "/run.h5"), before);

  // Asked what it would do, make leaves a run's mark and log as they are; a DEM beside the case is one of its files.
  write_bytes(shop / ("out/sweep/" + names[0] + "/failed"), "boom");
  const std::string log = read_bytes(shop / ("out/sweep/" + names[0] + "/log"));
  EXPECT_EQ(make("-n sweep").status, 0);
  EXPECT_EQ(read_bytes(shop / ("out/sweep/" + names[0] + "/failed")), "boom");
  EXPECT_EQ(read_bytes(shop / ("out/sweep/" + names[0] + "/log")), log);
  fs::remove(shop / ("out/sweep/" + names[0] + "/failed"));
  const std::string run =
      "MEMBER=2 -n '" + (shop / "out/sweep/level=110,friction_angle=24/particles.h5").string() + "'";
  EXPECT_EQ(make(run).out.find("dem2particles"), std::string::npos);
  fs::last_write_time(shop / "bowl/dem.asc", fs::file_time_type::clock::now());
  EXPECT_NE(make(run).out.find("dem2particles"), std::string::npos);

  // A run by its number, and what belongs to it alone.
  const Outcome one = make("MEMBER=2 '" + (shop / "out/sweep/level=110,friction_angle=24/summary.txt").string() + "'");
  EXPECT_EQ(one.status, 0) << one.err << one.out;
  EXPECT_NE(read_bytes(shop / "out/sweep/level=110,friction_angle=24/summary.txt").find("Case bowl"),
            std::string::npos);
  const Outcome nobody = make("MEMBER=9 sweep-member");
  EXPECT_EQ(nobody.status, 2);
  EXPECT_NE(nobody.err.find("there is no run 9 (the sweep has no such name or number) sweep-list lists them"),
            std::string::npos)
      << nobody.err;
}

TEST_F(Sweep, ListsItsRunsAndTheCommandsOfAJobArrayWhoseTasksAreTheRuns) {
  write_bytes(shop / "bowl/case.yaml", replaced(bowl_case, "end_time: 1", "end_time: 0.5"));
  const std::string own = "[[500180, 3699940], [500260, 3699940], [500260, 3700060], [500180, 3700060]]",
                    larger = "[[500180, 3699920], [500260, 3699920], [500260, 3700080], [500180, 3700080]]";
  write_bytes(shop / "bowl/sweep.yaml",
              "runs:\n  - {name: low}\n  - {name: high, water.level: 120, slide.polygon: " + larger + "}\n");
  const Outcome list = make("sweep-list");
  ASSERT_EQ(list.status, 0) << list.err;
  EXPECT_NE(list.out.find("1\tlow\n2\thigh\n"), std::string::npos) << list.out;
  EXPECT_NE(list.out.find("--array=1-2"), std::string::npos) << list.out;
  EXPECT_NE(list.out.find("--dependency=afterany:"), std::string::npos) << list.out;
  // As Slurm runs the template: a task a run, then a job that gathers; the second run has not been made yet.
  const std::string job = "cd '" LGIW_SOURCE_DIR "/pipelines' && env -u MAKEFLAGS -u MAKELEVEL BIN='" LGIW_BIN_DIR
                          "' SLURM_CPUS_PER_TASK=1 ",
                    words = "./sweep.sbatch CASE_DIR='" + (shop / "bowl").string() + "' OUT='" +
                            (shop / "out").string() + "'";
  const Outcome task = shop.run("sh -c \"" + job + "SLURM_ARRAY_TASK_ID=1 " + words + "\"");
  ASSERT_EQ(task.status, 0) << task.err << task.out;
  const Outcome early = shop.run("sh -c \"" + job + words + "\"");
  EXPECT_NE(early.status, 0);
  EXPECT_EQ(sweep()["runs"][1]["error"], "not run yet");
  ASSERT_EQ(shop.run("sh -c \"" + job + "SLURM_ARRAY_TASK_ID=2 " + words + "\"").status, 0);
  const Outcome gathered = shop.run("sh -c \"" + job + words + "\"");
  EXPECT_EQ(gathered.status, 0) << gathered.err << gathered.out;
  EXPECT_EQ(sweep()["runs"][1]["threads"], 1);
  EXPECT_TRUE(sweep()["runs"][1]["max_height_m"].is_number());

  // A polygon goes by its number in the table and in the figure, and is told once; other tools find it in full.
  const std::string text = read_bytes(shop / "out/sweep/sweep.txt"), csv = read_bytes(shop / "out/sweep/sweep.csv");
  EXPECT_TRUE(std::regex_search(text, std::regex("run +water.level +slide.polygon +G1 "))) << text;
  EXPECT_TRUE(std::regex_search(text, std::regex("  low +110 +#1 "))) << text;
  EXPECT_TRUE(std::regex_search(text, std::regex("  high +120 +#2 "))) << text;
  EXPECT_NE(text.find("\n  slide.polygon #1: " + own + "\n  slide.polygon #2: " + larger + "\n"), std::string::npos)
      << text;
  EXPECT_NE(csv.find("\"" + larger + "\",\"done\""), std::string::npos) << csv;
  std::istringstream points(read_bytes(shop / "out/sweep/.work/points.csv"));
  std::set<std::string> labels;
  for (std::string row; std::getline(points, row);) {
    EXPECT_EQ(std::count(row.begin(), row.end(), ','), 4) << row;
    if (row.rfind("slide.polygon,", 0) == 0) labels.insert(row.substr(row.find('#'), row.rfind(',') - row.find('#')));
  }
  EXPECT_EQ(labels, (std::set<std::string>{"#1", "#2"}));
}

TEST_F(Sweep, FaultsAreToldInOneLineBeforeAnyRun) {
  const Outcome none = make("sweep");
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("sweep.yaml does not exist (a sweep file is needed)"), std::string::npos) << none.err;
  write_bytes(shop / "bowl/sweep.yaml", "soil.friction_angle: [16]\nwater.levle: [110]\n");
  const Outcome typo = make("sweep");
  EXPECT_EQ(typo.status, 2);
  EXPECT_NE(typo.err.find("sweep.yaml:2: unknown key \"levle\" (water has no such key) did you mean \"level\"?"),
            std::string::npos)
      << typo.err;
  EXPECT_FALSE(fs::exists(shop / "out/sweep/runs.json"));
}

TEST_F(Sweep, TheCaseIsThereAndIsReadPastItsComments) {
  const std::string own = read_bytes(shop / "bowl/case.yaml");
  const auto measured = [&] { return make("-n").out.find("deposit-volume") != std::string::npos; };
  EXPECT_TRUE(measured());
  write_bytes(shop / "bowl/case.yaml",
              replaced(own, "\nslide:\n", "\n\"slide\":\n  #: motion: {file: m.csv}  # motion: none\n"));
  EXPECT_TRUE(measured());
  write_bytes(shop / "bowl/case.yaml", replaced(own, "\nslide:\n", "\nslide:\n  motion: {file: m.csv}\n"));
  EXPECT_FALSE(measured());
  fs::remove(shop / "bowl/case.yaml");
  const Outcome nowhere = make("-n");
  EXPECT_EQ(nowhere.status, 2);
  EXPECT_NE(nowhere.err.find("there is no case bowl ("), std::string::npos) << nowhere.err;
}

TEST_F(Sweep, TerrainAndSiteAreMapsOfTheUsersOwn) {
  // A coarse map 30 m higher than the case's, and on it a local one 40 m higher, named as the caller's folder has them.
  write_bytes(shop / "coarse.asc", ascii_grid([](double dx, double dy) { return bowl_height(dx, dy) + 30; }));
  std::string local = "ncols 20\nnrows 20\nxllcorner 499900\nyllcorner 3699900\ncellsize 10\n";
  for (int n = 0; n < 400; ++n)
    local += std::to_string(bowl_height(-95 + 10 * (n % 20), 95 - 10 * (n / 20)) + 40) + (n % 20 == 19 ? "\n" : " ");
  write_bytes(shop / "local.asc", local);
  // The window of neither is asked for: it is the coarse map's.
  write_bytes(shop / "bowl/case.yaml", replaced(replaced(bowl_case, "end_time: 1", "end_time: 0.5"),
                                                "  window: [499720, 3699720, 500280, 3700280]\n", ""));
  write_bytes(shop / "bowl/case.yaml", replaced(read_bytes(shop / "bowl/case.yaml"), "level: 110", "level: 150"));
  const std::string folder = (shop / "out/on-coarse-local").string();
  const Outcome outcome =
      make("TERRAIN=coarse.asc SITE=local.asc '" + folder + "/summary.json' '" + folder + "/ground.tif'");
  ASSERT_EQ(outcome.status, 0) << outcome.err << outcome.out;
  const auto ground = [&](int x, int y) {
    return std::stod(shop.run("gdallocationinfo -valonly -geoloc out/on-coarse-local/ground.tif " + std::to_string(x) +
                              " " + std::to_string(y))
                         .out);
  };
  EXPECT_NEAR(ground(500000, 3700000), 120, 1);                        // in the middle, on the local map
  EXPECT_NEAR(ground(499800, 3700000), bowl_height(-200, 0) + 30, 8);  // on the coarse one
  EXPECT_NEAR(ground(500180, 3700180), bowl_height(180, 180) + 30, 8);
  const json info = json::parse(shop.run("gdalinfo -json out/on-coarse-local/ground.tif").out);
  EXPECT_GT(info["size"][0].get<int>() * info["geoTransform"][1].get<double>(), 500);

  // The same again makes nothing again; another map of the same name does.
  const std::string goal = "SITE=local.asc '" + folder + "/particles.h5'";
  const auto before = date("on-coarse-local/particles.h5");
  ASSERT_EQ(make("TERRAIN=coarse.asc " + goal).status, 0);
  EXPECT_EQ(date("on-coarse-local/particles.h5"), before);
  fs::create_directory(shop / "other");
  fs::rename(shop / "coarse.asc", shop / "other/coarse.asc");
  ASSERT_EQ(make("TERRAIN=other/coarse.asc " + goal).status, 0);
  EXPECT_NE(date("on-coarse-local/particles.h5"), before);

  const Outcome missing = make("TERRAIN=nowhere.tif");
  EXPECT_EQ(missing.status, 2);
  EXPECT_NE(
      missing.err.find("TERRAIN=nowhere.tif is not there (the case is to lie on that map) name a raster that exists"),
      std::string::npos)
      << missing.err;
  EXPECT_EQ(std::count(missing.err.begin(), missing.err.end(), '\n'), 1) << missing.err;
}

}  // namespace
}  // namespace lgiw::test
