#include "case/attribution.hh"

#include <algorithm>
#include <vector>

namespace lgiw {

std::string terrain_attribution(const Terrain& terrain) {
  std::vector<std::string> names;
  for (const TerrainSource& source : terrain.sources)
    if (!source.attribution.empty() && std::find(names.begin(), names.end(), source.attribution) == names.end())
      names.push_back(source.attribution);
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : "; ") + name;
  return all;
}

}  // namespace lgiw
