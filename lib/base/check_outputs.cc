#include "base/check_outputs.hh"

#include <filesystem>
#include <set>
#include <system_error>

#include "base/atomic_file.hh"
#include "base/error.hh"

namespace lgiw {

void check_outputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs, bool overwrite,
                   bool stdout_taken) {
  namespace fs = std::filesystem;
  std::set<std::string> names;
  for (const std::string& output : outputs) {
    if (output.empty()) continue;
    if (output == "-") {
      LGIW_VALIDATE(!stdout_taken, "two outputs go to stdout", "they would be mixed",
                    "name a file for all but one of them");
      stdout_taken = true;
      continue;
    }
    std::error_code unknown;  // of a folder that cannot be looked into; AtomicFile will tell
    const fs::path resolved = fs::weakly_canonical(fs::absolute(output), unknown);
    LGIW_VALIDATE(names.insert((unknown ? fs::absolute(output).lexically_normal() : resolved).string()).second,
                  output + " is named twice", "two outputs cannot share a file", "choose another name for one of them");
    for (const std::string& input : inputs) {
      std::error_code none;  // of a file that does not exist
      LGIW_VALIDATE(!fs::equivalent(output, input, none), output + " is an input", "it would be overwritten",
                    "choose another name for the output");
    }
    const AtomicFile probe(output, overwrite);
  }
}

}  // namespace lgiw
