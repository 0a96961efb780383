// gauges and deposit-volume as a user calls them, on the basin's run, whose numbers are known.
#include <gdal_priv.h>
#include <netcdf.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "measuring_tools.hh"

namespace lgiw::test {
namespace {

using nlohmann::json;

TEST_F(MeasuringTools, GaugesWritesTheSeriesToStdout) {
  const Outcome outcome = shop.run("gauges run.h5 -q --no-provenance");
  expect_quiet_success(outcome, "gauges");
  const auto lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 62u);
  EXPECT_EQ(lines[0], "time_s,G1,B1,S1");
  EXPECT_EQ(lines[1], "0,510,nan,545");
  EXPECT_EQ(lines[11], "5,512,nan,542.5");
  EXPECT_EQ(lines[25], "12,510,514,539");

  const auto heights = lines_of(shop.run("gauges run.h5 -q --no-provenance --heights --gauge P,1040,20").out);
  EXPECT_EQ(heights[0], "time_s,P");
  EXPECT_EQ(heights[11], "5,2");
  EXPECT_EQ(heights[19], "9,-1");

  const auto rows = lines_of(shop.run("gauges run.h5 -q --long").out);
  EXPECT_EQ(rows[0].substr(0, 15), "# provenance: {");
  EXPECT_EQ(rows[1], "time_s,gauge,surface,elevation_m,height_m");
  EXPECT_EQ(rows[12], "5,G1,water,512,2");
  EXPECT_EQ(rows.back(), "30,S1,soil,nan,nan");
}

TEST_F(MeasuringTools, GaugesPeaksRunupAndSummary) {
  make("gauges run.h5 -q --no-provenance -o g.csv --peaks p.csv --runup r.csv --summary s.json --thresholds 1,1.75");
  const auto peaks = lines_of(read_bytes(shop / "p.csv"));
  ASSERT_EQ(peaks.size(), 4u);
  EXPECT_EQ(
      peaks[0],
      "name,surface,x,y,max_elevation_m,max_height_m,time_of_max_s,first_trough_m,time_of_trough_s,arrival_0.5m_s,"
      "arrival_1m_s,arrival_1.75m_s");
  EXPECT_EQ(peaks[1], "G1,water,1040,20,512,2,5,-1,9,3.5,4,4.75");
  EXPECT_EQ(peaks[2], "B1,water,1084,20,514,4,12,nan,nan,10.5,11,11.75");
  EXPECT_EQ(peaks[3], "S1,soil,1008,20,545,0,0,-9.75,19.5,1,2,3.5");
  const auto runup = lines_of(read_bytes(shop / "r.csv"));
  EXPECT_EQ(runup[0], "time_s,A_elevation_m,A_height_m");
  EXPECT_EQ(runup[1], "0,510,0");
  EXPECT_EQ(runup[25], "12,514,4");

  const json summary = json::parse(read_bytes(shop / "s.json"));
  EXPECT_DOUBLE_EQ(summary["runup_m"], 4);
  EXPECT_DOUBLE_EQ(summary["still_water_level_m"], 510);
  EXPECT_DOUBLE_EQ(summary["parameters"]["still_water_depth_m"], 10);
  EXPECT_DOUBLE_EQ(summary["parameters"]["friction_angle_deg"], 20);
  EXPECT_DOUBLE_EQ(summary["parameters"]["particle_spacing_m"], 2);
  EXPECT_TRUE(summary["parameters"]["water_fills_to_level"]);
  EXPECT_EQ(summary["sections"][0]["name"], "A");
  EXPECT_DOUBLE_EQ(summary["sections"][0]["time_of_runup_s"], 12);
  ASSERT_EQ(summary["gauges"].size(), 3u);
  EXPECT_EQ(summary["gauges"][0]["name"], "G1");
  EXPECT_DOUBLE_EQ(summary["gauges"][0]["x"], 1040);
  EXPECT_DOUBLE_EQ(summary["gauges"][0]["max_elevation_m"], 512);
  EXPECT_DOUBLE_EQ(summary["gauges"][0]["max_height_m"], 2);
  EXPECT_DOUBLE_EQ(summary["gauges"][0]["arrival_s"], 3.5);
  EXPECT_TRUE(summary["gauges"][1]["first_trough_m"].is_null());
  EXPECT_FALSE(summary.contains("provenance"));

  const Outcome printed = shop.run("gauges run.h5 -q --json");
  const json same = json::parse(printed.out);
  EXPECT_DOUBLE_EQ(same["runup_m"], 4);
  EXPECT_EQ(same["provenance"]["gauges"]["tool"], "gauges");
}

TEST_F(MeasuringTools, GaugesNetCdfIsATimeSeriesAfterCf) {
  make("gauges run.h5 -q --no-provenance -o g.csv --netcdf g.nc");
  int id = 0, variable = 0;
  ASSERT_EQ(nc_open((shop / "g.nc").c_str(), NC_NOWRITE, &id), NC_NOERR);
  char text[64] = {};
  ASSERT_EQ(nc_get_att_text(id, NC_GLOBAL, "featureType", text), NC_NOERR);
  EXPECT_STREQ(text, "timeSeries");
  std::vector<double> z(3 * 61);
  ASSERT_EQ(nc_inq_varid(id, "surface_elevation", &variable), NC_NOERR);
  ASSERT_EQ(nc_get_var_double(id, variable, z.data()), NC_NOERR);
  EXPECT_DOUBLE_EQ(z[10], 512);             // G1 at 5 s
  EXPECT_DOUBLE_EQ(z[61], NC_FILL_DOUBLE);  // B1 is dry at first
  EXPECT_DOUBLE_EQ(z[2 * 61 + 24], 539);    // S1 at 12 s
  ASSERT_EQ(nc_inq_varid(id, "station_name", &variable), NC_NOERR);
  char names[6];
  ASSERT_EQ(nc_get_var_text(id, variable, names), NC_NOERR);
  EXPECT_EQ(std::string(names, 6), "G1B1S1");
  ASSERT_EQ(nc_inq_varid(id, "crs", &variable), NC_NOERR);
  nc_close(id);
}

TEST_F(MeasuringTools, GaugesMapsAreGeoreferenced) {
  make("gauges run.h5 -q -o g.csv --maps maps --thresholds 1.9 --summary s.json");
  EXPECT_NEAR(json::parse(read_bytes(shop / "s.json"))["shore_runup_m"].get<double>(), 4, 1e-4);
  GDALAllRegister();
  const auto value = [&](const std::string& name, int column, int row_from_south) {
    const GDALDatasetUniquePtr data(GDALDataset::Open((shop / ("maps/" + name)).c_str()));
    if (!data) return -1.0f;
    EXPECT_EQ(data->GetRasterXSize(), 51);
    double transform[6];
    data->GetGeoTransform(transform);
    EXPECT_DOUBLE_EQ(transform[0], 999);  // the corner of the cell around the node at 1000
    EXPECT_DOUBLE_EQ(transform[1], 2);
    EXPECT_DOUBLE_EQ(transform[3], 41);
    EXPECT_STREQ(data->GetSpatialRef()->GetAuthorityCode(nullptr), "32611");
    float result = 0;
    EXPECT_EQ(
        data->GetRasterBand(1)->RasterIO(GF_Read, column, 20 - row_from_south, 1, 1, &result, 1, 1, GDT_Float32, 0, 0),
        CE_None);
    return result;
  };
  EXPECT_FLOAT_EQ(value("ground.tif", 42, 3), 512);
  EXPECT_FLOAT_EQ(value("max_elevation.tif", 20, 3), 512);
  EXPECT_FLOAT_EQ(value("max_elevation.tif", 42, 3), 514);
  EXPECT_FLOAT_EQ(value("max_elevation.tif", 30, 2), 512);  // and not 513 of the water that finds its place
  EXPECT_FLOAT_EQ(value("max_depth.tif", 42, 3), 2);
  EXPECT_FLOAT_EQ(value("max_speed.tif", 42, 3), 3);
  EXPECT_FLOAT_EQ(value("arrival.tif", 20, 3), 4);
  EXPECT_FLOAT_EQ(value("arrival.tif", 30, 2), 9);  // not while the water finds its place
  EXPECT_FLOAT_EQ(value("arrival_1.9m.tif", 20, 3), 5);
  EXPECT_FLOAT_EQ(value("hazard.tif", 20, 3), 2);  // 2 m
  EXPECT_FLOAT_EQ(value("hazard.tif", 38, 3), 3);  // 4 m at the eastern end of the lake
  EXPECT_FLOAT_EQ(value("hazard.tif", 43, 3), 2);  // 1 m deep on land
  EXPECT_FLOAT_EQ(value("hazard.tif", 48, 3), 0);

  const GDALDatasetUniquePtr package(GDALDataset::Open((shop / "maps/wave.gpkg").c_str(), GDAL_OF_VECTOR));
  ASSERT_TRUE(package);
  for (const char* layer : {"gauges", "shoreline", "shore_runup", "inundation", "hazard"})
    ASSERT_NE(package->GetLayerByName(layer), nullptr) << layer;
  EXPECT_EQ(package->GetLayerByName("gauges")->GetFeatureCount(), 3);
  EXPECT_EQ(package->GetLayerByName("shoreline")->GetFeatureCount(), 2);
  OGRLayer* inundation = package->GetLayerByName("inundation");
  ASSERT_EQ(inundation->GetFeatureCount(), 2);
  // 32 columns of the lake at rest, and on land the 4 from x = 80 to 86, of 21 cells of 4 m2.
  for (const double area : {32 * 21 * 4.0, 4 * 21 * 4.0}) {
    const OGRFeatureUniquePtr feature(inundation->GetNextFeature());
    EXPECT_DOUBLE_EQ(feature->GetFieldAsDouble("area_m2"), area);
  }
  for (const auto& piece : *package->GetLayerByName("shore_runup")) {
    const double x = piece->GetGeometryRef()->toLineString()->getX(0);
    const double y = piece->GetGeometryRef()->toLineString()->getY(0);
    // The crest that stands at the west bank from the first instant on is the slide's where that lies, and no wave
    // elsewhere: nothing has come from the slide to there as yet.
    const bool beside_the_slide = x < 1050 && (y < 6 || y > 34);
    if (beside_the_slide) {
      EXPECT_LE(piece->GetFieldAsDouble("runup_m"), 0.5 + 1e-4);
    } else if (x > 1050 || (y > 10 && y < 30)) {
      EXPECT_NEAR(piece->GetFieldAsDouble("runup_m"), x < 1050 ? 1 : 4, 1e-4);
    }
  }
}

TEST_F(MeasuringTools, RerunsAreByteIdentical) {
  const std::string gauges = " -q --no-provenance -o g.csv --peaks p.csv --netcdf g.nc --maps maps --runup r.csv -O";
  const std::string slide = " -q --no-provenance -o d.csv --thickness t.tif --profiles pr.csv --summary s.json -O";
  make("gauges run.h5" + gauges), make("deposit-volume run.h5" + slide);
  const auto first = shop.contents();
  make("gauges run.h5" + gauges), make("deposit-volume run.h5" + slide);
  const auto second = shop.contents();
  ASSERT_EQ(first.size(), second.size());
  for (const auto& [name, bytes] : first) EXPECT_TRUE(second.at(name) == bytes) << name;
}

TEST_F(MeasuringTools, GaugesRefusals) {
  expect_refused("gauges none.h5",
                 "gauges: cannot open 'none.h5' (No such file or directory) see that the name is right");
  write_bytes(shop / "text.h5", "this is no run");
  expect_refused("gauges text.h5", "gauges: cannot open 'text.h5' (it is not an HDF5 file) see that the name is right");
  expect_refused(
      "gauges run.h5 --gauge P,2000,20",
      "gauges: gauge P at x = 2000, y = 20 lies outside the run (its domain is x from 1000 to 1100 and y from 0 to "
      "40) give a place inside, in the coordinates of the case");
  expect_refused("gauges run.h5 --gauge P,1040",
                 "gauges: --gauge P,1040 is not a gauge (it has a name and a place in plan) write --gauge name,x,y");
  expect_refused("gauges run.h5 --gauge P,1040,north",
                 "gauges: --gauge P,1040,north is not a gauge ('north' is no number) write --gauge name,x,y");
  expect_refused("gauges run.h5 --gauge P,1040,20 --gauge P,1050,20",
                 "gauges: two gauges are named P (a name is a column of the table) give each a name of its own");
  expect_refused(
      "gauges run.h5 --thresholds 0.5,-1",
      "gauges: --thresholds has -1.000000 (a threshold is a change of the surface in m) give numbers above 0");
  write_bytes(shop / "g.csv", "mine");
  expect_refused("gauges run.h5 -o g.csv",
                 "gauges: g.csv exists (it would be overwritten) pass -O/--overwrite or choose another name");
  expect_refused("gauges run.h5 -o new.csv --peaks g.csv",
                 "gauges: g.csv exists (it would be overwritten) pass -O/--overwrite or choose another name");
  expect_refused(
      "gauges run.h5 -o a.csv --peaks ./a.csv",
      "gauges: ./a.csv is named twice (two outputs cannot share a file) choose another name for one of them");
  expect_refused("gauges run.h5 -O -o run.h5",
                 "gauges: run.h5 is an input (it would be overwritten) choose another name for the output");
  expect_refused("gauges run.h5 --json -o -",
                 "gauges: two outputs go to stdout (they would be mixed) name a file for all but one of them");
  // Names in the folder of maps are taken, too, whichever way they are written.
  fs::create_directory(shop / "maps");
  fs::create_directory_symlink(shop / "maps", shop / "link");
  for (const char* name : {"maps/hazard.tif", "link/hazard.tif"})
    expect_refused(std::string("gauges run.h5 -O --maps maps --summary ") + name,
                   "gauges: maps/hazard.tif is named twice (two outputs cannot share a file) choose another name for "
                   "one of them");
  EXPECT_EQ(read_bytes(shop / "g.csv"), "mine");
  EXPECT_EQ(shop.run("gauges run.h5 --nonsense").status, 2);
}

TEST_F(MeasuringTools, SnapshotsAreNamedWithEnoughDecimalsForTheFramesOfTheRun) {
  RunHeader header = basin_header();
  header.particles.crs_wkt = utm_wkt();
  RunWriter writer((shop / "lab.h5").string(), header);
  for (double t : {0.0, 0.25, 0.5}) writer.add_frame(basin_frame(header, t, 0, 0, 0, 0));
  writer.add_surface(0, basin_water(header.map, 0), basin_soil(header.map, 0));
  writer.close();
  make("gauges lab.h5 -q --no-provenance -o lab.csv --maps lab --snapshots 0.25");
  EXPECT_TRUE(fs::exists(shop / "lab/wave_0.25s.tif"));
  make("gauges run.h5 -q --no-provenance -o ten.csv --maps ten --snapshots 10");
  EXPECT_TRUE(fs::exists(shop / "ten/wave_10s.tif"));
}

TEST_F(MeasuringTools, ARunWithoutABedIsMeasuredWithoutRunup) {
  RunHeader header = basin_header();
  header.particles.crs_wkt = utm_wkt();
  header.particles.bed = header.particles.ground = HeightField();
  RunWriter writer((shop / "bedless.h5").string(), header);
  writer.add_frame(basin_frame(header, 0, 0, 0, 0, 0));
  for (int k = 0; k <= 20; ++k)
    writer.add_surface(0.5 * k, basin_water(header.map, 0.5 * k), basin_soil(header.map, 0.5 * k));
  writer.close();
  const Outcome outcome = shop.run("gauges bedless.h5 -q --no-provenance --json");
  expect_quiet_success(outcome, "gauges bedless.h5");
  const json summary = json::parse(outcome.out);
  EXPECT_DOUBLE_EQ(summary["gauges"][0]["max_height_m"], 2);
  EXPECT_TRUE(summary["runup_m"].is_null());
  make("gauges bedless.h5 -q --no-provenance -o o.csv --maps bedless");
}

TEST_F(MeasuringTools, ASlideThatHasLeftHasNoSpeed) {
  RunHeader header = basin_header();
  RunWriter writer((shop / "left.h5").string(), header);
  Frame frame = basin_frame(header, 0, 0, 0, 5, 0.5);
  writer.add_frame(frame);
  frame.time = 1, frame.lost.assign(frame.lost.size(), 1);
  writer.add_frame(frame);
  writer.close();
  const json summary = json::parse(shop.run("deposit-volume left.h5 -q --json").out);
  EXPECT_TRUE(summary["max_slide_speed_m_s"].is_null()) << summary;
  EXPECT_TRUE(summary["max_soil_particle_speed_m_s"].is_null());
}

TEST_F(MeasuringTools, ACaseFileReplacesTheRunsOwn) {
  std::string text = basin_case;
  text.replace(text.find("{name: G1, x: 1040"), 18, "{name: Q9, x: 1050");
  write_bytes(shop / "other.yaml", text);
  EXPECT_EQ(lines_of(shop.run("gauges run.h5 -q --no-provenance --case other.yaml").out)[0], "time_s,Q9,B1,S1");
  text.replace(text.find("x: 1050"), 7, "x: 9999");
  write_bytes(shop / "other.yaml", text);
  const Outcome outcome = shop.run("gauges run.h5 -q --case other.yaml");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("Q9"), std::string::npos) << outcome.err;
  write_bytes(shop / "other.yaml", "name: x\nnonsense: 1\n");
  const Outcome broken = shop.run("gauges run.h5 -q --case other.yaml");
  EXPECT_EQ(broken.status, 2);
  EXPECT_NE(broken.err.find("other.yaml:2"), std::string::npos) << broken.err;
}

