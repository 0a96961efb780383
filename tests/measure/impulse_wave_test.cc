// impulse-wave as a user calls it: with numbers, and beside a run whose slide and wave are known.
#include <cmath>
#include <nlohmann/json.hpp>

#include "files/csv_table.hh"
#include "measuring_tools.hh"

namespace lgiw::test {
namespace {

using nlohmann::json;

const std::string example =
    "impulse-wave --speed 58 --thickness 12 --width 100 --volume 220000 --density 1700 --slope 40 --depth 80";

const json& estimate(const json& place, const std::string& quantity, const std::string& formula) {
  for (const json& e : place["estimates"])
    if (e["quantity"] == quantity && e["formula"] == formula) return e;
  throw std::runtime_error("no " + quantity + " by " + formula);
}

class ImpulseWave : public MeasuringTools {
 protected:
  ImpulseWave() { write_entry_run("entry.h5", 3); }

  json summary(const std::string& command) {
    const Outcome outcome = shop.run(command + " -q --json");
    expect_quiet_success(outcome, command);
    return outcome.status == 0 ? json::parse(outcome.out)["impulse_wave"] : json();
  }

  /// The block of the basin (20 x 12 x 10 m, in 2-D 20 x 10 m) goes down its west bank, of 2:1, at 8 m/s for 6 s: from
  /// z = 30 to 40, over ground at 40 to 0 and water at 10.
  void write_entry_run(const std::string& name, int dimension) {
    RunHeader header = basin_header();
    ParticleHeader& p = header.particles;
    p.crs_wkt = utm_wkt();
    if (dimension == 2) {
      p.dimension = 2, p.crs_wkt.clear();
      p.bed.ny = 1, p.bed.z.resize(101), p.ground = p.bed;
      header.map.ny = 1, header.particle_volume = 4;
      std::vector<float> row;
      for (std::size_t k = 0; k < header.initial_soil.size(); k += 3)
        if (header.initial_soil[k + 1] == header.initial_soil[1])
          row.insert(row.end(), {header.initial_soil[k], 0, header.initial_soil[k + 2]});
      header.initial_soil = row, p.counts.soil = std::int64_t(row.size() / 3);
      p.low[1] = -1, p.high[1] = 1;
      p.case_text = replaced_all(p.case_text, ", y: 20", "");
      p.case_text = replaced_all(p.case_text, ", width: 40", "") + "dimension: 2\n";
      p.case_text = replaced_all(p.case_text, ", 20]", ", 0]");
    }
    RunWriter writer((shop / name).string(), header);
    const double r = std::sqrt(0.2);
    for (int k = 0; k <= 12; ++k) {
      const double way = 4.0 * k;
      Frame frame = basin_frame(header, 0.5 * k, r * way, -2 * r * way, 8 * r, 0.5);
      for (std::size_t n = 2; n < frame.points.size() / 3; ++n) frame.velocity[3 * n + 2] = float(-16 * r);
      writer.add_frame(frame);
    }
    for (int k = 0; k <= 60; ++k)
      writer.add_surface(0.5 * k, basin_water(header.map, 0.5 * k), basin_soil(header.map, 0.5 * k));
    writer.close();
  }

