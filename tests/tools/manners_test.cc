// What all six tools have in common on the command line.
#include <regex>

#include "tool_runner.hh"

namespace lgiw::test {
namespace {

class EveryTool : public testing::TestWithParam<std::string> {
 protected:
  Workshop workshop_;
};

class ParallelTool : public EveryTool {};

class Manners : public testing::Test {
 protected:
  Workshop workshop_;
};

TEST_P(EveryTool, HelpGoesToStdoutAndEndsWithAnExample) {
  const Outcome help = workshop_.run(GetParam() + " --help");
  EXPECT_EQ(help.status, 0);
  EXPECT_EQ(help.err, "");
  EXPECT_NE(help.out.find("--output"), std::string::npos);
  EXPECT_NE(help.out.find("--overwrite"), std::string::npos);
  const std::size_t example = help.out.rfind("Example");
  ASSERT_NE(example, std::string::npos) << help.out;
  EXPECT_NE(help.out.find(GetParam(), example), std::string::npos) << help.out;
}

TEST_P(EveryTool, VersionNamesTheToolAndItsNumber) {
  const Outcome version = workshop_.run(GetParam() + " --version");
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.err, "");
  // A build on a machine without git, or not from a checkout, has no hash to tell.
  const std::regex first_line(GetParam() + R"( 0\.1\.0 \((git [0-9a-f]{7,}(-dirty)?|no git)\)\n)");
  EXPECT_TRUE(std::regex_search(version.out, first_line, std::regex_constants::match_continuous)) << version.out;
}

TEST_P(EveryTool, UnknownFlagIsRefusedInOneLine) {
  const Outcome outcome = workshop_.run(GetParam() + " input --frobnicate");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err.rfind(GetParam() + ": ", 0), 0u) << outcome.err;
  EXPECT_NE(outcome.err.find("--frobnicate"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
  EXPECT_TRUE(workshop_.contents().empty());
}

TEST_P(EveryTool, NoArgumentsAreRefused) {
  const Outcome outcome = workshop_.run(GetParam());
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("required"), std::string::npos) << outcome.err;
}

/// As OpenMP itself tells when it is loaded.
TEST_P(ParallelTool, ThreadsWaitBrieflyUnlessTheEnvironmentSaysHow) {
  const std::string call = "env -u GOMP_SPINCOUNT -u OMP_WAIT_POLICY OMP_DISPLAY_ENV=verbose ";
  const Outcome own = workshop_.run(call + GetParam() + " --version");
  EXPECT_EQ(own.status, 0);
  EXPECT_EQ(own.out.rfind(GetParam() + " ", 0), 0u) << own.out;
  const std::size_t last = own.err.rfind("GOMP_SPINCOUNT");
  ASSERT_NE(last, std::string::npos) << own.err;
  EXPECT_EQ(own.err.find("'1000'", last), last + std::string("GOMP_SPINCOUNT = ").size()) << own.err;
  const Outcome active = workshop_.run(call + "OMP_WAIT_POLICY=active " + GetParam() + " --version");
  EXPECT_EQ(active.err.find("'1000'"), std::string::npos) << active.err;
  EXPECT_EQ(active.err.find("GOMP_SPINCOUNT"), active.err.rfind("GOMP_SPINCOUNT")) << active.err;  // not started anew
}

/// A program started by one whose threads are bound has that one's core alone.
TEST_P(ParallelTool, BoundThreadsKeepTheirCores) {
  const std::string all = "env -u GOMP_SPINCOUNT -u OMP_WAIT_POLICY OMP_DISPLAY_ENV=verbose ";
  for (const char* binding : {"OMP_PROC_BIND=true", "OMP_PLACES=cores", "GOMP_CPU_AFFINITY=0-1"}) {
    const Outcome bound = workshop_.run(all + binding + " " + GetParam() + " --version");
    EXPECT_EQ(bound.status, 0);
    EXPECT_NE(bound.err.find("GOMP_SPINCOUNT"), std::string::npos) << bound.err;
    EXPECT_EQ(bound.err.find("GOMP_SPINCOUNT"), bound.err.rfind("GOMP_SPINCOUNT")) << binding << "\n" << bound.err;
  }
}

/// What top shows and killall looks for. The tool waits for its case: when that can be written, it has been started
/// anew.
TEST_F(Manners, AToolStartedAnewKeepsItsName) {
  const Outcome outcome = workshop_.run(
      "(mkfifo case.yaml; env -u GOMP_SPINCOUNT -u OMP_WAIT_POLICY dem2particles case.yaml -o p.h5 & "
      "timeout 60 sh -c 'exec 3> case.yaml; cat /proc/'$!'/comm; echo nonsense: 1 >&3'; wait $!)");
  EXPECT_EQ(outcome.out, "dem2particles\n");
  EXPECT_EQ(outcome.status, 2) << outcome.err;
}

std::string name_of(const testing::TestParamInfo<std::string>& tool) {
  std::string name = tool.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Tools, EveryTool,
                         testing::Values("dem2particles", "lgiw-run", "gauges", "deposit-volume", "impulse-wave",
                                         "convergence"),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Tools, ParallelTool, testing::Values("dem2particles", "lgiw-run", "gauges", "deposit-volume"),
                         name_of);

}  // namespace
}  // namespace lgiw::test
