// What the tests of this room share: a folder of their own, whole files as text, the text of an error, small scenes.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "base/error.hh"
#include "files/run_file.hh"
#include "small_scene.hh"

namespace lgiw {

/// A folder that goes with the test.
class Scratch {
 public:
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "lgiw-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~Scratch() { std::filesystem::remove_all(folder_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  std::string operator/(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

inline std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

/// The file beside the one that h5::File has open, for what h5::File does not offer.
inline h5::Handle raw_file(const std::string& path, unsigned flags) {
  const h5::Handle access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_file_locking(access.id(), false, true);
  return h5::Handle(H5Fopen(path.c_str(), flags, access.id()));
}

inline void remove_object(const h5::File& file, const std::string& name) {
  const h5::Handle same = raw_file(file.path(), H5F_ACC_RDWR);
  ASSERT_GE(H5Ldelete(same.id(), name.c_str(), H5P_DEFAULT), 0);
}

/// While it lives, leaks are not counted: HDF5 1.10 itself loses memory where it refuses damaged metadata.
struct LeaksOfHdf5 {
#ifdef __SANITIZE_ADDRESS__
  __lsan::ScopedDisabler disabler;
#endif
  LeaksOfHdf5() {}
};

/// The message of the `Error` that `work` throws, with `path` in it replaced by FILE.
template <class Error, class Work>
std::string error_of(const std::string& path, Work work) {
  try {
    work();
  } catch (const Error& error) {
    std::string text = error.what();
    for (std::size_t at; (at = text.find(path)) != std::string::npos;) text.replace(at, path.size(), "FILE");
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text;
  }
  return "no error";
}

}  // namespace lgiw
