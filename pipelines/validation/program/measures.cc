#include "measures.hh"

#include "base/error.hh"

namespace lgiw::validation {

Keys::Keys(const YAML::Node& node, std::string folder, std::string where, std::string series)
    : node_(node), folder_(std::move(folder)), where_(std::move(where)), series_(std::move(series)) {}

bool Keys::has(const std::string& key) const { return bool(node_[key]); }

std::string Keys::text(const std::string& key) const {
  LGIW_VALIDATE(has(key), where_ + ": " + key + " is missing", "this measure needs it", "add it to the check");
  std::string word = node_[key].as<std::string>();
  const std::string place = "{series}";
  for (std::size_t at = word.find(place); at != std::string::npos; at = word.find(place))
    word.replace(at, place.size(), series_);
  return word;
}
std::string Keys::text(const std::string& key, const std::string& otherwise) const {
  return has(key) ? text(key) : otherwise;
}

double Keys::number(const std::string& key) const {
  const std::string word = text(key);
  try {
    return node_[key].as<double>();
  } catch (const YAML::Exception&) {
    throw InputError(where_ + ": " + key + " is '" + word + "'", "it has to be a number", "write one");
  }
}
double Keys::number(const std::string& key, double otherwise) const { return has(key) ? number(key) : otherwise; }

double Keys::time(const std::string& key) const { return text(key, "last") == "last" ? last_time : number(key); }

CsvFile Keys::csv(const std::string& key) const { return CsvFile(folder_ + "/" + text(key)); }

const std::map<std::string, Measure>& measures() {
  static const std::map<std::string, Measure> all = [] {
    std::map<std::string, Measure> m;
    add_states(m), add_profiles(m), add_series(m), add_pressures(m), add_motion(m);
    return m;
  }();
  return all;
}

}  // namespace lgiw::validation
