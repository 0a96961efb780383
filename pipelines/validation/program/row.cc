#include "row.hh"

#include <cmath>
#include <cstdio>

#include "files/csv_table.hh"

namespace lgiw::validation {
namespace {

std::string number(double value, int digits) {
  if (std::isnan(value)) return "";
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

}  // namespace

bool Row::judged() const { return !std::isnan(bar); }
bool Row::pass() const { return std::abs(error) <= bar; }  // NaN does not

std::string error_text(double value, bool relative) {
  if (std::isnan(value)) return "";
  return relative ? number(100 * value, 3) + "%" : number(value, 3);
}

std::vector<std::string> row_columns() {
  return {"case", "quantity", "unit", "reference", "measured", "error",
          "bar",  "pass",     "dp",   "particles", "steps",    "wall_time_s"};
}

std::string rows_csv(const std::vector<Row>& rows) {
  CsvTable table(row_columns());
  for (const Row& r : rows) {
    const std::string verdict = r.judged() ? (r.pass() ? "yes" : "no") : "";
    table.add(r.case_name, r.quantity, r.unit, number(r.reference, 5), number(r.measured, 5),
              error_text(r.error, r.relative), error_text(r.bar, r.relative), verdict, number(r.dp, 6),
              std::to_string(r.particles), std::to_string(r.steps), number(r.wall_time, 4));
  }
  return table.text();
}

}  // namespace lgiw::validation
