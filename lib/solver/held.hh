// What a thread of a device holds of its neighbours: the one that it computes, of which it has loaded four values at a
// stroke. Pair loops read these as they read the copies near a tile on the CPU.
#pragma once

#include "solver/parameters.hh"

namespace lgiw {

/// A field of the neighbour at hand, whichever it is asked for.
template <class T>
struct Held {
  mutable T value;
  LGIW_FN const T& operator[](int) const { return value; }
};

/// The first values of four, which come by value: by reference a compiler loads them one by one.
template <int D, class T>
LGIW_FN Vec<T, D> vector_in(Four<T> four) {
  Vec<T, D> r;
  for (int k = 0; k < D; ++k) r.c[k] = four.c[k];
  return r;
}
template <int D, class T>
LGIW_FN void hold_vector(Four<T> four, const Held<T> (&to)[D]) {
  for (int k = 0; k < D; ++k) to[k].value = four.c[k];
}

// Of each phase: at(j) is where particle j is, for j up to at_a_stroke - 1 beyond the last; hold(j) the same, and makes
// it the neighbour at hand. Fields that are not held are read where they lie.
template <class Tr>
struct HeldWater : WaterView<Tr> {
  static constexpr int D = Tr::D, at_a_stroke = 4;
  using T = typename Tr::T;
  Held<T> v[D], excess, term;
  LGIW_FN explicit HeldWater(const WaterView<Tr>& all) : WaterView<Tr>(all) {}
  LGIW_FN Vec<T, D> at(int j) const { return vector_in<D>(this->place[j]); }
  LGIW_FN Vec<T, D> hold(int j) const {
    const Four<T> there = this->place[j], moving = this->motion[j];
    hold_vector(moving, v);
    term.value = there.c[D], excess.value = moving.c[D];
    return vector_in<D>(there);
  }
};
template <class Tr>
struct HeldSoil : SoilView<Tr> {
  static constexpr int D = Tr::D, at_a_stroke = 4;
  using T = typename Tr::T;
  Held<T> v[D], image_excess, image_term;
  LGIW_FN explicit HeldSoil(const SoilView<Tr>& all) : SoilView<Tr>(all) {}
  LGIW_FN Vec<T, D> at(int j) const { return vector_in<D>(this->place[j]); }
  LGIW_FN Vec<T, D> hold(int j) const {
    const Four<T> there = this->place[j], moving = this->motion[j];
    hold_vector(moving, v);
    image_term.value = there.c[D], image_excess.value = moving.c[D];
    return vector_in<D>(there);
  }
};
template <class Tr>
struct HeldWall : WallView<Tr> {
  static constexpr int D = Tr::D, at_a_stroke = 4;
  using T = typename Tr::T;
  Held<T> weight;
  LGIW_FN explicit HeldWall(const WallView<Tr>& all) : WallView<Tr>(all) {}
  LGIW_FN Vec<T, D> at(int j) const { return vector_in<D>(this->place[j]); }
  LGIW_FN Vec<T, D> hold(int j) const {
    const Four<T> there = this->place[j];
    weight.value = there.c[D];
    return vector_in<D>(there);
  }
};
/// Bodies are few, and nothing of theirs is kept in fours.
template <class Tr>
struct HeldBodies : BodyView<Tr> {
  static constexpr int D = Tr::D, at_a_stroke = 1;
  using T = typename Tr::T;
  LGIW_FN explicit HeldBodies(const BodyView<Tr>& all) : BodyView<Tr>(all) {}
  LGIW_FN Vec<T, D> at(int j) const {
    Vec<T, D> r;
    for (int k = 0; k < D; ++k) r.c[k] = this->x[k][j];
    return r;
  }
  LGIW_FN Vec<T, D> hold(int j) const { return at(j); }
};

template <class Tr>
struct HeldNear {
  HeldWater<Tr> water;
  HeldSoil<Tr> soil;
  HeldWall<Tr> wall;
  HeldBodies<Tr> bodies;
};

}  // namespace lgiw
