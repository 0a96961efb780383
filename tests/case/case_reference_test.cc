// docs/case-reference.yaml: sound, complete, and true about the defaults.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "case/case.hh"
#include "case_summary.hh"

namespace lgiw {
namespace {

const std::string reference_path = LGIW_SOURCE_DIR "/docs/case-reference.yaml";

std::vector<std::string> reference_lines() {
  std::ifstream file(reference_path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

/// Dotted keys of `node`, without list numbers.
void collect(const YAML::Node& node, const std::string& prefix, std::set<std::string>& keys) {
  if (node.IsMap())
    for (const auto& entry : node) {
      const std::string key = prefix + entry.first.Scalar();
      keys.insert(key);
      collect(entry.second, key + ".", keys);
    }
  if (node.IsSequence())
    for (const YAML::Node& item : node) collect(item, prefix, keys);
}

TEST(CaseReference, IsAValidCase) {
  const Case c = read_case(reference_path);
  EXPECT_EQ(c.name, "reference");
  EXPECT_EQ(c.folder(), LGIW_SOURCE_DIR "/docs");
  EXPECT_EQ(c.resolve(c.terrain.sources[0].file), LGIW_SOURCE_DIR "/docs/valley.tif");
  EXPECT_TRUE(case_warnings(c).empty());
}

TEST(CaseReference, HoldsExactlyTheKeysThatTheReaderKnows) {
  std::string all;
  for (const std::string& line : reference_lines())
    all += std::regex_replace(line, std::regex("^( *)#: "), "$1") + "\n";
  std::set<std::string> documented;
  collect(YAML::Load(all), "", documented);
  const std::vector<std::string> known = known_case_keys();
  EXPECT_EQ(documented, std::set<std::string>(known.begin(), known.end()));
  EXPECT_GT(known.size(), 90u);
}

TEST(CaseReference, EveryKeyIsExplained) {
  for (const std::string& line : reference_lines()) {
    std::smatch match;
    // Section headings explain themselves by what stands below them.
    if (std::regex_match(line, match, std::regex("^ *(?:#: |- )?([a-z_]+): [^#]*$")))
      ADD_FAILURE() << "no comment behind: " << line;
  }
}

TEST(CaseReference, ValuesShownAreTheDefaults) {
  const Case whole = read_case(reference_path);
  // What has no default is marked as an example.
  std::set<std::string> examples;
  for (const auto& [key, place] : whole.places) {
    const std::size_t line = std::stoul(place.substr(place.rfind(':') + 1));
    if (reference_lines()[line - 1].find("ex.") != std::string::npos) examples.insert(key);
  }
  const auto is_example = [&](const std::string& key) {
    for (std::string k = key; !k.empty(); k = k.rfind('.') == std::string::npos ? "" : k.substr(0, k.rfind('.')))
      if (examples.count(k)) return true;
    return false;
  };
  const std::set<std::string> headings{"",         "terrain",   "water",           "slide",
                                       "gauges",   "sections",  "terrain.sources", "terrain.sources.0",
                                       "gauges.0", "sections.0"};
  int defaults = 0;
  for (const auto& [key, place] : whole.places) {
    if (headings.count(key) || is_example(key) || key.rfind("gravity.", 0) == 0) continue;
    const Case without = read_case(reference_path, {key + "=null"});
    EXPECT_EQ(case_summary(without), case_summary(whole)) << key;
    ++defaults;
  }
  EXPECT_GT(defaults, 50);
}

TEST(CaseReference, StatesTheDefaultsOfTheSchemeOfHuang2023) {
  const Case scheme = read_case(reference_path, {"soil=null", "interface=null", "numerics={scheme: huang2023}",
                                                 "water.density_diffusion=null", "water.viscosity_alpha=null", "water.walls=null"});
  const Case stated =
      read_case(reference_path, {"numerics.scheme=huang2023", "numerics.kernel=cubic", "numerics.h_over_dp=1.5",
                                 "numerics.integrator=verlet", "numerics.cfl=0.2", "numerics.constitutive=rate_form",
                                 "numerics.wall_viscosity=false", "water.walls=no_slip", "soil.viscosity_alpha=0.1",
                                 "soil.stress_diffusion=0", "soil.artificial_stress=0.5", "soil.pore_pressure=none",
                                 "interface.repulsion=true", "interface.velocity_factor=2", "water.density_diffusion=0",
                                 "water.viscosity_alpha=0.05"});
  EXPECT_EQ(case_summary(scheme), case_summary(stated));
  // Each of them is stated where the key is explained.
  std::string text;
  for (const std::string& line : reference_lines()) text += line + "\n";
  for (const char* note : {"(huang2023: cubic)", "(huang2023: 1.5)", "(huang2023: verlet)", "(huang2023: 0.2)",
                           "(huang2023: rate_form)", "(huang2023: false)", "(huang2023: 0.1)", "(huang2023: 0)",
                           "(huang2023: 0.5,", "(huang2023: none)", "(huang2023: 2)", "(huang2023: no_slip)"})
    EXPECT_NE(text.find(note), std::string::npos) << note;
}

}  // namespace
}  // namespace lgiw
