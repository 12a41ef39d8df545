#pragma once
// The alpha test of four samples at once: the arithmetic of `math::make_tap` and `math::alpha_at`, operation by
// operation, in double. Included by kernel_simd.cpp only.

#include "avx2.hpp"
#include "masked.hpp"

namespace gnomon::raster::detail {

namespace {

GNOMON_AVX2_INLINE __m256d all_of(double v) { return _mm256_set1_pd(v); }

GNOMON_AVX2_INLINE __m256d linear_x4(Linear const& f, __m256d x, __m256d y) {
    return _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(all_of(f.dx), x), _mm256_mul_pd(all_of(f.dy), y)),
                         all_of(f.constant));
}

/// `make_tap` before its texels wrap: the first is at -1 at least and below `size` (mirrored: below 2 `size`).
struct Tap4 {
    __m128i first;
    __m256d weight;
};

GNOMON_AVX2_INLINE Tap4 make_tap_x4(__m256d u, std::int32_t size, math::Wrap wrap) {
    __m256d reduced;
    if (wrap == math::Wrap::repeat) {
        reduced = _mm256_sub_pd(u, _mm256_floor_pd(u));
    } else if (wrap == math::Wrap::clamp) {
        reduced = _mm256_min_pd(_mm256_max_pd(u, _mm256_setzero_pd()), all_of(1.0));  // NaN becomes 0 here
    } else {
        reduced = _mm256_sub_pd(u, _mm256_mul_pd(all_of(2.0), _mm256_floor_pd(_mm256_mul_pd(u, all_of(0.5)))));
    }
    reduced = _mm256_and_pd(reduced, _mm256_cmp_pd(reduced, reduced, _CMP_ORD_Q));
    __m256d const place = _mm256_sub_pd(_mm256_mul_pd(reduced, all_of(static_cast<double>(size))), all_of(0.5));
    __m256d const floor = _mm256_floor_pd(place);
    return {_mm256_cvttpd_epi32(floor), _mm256_sub_pd(place, floor)};
}

GNOMON_AVX2_INLINE __m128i all_of_4(std::int32_t v) { return _mm_set1_epi32(v); }

/// `math::detail::wrapped`.
GNOMON_AVX2_INLINE __m128i wrapped_x4(__m128i i, std::int32_t size, math::Wrap wrap) {
    __m128i const zero = _mm_setzero_si128();
    __m128i const last = all_of_4(size - 1);
    if (wrap == math::Wrap::clamp) return _mm_min_epi32(_mm_max_epi32(i, zero), last);
    __m128i const beyond = _mm_cmpgt_epi32(i, last);
    if (wrap == math::Wrap::repeat) {
        __m128i const below = _mm_cmpgt_epi32(zero, i);
        return _mm_blendv_epi8(_mm_andnot_si128(beyond, i), last, below);
    }
    __m128i const back = _mm_sub_epi32(all_of_4(2 * size - 1), i);
    return _mm_max_epi32(_mm_blendv_epi8(i, back, beyond), zero);  // below 0, and at 2 size: texel 0
}

/// The cell of an `AlphaMap` that a tap lies in, along one axis.
GNOMON_AVX2_INLINE __m128i cell_of(__m128i first, std::int32_t size, math::Wrap wrap) {
    __m128i const next = _mm_add_epi32(first, all_of_4(1));
    if (wrap != math::Wrap::mirror) return next;
    __m128i const back = _mm_sub_epi32(all_of_4(2 * size - 1), first);
    return _mm_blendv_epi8(next, back, _mm_cmpgt_epi32(first, all_of_4(size - 1)));
}

/// Alphas of four texels, as numbers.
GNOMON_AVX2_INLINE __m256d texels_x4(math::AlphaTexture const& texture, __m128i column, __m128i row) {
    if (texture.channels == 4) {
        __m128i const at = _mm_add_epi32(_mm_mullo_epi32(row, all_of_4(texture.size_px.x)), column);
        // A gather reads whole texels, at 32-bit signed places: `fits_gather`.
        __m128i const rgba = _mm_i32gather_epi32(reinterpret_cast<int const*>(texture.texels.data()), at, 4);
        return _mm256_cvtepi32_pd(_mm_srli_epi32(rgba, 24));
    }
    alignas(16) std::int32_t x[4];
    alignas(16) std::int32_t y[4];
    _mm_store_si128(reinterpret_cast<__m128i*>(x), column);
    _mm_store_si128(reinterpret_cast<__m128i*>(y), row);
    double alpha[4];
    for (int i = 0; i < 4; ++i) {
        std::ptrdiff_t const at = std::ptrdiff_t{y[i]} * texture.size_px.x + x[i];
        alpha[i] = static_cast<double>(texture.texels.data()[(at + 1) * texture.channels - 1]);
    }
    return _mm256_loadu_pd(alpha);
}

