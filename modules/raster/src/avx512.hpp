#pragma once
// Small AVX-512 helpers. Included by kernel_avx512.cpp only.

#include "sample_loop.hpp"

#include <immintrin.h>

#include <cstdint>

#define GNOMON_AVX512 __attribute__((target("avx2,avx512f,avx512bw,avx512dq,avx512vl")))
#define GNOMON_AVX512_INLINE __attribute__((target("avx2,avx512f,avx512bw,avx512dq,avx512vl"), always_inline)) inline

namespace gnomon::raster::detail {

namespace {

GNOMON_AVX512_INLINE __m512i all16(std::int32_t v) { return _mm512_set1_epi32(v); }
GNOMON_AVX512_INLINE __m512 all16(float v) { return _mm512_set1_ps(v); }
GNOMON_AVX512_INLINE __m512i or16(__m512i a, __m512i b, __m512i c) { return _mm512_ternarylogic_epi32(a, b, c, 0xFE); }

/// Column and row of each sample of a block of 4 x 4.
GNOMON_AVX512_INLINE __m512i block_columns() {
    return _mm512_setr_epi32(0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3);
}
GNOMON_AVX512_INLINE __m512i block_rows() { return _mm512_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3); }
/// `step_x`, `step_y` times each sample's column and row.
GNOMON_AVX512_INLINE __m512i block_steps(std::int32_t step_x, std::int32_t step_y) {
    return _mm512_add_epi32(_mm512_mullo_epi32(all16(step_x), block_columns()),
                            _mm512_mullo_epi32(all16(step_y), block_rows()));
}

/// Two vectors of eight doubles, for sixteen samples.
struct Double16 {
    __m512d low, high;
};
GNOMON_AVX512_INLINE Double16 block_steps(double step_x, double step_y) {
    __m512d const columns = _mm512_setr_pd(0, 1, 2, 3, 0, 1, 2, 3);
    __m512d const rows = _mm512_setr_pd(0, 0, 0, 0, 1, 1, 1, 1);
    __m512d const low =
        _mm512_add_pd(_mm512_mul_pd(_mm512_set1_pd(step_x), columns), _mm512_mul_pd(_mm512_set1_pd(step_y), rows));
    return {low, _mm512_add_pd(low, _mm512_set1_pd(step_y + step_y))};
}
GNOMON_AVX512_INLINE __m512 joined16(__m256 low, __m256 high) {
    return _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
}

/// Four vectors of four quarters each, transposed: also its own inverse.
struct Four16 {
    __m512i v[4];
};
GNOMON_AVX512_INLINE Four16 transposed_quarters(__m512i a, __m512i b, __m512i c, __m512i d) {
    __m512i const ab_low = _mm512_shuffle_i32x4(a, b, 0x44);   // a0 a1 b0 b1
    __m512i const cd_low = _mm512_shuffle_i32x4(c, d, 0x44);   // c0 c1 d0 d1
    __m512i const ab_high = _mm512_shuffle_i32x4(a, b, 0xEE);  // a2 a3 b2 b3
    __m512i const cd_high = _mm512_shuffle_i32x4(c, d, 0xEE);
    return {{_mm512_shuffle_i32x4(ab_low, cd_low, 0x88), _mm512_shuffle_i32x4(ab_low, cd_low, 0xDD),
             _mm512_shuffle_i32x4(ab_high, cd_high, 0x88), _mm512_shuffle_i32x4(ab_high, cd_high, 0xDD)}};
}

}  // namespace

}  // namespace gnomon::raster::detail
