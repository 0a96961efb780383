// A line of validation.csv: one quantity of one run against its reference.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace lgiw::validation {

/// An error and its bar are fractions of the reference where `relative`, written with a %, else in `unit`.
struct Row {
  std::string case_name, quantity, unit;
  double reference = std::numeric_limits<double>::quiet_NaN(), measured = reference, error = reference;
  double bar = std::numeric_limits<double>::quiet_NaN();  // NaN: none (the bar is for the finest run)
  bool relative = true;
  double dp = 0;
  std::size_t particles = 0;
  long steps = 0;
  double wall_time = 0;
  std::string run;

  bool judged() const;
  bool pass() const;
};

/// The columns that validation.csv has.
std::vector<std::string> row_columns();
std::string rows_csv(const std::vector<Row>& rows);
/// Error and bar as they stand in the table: "1.2%" or "0.004".
std::string error_text(double value, bool relative);

}  // namespace lgiw::validation
