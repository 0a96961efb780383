// What happens to the fields of a phase when its particles are brought into another order.
#pragma once

#include <type_traits>

namespace lgiw {

/// One field of n values that is gathered into another array, or rounded into one. Lists of them are carried out in
/// order: a field may go to where the one before it has come from.
class Rearrangement {
 public:
  /// to[i] = from[order[i]].
  template <class U>
  static Rearrangement gathered(U* to, const U* from) {
    return {kind_of<U>(), to, from};
  }
  /// to[i] = from[i], in single precision.
  static Rearrangement rounded(float* to, const double* from) { return {Kind::rounded, to, from}; }

  bool gathers() const { return kind_ != Kind::rounded; }
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
  Rearrangement(Kind kind, void* to, const void* from) : kind_(kind), to_(to), from_(from) {}
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
  void* to_;
  const void* from_;
};

}  // namespace lgiw
