// What `cmake --install` lays down: tools, manual pages that groff takes without a warning, and completion for bash.
#include <regex>
#include <set>

#include "tool_runner.hh"

namespace lgiw::test {
namespace {

const std::vector<std::string> tools = {"dem2particles",  "lgiw-run",     "gauges",
                                        "deposit-volume", "impulse-wave", "convergence"};

/// Long options that a text names.
std::set<std::string> long_options(const std::string& text) {
  const std::regex option("--[a-z][a-z-]*[a-z]");
  return {std::sregex_token_iterator(text.begin(), text.end(), option), std::sregex_token_iterator()};
}

class Installed : public testing::Test {
 protected:
  void SetUp() override {
    const Outcome outcome = shop.run("cmake --install '" LGIW_BUILD_DIR "' --prefix installed");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  fs::path tree(const std::string& name) const { return shop / ("installed/" + name); }

  /// What bash offers for a line that ends where the cursor is; `word` is the word before it.
  std::set<std::string> offered(const std::string& line) {
    write_bytes(shop / "complete.sh", R"(set -u
source installed/share/bash-completion/completions/"$1"
COMP_LINE=$*
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
_lgiw "$1" "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}"
[ ${#COMPREPLY[@]} -eq 0 ] || printf '%s\n' "${COMPREPLY[@]}"
)");
    const Outcome outcome = shop.run("bash complete.sh " + line);
    EXPECT_EQ(outcome.status, 0) << line;
    EXPECT_EQ(outcome.err, "") << line;
    std::set<std::string> words;
    std::istringstream lines(outcome.out);
    for (std::string word; std::getline(lines, word);) words.insert(word);
    return words;
  }
  Workshop shop;
};

using Words = std::set<std::string>;

TEST_F(Installed, HasToolsAndDocumentation) {
  for (const std::string& tool : tools) {
    EXPECT_EQ(shop.run("installed/bin/" + tool + " --version").status, 0) << tool;
    EXPECT_TRUE(fs::exists(tree("share/bash-completion/completions/" + tool))) << tool;
  }
  for (const char* name : {"README.md", "LICENSE", "docs/tutorial.md", "docs/cookbook.md", "docs/case-reference.yaml"})
    EXPECT_TRUE(fs::exists(tree("share/doc/lgiw") / name)) << name;
  EXPECT_FALSE(fs::exists(tree("bin/lgiw-validation")));
}

TEST_F(Installed, ManualPagesHaveEveryOptionAndRaiseNoWarning) {
#ifndef LGIW_MANUALS
  GTEST_SKIP() << "help2man is not installed";
#endif
  for (const std::string& tool : tools) {
    const std::string page = "installed/share/man/man1/" + tool + ".1";
    ASSERT_TRUE(fs::exists(shop / page)) << page;
    const Outcome checked = shop.run("env LC_ALL=C.UTF-8 MANWIDTH=100 man --warnings=w -P cat -l " + page);
    EXPECT_EQ(checked.status, 0) << page;
    EXPECT_EQ(checked.err, "") << page;
    for (const char* section : {"NAME", "SYNOPSIS", "OPTIONS", "EXIT STATUS", "FILES", "EXAMPLES", "SEE ALSO"})
      EXPECT_NE(checked.out.find(std::string("\n") + section + "\n"), std::string::npos) << tool << " " << section;
    const std::string help = shop.run(tool + " --help").out;
    // In the page every hyphen of an option is escaped, and fonts change around it.
    const std::string text = std::regex_replace(
        std::regex_replace(read_bytes(shop / page), std::regex(R"(\\f[A-Z])"), ""), std::regex(R"(\\-)"), "-");
    for (const std::string& option : long_options(help)) EXPECT_NE(text.find(option), std::string::npos) << option;
  }
}

TEST_F(Installed, CompletionOffersEveryOptionAndNothingElse) {
  for (const std::string& tool : tools) {
    Words longer;
    for (const std::string& word : offered(tool + " -"))
      if (word.rfind("--", 0) == 0) longer.insert(word);
    EXPECT_GT(longer.size(), 8u) << tool;
    const std::string help = shop.run(tool + " --help").out;
    // Options begin their lines; those in the texts are among them.
    EXPECT_EQ(longer, long_options(help)) << tool;
  }
  EXPECT_EQ(offered("lgiw-run run.h5 --th"), (Words{"--threads"}));
}

TEST_F(Installed, CompletionKnowsValuesAndKindsOfFiles) {
  for (const char* name : {"a.yaml", "b.yml", "run 1.h5", "run.csv", "sum.json", "map.tif"})
    write_bytes(shop / name, "");
  fs::create_directories(shop / "maps");
  fs::remove_all(shop / ".stdout");
  EXPECT_EQ(offered("lgiw-run p.h5 --backend ''"), (Words{"auto", "cpu", "cuda"}));
  EXPECT_EQ(offered("lgiw-run p.h5 --backend = cu"), (Words{"cuda"}));
  EXPECT_EQ(offered("lgiw-run p.h5 --threads ''"), Words{});
  EXPECT_EQ(offered("dem2particles ''"), (Words{"a.yaml", "b.yml", "installed", "maps"}));
  EXPECT_EQ(offered("lgiw-run r"), (Words{"run 1.h5"}));
  EXPECT_EQ(offered("gauges ru"), (Words{"run 1.h5"}));
  EXPECT_EQ(offered("gauges run.h5 --case ''"), (Words{"a.yaml", "b.yml", "installed", "maps"}));
  EXPECT_EQ(offered("gauges run.h5 --compare r"), (Words{"run.csv"}));
  EXPECT_EQ(offered("gauges run.h5 -o r"), (Words{"run.csv"}));
  EXPECT_EQ(offered("gauges run.h5 --summary s"), (Words{"sum.json"}));
  EXPECT_EQ(offered("gauges run.h5 --maps m"), (Words{"maps"}));
  EXPECT_EQ(offered("deposit-volume run.h5 --thickness m"), (Words{"map.tif", "maps"}));
  EXPECT_EQ(offered("convergence a.h5 ru"), (Words{"run 1.h5"}));
  EXPECT_EQ(offered("impulse-wave ru"), (Words{"run 1.h5"}));
}

}  // namespace
}  // namespace lgiw::test
