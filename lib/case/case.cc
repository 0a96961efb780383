#include "case/case.hh"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numeric>
#include <utility>

#include "case/dotted_key.hh"

namespace lgiw {

std::string Case::folder() const {
  const std::string parent = std::filesystem::path(path).parent_path().string();
  return parent.empty() ? "." : parent;
}

std::string Case::resolve(const std::string& file) const {
  if (file.empty() || std::filesystem::path(file).is_absolute() || folder() == ".") return file;
  return (std::filesystem::path(folder()) / file).string();
}

std::string Case::where(const std::string& key) const { return nearest_place(places, key); }

std::string nearest_place(const std::map<std::string, std::string>& places, std::string key) {
  while (true) {
    if (const auto found = places.find(key); found != places.end()) return found->second;
    if (key.empty()) return "";
    const std::size_t dot = key.rfind('.');
    key = dot == std::string::npos ? "" : key.substr(0, dot);
  }
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& words) {
  const auto distance = [&word](const std::string& other) {
    std::vector<std::size_t> row(other.size() + 1);
    std::iota(row.begin(), row.end(), 0);
    for (std::size_t i = 0; i < word.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i + 1;
      for (std::size_t j = 0; j < other.size(); ++j) {
        const std::size_t substituted = diagonal + (word[i] != other[j]);
        diagonal = row[j + 1];
        row[j + 1] = std::min({substituted, row[j + 1] + 1, row[j] + 1});
      }
    }
    return row.back();
  };
  std::string nearest;
  std::size_t least = std::string::npos;
  for (const std::string& other : words)
    if (const std::size_t d = distance(other); d < least) least = d, nearest = other;
  return nearest;
}

std::string number_text(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

std::vector<std::string> case_warnings(const Case& c) {
  std::vector<std::string> warnings;
  const auto warn = [&](const std::string& key, const std::string& problem, const std::string& why,
                        const std::string& suggestion) {
    warnings.push_back(c.where(key) + ": " + problem + " (" + why + ") " + suggestion);
  };
  const auto given = [&](const std::string& key) { return c.places.count(key) > 0; };

  if (!c.has_soil() && given("soil"))
    warn("soil", "soil has no effect", "there is no slide", "add slide or leave soil out");
  if (!(c.has_soil() && c.water.present) && given("interface"))
    warn("interface", "interface has no effect", "it needs both water and slide", "leave interface out");
  if (c.slide.present && c.soil.bed != WallFriction::coulomb && c.soil.sides != WallFriction::coulomb &&
      c.soil.bed_friction_angle > 0)
    warn("soil.bed_friction_angle", "soil.bed_friction_angle has no effect", "no wall is coulomb",
         "set soil.bed: coulomb");
  // Metres of soil with a few pascals of cohesion: laboratory values come with laboratory spacings.
  if (c.slide.present && c.dp >= 1 && c.soil.cohesion > 0 && c.soil.cohesion < 1000)
    warn("soil.cohesion", "soil.cohesion is " + number_text(c.soil.cohesion) + " Pa",
         "little for particles of " + number_text(c.dp) + " m; it looks like kPa",
         "write " + number_text(1000 * c.soil.cohesion) + " if it is");
  if (c.numerics.kernel == KernelName::cubic && c.numerics.h_over_dp > 1.3 && c.numerics.scheme != "huang2023")
    warn("numerics.kernel", "the cubic kernel pairs particles at h/dp " + number_text(c.numerics.h_over_dp),
         "the pressure becomes noisy", "set numerics.h_over_dp: 1.2");
  if (c.output.map_spacing > 0 && c.output.map_spacing < 0.5 * c.dp)
    warn("output.map_spacing", "output.map_spacing is finer than half a particle", "it resolves nothing more",
         "set it to particle_spacing or leave it out");
  if (c.water.present && c.output.arrival_threshold > 0 && c.output.arrival_threshold < 0.1 * c.dp)
    warn("output.arrival_threshold", "output.arrival_threshold is below a tenth of a particle",
         "a lake at rest already moves as much", "set it to a quarter of particle_spacing or more");
  for (std::size_t i = 0; i < c.gauges.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (c.gauges[i].quantity == GaugeQuantity::surface && c.gauges[j].quantity == GaugeQuantity::surface &&
          std::hypot(c.gauges[i].x - c.gauges[j].x, c.gauges[i].y - c.gauges[j].y) < c.dp)
        warn("gauges." + std::to_string(i),
             "gauge " + c.gauges[i].name + " is less than a particle from " + c.gauges[j].name,
             "they measure the same column", "move one of them");
  return warnings;
}

namespace {

/// Calls `f` for every file that the case may name, empty where it does not.
template <class AnyCase, class F>
void for_each_file(AnyCase& c, const F& f) {
  for (auto& source : c.terrain.sources) f(source.file);
  auto& surface = c.slide.surface;
  f(c.slide.polygon_file), f(surface.before), f(surface.after), f(surface.thickness), f(surface.failure_surface);
  if (c.slide.motion) f(c.slide.motion->file);
  for (auto& body : c.bodies) f(body.motion);
}

}  // namespace

std::vector<std::string> files_of(const Case& c) {
  std::vector<std::string> files;
  for_each_file(c, [&](const std::string& file) {
    if (!file.empty()) files.push_back(file);
  });
  return files;
}

std::string differing_geometry(const Case& a, const Case& b) {
  const auto bare = [](Case c) {
    c.terrain.vertical_datum.clear();
    for (TerrainSource& source : c.terrain.sources) source.attribution.clear();
    for_each_file(c, [](std::string& file) { file = std::filesystem::path(file).filename().string(); });
    return c;
  };
  const Case p = bare(a), q = bare(b);
  const std::pair<bool, const char*> same[] = {
      {p.dimension == q.dimension, "dimension"},
      {p.dp == q.dp, "particle_spacing"},
      {p.gravity == q.gravity, "gravity"},
      {p.terrain == q.terrain, "terrain"},
      {p.water.present == q.water.present, "water"},
      {p.water.level == q.water.level, "water.level"},
      {p.water.seed == q.water.seed, "water.seed"},
      {p.water.density == q.water.density, "water.density"},
      {p.water.bodies == q.water.bodies, "water.bodies"},
      {p.water.wave == q.water.wave, "water.wave"},
      {p.slide == q.slide, "slide"},
      // In the vertical stress that the soil starts with.
      {!p.has_soil() || p.soil.density == q.soil.density, "soil.density"},
      {p.bodies == q.bodies, "bodies"}};
  for (const auto& [agree, key] : same)
    if (!agree) return key;
  return "";
}

}  // namespace lgiw
