// The quick runs of the benchmarks in pipelines/validation, through the tools, against the bars of their own.
#include <yaml-cpp/yaml.h>

#include "../tools/tool_runner.hh"

namespace lgiw::test {
namespace {

const fs::path benchmarks = fs::path(LGIW_SOURCE_DIR) / "pipelines/validation";

/// Names of the folders with a run of level quick.
std::vector<std::string> quick_cases() {
  std::vector<std::string> cases;
  for (const auto& entry : fs::directory_iterator(benchmarks)) {
    std::ifstream runs(entry.path() / "runs.txt");
    for (std::string line; std::getline(runs, line);) {
      std::istringstream words(line);
      std::string name, level;
      if (line[0] != '#' && words >> name >> level && level == "quick") cases.push_back(entry.path().filename());
    }
  }
  std::sort(cases.begin(), cases.end());
  return cases;
}

/// The quick run of a case: its name and the arguments of dem2particles.
std::pair<std::string, std::string> quick_run(const fs::path& folder) {
  std::ifstream runs(folder / "runs.txt");
  for (std::string line; std::getline(runs, line);) {
    std::istringstream words(line);
    std::string name, level, rest;
    if (line[0] == '#' || !(words >> name >> level) || level != "quick") continue;
    std::getline(words, rest);
    return {name, rest};
  }
  throw std::runtime_error("no quick run in " + folder.string());
}

class QuickBenchmark : public testing::TestWithParam<std::string> {};

TEST_P(QuickBenchmark, MeetsItsBars) {
  const fs::path folder = benchmarks / GetParam();
  const auto [name, arguments] = quick_run(folder);
  Workshop shop;
  fs::create_directory(shop / name);
  const auto tool = [&](const std::string& command) {
    const Outcome outcome = shop.run(command);
    ASSERT_EQ(outcome.status, 0) << command << "\n" << outcome.out << outcome.err;
  };
  tool("dem2particles '" + (folder / "case.yaml").string() + "'" + arguments + " -q -o " + name + "/particles.h5");
  tool("lgiw-run " + name + "/particles.h5 -q -o " + name + "/run.h5 --summary " + name + "/run.json");
  const YAML::Node scene = YAML::LoadFile(folder / "case.yaml");
  if (scene["gauges"]) tool("gauges " + name + "/run.h5 -q --long -o " + name + "/gauges.csv");
  if (scene["slide"]) tool("deposit-volume " + name + "/run.h5 -q -o " + name + "/slide.csv");
  const Outcome judged = shop.run("lgiw-validation check --quick --strict '" + folder.string() + "' .");
  std::printf("%s", judged.out.c_str());
  EXPECT_EQ(judged.status, 0) << judged.err;
}

std::string test_name(const testing::TestParamInfo<std::string>& test) {
  std::string name = test.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Validation, QuickBenchmark, testing::ValuesIn(quick_cases()), test_name);

}  // namespace
}  // namespace lgiw::test
