// Tables as comma-separated values, the form in which all series and profiles leave the tools.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lgiw {

/// Rows of numbers and words below one header line. Numbers have nine significant digits, NaN is `nan`; a word with a
/// comma, a quote or a line break is quoted (RFC 4180).
class CsvTable {
 public:
  explicit CsvTable(const std::vector<std::string>& header);

  /// The next cells of the present row, which ends with the table's last column.
  template <class... Cells>
  void add(const Cells&... cells) {
    (add_cell(cells), ...);
  }
  /// The table; in front of it `comment` as a line that starts with `#`, where there is one.
  std::string text(const std::string& comment = "") const;

 private:
  void add_cell(double number);
  void add_cell(const std::string& word);

  std::size_t columns_, column_ = 0;
  std::string text_;
};

}  // namespace lgiw