TEST_F(MeasuringTools, DepositVolumeSeriesAndSummary) {
  make("deposit-volume run.h5 -q --no-provenance -o d.csv --summary s.json");
  const auto lines = lines_of(read_bytes(shop / "d.csv"));
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0],
            "time_s,slide_volume_m3,immersed_volume_m3,unmoved_volume_m3,lost_volume_m3,mean_speed_m_s,p99_speed_m_s,"
            "max_speed_m_s,centre_x,centre_y,centre_z");
  EXPECT_EQ(lines[1], "0,0,0,2400,0,0,0,0,1010,20,535");
  EXPECT_EQ(lines[2], "10,2400,0,0,0,7,7,7,1020,20,521");
  EXPECT_EQ(lines[3], "30,2400,1920,0,0,0,0,0,1030,20,507");
  const json summary = json::parse(read_bytes(shop / "s.json"));
  EXPECT_DOUBLE_EQ(summary["slide_volume_m3"], 2400);
  EXPECT_DOUBLE_EQ(summary["immersed_volume_m3"], 1920);
  EXPECT_DOUBLE_EQ(summary["max_slide_speed_m_s"], 7);
  EXPECT_DOUBLE_EQ(summary["soil_volume_m3"], 2400);
  EXPECT_NEAR(summary["deposit"]["length_m"].get<double>(), 20, 1e-4);
  EXPECT_NEAR(summary["deposit"]["width_m"].get<double>(), 12, 1e-4);
  EXPECT_NEAR(summary["deposit"]["height_above_water_m"].get<double>(), 2, 1e-4);
  // Above the run's strain nothing slides.
  const json none = json::parse(shop.run("deposit-volume run.h5 -q --json --adps 0.9").out);
  EXPECT_DOUBLE_EQ(none["slide_volume_m3"], 0);
  EXPECT_DOUBLE_EQ(none["unmoved_volume_m3"], 2400);
  EXPECT_TRUE(none["deposit"]["length_m"].is_null());
}

