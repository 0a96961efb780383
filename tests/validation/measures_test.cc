// The judging itself: bars, bands, limits, extremes of sampled waves, tables.
#include <cmath>
#include <filesystem>

#include "../tools/tool_runner.hh"
#include "csv_file.hh"
#include "measures.hh"
#include "row.hh"
#include "series.hh"

namespace lgiw::test {
namespace {

using namespace validation;

TEST(Series, ExtremesOfACoarselySampledWaveAreItsOwn) {
  Series s;
  for (double t = 0; t < 3; t += 0.1) s.time.push_back(t), s.value.push_back(std::sin(2 * t));
  const Extreme crest = extreme(s, true), trough = extreme(s, false);
  EXPECT_NEAR(crest.time, M_PI / 4, 1e-3);
  EXPECT_NEAR(crest.value, 1, 1e-4);
  EXPECT_NEAR(trough.time, 3 * M_PI / 4, 1e-3);
  EXPECT_NEAR(trough.value, -1, 1e-4);
  EXPECT_EQ(extreme(between(s, 0.95, 2), true).time, s.time[10]);  // at an end: no parabola
  EXPECT_TRUE(std::isnan(extreme({}, true).value));
}

TEST(Series, MedianTakesOutSplashAndLeavesTheWave) {
  Series s;
  for (int k = 0; k <= 200; ++k) {
    s.time.push_back(0.01 * k);
    s.value.push_back(0.1 * std::sin(M_PI * s.time.back()));  // crest at 0.5 s
  }
  s.value[30] = 0.7, s.value[32] = 0.5, s.value[120] = -0.6;
  const Series smooth = running_median(s, 0.055);
  EXPECT_NEAR(extreme(smooth, true).value, 0.1, 0.001);
  EXPECT_NEAR(extreme(smooth, true).time, 0.5, 0.02);
  EXPECT_NEAR(extreme(smooth, false).value, -0.1, 0.001);
}
TEST(Rows, ErrorsAndBarsInUnitsOrPercent) {
  Row row;
  row.case_name = "c", row.quantity = "q", row.measured = 1.03, row.reference = 1, row.error = 0.03;
  EXPECT_FALSE(row.judged());
  row.bar = 0.05;
  EXPECT_TRUE(row.pass());
  row.bar = 0.02;
  EXPECT_FALSE(row.pass());
  row.error = std::nan("");
  EXPECT_FALSE(row.pass());
  EXPECT_EQ(error_text(0.0123, true), "1.23%");
  EXPECT_EQ(error_text(0.0123, false), "0.0123");
  EXPECT_EQ(rows_csv({}), "case,quantity,unit,reference,measured,error,bar,pass,dp,particles,steps,wall_time_s\n");
}

TEST(Csv, ColumnsByNameAndNumberAndFilter) {
  Workshop shop;
  write_bytes(shop / "t.csv", "# made by hand\ntime_s,\"a, b\",gauge\n0,1,G1\n1,nan,G2\n2,3,G1\n");
  const CsvFile csv((shop / "t.csv").string());
  EXPECT_EQ(csv.numbers("2", "gauge", "G1"), (std::vector<double>{1, 3}));
  EXPECT_EQ(csv.index("a, b"), 1u);
  EXPECT_THROW(csv.index("b"), std::exception);
  EXPECT_THROW(csv.index("4"), std::exception);
  EXPECT_DOUBLE_EQ(interpolate({0, 2}, {1, 3}, 0.5), 1.5);
  EXPECT_TRUE(std::isnan(interpolate({0, 2}, {1, 3}, 2.5)));
}

/// A dry block of soil one step old: enough for checks on its places.
struct SmallRun {
  Workshop shop;
  SmallRun() {
    write_bytes(shop / "case.yaml",
                "name: block\ndimension: 2\nparticle_spacing: 0.01\nterrain: {profile: [[0, 0], [0.5, 0]]}\n"
                "slide: {bodies: [[[0, 0], [0.2, 0], [0.2, 0.1], [0, 0.1]]]}\nsoil: {young_modulus: 1.0e+6}\n"
                "output: {end_time: 0.001, frame_interval: 0.001}\n");
    write_bytes(shop / "runs.txt", "dp10 full\n");
    fs::create_directory(shop / "dp10");
    EXPECT_EQ(shop.run("dem2particles case.yaml -q -o dp10/particles.h5").status, 0);
    EXPECT_EQ(shop.run("lgiw-run dp10/particles.h5 -q -o dp10/run.h5 --summary dp10/run.json").status, 0);
  }
  Outcome check(const std::string& checks) {
    write_bytes(shop / "checks.yaml", checks);
    return shop.run("lgiw-validation check . .");
  }
};

TEST(Checks, BarsBandsAndLimits) {
  SmallRun run;
  const auto verdict = [&](const std::string& keys) {
    const Outcome o = run.check("- {quantity: q, measure: front, phase: soil, " + keys + "}\n");
    EXPECT_EQ(o.status, 0) << o.err;
    const std::string row = o.out.substr(o.out.find('\n') + 1);
    std::vector<std::string> cells(1);
    for (char c : row)
      if (c == ',')
        cells.emplace_back();
      else
        cells.back() += c;
    return cells.at(5) + " " + cells.at(7);
  };
  EXPECT_EQ(verdict("reference: 0.2, bar: 1 %"), "0% yes");
  EXPECT_EQ(verdict("reference: 0.25, bar: 10 %"), "-20% no");
  EXPECT_EQ(verdict("reference: 0.25, bar: 0.06"), "-0.05 yes");
  EXPECT_EQ(verdict("reference: [0.1, 0.28]"), "0.01 yes");
  EXPECT_EQ(verdict("reference: [0.21, 0.3]"), "-0.055 no");
  EXPECT_EQ(verdict("at_least: 0.15"), "0 yes");
  EXPECT_EQ(verdict("at_most: 0.15"), "0.05 no");
  EXPECT_EQ(verdict("minus: 0.1, over: 0.1, reference: 1, bar: 1 %"), "0% yes");
  EXPECT_EQ(verdict("reference: 0.2"), "0 ");
}

TEST(Checks, ThoseOfTheBenchmarksNameMeasuresAndQuantities) {
  int cases = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(LGIW_SOURCE_DIR) / "pipelines/validation")) {
    if (!fs::exists(entry.path() / "runs.txt")) continue;
    ++cases;
    const YAML::Node checks = YAML::LoadFile(entry.path() / "checks.yaml");
    EXPECT_GT(checks.size(), 0u) << entry.path();
    for (const YAML::Node& check : checks) {
      ASSERT_TRUE(check["quantity"] && check["measure"]) << entry.path() << "\n" << check;
      EXPECT_EQ(measures().count(check["measure"].as<std::string>()), 1u) << entry.path() << "\n" << check;
      if (check["file"] && check["file"].as<std::string>().find('{') == std::string::npos) {
        EXPECT_TRUE(fs::exists(entry.path() / check["file"].as<std::string>())) << entry.path() << "\n" << check;
      }
    }
    if (fs::exists(entry.path() / "study.txt")) {
      EXPECT_TRUE(YAML::LoadFile(entry.path() / "study.yaml")["norm"]);
    }
  }
  EXPECT_GE(cases, 18);
}

TEST(Checks, WhatIsNoCheckEndsInOneLine) {
  SmallRun run;
  for (const std::string& bad : {std::string("- {quantity: q}\n"), std::string("- {quantity: q, measure: weight}\n"),
                                 std::string("- {quantity: q, measure: front, phase: air}\n"),
                                 std::string("- {quantity: q, measure: front, phase: soil, reference: 1, bar: wide}\n"),
                                 std::string("- {quantity: q, measure: crest, gauge: G1}\n"), std::string("{[")}) {
    const Outcome o = run.check(bad);
    EXPECT_EQ(o.status, 2) << bad << o.out;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
  }
}

}  // namespace
}  // namespace lgiw::test
