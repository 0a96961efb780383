#include "report.hh"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "base/error.hh"
#include "row.hh"

namespace lgiw::validation {
namespace {

namespace fs = std::filesystem;

std::string cell(const CsvFile& rows, std::size_t k, const std::string& column) {
  return rows.rows[k].at(rows.index(column));
}

}  // namespace

std::string joined_tables(const std::vector<std::string>& files) {
  std::string text, header;
  for (const std::string& file : files) {
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    LGIW_VALIDATE(!line.empty(), file + " holds no table", "it cannot be joined", "make it again");
    if (text.empty()) text = line + "\n", header = line;
    LGIW_VALIDATE(line == header, file + " has other columns than " + files[0], "it was made by another version",
                  "remove it and make it again");
    while (std::getline(in, line)) text += line + "\n";
  }
  return text;
}

std::vector<std::string> tables_of(const std::string& results_folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(results_folder))
    if (fs::exists(entry.path() / "rows.csv")) files.push_back((entry.path() / "rows.csv").string());
  LGIW_VALIDATE(!files.empty(), results_folder + " holds no rows.csv", "no benchmark has been judged yet",
                "run make -C pipelines validate");
  std::sort(files.begin(), files.end());
  return files;
}

std::string summary_text(const CsvFile& rows) {
  std::string text;
  int judged = 0, met = 0;
  for (std::size_t k = 0; k < rows.rows.size(); ++k) {
    const std::string pass = cell(rows, k, "pass");
    if (pass.empty()) continue;
    ++judged, met += pass == "yes";
    char line[300];
    std::snprintf(line, sizeof line, "%-4s %-18s %-58s %10s (%s) error %9s bar %8s  dp %s\n",
                  pass == "yes" ? "ok" : "MISS", cell(rows, k, "case").c_str(), cell(rows, k, "quantity").c_str(),
                  cell(rows, k, "measured").c_str(), cell(rows, k, "reference").c_str(), cell(rows, k, "error").c_str(),
                  cell(rows, k, "bar").c_str(), cell(rows, k, "dp").c_str());
    text += line;
  }
  return text + std::to_string(met) + " of " + std::to_string(judged) + " bars are met, " +
         std::to_string(judged - met) + " are missed\n";
}

std::string markdown(const CsvFile& rows) {
  // Rows of a quantity stand together, the finest last.
  std::vector<std::pair<std::string, std::vector<std::size_t>>> groups;
  for (std::size_t k = 0; k < rows.rows.size(); ++k) {
    const std::string name = cell(rows, k, "case") + "|" + cell(rows, k, "quantity");
    if (groups.empty() || groups.back().first != name) groups.push_back({name, {}});
    groups.back().second.push_back(k);
  }
  const std::vector<std::string> columns{"quantity", "unit", "reference", "measured",   "error",
                                         "bar",      "pass", "dp",        "wall_time_s"};
  std::string text = "Made by `make -C pipelines accuracy-docs` from pipelines/out/validation.csv.\n", present;
  for (const auto& [name, lines] : groups) {
    const std::size_t k = lines.back();
    if (cell(rows, k, "case") != present) {
      present = cell(rows, k, "case");
      text += "\n## " + present +
              "\n\n| quantity | unit | reference | measured | error | bar | met | dp (m) | wall time (s) | errors when "
              "coarser |\n|---|---|---|---|---|---|---|---|---|---|\n";
    }
    text += "|";
    for (const std::string& column : columns) text += " " + cell(rows, k, column) + " |";
    std::string coarser;
    for (std::size_t j = 0; j + 1 < lines.size(); ++j) coarser += (j ? ", " : "") + cell(rows, lines[j], "error");
    text += " " + coarser + " |\n";
  }
  return text;
}

}  // namespace lgiw::validation
