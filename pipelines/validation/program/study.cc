#include "study.hh"

#include <filesystem>
#include <map>

#include "base/error.hh"
#include "evaluate.hh"
#include "files/csv_table.hh"
#include "measure/convergence.hh"
#include "measure/norms.hh"
#include "measures.hh"
#include "series.hh"

namespace lgiw::validation {
namespace {

const std::vector<std::string> columns{"case",
                                       "scheme",
                                       "particles",
                                       "dp_m",
                                       "h_over_dp",
                                       "kernel",
                                       "integrator",
                                       "cfl",
                                       "precision",
                                       "device",
                                       "threads",
                                       "steps",
                                       "physical_time_s",
                                       "wall_time_s",
                                       "particle_steps_per_s",
                                       "peak_memory_bytes",
                                       "norm",
                                       "error",
                                       "lag_s",
                                       "nrmse",
                                       "willmott_d",
                                       "observed_order",
                                       "gci"};

std::string precision_name(Precision p) {
  return p == Precision::single_ ? "single" : p == Precision::double_ ? "double" : "mixed";
}

}  // namespace

std::string study_table(const std::string& case_folder, const std::string& results_folder) {
  const std::string path = case_folder + "/study.yaml";
  YAML::Node study;
  try {
    study = YAML::LoadFile(path);
  } catch (const YAML::Exception& e) {
    throw InputError(path + " is no study", e.what(), "see validation/README.md");
  }
  const std::string name = std::filesystem::path(case_folder).lexically_normal().filename().string();
  const std::vector<Run> runs = load_runs(case_folder, results_folder, "study.txt");
  LGIW_VALIDATE(!runs.empty(), results_folder + " holds no run of the study", "there is nothing to compare",
                "run make -C pipelines error-vs-time");
  std::map<std::string, std::vector<SpacingResult>> results;
  std::vector<Judgement> errors;
  for (const Run& run : runs) {
    const Keys norm(study["norm"], case_folder, path + ": norm", run.series());
    errors.push_back(judge(run, norm));
    results[run.series()].push_back({run.dp(), errors.back().measured});
  }
  CsvTable table(columns);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Run& run = runs[k];
    const Numerics& n = run.c.numerics;
    SeriesNorms norms;
    norms.phase_lag = norms.nrmse = norms.willmott_d = missing;
    if (study["series"]) norms = reference_norms(run, Keys(study["series"], case_folder, path + ": series"));
    bool finest = true;
    for (const SpacingResult& r : results[run.series()]) finest = finest && r.spacing >= run.dp();
    Convergence convergence;
    convergence.order = convergence.gci = missing;
    if (finest) convergence = convergence_of(results[run.series()]);
    table.add(name, run.series(), double(run.particles()), run.dp(), n.h_over_dp,
              std::string(n.kernel == KernelName::cubic ? "cubic" : "wendland"),
              std::string(n.integrator == Integrator::verlet ? "verlet" : "leapfrog"), n.cfl,
              precision_name(n.precision), run.summary.value("device", std::string("CPU")),
              run.summary.value("threads", 0.0), double(run.steps()), run.summary.value("end_time_s", 0.0),
              run.wall_time(), run.summary.value("particle_steps_per_s", 0.0),
              run.summary.value("peak_memory_bytes", missing), study["norm"]["quantity"].as<std::string>(),
              errors[k].error, norms.phase_lag, norms.nrmse, norms.willmott_d, convergence.order,
              convergence.use_gci ? convergence.gci : missing);
  }
  return table.text();
}

}  // namespace lgiw::validation
