// The table of all benchmarks, from the tables of the cases.
#pragma once

#include <string>
#include <vector>

#include "csv_file.hh"

namespace lgiw::validation {

/// Tables with one header under it, in the order given; throws InputError where headers differ.
std::string joined_tables(const std::vector<std::string>& files);
/// All RESULTS/*/rows.csv in the order of the cases' names.
std::vector<std::string> tables_of(const std::string& results_folder);
/// What a person reads: a line for every quantity that has a bar, measured against it, and how many bars are met.
std::string summary_text(const CsvFile& rows);
/// Markdown tables, one a case: the finest run of each quantity, and the errors of the coarser ones.
std::string markdown(const CsvFile& rows);

}  // namespace lgiw::validation
