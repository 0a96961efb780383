#include "base/atomic_file.hh"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <system_error>
#include <utility>
#include <vector>

#include "base/error.hh"

namespace lgiw {
namespace {

std::string folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

/// Brings what was written to `path` (a file or a folder) to the disk; false with errno set when that fails.
bool sync_to_disk(const std::string& path, int flags) {
  const int descriptor = open(path.c_str(), flags | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool synced = fsync(descriptor) == 0;
  const int error = errno;
  const bool closed = close(descriptor) == 0;
  if (!synced) errno = error;
  return synced && closed;
}

}  // namespace

AtomicFile::AtomicFile(std::string path, bool overwrite) : path_(std::move(path)), overwrite_(overwrite) {
  LGIW_VALIDATE(!path_.empty(), "the output has no name", "a file cannot be written without one",
                "name it with -o OUTPUT");
  struct stat status;
  if (lstat(path_.c_str(), &status) == 0) {
    // stat, not lstat, tells a link to a regular file from a link to a device.
    const bool regular = stat(path_.c_str(), &status) == 0 && S_ISREG(status.st_mode);
    LGIW_VALIDATE(regular, path_ + " is not a regular file", "an output replaces what has its name",
                  "choose another name");
    LGIW_VALIDATE(overwrite_, path_ + " exists", "it would be overwritten",
                  "pass -O/--overwrite or choose another name");
  }
  const std::filesystem::path target(path_);
  const std::string suffix = target.extension().string();
  std::string name = folder_of(path_) + "/." + target.stem().string() + "-XXXXXX" + suffix;
  const int descriptor = mkstemps(name.data(), static_cast<int>(suffix.size()));
  LGIW_VALIDATE(descriptor >= 0, path_ + " cannot be written", folder_of(path_) + ": " + std::strerror(errno),
                "create the folder or choose one that you may write to");
  close(descriptor);
  unlink(name.c_str());
  temporary_ = name;
}

AtomicFile::~AtomicFile() {
  if (!committed_) unlink(temporary_.c_str());
}

void AtomicFile::fail(const std::string& why) const {
  throw WorkError(path_ + " was not written", why, "make room or mend the folder, then run again");
}

void AtomicFile::commit() {
  if (!sync_to_disk(temporary_, O_RDWR)) fail(std::strerror(errno));
  const bool renamed = rename_file(temporary_, path_, overwrite_);
  if (!renamed && errno == EEXIST)
    throw WorkError(path_ + " was not written", "another program created it meanwhile",
                    "pass -O/--overwrite or choose another name");
  if (!renamed) fail(std::strerror(errno));
  committed_ = true;
  // The content is safe and visible; a file system that cannot sync a folder is no reason to fail.
  sync_folder_of(path_);
}

void AtomicFile::commit_keeping(const std::string& previous) {
  if (!sync_to_disk(temporary_, O_RDWR)) fail(std::strerror(errno));
  if (renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, path_.c_str(), RENAME_EXCHANGE) == 0) {
    // What was temporary is now the old file.
    committed_ = true;
    if (std::rename(temporary_.c_str(), previous.c_str()) != 0) fail(std::strerror(errno));
    sync_folder_of(path_);
    return;
  }
  if (access(path_.c_str(), F_OK) == 0 && std::rename(path_.c_str(), previous.c_str()) != 0) fail(std::strerror(errno));
  commit();
}

void remove_abandoned(const std::string& path) {
  const std::filesystem::path target(path);
  const std::string start = "." + target.stem().string() + "-", suffix = target.extension().string();
  std::error_code none;
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder_of(path), none)) {
    const std::string name = entry.path().filename().string();
    const std::size_t end = start.size() + 6;  // mkstemps: six letters or digits
    if (name.size() < end || name.compare(0, start.size(), start) != 0 ||
        !std::all_of(name.begin() + long(start.size()), name.begin() + long(end),
                     [](unsigned char c) { return std::isalnum(c); }))
      continue;
    const std::string rest = name.substr(end);
    if ((rest == suffix || rest == suffix + ".journal") && entry.is_regular_file(none)) found.push_back(entry.path());
  }
  for (const auto& file : found) std::filesystem::remove(file, none);
}

bool rename_file(const std::string& from, const std::string& to, bool overwrite) {
  if (overwrite) return std::rename(from.c_str(), to.c_str()) == 0;
  if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return true;
  if (errno != EINVAL && errno != ENOSYS) return false;  // which file systems that do not know the flag answer
  if (access(to.c_str(), F_OK) == 0) return errno = EEXIST, false;
  return std::rename(from.c_str(), to.c_str()) == 0;
}

void sync_folder_of(const std::string& path) { sync_to_disk(folder_of(path), O_RDONLY | O_DIRECTORY); }

void write_text_file(const std::string& path, const std::string& text, bool overwrite) {
  if (path == "-") {
    std::cout << text << std::flush;
    if (!std::cout)
      throw WorkError("stdout was not written", std::strerror(errno), "check the pipe or the disk behind it");
    return;
  }
  AtomicFile file(path, overwrite);
  std::FILE* stream = std::fopen(file.temporary().c_str(), "wb");
  const bool written = stream && std::fwrite(text.data(), 1, text.size(), stream) == text.size();
  const bool closed = stream && std::fclose(stream) == 0;
  if (!written || !closed)
    throw WorkError(path + " was not written", std::strerror(errno), "make room on the disk, then run again");
  file.commit();
}

}  // namespace lgiw
