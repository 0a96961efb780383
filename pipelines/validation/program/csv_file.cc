#include "csv_file.hh"

#include <cstdlib>

#include "base/error.hh"
#include "measure/norms.hh"

namespace lgiw::validation {

std::size_t CsvFile::index(const std::string& heading) const {
  const std::size_t k = column(heading);
  if (k < header.size()) return k;
  char* end = nullptr;
  const long n = std::strtol(heading.c_str(), &end, 10);
  LGIW_VALIDATE(*end == '\0' && n >= 1 && n <= long(header.size()), name + " has no column " + heading,
                "its columns are others", "name one of its header, or a number from 1");
  return std::size_t(n) - 1;
}

std::vector<double> CsvFile::numbers(const std::string& heading, const std::string& where,
                                     const std::string& value) const {
  const std::size_t k = index(heading), filter = where.empty() ? 0 : index(where);
  std::vector<double> result;
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (where.empty() || rows[row][filter] == value) result.push_back(number(row, k));
  return result;
}

double interpolate(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  return value_at({xs, ys}, x);
}

}  // namespace lgiw::validation
