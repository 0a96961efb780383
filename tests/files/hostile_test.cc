// Files from a stranger: what leads out of a file is not followed. And files whose writer was stopped at any write.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstring>
#include <functional>

#include "base/provenance.hh"
#include "files/journaled_driver.hh"
#include "small_run.hh"
#include "support.hh"

namespace lgiw {
namespace {

using h5::File;

/// A particles file in which `spoil` has replaced the dataset /VTKHDF/PointData/Density, and what reading it says.
std::string refusal(const std::function<void(hid_t, const std::string&)>& spoil) {
  const Scratch scratch;
  const std::string path = scratch / "p.h5", other = scratch / "other.h5", dataset = "/VTKHDF/PointData/Density";
  write_small_particles(other);
  write_small_particles(path);
  {
    const h5::Handle file = raw_file(path, H5F_ACC_RDWR);
    H5Ldelete(file.id(), dataset.c_str(), H5P_DEFAULT);
    spoil(file.id(), other);
  }
  return error_of<InputError>(path, [&] { read_particles(path); });
}

/// A file whose /x leads to the same name in another, and whose /soft leads there. Made before h5::File is used for the
/// first time, which makes HDF5 forget such links.
const std::string linked_file = [] {
  H5dont_atexit();  // as h5::File has it, which comes too late for that
  const Scratch scratch;
  const std::string path = scratch / "a.h5";
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5Lcreate_external("b.h5", "/x", file, "/x", H5P_DEFAULT, H5P_DEFAULT);
  H5Lcreate_soft("/x", file, "/soft", H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(file);
  return bytes_of(path);
}();

TEST(HostileFile, AnExternalLinkIsNotFollowed) {
  const Scratch scratch;
  const std::string path = scratch / "a.h5";
  write_bytes(path, linked_file);
  File other = File::create(scratch / "b.h5");
  other.write("/x", std::vector<double>{1, 2});
  other.close();
  const File file = File::open_read(path);
  EXPECT_EQ(file.children("/"), (std::vector<std::string>{"soft", "x"}));
  for (const std::string name : {"/x", "/soft"}) {
    EXPECT_FALSE(file.exists(name));
    EXPECT_EQ(error_of<InputError>(path, [&] { file.read<double>(name); }),
              "cannot read '" + name +
                  "' of 'FILE' (there is no such dataset) the file is damaged or of another kind, "
                  "make it again");
  }
}

TEST(HostileFile, ValuesInAnotherFileAreNotRead) {
  const std::string dataset = "/VTKHDF/PointData/Density",
                    elsewhere = "cannot read '" + dataset +
                                "' of 'FILE' (its values lie in another file) the file is damaged or of another kind, "
                                "make it again";
  const hsize_t five = 5;
  // As raw bytes of any file whatever.
  EXPECT_EQ(refusal([&](hid_t file, const std::string&) {
              const h5::Handle list(H5Pcreate(H5P_DATASET_CREATE)), space(H5Screate_simple(1, &five, nullptr));
              H5Pset_external(list.id(), "/etc/passwd", 0, 20);
              const h5::Handle made(
                  H5Dcreate2(file, dataset.c_str(), H5T_NATIVE_FLOAT, space.id(), H5P_DEFAULT, list.id(), H5P_DEFAULT));
              ASSERT_TRUE(bool(made));
            }),
            elsewhere);
  // As a dataset of another HDF5 file.
  EXPECT_EQ(refusal([&](hid_t file, const std::string& other) {
              const h5::Handle list(H5Pcreate(H5P_DATASET_CREATE)), space(H5Screate_simple(1, &five, nullptr));
              H5Pset_virtual(list.id(), space.id(), other.c_str(), dataset.c_str(), space.id());
              const h5::Handle made(
                  H5Dcreate2(file, dataset.c_str(), H5T_NATIVE_FLOAT, space.id(), H5P_DEFAULT, list.id(), H5P_DEFAULT));
              ASSERT_TRUE(bool(made));
            }),
            elsewhere);
}

TEST(HostileFile, NoFilterIsLoadedFromElsewhere) {
  unsigned state = 1;
  {
    const Scratch scratch;
    File::create(scratch / "a.h5").close();
  }
  ASSERT_GE(H5PLget_loading_state(&state), 0);
  EXPECT_EQ(state, 0u);
}

/// A step of `small_run`, with a flush behind it.
void add_flushed_step(RunWriter& writer, int step) {
  if (step % 3 == 0) writer.add_frame(small_frame(step / 3));
  writer.add_surface(0.25 * step, small_map(step), small_map(-step), {100 + float(step), 200 - float(step)});
  writer.flush();
}

TEST(JournaledFile, AFileOfOneFlushIsNeverSeenHalf) {
  const Scratch scratch;
  const std::string path = scratch / "r.h5", journal = h5::journal_path(path);
  RunWriter writer(path, small_run());
  add_flushed_step(writer, 0);
  EXPECT_FALSE(std::filesystem::exists(journal));
  EXPECT_TRUE(h5::is_being_written(path));
  const std::string first = bytes_of(path);
  // Not flushed: metadata on the disk stay those of the flush.
  writer.add_surface(0.25, small_map(1), small_map(-1), {1, 2});
  writer.add_frame(small_frame(1));
  write_bytes(scratch / "copy.h5", bytes_of(path));
  EXPECT_EQ(RunReader(scratch / "copy.h5").surface_times().size(), 1u);
  EXPECT_EQ(RunReader(scratch / "copy.h5").frame_count(), 1u);
  EXPECT_NE(bytes_of(path), first) << "raw data are there";
  writer.flush();
  EXPECT_EQ(RunReader(path).frame_count(), 2u);
  writer.close();
  EXPECT_FALSE(std::filesystem::exists(journal));
}

TEST(JournaledFile, AWholeJournalIsCarriedOutAndHalfOneRemoved) {
  const Scratch scratch;
  const std::string path = scratch / "file", journal = h5::journal_path(path);
  const auto number = [](uint64_t n) { return std::string(reinterpret_cast<const char*>(&n), sizeof n); };
  std::string text =
      "lgiw journal 1\n" + number(12) + number(2) + number(2) + number(3) + "abc" + number(9) + number(3) + "xyz";
  text += sha256_of_text(text);
  const auto after = [&](const std::string& journal_bytes) {
    write_bytes(path, "0123456789");
    write_bytes(journal, journal_bytes);
    h5::carry_out_journal(path);
    EXPECT_FALSE(std::filesystem::exists(journal));
    return bytes_of(path);
  };
  EXPECT_EQ(after(text), "01abc5678xyz");
  for (std::size_t size = 0; size < text.size(); size += 5)
    EXPECT_EQ(after(text.substr(0, size)), "0123456789") << size;
  for (std::size_t at = 0; at < text.size(); at += 3) {
    std::string flipped = text;
    flipped[at] = char(flipped[at] ^ 4);
    EXPECT_EQ(after(flipped), "0123456789") << at;
  }
  // Two pieces of which one lies over the end of all numbers, so that it seems to end before the other.
  std::string wraps =
      "lgiw journal 1\n" + number(12) + number(2) + number(2) + number(3) + "abc" + number(-2ul) + number(6) + "uvwxyz";
  EXPECT_EQ(after(wraps + sha256_of_text(wraps)), "0123456789");
  h5::carry_out_journal(path);  // none there
  EXPECT_EQ(bytes_of(path), "0123456789");
}

TEST(JournaledFile, IsWrittenByOneProcessAlone) {
  const Scratch scratch;
  const std::string path = scratch / "r.h5";
  RunWriter writer(path, small_run());
  add_flushed_step(writer, 0);
  const pid_t child = fork();
  if (child == 0) {
    try {
      RunWriter another(path, small_run());
      _exit(0);
    } catch (const WorkError&) {
      _exit(h5::is_being_written(path) ? 7 : 8);
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 7);
  writer.close();
  EXPECT_EQ(RunReader(path).frame_count(), 1u);
  EXPECT_FALSE(h5::is_being_written(path));
}

}  // namespace
}  // namespace lgiw
