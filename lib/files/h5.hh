// A thin RAII layer over HDF5's C API: every failure becomes an exception with the file and the object in it.
//
// Files that this layer writes depend on the sequence of calls alone: no times, no free-space aggregation, no chunk
// cache and no evictions from the metadata cache, so that neither the clock nor the moments of flush() move a byte.
#pragma once

#include <hdf5.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "files/journaled_driver.hh"

namespace lgiw::h5 {

template <class T>
hid_t native_type();  // float, double, int64_t, int32_t, uint32_t, uint8_t

/// Closes an identifier of any kind.
class Handle {
 public:
  Handle() = default;
  explicit Handle(hid_t id) : id_(id) {}
  ~Handle();
  Handle(Handle&& other) noexcept : id_(other.id_) { other.id_ = -1; }
  Handle& operator=(Handle&& other) noexcept;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  hid_t id() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }
  /// Hands the identifier over, unclosed.
  hid_t release() {
    const hid_t id = id_;
    id_ = -1;
    return id;
  }

 private:
  hid_t id_ = -1;
};

using Shape = std::vector<hsize_t>;

/// An HDF5 file. Object times are never tracked, so that reruns are byte-identical. Reading errors (not HDF5,
/// truncated, missing or wrongly shaped objects) are InputError; writing errors are WorkError. Not for several threads
/// at once. What leads out of the file - external links, external or virtual datasets - is not followed, and no filter
/// is loaded from elsewhere.
class File {
 public:
  static File create(const std::string& path);
  /// A file that is at any moment that of its last flush() or close(), whatever happens to the process; see
  /// journaled_driver.hh. One that is closed after an error, without close(), stays so too. Throws WorkError also where
  /// another process is writing it.
  static File create_journaled(const std::string& path);
  /// Files are not locked: one that another process is still writing can be read as of its last flush.
  static File open_read(const std::string& path);
  static File open_write(const std::string& path);  // read and write an existing file

  const std::string& path() const { return path_; }
  /// The file has another name now; for error messages.
  void renamed(const std::string& path);
  bool exists(const std::string& object) const;                       // every link on the way too
  void make_group(const std::string& group);                          // with parents
  std::vector<std::string> children(const std::string& group) const;  // names, sorted

  // Whole datasets. write() makes parent groups. deflate: chunks of at most 1 MiB, shuffle + deflate 1.
  template <class T>
  void write(const std::string& name, const T* data, const Shape& shape, bool deflate = false);
  template <class T>
  void write(const std::string& name, const std::vector<T>& data) {
    write(name, data.data(), Shape{data.size()});
  }
  template <class T>
  std::vector<T> read(const std::string& name, Shape* shape = nullptr) const;  // converts number types
  /// Throws InputError when the dataset declares more than the file can hold: with deflate more than 1100 times what is
  /// stored, otherwise more than is stored. Memory may be allocated by this shape.
  Shape shape(const std::string& name) const;

  // Parts: fixed-size datasets filled slab by slab, and extendible ones appended along the first axis.
  /// `chunk`: empty for the default; only for extendible or deflated datasets. Whatever is not written reads as zero.
  template <class T>
  void create_dataset(const std::string& name, const Shape& shape, bool extendible = false, bool deflate = false,
                      const Shape& chunk = {});
  template <class T>
  void write_slab(const std::string& name, const T* data, const Shape& start, const Shape& count);
  template <class T>
  void append(const std::string& name, const T* data, const Shape& count);
  template <class T>
  void read_slab(const std::string& name, T* data, const Shape& start, const Shape& count) const;
  /// Place in the file of the chunk that holds the element at `index`: chunks lie in the order in which they were
  /// written.
  haddr_t chunk_address(const std::string& name, const Shape& index) const;

  // Attributes of a group or dataset ("/" for the file). set_attribute replaces.
  void set_attribute(const std::string& object, const std::string& name, const std::string& text);  // fixed-length
  void set_attribute(const std::string& object, const std::string& name, const char* text) {
    set_attribute(object, name, std::string(text));
  }
  void set_attribute(const std::string& object, const std::string& name, double value);
  void set_attribute(const std::string& object, const std::string& name, int64_t value);
  void set_attribute(const std::string& object, const std::string& name, const std::vector<int64_t>& values);
  void set_attribute(const std::string& object, const std::string& name, const std::vector<double>& values);
  bool has_attribute(const std::string& object, const std::string& name) const;
  std::string text_attribute(const std::string& object, const std::string& name) const;
  double number_attribute(const std::string& object, const std::string& name) const;
  std::vector<double> numbers_attribute(const std::string& object, const std::string& name) const;

  void flush();
  void close();  // throws WorkError when the last bytes cannot be written

 private:
  File(Handle handle, std::string path, std::shared_ptr<Journal> journal = nullptr)
      : journal_(std::move(journal)), handle_(std::move(handle)), path_(std::move(path)) {}
  void arm() {
    if (journal_) journal_->armed = true;
  }
  std::shared_ptr<Journal> journal_;
  Handle handle_;
  std::string path_;
};

}  // namespace lgiw::h5
