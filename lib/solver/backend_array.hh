// Arrays of a backend: fixed size, uninitialised, owned.
#pragma once

#include <cstddef>
#include <utility>

namespace lgiw {

/// n values of T in memory of a backend; contents are undefined until written. `Memory` has
///   static void* take(std::size_t bytes)   never null; throws where there is no memory left
///   static void give(void*)
template <class T, class Memory>
class BackendArray {
 public:
  BackendArray() = default;
  explicit BackendArray(std::size_t n) : size_(n) {
    if (n) data_ = static_cast<T*>(Memory::take(n * sizeof(T)));
  }
  ~BackendArray() {
    if (data_) Memory::give(data_);
  }
  BackendArray(BackendArray&& o) noexcept { swap(o); }
  BackendArray& operator=(BackendArray&& o) noexcept {
    swap(o);
    return *this;
  }
  void swap(BackendArray& o) noexcept {
    std::swap(data_, o.data_);
    std::swap(size_, o.size_);
  }
  T* data() const { return data_; }
  std::size_t size() const { return size_; }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace lgiw
