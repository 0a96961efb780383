// Tables as comma-separated values, the form in which all series and profiles leave the tools, and measurements and
// motions come in.
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

/// A table read back. Every row has as many cells as the header; rows of cells without a character are left out.
struct CsvText {
  std::string name;  // of the file, for messages
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  std::size_t header_line = 0;
  std::vector<std::size_t> lines;  // where each row stands

  /// Index of a column; the number of columns where there is none of that name.
  std::size_t column(const std::string& heading) const;
  /// "file:line".
  std::string place(std::size_t row) const;
  /// A cell as a number; NaN where it is empty or `nan`. Throws InputError for other words and for infinities.
  double number(std::size_t row, std::size_t column) const;
  /// The same of a cell that must hold one.
  double given_number(std::size_t row, std::size_t column) const;
};

/// Reads comma-separated values (RFC 4180) with one header line; `path` "-" is stdin. Empty lines and lines that start
/// with `#`, behind spaces or not, are passed over, spaces around cells dropped. Throws InputError, with `file:line:`
/// in front, for what is no such table: no file, no text, no rows, rows of another length than the header, numbers
/// instead of a header, columns without a name or with the same one, a quote that does not end.
CsvText read_csv(const std::string& path);
/// The same of a text; `name` stands for the file in messages.
CsvText parse_csv(const std::string& text, const std::string& name);

}  // namespace lgiw
