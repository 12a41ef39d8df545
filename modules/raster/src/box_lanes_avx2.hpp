#pragma once
// Eight lanes in a register: what box_core.hpp computes with. Included by box_test_simd.cpp only.

#include "avx2.hpp"

namespace gnomon::raster::detail::avx2_lanes {

struct F8 {
    __m256 v;
};
struct I8 {
    __m256i v;
};
struct M8 {
    __m256 v;
};

GNOMON_AVX2_INLINE F8 all(float x) { return {_mm256_set1_ps(x)}; }
GNOMON_AVX2_INLINE I8 all(std::int32_t x) { return {_mm256_set1_epi32(x)}; }
GNOMON_AVX2_INLINE F8 load(float const* p) { return {_mm256_loadu_ps(p)}; }
GNOMON_AVX2_INLINE void store(float* p, F8 a) { _mm256_storeu_ps(p, a.v); }
GNOMON_AVX2_INLINE void store(std::int32_t* p, I8 a) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), a.v); }
GNOMON_AVX2_INLINE F8 operator+(F8 a, F8 b) { return {_mm256_add_ps(a.v, b.v)}; }
GNOMON_AVX2_INLINE F8 operator-(F8 a, F8 b) { return {_mm256_sub_ps(a.v, b.v)}; }
GNOMON_AVX2_INLINE F8 operator*(F8 a, F8 b) { return {_mm256_mul_ps(a.v, b.v)}; }
GNOMON_AVX2_INLINE F8 operator/(F8 a, F8 b) { return {_mm256_div_ps(a.v, b.v)}; }
GNOMON_AVX2_INLINE F8 lesser(F8 a, F8 b) { return {_mm256_min_ps(a.v, b.v)}; }
GNOMON_AVX2_INLINE F8 greater(F8 a, F8 b) { return {_mm256_max_ps(a.v, b.v)}; }
GNOMON_AVX2_INLINE F8 magnitude(F8 a) { return {_mm256_andnot_ps(_mm256_set1_ps(-0.0F), a.v)}; }
GNOMON_AVX2_INLINE M8 operator<(F8 a, F8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
GNOMON_AVX2_INLINE M8 operator<=(F8 a, F8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)}; }
GNOMON_AVX2_INLINE M8 operator&(M8 a, M8 b) { return {_mm256_and_ps(a.v, b.v)}; }
GNOMON_AVX2_INLINE M8 operator|(M8 a, M8 b) { return {_mm256_or_ps(a.v, b.v)}; }
GNOMON_AVX2_INLINE M8 without(M8 a, M8 b) { return {_mm256_andnot_ps(b.v, a.v)}; }
GNOMON_AVX2_INLINE std::uint32_t bits_of(M8 m) { return static_cast<std::uint32_t>(_mm256_movemask_ps(m.v)); }
GNOMON_AVX2_INLINE F8 choose(M8 m, F8 yes, F8 no) { return {_mm256_blendv_ps(no.v, yes.v, m.v)}; }

GNOMON_AVX2_INLINE I8 operator+(I8 a, I8 b) { return {_mm256_add_epi32(a.v, b.v)}; }
GNOMON_AVX2_INLINE I8 operator-(I8 a, I8 b) { return {_mm256_sub_epi32(a.v, b.v)}; }
GNOMON_AVX2_INLINE I8 lesser(I8 a, I8 b) { return {_mm256_min_epi32(a.v, b.v)}; }
GNOMON_AVX2_INLINE I8 greater(I8 a, I8 b) { return {_mm256_max_epi32(a.v, b.v)}; }
GNOMON_AVX2_INLINE I8 shifted_down(I8 a, int bits) { return {_mm256_sra_epi32(a.v, _mm_cvtsi32_si128(bits))}; }
GNOMON_AVX2_INLINE I8 shifted_up(I8 a, int bits) { return {_mm256_sll_epi32(a.v, _mm_cvtsi32_si128(bits))}; }
GNOMON_AVX2_INLINE M8 operator<(I8 a, I8 b) { return {as_float(_mm256_cmpgt_epi32(b.v, a.v))}; }
GNOMON_AVX2_INLINE F8 to_float(I8 a) { return {_mm256_cvtepi32_ps(a.v)}; }
GNOMON_AVX2_INLINE I8 to_nearest(F8 a) { return {_mm256_cvtps_epi32(a.v)}; }
GNOMON_AVX2_INLINE I8 lane_numbers() { return {iota()}; }
GNOMON_AVX2_INLINE F8 load_codes(std::uint16_t const* p) {
    return {_mm256_cvtepi32_ps(_mm256_cvtepu16_epi32(_mm_loadu_si128(reinterpret_cast<__m128i const*>(p))))};
}

/// Eight boxes of six floats: element c of each.
GNOMON_AVX2_INLINE void load_boxes(float const* const (&box)[8], F8 (&element)[6]) {
    // Two loads of four that overlap in the middle: nothing is read past a box.
    __m256i low[4];
    __m256i high[4];
    for (int i = 0; i < 4; ++i) {
        low[i] = joined(_mm_loadu_ps(box[i]), _mm_loadu_ps(box[i + 4]));
        high[i] = joined(_mm_loadu_ps(box[i] + 2), _mm_loadu_ps(box[i + 4] + 2));
    }
    Four const a = transposed_4x4(low[0], low[1], low[2], low[3]);
    Four const b = transposed_4x4(high[0], high[1], high[2], high[3]);
    // Halves hold boxes 0-3 and 4-7, each in the order that the four rows went in.
    for (int c = 0; c < 4; ++c) element[c] = {as_float(a.v[c])};
    for (int c = 4; c < 6; ++c) element[c] = {as_float(b.v[c - 2])};
}

}  // namespace gnomon::raster::detail::avx2_lanes
