// --compare of gauges and deposit-volume, and convergence, on runs whose numbers are known.
#include <gdal_priv.h>

#include <nlohmann/json.hpp>

#include "measuring_tools.hh"

namespace lgiw::test {
namespace {

using nlohmann::json;
using Comparison = MeasuringTools;

/// Of the comparison in a summary: the quantity of a gauge, section, slide ...
json quantity(const json& summary, const std::string& name, const std::string& key) {
  for (const json& item : summary["comparison"])
    if (item["name"] == name && item.contains(key)) return item[key];
  ADD_FAILURE() << "no " << key << " of " << name << " in " << summary.dump();
  return {};
}

/// The basin's wave at G1 (x = 40), `higher` times as high and `late` seconds later, and its run-up of 5 m.
std::string wave_reference(double higher, double late, const std::string& time = "time_s") {
  std::ostringstream text;
  text << "# measured in the flume\n" << time << ",G1, A\n";
  for (int k = -4; k <= 130; ++k) {
    const double t = 0.25 * k;
    text << t << "," << higher * basin_wave(40, t - late) << "," << 5 * std::max(0.0, 1 - std::abs(t - 12) / 4) << "\n";
  }
  return text.str();
}

TEST_F(Comparison, OfGaugesAndRunupWithHeightsAboveStillWater) {
  write_bytes(shop / "r.csv", wave_reference(1.25, 0.5, "t_s"));
  make("gauges run.h5 -q --no-provenance --compare r.csv --compare-output c.csv --summary s.json");
  const json summary = json::parse(read_bytes(shop / "s.json"));
  EXPECT_DOUBLE_EQ(quantity(summary, "G1", "max")["run"], 2);
  EXPECT_DOUBLE_EQ(quantity(summary, "G1", "max")["reference"], 2.5);
  EXPECT_DOUBLE_EQ(quantity(summary, "G1", "max")["error_percent"], -20);
  EXPECT_DOUBLE_EQ(quantity(summary, "G1", "time_of_first_crest")["error"], -0.5);
  EXPECT_DOUBLE_EQ(quantity(summary, "G1", "first_trough")["run"], -1);
  EXPECT_NEAR(quantity(summary, "G1", "phase_lag")["error"].get<double>(), -0.5, 0.02);
  // Half a metre is passed 1.5 s before the crest of 2 m, 1.6 s before that of 2.5 m.
  EXPECT_NEAR(quantity(summary, "G1", "arrival")["error"].get<double>(), -0.4, 1e-6);
  EXPECT_DOUBLE_EQ(quantity(summary, "G1", "samples")["run"], 121);  // from 0 s to the run's 30 s
  EXPECT_DOUBLE_EQ(quantity(summary, "A", "max")["run"], 4);
  EXPECT_DOUBLE_EQ(quantity(summary, "A", "max")["error_percent"], -20);
  EXPECT_DOUBLE_EQ(summary["runup_m"], 4);
  const auto lines = lines_of(read_bytes(shop / "c.csv"));
  EXPECT_EQ(lines[0], "name,quantity,unit,run,reference,error,error_percent");
  EXPECT_EQ(lines[1], "G1,max,m,2,2.5,-0.5,-20");
  EXPECT_FALSE(summary.dump().find("aida") < std::string::npos) << "of one section";

  // On stdout the comparison takes the place of the series.
  const Outcome printed = shop.run("gauges run.h5 -q --no-provenance --compare r.csv");
  expect_quiet_success(printed, "gauges --compare");
  EXPECT_EQ(printed.out, read_bytes(shop / "c.csv"));
  const Outcome piped = shop.run("sh -c 'gauges run.h5 -q --no-provenance --compare - <r.csv'");
  EXPECT_EQ(piped.out, printed.out);
}

TEST_F(Comparison, OfARunWithItsOwnTablesIsPerfect) {
  make("gauges run.h5 -q --heights -o h.csv");
  make("gauges run.h5 -q -o z.csv");
  for (const std::string flags : {"--compare h.csv", "--compare z.csv --compare-elevations"}) {
    const json summary = json::parse(shop.run("gauges run.h5 -q --json " + flags).out);
    for (const char* gauge : {"G1", "B1", "S1"}) {
      EXPECT_NEAR(quantity(summary, gauge, "rmse")["error"].get<double>(), 0, 1e-6) << gauge << flags;
      EXPECT_NEAR(quantity(summary, gauge, "willmott_d")["run"].get<double>(), 1, 1e-9) << gauge;
      EXPECT_DOUBLE_EQ(quantity(summary, gauge, "time_of_max")["error"], 0) << gauge;
    }
    EXPECT_EQ(quantity(summary, "G1", "phase_lag")["error"].get<double>(), 0);
  }
}

TEST_F(Comparison, OfPressureGauges) {
  RunHeader header = basin_header(false);
  header.pressure_gauges = {"P1", "P2"};
  RunWriter writer((shop / "p.h5").string(), header);
  for (int k = 0; k <= 20; ++k)
    writer.add_surface(0.5 * k, basin_water(header.map, 0.5 * k), {}, {float(1000 * k), 500});
  writer.close();
  make("gauges p.h5 -q --no-provenance --gauge G,1040,20 --pressure out.csv -o g.csv");
  const auto lines = lines_of(read_bytes(shop / "out.csv"));
  EXPECT_EQ(lines[0], "time_s,P1,P2");
  EXPECT_EQ(lines[3], "1,2000,500");
  write_bytes(shop / "r.csv", "time_s,P1\n0,0\n5,8000\n");
  const json summary = json::parse(shop.run("gauges p.h5 -q --json --gauge G,1040,20 --compare r.csv").out);
  EXPECT_EQ(quantity(summary, "P1", "max")["unit"], "Pa");
  EXPECT_DOUBLE_EQ(quantity(summary, "P1", "max")["error_percent"], 25);
  EXPECT_DOUBLE_EQ(quantity(summary, "P1", "rmse")["error"], 2000 / std::sqrt(2));
  EXPECT_DOUBLE_EQ(summary["pressure_gauges"][0]["max_pressure_pa"], 20000);
  expect_refused(
      "gauges run.h5 --pressure o.csv",
      "gauges: run.h5 has no pressure gauges (they are recorded while the case runs) give gauges of the case "
      "quantity: pressure and run it again");
}

TEST_F(Comparison, OfDepositProfilesAndQuantities) {
  // The block stands from 1020 to 1040 m, its top at 512 m; the section starts at 1010 m.
  write_bytes(shop / "p.csv", "distance_m,z_m\n24,511\n14,511\n18,511\n");
  write_bytes(shop / "q.csv",
              "quantity,value,low,high\nslide_volume_m3,2000,1900,2500\nimmersed_volume_m3,,2000,3000\n"
              "runout_of_front_m,25,,\n");
  make(
      "deposit-volume run.h5 -q --no-provenance --compare p.csv --compare q.csv --compare-output c.csv --summary "
      "s.json");
  const json summary = json::parse(read_bytes(shop / "s.json"));
  EXPECT_NEAR(quantity(summary, "A", "rms_height")["error"].get<double>(), 1, 0.05);
  EXPECT_NEAR(quantity(summary, "A", "rms_distance")["error"].get<double>(), 1, 0.05);
  EXPECT_NEAR(quantity(summary, "A", "front")["run"].get<double>(), 31, 2);
  EXPECT_DOUBLE_EQ(quantity(summary, "A", "front")["reference"], 24);
  EXPECT_NEAR(quantity(summary, "A", "height")["error"].get<double>(), 1, 0.05);
  EXPECT_DOUBLE_EQ(quantity(summary, "slide", "slide_volume_m3")["error_percent"], 20);
  EXPECT_EQ(quantity(summary, "slide", "slide_volume_m3")["inside"], true);
  EXPECT_EQ(quantity(summary, "slide", "immersed_volume_m3")["inside"], false);
  EXPECT_DOUBLE_EQ(quantity(summary, "slide", "immersed_volume_m3")["error"], -80);
  EXPECT_NEAR(quantity(summary, "slide", "runout_of_front_m")["run"].get<double>(), 20, 1e-4);
  const auto lines = lines_of(read_bytes(shop / "c.csv"));
  EXPECT_EQ(lines[0], "name,quantity,unit,run,reference,error,error_percent,low,high,inside");
  EXPECT_EQ(lines[1], "slide,slide_volume_m3,m3,2400,2000,400,20,1900,2500,1");
}

TEST_F(Comparison, GaugeReferencesAreRefusedInOneLine) {
  const auto refuse = [&](const std::string& table, const std::string& message) {
    write_bytes(shop / "r.csv", table);
    expect_refused("gauges run.h5 -o o.csv --compare r.csv", "gauges: " + message);
  };
  refuse("", "r.csv is empty (a table has a header line and rows) see that the name is right");
  refuse("# nothing\n\n", "r.csv is empty (a table has a header line and rows) see that the name is right");
  refuse("time_s,G1\n", "r.csv has no rows (there is only a header) see that the name is right");
  refuse(std::string("\x89HDF\0\1", 6),
         "r.csv is no text (a table is comma-separated values) see that the name is right");
  refuse("G1,time_s\n0,1\n1,2\n",
         "r.csv does not begin with a column time_s or t_s (its columns are G1, time_s) put the times, in s, into the "
         "first column");
  refuse("time_s\n0\n1\n",
         "r.csv holds times only (there is nothing to compare with) give each gauge a column that has its name");
  refuse("time_s,G1,G1\n0,1,2\n",
         "r.csv:1: two columns are named G1 (columns are told apart by name) give each a name of its own");
  refuse("time_s,G1,\n0,1,2\n", "r.csv:1: column 3 has no name (the first line names the columns) name it");
  refuse(
      "time_s,G1\n0,1\n1,2,3\n",
      "r.csv:3: 3 cells instead of 2 (every row has as many as the header) separate them with commas and leave unknown "
      "ones empty");
  refuse(
      "time_s,G1\n0,1\n1,high\n",
      "r.csv:3: 'high' is no number (column G1 holds numbers) write it with a decimal point, or leave the cell empty");
  refuse(
      "time_s,G1\n0,1\n1,inf\n",
      "r.csv:3: 'inf' is no number (column G1 holds numbers) write it with a decimal point, or leave the cell empty");
  refuse("time_s,G1\n0,1\n,2\n", "r.csv:3: time_s is missing (every row needs it) give it, or leave out the row");
  refuse("time_s,G1\n0,1\n2,1\n1,2\n",
         "r.csv:4: time 1 does not rise (times are in order, each once) sort the rows by time");
  refuse("time_s,G1\n0,1\n0,2\n",
         "r.csv:3: time 0 does not rise (times are in order, each once) sort the rows by time");
  refuse("time_s,G1\n0,1\n1,\n", "r.csv: column G1 has 1 values (a series has two or more) leave the column out");
  refuse(
      "time_s,G1,Q,R\n0,1,2,3\n1,1,2,3\n",
      "r.csv: the run has no gauge or section Q, R (its gauges are G1, B1, S1 and its sections A) name the columns as "
      "the case does");
  refuse(
      "time_s,G1\n50,1\n60,2\n",
      "r.csv: G1 shares no time with the run (it is from 50 s to 60 s, the run's surfaces from 0 s to 30 s) give times "
      "since the start of the run, in s");
  refuse("time_s,\"G1\n0,1\n", "r.csv:1: a quote does not end (the file ends before it does) close it");
  write_bytes(shop / "r.csv", "time_s,G1\n0,1\n1,2\n");
  expect_refused(
      "gauges run.h5 --compare none.csv",
      "gauges: none.csv cannot be read (there is no such file, or no right to it) see that the name is right");
  expect_refused("gauges run.h5 --compare .",
                 "gauges: . is a folder (a file with a table is wanted) name the file in it");
  expect_refused("gauges run.h5 --compare r.csv --compare r.csv",
                 "gauges: r.csv: G1 has a reference already (each gauge and section has one) leave one of them out");
  expect_refused("gauges run.h5 -O --compare r.csv --compare-output r.csv",
                 "gauges: r.csv is an input (it would be overwritten) choose another name for the output");
  expect_refused("gauges run.h5 -o - --compare r.csv",
                 "gauges: two outputs go to stdout (they would be mixed) name a file for all but one of them");
  EXPECT_EQ(shop.run("gauges run.h5 --compare-output c.csv").status, 2);
}

TEST_F(Comparison, DepositReferencesAreRefusedInOneLine) {
  const auto refuse = [&](const std::string& table, const std::string& message) {
    write_bytes(shop / "r.csv", table);
    expect_refused("deposit-volume run.h5 -o o.csv --compare r.csv", "deposit-volume: " + message);
  };
  refuse("x_m,y_m\n0,1\n",
         "r.csv is neither a profile nor a list of quantities (its columns are x_m, y_m) name the columns x_m,z_m or "
         "distance_m,z_m or quantity,value[,low,high]");
  refuse("x_m,z_m\n0,1\n1,1\n", "r.csv has places by x_m (run.h5 is 3-D) give distances along a section as distance_m");
  refuse("section,distance_m,z_m\nB,0,1\nB,1,1\n",
         "r.csv: there is no section B (the case names others) name one of the case");
  refuse("distance_m,z_m\n0,1\n", "r.csv has one point (a profile has two or more) give more points");
  refuse("distance_m,z_m\n0,\n1,1\n", "r.csv:2: z_m is missing (every row needs it) give it, or leave out the row");
  refuse("distance_m,z_m\n900,1\n901,1\n",
         "r.csv: the profile shares no place with the run (the run's line is from 0 m to 86 m) give distances from the "
         "section's first point");
  refuse(
      "quantity,value\nslide_volume,1\n",
      "r.csv:2: slide_volume is not measured (quantities are named as in the summary and in its deposit) do you mean "
      "slide_volume_m3?");
  refuse(
      "quantity,value\nwidth_m,\n",
      "r.csv:2: width_m has neither a value nor both bounds (there is nothing to compare with) give value, or low and "
      "high, or all three");
  write_bytes(shop / "r.csv", "quantity,low,high\ndirection_deg,340,100\n");
  const Outcome across = shop.run("deposit-volume run.h5 -q --no-provenance --compare r.csv");
  EXPECT_NE(across.out.find("slide,direction_deg,degrees,90,nan,0,nan,340,100,1\n"), std::string::npos) << across.out;
  refuse("quantity,value,low,high\nwidth_m,1,3,2\n",
         "r.csv:2: low is above high (they bound the width_m) exchange them");
  refuse("quantity,value\nwidth_m,1\nwidth_m,2\n",
         "r.csv:3: width_m comes twice (a quantity has one reference) leave out one of the rows");
  refuse("quantity,low\nwidth_m,1\n",
         "r.csv is no list of quantities (its columns are quantity, low) name them quantity,value or "
         "quantity,value,low,high");
}

/// The basin at spacing `dp`, its crest of 2 m raised by `raised` and its block's final place moved by `moved`.
void write_basin_at(const std::string& path, double dp, double raised, double moved, const std::string& more = "") {
  RunHeader header = basin_header();
  header.particles.dp = dp;
  header.particles.crs_wkt = utm_wkt();
  const std::string spacing = "particle_spacing: " + std::to_string(dp);
  header.particles.case_text.replace(header.particles.case_text.find("particle_spacing: 2"), 19, spacing) += more;
  header.map.dx = dp, header.map.nx = std::size_t(100 / dp) + 1, header.map.ny = std::size_t(40 / dp) + 1;
  RunWriter writer(path, header);
  writer.add_frame(basin_frame(header, 0, 0, 0, 0, 0));
  writer.add_frame(basin_frame(header, 30, moved, -28, 0, 0.5));
  std::vector<float> highest(header.map.size(), float(basin_level + raised));
  for (int k = 0; k <= 60; ++k) {
    std::vector<float> water = basin_water(header.map, 0.5 * k);
    for (float& z : water)
      if (z > basin_level + 1.9) z += float(raised);
    writer.add_surface(0.5 * k, water, basin_soil(header.map, 0.5 * k));
  }
  std::map<std::string, std::vector<float>> maxima;
  for (const char* name : {"elevation", "arrival", "depth", "speed", "soil_speed"}) maxima[name] = highest;
  writer.write_maxima(maxima);
  writer.close();
}

TEST_F(Comparison, ConvergenceOfThreeRunsInAnyOrder) {
  // Crests at the middle of the lake of 2 + 0.1 (dp - 1): first order with the limit 1.9. Run-outs of 20, 24 and 22 m.
  write_basin_at((shop / "dp4.h5").string(), 4, 0.3, 22);
  write_basin_at((shop / "dp1.h5").string(), 1, 0.0, 20);
  write_basin_at((shop / "dp2.h5").string(), 2, 0.1, 24);
  make("convergence dp4.h5 dp1.h5 dp2.h5 -q --no-provenance -o c.csv --summary s.json --difference-maps maps");
  const auto lines = lines_of(read_bytes(shop / "c.csv"));
  EXPECT_EQ(lines[0],
            "name,quantity,unit,dp_4m,dp_2m,dp_1m,observed_order,gci_percent,richardson,spread_percent,error,used,why");
  const json summary = json::parse(read_bytes(shop / "s.json"));
  const auto find = [&](const std::string& name, const std::string& quantity) {
    for (const json& q : summary["quantities"])
      if (q["name"] == name && q["quantity"] == quantity) return q;
    ADD_FAILURE() << "no " << quantity << " of " << name;
    return json();
  };
  const json crest = find("G1", "max_height_m");
  EXPECT_NEAR(crest["values"][0].get<double>(), 2, 1e-5);
  EXPECT_NEAR(crest["values"][2].get<double>(), 2.3, 1e-5);
  EXPECT_NEAR(crest["observed_order"].get<double>(), 1, 1e-3);
  EXPECT_NEAR(crest["richardson"].get<double>(), 1.9, 1e-3);
  EXPECT_NEAR(crest["gci_percent"].get<double>(), 6.25, 0.01);
  EXPECT_EQ(crest["used"], "gci");
  const json runout = find("deposit", "runout_of_front_m");
  EXPECT_EQ(runout["used"], "spread");
  EXPECT_EQ(runout["why"], "the results oscillate");
  EXPECT_NEAR(runout["error"].get<double>(), 4, 1e-4);
  EXPECT_NEAR(runout["spread_percent"].get<double>(), 20, 1e-3);
  EXPECT_TRUE(summary["warnings"].empty()) << summary["warnings"];
  for (const char* quantity : {"slide_volume_m3", "immersed_volume_m3"}) EXPECT_EQ(find("slide", quantity)["error"], 0);
  EXPECT_TRUE(find("A", "runup_m").contains("used"));

  GDALAllRegister();
  const auto raster = [&](const std::string& name) {
    const GDALDatasetUniquePtr data(GDALDataset::Open((shop / ("maps/" + name)).c_str()));
    std::vector<float> values;
    if (!data) return values;
    EXPECT_EQ(data->GetRasterXSize(), 26);  // the coarsest's cells
    EXPECT_STREQ(data->GetSpatialRef()->GetAuthorityCode(nullptr), "32611");
    values.resize(std::size_t(data->GetRasterXSize()) * data->GetRasterYSize());
    EXPECT_EQ(
        data->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, data->GetRasterXSize(), data->GetRasterYSize(), values.data(),
                                         data->GetRasterXSize(), data->GetRasterYSize(), GDT_Float32, 0, 0),
        CE_None);
    return values;
  };
  const auto water = raster("max_elevation_4m_minus_1m.tif"), two = raster("max_elevation_2m_minus_1m.tif");
  ASSERT_FALSE(water.empty());
  EXPECT_NEAR(water[water.size() / 2], 0.3, 1e-4);
  EXPECT_NEAR(two[two.size() / 2], 0.1, 1e-4);
  const auto thickness = raster("thickness_4m_minus_1m.tif");
  double volume = 0, largest = 0;
  for (float t : thickness)
    if (!std::isnan(t)) volume += 16 * t, largest = std::max(largest, double(std::abs(t)));
  EXPECT_NEAR(volume, 0, 1e-3) << "both slides have 2400 m3";
  EXPECT_GT(largest, 1);
  EXPECT_EQ(shop.contents().size(), 3u + 1 + 2 + 1 + 6) << "runs, run.h5, tables, the folder and its maps";
}

TEST_F(Comparison, ConvergenceWarnsAndRefuses) {
  write_basin_at((shop / "a.h5").string(), 2, 0, 20);
  write_basin_at((shop / "b.h5").string(), 2.5, 0, 20, "interface: {velocity_factor: 2}\n");
  const Outcome outcome = shop.run("convergence a.h5 b.h5 --json");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(
      outcome.err,
      "convergence: the cases differ in interface.velocity_factor (not only the spacing moves the results) compare "
      "like with like\nconvergence: the spacings 2.5 m and 2 m are close (an order wants a ratio of 1.3 or more) "
      "take coarser ones\n");
  EXPECT_EQ(json::parse(outcome.out)["warnings"].size(), 2u);
  EXPECT_EQ(json::parse(outcome.out)["quantities"][0]["why"], "two runs");
  expect_refused(
      "convergence a.h5",
      "convergence: there is one run (convergence is seen between runs) give two or more runs of a case that "
      "differ in particle_spacing");
  expect_refused("convergence run.h5 a.h5",
                 "convergence: a.h5 and run.h5 have the same particle spacing (2 m) give one run a spacing");
  write_basin_run((shop / "water.h5").string(), false, utm_wkt());
  expect_refused(
      "convergence water.h5 b.h5",
      "convergence: b.h5 and water.h5 do not both have water and soil (they are not runs of one case) give runs "
      "that differ in particle_spacing");
  write_bytes(shop / "c.csv", "mine");
  expect_refused("convergence a.h5 b.h5 -o c.csv",
                 "convergence: c.csv exists (it would be overwritten) pass -O/--overwrite or choose another name");
}

}  // namespace
}  // namespace lgiw::test
