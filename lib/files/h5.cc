#include "files/h5.hh"

#include <sys/mman.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <functional>
#include <new>
#include <numeric>

#include "base/error.hh"

namespace lgiw::h5 {

namespace {

constexpr hsize_t chunk_bytes = hsize_t(1) << 20;
// zlib cannot pack better than 1032:1.
constexpr hsize_t deflate_limit = 1100;

/// HDF5 1.10 crashes where its own small allocations fail: they must not.
void require_memory() {
  constexpr std::size_t enough = std::size_t(8) << 20;
  void* const place = mmap(nullptr, enough, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (place == MAP_FAILED) throw std::bad_alloc();
  munmap(place, enough);
}

void rethrow_lack_of_memory(const std::string& why) {
  if (why.find("memory allocation failed") != std::string::npos) throw std::bad_alloc();
}

/// Silences HDF5's own printing. Its clean-up at exit is left out too: after a failed write (disk full) it tries the
/// same write again and complains on stderr, and all our files are closed by then.
void set_up_library() {
  require_memory();
  static const bool once = [] {
    H5dont_atexit();
    // A file must neither make HDF5 load code nor read other files.
    H5PLset_loading_state(0);
    H5Lunregister(H5L_TYPE_EXTERNAL);
    return true;
  }();
  (void)once;
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

herr_t first_entry(unsigned n, const H5E_error2_t* error, void* text) {
  if (n == 0 && error->desc) *static_cast<std::string*>(text) = error->desc;
  return 0;
}

/// The innermost message of HDF5's error stack, or the system's where there is one: it alone names the cause.
std::string reason() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, first_entry, &text);
  const std::string mark = "error message = '";
  if (const auto at = text.find(mark); at != std::string::npos) {
    const auto end = text.find('\'', at + mark.size());
    text = text.substr(at + mark.size(), end == std::string::npos ? end : end - at - mark.size());
  }
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.empty() ? "HDF5 gives no reason" : text;
}

std::string quoted(const std::string& text) { return "'" + text + "'"; }

[[noreturn]] void read_failed(const std::string& path, const std::string& object, const std::string& why) {
  rethrow_lack_of_memory(why);
  throw InputError("cannot read " + quoted(object) + " of " + quoted(path), why,
                   "the file is damaged or of another kind, make it again");
}

[[noreturn]] void write_failed(const std::string& path, const std::string& object, const std::string& why) {
  rethrow_lack_of_memory(why);
  throw WorkError("cannot write " + (object.empty() ? "" : quoted(object) + " of ") + quoted(path), why,
                  "see that the disk has room and that the folder can be written");
}

Handle access_properties(bool writing) {
  Handle list(H5Pcreate(H5P_FILE_ACCESS));
  // No lock, for writers either: HDF5 refuses to open a file twice in one process with different ideas of locking.
  H5Pset_file_locking(list.id(), false, true);
  if (!writing) return list;
  // Without a chunk cache, chunks get their place at the write and not at some later flush.
  H5Pset_cache(list.id(), 0, 1, 0, 1.0);
  H5Pset_libver_bounds(list.id(), H5F_LIBVER_V18, H5F_LIBVER_V18);
  // Aggregated blocks are given back at each flush, which would make the layout depend on when that happens.
  H5Pset_meta_block_size(list.id(), 0);
  H5Pset_small_data_block_size(list.id(), 0);
  // Metadata goes to disk at flush() only: a process killed between two flushes leaves the file of the last one.
  H5AC_cache_config_t config;
  config.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  H5Pget_mdc_config(list.id(), &config);
  config.incr_mode = H5C_incr__off;
  config.flash_incr_mode = H5C_flash_incr__off;
  config.decr_mode = H5C_decr__off;
  config.evictions_enabled = false;
  H5Pset_mdc_config(list.id(), &config);
  return list;
}

/// Object creation without times.
Handle creation_properties(hid_t list_class) {
  Handle list(H5Pcreate(list_class));
  H5Pset_obj_track_times(list.id(), false);
  return list;
}

std::string parent(const std::string& name) { return name.substr(0, name.find_last_of('/')); }

bool link_exists(hid_t file, const std::string& object) {
  for (std::size_t at = 0; at != std::string::npos;) {
    at = object.find('/', at + 1);
    const std::string part = object.substr(0, at);
    if (part.empty() || part == "/") continue;
    if (H5Lexists(file, part.c_str(), H5P_DEFAULT) <= 0) return false;
    if (H5Oexists_by_name(file, part.c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return true;
}

hsize_t file_bytes(hid_t file) {
  hsize_t size = 0;
  return H5Fget_filesize(file, &size) < 0 ? 0 : size;
}

/// Bytes of `shape` elements of `size` bytes; false when that does not fit into 64 bits.
bool byte_count(const Shape& shape, hsize_t size, hsize_t& bytes) {
  bytes = size;
  for (hsize_t n : shape)
    if (__builtin_mul_overflow(bytes, n, &bytes)) return false;
  return true;
}

std::string text_of(const Shape& shape) {
  std::string text = "[";
  for (std::size_t k = 0; k < shape.size(); ++k) text.append(k ? "," : "").append(std::to_string(shape[k]));
  return text + "]";
}

Shape extents(hid_t dataset) {
  const Handle space(H5Dget_space(dataset));
  const int rank = space ? H5Sget_simple_extent_ndims(space.id()) : -1;
  Shape shape(std::size_t(std::max(rank, 0)));
  if (rank > 0) H5Sget_simple_extent_dims(space.id(), shape.data(), nullptr);
  return shape;
}

Handle open_for_reading(hid_t file, const std::string& path, const std::string& name) {
  if (!link_exists(file, name)) read_failed(path, name, "there is no such dataset");
  Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT));
  if (!dataset) read_failed(path, name, reason());
  const Handle list(H5Dget_create_plist(dataset.id()));
  if (!list) read_failed(path, name, reason());
  if (H5Pget_layout(list.id()) == H5D_VIRTUAL || H5Pget_external_count(list.id()) != 0)
    read_failed(path, name, "its values lie in another file");
  return dataset;
}

/// The shape, once the bytes that it declares are found to be backed by bytes in the file.
Shape backed_shape(hid_t file, const std::string& path, const std::string& name, hid_t dataset) {
  const Shape shape = extents(dataset);
  const Handle type(H5Dget_type(dataset));
  const Handle list(H5Dget_create_plist(dataset));
  if (!type || !list) read_failed(path, name, reason());
  const hsize_t stored = std::min<hsize_t>(H5Dget_storage_size(dataset), file_bytes(file));
  const hsize_t limit = H5Pget_nfilters(list.id()) > 0 ? stored * deflate_limit : stored;
  hsize_t declared = 0;
  if (!byte_count(shape, H5Tget_size(type.id()), declared) || declared > limit)
    read_failed(path, name,
                "its size " + text_of(shape) + " is more than the " + std::to_string(stored) + " bytes stored");
  if (declared > 0 && H5Pget_layout(list.id()) == H5D_CHUNKED && H5Pget_nfilters(list.id()) > 0) {
    // A filtered chunk is unpacked whole.
    Shape chunk(shape.size());
    hsize_t bytes = 0;
    H5Pget_chunk(list.id(), int(chunk.size()), chunk.data());
    if (!byte_count(chunk, H5Tget_size(type.id()), bytes) || bytes > std::max(limit, chunk_bytes))
      read_failed(path, name, "its chunks " + text_of(chunk) + " are more than the file can hold");
  }
  return shape;
}

Handle slab_of(hid_t dataset, const Shape& start, const Shape& count) {
  Handle space(H5Dget_space(dataset));
  if (!space || H5Sget_simple_extent_ndims(space.id()) != int(start.size()) || start.size() != count.size() ||
      H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) < 0 ||
      H5Sselect_valid(space.id()) <= 0)
    return Handle();
  return space;
}

/// Small writes reach the file when the dataset is closed, and fail there.
void close_written(Handle& dataset, const std::string& path, const std::string& name) {
  if (H5Dclose(dataset.release()) < 0) write_failed(path, name, reason());
}

void write_part(hid_t dataset, const std::string& path, const std::string& name, hid_t type, const void* data,
                const Shape& start, const Shape& count) {
  const Handle file_space = slab_of(dataset, start, count);
  if (!file_space)
    write_failed(path, name,
                 "slab " + text_of(start) + "+" + text_of(count) + " is not in " + text_of(extents(dataset)));
  const Handle memory_space(H5Screate_simple(int(count.size()), count.data(), nullptr));
  if (H5Dwrite(dataset, type, memory_space.id(), file_space.id(), H5P_DEFAULT, data) < 0)
    write_failed(path, name, reason());
}

hsize_t element_count(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), hsize_t(1), std::multiplies<>());
}

