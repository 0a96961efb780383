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

#include "physics/platform.hh"

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
  static constexpr int block = 128;  // threads
  /// Particles that a thread finds before it computes them (Pass::for_each_listed): 16 KiB of shared memory a block.
  static constexpr int list = 32;
  /// True if it is for any of the threads that run side by side. What follows from it must be right for each of them,
  /// whatever the others say: which they are is left to the device.
  static LGIW_FN bool any_beside(bool mine) {
#if defined(__CUDA_ARCH__)
    return __any_sync(__activemask(), mine);
#else
    return mine;
#endif
  }
};
/// No machine has vectors of more floats.
constexpr int widest_lanes = 16;

}  // namespace lgiw
