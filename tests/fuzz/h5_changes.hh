// Changes to an HDF5 file as a script orders them: attributes and datasets of other values, types and shapes, links to
// elsewhere, things that are gone. HDF5 itself writes them, so that what is tested is our reading, not HDF5's.
#pragma once

#include <string>
#include <vector>

#include "files/h5.hh"
#include "fuzzing.hh"

namespace lgiw::fuzz {

using h5::Handle;
using h5::Shape;

struct H5Object {
  std::string path;
  bool dataset = false;
  std::vector<std::string> attributes;
};

inline herr_t remember_attribute(hid_t, const char* name, const H5A_info_t*, void* to) {
  static_cast<H5Object*>(to)->attributes.push_back(name);
  return 0;
}

inline herr_t remember_object(hid_t file, const char* name, const H5O_info_t* info, void* to) {
  H5Object object{std::string("/") + (std::string(name) == "." ? "" : name), info->type == H5O_TYPE_DATASET, {}};
  const Handle opened(H5Oopen(file, name, H5P_DEFAULT));
  H5Aiterate2(opened.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, remember_attribute, &object);
  static_cast<std::vector<H5Object>*>(to)->push_back(object);
  return 0;
}

inline std::vector<H5Object> objects_of(const std::string& path) {
  std::vector<H5Object> objects;
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  H5Ovisit2(file.id(), H5_INDEX_NAME, H5_ITER_INC, remember_object, &objects, H5O_INFO_BASIC);
  return objects;
}

inline Handle text_type(std::size_t size) {
  Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.id(), size);
  return type;
}

inline Handle chosen_type(uint8_t choice, Script& script) {
  const hid_t numbers[] = {H5T_NATIVE_DOUBLE, H5T_NATIVE_FLOAT,  H5T_NATIVE_INT64, H5T_NATIVE_UINT8,
                           H5T_NATIVE_INT8,   H5T_NATIVE_UINT64, H5T_IEEE_F32BE,   H5T_STD_I16BE};
  if (choice % 12 < 8) return Handle(H5Tcopy(numbers[choice % 12]));
  if (choice % 12 == 8) return text_type(1 + std::size_t(script.byte()));
  if (choice % 12 == 9) return text_type(H5T_VARIABLE);
  if (choice % 12 == 10) return Handle(H5Tvlen_create(H5T_NATIVE_DOUBLE));
  Handle type(H5Tcreate(H5T_COMPOUND, 16));
  H5Tinsert(type.id(), "a", 0, H5T_NATIVE_DOUBLE);
  H5Tinsert(type.id(), "b", 8, H5T_NATIVE_INT32);
  return type;
}

inline Shape chosen_shape(Script& script) {
  Shape shape(script.byte() % 5);
  for (hsize_t& n : shape) {
    const uint8_t choice = script.byte();
    n = choice < 200 ? choice % 20 : choice < 240 ? hsize_t(1) << (choice % 62) : script.number();
  }
  return shape;
}

inline hsize_t count_of(const Shape& shape) {
  hsize_t n = 1;
  for (const hsize_t k : shape)
    if (__builtin_mul_overflow(n, k, &n)) return ~hsize_t(0);
  return n;
}

/// Whether there are few elements, and they are plain bytes.
inline bool can_be_filled(const Handle& type, const Shape& shape) {
  return count_of(shape) <= 4096 && !H5Tis_variable_str(type.id()) && H5Tget_class(type.id()) != H5T_VLEN;
}

/// Bytes for `n` elements, where that is little: as reals, or as they come.
inline std::vector<char> chosen_bytes(Script& script, std::size_t n) {
  std::vector<char> bytes(n);
  if (script.byte() % 2) {
    for (char& b : bytes) b = char(script.byte());
  } else {
    for (std::size_t k = 0; k + 8 <= n; k += 8) {
      const double value = script.real();
      std::memcpy(&bytes[k], &value, 8);
    }
  }
  return bytes;
}

inline void change_attribute(const Handle& file, const H5Object& object, const std::string& name, Script& script) {
  const Handle owner(H5Oopen(file.id(), object.path.c_str(), H5P_DEFAULT));
  if (!owner) return;
  const uint8_t what = script.byte();
  if (what % 4 == 0) {
    H5Adelete(owner.id(), name.c_str());
  } else if (what % 4 == 1) {  // the same type and shape, other values
    const Handle attribute(H5Aopen(owner.id(), name.c_str(), H5P_DEFAULT));
    if (!attribute) return;  // an earlier change took it away
    const Handle type(H5Aget_type(attribute.id()));
    if (H5Tget_class(type.id()) != H5T_STRING) {
      const Handle space(H5Aget_space(attribute.id()));
      std::vector<double> values(std::size_t(H5Sget_simple_extent_npoints(space.id())) + 1);
      H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, values.data());
      values[script.byte() % values.size()] = script.real();
      H5Awrite(attribute.id(), H5T_NATIVE_DOUBLE, values.data());
    } else {
      const Handle space(H5Aget_space(attribute.id()));
      std::string text = script.text(200);
      text.resize(std::max<std::size_t>(
          text.size(), H5Tget_size(type.id()) * std::size_t(H5Sget_simple_extent_npoints(space.id()))));
      H5Awrite(attribute.id(), type.id(), text.data());
    }
  } else {
    const Handle type = chosen_type(what / 4, script);
    const Shape shape = what % 4 == 2 ? Shape{} : chosen_shape(script);
    if (!can_be_filled(type, shape)) return;
    H5Adelete(owner.id(), name.c_str());
    const Handle space(H5Screate_simple(int(shape.size()), shape.data(), nullptr));
    const Handle attribute(H5Acreate2(owner.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT));
    const std::vector<char> bytes = chosen_bytes(script, count_of(shape) * H5Tget_size(type.id()) + 8);
    if (attribute) H5Awrite(attribute.id(), type.id(), bytes.data());
  }
}

