#include "run.hh"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hh"

namespace lgiw::validation {
namespace {

template <class Time>
std::size_t nearest(std::size_t n, double time, const Time& time_of) {
  if (!std::isfinite(time)) return n - 1;
  std::size_t best = 0;
  for (std::size_t k = 1; k < n; ++k)
    if (std::abs(time_of(k) - time) < std::abs(time_of(best) - time)) best = k;
  return best;
}

}  // namespace

std::string Run::series() const {
  const std::size_t hyphen = name.rfind('-');
  return hyphen == std::string::npos ? "" : name.substr(0, hyphen);
}

std::size_t Run::particles() const {
  std::size_t n = 0;
  for (const char* phase : {"water", "soil", "wall"}) n += summary.at("particles").value(phase, std::size_t(0));
  return n;
}

std::size_t Run::frame_index(double time) const {
  return nearest(file->frame_count(), time, [&](std::size_t k) { return file->frame_time(k); });
}
std::size_t Run::surface_index(double time) const {
  return nearest(file->surface_times().size(), time, [&](std::size_t k) { return file->surface_times()[k]; });
}
Frame Run::frame_at(double time) const { return file->frame(frame_index(time)); }

std::vector<Run> load_runs(const std::string& case_folder, const std::string& results_folder, const std::string& list) {
  std::ifstream in(case_folder + "/" + list);
  LGIW_VALIDATE(in.good(), case_folder + "/" + list + " cannot be read", "it names the runs of the case",
                "name a folder of validation/");
  std::vector<Run> runs;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    Run run;
    std::string levels;
    if (line.empty() || line[0] == '#' || !(words >> run.name >> levels)) continue;
    run.folder = results_folder + "/" + run.name;
    run.quick = levels == "quick";
    std::ifstream json(run.folder + "/run.json");
    if (!json.good() || !std::filesystem::exists(run.folder + "/run.h5")) continue;
    run.summary = nlohmann::json::parse(json);
    run.file = std::make_shared<const RunReader>(run.folder + "/run.h5");
    run.c = parse_case(run.header().particles.case_text, run.folder + "/run.h5 (case)");
    runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace lgiw::validation