/// Corner `index` in clip space: x, y, w, 0.
GNOMON_AVX2_INLINE __m256d to_clip_xyw(MaskedDraw const& draw, std::size_t index) {
    VertexJob const& job = *draw.vertex;
    float position[3];
    __builtin_memcpy(position, job.positions + index * job.stride, sizeof position);
    __m128 clip = _mm_mul_ps(_mm_loadu_ps(draw.column[0]), _mm_set1_ps(position[0] - job.origin[0]));
    for (int k = 1; k < 3; ++k)
        clip = _mm_add_ps(clip, _mm_mul_ps(_mm_loadu_ps(draw.column[k]), _mm_set1_ps(position[k] - job.origin[k])));
    return _mm256_cvtps_pd(_mm_add_ps(clip, _mm_loadu_ps(draw.column[3])));
}

GNOMON_AVX2_INLINE __m256d cross(__m256d p, __m256d q) {
    constexpr int yzx = 0b11'00'10'01;
    constexpr int zxy = 0b11'01'00'10;
    return _mm256_sub_pd(_mm256_mul_pd(_mm256_permute4x64_pd(p, yzx), _mm256_permute4x64_pd(q, zxy)),
                         _mm256_mul_pd(_mm256_permute4x64_pd(p, zxy), _mm256_permute4x64_pd(q, yzx)));
}

/// `make_texture_plane`, the three numbers of a sum side by side.
GNOMON_AVX2_INLINE TexturePlane make_texture_plane_x4(MaskedDraw const& draw, std::uint32_t triangle) {
    __m256d clip[3];
    math::vec2 uv[3];
    for (std::size_t i = 0; i < 3; ++i) {
        std::size_t const at = std::size_t{triangle} * 3 + i;
        std::size_t const index = draw.indices.empty() ? at : draw.indices[at];
        clip[i] = to_clip_xyw(draw, index);
        uv[i] = draw.test->uv[index];
    }
    __m256d const zero = _mm256_setzero_pd();
    __m256d sum[3] = {zero, zero, zero};  // of w, u, v
    for (int i = 0; i < 3; ++i) {
        __m256d const weight = cross(clip[(i + 1) % 3], clip[(i + 2) % 3]);
        sum[0] = _mm256_add_pd(sum[0], weight);
        sum[1] = _mm256_add_pd(sum[1], _mm256_mul_pd(weight, all_of(static_cast<double>(uv[i].x))));
        sum[2] = _mm256_add_pd(sum[2], _mm256_mul_pd(weight, all_of(static_cast<double>(uv[i].y))));
    }
    __m256d const scale = _mm256_setr_pd(draw.scale_x, draw.scale_y, 0.0, 0.0);
    __m256d const shift = _mm256_setr_pd(draw.shift_x, draw.shift_y, 1.0, 0.0);
    Linear made[3];
    for (int i = 0; i < 3; ++i) {
        double slope[4];
        double term[4];
        _mm256_storeu_pd(slope, _mm256_mul_pd(sum[i], scale));
        _mm256_storeu_pd(term, _mm256_mul_pd(sum[i], shift));
        made[i] = {slope[0], slope[1], (term[0] + term[1]) + term[2]};
    }
    return {made[0], made[1], made[2]};
}

/// The alpha test of one triangle's samples.
struct Texture4 {
    TexturePlane plane;
    AlphaTest const* test;
    AlphaMap const* map;
    bool uniform_w;    // As in an orthographic view.
    double inverse_w;  // Where it is.

    GNOMON_AVX2_INLINE void set(MaskedDraw const& draw, std::uint32_t triangle) {
        plane = make_texture_plane_x4(draw, triangle);
        test = draw.test;
        map = draw.map;
        uniform_w = plane.w.dx == 0.0 && plane.w.dy == 0.0;
        inverse_w = 1.0 / plane.w(0.0, 0.0);
    }

