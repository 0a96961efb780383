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

/// 2 of water, 1 of soil, 2 of wall in a box 10 m long, 5 m wide, 4 m high.
inline ParticleHeader small_header() {
  ParticleHeader header;
  header.dp = 0.5;
  header.origin = {400000.25, 3800000.5, 700};
  header.crs_wkt = "PROJCRS[\"WGS 84 / UTM zone 11N\"]";
  header.vertical_datum = "EGM96";
  header.still_water_level = 2.25;
  header.low = {0, 0, 0};
  header.high = {10, 5, 4};
  header.sides = {Side::wall, Side::absorbing, Side::open, Side::wall};
  header.absorbing_width = 1.5;
  header.bed = {3, 2, -1, -0.5, 6, {0.1, 0.2, NAN, 0.4, 0.5, 0.6}};
  header.ground = {3, 2, -1, -0.5, 6, {1, 2, NAN, 4, 5, 6}};
  header.case_text = "name: Gro\xC3\x9F\n";
  header.provenance = "{}";
  header.counts = {2, 1, 2, 17};
  return header;
}

inline ParticleBlock small_water() {
  return {Phase::water, {0, 0, 0, 10, 5, 4}, {0.125f, 0.25f}, {1000, 1001}, {9810, 0}, {}, {}, {}};
}
inline ParticleBlock small_soil() {
  return {Phase::soil, {1, 2, 3}, {0.5f}, {2000}, {5}, {-1, -2, -3, 0.5f, 0.25f, 0}, {}, {}};
}
inline ParticleBlock small_wall() {
  return {Phase::wall, {1, 1, -0.5, -0.5, 2, 1}, {0.125f, 0.125f}, {1000, 1000}, {0, 1}, {}, {0, 0, 1, 0.6f, 0, 0.8f},
          {0, 1}};
}

inline void write_small_particles(const std::string& path) {
  ParticleWriter writer(path, small_header());
  writer.append(small_water());
  writer.append(small_soil());
  writer.append(small_wall());
  writer.finish();
}

}  // namespace lgiw
