#pragma once
// Eight triangles turned as `orient` turns one, their depths moved. Included by kernel_simd.cpp only.

#include "avx2.hpp"
#include "pieces.hpp"

namespace gnomon::raster::detail {

namespace {

/// Corner k of eight triangles.
struct Corner8 {
    __m256i x, y, z, code;
};

GNOMON_AVX2_INLINE __m256i residues_x(Corner8 const& c) { return _mm256_srai_epi32(_mm256_slli_epi32(c.code, 12), 20); }
GNOMON_AVX2_INLINE __m256i residues_y(Corner8 const& c) { return _mm256_srai_epi32(c.code, 20); }

/// From a to b before snapping, in residue units. A triangle of 64 pixels keeps it below 2^27.
struct Side8 {
    __m256i x, y;
};
GNOMON_AVX2_INLINE __m256i unsnapped_x8(__m256i a, __m256i b, __m256i residue_a, __m256i residue_b) {
    return _mm256_add_epi32(_mm256_slli_epi32(_mm256_sub_epi32(b, a), 12), _mm256_sub_epi32(residue_b, residue_a));
}
GNOMON_AVX2_INLINE Side8 unsnapped_side_x8(Corner8 const& a, Corner8 const& b) {
    return {unsnapped_x8(a.x, b.x, residues_x(a), residues_x(b)), unsnapped_x8(a.y, b.y, residues_y(a), residues_y(b))};
}

struct Sides8 {
    Side8 one, two;
};

GNOMON_AVX2_INLINE __m256d wide(__m256i v, bool high) { return _mm256_cvtepi32_pd(high ? high_half(v) : low_half(v)); }
GNOMON_AVX2_INLINE __m256d wide_float(__m256i v, bool high) {
    return _mm256_cvtps_pd(_mm_castsi128_ps(high ? high_half(v) : low_half(v)));
}

/// `move_depths` for four triangles.
GNOMON_AVX2_INLINE void move_depths_x4(Corner8 const (&v)[3], Sides8 const& side, __m256i area, bool high,
                                       __m128 (&moved)[3]) {
    __m256d const z[3] = {wide_float(v[0].z, high), wide_float(v[1].z, high), wide_float(v[2].z, high)};
    __m256d const x1 = wide(side.one.x, high);
    __m256d const y1 = wide(side.one.y, high);
    __m256d const x2 = wide(side.two.x, high);
    __m256d const y2 = wide(side.two.y, high);
    __m256d const d1 = _mm256_sub_pd(z[1], z[0]);
    __m256d const d2 = _mm256_sub_pd(z[2], z[0]);
    __m256d const true_area = _mm256_sub_pd(_mm256_mul_pd(x1, y2), _mm256_mul_pd(x2, y1));
    __m256d const least_area = _mm256_mul_pd(wide(area, high), _mm256_set1_pd(0.0625 * residue_scale * residue_scale));
    __m256d const scale =
        _mm256_and_pd(_mm256_div_pd(_mm256_set1_pd(1.0), true_area), _mm256_cmp_pd(true_area, least_area, _CMP_GE_OQ));
    __m256d const gx = _mm256_mul_pd(_mm256_sub_pd(_mm256_mul_pd(d1, y2), _mm256_mul_pd(d2, y1)), scale);
    __m256d const gy = _mm256_mul_pd(_mm256_sub_pd(_mm256_mul_pd(d2, x1), _mm256_mul_pd(d1, x2)), scale);
    __m256d const most = _mm256_max_pd(z[1], z[2]);
    __m256d const slack = _mm256_mul_pd(_mm256_sub_pd(most, z[0]), _mm256_set1_pd(0.125));
    __m256d const low = _mm256_max_pd(_mm256_sub_pd(z[0], slack), _mm256_min_pd(z[0], _mm256_setzero_pd()));
    __m256d const limit = _mm256_max_pd(most, _mm256_set1_pd(1.0));
    __m256d const above = _mm256_min_pd(_mm256_add_pd(most, slack), limit);
    for (int i = 0; i < 3; ++i) {
        __m256d const rx = wide(residues_x(v[i]), high);
        __m256d const ry = wide(residues_y(v[i]), high);
        __m256d const shift = _mm256_add_pd(_mm256_mul_pd(gx, rx), _mm256_mul_pd(gy, ry));
        moved[i] = _mm256_cvtpd_ps(_mm256_min_pd(_mm256_max_pd(_mm256_sub_pd(z[i], shift), low), above));
    }
}

GNOMON_AVX2_INLINE Corner8 selected(Corner8 const& a, Corner8 const& b, __m256i mask) {
    return {select(a.x, b.x, mask), select(a.y, b.y, mask), select(a.z, b.z, mask), select(a.code, b.code, mask)};
}

/// Counts the corners from the one with the least depth.
GNOMON_AVX2_INLINE void turn_to_least(Corner8 (&v)[3]) {
    __m256 const one_first = _mm256_cmp_ps(as_float(v[1].z), as_float(v[0].z), _CMP_LT_OQ);
    __m256 const nearest = _mm256_blendv_ps(as_float(v[0].z), as_float(v[1].z), one_first);
    __m256i const two = as_int(_mm256_cmp_ps(as_float(v[2].z), nearest, _CMP_LT_OQ));
    __m256i const one = as_int(one_first);
    Corner8 const from[3] = {v[0], v[1], v[2]};
    for (int i = 0; i < 3; ++i) v[i] = selected(selected(from[i], from[(i + 1) % 3], one), from[(i + 2) % 3], two);
}

/// Turns the corners so that the area is positive, moves their depths, and counts from the least.
GNOMON_AVX2_INLINE void orient_x8(Corner8 (&v)[3], __m256i area, __m256i signed_area) {
    Corner8 const b = v[1];
    Corner8 const c = v[2];
    v[1] = selected(b, c, signed_area);
    v[2] = selected(c, b, signed_area);
    turn_to_least(v);
    Sides8 const sides{unsnapped_side_x8(v[0], v[1]), unsnapped_side_x8(v[0], v[2])};
    __m128 low[3];
    __m128 high[3];
    move_depths_x4(v, sides, area, false, low);
    move_depths_x4(v, sides, area, true, high);
    for (int i = 0; i < 3; ++i) v[i].z = joined(low[i], high[i]);
    turn_to_least(v);
}

}  // namespace

}  // namespace gnomon::raster::detail