    /// Bits of the samples, of those in `wanted`, whose alpha is at the cutoff or above. Others' bits may be anything.
    GNOMON_AVX2_INLINE std::uint32_t accepts(__m128i px, __m128i py, std::uint32_t wanted) const {
        math::AlphaTexture const& t = test->texture;
        __m256d const x = _mm256_cvtepi32_pd(px);
        __m256d const y = _mm256_cvtepi32_pd(py);
        __m256d const w = uniform_w ? all_of(inverse_w) : _mm256_div_pd(all_of(1.0), linear_x4(plane.w, x, y));
        Tap4 const u = make_tap_x4(_mm256_mul_pd(linear_x4(plane.u, x, y), w), t.size_px.x, t.wrap_u);
        Tap4 const v = make_tap_x4(_mm256_mul_pd(linear_x4(plane.v, x, y), w), t.size_px.y, t.wrap_v);
        if (map != nullptr) {
            __m128i const cell = cells(u, v);
            auto const solid = static_cast<std::uint32_t>(_mm_movemask_ps(_mm_castsi128_ps(_mm_slli_epi32(cell, 30))));
            auto const clear = static_cast<std::uint32_t>(_mm_movemask_ps(_mm_castsi128_ps(_mm_slli_epi32(cell, 31))));
            if ((wanted & ~(solid | clear)) == 0) return solid;
        }
        return compare(u, v);
    }

    GNOMON_AVX2_INLINE __m128i cells(Tap4 const& u, Tap4 const& v) const {
        math::AlphaTexture const& t = test->texture;
        __m128i const k = cell_of(u.first, t.size_px.x, t.wrap_u);
        __m128i const l = cell_of(v.first, t.size_px.y, t.wrap_v);
        __m128i const word =
            _mm_add_epi32(_mm_mullo_epi32(_mm_srli_epi32(l, 2), all_of_4(map->words_across())), _mm_srli_epi32(k, 2));
        __m128i const bits = _mm_i32gather_epi32(reinterpret_cast<int const*>(map->words().data()), word, 4);
        __m128i const three = all_of_4(3);
        __m128i const place =
            _mm_or_si128(_mm_slli_epi32(_mm_and_si128(l, three), 3), _mm_slli_epi32(_mm_and_si128(k, three), 1));
        return _mm_srlv_epi32(bits, place);
    }

    GNOMON_AVX2_INLINE std::uint32_t compare(Tap4 const& u, Tap4 const& v) const {
        math::AlphaTexture const& t = test->texture;
        __m128i const one = all_of_4(1);
        __m128i const x0 = wrapped_x4(u.first, t.size_px.x, t.wrap_u);
        __m128i const x1 = wrapped_x4(_mm_add_epi32(u.first, one), t.size_px.x, t.wrap_u);
        __m128i const y0 = wrapped_x4(v.first, t.size_px.y, t.wrap_v);
        __m128i const y1 = wrapped_x4(_mm_add_epi32(v.first, one), t.size_px.y, t.wrap_v);
        __m256d const rest_x = _mm256_sub_pd(all_of(1.0), u.weight);
        __m256d const rest_y = _mm256_sub_pd(all_of(1.0), v.weight);
        __m256d const top =
            _mm256_add_pd(_mm256_mul_pd(texels_x4(t, x0, y0), rest_x), _mm256_mul_pd(texels_x4(t, x1, y0), u.weight));
        __m256d const bottom =
            _mm256_add_pd(_mm256_mul_pd(texels_x4(t, x0, y1), rest_x), _mm256_mul_pd(texels_x4(t, x1, y1), u.weight));
        __m256d const sum = _mm256_add_pd(_mm256_mul_pd(top, rest_y), _mm256_mul_pd(bottom, v.weight));
        __m256d const alpha = _mm256_mul_pd(_mm256_div_pd(sum, all_of(255.0)), all_of(test->factor));
        return static_cast<std::uint32_t>(_mm256_movemask_pd(_mm256_cmp_pd(alpha, all_of(test->cutoff), _CMP_GE_OQ)));
    }
};

/// Whether the vector code can address all texels and cells.
[[nodiscard]] inline bool fits_gather(math::AlphaTexture const& texture) noexcept {
    return std::int64_t{texture.size_px.x} * texture.size_px.y <= std::int64_t{1} << 30U &&
           texture.size_px.x <= 1 << 29U && texture.size_px.y <= 1 << 29U;
}

}  // namespace

}  // namespace gnomon::raster::detail
