// Output files that are either whole or absent.
#pragma once

#include <string>

namespace lgiw {

/// Names a temporary file beside `path`, and renames it to `path` on commit() after an fsync.
/// Throws InputError from the constructor when `path` exists and `overwrite` is false, when it is no regular file (a
/// folder, /dev/null), or when its folder cannot be written, so that a tool can create it before any work starts. The
/// temporary file itself does not exist yet: some writers refuse an existing one. Unless committed, the destructor
/// removes it; a failed commit() throws WorkError and leaves an older file at `path` as it was.
class AtomicFile {
 public:
  AtomicFile(std::string path, bool overwrite);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::string& path() const { return path_; }
  /// Same folder; keeps the extension of `path` last, since GDAL's drivers go by it. Hidden, so that no glob finds it.
  const std::string& temporary() const { return temporary_; }
  void commit();

 private:
  std::string path_, temporary_;
  bool overwrite_;
  bool committed_ = false;
};

/// Writes `text` to `path` through an AtomicFile; "-" is stdout.
void write_text_file(const std::string& path, const std::string& text, bool overwrite);

}  // namespace lgiw
