// Times the innermost functions of the solver with Google Benchmark, for every instruction set that build and processor
// have. Items are particles, pairs or candidates.
#include <benchmark/benchmark.h>

#include <cstring>
#include <string>
#include <utility>

#include "kernels.hh"
#include "solver/simulation.hh"

namespace {

int lanes_of(const std::string& name) { return name == "avx512" ? 16 : (name == "avx2" ? 8 : 4); }

template <int... lanes>
void register_possible(std::integer_sequence<int, lanes...>) {
  for (const std::string& set : lgiw::cpu_instruction_sets())
    ((lanes == lanes_of(set) ? lgiw::register_kernels<lanes>(set.c_str()) : void()), ...);
}

/// A benchmark that found its own results wrong ends the program with 1.
class Watching : public benchmark::ConsoleReporter {
 public:
  Watching() : ConsoleReporter(OO_Tabular) {}
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) failed = failed || run.error_occurred;
    ConsoleReporter::ReportRuns(runs);
  }
  bool failed = false;
};

}  // namespace

int main(int argc, char** argv) {
  register_possible(std::integer_sequence<int, LGIW_CPU_LANES>{});
  lgiw::register_sort();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Watching console;
  benchmark::RunSpecifiedBenchmarks(&console);
  return console.failed ? 1 : 0;
}
