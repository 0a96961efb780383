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
  bool overwrite = false;      // -O, --overwrite
  bool quiet = false;          // -q, --quiet
  int verbose = 0;             // -v, --verbose
  bool progress = false;       // --progress: also when stderr is no terminal
  bool provenance = true;      // --no-provenance
  bool json = false;           // --json: machine-readable summary on stdout
  bool show_progress() const;  // quiet, the terminal and --progress taken together
};

/// Adds the options above and --version (with `library_versions` on the lines below the tool's own).
void add_common_options(CLI::App& app, CommonOptions& options, const std::string& library_versions);

/// Parses and runs: CLI11's ParseError -> 2 (help and version -> 0), InputError -> 2, WorkError and anything else -> 1,
/// BackendError -> 3; the message goes to stderr as `tool: message`, newlines in it turned into spaces. `run`'s own
/// return value is passed on, but becomes 1 when what it wrote to stdout did not arrive. The tool's name is the App's;
/// its example is the App's footer.
int tool_main(CLI::App& app, int argc, char** argv, const std::function<int()>& run);

/// `argv` as one shell-quoted line.
std::string command_line(int argc, char** argv);

/// "47 s", "3 min 05 s", "2 h 07 min", "3 d 04 h".
std::string format_duration(double seconds);

/// "what  42 %  ETA 3 min 05 s  note"; no ETA before 1 % or two seconds, "done in 4 min 10 s" at the end.
std::string progress_line(const std::string& what, double fraction, double elapsed_seconds, const std::string& note);

/// A progress line with ETA on stderr; rewrites itself on a terminal, one line per 10 % elsewhere.
class Progress {
 public:
  Progress(bool shown, std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void update(double fraction, const std::string& note = "");

 private:
  bool shown_, terminal_;
  std::string what_;
  double start_, last_ = -1, last_fraction_ = -1;
};

}  // namespace lgiw
