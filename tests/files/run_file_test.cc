#include "files/run_file.hh"

#include <malloc.h>

#include <csignal>
#include <functional>
#include <numeric>
#include <random>

#include "small_run.hh"
#include "support.hh"

namespace lgiw {
namespace {

using h5::File;

void expect_same(const std::vector<float>& a, const std::vector<float>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k)
    EXPECT_TRUE(a[k] == b[k] || (std::isnan(a[k]) && std::isnan(b[k]))) << k << ": " << a[k] << " " << b[k];
}

TEST(RunFile, RoundTrip) {
  const Scratch scratch;
  const std::string path = scratch / "r.h5";
  write_small_run(path, 7);
  const RunReader run(path);
  EXPECT_EQ(run.header().particles.counts.water, 2);
  EXPECT_EQ(run.header().particles.counts.soil, 1);
  EXPECT_EQ(run.header().particles.counts.wall, 2);
  EXPECT_EQ(run.header().particles.counts.wall_left_out, 17);
  EXPECT_EQ(run.header().particles.bed.at(1, 0), 0.2);
  EXPECT_EQ(run.header().particle_volume, 0.125);
  EXPECT_EQ(run.header().left_out, "[\"artificial stress\"]");
  EXPECT_EQ(run.header().initial_soil, (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(run.header().map.nx, 3u);
  EXPECT_EQ(run.header().map.ny, 2u);
  EXPECT_EQ(run.header().map.x0, 1);
  EXPECT_EQ(run.header().map.y0, 0.5);
  EXPECT_EQ(run.header().map.dx, 2);
  ASSERT_EQ(run.frame_count(), 3u);
  for (int k = 0; k < 3; ++k) {
    const Frame frame = run.frame(k), wanted = small_frame(k);
    EXPECT_EQ(run.frame_time(k), 0.5 * k);
    EXPECT_EQ(frame.time, 0.5 * k);
    EXPECT_EQ(frame.points, wanted.points);
    EXPECT_EQ(frame.velocity, wanted.velocity);
    EXPECT_EQ(frame.pressure, wanted.pressure);
    EXPECT_EQ(frame.adps, wanted.adps);
    EXPECT_EQ(frame.lost, wanted.lost);
  }
  ASSERT_EQ(run.surface_times(), (std::vector<double>{0, 0.25, 0.5, 0.75, 1, 1.25, 1.5}));
  EXPECT_TRUE(run.has_water_surface());
  EXPECT_TRUE(run.has_soil_surface());
  expect_same(run.water_surface(4), small_map(4));
  expect_same(run.soil_surface(4), small_map(-4));
  EXPECT_EQ(run.water_surface_at(2, 1), (std::vector<float>{0, 0.5f, 1, 1.5f, 2, 2.5f, 3}));
  EXPECT_EQ(run.soil_surface_at(0, 0), (std::vector<float>{0, -1, -2, -3, -4, -5, -6}));
  EXPECT_EQ(run.header().pressure_gauges, (std::vector<std::string>{"wall", "bed"}));
  EXPECT_EQ(run.pressure(0), (std::vector<float>{100, 101, 102, 103, 104, 105, 106}));
  EXPECT_EQ(run.pressure(1), (std::vector<float>{200, 199, 198, 197, 196, 195, 194}));
  EXPECT_EQ(File::open_read(path).read<double>("/lgiw/pressure_gauges/time"), run.surface_times());
  expect_same(run.maximum("elevation"), small_map(9));
  expect_same(run.maximum("depth"), std::vector<float>(6, NAN));
  EXPECT_TRUE(run.maximum("nonsense").empty());
  const auto diagnostics = run.diagnostics();
  ASSERT_EQ(diagnostics.size(), 4u);
  EXPECT_EQ(diagnostics.at("time").size(), 21u);
  EXPECT_EQ(diagnostics.at("energy")[20], -6);
  EXPECT_EQ(diagnostics.at("a density")[1], 1001);
  EXPECT_EQ(run.summary(), "{\"steps\": 3}");
}

TEST(RunFile, LeavesOutWhatTheSceneLacks) {
  const Scratch scratch;
  RunHeader header = small_run();
  header.particles.counts = {0, 1, 0, 0};
  header.particles.still_water_level = NAN;
  header.pressure_gauges.clear();
  RunWriter writer(scratch / "soil.h5", header);
  writer.add_frame({0, {1, 2, 3}, {0, 0, 0}, {}, {0.5f}, {0}});
  writer.add_surface(0, {}, small_map(1));
  writer.close();
  const RunReader soil(scratch / "soil.h5");
  EXPECT_FALSE(soil.has_water_surface());
  EXPECT_TRUE(soil.frame(0).pressure.empty());
  EXPECT_TRUE(soil.maximum("elevation").empty());
  EXPECT_EQ(soil.maximum("soil_speed").size(), 6u);
  EXPECT_EQ(soil.summary(), "");
  const File file = File::open_read(scratch / "soil.h5");
  EXPECT_EQ(file.children("/VTKHDF/PointData"), (std::vector<std::string>{"Adps", "Lost", "Phase", "Velocity"}));
  EXPECT_EQ(file.children("/lgiw/maxima"), std::vector<std::string>{"soil_speed"});
  EXPECT_TRUE(soil.header().pressure_gauges.empty());
  EXPECT_FALSE(file.exists("/lgiw/pressure_gauges"));

  header.particles.counts = {2, 0, 0, 0};
  header.particles.still_water_level = 2;
  header.initial_soil.clear();
  header.pressure_gauges = {"time"};
  EXPECT_EQ(error_of<WorkError>(scratch / "water.h5", [&] { RunWriter(scratch / "water.h5", header); }),
            "cannot add pressures to 'FILE' ('time' is no name for a new gauge) report this as a fault of the program");
  header.pressure_gauges.clear();
  RunWriter water(scratch / "water.h5", header);
  water.add_frame({0, {1, 2, 3, 4, 5, 6}, {0, 0, 0, 0, 0, 0}, {7, 8}, {}, {0, 0}});
  EXPECT_EQ(error_of<WorkError>(scratch / "water.h5", [&] { water.add_surface(0, small_map(1), small_map(1)); }),
            "cannot add a soil surface to 'FILE' (6 values instead of 0) report this as a fault of the program");
  EXPECT_EQ(
      error_of<WorkError>(scratch / "water.h5",
                          [&] {
                            water.write_maxima({{"soil_speed", small_map(1)}});
                          }),
      "cannot add the maximum 'soil_speed' to 'FILE' (the scene has none of that name) report this as a fault of the "
      "program");
  EXPECT_EQ(error_of<WorkError>(scratch / "water.h5",
                                [&] {
                                  water.add_frame({0, {1, 2, 3}, {0, 0, 0}, {7}, {}, {0}});
                                }),
            "cannot add points to 'FILE' (3 values instead of 6) report this as a fault of the program");
  water.add_diagnostics(0, {{"mass", 1}});
  EXPECT_EQ(
      error_of<WorkError>(scratch / "water.h5",
                          [&] {
                            water.add_diagnostics(1, {{"energy", 1}});
                          }),
      "cannot add diagnostics to 'FILE' (the columns are not those of the first row) report this as a fault of the "
      "program");
  water.close();
  EXPECT_FALSE(File::open_read(scratch / "water.h5").exists("/VTKHDF/PointData/Adps"));
}

TEST(RunFile, IsTheTemporalVtkhdfThatReadersWant) {
  const Scratch scratch;
  const std::string path = scratch / "r.h5";
  write_small_run(path, 4);  // 2 frames of 3 particles
  const File file = File::open_read(path);
  using List = std::vector<int64_t>;
  const auto ints = [&](const std::string& name) { return file.read<int64_t>("/VTKHDF/" + name); };
  EXPECT_EQ(file.text_attribute("/VTKHDF", "Type"), "PolyData");
  EXPECT_EQ(file.number_attribute("/VTKHDF/Steps", "NSteps"), 2);
  EXPECT_EQ(file.read<double>("/VTKHDF/Steps/Values"), (std::vector<double>{0, 0.5}));
  EXPECT_EQ(ints("NumberOfPoints"), List{3});
  EXPECT_EQ(ints("Vertices/Connectivity"), (List{0, 1, 2}));
  EXPECT_EQ(ints("Steps/PartOffsets"), (List{0, 0}));
  EXPECT_EQ(ints("Steps/NumberOfParts"), (List{1, 1}));
  EXPECT_EQ(ints("Steps/PointOffsets"), (List{0, 3}));
  EXPECT_EQ(ints("Steps/CellOffsets"), List(8, 0));
  EXPECT_EQ(file.shape("/VTKHDF/Steps/CellOffsets"), (h5::Shape{2, 4}));
  EXPECT_EQ(ints("Steps/ConnectivityIdOffsets"), List(8, 0));
  EXPECT_EQ(file.shape("/VTKHDF/Steps/ConnectivityIdOffsets"), (h5::Shape{2, 4}));
  EXPECT_EQ(ints("Steps/PointDataOffsets/Phase"), (List{0, 0}));
  EXPECT_EQ(file.children("/VTKHDF/Steps/PointDataOffsets"), file.children("/VTKHDF/PointData"));
  for (const char* name : {"Velocity", "Pressure", "Adps", "Lost"})
    EXPECT_EQ(ints(std::string("Steps/PointDataOffsets/") + name), (List{0, 3})) << name;
  EXPECT_EQ(file.shape("/VTKHDF/Points"), (h5::Shape{6, 3}));
  EXPECT_EQ(file.shape("/VTKHDF/PointData/Velocity"), (h5::Shape{6, 3}));
  EXPECT_EQ(file.shape("/VTKHDF/PointData/Phase"), (h5::Shape{3}));
  EXPECT_EQ(file.shape("/VTKHDF/PointData/Lost"), (h5::Shape{6}));
}

/// Its surfaces are two fields of six tiles.
RunHeader tiled_run() {
  RunHeader header = small_run();
  header.map = {300, 200, 0, 0, 1};
  header.pressure_gauges.clear();
  return header;
}

TEST(RunFile, LargeMapsAreTiledAndNodesReadAsSeries) {
  const Scratch scratch;
  RunWriter writer(scratch / "r.h5", tiled_run());
  std::vector<float> map(tiled_run().map.size());
  for (int k = 0; k < 5; ++k) {
    std::iota(map.begin(), map.end(), float(k));
    writer.add_surface(k, map, map);
  }
  writer.add_surface(5, std::vector<float>(map.size(), NAN), std::vector<float>(map.size(), 0));
  writer.close();
  const RunReader run(scratch / "r.h5");
  EXPECT_EQ(run.water_surface(4), map);
  EXPECT_EQ(run.soil_surface(5), std::vector<float>(map.size(), 0));
  const float first = 199 * 300 + 299;
  EXPECT_EQ(run.soil_surface_at(299, 199), (std::vector<float>{first, first + 1, first + 2, first + 3, first + 4, 0}));
}

TEST(RunFile, GrowsWithLittleMemory) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer's allocator does not tell how much is in use";
#endif
  const Scratch scratch;
  RunWriter writer(scratch / "r.h5", tiled_run());
  const std::vector<float> map(tiled_run().map.size(), 1);
  std::size_t before = 0;
  const auto in_use = [] {
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
  };
  for (int k = 0; k < 400; ++k) {
    writer.add_surface(k, map, map);
    if (k % 10 == 9) writer.flush();
    if (k == 99) before = in_use();
  }
  const double a_tile = (double(in_use()) - double(before)) / (300 * 12);
  EXPECT_GT(in_use(), 1000u);
  EXPECT_LT(a_tile, 60);
}

TEST(RunFile, RerunsAndFlushesLeaveTheSameBytes) {
  const Scratch scratch;
  write_small_run(scratch / "a.h5", 400);  // past a chunk of diagnostics, and splits of the chunk index
  RunWriter writer(scratch / "b.h5", small_run());
  for (int step = 0; step < 400; ++step) {
    add_step(writer, step);
    if (step % 7 == 3) writer.flush();
    if (step % 50 == 9) writer.write_maxima({{"depth", small_map(3)}});
  }
  writer.write_maxima({{"depth", std::vector<float>(6, NAN)}});
  finish(writer);
  // The payload of a NaN is that of the writer: these rasters are of NAN in both.
  EXPECT_EQ(bytes_of(scratch / "a.h5").compare(bytes_of(scratch / "b.h5")), 0);
}

TEST(RunFile, ResumedRunEndsInTheSameBytes) {
  const Scratch scratch;
  write_small_run(scratch / "whole.h5", 400);
  for (const int checkpoint : {1, 5, 342, 399}) {
    const std::string path = scratch / "resumed.h5";
    int64_t frames = 0, surfaces = 0, diagnostics = 0;
    {
      RunWriter writer(path, small_run());
      for (int step = 0; step < 400; ++step) {
        add_step(writer, step);
        if (step + 1 == checkpoint) {
          frames = writer.frames();
          surfaces = writer.surfaces();
          diagnostics = writer.diagnostics();
          writer.flush();
        }
      }
      finish(writer);
    }
    RunWriter writer = RunWriter::reopen(path, frames, surfaces, diagnostics);
    EXPECT_EQ(writer.frames(), frames);
    EXPECT_EQ(writer.surfaces(), checkpoint);
    EXPECT_EQ(writer.diagnostics(), 3 * checkpoint);
    EXPECT_EQ(RunReader(path).summary(), "");
    for (int step = checkpoint; step < 400; ++step) add_step(writer, step);
    finish(writer);
    EXPECT_EQ(bytes_of(path).compare(bytes_of(scratch / "whole.h5")), 0) << checkpoint;
  }
}

TEST(RunFile, ResumeAtTheVeryStartAndTwice) {
  const Scratch scratch;
  const std::string path = scratch / "r.h5";
  write_small_run(scratch / "whole.h5", 40);
  write_small_run(path, 40);
  RunWriter::reopen(path, 7, 20, 60).close();
  RunWriter::reopen(path, 7, 19, 57).close();
  RunWriter writer = RunWriter::reopen(path, 0, 0, 0);
  for (int step = 0; step < 40; ++step) add_step(writer, step);
  finish(writer);
  EXPECT_EQ(bytes_of(path).compare(bytes_of(scratch / "whole.h5")), 0);
}

TEST(RunFile, ReopenRefusesARunShorterThanTheCheckpoint) {
  const Scratch scratch;
  const std::string path = scratch / "r.h5";
  write_small_run(path, 4);
  const std::string before = bytes_of(path);
  EXPECT_EQ(error_of<InputError>(path, [&] { RunWriter::reopen(path, 3, 4, 12); }),
            "cannot continue 'FILE' (it has 2 frames where the checkpoint has 3) give the run that belongs to the "
            "checkpoint");
  EXPECT_EQ(
      error_of<InputError>(path, [&] { RunWriter::reopen(path, 2, 4, 13); }),
      "cannot continue 'FILE' (it has 12 rows of diagnostics where the checkpoint has 13) give the run that belongs to "
      "the checkpoint");
  EXPECT_EQ(bytes_of(path).compare(before), 0);
}

/// Flushes after step 100 and dies in the midst of more.
void be_killed(const std::string& path) {
  RunWriter writer(path, small_run());
  for (int step = 0; step < 250; ++step) {
    add_step(writer, step);
    if (step == 99) writer.flush();
  }
  raise(SIGKILL);
}

TEST(RunFile, KilledWriterLeavesTheFileOfTheLastFlush) {
  const Scratch scratch;
  const std::string path = scratch / "r.h5";
  EXPECT_EXIT(be_killed(path), testing::KilledBySignal(SIGKILL), "");
  {
    const RunReader run(path);
    EXPECT_EQ(run.frame_count(), 34u);
    EXPECT_EQ(run.surface_times().size(), 100u);
    EXPECT_EQ(run.diagnostics().at("energy").size(), 300u);
    EXPECT_EQ(run.frame(33).points, small_frame(33).points);
    expect_same(run.soil_surface(99), small_map(-99));
    EXPECT_EQ(run.water_surface_at(0, 0)[99], 99);
    EXPECT_EQ(run.pressure(1).size(), 100u);
    EXPECT_EQ(run.pressure(1)[99], 101);
  }
  RunWriter writer = RunWriter::reopen(path, 34, 100, 300);
  for (int step = 100; step < 250; ++step) add_step(writer, step);
  finish(writer);
  write_small_run(scratch / "whole.h5", 250);
  EXPECT_EQ(bytes_of(path).compare(bytes_of(scratch / "whole.h5")), 0);
}

/// The error of opening the small run, or reading all of it, after `damage`.
std::string error_after(const std::function<void(File&)>& damage) {
  const Scratch scratch;
  const std::string path = scratch / "r.h5";
  write_small_run(path, 4);
  File file = File::open_write(path);
  damage(file);
  file.close();
  return error_of<InputError>(path, [&] {
    const RunReader run(path);
    for (std::size_t k = 0; k < run.frame_count(); ++k) run.frame(k);
    for (std::size_t k = 0; k < run.surface_times().size(); ++k) run.water_surface(k);
    for (std::size_t k = 0; k < run.header().pressure_gauges.size(); ++k) run.pressure(k);
    run.diagnostics();
  });
}

TEST(MalformedRun, IsRefusedWithTheReason) {
  const std::string again = " make the file again";
  const auto set = [](const std::string& name, const h5::Shape& at, float value) {
    return [=](File& file) { file.write_slab(name, &value, at, h5::Shape(at.size(), 1)); };
  };
  EXPECT_EQ(
      error_after([](File& f) { f.set_attribute("/lgiw", "Format", "lgiw-particles 1"); }),
      "'FILE' is not a run file (its Format is 'lgiw-particles 1' instead of 'lgiw-run 1') make one with lgiw-run");
  EXPECT_EQ(error_after([](File& f) { f.set_attribute("/VTKHDF/Steps", "NSteps", int64_t(3)); }),
            "/VTKHDF/Steps/Values of 'FILE' is unsound (it has 2 rows instead of 3)" + again);
  EXPECT_EQ(error_after([](File& f) { f.set_attribute("/VTKHDF/Steps", "NSteps", int64_t(1) << 50); }),
            "/VTKHDF/Steps@NSteps of 'FILE' is unsound (1125899906842624.000000 is not a count)" + again);
  EXPECT_EQ(error_after([](File& f) { f.set_attribute("/lgiw/surface", "Count", 0.5); }),
            "/lgiw/surface@Count of 'FILE' is unsound (0.500000 is not a count)" + again);
  EXPECT_EQ(
      error_after([](File& f) { f.set_attribute("/lgiw/diagnostics", "Count", int64_t(13)); }),
      "/lgiw/diagnostics/a density of 'FILE' is unsound (it is shorter than the 13 rows that are counted)" + again);
  EXPECT_EQ(error_after([](File& f) { f.set_attribute("/lgiw/pressure_gauges", "Count", int64_t(3)); }),
            "/lgiw/pressure_gauges@Count of 'FILE' is unsound (it is not that of the surfaces)" + again);
  EXPECT_EQ(error_after([](File& f) { f.set_attribute("/lgiw/pressure_gauges", "Names", "wall\nsky\n"); }),
            "cannot read '/lgiw/pressure_gauges/sky' of 'FILE' (there is no such dataset) the file is damaged or of "
            "another kind, make it again");
  EXPECT_EQ(error_after(set("/lgiw/pressure_gauges/bed", {2}, NAN)),
            "/lgiw/pressure_gauges/bed of 'FILE' is unsound (the value of row 2 is not finite)" + again);
  EXPECT_EQ(error_after(set("/VTKHDF/Steps/Values", {1}, -1)),
            "/VTKHDF/Steps/Values of 'FILE' is unsound (a time is earlier than the one before it)" + again);
  EXPECT_EQ(error_after(set("/VTKHDF/Steps/Values", {1}, NAN)),
            "/VTKHDF/Steps/Values of 'FILE' is unsound (the value of row 1 is not finite)" + again);
  EXPECT_EQ(error_after(set("/VTKHDF/Points", {4, 1}, NAN)),
            "/VTKHDF/Points of 'FILE' is unsound (the value of row 4 is not finite)" + again);
  EXPECT_EQ(error_after(set("/VTKHDF/PointData/Phase", {1}, 1)),
            "/VTKHDF/PointData/Phase of 'FILE' is unsound (particle 1 has phase 1 where /lgiw@Counts says 0)" + again);
  EXPECT_EQ(error_after(set("/VTKHDF/PointData/Lost", {2}, 3)),
            "/VTKHDF/PointData/Lost of 'FILE' is unsound (that of row 2 is neither 0 nor 1)" + again);
  EXPECT_EQ(error_after([](File& f) { f.set_attribute("/lgiw", "ParticleVolume", 0.0); }),
            "/lgiw@ParticleVolume of 'FILE' is unsound (0.000000 is not above 0)" + again);
  EXPECT_EQ(error_after([](File& f) { f.set_attribute("/lgiw/surface", "dx", -2.0); }),
            "/lgiw/surface of 'FILE' is unsound (x0, y0 and dx must be finite and dx above 0)" + again);
  EXPECT_EQ(error_after([](File& f) {
              remove_object(f, "/lgiw/maxima/elevation");
              f.write("/lgiw/maxima/elevation", std::vector<float>(8).data(), {2, 4});
            }),
            "/lgiw/maxima/depth of 'FILE' is unsound (its size is not that of the other maxima)" + again);
  const std::string kind = " the file is damaged or of another kind, make it again";
  EXPECT_EQ(error_after([](File& f) { remove_object(f, "/lgiw/soil/InitialPoints"); }),
            "cannot read '/lgiw/soil/InitialPoints' of 'FILE' (there is no such dataset)" + kind);
  EXPECT_EQ(error_after([](File& f) { remove_object(f, "/VTKHDF/PointData/Adps"); }),
            "cannot read '/VTKHDF/PointData/Adps' of 'FILE' (there is no such dataset)" + kind);
  EXPECT_EQ(
      error_after([](File& f) {
        remove_object(f, "/VTKHDF/Points");
        f.create_dataset<float>("/VTKHDF/Points", {hsize_t(1) << 45, 3}, true, true, {1024, 3});
      }),
      "cannot read '/VTKHDF/Points' of 'FILE' (its size [35184372088832,3] is more than the 0 bytes stored)" + kind);
  const auto counts = [](File& f) { f.set_attribute("/lgiw", "Counts", std::vector<int64_t>{3, 1, 2}); };
  EXPECT_EQ(error_after(counts), "/VTKHDF/PointData/Phase of 'FILE' is unsound (it has 3 rows instead of 4)" + again);
}

TEST(MalformedRun, TruncationsAndDamagedBytesNeverCrash) {
  const LeaksOfHdf5 allowed;
  const Scratch scratch;
  const std::string whole = scratch / "r.h5", path = scratch / "damaged.h5";
  write_small_run(whole, 20);
  const std::string bytes = bytes_of(whole);
  const auto read_all = [&] {
    const RunReader run(path);
    for (std::size_t k = 0; k < run.frame_count(); ++k) run.frame(k);
    for (std::size_t k = 0; k < run.surface_times().size(); ++k) run.soil_surface(k);
    run.water_surface_at(1, 1);
    for (std::size_t k = 0; k < run.header().pressure_gauges.size(); ++k) run.pressure(k);
    run.diagnostics();
  };
  for (std::size_t size = 1; size < bytes.size(); size += 1 + size / 20) {
    write_bytes(path, bytes.substr(0, size));
    ASSERT_EQ(error_of<InputError>(path, read_all).rfind("cannot open 'FILE' (", 0), 0u) << size;
  }
  std::mt19937 random(11);
  int refused = 0;
  for (int k = 0; k < 300; ++k) {
    std::string copy = bytes;
    for (int flips = 0; flips < 5; ++flips) copy[random() % copy.size()] = char(random());
    write_bytes(path, copy);
    try {
      read_all();
    } catch (const InputError& error) {
      ++refused;
      ASSERT_NE(std::string(error.what()).find(path), std::string::npos);
    }
  }
  EXPECT_GT(refused, 50);
}

TEST(Xdmf, RefersToTheRowsOfEachFrame) {
  const Scratch scratch;
  std::filesystem::create_directory(scratch / "out");
  write_small_run(scratch / "out/a & b.h5", 4);
  const std::string xmf = scratch / "run.xmf";
  write_xdmf(scratch / "out/a & b.h5", xmf);
  const std::string text = bytes_of(xmf);
  const auto has = [&](const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  };
  has("<Grid Name=\"run\" GridType=\"Collection\" CollectionType=\"Temporal\">");
  has("<Time Value=\"0\"/>");
  has("<Time Value=\"0.5\"/>");
  has("<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"3\" NodesPerElement=\"1\"><DataItem Format=\"HDF\" "
      "NumberType=\"Int\" Precision=\"8\" Dimensions=\"3\">out/a &amp; "
      "b.h5:/VTKHDF/Vertices/Connectivity|0:1:3:3</DataItem>");
  has("Dimensions=\"3 3\">out/a &amp; b.h5:/VTKHDF/Points|0 0:1 1:3 3:6 3</DataItem>");
  has("Dimensions=\"3 3\">out/a &amp; b.h5:/VTKHDF/Points|3 0:1 1:3 3:6 3</DataItem>");
  has("<Attribute Name=\"Pressure\" AttributeType=\"Scalar\" Center=\"Node\"><DataItem Format=\"HDF\" "
      "NumberType=\"Float\" "
      "Precision=\"4\" Dimensions=\"3\">out/a &amp; b.h5:/VTKHDF/PointData/Pressure|3:1:3:6</DataItem>");
  has("out/a &amp; b.h5:/VTKHDF/PointData/Phase|0:1:3:3</DataItem>");
  EXPECT_EQ(error_of<InputError>(xmf, [&] { write_xdmf(scratch / "out/a & b.h5", xmf); }),
            "FILE exists (it would be overwritten) pass -O/--overwrite or choose another name");
  write_xdmf(scratch / "out/a & b.h5", xmf, true);
}

}  // namespace
}  // namespace lgiw