TEST_F(MeasuringTools, DepositVolumeProfilesAndThickness) {
  make("deposit-volume run.h5 -q --no-provenance -o d.csv --profiles p.csv --thickness t.tif --at last,9.7,first");
  const auto lines = lines_of(read_bytes(shop / "p.csv"));
  ASSERT_EQ(lines.size(), 1u + 3 * 44);  // 86 m every 2 m, at three times
  EXPECT_EQ(lines[0], "section,time_s,distance_m,x,y,ground_m,bed_m,soil_m,water_m,slip_m");
  EXPECT_EQ(lines[1].substr(0, 24), "A,0,0,1010,20,520,520,53");
  EXPECT_EQ(lines[1 + 44].substr(0, 22), "A,10,0,1010,20,520,520");
  // Half-way through the block at the end: its top at 512; all of it is strained, so that the slip line is the bed.
  const std::string at_1030 = lines[1 + 2 * 44 + 10];
  EXPECT_EQ(at_1030.substr(0, 26), "A,30,20,1030,20,500,500,51");
  EXPECT_NEAR(std::stod(at_1030.substr(24)), 512, 0.05);
  EXPECT_EQ(at_1030.substr(at_1030.size() - 8), ",nan,500");
  GDALAllRegister();
  const GDALDatasetUniquePtr raster(GDALDataset::Open((shop / "t.tif").c_str()));
  ASSERT_TRUE(raster);
  float thickness = 0;
  ASSERT_EQ(raster->GetRasterBand(1)->RasterIO(GF_Read, 15, 10, 1, 1, &thickness, 1, 1, GDT_Float32, 0, 0), CE_None);
  EXPECT_FLOAT_EQ(thickness, 10);
  EXPECT_STREQ(raster->GetRasterBand(1)->GetUnitType(), "m");
}

