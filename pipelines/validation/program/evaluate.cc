#include "evaluate.hh"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "base/error.hh"
#include "measure/convergence.hh"
#include "measures.hh"

namespace lgiw::validation {
namespace {

/// "5 %" or "0.01": a fraction of the reference, or in the quantity's unit.
struct Bar {
  double value = missing;
  bool relative = false;
};
Bar parse_bar(const std::string& text, const std::string& where) {
  char* end = nullptr;
  Bar bar;
  bar.value = std::strtod(text.c_str(), &end);
  std::string rest = end;
  rest.erase(std::remove(rest.begin(), rest.end(), ' '), rest.end());
  LGIW_VALIDATE(end != text.c_str() && (rest.empty() || rest == "%"), where + ": the bar is '" + text + "'",
                "it is a number, or a percentage of the reference", "write for example 0.01 or 5 %");
  bar.relative = rest == "%";
  if (bar.relative) bar.value /= 100;
  return bar;
}

/// What a number is held against: a reference with a bar, a band (its middle, half of its width as bar), or a limit.
struct Expectation {
  double reference = missing;
  Bar bar;
  int limit = 0;  // 1: at least, -1: at most the reference
};

Expectation expectation(const Keys& keys, bool quick) {
  Expectation e;
  const YAML::Node& node = keys.node();
  if (keys.has("at_least") || keys.has("at_most")) {
    e.limit = keys.has("at_least") ? 1 : -1;
    e.reference = keys.number(e.limit > 0 ? "at_least" : "at_most");
    e.bar.value = 0;
  } else if (keys.has("reference") && node["reference"].IsSequence()) {
    const double low = node["reference"][0].as<double>(), high = node["reference"][1].as<double>();
    e.reference = (low + high) / 2;
    e.bar.value = (high - low) / 2;
  } else {
    e.reference = keys.number("reference", missing);
    if (keys.has("bar")) e.bar = parse_bar(keys.text("bar"), keys.where());
  }
  if (quick) {
    const bool relative = e.bar.relative;
    e.bar.value = missing;
    if (keys.has("quick")) e.bar = parse_bar(keys.text("quick"), keys.where());
    e.bar.relative = e.bar.relative || relative;
  }
  return e;
}

double error_of(const Expectation& e, double measured, double reference) {
  if (e.limit) {
    const double beyond = measured - reference;
    return std::isnan(beyond) || beyond * e.limit < 0 ? beyond : 0;
  }
  if (!e.bar.relative) return measured - reference;
  return reference == 0 ? measured : (measured - reference) / std::abs(reference);
}

Row row_of(const Run& run, const std::string& case_name, const std::string& quantity, const std::string& unit) {
  Row row;
  row.case_name = case_name, row.quantity = quantity, row.unit = unit, row.run = run.name;
  row.dp = run.dp(), row.particles = run.particles(), row.steps = long(run.steps()), row.wall_time = run.wall_time();
  return row;
}

Measure measure_of(const Keys& keys) {
  const auto measure = measures().find(keys.text("measure"));
  LGIW_VALIDATE(measure != measures().end(), keys.where() + ": there is no measure " + keys.text("measure"),
                "the program knows others", "see validation/README.md");
  return measure->second;
}

/// The value of a check, less `minus` and over `over`; so is the reference that the measure knows, the one that the
/// check gives is not.
Value value_of(const Run& run, const Keys& keys, Measure measure, const Expectation& expected) {
  Value value = measure(run, keys);
  for (double* x : {&value.measured, &value.reference}) *x = (*x - keys.number("minus", 0)) / keys.number("over", 1);
  if (keys.has("reference") || expected.limit) value.reference = expected.reference;
  return value;
}

class Checks {
 public:
  Checks(const std::string& folder, const std::string& results, bool quick)
      : folder_(folder), quick_(quick), name_(std::filesystem::path(folder).lexically_normal().filename().string()) {
    for (Run& run : load_runs(folder, results))
      if (run.quick == quick) runs_.push_back(std::move(run));
    std::stable_sort(runs_.begin(), runs_.end(), [](const Run& a, const Run& b) { return a.dp() > b.dp(); });
  }

