// Marks what runs on the host and on a CUDA device alike. Everything in lib/physics is C++17 and free of allocation,
// exceptions and I/O, so that one source serves both.
#pragma once

#if defined(__CUDACC__)
#define LGIW_FN __host__ __device__ __forceinline__
#else
#define LGIW_FN inline __attribute__((always_inline))
#endif

/// After the parameters of a lambda that is the body of a pair loop: a call left in the loop keeps it from vectorising.
#define LGIW_INLINE __attribute__((always_inline))

/// Before a loop over components inside a pair loop: with a loop left in it the pair loop does not vectorise.
#if defined(__CUDACC__)
#define LGIW_COMPONENTS _Pragma("unroll")
#else
#define LGIW_COMPONENTS _Pragma("GCC unroll 9")
#endif
