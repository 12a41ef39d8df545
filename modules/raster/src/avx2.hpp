#pragma once
// Small AVX2 helpers. Included by kernel_simd.cpp only.

#include <immintrin.h>

#include <cstdint>

#define GNOMON_AVX2 __attribute__((target("avx2")))
#define GNOMON_AVX2_INLINE __attribute__((target("avx2"), always_inline)) inline

namespace gnomon::raster::detail {

namespace {

GNOMON_AVX2_INLINE __m256i all_of(std::int32_t v) { return _mm256_set1_epi32(v); }
GNOMON_AVX2_INLINE __m256 all_of(float v) { return _mm256_set1_ps(v); }
GNOMON_AVX2_INLINE __m256 as_float(__m256i v) { return _mm256_castsi256_ps(v); }
GNOMON_AVX2_INLINE __m256i as_int(__m256 v) { return _mm256_castps_si256(v); }
GNOMON_AVX2_INLINE __m256i iota() { return _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7); }
GNOMON_AVX2_INLINE std::uint32_t sign_bits(__m256i v) {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(as_float(v)));
}
/// mask ? b : a, by the mask's sign bits.
GNOMON_AVX2_INLINE __m256i select(__m256i a, __m256i b, __m256i mask) {
    return as_int(_mm256_blendv_ps(as_float(a), as_float(b), as_float(mask)));
}
GNOMON_AVX2_INLINE __m256i is_less(__m256i a, __m256i b) { return _mm256_cmpgt_epi32(b, a); }

GNOMON_AVX2_INLINE __m128i low_half(__m256i v) { return _mm256_castsi256_si128(v); }
GNOMON_AVX2_INLINE __m128i high_half(__m256i v) { return _mm256_extracti128_si256(v, 1); }
GNOMON_AVX2_INLINE __m256i joined(__m128 low, __m128 high) {
    return as_int(_mm256_insertf128_ps(_mm256_castps128_ps256(low), high, 1));
}

/// Four rows of eight (x, y, z, w in lanes) to and from eight structs of four, as [0|4] [1|5] [2|6] [3|7].
struct Four {
    __m256i v[4];
};
GNOMON_AVX2_INLINE Four transposed_4x4(__m256i a, __m256i b, __m256i c, __m256i d) {
    __m256i const ab_lo = _mm256_unpacklo_epi32(a, b);
    __m256i const ab_hi = _mm256_unpackhi_epi32(a, b);
    __m256i const cd_lo = _mm256_unpacklo_epi32(c, d);
    __m256i const cd_hi = _mm256_unpackhi_epi32(c, d);
    return {{_mm256_unpacklo_epi64(ab_lo, cd_lo), _mm256_unpackhi_epi64(ab_lo, cd_lo),
             _mm256_unpacklo_epi64(ab_hi, cd_hi), _mm256_unpackhi_epi64(ab_hi, cd_hi)}};
}

/// Rows to columns, in place.
GNOMON_AVX2_INLINE void transpose_8x8(__m256i (&v)[8]) {
    Four const low = transposed_4x4(v[0], v[1], v[2], v[3]);
    Four const high = transposed_4x4(v[4], v[5], v[6], v[7]);
    for (int i = 0; i < 4; ++i) {
        v[i] = _mm256_permute2x128_si256(low.v[i], high.v[i], 0x20);
        v[i + 4] = _mm256_permute2x128_si256(low.v[i], high.v[i], 0x31);
    }
}

}  // namespace

}  // namespace gnomon::raster::detail
