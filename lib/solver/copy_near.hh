// Copies the particles within reach of a box side by side, in the instructions for which the file is compiled: vectors
// of LGIW_LANES floats (machine.hh).
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "solver/machine.hh"

namespace lgiw {

/// Particles closer than sqrt(reach2) to the box are near it.
template <class T, int D>
struct NearBox {
  T low[D], high[D], reach2;
};

/// Ranges [first, second) of particles.
using Ranges = std::vector<std::pair<int, int>>;

/// The tiles of a phase, in the order of their cells: the particles of cells that are not empty, the boxes around them,
/// and the rows of cells [first, second) that hold everything near. Found once after a sort, for all passes of a step.
template <class T, int D>
struct TileTable {
  static constexpr int most_rows = D == 2 ? 5 : 25;  // a box in a cell is near five slabs along each axis at most
  int n = 0;
  int* cell = nullptr;                  // [n]
  int* row_count = nullptr;             // [n]
  std::pair<int, int>* rows = nullptr;  // [n][most_rows]
  NearBox<T, D>* box = nullptr;         // [n]
};
/// Of a backend whose passes find their neighbours by themselves.
template <class T, int D>
struct NoTiles {
  const TileTable<T, D>* table() const { return nullptr; }
  const unsigned char* cells_near() const { return nullptr; }
  template <class F>
  void all(F&&) {}
};

/// Appends the fields of those particles of the ranges that are near the box to to[f] + n, in order; the first D fields
/// are the places, and index[n], unless it is null, gets the particle's number. Returns the new n. Up to
/// `widest_lanes` numbers behind it are overwritten.
template <int lanes, class T, int D>
int copy_near(const NearBox<T, D>& box, int fields, const T* const* from, const Ranges& ranges, T* const* to, int n,
              int* index = nullptr) {
  for (const auto& [begin, end] : ranges)
    for (int j = begin; j < end; ++j) {
      T d2 = 0;
      for (int k = 0; k < D; ++k) {
        const T x = from[k][j], below = box.low[k] - x, above = x - box.high[k];
        const T d = below > above ? below : above;
        d2 += d > 0 ? d * d : T(0);
      }
      for (int f = 0; f < fields; ++f) to[f][n] = from[f][j];
      if (index) index[n] = j;
      n += d2 < box.reach2;  // no branch: half of them are near
    }
  return n;
}

#if LGIW_LANES == 16
template <int lanes, int D>
int copy_near(const NearBox<float, D>& box, int fields, const float* const* from, const Ranges& ranges,
              float* const* to, int n, int* index = nullptr) {
  const __m512i lane = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const __m512 zero = _mm512_setzero_ps(), reach2 = _mm512_set1_ps(box.reach2);
  __m512 low[D], high[D];
  for (int k = 0; k < D; ++k) low[k] = _mm512_set1_ps(box.low[k]), high[k] = _mm512_set1_ps(box.high[k]);
  for (const auto& [begin, end] : ranges)
    for (int j = begin; j < end; j += 16) {
      const __mmask16 present = end - j >= 16 ? __mmask16(0xffff) : __mmask16((1u << (end - j)) - 1);
      __m512 d2 = zero;
      for (int k = 0; k < D; ++k) {
        const __m512 x = _mm512_maskz_loadu_ps(present, from[k] + j);
        // Masked: GCC 12 warns of uninitialised values in the plain maximum.
        const __m512 outside = _mm512_maskz_max_ps(present, _mm512_sub_ps(low[k], x), _mm512_sub_ps(x, high[k]));
        const __m512 d = _mm512_maskz_max_ps(present, zero, outside);
        d2 = _mm512_fmadd_ps(d, d, d2);
      }
      const __mmask16 near = _mm512_mask_cmp_ps_mask(present, d2, reach2, _CMP_LT_OQ);
      for (int f = 0; f < fields; ++f)
        _mm512_storeu_ps(to[f] + n, _mm512_maskz_compress_ps(near, _mm512_maskz_loadu_ps(near, from[f] + j)));
      if (index)
        _mm512_storeu_si512(index + n, _mm512_maskz_compress_epi32(near, _mm512_add_epi32(_mm512_set1_epi32(j), lane)));
      n += __builtin_popcount(near);
    }
  return n;
}
#elif LGIW_LANES == 8
/// For each mask of 8 lanes: the lanes that it keeps, first.
struct CompressTable {
  alignas(32) std::int32_t lane[256][8];
  constexpr CompressTable() : lane() {
    for (int mask = 0; mask < 256; ++mask)
      for (int k = 0, n = 0; k < 8; ++k)
        if (mask >> k & 1) lane[mask][n++] = k;
  }
};
inline constexpr CompressTable compress_table;

template <int lanes, int D>
int copy_near(const NearBox<float, D>& box, int fields, const float* const* from, const Ranges& ranges,
              float* const* to, int n, int* index = nullptr) {
  const __m256 zero = _mm256_setzero_ps(), reach2 = _mm256_set1_ps(box.reach2);
  const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  __m256 low[D], high[D];
  for (int k = 0; k < D; ++k) low[k] = _mm256_set1_ps(box.low[k]), high[k] = _mm256_set1_ps(box.high[k]);
  for (const auto& [begin, end] : ranges)
    for (int j = begin; j < end; j += 8) {
      const __m256i present = _mm256_cmpgt_epi32(_mm256_set1_epi32(end - j), lane);
      __m256 d2 = zero;
      for (int k = 0; k < D; ++k) {
        const __m256 x = _mm256_maskload_ps(from[k] + j, present);
        const __m256 d = _mm256_max_ps(zero, _mm256_max_ps(_mm256_sub_ps(low[k], x), _mm256_sub_ps(x, high[k])));
        d2 = _mm256_fmadd_ps(d, d, d2);
      }
      const __m256 close = _mm256_and_ps(_mm256_cmp_ps(d2, reach2, _CMP_LT_OQ), _mm256_castsi256_ps(present));
      const int near = _mm256_movemask_ps(close);
      const __m256i order = _mm256_load_si256(reinterpret_cast<const __m256i*>(compress_table.lane[near]));
      for (int f = 0; f < fields; ++f)
        _mm256_storeu_ps(to[f] + n, _mm256_permutevar8x32_ps(_mm256_maskload_ps(from[f] + j, present), order));
      if (index)
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(index + n), _mm256_add_epi32(_mm256_set1_epi32(j), order));
      n += __builtin_popcount(unsigned(near));
    }
  return n;
}
#endif

}  // namespace lgiw
