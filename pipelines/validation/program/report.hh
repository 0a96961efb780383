// The table of all benchmarks, from the tables of the cases.
#pragma once

#include <string>

#include "csv_file.hh"

namespace lgiw::validation {

/// The rows of all RESULTS/*/rows.csv under one header, in the order of the cases' names.
std::string merged_rows(const std::string& results_folder);
/// What a person reads: a line for every quantity that has a bar, measured against it, and how many bars are met.
std::string summary_text(const CsvFile& rows);
/// The same as a Markdown table, with the errors of the coarser runs beside that of the finest.
std::string markdown(const CsvFile& rows);

}  // namespace lgiw::validation
