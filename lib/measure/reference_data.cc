#include "measure/reference_data.hh"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "base/error.hh"

namespace lgiw {
namespace {

std::string column_list(const CsvText& table) {
  std::string names;
  for (std::size_t k = 0; k < std::min<std::size_t>(table.header.size(), 12); ++k)
    names += (k ? ", " : "") + table.header[k];
  return names + (table.header.size() > 12 ? " ..." : "");
}

}  // namespace

SeriesReference series_reference(const CsvText& table) {
  const bool timed = table.header[0] == "time_s" || table.header[0] == "t_s";
  LGIW_VALIDATE(timed, table.name + " does not begin with a column time_s or t_s",
                "its columns are " + column_list(table), "put the times, in s, into the first column");
  LGIW_VALIDATE(table.header.size() > 1, table.name + " holds times only", "there is nothing to compare with",
                "give each gauge a column that has its name");
  SeriesReference reference{table.name, {}};
  for (std::size_t column = 1; column < table.header.size(); ++column)
    reference.series.push_back({table.header[column], {}});
  double before = -HUGE_VAL;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const double time = table.given_number(row, 0);
    LGIW_VALIDATE(time > before, table.place(row) + ": time " + table.rows[row][0] + " does not rise",
                  "times are in order, each once", "sort the rows by time");
    before = time;
    for (std::size_t column = 1; column < table.header.size(); ++column) {
      const double value = table.number(row, column);
      Series& series = reference.series[column - 1].second;
      if (!std::isnan(value)) series.time.push_back(time), series.value.push_back(value);
    }
  }
  for (const auto& [name, series] : reference.series)
    LGIW_VALIDATE(series.time.size() >= 2,
                  table.name + ": column " + name + " has " + std::to_string(series.time.size()) + " values",
                  "a series has two or more", "leave the column out");
  return reference;
}

std::vector<ProfileReference> profile_references(const CsvText& table) {
  const std::size_t none = table.header.size();
  const std::size_t x = table.column("x_m"), distance = table.column("distance_m"), z = table.column("z_m"),
                    section = table.column("section");
  LGIW_VALIDATE((x == none) != (distance == none) && z != none,
                table.name + " is neither a profile nor a list of quantities", "its columns are " + column_list(table),
                "name the columns x_m,z_m or distance_m,z_m or quantity,value[,low,high]");
  LGIW_VALIDATE(section == none || distance != none, table.name + " has a column section with x_m",
                "places along a section are distances from its first point", "name the column distance_m");
  const std::size_t along = x != none ? x : distance;
  std::vector<ProfileReference> profiles;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::string name = section == none ? "" : table.rows[row][section];
    auto profile = std::find_if(profiles.begin(), profiles.end(), [&](const auto& p) { return p.section == name; });
    if (profile == profiles.end())
      profile = profiles.insert(profiles.end(), {table.name, distance != none, name, {}, {}});
    profile->distance.push_back(table.given_number(row, along));
    profile->elevation.push_back(table.given_number(row, z));
  }
  for (ProfileReference& p : profiles) {
    LGIW_VALIDATE(p.distance.size() >= 2,
                  table.name + (p.section.empty() ? "" : ": section " + p.section) + " has one point",
                  "a profile has two or more", "give more points");
    std::vector<std::size_t> order(p.distance.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return p.distance[a] < p.distance[b]; });
    const ProfileReference given = p;
    for (std::size_t k = 0; k < order.size(); ++k)
      p.distance[k] = given.distance[order[k]], p.elevation[k] = given.elevation[order[k]];
  }
  return profiles;
}

bool holds_scalars(const CsvText& table) { return table.column("quantity") < table.header.size(); }

std::vector<ScalarReference> scalar_references(const CsvText& table) {
  const std::size_t none = table.header.size();
  const std::size_t quantity = table.column("quantity"), value = table.column("value"), low = table.column("low"),
                    high = table.column("high");
  LGIW_VALIDATE(quantity != none && (value != none || low != none) && (low == none) == (high == none),
                table.name + " is no list of quantities", "its columns are " + column_list(table),
                "name them quantity,value or quantity,value,low,high");
  std::vector<ScalarReference> scalars;
  std::set<std::string> names;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto cell = [&](std::size_t column) { return column == none ? NAN : table.number(row, column); };
    const ScalarReference s{table.rows[row][quantity], table.place(row), cell(value), cell(low), cell(high)};
    LGIW_VALIDATE(!s.quantity.empty(), s.place + ": the quantity has no name", "it says what is compared", "name it");
    LGIW_VALIDATE(names.insert(s.quantity).second, s.place + ": " + s.quantity + " comes twice",
                  "a quantity has one reference", "leave out one of the rows");
    LGIW_VALIDATE(std::isnan(s.low) == std::isnan(s.high) && !(std::isnan(s.value) && std::isnan(s.low)),
                  s.place + ": " + s.quantity + " has neither a value nor both bounds",
                  "there is nothing to compare with", "give value, or low and high, or all three");
    const bool direction = s.quantity == "direction_deg";  // whose bounds may enclose north
    LGIW_VALIDATE(std::isnan(s.low) || direction || s.low <= s.high, s.place + ": low is above high",
                  "they bound the " + s.quantity, "exchange them");
    scalars.push_back(s);
  }
  return scalars;
}

}  // namespace lgiw
