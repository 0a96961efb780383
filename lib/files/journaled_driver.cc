#include "files/journaled_driver.hh"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <system_error>
#include <vector>

#include "base/error.hh"
#include "base/provenance.hh"

namespace lgiw::h5 {
namespace {

const std::string magic = "lgiw journal 1\n";
constexpr std::size_t digest_length = 64;  // SHA-256 in hexadecimal

[[noreturn]] void fail() { throw std::system_error(errno, std::generic_category()); }

void write_all(int descriptor, const char* data, std::size_t size, haddr_t at) {
  while (size > 0) {
    const ssize_t n = pwrite(descriptor, data, size, off_t(at));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail();
    if (n == 0) errno = ENOSPC, fail();
    data += n, size -= std::size_t(n), at += haddr_t(n);
  }
}

/// Zeros beyond the end of the file.
void read_all(int descriptor, char* data, std::size_t size, haddr_t at) {
  while (size > 0) {
    const ssize_t n = pread(descriptor, data, size, off_t(at));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail();
    if (n == 0) {
      std::memset(data, 0, size);
      return;
    }
    data += n, size -= std::size_t(n), at += haddr_t(n);
  }
}

void sync(int descriptor) {
  if (fsync(descriptor) != 0) fail();
}

class Descriptor {
 public:
  Descriptor(const std::string& path, int flags) : id_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (id_ < 0) fail();
  }
  ~Descriptor() { close(id_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return id_; }

 private:
  int id_;
};

/// Bytes by their place in a file; pieces do not overlap.
class Pieces {
 public:
  void put(haddr_t at, const char* data, std::size_t size) {
    cut(at, size);
    pieces_[at].assign(data, data + size);
  }
  /// Forgets what lies in [at, at + size).
  void cut(haddr_t at, std::size_t size) {
    const haddr_t end = at + size;
    auto it = pieces_.lower_bound(at);
    if (it != pieces_.begin()) {
      auto before = std::prev(it);
      const haddr_t its_end = before->first + before->second.size();
      if (its_end > end) pieces_[end].assign(before->second.end() - long(its_end - end), before->second.end());
      if (its_end > at) before->second.resize(at - before->first);
    }
    while (it != pieces_.end() && it->first < end) {
      const haddr_t its_end = it->first + it->second.size();
      if (its_end > end) pieces_[end].assign(it->second.end() - long(its_end - end), it->second.end());
      it = pieces_.erase(it);
    }
  }
  /// Writes what is here over `data`, the bytes of the file at [at, at + size).
  void overlay(haddr_t at, char* data, std::size_t size) const {
    const haddr_t end = at + size;
    auto it = pieces_.upper_bound(at);
    if (it != pieces_.begin()) --it;
    for (; it != pieces_.end() && it->first < end; ++it) {
      const haddr_t low = std::max(at, it->first), high = std::min<haddr_t>(end, it->first + it->second.size());
      if (low < high) std::memcpy(data + (low - at), it->second.data() + (low - it->first), high - low);
    }
  }
  bool empty() const { return pieces_.empty(); }
  void clear() { pieces_.clear(); }
  auto begin() const { return pieces_.begin(); }
  auto end() const { return pieces_.end(); }

 private:
  std::map<haddr_t, std::vector<char>> pieces_;
};

/// Magic, size of the file, count of pieces; place, size and bytes of each; digest of all that.
std::string journal_text(haddr_t file_size, const Pieces& pieces) {
  std::string text = magic;
  const auto number = [&text](uint64_t n) { text.append(reinterpret_cast<const char*>(&n), sizeof n); };
  number(file_size);
  number(uint64_t(std::distance(pieces.begin(), pieces.end())));
  for (const auto& [at, bytes] : pieces) {
    number(at);
    number(bytes.size());
    text.append(bytes.data(), bytes.size());
  }
  return text + sha256_of_text(text);
}

/// False when `text` is no whole journal.
bool parse_journal(const std::string& text, haddr_t& file_size, Pieces& pieces) {
  if (text.size() < magic.size() + digest_length || text.compare(0, magic.size(), magic) != 0) return false;
  const std::size_t end = text.size() - digest_length;
  if (sha256_of_text(text.substr(0, end)) != text.substr(end)) return false;
  std::size_t at = magic.size();
  bool sound = true;
  const auto number = [&] {
    uint64_t n = 0;
    sound = sound && end - at >= sizeof n;
    if (sound) std::memcpy(&n, text.data() + at, sizeof n), at += sizeof n;
    return n;
  };
  file_size = number();
  const uint64_t count = number();
  for (uint64_t k = 0; sound && k < count; ++k) {
    const uint64_t place = number(), size = number();
    // A sum that wraps would put bytes where there is no memory.
    sound = sound && size <= end - at && place <= uint64_t(std::numeric_limits<off_t>::max()) - size;
    if (sound) pieces.put(place, text.data() + at, size), at += size;
  }
  return sound && at == end;
}

void apply(int descriptor, haddr_t file_size, const Pieces& pieces) {
  for (const auto& [at, bytes] : pieces) write_all(descriptor, bytes.data(), bytes.size(), at);
  if (ftruncate(descriptor, off_t(file_size)) != 0) fail();
  sync(descriptor);
}

struct JournaledFile {
  H5FD_t base{};  // first: HDF5 sees only this
  int descriptor = -1;
  std::shared_ptr<Journal> journal;
  haddr_t end_of_allocation = 0, end_of_file = 0;
  Pieces pending;

