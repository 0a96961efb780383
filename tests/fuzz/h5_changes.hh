// Changes to an HDF5 file as a script orders them: attributes and datasets of other values, types and shapes, links to
// elsewhere, things that are gone. HDF5 itself writes them, so that what is tested is our reading, not HDF5's.
#pragma once

#include <hdf5.h>

#include <string>
#include <vector>

#include "fuzzing.hh"

namespace lgiw::fuzz {

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
  const hid_t opened = H5Oopen(file, name, H5P_DEFAULT);
  H5Aiterate2(opened, H5_INDEX_NAME, H5_ITER_INC, nullptr, remember_attribute, &object);
  H5Oclose(opened);
  static_cast<std::vector<H5Object>*>(to)->push_back(object);
  return 0;
}

inline std::vector<H5Object> objects_of(const std::string& path) {
  std::vector<H5Object> objects;
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, remember_object, &objects, H5O_INFO_BASIC);
  H5Fclose(file);
  return objects;
}

inline hid_t chosen_type(uint8_t choice, Script& script) {
  const hid_t numbers[] = {H5T_NATIVE_DOUBLE, H5T_NATIVE_FLOAT,  H5T_NATIVE_INT64, H5T_NATIVE_UINT8,
                           H5T_NATIVE_INT8,   H5T_NATIVE_UINT64, H5T_IEEE_F32BE,   H5T_STD_I16BE};
  if (choice % 12 < 8) return H5Tcopy(numbers[choice % 12]);
  if (choice % 12 == 8) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, 1 + script.byte());
    return type;
  }
  if (choice % 12 == 9) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, H5T_VARIABLE);
    return type;
  }
  if (choice % 12 == 10) return H5Tvlen_create(H5T_NATIVE_DOUBLE);
  const hid_t type = H5Tcreate(H5T_COMPOUND, 16);
  H5Tinsert(type, "a", 0, H5T_NATIVE_DOUBLE);
  H5Tinsert(type, "b", 8, H5T_NATIVE_INT32);
  return type;
}

inline std::vector<hsize_t> chosen_shape(Script& script) {
  std::vector<hsize_t> shape(script.byte() % 5);
  for (hsize_t& n : shape) {
    const uint8_t choice = script.byte();
    n = choice < 200 ? choice % 20 : choice < 240 ? hsize_t(1) << (choice % 62) : script.number();
  }
  return shape;
}

inline hsize_t count_of(const std::vector<hsize_t>& shape) {
  hsize_t n = 1;
  for (const hsize_t k : shape)
    if (__builtin_mul_overflow(n, k, &n)) return ~hsize_t(0);
  return n;
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

inline void change_attribute(hid_t file, const H5Object& object, const std::string& name, Script& script) {
  const hid_t owner = H5Oopen(file, object.path.c_str(), H5P_DEFAULT);
  if (owner < 0) return;
  const uint8_t what = script.byte();
  if (what % 4 == 0) {
    H5Adelete(owner, name.c_str());
  } else if (what % 4 == 1) {  // the same type and shape, other values
    const hid_t attribute = H5Aopen(owner, name.c_str(), H5P_DEFAULT);
    const hid_t type = H5Aget_type(attribute);
    if (H5Tget_class(type) != H5T_STRING) {
      const hid_t space = H5Aget_space(attribute);
      std::vector<double> values(std::size_t(H5Sget_simple_extent_npoints(space)) + 1);
      H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data());
      values[script.byte() % values.size()] = script.real();
      H5Awrite(attribute, H5T_NATIVE_DOUBLE, values.data());
      H5Sclose(space);
    } else {
      std::string text = script.text(200);
      text.resize(std::max<std::size_t>(text.size(), H5Tget_size(type)));
      H5Awrite(attribute, type, text.data());
    }
    H5Tclose(type);
    H5Aclose(attribute);
  } else {
    const hid_t type = chosen_type(what / 4, script);
    const std::vector<hsize_t> shape = what % 4 == 2 ? std::vector<hsize_t>{} : chosen_shape(script);
    if (count_of(shape) <= 4096 && !H5Tis_variable_str(type) && H5Tget_class(type) != H5T_VLEN) {
      H5Adelete(owner, name.c_str());
      const hid_t space = H5Screate_simple(int(shape.size()), shape.data(), nullptr);
      const hid_t attribute = H5Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT);
      const std::vector<char> bytes = chosen_bytes(script, count_of(shape) * H5Tget_size(type) + 8);
      if (attribute >= 0) H5Awrite(attribute, type, bytes.data()), H5Aclose(attribute);
      H5Sclose(space);
    }
    H5Tclose(type);
  }
  H5Oclose(owner);
}

