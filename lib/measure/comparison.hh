// A comparison with measurements as rows of a table and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "files/csv_table.hh"
#include "measure/norms.hh"
#include "measure/reference_data.hh"

namespace lgiw {

/// One quantity of one gauge, section or slide. Norms have no value of the run or the reference, only an error; indices
/// of agreement (Willmott's d, correlation, Aida's K and kappa) stand under `run`, what they are at best under
/// `reference`.
struct ComparisonRow {
  std::string name, quantity, unit;
  double run, reference, error, error_percent;  // NaN where there is none; error: run - reference
  /// Of quantities with bounds: 1 inside, 0 outside; NaN without bounds.
  double low, high, inside;
};

/// A quantity with its error; `relative`: in per cent too (of a height it says something, of a time not).
ComparisonRow compared(const std::string& name, const std::string& quantity, const std::string& unit, double run,
                       double reference, bool relative = true);
std::vector<ComparisonRow> series_rows(const std::string& name, const std::string& unit, const SeriesNorms& norms);
/// Rows aida_K and aida_kappa of run-ups.
std::vector<ComparisonRow> aida_rows(const AidaNumbers& numbers);
std::vector<ComparisonRow> profile_rows(const std::string& name, const ProfileNorms& norms);
/// `unit` of the quantity; a row's error is to its value, or to the nearer bound where there is none (inside: 0).
ComparisonRow scalar_row(const ScalarReference& reference, const std::string& unit, double run);

/// Columns name, quantity, unit, run, reference, error, error_percent; with any bounds also low, high, inside.
CsvTable comparison_table(const std::vector<ComparisonRow>& rows);
/// [{name, <quantity>: {unit, run, reference, error, error_percent ...}, ...}, ...], an object a name; what is NaN is
/// left out.
nlohmann::ordered_json comparison_json(const std::vector<ComparisonRow>& rows);

}  // namespace lgiw
