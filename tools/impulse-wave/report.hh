// An assessment as text, as a table and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "assessment.hh"
#include "files/csv_table.hh"

namespace lgiw {

std::string report_text(const Assessment& a);
/// A row an estimate: place, kind, distance_m, angle_deg, quantity, formula, verified, predicted, simulated,
/// error_percent, limits_broken.
CsvTable report_table(const Assessment& a);
/// docs/impulse-wave.md tells the keys. What is not known is null.
nlohmann::ordered_json report_json(const Assessment& a);

}  // namespace lgiw
