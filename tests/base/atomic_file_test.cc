#include "base/atomic_file.hh"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hh"

namespace fs = std::filesystem;

namespace lgiw {
namespace {

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void put(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

class AtomicFileTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "lgiw-atomic-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override {
    fs::permissions(folder, fs::perms::owner_all);
    fs::remove_all(folder);
  }
  std::string in_folder(const std::string& name) const { return folder + "/" + name; }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }
  template <class Error, class Action>
  std::string message_of(Action action) {
    try {
      action();
    } catch (const Error& e) {
      return e.what();
    }
    ADD_FAILURE() << "no error was thrown";
    return "";
  }
  std::string folder;
};

TEST_F(AtomicFileTest, CommitBringsTheFileUnderItsName) {
  AtomicFile file(in_folder("out.tif"), false);
  EXPECT_EQ(entries(), 0u) << "writers that refuse an existing file must find none";
  EXPECT_EQ(fs::path(file.temporary()).parent_path(), folder);
  EXPECT_EQ(fs::path(file.temporary()).extension(), ".tif");
  EXPECT_EQ(fs::path(file.temporary()).filename().string()[0], '.');
  put(file.temporary(), "heights");
  EXPECT_FALSE(fs::exists(in_folder("out.tif")));
  file.commit();
  EXPECT_EQ(content(in_folder("out.tif")), "heights");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(AtomicFileTest, WithoutCommitNothingIsLeft) {
  {
    AtomicFile file(in_folder("out.h5"), false);
    put(file.temporary(), "half a fi");
    EXPECT_EQ(entries(), 1u);
  }
  EXPECT_EQ(entries(), 0u);
}

TEST_F(AtomicFileTest, KilledProgramLeavesNoFileUnderTheName) {
  put(in_folder("out.h5"), "older");
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    AtomicFile file(in_folder("out.h5"), true);
    put(file.temporary(), "half a fi");
    kill(getpid(), SIGKILL);
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(content(in_folder("out.h5")), "older");
}

TEST_F(AtomicFileTest, ExistingFileIsRefusedWithoutOverwrite) {
  const std::string path = in_folder("out.h5");
  put(path, "older");
  EXPECT_EQ(message_of<InputError>([&] { AtomicFile file(path, false); }),
            path + " exists (it would be overwritten) pass -O/--overwrite or choose another name");
  EXPECT_EQ(content(path), "older");
  AtomicFile file(path, true);
  put(file.temporary(), "newer");
  EXPECT_EQ(content(path), "older");
  file.commit();
  EXPECT_EQ(content(path), "newer");
}

TEST_F(AtomicFileTest, FileThatAppearedMeanwhileIsKept) {
  const std::string path = in_folder("out.h5");
  AtomicFile file(path, false);
  put(file.temporary(), "mine");
  put(path, "another's");
  EXPECT_EQ(
      message_of<WorkError>([&] { file.commit(); }),
      path + " was not written (another program created it meanwhile) pass -O/--overwrite or choose another name");
  EXPECT_EQ(content(path), "another's");
}

TEST_F(AtomicFileTest, FailedCommitLeavesTheOlderFile) {
  const std::string path = in_folder("out.h5");
  put(path, "older");
  AtomicFile file(path, true);  // and nothing is written to file.temporary()
  EXPECT_EQ(message_of<WorkError>([&] { file.commit(); }),
            path + " was not written (No such file or directory) make room or mend the folder, then run again");
  EXPECT_EQ(content(path), "older");
}

TEST_F(AtomicFileTest, OutputMustBeAPlainFileInAnExistingFolder) {
  EXPECT_EQ(message_of<InputError>([&] { AtomicFile file(folder, true); }),
            folder + " is not a regular file (an output replaces what has its name) choose another name");
  EXPECT_EQ(message_of<InputError>([&] { AtomicFile file("/dev/null", true); }),
            "/dev/null is not a regular file (an output replaces what has its name) choose another name");
  EXPECT_EQ(message_of<InputError>([&] { AtomicFile file(in_folder("no/out.h5"), false); }),
            in_folder("no/out.h5") + " cannot be written (" + in_folder("no") +
                ": No such file or directory) create the folder or choose one that you may write to");
  EXPECT_EQ(message_of<InputError>([&] { AtomicFile file("", false); }),
            "the output has no name (a file cannot be written without one) name it with -o OUTPUT");
  EXPECT_EQ(entries(), 0u);
}

TEST_F(AtomicFileTest, ReadOnlyFolderIsRefusedBeforeAnyWork) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_EQ(message_of<InputError>([&] { AtomicFile file(in_folder("out.h5"), false); }),
            in_folder("out.h5") + " cannot be written (" + folder +
                ": Permission denied) create the folder or choose one that you may write to");
}

TEST_F(AtomicFileTest, WritesText) {
  write_text_file(in_folder("gauges.csv"), "t,z\n0,740\n", false);
  EXPECT_EQ(content(in_folder("gauges.csv")), "t,z\n0,740\n");
  EXPECT_THROW(write_text_file(in_folder("gauges.csv"), "", false), InputError);
  write_text_file(in_folder("gauges.csv"), "", true);
  EXPECT_EQ(content(in_folder("gauges.csv")), "");
  EXPECT_EQ(entries(), 1u);
  testing::internal::CaptureStdout();
  write_text_file("-", "to stdout\n", false);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "to stdout\n");
}

}  // namespace
}  // namespace lgiw
