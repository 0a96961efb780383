#include "case/attribution.hh"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <vector>

namespace lgiw {

std::string terrain_attribution(const std::string& case_text) {
  const YAML::Node document = YAML::Load(case_text);
  if (!document.IsMap() || !document["terrain"].IsDefined() || !document["terrain"].IsMap()) return "";
  std::vector<std::string> names;
  for (const YAML::Node& source : document["terrain"]["sources"]) {
    const YAML::Node name = source["attribution"];
    if (name.IsDefined() && std::find(names.begin(), names.end(), name.Scalar()) == names.end())
      names.push_back(name.Scalar());
  }
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : "; ") + name;
  return all;
}

}  // namespace lgiw