/// Rows of the first axis that fill `bytes`, all of the others.
Shape default_chunk(const Shape& shape, std::size_t size, bool extendible) {
  Shape chunk = shape;
  hsize_t row = size;
  for (std::size_t k = 1; k < chunk.size(); ++k) row *= chunk[k] = std::max<hsize_t>(chunk[k], 1);
  const hsize_t rows = std::max<hsize_t>(1, chunk_bytes / row);
  chunk[0] = extendible ? std::min<hsize_t>(rows, 1024) : std::clamp<hsize_t>(chunk[0], 1, rows);
  return chunk;
}

}  // namespace

template <>
hid_t native_type<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
hid_t native_type<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t native_type<int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
hid_t native_type<int32_t>() {
  return H5T_NATIVE_INT32;
}
template <>
hid_t native_type<uint32_t>() {
  return H5T_NATIVE_UINT32;
}
template <>
hid_t native_type<uint8_t>() {
  return H5T_NATIVE_UINT8;
}

Handle::~Handle() {
  if (id_ >= 0) H5Idec_ref(id_);
}

Handle& Handle::operator=(Handle&& other) noexcept {
  std::swap(id_, other.id_);
  return *this;
}

File File::create(const std::string& path) {
  set_up_library();
  const Handle creation = creation_properties(H5P_FILE_CREATE);
  const Handle access = access_properties(true);
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()));
  if (!file) write_failed(path, "", reason());
  return File(std::move(file), path);
}

