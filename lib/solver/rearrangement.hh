// What happens to the fields of a phase when its particles are brought into another order.
#pragma once

#include <cstddef>
#include <type_traits>

namespace lgiw {

/// One field of n values that is gathered into another array, copied or rounded into one. Lists of them are carried out
/// in order: a field may go to where the one before it has come from.
class Rearrangement {
 public:
  /// to[i] = from[order[i]].
  template <class U>
  static Rearrangement gathered(U* to, const U* from) {
    return {kind_of<U>(), true, to, from};
  }
  /// to[i] = from[i].
  template <class U>
  static Rearrangement copied(U* to, const U* from) {
    return {kind_of<U>(), false, to, from};
  }
  /// to[i] = from[i], in single precision.
  static Rearrangement rounded(float* to, const double* from) { return {Kind::rounded, false, to, from}; }

  bool gathers() const { return gathers_; }
  /// Bytes of a value where both arrays have the same type, else 0.
  std::size_t width() const {
    return kind_ == Kind::rounded ? 0 : (kind_ == Kind::doubles ? sizeof(double) : sizeof(float));
  }
  void* to() const { return to_; }
  const void* from() const { return from_; }
  /// Calls f(to, from) with the pointers as they were given.
  template <class F>
  void with_types(const F& f) const {
    switch (kind_) {
      case Kind::floats:
        return f(static_cast<float*>(to_), static_cast<const float*>(from_));
      case Kind::doubles:
        return f(static_cast<double*>(to_), static_cast<const double*>(from_));
      case Kind::ints:
        return f(static_cast<int*>(to_), static_cast<const int*>(from_));
      case Kind::numbers:
        return f(static_cast<unsigned*>(to_), static_cast<const unsigned*>(from_));
      case Kind::rounded:
        return f(static_cast<float*>(to_), static_cast<const double*>(from_));
    }
  }

 private:
  enum class Kind { floats, doubles, ints, numbers, rounded };
  Rearrangement(Kind kind, bool gathers, void* to, const void* from)
      : kind_(kind), gathers_(gathers), to_(to), from_(from) {}
  template <class U>
  static constexpr Kind kind_of() {
    if constexpr (std::is_same_v<U, float>)
      return Kind::floats;
    else if constexpr (std::is_same_v<U, double>)
      return Kind::doubles;
    else if constexpr (std::is_same_v<U, int>)
      return Kind::ints;
    else
      return Kind::numbers;
  }

  Kind kind_;
  bool gathers_;
  void* to_;
  const void* from_;
};

}  // namespace lgiw
