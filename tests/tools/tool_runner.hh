// Runs the built tools as a user does, in a folder of its own, and keeps what they say.
#pragma once

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#include "gtest/gtest.h"

namespace lgiw::test {

namespace fs = std::filesystem;

inline std::string read_bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

struct Outcome {
  int status = -1;
  std::string out, err;
};

/// A temporary folder in which commands run; gone with the object.
class Workshop {
 public:
  Workshop() {
    std::string name = (fs::temp_directory_path() / "lgiw-test-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("mkdtemp failed");
    folder_ = name;
  }
  ~Workshop() { fs::remove_all(folder_); }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;

  fs::path operator/(const std::string& name) const { return folder_ / name; }

  /// `command` is a line of shell whose first word is a tool; two threads, so that results are the same everywhere.
  Outcome run(const std::string& command) const {
    const fs::path out = folder_ / ".stdout", err = folder_ / ".stderr";
    const std::string line = "cd '" + folder_.string() +
                             "' && OMP_NUM_THREADS=2 PATH='" LGIW_BIN_DIR "':\"$PATH\" && export OMP_NUM_THREADS && " +
                             command + " </dev/null >.stdout 2>.stderr";
    const int status = std::system(line.c_str());
    Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_bytes(out), read_bytes(err)};
    fs::remove(out), fs::remove(err);
    return outcome;
  }

  /// Every file below the folder with its bytes.
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
      files[fs::relative(entry.path(), folder_).string()] = entry.is_regular_file() ? read_bytes(entry.path()) : "";
    return files;
  }

 private:
  fs::path folder_;
};

/// Expects exit 0 and, since the tools are run with -q, silence on stderr.
inline void expect_quiet_success(const Outcome& outcome, const std::string& command) {
  EXPECT_EQ(outcome.status, 0) << command << "\n" << outcome.err;
  EXPECT_EQ(outcome.err, "") << command;
}

}  // namespace lgiw::test
