// What every tool shares: exit codes, the one-line error form, common options, progress.
#pragma once

#include <functional>
#include <string>

#include "base/provenance.hh"

namespace CLI {
class App;
}

namespace lgiw {

struct CommonOptions {
  bool overwrite = false;       // -O, --overwrite
  bool quiet = false;           // -q
  int verbose = 0;              // -v
  bool progress = false;        // --progress: also when stderr is no terminal
  bool provenance = true;       // --no-provenance
  bool json = false;            // --json: machine-readable summary on stdout
  bool show_progress() const;   // quiet, the terminal and --progress taken together
};

/// Adds the options above and --version (with `library_versions` on the lines below the tool's own).
void add_common_options(CLI::App& app, CommonOptions& options, const std::string& library_versions);

/// Parses and runs: CLI11's ParseError -> 2 (help and version -> 0), InputError -> 2, WorkError and anything else -> 1,
/// BackendError -> 3; the message goes to stderr as `tool: message`, newlines in it turned into spaces.
int tool_main(CLI::App& app, int argc, char** argv, const std::function<int()>& run);

/// `argv` as one shell-quoted line.
std::string command_line(int argc, char** argv);

/// A progress line with ETA on stderr; rewrites itself on a terminal, one line per 10 % elsewhere.
class Progress {
 public:
  Progress(bool shown, std::string what);
  ~Progress();
  void update(double fraction, const std::string& note = "");

 private:
  bool shown_, terminal_;
  std::string what_;
  double start_, last_ = -1, last_fraction_ = -1;
};

}  // namespace lgiw