TEST_F(MeasuringTools, DepositVolumeSlices) {
  make("deposit-volume run.h5 -q --no-provenance -o d.csv --slices sl.csv --at last");
  const auto lines = lines_of(read_bytes(shop / "sl.csv"));
  EXPECT_EQ(lines[0], "section,time_s,distance_m,z_m,phase,speed_m_s,adps");
  // The block at the end is 6 particles wide; the line passes between two of them, and takes those half a spacing
  // aside.
  std::size_t soil = 0;
  double low = 1e9, high = -1e9;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    std::vector<std::string> cells;
    std::istringstream line(lines[k]);
    for (std::string cell; std::getline(line, cell, ',');) cells.push_back(cell);
    ASSERT_EQ(cells.size(), 7u);
    EXPECT_EQ(cells[0] + "," + cells[1], "A,30");
    if (cells[4] != "soil") continue;
    ++soil, low = std::min(low, std::stod(cells[2])), high = std::max(high, std::stod(cells[2]));
    EXPECT_GT(std::stod(cells[6]), 0);
  }
  EXPECT_EQ(soil % 50, 0u);  // 10 along the line, 5 above each other, in one or two rows
  EXPECT_GT(soil, 0u);
  EXPECT_NEAR(high - low, 18, 1e-4);
}

