// What the measuring tools share: options, the check of their outputs before any work, provenance, writing.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/provenance.hh"
#include "base/tool_main.hh"
#include "files/csv_table.hh"

namespace lgiw {

/// Makes `folder` where it is missing. Throws InputError when it cannot be made.
void make_folder(const std::string& folder);

/// Options of every tool that measures one run.
struct MeasuringOptions {
  std::string run, case_file, output, summary, compare_output;
  std::vector<std::string> compare;
  CommonOptions common;

  /// Where the comparison goes: stdout unless told otherwise; nowhere without one, or when the JSON takes stdout.
  std::string comparison_output() const;
};

/// The run, --case (which takes `from_case` from another case file), --summary with `summary`, --compare with `compare`
/// and --compare-output.
void add_measuring_options(CLI::App& app, MeasuringOptions& options, const std::string& from_case,
                           const std::string& summary, const std::string& compare);

/// The outputs of one call and where they come from.
class ToolOutputs {
 public:
  /// Names that are empty or "-" are no files and are passed over.
  ToolOutputs(const std::string& tool, const std::string& command, const CommonOptions& common,
              const std::vector<std::string>& inputs);
  /// check_outputs() with what was given here.
  void check(const std::vector<std::string>& outputs) const;
  /// Hashes the inputs, for --no-provenance nothing; throws InputError where one cannot be read.
  void hash_inputs();

  const Provenance& provenance() const { return provenance_; }
  /// Nothing where `path` is empty.
  void write(const std::string& path, const CsvTable& table) const;
  /// The summary with its provenance, to `path` and with --json to stdout.
  void summarise(const std::string& path, nlohmann::ordered_json summary) const;

 private:
  CommonOptions common_;
  std::vector<std::string> inputs_;
  Provenance provenance_;
};

/// "1.10.8".
std::string hdf5_version();

}  // namespace lgiw
