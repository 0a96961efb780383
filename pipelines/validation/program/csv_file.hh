// Columns of the tables that the tools write and of the references.
#pragma once

#include <string>
#include <vector>

#include "files/csv_table.hh"

namespace lgiw::validation {

struct CsvFile : CsvText {
  explicit CsvFile(const std::string& path) : CsvText(lgiw::read_csv(path)) {}

  /// Index of a column by its name, or by its number from 1; throws InputError.
  std::size_t index(const std::string& heading) const;
  /// A column as numbers; empty cells and words are NaN. Only rows whose column `where` holds `value`, where given.
  std::vector<double> numbers(const std::string& heading, const std::string& where = "",
                              const std::string& value = "") const;
};

/// y at x by linear interpolation between points of rising x; NaN outside.
double interpolate(const std::vector<double>& xs, const std::vector<double>& ys, double x);

}  // namespace lgiw::validation
