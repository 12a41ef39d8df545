#pragma once
// Eight vertices at a time; the arithmetic of `to_clip`, `outcode_of` and `snap_of`. Included by kernel_simd.cpp only.

#include "avx2.hpp"
#include "pieces.hpp"

namespace gnomon::raster::detail {

namespace {

struct Clip4x8 {
    __m256 v[4];
};

GNOMON_AVX2_INLINE Clip4x8 to_clip_x8(VertexJob const& job, unsigned char const* from, __m256i offsets) {
    __m256 p[3];
    for (int i = 0; i < 3; ++i)
        p[i] = _mm256_sub_ps(_mm256_i32gather_ps(reinterpret_cast<float const*>(from + 4 * i), offsets, 1),
                             all_of(job.origin[i]));
    Clip4x8 clip;
    for (int r = 0; r < 4; ++r) {
        __m256 const xy =
            _mm256_add_ps(_mm256_mul_ps(all_of(job.row[r][0]), p[0]), _mm256_mul_ps(all_of(job.row[r][1]), p[1]));
        clip.v[r] = _mm256_add_ps(_mm256_add_ps(xy, _mm256_mul_ps(all_of(job.row[r][2]), p[2])), all_of(job.row[r][3]));
    }
    return clip;
}

GNOMON_AVX2_INLINE __m256i bit_where(__m256 mask, std::uint32_t bit) {
    return _mm256_and_si256(as_int(mask), all_of(static_cast<std::int32_t>(bit)));
}

GNOMON_AVX2_INLINE __m256i outcode_x8(Clip4x8 const& c, VertexJob const& job) {
    __m256 const sign = all_of(-0.0F);
    __m256 usable = _mm256_castsi256_ps(all_of(-1));
    for (__m256 const& v : c.v)
        usable =
            _mm256_and_ps(usable, _mm256_cmp_ps(_mm256_andnot_ps(sign, v), all_of(max_clip_coordinate), _CMP_LE_OQ));
    __m256 const w = c.v[3];
    __m256 const gx = _mm256_mul_ps(all_of(job.guard_x), w);
    __m256 const gy = _mm256_mul_ps(all_of(job.guard_y), w);
    __m256i code = bit_where(_mm256_cmp_ps(w, all_of(min_w), _CMP_LT_OQ), code_w);
    if (job.clip_depth) {
        code = _mm256_or_si256(code, bit_where(_mm256_cmp_ps(c.v[2], all_of(0.0F), _CMP_LT_OQ), code_z_low));
        code = _mm256_or_si256(code, bit_where(_mm256_cmp_ps(c.v[2], w, _CMP_GT_OQ), code_z_high));
    }
    code = _mm256_or_si256(code, bit_where(_mm256_cmp_ps(c.v[0], _mm256_xor_ps(sign, gx), _CMP_LT_OQ), code_x_low));
    code = _mm256_or_si256(code, bit_where(_mm256_cmp_ps(c.v[0], gx, _CMP_GT_OQ), code_x_high));
    code = _mm256_or_si256(code, bit_where(_mm256_cmp_ps(c.v[1], _mm256_xor_ps(sign, gy), _CMP_LT_OQ), code_y_low));
    code = _mm256_or_si256(code, bit_where(_mm256_cmp_ps(c.v[1], gy, _CMP_GT_OQ), code_y_high));
    return select(all_of(static_cast<std::int32_t>(code_not_finite)), code, as_int(usable));
}

struct Rounded8 {
    __m256i value, residue;
};

/// Pixels to fixed point, and `residue_of` what was rounded.
GNOMON_AVX2_INLINE Rounded8 rounded_x8(__m256 pixels) {
    __m256 const scaled = _mm256_mul_ps(pixels, all_of(256.0F));
    __m256i const value = _mm256_cvtps_epi32(scaled);
    __m256 const rest =
        _mm256_mul_ps(_mm256_sub_ps(scaled, _mm256_cvtepi32_ps(value)), all_of(static_cast<float>(residue_scale)));
    return {value, _mm256_min_epi32(_mm256_cvtps_epi32(rest), all_of(2047))};
}

GNOMON_AVX2_INLINE void snap_x8(Clip4x8 const& c, VertexJob const& job, __m256i code, Corner* out) {
    __m256i const valid = _mm256_cmpeq_epi32(code, _mm256_setzero_si256());
    __m256 const r = _mm256_div_ps(all_of(1.0F), c.v[3]);
    __m256 const half_x = all_of(job.half_width);
    __m256 const half_y = all_of(job.half_height);
    __m256 const px = _mm256_add_ps(_mm256_mul_ps(_mm256_mul_ps(c.v[0], r), half_x), half_x);
    __m256 const py = _mm256_add_ps(_mm256_mul_ps(_mm256_mul_ps(c.v[1], r), half_y), half_y);
    __m256 z = _mm256_mul_ps(c.v[2], r);
    if (job.clip_depth) z = _mm256_min_ps(_mm256_max_ps(z, all_of(0.0F)), all_of(1.0F));
    Rounded8 const x = rounded_x8(px);
    Rounded8 const y = rounded_x8(py);
    __m256i const residues = _mm256_or_si256(_mm256_slli_epi32(y.residue, 20),
                                             _mm256_slli_epi32(_mm256_and_si256(x.residue, all_of(0xFFF)), 8));
    Four const corners = transposed_4x4(_mm256_and_si256(_mm256_add_epi32(x.value, all_of(job.offset_x)), valid),
                                        _mm256_and_si256(_mm256_add_epi32(y.value, all_of(job.offset_y)), valid),
                                        _mm256_and_si256(as_int(z), valid), select(code, residues, valid));
    __m256i* const to = reinterpret_cast<__m256i*>(out);
    _mm256_storeu_si256(to, _mm256_permute2x128_si256(corners.v[0], corners.v[1], 0x20));
    _mm256_storeu_si256(to + 1, _mm256_permute2x128_si256(corners.v[2], corners.v[3], 0x20));
    _mm256_storeu_si256(to + 2, _mm256_permute2x128_si256(corners.v[0], corners.v[1], 0x31));
    _mm256_storeu_si256(to + 3, _mm256_permute2x128_si256(corners.v[2], corners.v[3], 0x31));
}

GNOMON_AVX2 void avx2_transform(VertexJob const& job, std::size_t begin, std::size_t end, Corner* out) {
    if (job.stride < (std::size_t{1} << 24U)) {
        __m256i const offsets = _mm256_mullo_epi32(iota(), all_of(static_cast<std::int32_t>(job.stride)));
        for (; begin + 8 <= end; begin += 8, out += 8) {
            Clip4x8 const clip = to_clip_x8(job, job.positions + begin * job.stride, offsets);
            snap_x8(clip, job, outcode_x8(clip, job), out);
        }
    }
    scalar_kernel().transform(job, begin, end, out);
}

}  // namespace

}  // namespace gnomon::raster::detail