File File::create_journaled(const std::string& path) {
  set_up_library();
  const Handle creation = creation_properties(H5P_FILE_CREATE);
  const Handle access = access_properties(true);
  auto journal = std::make_shared<Journal>();
  journal->path = journal_path(path);
  set_journaled_driver(access.id(), journal);
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()));
  // All metadata stays in memory while such a file grows. The index of chunks of HDF5 1.10, an extensible array, takes
  // some 35 bytes a chunk there, the B-tree of 1.8 480. The superblock is 1.8's still: that of 1.10 calls a file whose
  // writer was killed one in use.
  if (!file || H5Fset_libver_bounds(file.id(), H5F_LIBVER_V110, H5F_LIBVER_V110) < 0) write_failed(path, "", reason());
  return File(std::move(file), path, std::move(journal));
}

void File::renamed(const std::string& path) {
  path_ = path;
  if (journal_) journal_->path = journal_path(path);
}

namespace {

Handle open_existing(const std::string& path, bool writing) {
  set_up_library();
  struct stat status {};
  const std::string problem = "cannot open " + quoted(path);
  if (path == "-") throw InputError(problem, "HDF5 needs a seekable file", "give a file's name");
  if (stat(path.c_str(), &status) != 0) throw InputError(problem, std::strerror(errno), "see that the name is right");
  if (!S_ISREG(status.st_mode)) throw InputError(problem, "it is not a regular file", "HDF5 needs a seekable file");
  if (!std::ifstream(path)) throw InputError(problem, std::strerror(errno), "see that you may read it");
  if (H5Fis_hdf5(path.c_str()) <= 0) throw InputError(problem, "it is not an HDF5 file", "see that the name is right");
  const Handle access = access_properties(writing);
  Handle file(H5Fopen(path.c_str(), writing ? H5F_ACC_RDWR : H5F_ACC_RDONLY, access.id()));
  if (!file) throw InputError(problem, reason(), "the file is damaged or in use, make it again");
  return file;
}

}  // namespace

File File::open_read(const std::string& path) { return File(open_existing(path, false), path); }

File File::open_write(const std::string& path) { return File(open_existing(path, true), path); }

bool File::exists(const std::string& object) const { return link_exists(handle_.id(), object); }

void File::make_group(const std::string& group) {
  if (group.empty() || exists(group)) return;
  make_group(parent(group));
  const Handle creation = creation_properties(H5P_GROUP_CREATE);
  const Handle made(H5Gcreate2(handle_.id(), group.c_str(), H5P_DEFAULT, creation.id(), H5P_DEFAULT));
  if (!made) write_failed(path_, group, reason());
}

