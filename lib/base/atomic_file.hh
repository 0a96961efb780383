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
  /// As commit(), with the file that has the name now kept as `previous`. At any moment there is a whole file at
  /// path(), where the file system can exchange names; elsewhere it lacks for a moment, in which `previous` is there.
  void commit_keeping(const std::string& previous);

 private:
  [[noreturn]] void fail(const std::string& why) const;
  std::string path_, temporary_;
  bool overwrite_;
  bool committed_ = false;
};

/// Removes the temporary files that killed processes left of an AtomicFile of `path`. Only where none is being written.
void remove_abandoned(const std::string& path);

/// Renames a file; false with errno set when that fails, which is EEXIST where `to` exists and `overwrite` is false.
bool rename_file(const std::string& from, const std::string& to, bool overwrite);

/// Brings renamed and removed names in the folder of `path` to the disk, where its file system can do that.
void sync_folder_of(const std::string& path);

/// Writes `text` to `path` through an AtomicFile; "-" is stdout.
void write_text_file(const std::string& path, const std::string& text, bool overwrite);

}  // namespace lgiw
