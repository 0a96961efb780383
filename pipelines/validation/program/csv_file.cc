#include "csv_file.hh"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

#include "base/error.hh"

namespace lgiw::validation {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

/// Cells of a line; a quoted cell may hold commas.
std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else if (c != '\r')
      cells.back() += c;
  }
  return cells;
}

double number(const std::string& cell) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  return end == cell.c_str() ? nan_value : value;
}

}  // namespace

std::size_t CsvFile::column(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return std::size_t(found - names.begin());
  const double n = number(name);
  LGIW_VALIDATE(n >= 1 && n <= double(names.size()), path + " has no column " + name, "its columns are others",
                "name one of its header, or a number from 1");
  return std::size_t(n) - 1;
}

std::vector<double> CsvFile::numbers(const std::string& name, const std::string& where,
                                     const std::string& value) const {
  const std::size_t k = column(name), filter = where.empty() ? 0 : column(where);
  std::vector<double> result;
  for (const auto& row : cells)
    if (k < row.size() && (where.empty() || (filter < row.size() && row[filter] == value)))
      result.push_back(number(row[k]));
  return result;
}

CsvFile read_csv(const std::string& path) {
  std::ifstream in(path);
  LGIW_VALIDATE(in.good(), path + " cannot be read", "a check needs it", "see the case's README");
  CsvFile table;
  table.path = path;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (table.names.empty())
      table.names = split(line);
    else
      table.cells.push_back(split(line));
  }
  LGIW_VALIDATE(!table.cells.empty(), path + " holds no table", "it has no row below a header",
                "see the case's README");
  return table;
}

double interpolate(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  if (xs.empty() || !(x >= xs.front() && x <= xs.back())) return nan_value;
  const std::size_t k = std::size_t(std::lower_bound(xs.begin(), xs.end(), x) - xs.begin());
  if (k == 0) return ys[0];
  const double a = (x - xs[k - 1]) / (xs[k] - xs[k - 1]);
  return ys[k - 1] + a * (ys[k] - ys[k - 1]);
}

}  // namespace lgiw::validation
