#include "files/particle_file.hh"

#include <sys/resource.h>

#include <functional>
#include <random>

#include "support.hh"

namespace lgiw {
namespace {

using h5::File;
using h5::Handle;
using h5::Shape;

TEST(ParticleFile, RoundTrip) {
  const Scratch scratch;
  const std::string path = scratch / "p.h5";
  write_small_particles(path);
  const ParticleData data = read_particles(path);
  const ParticleHeader& h = data.header;
  const ParticleHeader wanted = small_header();
  EXPECT_EQ(h.dimension, 3);
  EXPECT_EQ(h.dp, 0.5);
  EXPECT_EQ(h.origin, wanted.origin);
  EXPECT_EQ(h.crs_wkt, wanted.crs_wkt);
  EXPECT_EQ(h.vertical_datum, "EGM96");
  EXPECT_EQ(h.attribution, "Office, CC BY 4.0");
  EXPECT_EQ(h.still_water_level, 2.25);
  EXPECT_EQ(h.low, wanted.low);
  EXPECT_EQ(h.high, wanted.high);
  EXPECT_EQ(h.sides, wanted.sides);
  EXPECT_EQ(h.absorbing_width, 1.5);
  EXPECT_EQ(h.case_text, wanted.case_text);
  EXPECT_EQ(h.provenance, "{}");
  EXPECT_EQ(h.counts.water, 2);
  EXPECT_EQ(h.counts.soil, 1);
  EXPECT_EQ(h.counts.wall, 2);
  EXPECT_EQ(h.counts.wall_left_out, 17);
  EXPECT_EQ(h.bed.nx, 3u);
  EXPECT_EQ(h.bed.ny, 2u);
  EXPECT_EQ(h.bed.x0, -1);
  EXPECT_EQ(h.bed.y0, -0.5);
  EXPECT_EQ(h.bed.dx, 6);
  EXPECT_EQ(h.bed.at(1, 1), 0.5);
  EXPECT_TRUE(std::isnan(h.bed.at(2, 0)));
  EXPECT_EQ(h.ground.at(0, 1), 4);
  const auto same = [](const ParticleBlock& a, const ParticleBlock& b) {
    EXPECT_EQ(a.phase, b.phase);
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.volume, b.volume);
    EXPECT_EQ(a.density, b.density);
    EXPECT_EQ(a.pressure, b.pressure);
    EXPECT_EQ(a.stress, b.stress);
    EXPECT_EQ(a.normal, b.normal);
    EXPECT_EQ(a.kind, b.kind);
  };
  same(data.water, small_water());
  same(data.soil, small_soil());
  same(data.wall, small_wall());
  EXPECT_EQ(read_particle_header(path).counts.total(), 5);
}

TEST(ParticleFile, WaterAloneHasNoSoilDatasets) {
  const Scratch scratch;
  const std::string path = scratch / "p.h5";
  ParticleHeader header = small_header();
  header.counts = {2, 0, 0, 0};
  header.bed = header.ground = {};
  ParticleWriter writer(path, header);
  writer.append(small_water());
  writer.finish();
  const ParticleData data = read_particles(path);
  EXPECT_EQ(data.water.size(), 2u);
  EXPECT_EQ(data.soil.size(), 0u);
  EXPECT_TRUE(data.header.bed.empty());
  const File file = File::open_read(path);
  EXPECT_EQ(file.children("/lgiw"), std::vector<std::string>());
}

BodyMotion small_motion() {
  BodyMotion m;
  m.name = "plate";
  m.pivot = {1, 2, 3};
  m.heading = 120;
  m.time = {-1, 0, 2.5};
  m.pitch = {0, 0, 0.25};
  m.displacement = {{0, 0, 0}, {0, 0, 0}, {1.5, 0.5, -1}};
  return m;
}

/// Everything moves: water, the soil at the outset, and the second wall particle with the second body.
void write_moving_particles(const std::string& path) {
  ParticleHeader header = small_header();
  header.bodies = {small_motion(), small_motion()};
  header.bodies[1].name = "gate";
  header.initial_velocity = true;
  ParticleWriter writer(path, header);
  ParticleBlock water = small_water(), soil = small_soil(), wall = small_wall();
  water.velocity = {1, 0, -1, 0.5f, 0, 0};
  soil.velocity = {3, 0, -3};
  wall.kind = {0, 2};
  wall.body = {0, 2};
  for (const ParticleBlock& block : {water, soil, wall}) writer.append(block);
  writer.finish();
}

TEST(ParticleFile, RoundTripOfWhatMoves) {
  const Scratch scratch;
  const std::string path = scratch / "p.h5";
  write_moving_particles(path);
  const ParticleData data = read_particles(path);
  EXPECT_TRUE(data.header.initial_velocity);
  EXPECT_EQ(data.water.velocity, (std::vector<float>{1, 0, -1, 0.5f, 0, 0}));
  EXPECT_EQ(data.soil.velocity, (std::vector<float>{3, 0, -3}));
  EXPECT_TRUE(data.wall.velocity.empty());
  EXPECT_EQ(data.wall.body, (std::vector<uint8_t>{0, 2}));
  EXPECT_EQ(data.wall.kind, (std::vector<uint8_t>{0, 2}));
  ASSERT_EQ(data.header.bodies.size(), 2u);
  EXPECT_EQ(data.header.bodies[1].name, "gate");
  for (const BodyMotion& m : data.header.bodies) {
    EXPECT_EQ(m.pivot, small_motion().pivot);
    EXPECT_EQ(m.heading, 120);
    EXPECT_EQ(m.time, small_motion().time);
    EXPECT_EQ(m.pitch, small_motion().pitch);
    EXPECT_EQ(m.displacement, small_motion().displacement);
  }
  EXPECT_EQ(read_particle_header(path).bodies.size(), 2u);
}

TEST(ParticleFile, WhatRestsHasNoVelocities) {
  const Scratch scratch;
  write_small_particles(scratch / "p.h5");
  const ParticleData data = read_particles(scratch / "p.h5");
  EXPECT_FALSE(data.header.initial_velocity);
  EXPECT_TRUE(data.water.velocity.empty() && data.soil.velocity.empty() && data.wall.body.empty());
  const File file = File::open_read(scratch / "p.h5");
  EXPECT_FALSE(file.exists("/VTKHDF/PointData/Velocity"));
  EXPECT_FALSE(file.exists("/lgiw/bodies"));
  EXPECT_FALSE(file.exists("/lgiw/wall/Body"));
}

TEST(ParticleFile, BlocksInAnyOrderAndPiecesGiveTheSameFile) {
  const Scratch scratch;
  write_small_particles(scratch / "a.h5");
  write_small_particles(scratch / "b.h5");
  EXPECT_EQ(bytes_of(scratch / "a.h5").compare(bytes_of(scratch / "b.h5")), 0);
  ParticleWriter writer(scratch / "c.h5", small_header());
  writer.append(small_wall());
  writer.append(small_soil());
  const ParticleBlock both = small_water();
  for (int k = 0; k < 2; ++k) {
    ParticleBlock one;
    one.points.assign(both.points.begin() + 3 * k, both.points.begin() + 3 * k + 3);
    one.volume = {both.volume[k]};
    one.density = {both.density[k]};
    one.pressure = {both.pressure[k]};
    writer.append(one);
  }
  writer.finish();
  EXPECT_EQ(bytes_of(scratch / "a.h5").compare(bytes_of(scratch / "c.h5")), 0);
}

/// Class, size and extents of a dataset, as "float64[5,3]".
std::string dataset_text(const std::string& path, const std::string& name) {
  const Handle file = raw_file(path, H5F_ACC_RDONLY);
  const Handle dataset(H5Dopen2(file.id(), name.c_str(), H5P_DEFAULT));
  const Handle type(H5Dget_type(dataset.id())), space(H5Dget_space(dataset.id()));
  std::string text = H5Tget_class(type.id()) == H5T_FLOAT  ? "float"
                     : H5Tget_sign(type.id()) == H5T_SGN_2 ? "int"
                                                           : "uint";
  text += std::to_string(8 * H5Tget_size(type.id())) + "[";
  hsize_t dims[8];
  const int rank = H5Sget_simple_extent_dims(space.id(), dims, nullptr);
  for (int k = 0; k < rank; ++k) text.append(k ? "," : "").append(std::to_string(dims[k]));
  return text + "]";
}

TEST(ParticleFile, IsTheVtkhdfThatReadersWant) {
  const Scratch scratch;
  const std::string path = scratch / "p.h5";
  write_small_particles(path);
  {
    const Handle file = raw_file(path, H5F_ACC_RDONLY);
    const Handle type(H5Aopen_by_name(file.id(), "/VTKHDF", "Type", H5P_DEFAULT, H5P_DEFAULT));
    const Handle text(H5Aget_type(type.id())), scalar(H5Aget_space(type.id()));
    EXPECT_EQ(H5Tget_class(text.id()), H5T_STRING);
    EXPECT_EQ(H5Tis_variable_str(text.id()), 0);
    EXPECT_EQ(H5Tget_cset(text.id()), H5T_CSET_ASCII);
    EXPECT_EQ(H5Tget_size(text.id()), 8u);  // "PolyData" without a terminator
    EXPECT_EQ(H5Sget_simple_extent_type(scalar.id()), H5S_SCALAR);
    const Handle version(H5Aopen_by_name(file.id(), "/VTKHDF", "Version", H5P_DEFAULT, H5P_DEFAULT));
    const Handle number(H5Aget_type(version.id()));
    EXPECT_GT(H5Tequal(number.id(), H5T_STD_I64LE), 0);
    const Handle group(H5Oopen(file.id(), "/VTKHDF", H5P_DEFAULT));
    H5O_info_t info;
    ASSERT_GE(H5Oget_info(group.id(), &info), 0);
    EXPECT_EQ(info.mtime, 0);
    EXPECT_EQ(info.ctime, 0);
  }
  const File file = File::open_read(path);
  EXPECT_EQ(file.text_attribute("/VTKHDF", "Type"), "PolyData");
  EXPECT_EQ(file.numbers_attribute("/VTKHDF", "Version"), (std::vector<double>{2, 0}));
  EXPECT_EQ(file.children("/VTKHDF"), (std::vector<std::string>{"Lines", "NumberOfPoints", "PointData", "Points",
                                                                "Polygons", "Strips", "Vertices"}));
  const auto ints = [&](const std::string& name) {
    EXPECT_EQ(dataset_text(path, name).substr(0, 6), "int64[") << name;
    return file.read<int64_t>(name);
  };
  using List = std::vector<int64_t>;
  EXPECT_EQ(ints("/VTKHDF/NumberOfPoints"), List{5});
  EXPECT_EQ(ints("/VTKHDF/Vertices/NumberOfCells"), List{5});
  EXPECT_EQ(ints("/VTKHDF/Vertices/NumberOfConnectivityIds"), List{5});
  EXPECT_EQ(ints("/VTKHDF/Vertices/Connectivity"), (List{0, 1, 2, 3, 4}));
  EXPECT_EQ(ints("/VTKHDF/Vertices/Offsets"), (List{0, 1, 2, 3, 4, 5}));
  for (const std::string kind : {"/VTKHDF/Lines/", "/VTKHDF/Polygons/", "/VTKHDF/Strips/"}) {
    EXPECT_EQ(ints(kind + "NumberOfCells"), List{0});
    EXPECT_EQ(ints(kind + "NumberOfConnectivityIds"), List{0});
    EXPECT_EQ(ints(kind + "Connectivity"), List{});
    EXPECT_EQ(ints(kind + "Offsets"), List{0});
  }
  EXPECT_EQ(dataset_text(path, "/VTKHDF/Points"), "float64[5,3]");
  EXPECT_EQ(dataset_text(path, "/VTKHDF/PointData/Phase"), "uint8[5]");
  EXPECT_EQ(dataset_text(path, "/VTKHDF/PointData/Volume"), "float32[5]");
  EXPECT_EQ(dataset_text(path, "/VTKHDF/PointData/Density"), "float32[5]");
  EXPECT_EQ(dataset_text(path, "/VTKHDF/PointData/Pressure"), "float32[5]");
  EXPECT_EQ(file.read<uint8_t>("/VTKHDF/PointData/Phase"), (std::vector<uint8_t>{0, 0, 1, 2, 2}));
  EXPECT_EQ(dataset_text(path, "/lgiw/soil/Stress"), "float32[1,6]");
  EXPECT_EQ(dataset_text(path, "/lgiw/wall/Normal"), "float32[2,3]");
  EXPECT_EQ(dataset_text(path, "/lgiw/wall/Kind"), "uint8[2]");
  EXPECT_EQ(dataset_text(path, "/lgiw/bed"), "float64[2,3]");
  EXPECT_EQ(file.text_attribute("/lgiw", "Format"), "lgiw-particles 1");
  EXPECT_EQ(file.text_attribute("/lgiw", "LeftOut"), "{\"wall_particles\": 17}");
}

TEST(ParticleFile, TopologyLongerThanOneSlab) {
  const Scratch scratch;
  for (const int64_t n : {131071, 131072, 300000}) {
    const std::string path = scratch / (std::to_string(n) + ".h5");
    ParticleHeader header = small_header();
    header.counts = {n, 0, 0, 0};
    ParticleWriter writer(path, header);
    ParticleBlock block;
    block.points.assign(std::size_t(3 * n), 1.0);
    block.volume.assign(std::size_t(n), 0.125f);
    block.density.assign(std::size_t(n), 1000);
    block.pressure.assign(std::size_t(n), 0);
    writer.append(block);
    writer.finish();
    const File file = File::open_read(path);
    const std::vector<int64_t> ids = file.read<int64_t>("/VTKHDF/Vertices/Connectivity");
    const std::vector<int64_t> offsets = file.read<int64_t>("/VTKHDF/Vertices/Offsets");
    ASSERT_EQ(int64_t(ids.size()), n);
    ASSERT_EQ(int64_t(offsets.size()), n + 1);
    for (int64_t k = 0; k < n; ++k) ASSERT_EQ(ids[std::size_t(k)], k);
    for (int64_t k = 0; k <= n; ++k) ASSERT_EQ(offsets[std::size_t(k)], k);
  }
}

TEST(ParticleFile, WriterRefusesWhatDoesNotFit) {
  const Scratch scratch;
  const std::string path = scratch / "p.h5";
  ParticleWriter writer(path, small_header());
  writer.append(small_water());
  const std::string fault = " report this as a fault of the program";
  EXPECT_EQ(error_of<WorkError>(path, [&] { writer.append(small_water()); }),
            "cannot add 2 particles of water to 'FILE' (2 were announced and 2 are written)" + fault);
  ParticleBlock soil = small_soil();
  soil.stress.pop_back();
  EXPECT_EQ(error_of<WorkError>(path, [&] { writer.append(soil); }),
            "cannot add 1 particles of soil to 'FILE' (their arrays differ in length)" + fault);
  EXPECT_EQ(error_of<WorkError>(path, [&] { writer.finish(); }),
            "'FILE' is not complete (0 of 1 particles of soil are written)" + fault);

  const std::string other = scratch / "q.h5";
  ParticleHeader header = small_header();
  header.dp = 0;
  EXPECT_EQ(error_of<InputError>(other, [&] { ParticleWriter(other, header); }),
            "the header of 'FILE' is unsound (ParticleSpacing 0.000000 m is not above 0) make the file again");
  EXPECT_FALSE(std::filesystem::exists(other));
}

/// The reading error of the small file (or of the moving one) after `damage`, and whether the header alone tells it.
std::string error_after(const std::function<void(File&)>& damage, bool in_header = false, bool moving = false) {
  const Scratch scratch;
  const std::string path = scratch / "p.h5";
  (moving ? write_moving_particles : write_small_particles)(path);
  File file = File::open_write(path);
  damage(file);
  file.close();
  const std::string text = error_of<InputError>(path, [&] { read_particles(path); });
  if (in_header) {
    EXPECT_EQ(error_of<InputError>(path, [&] { read_particle_header(path); }), text);
  }
  return text;
}

/// Puts another dataset in the place of `name`.
template <class T>
void replace(File& file, const std::string& name, const std::vector<T>& values, const Shape& shape) {
  remove_object(file, name);
  file.write(name, values.data(), shape);
}

template <class T>
std::function<void(File&)> set(const std::string& name, const Shape& at, T value) {
  return [=](File& file) { file.write_slab(name, &value, at, Shape(at.size(), 1)); };
}

template <class T>
std::function<void(File&)> set_attribute(const std::string& object, const std::string& name, T value) {
  return [=](File& file) { file.set_attribute(object, name, value); };
}

const std::string again = " make the file again";

TEST(MalformedParticles, NotOfThisKind) {
  const std::string made = " make one with dem2particles";
  EXPECT_EQ(error_after(set_attribute("/lgiw", "Format", "lgiw-run 1"), true),
            "'FILE' is not a particles file (its Format is 'lgiw-run 1' instead of 'lgiw-particles 1')" + made);
  EXPECT_EQ(error_after(set_attribute("/VTKHDF", "Type", "ImageData"), true),
            "'FILE' is not a particles file (its VTKHDF Type is 'ImageData' instead of 'PolyData')" + made);
  const Scratch scratch;
  const std::string path = scratch / "p.h5";
  File::create(path).close();
  EXPECT_EQ(error_of<InputError>(path, [&] { read_particles(path); }),
            "'FILE' is not a particles file (it has no attribute Format in /lgiw)" + made);
}

TEST(MalformedParticles, ValuesOutOfBounds) {
  EXPECT_EQ(error_after(set<double>("/VTKHDF/Points", {1, 2}, NAN)),
            "/VTKHDF/Points of 'FILE' is unsound (the value of row 1 is not finite)" + again);
  EXPECT_EQ(error_after(set<float>("/VTKHDF/PointData/Density", {4}, INFINITY)),
            "/VTKHDF/PointData/Density of 'FILE' is unsound (the value of row 4 is not finite)" + again);
  EXPECT_EQ(error_after(set<float>("/lgiw/soil/Stress", {0, 5}, NAN)),
            "/lgiw/soil/Stress of 'FILE' is unsound (the value of row 0 is not finite)" + again);
  EXPECT_EQ(error_after(set<float>("/VTKHDF/PointData/Volume", {2}, -0.5f)),
            "/VTKHDF/PointData/Volume of 'FILE' is unsound (that of particle 2 is -0.500000)" + again);
  EXPECT_EQ(error_after(set<float>("/VTKHDF/PointData/Density", {0}, 0.f)),
            "/VTKHDF/PointData/Density of 'FILE' is unsound (that of particle 0 is 0.000000)" + again);
  EXPECT_EQ(
      error_after(set<double>("/VTKHDF/Points", {2, 0}, 10.5)),
      "/VTKHDF/Points of 'FILE' is unsound (particle 2 lies outside the domain, x = 10.500000 is not from 0.000000 to "
      "10.000000)" +
          again);
  EXPECT_EQ(error_after(set<uint8_t>("/VTKHDF/PointData/Phase", {1}, 7)),
            "/VTKHDF/PointData/Phase of 'FILE' is unsound (particle 1 has the unknown phase 7)" + again);
  EXPECT_EQ(error_after(set<uint8_t>("/VTKHDF/PointData/Phase", {1}, 1)),
            "/VTKHDF/PointData/Phase of 'FILE' is unsound (particle 1 is soil where /lgiw@Counts says water)" + again);
  EXPECT_EQ(error_after(set<float>("/lgiw/wall/Normal", {1, 2}, 0.7f)),
            "/lgiw/wall/Normal of 'FILE' is unsound (that of wall particle 1 is not a unit vector)" + again);
  EXPECT_EQ(error_after(set<uint8_t>("/lgiw/wall/Kind", {0}, 2)),
            "/lgiw/wall/Kind of 'FILE' is unsound (that of wall particle 0 is neither 0 (bed) nor 1 (side))" + again);
}

TEST(MalformedParticles, BodiesAndVelocities) {
  const auto moving_error = [](const std::function<void(File&)>& damage, bool in_header = false) {
    return error_after(damage, in_header, true);
  };
  EXPECT_EQ(moving_error(set<uint8_t>("/lgiw/wall/Body", {1}, 3)),
            "/lgiw/wall/Body of 'FILE' is unsound (that of wall particle 1 is 3 where /lgiw/bodies holds 2)" + again);
  EXPECT_EQ(moving_error(set<uint8_t>("/lgiw/wall/Body", {0}, 1)),
            "/lgiw/wall/Body of 'FILE' is unsound (that of wall particle 0 is 1 where its Kind is 0)" + again);
  EXPECT_EQ(moving_error(set<uint8_t>("/lgiw/wall/Kind", {1}, 3)),
            "/lgiw/wall/Kind of 'FILE' is unsound (that of wall particle 1 is not 0 (bed), 1 (side) or 2 (body))" +
                again);
  EXPECT_EQ(moving_error(set<float>("/VTKHDF/PointData/Velocity", {0, 1}, NAN)),
            "/VTKHDF/PointData/Velocity of 'FILE' is unsound (the value of row 0 is not finite)" + again);
  EXPECT_EQ(moving_error(set<float>("/VTKHDF/PointData/Velocity", {4, 1}, 1.f)),
            "/VTKHDF/PointData/Velocity of 'FILE' is unsound (wall particle 1 has one)" + again);
  const std::string motion = "the header of 'FILE' is unsound (the motion of a body is unsound: ";
  EXPECT_EQ(moving_error(set<double>("/lgiw/bodies/2/Time", {1}, -2.0), true),
            motion + "its times do not rise)" + again);
  EXPECT_EQ(moving_error(set<double>("/lgiw/bodies/2/Displacement", {2, 2}, NAN), true),
            motion + "a number is not finite)" + again);
  EXPECT_EQ(moving_error([](File& f) { replace<double>(f, "/lgiw/bodies/1/Pitch", {0, 0}, {2}); }, true),
            motion + "its lists differ in length)" + again);
  EXPECT_EQ(moving_error([](File& f) { replace<double>(f, "/lgiw/bodies/1/Displacement", {0, 0, 0}, {3}); }, true),
            "/lgiw/bodies/1/Displacement of 'FILE' is unsound (it does not hold 3 numbers a row)" + again);
  EXPECT_EQ(moving_error(set_attribute("/lgiw/bodies/1", "Pivot", std::vector<double>{1, 2}), true),
            "/lgiw/bodies/1@Pivot of 'FILE' is unsound (it has 2 values)" + again);
  EXPECT_EQ(moving_error([](File& f) { remove_object(f, "/lgiw/bodies/1"); }, true),
            "/lgiw/bodies of 'FILE' is unsound (its groups are not numbered from 1)" + again);
  EXPECT_EQ(moving_error([](File& f) { replace<float>(f, "/VTKHDF/PointData/Velocity", {0, 0, 0}, {1, 3}); }, true),
            "/VTKHDF/PointData/Velocity of 'FILE' is unsound (it has 1 rows where /lgiw@Counts says 5)" + again);

  const Scratch scratch;
  const std::string path = scratch / "p.h5";
  ParticleWriter writer(path, small_header());
  ParticleBlock water = small_water(), wall = small_wall();
  water.velocity.assign(6, 1);
  wall.body.assign(2, 1);
  EXPECT_NE(error_of<WorkError>(path, [&] { writer.append(water); }).find("(they move, and"), std::string::npos);
  EXPECT_NE(error_of<WorkError>(path, [&] { writer.append(wall); }).find("(they belong to"), std::string::npos);
}

TEST(MalformedParticles, SizesThatDisagree) {
  EXPECT_EQ(error_after(set_attribute("/lgiw", "Counts", std::vector<int64_t>{3, 1, 2}), true),
            "/VTKHDF/Points of 'FILE' is unsound (it has 5 rows where /lgiw@Counts says 6)" + again);
  EXPECT_EQ(error_after(set_attribute("/lgiw", "Counts", std::vector<int64_t>{1, 2, 2}), true),
            "/lgiw/soil/Stress of 'FILE' is unsound (it has 1 rows where /lgiw@Counts says 2)" + again);
  EXPECT_EQ(error_after(
                [](File& f) {
                  replace<float>(f, "/VTKHDF/PointData/Volume", {1, 1}, {2});
                },
                true),
            "/VTKHDF/PointData/Volume of 'FILE' is unsound (it has 2 rows where /lgiw@Counts says 5)" + again);
  EXPECT_EQ(error_after([](File& f) {
              replace<double>(f, "/VTKHDF/Points", std::vector<double>(10, 1.0), {5, 2});
            }),
            "/VTKHDF/Points of 'FILE' is unsound (it does not hold 3 numbers a particle)" + again);
  EXPECT_EQ(error_after([](File& f) { remove_object(f, "/lgiw/wall/Kind"); }, true),
            "cannot read '/lgiw/wall/Kind' of 'FILE' (there is no such dataset) the file is damaged or of another "
            "kind, make it "
            "again");
  const auto huge = [](File& file) {
    file.set_attribute("/lgiw", "Counts", std::vector<int64_t>{1000000000000, 1, 2});
    remove_object(file, "/VTKHDF/Points");
    file.create_dataset<double>("/VTKHDF/Points", {1000000000003, 3}, true, false, {1024, 3});
  };
  EXPECT_EQ(
      error_after(huge, true),
      "cannot read '/VTKHDF/Points' of 'FILE' (its size [1000000000003,3] is more than the 0 bytes stored) the file is "
      "damaged or of another kind, make it again");
}

TEST(MalformedParticles, HeadersThatContradictThemselves) {
  const std::string head = "the header of 'FILE' is unsound (";
  EXPECT_EQ(error_after(set_attribute("/lgiw", "Dimension", int64_t(4)), true),
            head + "Dimension is 0 instead of 2 or 3)" + again);
  EXPECT_EQ(error_after(set_attribute("/lgiw", "DomainHigh", std::vector<double>{10, -5, 4}), true),
            head +
                "DomainLow (0.000000, 0.000000, 0.000000) is not below DomainHigh (10.000000, -5.000000, 4.000000))" +
                again);
  EXPECT_EQ(error_after(set_attribute("/lgiw", "StillWaterLevel", double(NAN)), true),
            head + "there is water but no StillWaterLevel)" + again);
  EXPECT_EQ(error_after(set_attribute("/lgiw", "Sides", std::vector<int64_t>{0, 0, 0, 7}), true),
            "/lgiw@Sides of 'FILE' is unsound (7.000000 is not 0 (wall), 1 (absorbing) or 2 (open))" + again);
  EXPECT_EQ(error_after(set_attribute("/lgiw", "Counts", std::vector<double>{2.5, 1, 2}), true),
            "/lgiw@Counts of 'FILE' is unsound (2.500000 is not a count)" + again);
  EXPECT_EQ(error_after(set_attribute("/lgiw", "Origin", std::vector<double>{1, 2}), true),
            "/lgiw@Origin of 'FILE' is unsound (it has 2 values instead of 3)" + again);
  EXPECT_EQ(error_after(set_attribute("/lgiw/bed", "dx", 0.0), true),
            "/lgiw/bed of 'FILE' is unsound (x0, y0 and dx must be finite and dx above 0)" + again);
  EXPECT_EQ(error_after(set_attribute("/lgiw", "ParticleSpacing", "coarse"), true),
            "cannot read '/lgiw@ParticleSpacing' of 'FILE' (it is not a number) the file is damaged or of another "
            "kind, make it "
            "again");
}

TEST(MalformedParticles, EveryTruncationIsAnInputError) {
  const Scratch scratch;
  const std::string whole = scratch / "p.h5", cut = scratch / "cut.h5";
  write_small_particles(whole);
  const std::string bytes = bytes_of(whole);
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 40) {
    write_bytes(cut, bytes.substr(0, size));
    const std::string text = error_of<InputError>(cut, [&] { read_particles(cut); });
    ASSERT_EQ(text.rfind("cannot open 'FILE' (", 0), 0u) << size << ": " << text;
  }
  write_bytes(cut, bytes.substr(0, bytes.size() - 1));
  EXPECT_EQ(error_of<InputError>(cut, [&] { read_particles(cut); }),
            "cannot open 'FILE' (truncated file: eof = " + std::to_string(bytes.size() - 1) +
                ", sblock->base_addr = 0, stored_eof = " + std::to_string(bytes.size()) +
                ") the file is damaged or in use, make it again");
}

