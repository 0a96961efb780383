// What the fuzz targets share. A target is a function LLVMFuzzerTestOneInput; libFuzzer calls it (LGIW_FUZZ=ON, clang),
// or replay.cc with the inputs that are kept in corpus/ (every build, ctest).
//
// A reader may refuse its input with InputError or WorkError, or read it. Whatever else it throws, ends the program.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "base/error.hh"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size);

namespace lgiw::fuzz {

/// What `read` does is in order when it returns or refuses.
template <class F>
bool accepted(const F& read) {
  try {
    read();
    return true;
  } catch (const InputError&) {
  } catch (const WorkError&) {
  }
  return false;
}

/// A folder in memory, of this process; gone with it.
class Folder {
 public:
  Folder() {
    const std::string place = std::filesystem::is_directory("/dev/shm") ? "/dev/shm" : "/tmp";
    folder_ = place + "/lgiw-fuzz-" + std::to_string(getpid());
    std::filesystem::create_directories(folder_);
  }
  ~Folder() { std::filesystem::remove_all(folder_); }
  std::string operator/(const std::string& name) const { return folder_ + "/" + name; }

 private:
  std::string folder_;
};

inline void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc).write(bytes.data(), std::streamsize(bytes.size()));
}

inline std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The input as a script: numbers and texts one after the other, zeros behind its end.
class Script {
 public:
  Script(const uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool done() const { return at_ >= size_; }
  uint8_t byte() { return at_ < size_ ? data_[at_++] : 0; }
  uint64_t number(std::size_t bytes = 8) {
    uint64_t n = 0;
    for (std::size_t k = 0; k < bytes; ++k) n |= uint64_t(byte()) << (8 * k);
    return n;
  }
  double real() {
    // Mostly numbers that mean something.
    static const double some[] = {0, 1, -1, 2, 3, 0.5, 1e-300, 1e300, -1e300, 4e18, 1e12, 1e13, -0.0, 255, 256};
    const uint8_t choice = byte();
    if (choice < 15) return some[choice];
    if (choice < 128) return double(int8_t(byte())) / 8;
    const uint64_t bits = number();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  std::string text(std::size_t most = 64) {
    std::string t;
    for (std::size_t n = byte() % (most + 1); n > 0 && !done(); --n) t += char(byte());
    return t;
  }
  std::string rest() {
    std::string t(reinterpret_cast<const char*>(data_) + (at_ < size_ ? at_ : size_), at_ < size_ ? size_ - at_ : 0);
    at_ = size_;
    return t;
  }

 private:
  const uint8_t* data_;
  std::size_t size_, at_ = 0;
};

}  // namespace lgiw::fuzz
