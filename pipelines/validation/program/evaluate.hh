// From a case's checks and its runs to rows of the table.
#pragma once

#include <string>
#include <vector>

#include "measures.hh"
#include "row.hh"
#include "run.hh"

namespace lgiw::validation {

/// Rows of all checks in CASE/checks.yaml on all runs that are there; the form of checks is in ../README.md. `quick`:
/// only the runs of the tests, against the bars of the tests. Throws InputError for checks that are none.
std::vector<Row> evaluate(const std::string& case_folder, const std::string& results_folder, bool quick);

/// What a check with the keys measures of a run, and its error; relative to the reference unless that is 0.
struct Judgement {
  double measured, error;
};
Judgement judge(const Run& run, const Keys& keys);

}  // namespace lgiw::validation
