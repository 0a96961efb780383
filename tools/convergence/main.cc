// convergence: how much the results of a case still depend on the particle spacing.
#include <gdal_version.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.hh"
#include "base/tool_main.hh"
#include "case/dotted_key.hh"
#include "difference_maps.hh"
#include "files/csv_table.hh"
#include "files/domain.hh"
#include "measure/convergence.hh"
#include "measure/run_measures.hh"
#include "measure/surface_sampling.hh"
#include "measure/tool_outputs.hh"

namespace {

using namespace lgiw;
using nlohmann::ordered_json;

struct Options {
  std::vector<std::string> runs;
  std::string output, summary, maps;
  CommonOptions common;
};

/// A quantity in all runs, from fine to coarse.
struct Quantity {
  Measure measure;  // its value is the finest run's
  std::vector<SpacingResult> results;
  Convergence convergence;
};

double spacing_of(const RunReader& run) { return run.header().particles.dp; }

/// The runs from fine to coarse; refuses what cannot be compared.
std::vector<std::unique_ptr<RunReader>> opened(const std::vector<std::string>& paths) {
  LGIW_VALIDATE(paths.size() >= 2, "there is one run", "convergence is seen between runs",
                "give two or more runs of a case that differ in particle_spacing");
  std::vector<std::pair<std::string, std::unique_ptr<RunReader>>> runs;
  for (const std::string& path : paths) runs.push_back({path, std::make_unique<RunReader>(path)});
  std::sort(runs.begin(), runs.end(),
            [](const auto& a, const auto& b) { return spacing_of(*a.second) < spacing_of(*b.second); });
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const auto& [path, run] = runs[k];
    const auto& [finest_path, finest] = runs.front();
    LGIW_VALIDATE(!run->surface_times().empty() && (run->header().particles.counts.soil == 0 || run->frame_count() > 0),
                  path + " holds no results", "the run has not got that far", "wait for lgiw-run to write some");
    LGIW_VALIDATE(run->header().particles.dimension == finest->header().particles.dimension,
                  path + " and " + finest_path + " differ in dimension", "they are not runs of one case",
                  "give runs that differ in particle_spacing");
    const bool scene = run->has_water_surface() == finest->has_water_surface() &&
                       (run->header().particles.counts.soil > 0) == (finest->header().particles.counts.soil > 0);
    LGIW_VALIDATE(scene, path + " and " + finest_path + " do not both have water and soil",
                  "they are not runs of one case", "give runs that differ in particle_spacing");
    LGIW_VALIDATE(k == 0 || spacing_of(*run) > spacing_of(*runs[k - 1].second) * (1 + 1e-9),
                  path + " and " + runs[k - 1].first + " have the same particle spacing",
                  number_text(spacing_of(*run)) + " m", "give one run a spacing");
  }
  std::vector<std::unique_ptr<RunReader>> sorted;
  for (auto& [path, run] : runs) sorted.push_back(std::move(run));
  return sorted;
}

/// Why a difference between the runs may not be one of the spacing alone.
std::vector<std::string> warnings_of(const std::vector<std::unique_ptr<RunReader>>& runs) {
  std::vector<std::string> warnings, texts;
  for (const auto& run : runs) texts.push_back(run->header().particles.case_text);
  const bool described = std::none_of(texts.begin(), texts.end(), [](const std::string& t) { return t.empty(); });
  std::string keys;
  for (const std::string& key : described ? case_differences(texts) : std::vector<std::string>{})
    keys += (keys.empty() ? "" : ", ") + key;
  if (!keys.empty())
    warnings.push_back("the cases differ in " + keys +
                       " (not only the spacing moves the results) compare like with like");
  if (!described) warnings.push_back("a run has no case (it cannot be seen what else differs) gauges are left out");
  const double end = runs.front()->surface_times().back();
  for (const auto& run : runs) {
    const double here = run->surface_times().back();
    if (std::abs(here - end) > 0.01 * end)
      warnings.push_back("the run at " + number_text(spacing_of(*run)) + " m ends at " + number_text(here) +
                         " s, the finest at " + number_text(end) + " s (maxima and deposits may come later) let them " +
                         "end alike");
  }
  for (std::size_t k = 1; k < std::min<std::size_t>(runs.size(), 3); ++k) {
    const double ratio = spacing_of(*runs[k]) / spacing_of(*runs[k - 1]);
    if (ratio < 1.3 * (1 - 1e-6))
      warnings.push_back("the spacings " + number_text(spacing_of(*runs[k])) + " m and " +
                         number_text(spacing_of(*runs[k - 1])) + " m are close (an order wants a ratio of 1.3 or " +
                         "more) take coarser ones");
  }
  return warnings;
}

std::vector<Quantity> quantities_of(const std::vector<std::unique_ptr<RunReader>>& runs, const Case& c,
                                    const CommonOptions& common) {
  std::vector<Quantity> quantities;
  Progress progress(common.show_progress(), "convergence");
  for (std::size_t k = 0; k < runs.size(); ++k) {
    for (const Measure& measure : run_measures(*runs[k], c)) {
      auto here = std::find_if(quantities.begin(), quantities.end(), [&](const Quantity& q) {
        return q.measure.name == measure.name && q.measure.quantity == measure.quantity;
      });
      // What the finest run has not (a gauge that is on soil there, a bank that it cannot see) has no error.
      if (here == quantities.end() && k > 0) continue;
      if (here == quantities.end()) here = quantities.insert(quantities.end(), {measure, {}, {}});
      here->results.push_back({spacing_of(*runs[k]), measure.value});
    }
    progress.update(double(k + 1) / double(runs.size()));
  }
  for (Quantity& q : quantities) q.convergence = convergence_of(q.results);
  return quantities;
}

