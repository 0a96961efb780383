#include "measure/comparison.hh"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace lgiw {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

ComparisonRow norm(const std::string& name, const std::string& quantity, const std::string& unit, double error,
                   double percent = nothing) {
  return {name, quantity, unit, nothing, nothing, error, percent, nothing, nothing, nothing};
}

/// From one direction to another, the shorter way, degrees in [-180, 180].
double turn(double from, double to) { return std::remainder(to - from, 360); }

/// Directions from north: bounds run clockwise from low to high, also across north.
ComparisonRow direction_row(const ScalarReference& reference, const std::string& unit, double run) {
  const auto clockwise = [](double from, double to) { return std::fmod(std::fmod(to - from, 360) + 360, 360); };
  const bool bounded = !std::isnan(reference.low) && !std::isnan(run);
  const bool inside = bounded && clockwise(reference.low, run) <= clockwise(reference.low, reference.high);
  const double low = turn(reference.low, run), high = turn(reference.high, run);
  double error = turn(reference.value, run);
  if (std::isnan(reference.value)) error = inside ? 0 : std::abs(low) < std::abs(high) ? low : high;
  return {"slide",
          reference.quantity,
          unit,
          run,
          reference.value,
          error,
          nothing,
          reference.low,
          reference.high,
          bounded ? (inside ? 1.0 : 0.0) : nothing};
}

}  // namespace

ComparisonRow compared(const std::string& name, const std::string& quantity, const std::string& unit, double run,
                       double reference, bool relative) {
  return {
      name,    quantity, unit,   run, reference, run - reference, relative ? percent_error(run, reference) : nothing,
      nothing, nothing,  nothing};
}

std::vector<ComparisonRow> series_rows(const std::string& name, const std::string& unit, const SeriesNorms& norms) {
  std::vector<ComparisonRow> rows;
  const auto extreme = [&](const std::string& quantity, const Extreme& run, const Extreme& reference) {
    rows.push_back(compared(name, quantity, unit, run.value, reference.value));
    rows.push_back(compared(name, "time_of_" + quantity, "s", run.time, reference.time, false));
  };
  extreme("max", norms.run.highest, norms.reference.highest);
  extreme("min", norms.run.lowest, norms.reference.lowest);
  extreme("first_trough", norms.run.trough, norms.reference.trough);
  extreme("first_crest", norms.run.crest, norms.reference.crest);
  rows.push_back(compared(name, "arrival", "s", norms.run.arrival, norms.reference.arrival, false));
  rows.push_back(norm(name, "phase_lag", "s", norms.phase_lag));
  rows.push_back(compared(name, "correlation_at_lag", "1", norms.correlation, 1, false));
  rows.push_back(norm(name, "rmse", unit, norms.rmse));
  rows.push_back(norm(name, "nrmse", "1", norms.nrmse, 100 * norms.nrmse));
  rows.push_back(norm(name, "mae", unit, norms.mae));
  rows.push_back(compared(name, "willmott_d", "1", norms.willmott_d, 1, false));
  rows.push_back({name, "samples", "1", double(norms.samples), nothing, nothing, nothing, nothing, nothing, nothing});
  return rows;
}

std::vector<ComparisonRow> aida_rows(const AidaNumbers& numbers) {
  return {compared("runup", "aida_K", "1", numbers.K, 1, false),
          compared("runup", "aida_kappa", "1", numbers.kappa, 1, false)};
}

std::vector<ComparisonRow> profile_rows(const std::string& name, const ProfileNorms& norms) {
  return {norm(name, "rms_distance", "m", norms.rms_distance),
          norm(name, "rms_height", "m", norms.rms_height),
          compared(name, "front", "m", norms.front_run, norms.front_reference, false),
          compared(name, "height", "m", norms.height_run, norms.height_reference, false),
          {name, "samples", "1", double(norms.samples), nothing, nothing, nothing, nothing, nothing, nothing}};
}

ComparisonRow scalar_row(const ScalarReference& reference, const std::string& unit, double run) {
  if (unit == "degrees") return direction_row(reference, unit, run);
  double target = reference.value;
  if (std::isnan(target)) target = std::isnan(run) ? nothing : std::clamp(run, reference.low, reference.high);
  ComparisonRow row = compared("slide", reference.quantity, unit, run, target);
  row.reference = reference.value;
  row.low = reference.low, row.high = reference.high;
  if (!std::isnan(row.low) && !std::isnan(run)) row.inside = run >= row.low && run <= row.high ? 1 : 0;
  return row;
}

CsvTable comparison_table(const std::vector<ComparisonRow>& rows) {
  const bool bounds = std::any_of(rows.begin(), rows.end(), [](const auto& row) { return !std::isnan(row.low); });
  std::vector<std::string> header{"name", "quantity", "unit", "run", "reference", "error", "error_percent"};
  if (bounds) header.insert(header.end(), {"low", "high", "inside"});
  CsvTable table(header);
  for (const ComparisonRow& row : rows) {
    table.add(row.name, row.quantity, row.unit, row.run, row.reference, row.error, row.error_percent);
    if (bounds) table.add(row.low, row.high, row.inside);
  }
  return table;
}

nlohmann::ordered_json comparison_json(const std::vector<ComparisonRow>& rows) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const ComparisonRow& row : rows) {
    if (json.empty() || json.back()["name"] != row.name) json.push_back({{"name", row.name}});
    nlohmann::ordered_json cell{{"unit", row.unit}};
    const auto add = [&](const char* key, double value) {
      if (!std::isnan(value)) cell[key] = value;
    };
    add("run", row.run), add("reference", row.reference), add("error", row.error);
    add("error_percent", row.error_percent), add("low", row.low), add("high", row.high);
    if (!std::isnan(row.inside)) cell["inside"] = row.inside == 1;
    json.back()[row.quantity] = std::move(cell);
  }
  return json;
}

}  // namespace lgiw
