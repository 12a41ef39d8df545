#pragma once
// Eight samples of one row: compared, written, counted. Included by kernel_simd.cpp only.

#include "avx2.hpp"
#include "kernel_mode.hpp"
#include "pieces.hpp"

namespace gnomon::raster::detail {

namespace {

/// As a target holds it: clamped, and a code for a 16-bit one. Monotone, so it keeps bounds.
template <class M>
GNOMON_AVX2_INLINE __m256 stored_depth(__m256 z) {
    // Without `clamp` no depth is below 0, and one that rounding took beyond 1 fails against any forward target as 1
    // does.
    if constexpr (M::clamp) z = _mm256_max_ps(z, _mm256_setzero_ps());
    if constexpr (M::clamp || M::reversed) z = _mm256_min_ps(z, all_of(1.0F));
    if constexpr (M::quantize) {
        __m256 const magic = all_of(8388608.0F);
        z = _mm256_sub_ps(_mm256_add_ps(_mm256_mul_ps(z, all_of(65535.0F)), magic), magic);
    }
    return z;
}

template <class M>
GNOMON_AVX2_INLINE __m256 is_nearer(__m256 z, __m256 held) {
    return M::reversed ? _mm256_cmp_ps(z, held, _CMP_GT_OQ) : _mm256_cmp_ps(z, held, _CMP_LT_OQ);
}

template <class M>
GNOMON_AVX2_INLINE __m256 farther_of(__m256 a, __m256 b) {
    return M::reversed ? _mm256_min_ps(a, b) : _mm256_max_ps(a, b);
}

/// The rows that a record is drawn to, and how many samples were written, by column.
template <class M>
struct Writer {
    float* depth;
    std::uint32_t* id;
    __m256i record_id;
    __m256i written;

    /// Compares and writes eight samples; a sample is covered where the sign of `outside` is clear. Columns out of
    /// `counted` lie beyond the tile: they are drawn into its margin and not counted.
    ///
    /// returns: what the image holds then.
    GNOMON_AVX2_INLINE __m256 write(__m256 z, __m256i outside, __m256i counted) {
        z = stored_depth<M>(z);
        __m256 const held = _mm256_loadu_ps(depth);
        __m256 const nearer = _mm256_andnot_ps(as_float(outside), is_nearer<M>(z, held));
        __m256i const mask = _mm256_srai_epi32(as_int(nearer), 31);
        written = _mm256_sub_epi32(written, _mm256_and_si256(mask, counted));
        __m256 const now = _mm256_blendv_ps(held, z, nearer);
        _mm256_storeu_ps(depth, now);
        if constexpr (M::ids) {
            __m256i* const at = reinterpret_cast<__m256i*>(id);
            _mm256_storeu_si256(at, select(_mm256_loadu_si256(at), record_id, as_int(nearer)));
        }
        return now;
    }
    GNOMON_AVX2_INLINE void to_row(TileJob const& job, std::ptrdiff_t at) {
        depth = job.depth + at;
        if constexpr (M::ids) id = job.id + at;
    }
    GNOMON_AVX2_INLINE void next_row() {
        depth += tile_pitch;
        if constexpr (M::ids) id += tile_pitch;
    }
};

/// All ones in the first `n` columns.
GNOMON_AVX2_INLINE __m256i first_columns(std::int32_t n) { return is_less(iota(), all_of(n)); }

/// Edges and depth of a regular triangle, stepping through eight columns at once.
struct RegularDepth {
    __m256 z0, g1, g2;
    GNOMON_AVX2_INLINE __m256 at(__m256i e20, __m256i e01) const {
        return _mm256_add_ps(
            z0, _mm256_add_ps(_mm256_mul_ps(_mm256_cvtepi32_ps(e20), g1), _mm256_mul_ps(_mm256_cvtepi32_ps(e01), g2)));
    }
};

}  // namespace

}  // namespace gnomon::raster::detail
