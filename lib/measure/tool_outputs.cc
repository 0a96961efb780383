#include "measure/tool_outputs.hh"

#include <hdf5.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/atomic_file.hh"
#include "base/check_outputs.hh"
#include "base/error.hh"

namespace lgiw {

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  LGIW_VALIDATE(std::filesystem::is_directory(folder), folder + " cannot be made a folder",
                error ? error.message() : "a file has that name", "name another folder");
}

std::string MeasuringOptions::comparison_output() const {
  return !compare_output.empty() ? compare_output : compare.empty() || common.json ? "" : "-";
}

void add_measuring_options(CLI::App& app, MeasuringOptions& options, const std::string& from_case,
                           const std::string& summary, const std::string& compare) {
  app.add_option("run", options.run, "Run file, as lgiw-run writes it")->required()->type_name("RUN.h5");
  app.add_option("--case", options.case_file, "Take " + from_case + " from this case file, not from the run's own case")
      ->type_name("FILE")
      ->group("What is measured");
  auto* comparing = app.add_option("--compare", options.compare, compare)
                        ->type_name("FILE")
                        ->allow_extra_args(false)
                        ->group("Comparison with measurements");
  app.add_option("--compare-output", options.compare_output, "The comparison as CSV; stdout without it or with -")
      ->type_name("FILE")
      ->needs(comparing)
      ->group("Comparison with measurements");
  app.add_option("--summary", options.summary, summary)->type_name("FILE")->group("Outputs");
}

ToolOutputs::ToolOutputs(const std::string& tool, const std::string& command, const CommonOptions& common,
                         const std::vector<std::string>& inputs)
    : common_(common) {
  for (const std::string& input : inputs)
    if (!input.empty() && input != "-") inputs_.push_back(input);
  provenance_.enabled = common.provenance;
  provenance_.tool = tool;
  provenance_.version = version_string();
  provenance_.command_line = command;
}

void ToolOutputs::check(const std::vector<std::string>& outputs) const {
  check_outputs(outputs, inputs_, common_.overwrite, common_.json);
}

void ToolOutputs::hash_inputs() {
  for (const std::string& input : inputs_) provenance_.add_input(input);
}

void ToolOutputs::write(const std::string& path, const CsvTable& table) const {
  const std::string comment = provenance_.enabled ? "provenance: " + provenance_.to_json() : "";
  if (!path.empty()) write_text_file(path, table.text(comment), common_.overwrite);
}

void ToolOutputs::summarise(const std::string& path, nlohmann::ordered_json summary) const {
  if (provenance_.enabled)
    summary["provenance"][provenance_.tool] = nlohmann::ordered_json::parse(provenance_.to_json());
  if (!path.empty()) write_text_file(path, summary.dump(2) + "\n", common_.overwrite);
  if (common_.json) std::cout << summary.dump(2) << "\n";
}

std::string hdf5_version() {
  return std::to_string(H5_VERS_MAJOR) + "." + std::to_string(H5_VERS_MINOR) + "." + std::to_string(H5_VERS_RELEASE);
}

}  // namespace lgiw