std::vector<std::string> File::children(const std::string& group) const {
  const Handle opened(exists(group) ? H5Gopen2(handle_.id(), group.c_str(), H5P_DEFAULT) : -1);
  H5G_info_t info;
  if (!opened || H5Gget_info(opened.id(), &info) < 0) read_failed(path_, group, "there is no such group");
  std::vector<std::string> names;
  for (hsize_t k = 0; k < info.nlinks; ++k) {
    const auto length = H5Lget_name_by_idx(opened.id(), ".", H5_INDEX_NAME, H5_ITER_INC, k, nullptr, 0, H5P_DEFAULT);
    if (length < 0) read_failed(path_, group, reason());
    std::string name(std::size_t(length) + 1, '\0');
    H5Lget_name_by_idx(opened.id(), ".", H5_INDEX_NAME, H5_ITER_INC, k, name.data(), name.size(), H5P_DEFAULT);
    name.pop_back();
    names.push_back(name);
  }
  return names;
}

template <class T>
void File::create_dataset(const std::string& name, const Shape& shape, bool extendible, bool deflate,
                          const Shape& chunk) {
  require_memory();
  make_group(parent(name));
  const Handle creation = creation_properties(H5P_DATASET_CREATE);
  Shape largest = shape;
  H5Pset_fill_time(creation.id(), H5D_FILL_TIME_NEVER);
  if (extendible || (deflate && element_count(shape) > 0)) {
    const Shape chunks = chunk.empty() ? default_chunk(shape, sizeof(T), extendible) : chunk;
    H5Pset_chunk(creation.id(), int(chunks.size()), chunks.data());
    if (extendible) largest[0] = H5S_UNLIMITED;
    if (deflate) {
      H5Pset_shuffle(creation.id());
      H5Pset_deflate(creation.id(), 1);
    }
  } else {
    H5Pset_alloc_time(creation.id(), H5D_ALLOC_TIME_EARLY);
  }
  const Handle space(H5Screate_simple(int(shape.size()), shape.data(), largest.data()));
  const Handle dataset(
      H5Dcreate2(handle_.id(), name.c_str(), native_type<T>(), space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT));
  if (!dataset) write_failed(path_, name, reason());
}

template <class T>
void File::write_slab(const std::string& name, const T* data, const Shape& start, const Shape& count) {
  if (element_count(count) == 0) return;
  require_memory();
  Handle dataset(H5Dopen2(handle_.id(), name.c_str(), H5P_DEFAULT));
  if (!dataset) write_failed(path_, name, reason());
  write_part(dataset.id(), path_, name, native_type<T>(), data, start, count);
  close_written(dataset, path_, name);
}

template <class T>
void File::write(const std::string& name, const T* data, const Shape& shape, bool deflate) {
  create_dataset<T>(name, shape, false, deflate);
  write_slab(name, data, Shape(shape.size(), 0), shape);
}

template <class T>
void File::append(const std::string& name, const T* data, const Shape& count) {
  if (element_count(count) == 0) return;
  require_memory();
  Handle dataset(H5Dopen2(handle_.id(), name.c_str(), H5P_DEFAULT));
  if (!dataset) write_failed(path_, name, reason());
  Shape start(count.size(), 0), size = extents(dataset.id());
  if (size.size() != count.size() || !std::equal(size.begin() + 1, size.end(), count.begin() + 1))
    write_failed(path_, name, text_of(count) + " cannot be appended to " + text_of(size));
  start[0] = size[0];
  size[0] += count[0];
  if (H5Dset_extent(dataset.id(), size.data()) < 0) write_failed(path_, name, reason());
  write_part(dataset.id(), path_, name, native_type<T>(), data, start, count);
  close_written(dataset, path_, name);
}

template <class T>
std::vector<T> File::read(const std::string& name, Shape* shape) const {
  require_memory();
  const Handle dataset = open_for_reading(handle_.id(), path_, name);
  const Shape size = backed_shape(handle_.id(), path_, name, dataset.id());
  std::vector<T> data(element_count(size));
  require_memory();
  if (!data.empty() && H5Dread(dataset.id(), native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()) < 0)
    read_failed(path_, name, reason());
  if (shape) *shape = size;
  return data;
}

