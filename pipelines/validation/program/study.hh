// Error against run time: one norm of a case over the schemes and spacings of its study.
#pragma once

#include <string>

namespace lgiw::validation {

/// The table of the runs of CASE/study.txt with the norm of CASE/study.yaml, as CSV; a series is a scheme. Observed
/// order and GCI of a scheme stand on its finest run. Throws InputError for a study that is none.
std::string study_table(const std::string& case_folder, const std::string& results_folder);

}  // namespace lgiw::validation
