// Measurements that a run is compared with, from CSV tables. Every fault of a table is an InputError with its place.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "files/csv_table.hh"
#include "measure/norms.hh"

namespace lgiw {

/// Series by name. The table's first column is `time_s` or `t_s`, seconds, rising; every other column is a series,
/// whose empty cells are left out of it.
struct SeriesReference {
  std::string file;
  std::vector<std::pair<std::string, Series>> series;
};
SeriesReference series_reference(const CsvText& table);

/// Points of a soil surface along a line: columns `x_m` (2-D runs: x in the case's CRS) or `distance_m` (m along a
/// section) and `z_m` (elevation), and with several sections `section`. Sorted by distance.
struct ProfileReference {
  std::string file;
  bool along_section = false;  // distance_m instead of x_m
  std::string section;         // empty: not named
  std::vector<double> distance, elevation;
};
std::vector<ProfileReference> profile_references(const CsvText& table);

/// A single quantity: columns `quantity`, `value` and, for estimates and scatter, `low` and `high`. A row has a value,
/// or both bounds, or all.
struct ScalarReference {
  std::string quantity, place;  // place: file:line
  double value, low, high;      // NaN where not given
};
std::vector<ScalarReference> scalar_references(const CsvText& table);
/// Whether a table holds scalars; else it holds profiles.
bool holds_scalars(const CsvText& table);

}  // namespace lgiw
