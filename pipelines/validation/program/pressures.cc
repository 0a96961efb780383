// Measures of pressure gauges.
#include <cmath>

#include "base/error.hh"
#include "measures.hh"
#include "series.hh"

namespace lgiw::validation {
namespace {

/// Pressure, Pa, of the case's pressure gauge `gauge` against time.
Series pressure_series(const Run& run, const Keys& keys) {
  const std::vector<std::string>& names = run.header().pressure_gauges;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (names[k] == keys.text("gauge")) {
      const std::vector<float> p = run.file->pressure(k);
      return {run.file->surface_times(), {p.begin(), p.end()}};
    }
  throw InputError(keys.where() + ": there is no pressure gauge " + keys.text("gauge"), "the case has others",
                   "add it to the case");
}

Series part(const Series& s, const Keys& keys) {
  return between(s, keys.number("from", -last_time), keys.number("to", last_time));
}

/// Column `key` of `file`, times multiplied by `time_scale`, values by `scale`.
Series reference_series(const Keys& keys, const std::string& key) {
  const CsvFile csv = keys.csv("file");
  Series s{csv.numbers("1"), csv.numbers(keys.text(key))};
  for (double& t : s.time) t *= keys.number("time_scale", 1);
  for (double& v : s.value) v *= keys.number("scale", 1);
  return s;
}

/// Mean over time by the trapezoidal rule.
double mean(const Series& s) {
  double sum = 0;
  for (std::size_t k = 1; k < s.time.size(); ++k)
    sum += (s.time[k] - s.time[k - 1]) * (s.value[k] + s.value[k - 1]) / 2;
  return s.time.size() < 2 ? missing : sum / (s.time.back() - s.time.front());
}

/// Mean from `from` to `to`, Pa, and the same of column `column` of `file`.
Value pressure_mean(const Run& run, const Keys& keys) {
  return {mean(part(pressure_series(run, keys), keys)),
          keys.has("file") ? mean(part(reference_series(keys, "column"), keys)) : missing};
}

Value pressure_max(const Run& run, const Keys& keys) {
  return {extreme(part(pressure_series(run, keys), keys), true).value};
}

/// Time at which the pressure first exceeds `threshold` Pa.
Value pressure_arrival(const Run& run, const Keys& keys) {
  const Series s = pressure_series(run, keys);
  for (std::size_t k = 0; k < s.time.size(); ++k)
    if (s.value[k] > keys.number("threshold")) return {s.time[k]};
  return {};
}

/// Share of the times from `from` to `to` at which the mean over `window` s lies between the columns `low` and `high`
/// of `file`.
Value pressure_inside(const Run& run, const Keys& keys) {
  const Series all = pressure_series(run, keys), low = reference_series(keys, "low"),
               high = reference_series(keys, "high");
  const double window = keys.number("window");
  double inside = 0, n = 0;
  for (double t : part(all, keys).time) {
    const double p = mean(between(all, t - window / 2, t + window / 2));
    inside += p >= interpolate(low.time, low.value, t) && p <= interpolate(high.time, high.value, t);
    n += 1;
  }
  return {inside / n};
}

}  // namespace

void add_pressures(std::map<std::string, Measure>& all) {
  all["pressure_mean"] = pressure_mean;
  all["pressure_max"] = pressure_max;
  all["pressure_arrival"] = pressure_arrival;
  all["pressure_inside"] = pressure_inside;
}

}  // namespace lgiw::validation