template <class T>
void File::read_slab(const std::string& name, T* data, const Shape& start, const Shape& count) const {
  if (element_count(count) == 0) return;
  require_memory();
  const Handle dataset = open_for_reading(handle_.id(), path_, name);
  const Shape size = backed_shape(handle_.id(), path_, name, dataset.id());
  const Handle file_space = slab_of(dataset.id(), start, count);
  if (!file_space)
    read_failed(path_, name,
                "its size is " + text_of(size) + ", too little for " + text_of(start) + "+" + text_of(count));
  const Handle memory_space(H5Screate_simple(int(count.size()), count.data(), nullptr));
  if (H5Dread(dataset.id(), native_type<T>(), memory_space.id(), file_space.id(), H5P_DEFAULT, data) < 0)
    read_failed(path_, name, reason());
}

Shape File::shape(const std::string& name) const {
  return backed_shape(handle_.id(), path_, name, open_for_reading(handle_.id(), path_, name).id());
}

haddr_t File::chunk_address(const std::string& name, const Shape& index) const {
  const Handle dataset = open_for_reading(handle_.id(), path_, name);
  const Handle list(H5Dget_create_plist(dataset.id()));
  Shape chunk(index.size()), corner(index);
  if (H5Pget_layout(list.id()) != H5D_CHUNKED ||
      H5Pget_chunk(list.id(), int(chunk.size()), chunk.data()) != int(chunk.size()))
    read_failed(path_, name, "it is not stored in chunks");
  for (std::size_t k = 0; k < corner.size(); ++k) corner[k] -= corner[k] % chunk[k];
  haddr_t address = HADDR_UNDEF;
  hsize_t size = 0;
  if (H5Dget_chunk_info_by_coord(dataset.id(), corner.data(), nullptr, &address, &size) < 0 || address == HADDR_UNDEF)
    read_failed(path_, name, "it has no chunk at " + text_of(corner));
  return address;
}

#define LGIW_H5_INSTANTIATE(T)                                                                       \
  template void File::create_dataset<T>(const std::string&, const Shape&, bool, bool, const Shape&); \
  template void File::write_slab(const std::string&, const T*, const Shape&, const Shape&);          \
  template void File::write(const std::string&, const T*, const Shape&, bool);                       \
  template void File::append(const std::string&, const T*, const Shape&);                            \
  template std::vector<T> File::read(const std::string&, Shape*) const;                              \
  template void File::read_slab(const std::string&, T*, const Shape&, const Shape&) const;
LGIW_H5_INSTANTIATE(float)
LGIW_H5_INSTANTIATE(double)
LGIW_H5_INSTANTIATE(int64_t)
LGIW_H5_INSTANTIATE(int32_t)
LGIW_H5_INSTANTIATE(uint32_t)
LGIW_H5_INSTANTIATE(uint8_t)
#undef LGIW_H5_INSTANTIATE

namespace {

void write_attribute(hid_t file, const std::string& path, const std::string& object, const std::string& name,
                     const Handle& type, const Handle& space, const void* data) {
  require_memory();
  const std::string full = object + "@" + name;
  const Handle owner(H5Oopen(file, object.c_str(), H5P_DEFAULT));
  if (!owner) write_failed(path, object, reason());
  Handle attribute;
  if (H5Aexists(owner.id(), name.c_str()) > 0) {
    attribute = Handle(H5Aopen(owner.id(), name.c_str(), H5P_DEFAULT));
    const Handle old_type(H5Aget_type(attribute.id())), old_space(H5Aget_space(attribute.id()));
    if (H5Tequal(old_type.id(), type.id()) <= 0 || H5Sextent_equal(old_space.id(), space.id()) <= 0) {
      attribute = Handle();
      if (H5Adelete(owner.id(), name.c_str()) < 0) write_failed(path, full, reason());
    }
  }
  if (!attribute)
    attribute = Handle(H5Acreate2(owner.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT));
  if (!attribute || H5Awrite(attribute.id(), type.id(), data) < 0) write_failed(path, full, reason());
}

template <class T>
Handle number_type() {
  return Handle(H5Tcopy(native_type<T>()));
}

Handle list_space(std::size_t n) {
  const hsize_t count = n;
  return Handle(H5Screate_simple(1, &count, nullptr));
}

Handle open_attribute(hid_t file, const std::string& path, const std::string& object, const std::string& name) {
  const std::string full = object + "@" + name;
  if (!link_exists(file, object) || H5Aexists_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT) <= 0)
    read_failed(path, full, "there is no such attribute");
  Handle attribute(H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT));
  if (!attribute) read_failed(path, full, reason());
  return attribute;
}

}  // namespace