double at_spacing(const Quantity& q, double spacing) {
  for (const SpacingResult& r : q.results)
    if (r.spacing == spacing) return r.value;
  return no_value;
}

const char* used(const Convergence& c) { return c.use_gci ? "gci" : std::isnan(c.error) ? "none" : "spread"; }

CsvTable convergence_table(const std::vector<Quantity>& quantities, const std::vector<double>& spacings) {
  std::vector<std::string> header{"name", "quantity", "unit"};
  for (auto dp = spacings.rbegin(); dp != spacings.rend(); ++dp) header.push_back("dp_" + number_text(*dp) + "m");
  header.insert(header.end(),
                {"observed_order", "gci_percent", "richardson", "spread_percent", "error", "used", "why"});
  CsvTable table(header);
  for (const Quantity& q : quantities) {
    const Convergence& c = q.convergence;
    table.add(q.measure.name, q.measure.quantity, q.measure.unit);
    for (auto dp = spacings.rbegin(); dp != spacings.rend(); ++dp) table.add(at_spacing(q, *dp));
    table.add(c.order, 100 * c.gci, c.richardson, 100 * c.spread, c.error, std::string(used(c)), c.why);
  }
  return table;
}

ordered_json summary_json(const std::vector<Quantity>& quantities, const std::vector<double>& spacings,
                          const std::vector<std::string>& warnings) {
  ordered_json summary{{"particle_spacing_m", spacings}, {"quantities", ordered_json::array()}, {"warnings", warnings}};
  for (const Quantity& q : quantities) {
    const Convergence& c = q.convergence;
    ordered_json values = ordered_json::array();
    for (double dp : spacings) values.push_back(at_spacing(q, dp));
    summary["quantities"].push_back({{"name", q.measure.name},
                                     {"quantity", q.measure.quantity},
                                     {"unit", q.measure.unit},
                                     {"values", values},
                                     {"observed_order", c.order},
                                     {"gci_percent", 100 * c.gci},
                                     {"richardson", c.richardson},
                                     {"spread_percent", 100 * c.spread},
                                     {"error", c.error},
                                     {"used", used(c)},
                                     {"why", c.why}});
  }
  return summary;
}

int run(const Options& options, const std::string& command) {
  const auto runs = opened(options.runs);
  const RunReader& finest = *runs.front();
  const ParticleHeader& particles = finest.header().particles;
  const Case c = case_of_run(finest.header(), "the finest run", "");
  std::vector<double> spacings;
  for (const auto& run : runs) {
    check_inside(run->header().particles, c.gauges, c.sections);
    spacings.push_back(spacing_of(*run));
    LGIW_VALIDATE(options.maps.empty() || run->header().particles.crs_wkt == particles.crs_wkt,
                  "the runs differ in their CRS", "maps of them do not lie over each other",
                  "leave out --difference-maps");
  }
  LGIW_VALIDATE(options.maps.empty() || particles.dimension == 3, "--difference-maps is for 3-D runs", "these are 2-D",
                "leave it out");

  const std::string output = !options.output.empty() ? options.output : options.common.json ? "" : "-";
  ToolOutputs results("convergence", command, options.common, options.runs);
  std::vector<std::string> outputs{output, options.summary};
  if (!options.maps.empty()) {
    make_folder(options.maps);
    for (const std::string& file : difference_map_files(options.maps, runs)) outputs.push_back(file);
  }
  results.check(outputs);
  results.hash_inputs();

  const std::vector<std::string> warnings = warnings_of(runs);
  if (!options.common.quiet)
    for (const std::string& warning : warnings) std::cerr << "convergence: " << warning << "\n";
  const std::vector<Quantity> quantities = quantities_of(runs, c, options.common);
  results.write(output, convergence_table(quantities, spacings));
  if (!options.maps.empty()) write_difference_maps(options.maps, runs, c, options.common.overwrite);
  results.summarise(options.summary, summary_json(quantities, spacings, warnings));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(
      "Wave heights, run-up, volumes and run-out of runs of one case at several particle spacings: observed order,\n"
      "grid convergence index (GCI) and Richardson's value of the three finest, or their spread where they do not\n"
      "converge. Gauges, sections and threshold are those of the finest run's case.",
      "convergence");
  app.add_option("runs", options.runs, "Run files, as lgiw-run writes them, in any order")
      ->required()
      ->type_name("RUN.h5 RUN.h5 ...");
  const std::string outputs = "Outputs";
  app.add_option("-o,--output", options.output,
                 "Table with a row a quantity (CSV); stdout without -o or with -. `error` is the finest run's, in the "
                 "quantity's unit: GCI times value, or the spread; `used` and `why` say which")
      ->type_name("FILE")
      ->group(outputs);
  app.add_option("--difference-maps", options.maps,
                 "Folder for GeoTIFFs of the highest water surface, the final soil surface and the thickness of the "
                 "slide of each run minus the finest, on the coarsest map")
      ->type_name("FOLDER")
      ->group(outputs);
  app.add_option("--summary", options.summary, "The same as JSON")->type_name("FILE")->group(outputs);
  const std::string versions = std::string("GDAL ") + GDAL_RELEASE_NAME + ", HDF5 " + hdf5_version();
  add_common_options(app, options.common, versions);
  app.footer("Examples:\n  $ convergence dp20.h5 dp10.h5 dp5.h5 -o convergence.csv --difference-maps differences");
  const std::string command = command_line(argc, argv);
  return tool_main(app, argc, argv, [&] { return run(options, command); });
}
