#include "base/tool_main.hh"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <new>
#include <stdexcept>

#include "base/error.hh"

namespace lgiw {
namespace {

struct Outcome {
  int status;
  std::string out, err;
};

class ToolMain : public testing::Test {
 protected:
  Outcome call(std::vector<std::string> words, const std::function<int()>& run) {
    words.insert(words.begin(), "gauges");
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    CLI::App app("Wave gauges", "gauges");
    app.footer("Example:\n  gauges run.h5 -o gauges.csv");
    add_common_options(app, options, "HDF5 1.10.8");
    app.add_option("INPUT", input, "Run file")->required();
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int status = tool_main(app, static_cast<int>(argv.size()), argv.data(), run);
    const std::string err = testing::internal::GetCapturedStderr();
    return {status, testing::internal::GetCapturedStdout(), err};
  }
  CommonOptions options;
  std::string input;
};

TEST_F(ToolMain, PassesTheStatusOnAndIsQuiet) {
  bool ran = false;
  const Outcome done = call({"run.h5"}, [&] { return ran = true, 0; });
  EXPECT_TRUE(ran);
  EXPECT_EQ(done.status, 0);
  EXPECT_EQ(done.out + done.err, "");
  EXPECT_EQ(call({"run.h5"}, [] { return 130; }).status, 130);
}

TEST_F(ToolMain, ErrorsAreOneLineWithTheirStatus) {
  const Outcome input_error = call({"run.h5"}, []() -> int {
    throw InputError("run.h5 is no HDF5 file", "HDF5 says:\n  #000: H5F.c\r\n\tfile signature not found", "check it\n");
  });
  EXPECT_EQ(input_error.status, 2);
  EXPECT_EQ(input_error.err,
            "gauges: run.h5 is no HDF5 file (HDF5 says: #000: H5F.c file signature not found) check it\n");
  EXPECT_EQ(input_error.out, "");

  const Outcome work_error =
      call({"run.h5"}, []() -> int { throw WorkError("g.csv was not written", "disk full", "make room"); });
  EXPECT_EQ(work_error.status, 1);
  EXPECT_EQ(work_error.err, "gauges: g.csv was not written (disk full) make room\n");

  const Outcome backend_error =
      call({"run.h5"}, []() -> int { throw BackendError("no CUDA device (no driver) use --backend cpu"); });
  EXPECT_EQ(backend_error.status, 3);
  EXPECT_EQ(backend_error.err, "gauges: no CUDA device (no driver) use --backend cpu\n");

  const Outcome memory = call({"run.h5"}, []() -> int { throw std::bad_alloc(); });
  EXPECT_EQ(memory.status, 1);
  EXPECT_EQ(memory.err,
            "gauges: out of memory (the machine has less than the case needs) take a larger particle spacing\n");

  const Outcome other = call({"run.h5"}, []() -> int { throw std::logic_error("bug"); });
  EXPECT_EQ(other.status, 1);
  EXPECT_EQ(other.err, "gauges: bug\n");
}

TEST_F(ToolMain, WrongCallsAreRefusedBeforeAnyWork) {
  bool ran = false;
  const Outcome unknown = call({"run.h5", "--overwrit"}, [&] { return ran = true, 0; });
  EXPECT_EQ(unknown.status, 2);
  EXPECT_EQ(
      unknown.err,
      "gauges: The following argument was not expected: --overwrit (the command line is not understood) try gauges "
      "--help\n");
  const Outcome missing = call({}, [&] { return ran = true, 0; });
  EXPECT_EQ(missing.status, 2);
  EXPECT_EQ(missing.err, "gauges: INPUT is required (the command line is not understood) try gauges --help\n");
  EXPECT_FALSE(ran);
}

TEST_F(ToolMain, HelpEndsWithTheExampleAndVersionNamesTheLibraries) {
  const Outcome help = call({"--help"}, [] { return 7; });
  EXPECT_EQ(help.status, 0);
  EXPECT_EQ(help.err, "");
  const std::string example = "Example:\n  gauges run.h5 -o gauges.csv\n";
  ASSERT_GE(help.out.size(), example.size());
  EXPECT_EQ(help.out.substr(help.out.size() - example.size()), example);
  EXPECT_NE(help.out.find("Common options:"), std::string::npos);
  const Outcome version = call({"--version"}, [] { return 7; });
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out, "gauges " + version_string() + "\nHDF5 1.10.8\n");
}

TEST_F(ToolMain, CommonOptionsAreRead) {
  EXPECT_EQ(
      call({"-O", "-q", "-v", "-v", "--progress", "--no-provenance", "--json", "run.h5"}, [] { return 0; }).status, 0);
  EXPECT_TRUE(options.overwrite);
  EXPECT_TRUE(options.quiet);
  EXPECT_EQ(options.verbose, 2);
  EXPECT_TRUE(options.progress);
  EXPECT_FALSE(options.provenance);
  EXPECT_TRUE(options.json);
  EXPECT_FALSE(options.show_progress()) << "quiet wins";
  options.quiet = false;
  EXPECT_TRUE(options.show_progress());
  EXPECT_EQ(input, "run.h5");
}

TEST_F(ToolMain, OutputThatDoesNotArriveFails) {
  const Outcome closed = call({"run.h5"}, [] {
    std::cout.setstate(std::ios::badbit);
    return 0;
  });
  std::cout.clear();
  EXPECT_EQ(closed.status, 1);
  EXPECT_EQ(closed.err,
            "gauges: stdout was not written (the pipe or disk behind it took no more) make room, then run again\n");
}

TEST(CommandLine, IsQuotedForTheShell) {
  std::vector<std::string> words{"lgiw-run", "case 1.yaml", "--set", "name=it's", "", "-o", "out/run.h5"};
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  EXPECT_EQ(command_line(static_cast<int>(argv.size()), argv.data()),
            R"(lgiw-run 'case 1.yaml' --set 'name=it'\''s' '' -o out/run.h5)");
}

TEST(ProgressTest, Durations) {
  EXPECT_EQ(format_duration(0.4), "0 s");
  EXPECT_EQ(format_duration(59.4), "59 s");
  EXPECT_EQ(format_duration(59.6), "1 min 00 s");
  EXPECT_EQ(format_duration(185), "3 min 05 s");
  EXPECT_EQ(format_duration(7620), "2 h 07 min");
  EXPECT_EQ(format_duration(273600), "3 d 04 h");
  EXPECT_EQ(format_duration(HUGE_VAL), "unknown");
}

TEST(ProgressTest, Lines) {
  EXPECT_EQ(progress_line("step", 0, 0, ""), "step  0 %");
  EXPECT_EQ(progress_line("step", 0.25, 60, "dt 4 ms"), "step  25 %  ETA 3 min 00 s  dt 4 ms");
  EXPECT_EQ(progress_line("step", 0.005, 60, ""), "step  0 %") << "too early for an estimate";
  EXPECT_EQ(progress_line("step", 1, 250, ""), "step  100 %  done in 4 min 10 s");
  EXPECT_EQ(progress_line("step", 1.2, 250, ""), "step  100 %  done in 4 min 10 s");
}

TEST(ProgressTest, OneLinePerTenthAwayFromATerminal) {
  testing::internal::CaptureStderr();
  {
    Progress progress(true, "step");
    for (int i = 0; i <= 1000; ++i) progress.update(i / 1000.0);
    progress.update(1);
  }
  const std::string err = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 11);
  EXPECT_EQ(err.substr(0, 21), "step  0 %\nstep  10 %\n");
  EXPECT_NE(err.find("step  100 %  done in 0 s\n"), std::string::npos);

  testing::internal::CaptureStderr();
  {
    Progress progress(false, "step");
    for (int i = 0; i <= 10; ++i) progress.update(i / 10.0);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace lgiw