  void commit() {
    sync(descriptor);  // raw data before what refers to them
    {
      const std::string text = journal_text(end_of_allocation, pending);
      const Descriptor log(journal->path, O_WRONLY | O_CREAT | O_TRUNC);
      write_all(log, text.data(), text.size(), 0);
      sync(log);
    }
    apply(descriptor, end_of_allocation, pending);
    if (unlink(journal->path.c_str()) != 0) fail();
    pending.clear();
    end_of_file = end_of_allocation;
  }
};

JournaledFile& of(H5FD_t* file) { return *reinterpret_cast<JournaledFile*>(file); }
const JournaledFile& of(const H5FD_t* file) { return *reinterpret_cast<const JournaledFile*>(file); }

/// Runs a callback of HDF5's: what it throws becomes an entry of HDF5's error stack.
template <class F>
herr_t guarded(const char* what, const F& f) {
  try {
    f();
    return 0;
  } catch (const std::system_error& e) {
    H5Epush2(H5E_DEFAULT, __FILE__, what, __LINE__, H5E_ERR_CLS, H5E_IO, H5E_WRITEERROR, "error message = '%s'",
             e.code().message().c_str());
  } catch (const std::bad_alloc&) {
    H5Epush2(H5E_DEFAULT, __FILE__, what, __LINE__, H5E_ERR_CLS, H5E_RESOURCE, H5E_NOSPACE, "memory allocation failed");
  } catch (const std::exception& e) {
    H5Epush2(H5E_DEFAULT, __FILE__, what, __LINE__, H5E_ERR_CLS, H5E_IO, H5E_WRITEERROR, "error message = '%s'",
             e.what());
  }
  return -1;
}

/// What the access property list carries.
struct DriverInfo {
  const std::shared_ptr<Journal>* journal;
};

H5FD_t* open_file(const char* name, unsigned flags, hid_t access, haddr_t maxaddr) {
  JournaledFile* file = nullptr;
  const herr_t status = guarded("open", [&] {
    const auto* info = static_cast<const DriverInfo*>(H5Pget_driver_info(access));
    if (!info || maxaddr == 0) errno = EINVAL, fail();
    auto opened = std::make_unique<JournaledFile>();
    const int creating = (flags & H5F_ACC_CREAT ? O_CREAT : 0) | (flags & H5F_ACC_EXCL ? O_EXCL : 0);
    opened->descriptor = open(name, (flags & H5F_ACC_RDWR ? O_RDWR : O_RDONLY) | creating | O_CLOEXEC, 0666);
    if (opened->descriptor < 0) fail();
    const auto give_up = [&] {
      const int error = errno;
      close(opened->descriptor);
      errno = error;
      fail();
    };
    // Some file systems know no locks.
    if (flock(opened->descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) give_up();
    opened->journal = *info->journal;
    if (flags & H5F_ACC_TRUNC) {
      unlink(opened->journal->path.c_str());  // that of a file which goes now
      if (ftruncate(opened->descriptor, 0) != 0) give_up();
    }
    struct stat status_of_file {};
    if (fstat(opened->descriptor, &status_of_file) != 0) give_up();
    opened->end_of_file = haddr_t(status_of_file.st_size);
    file = opened.release();
  });
  return status < 0 ? nullptr : &file->base;
}

herr_t close_file(H5FD_t* base) {
  JournaledFile* file = &of(base);
  return guarded("close", [file] {
    const std::unique_ptr<JournaledFile> owner(file);
    if (close(file->descriptor) != 0) fail();
  });
}

int compare(const H5FD_t* a, const H5FD_t* b) {
  struct stat x {
  }, y{};
  if (fstat(of(a).descriptor, &x) != 0 || fstat(of(b).descriptor, &y) != 0) return -1;
  if (x.st_dev != y.st_dev) return x.st_dev < y.st_dev ? -1 : 1;
  return x.st_ino < y.st_ino ? -1 : x.st_ino > y.st_ino;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  // As HDF5's own driver for files, so that the layout is the same.
  if (flags)
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t get_eoa(const H5FD_t* file, H5FD_mem_t) { return of(file).end_of_allocation; }
herr_t set_eoa(H5FD_t* file, H5FD_mem_t, haddr_t address) {
  of(file).end_of_allocation = address;
  return 0;
}
haddr_t get_eof(const H5FD_t* file, H5FD_mem_t) { return of(file).end_of_file; }

herr_t read(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, void* data) {
  return guarded("read", [=] {
    read_all(of(base).descriptor, static_cast<char*>(data), size, at);
    of(base).pending.overlay(at, static_cast<char*>(data), size);
  });
}

herr_t write(H5FD_t* base, H5FD_mem_t type, hid_t, haddr_t at, std::size_t size, const void* data) {
  return guarded("write", [=] {
    JournaledFile& file = of(base);
    const auto* bytes = static_cast<const char*>(data);
    if (type == H5FD_MEM_DRAW) {
      file.pending.cut(at, size);
      write_all(file.descriptor, bytes, size, at);
    } else {
      file.pending.put(at, bytes, size);
    }
    file.end_of_file = std::max<haddr_t>(file.end_of_file, at + size);
  });
}

herr_t flush(H5FD_t* base, hid_t, hbool_t) {
  return guarded("flush", [=] {
    JournaledFile& file = of(base);
    if (!file.journal->armed) return;
    file.journal->armed = false;
    file.commit();
  });
}

/// The file gets its length with the metadata that tell it.
herr_t truncate(H5FD_t* base, hid_t, hbool_t) {
  of(base).end_of_file = of(base).end_of_allocation;
  return 0;
}

H5FD_class_t driver_class() {
  H5FD_class_t c{};
  c.name = "lgiw-journaled";
  c.maxaddr = (haddr_t(1) << 62) - 1;
  c.fc_degree = H5F_CLOSE_WEAK;
  c.fapl_size = sizeof(DriverInfo);
  c.open = open_file;
  c.close = close_file;
  c.cmp = compare;
  c.query = query;
  c.get_eoa = get_eoa;
  c.set_eoa = set_eoa;
  c.get_eof = get_eof;
  c.read = read;
  c.write = write;
  c.flush = flush;
  c.truncate = truncate;
  const H5FD_mem_t kinds[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(kinds), std::end(kinds), c.fl_map);
  return c;
}

}  // namespace

std::string journal_path(const std::string& file) {
  const std::filesystem::path p(file);
  const std::string name = p.filename().string();
  return (p.parent_path() / ((name.rfind('.', 0) == 0 ? "" : ".") + name + ".journal")).string();
}

void set_journaled_driver(hid_t access, const std::shared_ptr<Journal>& journal) {
  static const H5FD_class_t c = driver_class();
  static const hid_t id = H5FDregister(&c);
  const DriverInfo info{&journal};
  if (id < 0 || H5Pset_driver(access, id, &info) < 0)
    throw WorkError("HDF5 takes no driver", "it is not the one that this program was built with", "build it anew");
}

void carry_out_journal(const std::string& file) {
  const std::string path = journal_path(file);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return;
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  try {
    haddr_t file_size = 0;
    Pieces pieces;
    if (parse_journal(text, file_size, pieces)) apply(Descriptor(file, O_RDWR), file_size, pieces);
    if (unlink(path.c_str()) != 0) fail();
  } catch (const std::system_error& e) {
    throw WorkError(file + " cannot be brought to its last state", e.code().message(),
                    "make room or mend the folder, then run again");
  }
}

bool is_being_written(const std::string& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool locked = flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  close(descriptor);
  return locked;
}

}  // namespace lgiw::h5
