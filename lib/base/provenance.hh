// Where a result comes from: program, version, command line, inputs and their SHA-256.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace lgiw {

struct Provenance {
  std::string tool;
  std::string version;  // "0.1.0 (git hash)"
  std::string command_line;
  std::vector<std::pair<std::string, std::string>> inputs;  // (path as given, SHA-256 in hex; empty: a pipe)
  bool enabled = true;                                      // false with --no-provenance: reruns compare byte by byte

  /// Hashes the file now; only its name when disabled. What comes through a pipe ("-": stdin) is named, with null for its
  /// hash.
  void add_input(const std::string& path);
  void add_text(const std::string& name, const std::string& text);
  std::string to_json() const;  // "{}" when disabled
};

/// Project version and git hash of the build: "0.1.0 (git 1a2b3c4)", "0.1.0 (no git)" when built outside a clone.
std::string version_string();
std::string sha256_of_file(const std::string& path);  // throws InputError when it cannot be read
/// Of the first `size` bytes.
std::string sha256_of_start(const std::string& path, uint64_t size);
std::string sha256_of_text(const std::string& text);

}  // namespace lgiw
