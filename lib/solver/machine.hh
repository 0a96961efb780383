// For which processor the passes are compiled. The CPU solver is compiled several times from one source, and the widest
// instructions that the processor has are chosen at run time (simulation.cc). LGIW_LANES says which: the number of
// floats in a vector.
//
// Only what is templated on the machine is compiled with these instructions. All else, the standard library too, must
// be included before #pragma GCC target: the linker keeps one copy of an inline function, and it must run anywhere.
#pragma once

#if !defined(LGIW_LANES)
#define LGIW_LANES 4
#endif

#if LGIW_LANES > 4
#include <immintrin.h>
#endif

namespace lgiw {

/// Part of Traits. tiles: the passes find copies of their neighbours, made for a tile of particles at a time
/// (tiles.hh).
template <int lanes_>
struct Cpu {
  static constexpr bool tiles = true;
  static constexpr int lanes = lanes_;
};
struct CudaDevice {
  static constexpr bool tiles = false;
};
/// No machine has vectors of more floats.
constexpr int widest_lanes = 16;

}  // namespace lgiw
