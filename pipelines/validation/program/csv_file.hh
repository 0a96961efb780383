// Tables of numbers as the tools write them and as the references come: commas, one header line, lines with # are
// comments.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace lgiw::validation {

struct CsvFile {
  std::string path;
  std::vector<std::string> names;               // of the columns
  std::vector<std::vector<std::string>> cells;  // by row

  /// Index of a column by its name, or by its number from 1; throws InputError.
  std::size_t column(const std::string& name) const;
  /// A column as numbers; words are NaN. Only rows whose column `where` holds `value`, if `where` is given.
  std::vector<double> numbers(const std::string& name, const std::string& where = "",
                              const std::string& value = "") const;
};

/// Throws InputError when there is no such file or it holds no table.
CsvFile read_csv(const std::string& path);

/// y at x by linear interpolation between points of rising x; NaN outside.
double interpolate(const std::vector<double>& xs, const std::vector<double>& ys, double x);

}  // namespace lgiw::validation