inline void replace_dataset(hid_t file, const H5Object& object, Script& script) {
  const uint8_t how = script.byte();
  const hid_t type = chosen_type(script.byte(), script);
  const std::vector<hsize_t> shape = chosen_shape(script);
  const hsize_t count = count_of(shape);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  if (how % 4 != 0 && !shape.empty()) {
    std::vector<hsize_t> chunk(shape.size(), 1);
    chunk[0] = 1 + how / 4;
    if (how % 4 == 3) chunk.back() = hsize_t(1) << (how % 24);
    H5Pset_chunk(creation, int(chunk.size()), chunk.data());
    if (how % 4 == 2) H5Pset_deflate(creation, 1);
  }
  const hid_t space = shape.empty() ? H5Screate(how % 8 == 0 ? H5S_NULL : H5S_SCALAR)
                                    : H5Screate_simple(int(shape.size()), shape.data(), nullptr);
  H5Ldelete(file, object.path.c_str(), H5P_DEFAULT);
  const hid_t dataset =
      space < 0 ? -1 : H5Dcreate2(file, object.path.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  if (dataset >= 0) {
    if (count <= 4096 && !H5Tis_variable_str(type) && H5Tget_class(type) != H5T_VLEN) {
      const std::vector<char> bytes = chosen_bytes(script, (count + 1) * H5Tget_size(type));
      H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
    }
    H5Dclose(dataset);
  }
  if (space >= 0) H5Sclose(space);
  H5Pclose(creation);
  H5Tclose(type);
}

/// Other values in a dataset that stays as it is.
inline void change_values(hid_t file, const H5Object& object, Script& script) {
  const hid_t dataset = H5Dopen2(file, object.path.c_str(), H5P_DEFAULT);
  if (dataset < 0) return;
  const hid_t space = H5Dget_space(dataset);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count > 0 && count <= 65536) {
    std::vector<double> values(std::size_t(count) + 1);
    if (H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0) {
      for (int k = script.byte() % 4; k >= 0; --k) values[script.number(2) % std::size_t(count)] = script.real();
      H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    }
  }
  H5Sclose(space);
  H5Dclose(dataset);
}

inline void set_extent(hid_t file, const H5Object& object, Script& script) {
  const hid_t dataset = H5Dopen2(file, object.path.c_str(), H5P_DEFAULT);
  if (dataset < 0) return;
  const hid_t space = H5Dget_space(dataset);
  std::vector<hsize_t> size(std::size_t(std::max(H5Sget_simple_extent_ndims(space), 0)) + 1);
  H5Sget_simple_extent_dims(space, size.data(), nullptr);
  size[0] = script.byte() % 2 ? script.byte() : script.number();
  H5Dset_extent(dataset, size.data());
  H5Sclose(space);
  H5Dclose(dataset);
}

inline void change(const std::string& path, const std::vector<H5Object>& objects, Script& script) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_file_locking(access, false, true);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, access);
  H5Pclose(access);
  if (file < 0) return;
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
      H5Ldelete(file, object.path.c_str(), H5P_DEFAULT);
      if (what / 8 % 4 == 0) H5Lcreate_soft(other.c_str(), file, object.path.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      if (what / 8 % 4 == 1)
        H5Lcreate_external("elsewhere.h5", other.c_str(), file, object.path.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      if (what / 8 % 4 == 2) H5Lcreate_hard(file, other.c_str(), file, object.path.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    }
  }
  H5Fclose(file);
}

}  // namespace lgiw::fuzz
