#include "measure/csv_table.hh"

#include <cmath>
#include <cstdio>

#include "base/error.hh"

namespace lgiw {

CsvTable::CsvTable(const std::vector<std::string>& header) : columns_(header.size()) {
  for (const std::string& name : header) add(name);
}

void CsvTable::add_cell(double number) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", number);
  add_cell(std::isnan(number) ? std::string("nan") : std::string(text));
}

void CsvTable::add_cell(const std::string& word) {
  if (word.find_first_of(",\"\n\r") == std::string::npos) {
    text_ += word;
  } else {
    text_ += '"';
    for (char c : word) text_ += c == '"' ? std::string("\"\"") : std::string(1, c);
    text_ += '"';
  }
  column_ = (column_ + 1) % columns_;
  text_ += column_ ? ',' : '\n';
}

std::string CsvTable::text(const std::string& comment) const {
  LGIW_EXPECT(column_ == 0);
  return (comment.empty() ? "" : "# " + comment + "\n") + text_;
}

}  // namespace lgiw