TEST(MalformedParticles, DamagedBytesAreReadOrRefusedButNeverCrash) {
  const LeaksOfHdf5 allowed;
  const Scratch scratch;
  const std::string whole = scratch / "p.h5", damaged = scratch / "damaged.h5";
  write_small_particles(whole);
  const std::string bytes = bytes_of(whole);
  std::mt19937 random(7);
  int refused = 0;
  for (int k = 0; k < 400; ++k) {
    std::string copy = bytes;
    for (int flips = 0; flips < 3; ++flips) copy[random() % copy.size()] = char(random());
    write_bytes(damaged, copy);
    try {
      const ParticleData data = read_particles(damaged);
      ASSERT_EQ(data.water.size(), 2u);
    } catch (const InputError& error) {
      ++refused;
      ASSERT_NE(std::string(error.what()).find(damaged), std::string::npos);
    }
  }
  EXPECT_GT(refused, 100);
}

/// Streams `n` particles in blocks of 20,000 and exits 0 when this took less than 24 MiB.
void stream_particles(const std::string& path, int64_t n) {
  const auto peak = [] {
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  const int64_t size = 20000;
  ParticleBlock block;
  block.points.assign(3 * size, 1.0);
  block.volume.assign(size, 0.125f);
  block.density.assign(size, 1000);
  block.pressure.assign(size, 0);
  ParticleHeader header = small_header();
  header.counts = {n, 0, 0, 0};
  const long before = peak();
  ParticleWriter writer(path, header);
  for (int64_t k = 0; k < n; k += size) writer.append(block);
  writer.finish();
  const long taken = peak() - before;
  fprintf(stderr, "%ld KiB for %ju bytes\n", taken, uintmax_t(std::filesystem::file_size(path)));
  exit(taken < 24 * 1024 && std::filesystem::file_size(path) > 70000000 ? 0 : 1);
}

TEST(ParticleFile, StreamsTwoMillionParticlesInLittleMemory) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer keeps freed memory";
#endif
  const Scratch scratch;
  EXPECT_EXIT(stream_particles(scratch / "p.h5", 2000000), testing::ExitedWithCode(0), "KiB for");
}

}  // namespace
}  // namespace lgiw
