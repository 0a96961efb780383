// Measures of series in time: gauges, the diagnostics of the run, tables of the tools.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hh"
#include "measures.hh"
#include "series.hh"

namespace lgiw::validation {

Series gauge_series(const Run& run, const std::string& gauge) {
  const CsvFile csv = CsvFile(run.folder + "/gauges.csv");
  Series s{csv.numbers("time_s", "gauge", gauge), csv.numbers("height_m", "gauge", gauge)};
  LGIW_VALIDATE(!s.time.empty(), csv.name + " has no gauge " + gauge, "a check asks for it", "add it to the case");
  return s;
}

Series between(const Series& s, double from, double to) {
  Series part;
  for (std::size_t k = 0; k < s.time.size(); ++k)
    if (s.time[k] >= from && s.time[k] <= to && std::isfinite(s.value[k]))
      part.time.push_back(s.time[k]), part.value.push_back(s.value[k]);
  return part;
}

Series running_median(const Series& s, double window) {
  Series out = s;
  std::vector<double> near;
  for (std::size_t k = 0; k < s.time.size(); ++k) {
    near.clear();
    for (std::size_t j = 0; j < s.time.size(); ++j)
      if (std::abs(s.time[j] - s.time[k]) <= window / 2) near.push_back(s.value[j]);
    std::nth_element(near.begin(), near.begin() + near.size() / 2, near.end());
    out.value[k] = near[near.size() / 2];
  }
  return out;
}

Extreme extreme(const Series& s, bool highest) {
  if (s.value.empty()) return {missing, missing};
  const auto at =
      highest ? std::max_element(s.value.begin(), s.value.end()) : std::min_element(s.value.begin(), s.value.end());
  const std::size_t k = std::size_t(at - s.value.begin());
  if (k == 0 || k + 1 == s.value.size()) return {s.value[k], s.time[k]};
  // The vertex of the parabola through it and its neighbours: references are sampled coarsely.
  const double a = s.value[k - 1] - s.value[k], b = s.value[k + 1] - s.value[k];
  const double p = s.time[k - 1] - s.time[k], q = s.time[k + 1] - s.time[k];
  const double curvature = (a / p - b / q) / (p - q), slope = a / p - curvature * p;
  if (curvature == 0) return {s.value[k], s.time[k]};
  const double t = -slope / (2 * curvature);
  return {s.value[k] + slope * t / 2, s.time[k] + t};
}

SeriesNorms reference_norms(const Run& run, const Keys& keys) {
  const Series measured = gauge_series(run, keys.text("gauge"));
  Series reference;
  if (keys.has("file")) {
    const CsvFile csv = keys.csv("file");
    reference = {csv.numbers("1"), csv.numbers(keys.text("column"))};
  } else {
    const double amplitude = std::copysign(keys.number("amplitude"), measured.value.front());
    for (double t : measured.time) {
      reference.time.push_back(t);
      reference.value.push_back(amplitude * std::cos(2 * std::numbers::pi * t / keys.number("period")));
    }
  }
  const double to = keys.number("to", measured.time.back());
  return compare_series(part_of(measured, 0, to), part_of(reference, 0, to), run.dp() / 4);
}

namespace {

/// The series of the run's gauge `gauge` and that of column `column` of `file` (multiplied by `scale`, time by
/// `time_scale`), if the check names one; both between `from` and `to`, and after their lowest with `after: trough`.
/// With `median` the run's is without what lasts less than half of so many seconds.
struct Pair {
  Series measured, reference;
};
Pair gauge_pair(const Run& run, const Keys& keys) {
  const double from = keys.number("from", -last_time), to = keys.number("to", last_time);
  Pair p{between(gauge_series(run, keys.text("gauge")), from, to), {}};
  if (keys.has("median")) p.measured = running_median(p.measured, keys.number("median"));
  if (keys.has("file")) {
    const CsvFile csv = keys.csv("file");
    Series s{csv.numbers(keys.text("time_column", "1")), csv.numbers(keys.text("column"))};
    for (double& t : s.time) t *= keys.number("time_scale", 1);
    for (double& v : s.value) v *= keys.number("scale", 1);
    p.reference = between(s, from, to);
  }
  if (keys.text("after", "") == "trough")
    for (Series* s : {&p.measured, &p.reference}) *s = between(*s, extreme(*s, false).time, to);
  return p;
}

/// Highest and lowest of a gauge, m, and when, s. The same of the reference series where the check names a `file`.
Value crest(const Run& run, const Keys& keys) {
  const Pair p = gauge_pair(run, keys);
  return {extreme(p.measured, true).value, extreme(p.reference, true).value};
}
Value trough(const Run& run, const Keys& keys) {
  const Pair p = gauge_pair(run, keys);
  return {extreme(p.measured, false).value, extreme(p.reference, false).value};
}
Value crest_time(const Run& run, const Keys& keys) {
  const Pair p = gauge_pair(run, keys);
  return {extreme(p.measured, true).time, extreme(p.reference, true).time};
}
Value trough_time(const Run& run, const Keys& keys) {
  const Pair p = gauge_pair(run, keys);
  return {extreme(p.measured, false).time, extreme(p.reference, false).time};
}

/// RMS difference of a gauge and its reference series at the times of the latter, over the range of the latter.
Value gauge_nrmse(const Run& run, const Keys& keys) {
  const Pair p = gauge_pair(run, keys);
  double sum = 0, n = 0;
  for (std::size_t k = 0; k < p.reference.time.size(); ++k) {
    const double d = interpolate(p.measured.time, p.measured.value, p.reference.time[k]) - p.reference.value[k];
    if (std::isfinite(d)) sum += d * d, n += 1;
  }
  return {std::sqrt(sum / n) / (extreme(p.reference, true).value - extreme(p.reference, false).value), 0};
}

/// NRMSE of a gauge against linear theory: reference_norms() below.
Value wave_nrmse(const Run& run, const Keys& keys) { return {reference_norms(run, keys).nrmse, 0}; }

/// Middle of the span in which the highest crest is above half of its height: steadier than the time of a flat top.
double middle_of_crest(const Series& s) {
  const Extreme top = extreme(s, true);
  std::size_t first = 0;
  while (first + 1 < s.time.size() && s.time[first + 1] <= top.time) ++first;
  std::size_t last = first;
  const auto above = [&](std::size_t k) { return s.value[k] > top.value / 2; };
  while (first > 0 && above(first - 1)) --first;
  while (last + 1 < s.time.size() && above(last + 1)) ++last;
  if (first == 0 || last + 1 == s.time.size()) return top.time;
  const auto crossing = [&](std::size_t inside, std::size_t outside) {
    const double share = (s.value[inside] - top.value / 2) / (s.value[inside] - s.value[outside]);
    return s.time[inside] + share * (s.time[outside] - s.time[inside]);
  };
  return (crossing(first, first - 1) + crossing(last, last + 1)) / 2;
}

/// Speed of the highest crest between the gauges `gauge` and `second`, m/s; reference: sqrt(g (d + a)) with the depth
/// `depth` and the mean of the two crests.
Value celerity(const Run& run, const Keys& keys) {
  const std::string names[2] = {keys.text("gauge"), keys.text("second")};
  double x[2] = {missing, missing}, a = 0, t[2];
  for (int k = 0; k < 2; ++k) {
    const Series s = between(gauge_series(run, names[k]), 0, last_time);
    t[k] = middle_of_crest(s), a += extreme(s, true).value / 2;
    for (const Gauge& g : run.c.gauges)
      if (g.name == names[k]) x[k] = g.x;
  }
  return {(x[1] - x[0]) / (t[1] - t[0]), std::sqrt(-run.c.gravity[2] * (keys.number("depth") + a))};
}

/// From the lowest to the highest of a gauge, m.
Value wave_height(const Run& run, const Keys& keys) {
  const Pair p = gauge_pair(run, keys);
  return {extreme(p.measured, true).value - extreme(p.measured, false).value,
          extreme(p.reference, true).value - extreme(p.reference, false).value};
}

double reduce(const Series& s, const Keys& keys) {
  const std::string how = keys.text("reduce", "last");
  if (s.value.empty()) return missing;
  if (how == "last") return s.value.back();
  if (how == "first") return s.value.front();
  if (how == "max") return extreme(s, true).value;
  if (how == "min") return extreme(s, false).value;
  if (how == "change") return s.value.back() - s.value.front();
  if (how == "mean") {
    double sum = 0;
    for (double v : s.value) sum += v;
    return sum / double(s.value.size());
  }
  throw InputError(keys.where() + ": reduce is " + how, "it is none of last, first, max, min, change, mean",
                   "write one of them");
}

/// A column of the run's diagnostics, reduced over `from` to `to` as `reduce` (last) says.
Value diagnostic(const Run& run, const Keys& keys) {
  const auto columns = run.file->diagnostics();
  const auto column = columns.find(keys.text("column"));
  LGIW_VALIDATE(column != columns.end(), keys.where() + ": there is no diagnostic " + keys.text("column"),
                "the run has others", "name one of its diagnostics");
  return {reduce(
      between({columns.at("time"), column->second}, keys.number("from", -last_time), keys.number("to", last_time)),
      keys)};
}

/// The same of a column of a table that a tool wrote into the run's folder: `table` slide.csv, with its time column.
Value table(const Run& run, const Keys& keys) {
  const CsvFile csv = CsvFile(run.folder + "/" + keys.text("table"));
  return {reduce(between({csv.numbers("time_s"), csv.numbers(keys.text("column"))}, keys.number("from", -last_time),
                         keys.number("to", last_time)),
                 keys)};
}

/// How far the total energy rises above what it was before, over what has been released by the end.
Value energy_created(const Run& run, const Keys&) {
  const auto columns = run.file->diagnostics();
  std::vector<double> total(columns.at("time").size(), 0.0);
  for (const char* part : {"kinetic_energy", "potential_energy", "compression_energy"}) {
    const auto column = columns.find(part);
    if (column == columns.end()) continue;
    for (std::size_t k = 0; k < total.size(); ++k) total[k] += column->second[k];
  }
  double rise = 0, lowest = total.front();
  for (double e : total) lowest = std::min(lowest, e), rise = std::max(rise, e - lowest);
  return {rise / (total.front() - lowest), 0};
}

}  // namespace

void add_series(std::map<std::string, Measure>& all) {
  all["crest"] = crest;
  all["trough"] = trough;
  all["crest_time"] = crest_time;
  all["trough_time"] = trough_time;
  all["gauge_nrmse"] = gauge_nrmse;
  all["wave_height"] = wave_height;
  all["wave_nrmse"] = wave_nrmse;
  all["celerity"] = celerity;
  all["diagnostic"] = diagnostic;
  all["table"] = table;
  all["energy_created"] = energy_created;
}

}  // namespace lgiw::validation
