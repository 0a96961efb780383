// A sweep: one case run with several values of its keys. docs/sweep.md describes the file.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace lgiw {

/// One run of a sweep.
struct SweepRun {
  std::string name;                    // of a folder: "friction_angle=28,level=740", or what the sweep calls it
  std::vector<std::string> inputs;     // the values of Sweep::keys, as YAML on one line; "" where the case has none
  std::vector<std::string> overrides;  // key.sub=value, as for --set
  std::string case_text;               // of the case as it is run; without its comments
};

struct Sweep {
  std::vector<std::string> keys;  // that differ between runs, dotted
  std::vector<SweepRun> runs;
};

/// Reads the sweep at `path`, whose runs are those of the case at `case_path` with `overrides` (--set) and then their
/// own. All combinations of its lists and of its `runs`. Every run is checked as a case is. Throws InputError with
/// `path:line:` in front, also where it is a case that a value makes unsound. Opens no other file.
Sweep read_sweep(const std::string& path, const std::string& case_path, const std::vector<std::string>& overrides = {});
Sweep parse_sweep(const std::string& text, const std::string& name_for_messages, const std::string& case_text,
                  const std::string& case_name_for_messages, const std::vector<std::string>& overrides = {});

}  // namespace lgiw
