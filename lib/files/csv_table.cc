#include "files/csv_table.hh"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>
#include <set>

#include "base/error.hh"

namespace lgiw {
namespace {

std::string trimmed(const std::string& word) {
  const std::size_t first = word.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : word.substr(first, word.find_last_not_of(" \t\r") - first + 1);
}

/// Whether the whole of `cell` is a number, infinities and NaN among them; a plus sign may stand in front.
bool is_number(const std::string& cell, double& value) {
  const bool plus = cell.size() > 1 && cell[0] == '+' && cell[1] != '-';  // which from_chars does not take
  const char* last = cell.data() + cell.size();
  const auto [end, error] = std::from_chars(cell.data() + plus, last, value);
  return error == std::errc() && end == last;
}

/// A cell as a number, NaN where it is empty or `nan`; `otherwise`: what can be done about others but to write a
/// number.
double number_in(const CsvText& table, std::size_t row, std::size_t column, const char* otherwise) {
  const std::string& cell = table.rows[row][column];
  if (cell.empty() || cell == "nan" || cell == "NaN" || cell == "NAN") return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  LGIW_VALIDATE(
      is_number(cell, value) && std::isfinite(value), table.place(row) + ": '" + cell.substr(0, 40) + "' is no number",
      "column " + table.header[column] + " holds numbers", std::string("write it with a decimal point") + otherwise);
  return value;
}

/// Takes a text apart into rows of cells.
class CsvParser {
 public:
  CsvParser(const std::string& text, const std::string& name) : text_(text), name_(name) {
    // What spreadsheets put in front.
    if (text_.rfind("\xEF\xBB\xBF", 0) == 0) at_ = 3;
  }

  /// The next row that is neither empty nor a comment, and the line it starts on; false at the end.
  bool next(std::vector<std::string>& cells, std::size_t& line) {
    while (at_ < text_.size()) {
      const std::size_t word = text_.find_first_not_of(" \t", at_);
      if (word != std::string::npos && text_[word] == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1;
        ++line_;
        continue;
      }
      line = line_;
      cells = row();
      if (!std::all_of(cells.begin(), cells.end(), [](const std::string& cell) { return cell.empty(); })) return true;
    }
    return false;
  }

 private:
  std::vector<std::string> row() {
    std::vector<std::string> cells;
    std::string cell;
    bool quoted = false;  // this cell was; its spaces are its own
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '"' && trimmed(cell).empty() && !quoted) {
        cell = quotation();
        quoted = true;
      } else if (c == ',' || c == '\n') {
        cells.push_back(quoted ? cell : trimmed(cell));
        cell.clear(), quoted = false;
        if (c == '\n') {
          ++at_, ++line_;
          return cells;
        }
      } else if (!quoted) {
        cell += c;
      }
    }
    cells.push_back(quoted ? cell : trimmed(cell));
    return cells;
  }

  /// From the opening quote on; leaves the closing one as the present character.
  std::string quotation() {
    const std::size_t start = line_;
    std::string cell;
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\n') ++line_;
      if (text_[at_] != '"') {
        cell += text_[at_];
      } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
        cell += text_[at_++];
      } else {
        return cell;
      }
    }
    throw InputError(name_ + ":" + std::to_string(start) + ": a quote does not end", "the file ends before it does",
                     "close it");
  }

  const std::string& text_;
  const std::string& name_;
  std::size_t at_ = 0, line_ = 1;
};

}  // namespace

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

std::size_t CsvText::column(const std::string& heading) const {
  return std::size_t(std::find(header.begin(), header.end(), heading) - header.begin());
}

std::string CsvText::place(std::size_t row) const { return name + ":" + std::to_string(lines[row]); }

double CsvText::number(std::size_t row, std::size_t column) const {
  return number_in(*this, row, column, ", or leave the cell empty");
}

double CsvText::given_number(std::size_t row, std::size_t column) const {
  const double value = number_in(*this, row, column, "");
  LGIW_VALIDATE(!std::isnan(value), place(row) + ": " + header[column] + " is missing", "every row needs it",
                "give it, or leave out the row");
  return value;
}

CsvText parse_csv(const std::string& text, const std::string& name) {
  LGIW_VALIDATE(text.find('\0') == std::string::npos, name + " is no text", "a table is comma-separated values",
                "see that the name is right");
  CsvText csv;
  csv.name = name;
  CsvParser parser(text, name);
  LGIW_VALIDATE(parser.next(csv.header, csv.header_line), name + " is empty", "a table has a header line and rows",
                "see that the name is right");
  const std::string start = name + ":" + std::to_string(csv.header_line);
  double unnamed = 0;
  LGIW_VALIDATE(!std::all_of(csv.header.begin(), csv.header.end(),
                             [&](const std::string& cell) { return is_number(cell, unnamed); }),
                start + ": there is no header", "the first line names the columns", "write one above the numbers");
  std::set<std::string> names;
  for (std::size_t k = 0; k < csv.header.size(); ++k) {
    LGIW_VALIDATE(!csv.header[k].empty(), start + ": column " + std::to_string(k + 1) + " has no name",
                  "the first line names the columns", "name it");
    LGIW_VALIDATE(names.insert(csv.header[k]).second, start + ": two columns are named " + csv.header[k],
                  "columns are told apart by name", "give each a name of its own");
  }
  std::size_t line = 0;
  for (std::vector<std::string> cells; parser.next(cells, line);) {
    LGIW_VALIDATE(cells.size() == csv.header.size(),
                  name + ":" + std::to_string(line) + ": " + std::to_string(cells.size()) + " cells instead of " +
                      std::to_string(csv.header.size()),
                  "every row has as many as the header", "separate them with commas and leave unknown ones empty");
    csv.rows.push_back(cells), csv.lines.push_back(line);
  }
  LGIW_VALIDATE(!csv.rows.empty(), name + " has no rows", "there is only a header", "see that the name is right");
  return csv;
}

CsvText read_csv(const std::string& path) {
  if (path == "-") return parse_csv({std::istreambuf_iterator<char>(std::cin), {}}, "stdin");
  std::error_code none;
  LGIW_VALIDATE(!std::filesystem::is_directory(path, none), path + " is a folder", "a file with a table is wanted",
                "name the file in it");
  std::ifstream file(path, std::ios::binary);
  LGIW_VALIDATE(file.good(), path + " cannot be read", "there is no such file, or no right to it",
                "see that the name is right");
  return parse_csv({std::istreambuf_iterator<char>(file), {}}, path);
}

}  // namespace lgiw
