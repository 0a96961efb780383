#include "files/h5.hh"

#include <sys/resource.h>

#include <csignal>
#include <numeric>

#include "support.hh"

namespace lgiw {
namespace {

using h5::File;
using h5::Shape;

TEST(H5, KeepsNumbersShapesAndAttributes) {
  const Scratch scratch;
  const std::string path = scratch / "a.h5";
  const std::string long_text(100000, 'x');  // more than an object header holds
  {
    File file = File::create(path);
    const double numbers[6] = {1, 2, 3, 4, 5, 6.5};
    file.write("/a/b/numbers", numbers, {2, 3});
    file.write("/bytes", std::vector<uint8_t>{7, 255});
    file.write("/empty", std::vector<int64_t>{});
    file.set_attribute("/a", "text", "abc");
    file.set_attribute("/a", "text", "longer text");
    file.set_attribute("/a", "nothing", "");
    file.set_attribute("/a", "long", long_text);
    file.set_attribute("/a", "umlaut", "Gro\xC3\x9F");
    file.set_attribute("/a/b/numbers", "x", 2.5);
    file.set_attribute("/", "n", int64_t(1) << 40);
    file.set_attribute("/", "list", std::vector<int64_t>{2, 0});
    file.set_attribute("/", "list", std::vector<double>{0.5, 1, 2});
    file.close();
  }
  const File file = File::open_read(path);
  Shape shape;
  EXPECT_EQ(file.read<double>("/a/b/numbers", &shape), (std::vector<double>{1, 2, 3, 4, 5, 6.5}));
  EXPECT_EQ(shape, (Shape{2, 3}));
  EXPECT_EQ(file.read<float>("/bytes"), (std::vector<float>{7, 255}));
  EXPECT_EQ(file.shape("/empty"), (Shape{0}));
  EXPECT_TRUE(file.read<int64_t>("/empty").empty());
  EXPECT_EQ(file.text_attribute("/a", "text"), "longer text");
  EXPECT_EQ(file.text_attribute("/a", "nothing"), "");
  EXPECT_EQ(file.text_attribute("/a", "long"), long_text);
  EXPECT_EQ(file.text_attribute("/a", "umlaut"), "Gro\xC3\x9F");
  EXPECT_EQ(file.number_attribute("/a/b/numbers", "x"), 2.5);
  EXPECT_EQ(file.number_attribute("/", "n"), double(int64_t(1) << 40));
  EXPECT_EQ(file.numbers_attribute("/", "list"), (std::vector<double>{0.5, 1, 2}));
  EXPECT_TRUE(file.exists("/a/b/numbers"));
  EXPECT_FALSE(file.exists("/a/c/numbers"));
  EXPECT_TRUE(file.has_attribute("/", "n"));
  EXPECT_FALSE(file.has_attribute("/", "m"));
  EXPECT_FALSE(file.has_attribute("/c", "m"));
  EXPECT_EQ(file.children("/"), (std::vector<std::string>{"a", "bytes", "empty"}));
}

TEST(H5, WritesAndReadsParts) {
  const Scratch scratch;
  const std::string path = scratch / "a.h5";
  File file = File::create(path);
  file.create_dataset<float>("/fixed", {4, 2}, false, true);
  const float rows[4] = {1, 2, 3, 4};
  file.write_slab("/fixed", rows, {2, 0}, {2, 2});
  file.create_dataset<int32_t>("/grown", {0, 3}, true, true, {2, 3});
  std::vector<int32_t> values(15);
  std::iota(values.begin(), values.end(), 0);
  file.append("/grown", values.data(), {1, 3});
  file.append("/grown", values.data() + 3, {4, 3});
  EXPECT_EQ(file.read<float>("/fixed"), (std::vector<float>{0, 0, 0, 0, 1, 2, 3, 4}));
  EXPECT_EQ(file.read<int32_t>("/grown"), values);
  EXPECT_LT(file.chunk_address("/grown", {1, 2}), file.chunk_address("/grown", {2, 0}));
  std::vector<int32_t> column(5);
  file.read_slab("/grown", column.data(), {0, 1}, {5, 1});
  EXPECT_EQ(column, (std::vector<int32_t>{1, 4, 7, 10, 13}));
  file.close();

  File again = File::open_write(path);
  again.append("/grown", values.data(), {1, 3});
  again.close();
  EXPECT_EQ(File::open_read(path).shape("/grown"), (Shape{6, 3}));
}

TEST(H5, NamesFileObjectAndReasonOfReadingErrors) {
  const Scratch scratch;
  const std::string path = scratch / "a.h5";
  const auto open_error = [&] { return error_of<InputError>(path, [&] { File::open_read(path); }); };
  EXPECT_EQ(open_error(), "cannot open 'FILE' (No such file or directory) see that the name is right");
  write_bytes(path, "particles: 3\n");
  EXPECT_EQ(open_error(), "cannot open 'FILE' (it is not an HDF5 file) see that the name is right");
  write_bytes(path, "");
  EXPECT_EQ(open_error(), "cannot open 'FILE' (it is not an HDF5 file) see that the name is right");
  EXPECT_EQ(error_of<InputError>("-", [&] { File::open_read("-"); }),
            "cannot open 'FILE' (HDF5 needs a seekable file) give a file's name");
  EXPECT_EQ(error_of<InputError>("/dev/null", [&] { File::open_read("/dev/null"); }),
            "cannot open 'FILE' (it is not a regular file) HDF5 needs a seekable file");

  File made = File::create(path);
  made.write("/x", std::vector<double>{1, 2, 3});
  made.set_attribute("/x", "text", "abc");
  made.set_attribute("/x", "list", std::vector<double>{1, 2});
  made.close();
  const File file = File::open_read(path);
  const auto error = [&](auto work) { return error_of<InputError>(path, [&] { work(); }); };
  const std::string end = " the file is damaged or of another kind, make it again";
  EXPECT_EQ(error([&] { file.read<double>("/y"); }), "cannot read '/y' of 'FILE' (there is no such dataset)" + end);
  EXPECT_EQ(error([&] { file.number_attribute("/x", "text"); }),
            "cannot read '/x@text' of 'FILE' (it is not a number)" + end);
  EXPECT_EQ(error([&] { file.text_attribute("/x", "list"); }),
            "cannot read '/x@list' of 'FILE' (it is not a text)" + end);
  EXPECT_EQ(error([&] { file.number_attribute("/x", "list"); }),
            "cannot read '/x@list' of 'FILE' (it has 2 values instead of 1)" + end);
  EXPECT_EQ(error([&] { file.number_attribute("/x", "z"); }),
            "cannot read '/x@z' of 'FILE' (there is no such attribute)" + end);
  double four[4];
  EXPECT_EQ(error([&] { file.read_slab("/x", four, {0}, {4}); }),
            "cannot read '/x' of 'FILE' (its size is [3], too little for [0]+[4])" + end);
  EXPECT_EQ(error([&] { file.children("/nowhere"); }),
            "cannot read '/nowhere' of 'FILE' (there is no such group)" + end);
}

TEST(H5, RefusesToAllocateWhatTheFileDoesNotHold) {
  const Scratch scratch;
  const std::string path = scratch / "a.h5";
  File made = File::create(path);
  made.create_dataset<double>("/plain", {1000000000000, 3}, true, false, {1024, 3});
  made.create_dataset<double>("/packed", {1000000000000}, true, true, {1024});
  made.create_dataset<double>("/overflow", {hsize_t(1) << 40, hsize_t(1) << 40}, true, true, {16, 16});
  made.close();
  const File file = File::open_read(path);
  const std::string end = " is more than the 0 bytes stored) the file is damaged or of another kind, make it again";
  const auto error = [&](const std::string& name) {
    return error_of<InputError>(path, [&] { file.read<double>(name); });
  };
  EXPECT_EQ(error("/plain"), "cannot read '/plain' of 'FILE' (its size [1000000000000,3]" + end);
  EXPECT_EQ(error("/packed"), "cannot read '/packed' of 'FILE' (its size [1000000000000]" + end);
  EXPECT_EQ(error("/overflow"), "cannot read '/overflow' of 'FILE' (its size [1099511627776,1099511627776]" + end);
}

TEST(H5, ReadsTextsOfVariableLength) {
  const Scratch scratch;
  const std::string path = scratch / "a.h5";
  File::create(path).close();
  {
    const h5::Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
    const h5::Handle type(H5Tcopy(H5T_C_S1)), space(H5Screate(H5S_SCALAR));
    H5Tset_size(type.id(), H5T_VARIABLE);
    const h5::Handle attribute(H5Acreate2(file.id(), "text", type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT));
    const char* text = "from elsewhere";
    ASSERT_GE(H5Awrite(attribute.id(), type.id(), &text), 0);
  }
  EXPECT_EQ(File::open_read(path).text_attribute("/", "text"), "from elsewhere");
}

TEST(H5, WritingErrorsAreWorkErrors) {
  const Scratch scratch;
  const std::string path = scratch / "nowhere/a.h5";
  EXPECT_EQ(
      error_of<WorkError>(path, [&] { File::create(path); }),
      "cannot write 'FILE' (No such file or directory) see that the disk has room and that the folder can be written");
  const std::string good = scratch / "a.h5";
  File file = File::create(good);
  file.create_dataset<double>("/x", {2});
  const double three[3] = {1, 2, 3};
  EXPECT_EQ(
      error_of<WorkError>(good, [&] { file.write_slab("/x", three, {0}, {3}); }),
      "cannot write '/x' of 'FILE' (slab [0]+[3] is not in [2]) see that the disk has room and that the folder can be "
      "written");
}

/// Writes until the limit on file sizes stops it; what a full disk does, on any machine.
void fill_the_disk(const std::string& path) {
  signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{300000, 300000};
  setrlimit(RLIMIT_FSIZE, &limit);
  const std::string text = error_of<WorkError>(path, [&] {
    File file = File::create(path);
    file.create_dataset<double>("/x", {0}, true, false, {1000});
    const std::vector<double> block(1000, 1.0);
    for (int k = 0; k < 100; ++k) file.append("/x", block.data(), {1000});
    file.close();
  });
  const std::string expected =
      "cannot write '/x' of 'FILE' (File too large) see that the disk has room and that the folder can be written";
  if (text != expected) {
    fprintf(stderr, "%s\n", text.c_str());
    exit(1);
  }
  fprintf(stderr, "refused");
  exit(0);
}

TEST(H5, FullDiskIsOneLineAndNothingElse) {
  const Scratch scratch;
  EXPECT_EXIT(fill_the_disk(scratch / "a.h5"), testing::ExitedWithCode(0), "^refused$");
}

TEST(H5, LayoutDoesNotDependOnFlushesOrTheClock) {
  const Scratch scratch;
  const auto write = [&](const std::string& path, int flush_every) {
    File file = File::create(path);
    file.create_dataset<double>("/a", {0}, true, false, {64});
    file.create_dataset<float>("/b", {0, 16, 16}, true, true, {1, 8, 8});
    std::vector<float> map(256);
    for (int k = 0; k < 300; ++k) {
      const double value = 0.5 * k;
      std::iota(map.begin(), map.end(), float(k));
      file.append("/a", &value, {1});
      file.append("/b", map.data(), {1, 16, 16});
      file.set_attribute("/a", "count", int64_t(k));
      if (k % flush_every == 0) file.flush();
    }
    file.set_attribute("/", "end", "done");
    file.close();
  };
  write(scratch / "one.h5", 1000);
  write(scratch / "two.h5", 7);
  write(scratch / "three.h5", 1);
  EXPECT_EQ(bytes_of(scratch / "one.h5").compare(bytes_of(scratch / "two.h5")), 0);
  EXPECT_EQ(bytes_of(scratch / "one.h5").compare(bytes_of(scratch / "three.h5")), 0);
}

}  // namespace
}  // namespace lgiw