void File::set_attribute(const std::string& object, const std::string& name, const std::string& text) {
  // Padded with NUL and as long as the text: what readers of VTKHDF compare without a terminator. Size 0 does not
  // exist.
  const Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.id(), std::max<std::size_t>(text.size(), 1));
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  const bool ascii = std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 128; });
  H5Tset_cset(type.id(), ascii ? H5T_CSET_ASCII : H5T_CSET_UTF8);
  write_attribute(handle_.id(), path_, object, name, type, Handle(H5Screate(H5S_SCALAR)), text.c_str());
}

void File::set_attribute(const std::string& object, const std::string& name, double value) {
  write_attribute(handle_.id(), path_, object, name, number_type<double>(), Handle(H5Screate(H5S_SCALAR)), &value);
}

void File::set_attribute(const std::string& object, const std::string& name, int64_t value) {
  write_attribute(handle_.id(), path_, object, name, number_type<int64_t>(), Handle(H5Screate(H5S_SCALAR)), &value);
}

void File::set_attribute(const std::string& object, const std::string& name, const std::vector<int64_t>& values) {
  write_attribute(handle_.id(), path_, object, name, number_type<int64_t>(), list_space(values.size()), values.data());
}

void File::set_attribute(const std::string& object, const std::string& name, const std::vector<double>& values) {
  write_attribute(handle_.id(), path_, object, name, number_type<double>(), list_space(values.size()), values.data());
}

bool File::has_attribute(const std::string& object, const std::string& name) const {
  return exists(object) && H5Aexists_by_name(handle_.id(), object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::string File::text_attribute(const std::string& object, const std::string& name) const {
  const std::string full = object + "@" + name;
  const Handle attribute = open_attribute(handle_.id(), path_, object, name);
  const Handle type(H5Aget_type(attribute.id())), space(H5Aget_space(attribute.id()));
  if (H5Tget_class(type.id()) != H5T_STRING || H5Sget_simple_extent_npoints(space.id()) != 1)
    read_failed(path_, full, "it is not a text");
  if (H5Tis_variable_str(type.id()) > 0) {  // as other programs write it
    char* value = nullptr;
    if (H5Aread(attribute.id(), type.id(), &value) < 0) read_failed(path_, full, reason());
    const std::string text = value ? value : "";
    H5Dvlen_reclaim(type.id(), space.id(), H5P_DEFAULT, &value);
    return text;
  }
  const std::size_t size = H5Tget_size(type.id());
  if (size > file_bytes(handle_.id())) read_failed(path_, full, "it is longer than the file");
  std::string text(size, '\0');
  if (H5Aread(attribute.id(), type.id(), text.data()) < 0) read_failed(path_, full, reason());
  text.resize(std::min(text.find('\0'), text.size()));
  return text;
}

std::vector<double> File::numbers_attribute(const std::string& object, const std::string& name) const {
  const std::string full = object + "@" + name;
  const Handle attribute = open_attribute(handle_.id(), path_, object, name);
  const Handle type(H5Aget_type(attribute.id())), space(H5Aget_space(attribute.id()));
  const H5T_class_t kind = H5Tget_class(type.id());
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) read_failed(path_, full, "it is not a number");
  const hssize_t count = H5Sget_simple_extent_npoints(space.id());
  if (count < 0 || hsize_t(count) > file_bytes(handle_.id())) read_failed(path_, full, "it is longer than the file");
  std::vector<double> values(std::size_t(count), 0.0);
  if (!values.empty() && H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, values.data()) < 0)
    read_failed(path_, full, reason());
  return values;
}

double File::number_attribute(const std::string& object, const std::string& name) const {
  const std::vector<double> values = numbers_attribute(object, name);
  if (values.size() != 1)
    read_failed(path_, object + "@" + name, "it has " + std::to_string(values.size()) + " values instead of 1");
  return values[0];
}

void File::flush() {
  require_memory();
  arm();
  if (H5Fflush(handle_.id(), H5F_SCOPE_GLOBAL) < 0) write_failed(path_, "", reason());
}

void File::close() {
  if (!handle_) return;
  unsigned intent = 0;
  H5Fget_intent(handle_.id(), &intent);
  if (intent & H5F_ACC_RDWR) flush();
  arm();
  if (H5Fclose(handle_.release()) < 0) write_failed(path_, "", reason());
}

}  // namespace lgiw::h5
