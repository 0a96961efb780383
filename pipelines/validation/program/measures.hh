// What can be measured of a run. A check names a measure and gives its parameters (see ../README.md).
#pragma once

#include <yaml-cpp/yaml.h>

#include <limits>
#include <map>
#include <string>

#include "csv_file.hh"
#include "run.hh"

namespace lgiw::validation {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr double last_time = std::numeric_limits<double>::infinity();

/// The keys of a check; asking for one that is not there without a default throws InputError.
class Keys {
 public:
  /// `series` takes the place of {series} in texts.
  Keys(const YAML::Node& node, std::string folder, std::string where, std::string series = "");
  bool has(const std::string& key) const;
  double number(const std::string& key) const;
  double number(const std::string& key, double otherwise) const;
  std::string text(const std::string& key) const;
  std::string text(const std::string& key, const std::string& otherwise) const;
  /// A file of the case's folder.
  CsvFile csv(const std::string& key) const;
  /// `key` as a time; "last" or absent: the last.
  double time(const std::string& key) const;
  const YAML::Node& node() const { return node_; }
  const std::string& where() const { return where_; }

 private:
  YAML::Node node_;
  std::string folder_, where_, series_;
};

/// A number of a run, and the reference that the measure itself knows (NaN: the check gives it).
struct Value {
  double measured = missing, reference = missing;
};
using Measure = Value (*)(const Run&, const Keys&);

/// By name; each is described where it is defined.
const std::map<std::string, Measure>& measures();

// Topics: each adds its measures.
void add_states(std::map<std::string, Measure>& all);     // states.cc: pressure, speeds, drifts, crossings
void add_profiles(std::map<std::string, Measure>& all);   // profiles.cc: fronts, surfaces, failure lines
void add_series(std::map<std::string, Measure>& all);     // series.cc: gauges, diagnostics, tables of the tools
void add_pressures(std::map<std::string, Measure>& all);  // pressures.cc: pressure gauges
void add_motion(std::map<std::string, Measure>& all);     // motion.cc: accelerations, waves' periods and decay

}  // namespace lgiw::validation
