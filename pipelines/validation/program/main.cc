// lgiw-validation: judges runs of the benchmarks against their references. See ../README.md.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>

#include "base/atomic_file.hh"
#include "base/error.hh"
#include "base/tool_main.hh"
#include "evaluate.hh"
#include "operators.hh"
#include "report.hh"
#include "study.hh"

namespace {

using namespace lgiw;
using namespace lgiw::validation;

struct Options {
  std::string case_folder, results, table, output = "-";
  std::vector<std::string> tables;
  bool quick = false, strict = false;
  CommonOptions common;
};

/// A missed bar is a result, and no failure unless the checks are strict.
int check(const Options& o) {
  const std::vector<Row> rows = evaluate(o.case_folder, o.results, o.quick);
  LGIW_VALIDATE(!rows.empty(), "nothing of " + o.case_folder + " can be judged",
                "its checks fit none of the runs in " + o.results, "make the runs first");
  write_text_file(o.output, rows_csv(rows), o.common.overwrite);
  if (!o.strict) return 0;
  return std::any_of(rows.begin(), rows.end(), [](const Row& r) { return r.judged() && !r.pass(); });
}

int study(const Options& o) {
  write_text_file(o.output, study_table(o.case_folder, o.results), o.common.overwrite);
  return 0;
}

int study_operators(const Options& o) {
  write_text_file(o.output, rows_csv(operator_rows()), o.common.overwrite);
  return 0;
}

int merge(const Options& o) {
  write_text_file(o.output, joined_tables(tables_of(o.results)), o.common.overwrite);
  if (o.output != "-" && !o.common.quiet) std::cout << summary_text(CsvFile(o.output));
  return 0;
}

int join(const Options& o) {
  write_text_file(o.output, joined_tables(o.tables), o.common.overwrite);
  return 0;
}

int tabulate(const Options& o) {
  write_text_file(o.output, markdown(CsvFile(o.table)), o.common.overwrite);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Judges runs of the benchmarks against their references.", "lgiw-validation");
  Options o;
  app.require_subcommand(1);
  app.fallthrough();
  CLI::App* check_command = app.add_subcommand("check", "one case: its checks on the runs that are there, as CSV");
  check_command->add_option("CASE", o.case_folder, "folder with runs.txt and checks.yaml")->required();
  check_command->add_option("RESULTS", o.results, "folder of the runs' folders")->required();
  check_command->add_flag("--quick", o.quick, "the runs and bars of the tests");
  check_command->add_flag("--strict", o.strict, "exit status 1 when a bar is missed");
  CLI::App* study_command = app.add_subcommand("study", "one case: error against run time of its schemes, as CSV");
  study_command->add_option("CASE", o.case_folder, "folder with study.txt and study.yaml")->required();
  study_command->add_option("RESULTS", o.results, "folder of the runs' folders")->required();
  CLI::App* operators_command = app.add_subcommand("operators", "SPH operators on disordered particles, as CSV");
  CLI::App* merge_command = app.add_subcommand("merge", "all cases: one CSV, and on stdout what is met");
  merge_command->add_option("RESULTS", o.results, "folder of the cases' results")->required();
  CLI::App* join_command = app.add_subcommand("join", "tables with the same columns as one");
  join_command->add_option("CSV", o.tables, "the tables")->required();
  CLI::App* table_command = app.add_subcommand("table", "the CSV as a Markdown table");
  table_command->add_option("CSV", o.table, "validation.csv")->required();
  app.add_option("-o,--output", o.output, "file to write; - is standard output");
  add_common_options(app, o.common, "");
  app.footer("Example: lgiw-validation check pipelines/validation/tank pipelines/out/validation/tank");
  return tool_main(app, argc, argv, [&] {
    if (check_command->parsed()) return check(o);
    if (study_command->parsed()) return study(o);
    if (operators_command->parsed()) return study_operators(o);
    if (join_command->parsed()) return join(o);
    if (merge_command->parsed()) return merge(o);
    return tabulate(o);
  });
}