TEST_F(MeasuringTools, DepositVolumeRefusals) {
  write_basin_run((shop / "water.h5").string(), false);
  expect_refused(
      "deposit-volume water.h5",
      "deposit-volume: water.h5 has no soil (there is no slide to measure) give the run of a case with a slide");
  expect_refused(
      "deposit-volume run.h5 --profiles p.csv --at first,99",
      "deposit-volume: there is no frame at 99 s (the run's frames are from 0 s to 30 s) name a time between them");
  expect_refused("deposit-volume run.h5 --at noon",
                 "deposit-volume: --at has 'noon' (it is neither first, last nor a time in s) write for example --at "
                 "first,20,last");
  write_bytes(shop / "d.csv", "mine");
  expect_refused("deposit-volume run.h5 -o d.csv",
                 "deposit-volume: d.csv exists (it would be overwritten) pass -O/--overwrite or choose another name");
  EXPECT_EQ(shop.run("deposit-volume none.h5").status, 2);
  EXPECT_EQ(shop.run("deposit-volume").status, 2);
  // Water alone has gauges and run-up all the same.
  EXPECT_DOUBLE_EQ(json::parse(shop.run("gauges water.h5 -q --json").out)["runup_m"], 4);
}

TEST_F(MeasuringTools, SectionWithoutAnOppositeBankIsTold) {
  std::string text = basin_case;
  text.replace(text.find("[1096, 20]"), 10, "[1050, 20]");
  write_bytes(shop / "short.yaml", text);
  const Outcome outcome = shop.run("gauges run.h5 --json --case short.yaml");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err,
            "gauges: section A has no opposite bank (it does not run from the lake to dry land above its level) let it "
            "end there\n");
  EXPECT_TRUE(json::parse(outcome.out)["runup_m"].is_null());
}

