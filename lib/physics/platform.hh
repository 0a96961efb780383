// Marks what runs on the host and on a CUDA device alike. Everything in lib/physics is C++17 and free of allocation,
// exceptions and I/O, so that one source serves both.
#pragma once

#if defined(__CUDACC__)
#define LGIW_FN __host__ __device__ __forceinline__
#else
#define LGIW_FN inline __attribute__((always_inline))
#endif