  std::vector<Row> rows() const {
    std::vector<Row> all;
    const std::string path = folder_ + "/checks.yaml";
    YAML::Node list;
    try {
      list = YAML::LoadFile(path);
    } catch (const YAML::Exception& e) {
      throw InputError(path + " is no list of checks", e.what(), "see validation/README.md");
    }
    for (std::size_t k = 0; k < list.size(); ++k) {
      const Keys keys(list[k], folder_, path + ": check " + std::to_string(k + 1));
      for (Row& row : rows_of(keys)) all.push_back(std::move(row));
    }
    return all;
  }

 private:
  std::vector<Row> rows_of(const Keys& keys) const {
    const Measure measure = measure_of(keys);
    std::set<std::string> done;
    std::vector<Row> rows;
    for (const Run& first : runs_) {
      const std::string series = quick_ ? "" : first.series();
      if (!done.insert(series).second) continue;
      if (!quick_ && fnmatch(keys.text("series", "*").c_str(), series.c_str(), 0) != 0) continue;
      if (quick_ && !keys.has("quick")) continue;
      const Keys own(keys.node(), folder_, keys.where(), series);
      for (Row& row : rows_of_series(own, measure, series)) rows.push_back(std::move(row));
    }
    return rows;
  }

  std::vector<Row> rows_of_series(const Keys& keys, Measure measure, const std::string& series) const {
    const Expectation expected = expectation(keys, quick_);
    const std::string quantity = keys.text("quantity"), unit = keys.text("unit", "-");
    std::vector<Row> rows;
    for (const Run& run : runs_) {
      if (!quick_ && run.series() != series) continue;
      const Value value = value_of(run, keys, measure, expected);
      Row row = row_of(run, name_, quantity, unit);
      row.measured = value.measured, row.reference = value.reference;
      row.relative = expected.bar.relative;
      row.error = error_of(expected, row.measured, row.reference);
      rows.push_back(row);
    }
    // The bar is that of the finest run; coarser ones show the way there.
    if (!rows.empty()) rows.back().bar = expected.bar.value;
    if (keys.has("converges") && rows.size() >= 2) add_convergence(keys, rows);
    return rows;
  }

  /// The change from the second finest run to the finest; observed order and GCI, or the spread where there is none.
  void add_convergence(const Keys& keys, std::vector<Row>& rows) const {
    Row row = rows.back();
    const double coarser = rows[rows.size() - 2].measured;
    const Bar bar = parse_bar(keys.text("converges"), keys.where());
    row.quantity += ": change between the two finest";
    row.reference = coarser;
    row.relative = bar.relative, row.bar = bar.value;
    row.error = (row.measured - coarser) / (bar.relative ? std::abs(coarser) : 1);
    std::vector<SpacingResult> results;
    for (const Row& r : rows) results.push_back({r.dp, r.measured});
    rows.push_back(row);
    const Convergence convergence = convergence_of(results);
    Row numbers = rows.front();
    numbers.dp = row.dp, numbers.particles = row.particles, numbers.steps = row.steps,
    numbers.wall_time = row.wall_time;
    numbers.unit = "-", numbers.reference = numbers.error = numbers.bar = missing;
    numbers.quantity = rows.front().quantity + ": observed order";
    numbers.measured = convergence.order;
    if (std::isfinite(convergence.order)) rows.push_back(numbers);
    numbers.quantity = rows.front().quantity + (convergence.use_gci ? ": GCI" : ": spread (no GCI)");
    numbers.measured = convergence.use_gci ? convergence.gci : convergence.spread;
    rows.push_back(numbers);
  }

  std::string folder_;
  bool quick_;
  std::string name_;
  std::vector<Run> runs_;
};

}  // namespace

Judgement judge(const Run& run, const Keys& keys) {
  Expectation expected = expectation(keys, false);
  expected.bar.relative = true;
  const Value value = value_of(run, keys, measure_of(keys), expected);
  return {value.measured, error_of(expected, value.measured, value.reference)};
}

std::vector<Row> evaluate(const std::string& case_folder, const std::string& results_folder, bool quick) {
  return Checks(case_folder, results_folder, quick).rows();
}

}  // namespace lgiw::validation