TEST_F(MeasuringTools, TwoDimensionsAndSoilAlone) {
  // A slab of soil 20 m long and 10 m high that slides by 6 m along a flat bed; no water, no sections.
  RunHeader header;
  ParticleHeader& p = header.particles;
  p.dimension = 2, p.dp = 2;
  p.still_water_level = NAN;
  p.low = {0, -1, -10}, p.high = {60, 1, 40};
  p.bed.nx = 61, p.bed.ny = 1, p.bed.dx = 1, p.bed.z.assign(61, 0.0);
  p.case_text =
      "name: slab\ndimension: 2\nparticle_spacing: 2\nterrain: {profile: [[0, 0], [60, 0]]}\n"
      "slide: {bodies: [[[4, 0], [24, 0], [24, 10], [4, 10]]]}\nsoil: {friction_angle: 20}\n";
  p.provenance = "{}";
  header.particle_volume = 4, header.left_out = "[]";
  header.map.nx = 31, header.map.ny = 1, header.map.dx = 2;
  for (int k = 0; k < 5; ++k)
    for (int i = 0; i < 10; ++i)
      header.initial_soil.insert(header.initial_soil.end(), {4 + 2 * float(i) + 1, 0, 2 * float(k) + 1});
  p.counts.soil = 50;
  RunWriter writer((shop / "slab.h5").string(), header);
  for (double t : {0.0, 2.0}) {
    Frame frame;
    frame.time = t, frame.points = header.initial_soil;
    for (std::size_t k = 0; k < 50; ++k) frame.points[3 * k] += float(3 * t);
    frame.velocity.assign(150, 0), frame.adps.assign(50, float(t)), frame.lost.assign(50, 0);
    writer.add_frame(frame);
    std::vector<float> soil(31, NAN);
    for (std::size_t n = 0; n < 31; ++n)
      if (double(n) * 2 >= 4 + 3 * t && double(n) * 2 <= 24 + 3 * t) soil[n] = float(10 - t);
    writer.add_surface(t, {}, soil);
  }
  writer.close();

  const Outcome series = shop.run("gauges slab.h5 -q --no-provenance --gauge S1,16 --gauge S2,6");
  expect_quiet_success(series, "gauges slab.h5");
  EXPECT_EQ(series.out, "time_s,S1,S2\n0,10,10\n2,8,nan\n");
  make("deposit-volume slab.h5 -q --no-provenance -o d.csv --profiles p.csv --at last --summary s.json");
  const json summary = json::parse(read_bytes(shop / "s.json"));
  EXPECT_DOUBLE_EQ(summary["slide_volume_m3"], 200);
  EXPECT_TRUE(summary["immersed_volume_m3"].is_null());
  EXPECT_NEAR(summary["deposit"]["length_m"].get<double>(), 20, 1e-4);
  EXPECT_TRUE(summary["deposit"]["width_m"].is_null());
  EXPECT_NEAR(summary["deposit"]["direction_deg"].get<double>(), 90, 1e-9);
  EXPECT_NEAR(summary["deposit"]["runout_of_centre_m"].get<double>(), 6, 1e-4);
  const auto profile = lines_of(read_bytes(shop / "p.csv"));
  ASSERT_EQ(profile.size(), 32u);  // the whole domain, 60 m every 2 m
  EXPECT_EQ(profile[1], "profile,2,0,0,0,0,0,nan,nan,nan");
  EXPECT_EQ(profile[11].substr(0, 21), "profile,2,20,20,0,0,0");
  EXPECT_NEAR(std::stod(profile[11].substr(22)), 10, 0.05);

  // The same mirrored: it goes west, and its front is looked for there, whichever way the places are given.
  RunHeader mirrored = header;
  for (std::size_t k = 0; k < 150; k += 3) mirrored.initial_soil[k] = 60 - header.initial_soil[k];
  RunWriter west((shop / "west.h5").string(), mirrored);
  for (double t : {0.0, 2.0}) {
    Frame frame;
    frame.time = t, frame.points = mirrored.initial_soil;
    for (std::size_t k = 0; k < 50; ++k) frame.points[3 * k] -= float(3 * t);
    frame.velocity.assign(150, 0), frame.adps.assign(50, float(t)), frame.lost.assign(50, 0);
    west.add_frame(frame);
    west.add_surface(t, {}, std::vector<float>(31, NAN));
  }
  west.close();
  for (const char* along : {"x_m", "distance_m"}) {
    write_bytes(shop / "ref.csv", std::string(along) + ",z_m\n30,0\n32,10\n48,10\n50,0\n");
    const Outcome compared = shop.run("deposit-volume west.h5 -q --json --compare ref.csv");
    expect_quiet_success(compared, along);
    const json front = json::parse(compared.out)["comparison"][0]["front"];
    EXPECT_NEAR(front["run"].get<double>(), 30, 2) << along;
    EXPECT_NEAR(front["reference"].get<double>(), 30, 0.5) << along;
  }

  make("deposit-volume slab.h5 -q --no-provenance -o d2.csv --slices sl.csv --at last");
  const auto slice = lines_of(read_bytes(shop / "sl.csv"));
  ASSERT_EQ(slice.size(), 51u);  // all particles of a 2-D run
  EXPECT_EQ(slice[1], "profile,2,11,1,soil,0,2");

  expect_refused("gauges slab.h5 -q --maps maps",
                 "gauges: --maps is for 3-D runs (slab.h5 is 2-D) leave it out; --runup has the run-up");
  expect_refused("gauges slab.h5 -q --runup r.csv",
                 "gauges: slab.h5 has no water (there is no run-up and no wave to map) leave out --maps and --runup");
  expect_refused("gauges slab.h5 -q",
                 "gauges: there is no gauge (the case names none) add gauges to the case or pass --gauge name,x,y");
  header.pressure_gauges = {"P1"};
  RunWriter pressure((shop / "pressure.h5").string(), header);
  pressure.add_surface(0, {}, std::vector<float>(31, NAN), {9.81f});
  pressure.close();
  expect_refused("gauges pressure.h5 -q",
                 "gauges: there is no gauge (the case has pressure gauges only) write those with --pressure FILE, or "
                 "pass --gauge name,x,y");
  expect_quiet_success(shop.run("gauges pressure.h5 -q --no-provenance --pressure p1.csv"), "gauges pressure.h5");
  expect_refused(
      "deposit-volume slab.h5 --thickness t.tif",
      "deposit-volume: --thickness is for 3-D runs (slab.h5 is 2-D) leave it out; --profiles has the deposit");
}

TEST_F(MeasuringTools, HelpAndVersion) {
  for (const std::string tool : {"gauges", "deposit-volume", "convergence"}) {
    const Outcome help = shop.run(tool + " --help");
    EXPECT_EQ(help.status, 0);
    EXPECT_NE(help.out.find("Examples:\n  $ " + tool + " "), std::string::npos);
    const Outcome version = shop.run(tool + " --version");
    EXPECT_EQ(version.status, 0);
    EXPECT_EQ(version.out.rfind(tool + " 0.1.0", 0), 0u);
    EXPECT_NE(version.out.find("GDAL 3."), std::string::npos);
    EXPECT_NE(version.out.find("HDF5 1."), std::string::npos) << version.out;
  }
}

}  // namespace
}  // namespace lgiw::test