  static std::string replaced_all(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at; (at = text.find(from)) != std::string::npos;) text.replace(at, from.size(), to);
    return text;
  }
};

TEST_F(ImpulseWave, WorkedExampleAsText) {
  const Outcome outcome = shop.run(example);
  expect_quiet_success(outcome, example);
  EXPECT_NE(outcome.out.find("impulse product parameter P 0.637"), std::string::npos) << outcome.out;
  for (const std::string line : {"first crest, m              14.4\n", "first trough, m             22.7\n",
                                 "second crest, m             10.1\n"})
    EXPECT_NE(outcome.out.find(line), std::string::npos) << line << outcome.out;
  EXPECT_EQ(outcome.out.find("Outside the limits"), std::string::npos) << outcome.out;
  EXPECT_EQ(shop.contents().size(), 2u);  // the two runs: nothing was written
}

TEST_F(ImpulseWave, BrokenLimitsAreToldWithValueAndRangeAndRecalledFormulasMarked) {
  const std::string command = example + " --distance 500,1700 --angle 20 --bank-slope 35";
  const Outcome text = shop.run(command);
  EXPECT_EQ(text.err, "");
  EXPECT_NE(text.out.find("VAW 254 (Evers et al. 2019, 3-D): r/h 21.2 is not from 1 to 16\n"), std::string::npos);
  EXPECT_NE(text.out.find("Mohammed-Fritz*"), std::string::npos);
  EXPECT_NE(text.out.find("* recalled, not verified against the source\n"), std::string::npos);
  const Outcome table = shop.run(command + " -o -");
  EXPECT_EQ(table.status, 0);
  EXPECT_EQ(table.err,
            "impulse-wave: Synolakis (Synolakis 1987): a/h 0.0406 at 500m (and others at 1700m) is not from 0.0407 to "
            "0.551\nimpulse-wave: VAW 254 (Evers et al. 2019, 3-D): r/h 21.2 is not from 1 to 16\n");
  const CsvText csv = parse_csv(table.out, "table");
  EXPECT_EQ(csv.rows.size(), 3u + 2 * (6 + 3));
  EXPECT_EQ(csv.rows.back()[csv.column("limits_broken")], "r/h 21.2 (1..16)");
  EXPECT_EQ(csv.rows.back()[csv.column("verified")], "0");
}

TEST_F(ImpulseWave, KoernersSpeedStandsInForTheSpeed) {
  std::string command = replaced_all(example, "--speed 58", "--drop 100 --friction-angle 20");
  const json result = summary(command);
  const double speed = std::sqrt(2 * 9.81 * 100 * (1 - std::tan(20 * M_PI / 180) / std::tan(40 * M_PI / 180)));
  EXPECT_NEAR(result["slide"]["speed_m_s"].get<double>(), speed, 1e-9);
  EXPECT_EQ(shop.run(replaced_all(command, "--friction-angle 20", "--friction-angle 50")).err,
            "impulse-wave: the slide does not move (a friction angle of 50 degrees holds it on 40 degrees) give a "
            "smaller --friction-angle or the --speed itself\n");
}

TEST_F(ImpulseWave, ChannelPerMetreOfWidth) {
  const std::string slide = "impulse-wave --channel --speed 3 --thickness 0.1 --density 1700 --slope 45 --depth 0.3";
  const json thin = summary(slide + " --volume 0.05 --distance 2 --bank-slope 30");
  const json wide = summary(slide + " --volume 0.1 --width 2 --distance 2");
  EXPECT_EQ(thin["dimension"], 2);
  EXPECT_TRUE(thin["numbers"]["B"].is_null());
  EXPECT_NEAR(thin["numbers"]["P"].get<double>(), wide["numbers"]["P"].get<double>(), 1e-12);
  const double P = thin["numbers"]["P"];
  EXPECT_NEAR(estimate(thin["places"][0], "wave_height_m", "VAW 254")["predicted"].get<double>(),
              5.0 / 9 * std::pow(P, 0.8) * 0.3, 1e-12);
  EXPECT_GT(estimate(thin["places"][2], "runup_m", "Mueller")["predicted"].get<double>(), 0.1);
}

TEST_F(ImpulseWave, MeasuresTheSlideThatItsRunHolds) {
  const json result = summary("impulse-wave entry.h5");
  const json& slide = result["slide"];
  EXPECT_NEAR(slide["speed_m_s"].get<double>(), 8, 1e-4);
  EXPECT_NEAR(slide["slope_deg"].get<double>(), std::atan(2) * 180 / M_PI, 1e-3);
  EXPECT_NEAR(slide["width_m"].get<double>(), 12, 1e-4);
  EXPECT_NEAR(slide["still_water_depth_m"].get<double>(), 10, 1e-4);
  EXPECT_EQ(slide["density_kg_m3"], 2000);
  EXPECT_NEAR(slide["measured"]["direction_deg"].get<double>(), 90, 1e-3);
  EXPECT_DOUBLE_EQ(slide["volume_m3"].get<double>(), 2400);  // it sinks by 43 m, so that all of it is under water
  // Seen along its way of 2:1 the block is (20 x 2 + 10 x 1) / 5^0.5 m across at most.
  EXPECT_GT(slide["thickness_m"].get<double>(), 10);
  EXPECT_LT(slide["thickness_m"].get<double>(), 50 / std::sqrt(5));
  EXPECT_NEAR(result["numbers"]["F"].get<double>(), 8 / std::sqrt(98.1), 1e-4);

  // Gauges in water alone; the wave of 2 m passes x = 1040 at 5 s.
  const json &impact = result["places"][0], &gauge = result["places"][1], &bank = result["places"][2];
  EXPECT_EQ(impact["kind"], "impact");
  EXPECT_EQ(gauge["name"], "G1");
  EXPECT_NEAR(gauge["distance_m"].get<double>(), 1040 - slide["measured"]["x"].get<double>(), 1e-3);
  EXPECT_NEAR(estimate(gauge, "first_crest_m", "VAW 254")["simulated"].get<double>(), 2, 1e-4);
  EXPECT_NEAR(estimate(gauge, "first_crest_time_s", "VAW 254")["simulated"].get<double>(), 5, 1e-9);
  EXPECT_NEAR(estimate(gauge, "first_trough_m", "VAW 254")["simulated"].get<double>(), 1, 1e-4);
  EXPECT_NEAR(gauge["simulated"]["largest_crest_m"].get<double>(), 2, 1e-4);
  EXPECT_EQ(bank["kind"], "bank");
  EXPECT_EQ(bank["name"], "A");
  EXPECT_NEAR(bank["bank_slope_deg"].get<double>(), std::atan(0.5) * 180 / M_PI, 1e-6);
  EXPECT_NEAR(estimate(bank, "runup_m", "Synolakis")["simulated"].get<double>(), 4, 1e-3);
  EXPECT_EQ(result["places"].size(), 3u);
}

TEST_F(ImpulseWave, ANumberThatIsGivenReplacesTheRuns) {
  const json result = summary("impulse-wave entry.h5 --depth 20 --speed 14");
  EXPECT_EQ(result["slide"]["given"], json({"speed", "depth"}));
  EXPECT_EQ(result["slide"]["speed_m_s"], 14);
  EXPECT_NEAR(result["slide"]["measured"]["speed_m_s"].get<double>(), 8, 1e-4);
  EXPECT_NEAR(result["numbers"]["F"].get<double>(), 14 / std::sqrt(196.2), 1e-9);
}

TEST_F(ImpulseWave, TwoDimensionalRunsTakeTheFormulasOfAChannel) {
  write_entry_run("flume.h5", 2);
  const json result = summary("impulse-wave flume.h5");
  EXPECT_EQ(result["dimension"], 2);
  EXPECT_NEAR(result["slide"]["volume_m3"].get<double>(), 200, 1e-9);
  EXPECT_EQ(result["slide"]["width_m"], 1);
  EXPECT_TRUE(result["numbers"]["B"].is_null());
  const json& gauge = result["places"][1];
  EXPECT_NEAR(estimate(gauge, "wave_height_m", "VAW 254")["simulated"].get<double>(), 3, 1e-4);
  EXPECT_GT(estimate(result["places"][2], "runup_m", "Mueller")["predicted"].get<double>(), 0);
  // A width makes the volume that was measured per metre one of the whole width.
  const json wide = summary("impulse-wave flume.h5 --width 5");
  EXPECT_NEAR(wide["slide"]["volume_m3"].get<double>(), 1000, 1e-9);
  EXPECT_EQ(wide["numbers"]["P"], result["numbers"]["P"]);
  EXPECT_EQ(summary("impulse-wave flume.h5 --width 5 --volume 7")["slide"]["volume_m3"], 7);
}

TEST_F(ImpulseWave, AnotherCaseFileChangesNoPhysics) {
  const std::string other =
      replaced_all(basin_case, "{friction_angle", "{density: 2600, friction_angle") + "gravity: [0, 0, -1.62]\n";
  write_bytes(shop / "other.yaml", replaced_all(other, "name: G1", "name: Q1"));
  const json own = summary("impulse-wave entry.h5"), chosen = summary("impulse-wave entry.h5 --case other.yaml");
  EXPECT_EQ(chosen["places"][1]["name"], "Q1");
  EXPECT_EQ(chosen["numbers"], own["numbers"]);
  EXPECT_EQ(chosen["slide"], own["slide"]);
}

TEST_F(ImpulseWave, NumbersAreFiniteAndNoneIsWithoutEffect) {
  for (const char* option :
       {"--distance nan", "--angle nan --distance 500", "--speed inf", "--bank-slope nan --distance 9"}) {
    const Outcome outcome = shop.run(example + " " + option);
    EXPECT_EQ(outcome.status, 2) << option;
    EXPECT_NE(outcome.err.find(" is not a number "), std::string::npos) << outcome.err;
    EXPECT_LT(outcome.err.size(), 160u) << outcome.err;
  }
  EXPECT_EQ(shop.run(example + " --angle 30").status, 2);
  EXPECT_EQ(shop.run("impulse-wave --channel --speed 3 --thickness 0.1 --density 1700 --slope 45 --depth 0.3 --volume "
                     "0.1 --distance 3 --angle 80")
                .status,
            2);
}

TEST_F(ImpulseWave, ASlideThatStaysDryMakesNoWaveAndIsNoFault) {
  RunHeader header = basin_header();
  RunWriter writer((shop / "dry.h5").string(), header);
  writer.add_frame(basin_frame(header, 0, 0, 0, 0, 0));
  writer.add_frame(basin_frame(header, 1, 0, -1, 1, 0.5));
  writer.add_surface(0, basin_water(header.map, 0), basin_soil(header.map, 0));
  writer.close();
  const json result = summary("impulse-wave dry.h5");
  EXPECT_EQ(result["notes"], json({"no part of the slide crossed the still water level"}));
  EXPECT_TRUE(result["numbers"].is_null());
  EXPECT_TRUE(result["places"].empty());
}

TEST_F(ImpulseWave, WritesTableAndSummaryWithProvenanceAndReruns) {
  make("impulse-wave entry.h5 -q -o i.csv --summary i.json");
  EXPECT_EQ(read_bytes(shop / "i.csv").rfind("# provenance: {", 0), 0u);
  EXPECT_TRUE(json::parse(read_bytes(shop / "i.json"))["provenance"].contains("impulse-wave"));
  const std::string again = "impulse-wave entry.h5 -q -O --no-provenance -o i.csv --summary i.json";
  make(again);
  const auto first = shop.contents();
  make(again);
  EXPECT_TRUE(shop.contents() == first);
  const CsvText csv = parse_csv(read_bytes(shop / "i.csv"), "i.csv");
  EXPECT_EQ(csv.header,
            (std::vector<std::string>{"place", "kind", "distance_m", "angle_deg", "quantity", "formula", "verified",
                                      "predicted", "simulated", "error_percent", "limits_broken"}));
}

TEST_F(ImpulseWave, Refusals) {
  expect_refused("impulse-wave --speed 10 --thickness 1",
                 "impulse-wave: --width, --volume, --density, --slope, --depth are required (there is no run in which "
                 "to measure the slide) give the numbers or a run");
  EXPECT_EQ(shop.run(example + " --speed -5").status, 2);
  EXPECT_EQ(shop.run(example + " --slope 95").status, 2);
  EXPECT_EQ(shop.run(example + " --bank-slope 30").status, 2);
  expect_refused(example + " --case case.yaml",
                 "impulse-wave: --case is for a run (none is given) leave it out, or give the run");
  expect_refused("impulse-wave entry.h5 --channel",
                 "impulse-wave: --channel is for numbers without a run (the run says whether it is 2-D) leave it out");
  expect_refused("impulse-wave none.h5",
                 "impulse-wave: cannot open 'none.h5' (No such file or directory) see that the name is right");
  write_basin_run((shop / "water.h5").string(), false);
  expect_refused("impulse-wave water.h5",
                 "impulse-wave: water.h5 has no slide (there is nothing that could make a wave) give the run of a case "
                 "with a slide");
  write_bytes(shop / "i.csv", "mine");
  expect_refused("impulse-wave entry.h5 -o i.csv",
                 "impulse-wave: i.csv exists (it would be overwritten) pass -O/--overwrite or choose another name");
  expect_refused("impulse-wave entry.h5 -O -o entry.h5",
                 "impulse-wave: entry.h5 is an input (it would be overwritten) choose another name for the output");
}

}  // namespace
}  // namespace lgiw::test