inline void replace_dataset(const Handle& file, const H5Object& object, Script& script) {
  const uint8_t how = script.byte();
  const Handle type = chosen_type(script.byte(), script);
  const Shape shape = chosen_shape(script);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE));
  if (how % 4 != 0 && !shape.empty()) {
    Shape chunk(shape.size(), 1);
    chunk[0] = 1 + how / 4;
    if (how % 4 == 3) chunk.back() = hsize_t(1) << (how % 24);
    H5Pset_chunk(creation.id(), int(chunk.size()), chunk.data());
    if (how % 4 == 2) H5Pset_deflate(creation.id(), 1);
  }
  const Handle space(shape.empty() ? H5Screate(how % 8 == 0 ? H5S_NULL : H5S_SCALAR)
                                   : H5Screate_simple(int(shape.size()), shape.data(), nullptr));
  H5Ldelete(file.id(), object.path.c_str(), H5P_DEFAULT);
  if (!space) return;
  const Handle dataset(
      H5Dcreate2(file.id(), object.path.c_str(), type.id(), space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT));
  if (!dataset || !can_be_filled(type, shape)) return;
  const std::vector<char> bytes = chosen_bytes(script, (count_of(shape) + 1) * H5Tget_size(type.id()));
  H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
}

/// A dataset with its shape.
struct H5Dataset {
  H5Dataset(const Handle& file, const H5Object& object)
      : dataset(H5Dopen2(file.id(), object.path.c_str(), H5P_DEFAULT)),
        space(dataset ? H5Dget_space(dataset.id()) : -1) {}
  Handle dataset, space;
};

/// Other values in a dataset that stays as it is.
inline void change_values(const Handle& file, const H5Object& object, Script& script) {
  const H5Dataset open(file, object);
  if (!open.dataset) return;
  const hssize_t count = H5Sget_simple_extent_npoints(open.space.id());
  if (count <= 0 || count > 65536) return;
  std::vector<double> values(std::size_t(count) + 1);
  const hid_t id = open.dataset.id();
  if (H5Dread(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) return;
  for (int k = script.byte() % 4; k >= 0; --k) values[script.number(2) % std::size_t(count)] = script.real();
  H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
}

inline void set_extent(const Handle& file, const H5Object& object, Script& script) {
  const H5Dataset open(file, object);
  if (!open.dataset) return;
  Shape size(std::size_t(std::max(H5Sget_simple_extent_ndims(open.space.id()), 0)) + 1);
  H5Sget_simple_extent_dims(open.space.id(), size.data(), nullptr);
  if (size[0] > 65536) return;  // made so before; to shrink it, HDF5 looks for each chunk there could be
  size[0] = script.byte() % 2 ? script.byte() : script.number();
  H5Dset_extent(open.dataset.id(), size.data());
}

inline void change(const std::string& path, const std::vector<H5Object>& objects, Script& script) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_file_locking(access.id(), false, true);
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, access.id()));
  if (!file) return;
  for (int k = 0; k < 8 && !script.done(); ++k) {
    const uint8_t what = script.byte();
    const H5Object& object = objects[script.byte() % objects.size()];
    if (what % 8 < 3 && !object.attributes.empty()) {
      change_attribute(file, object, object.attributes[script.byte() % object.attributes.size()], script);
    } else if (what % 8 < 5 && object.dataset) {
      change_values(file, object, script);
    } else if (what % 8 == 5 && object.dataset) {
      replace_dataset(file, object, script);
    } else if (what % 8 == 6 && object.dataset) {
      set_extent(file, object, script);
    } else if (what % 8 == 7 && object.path != "/") {
      const std::string& other = objects[script.byte() % objects.size()].path;
      H5Ldelete(file.id(), object.path.c_str(), H5P_DEFAULT);
      if (what / 8 % 4 == 0) H5Lcreate_soft(other.c_str(), file.id(), object.path.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      if (what / 8 % 4 == 1)
        H5Lcreate_external("elsewhere.h5", other.c_str(), file.id(), object.path.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      // No hard links: HDF5 1.10 itself falls over a null name while it makes them or flushes the group.
    }
  }
}

}  // namespace lgiw::fuzz
