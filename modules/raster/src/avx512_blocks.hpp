#pragma once
// Blocks of 4 x 4 samples, one vector each. The sixteen blocks of a window of 16 x 16 samples are classified at once,
// by their corners and by their farthest depth. Included by kernel_avx512.cpp only.

#include "avx512.hpp"
#include "kernel_mode.hpp"

namespace gnomon::raster::detail {

namespace {

constexpr std::int32_t blocks_across = tile_size / 4;

/// As a target holds it: clamped, and a code for a 16-bit one. Monotone, so it keeps bounds.
template <class M>
GNOMON_AVX512_INLINE __m512 stored_depth16(__m512 z) {
    // Without `clamp` no depth is below 0, and one that rounding took beyond 1 fails against any forward target as 1
    // does.
    if constexpr (M::clamp) z = _mm512_max_ps(z, _mm512_setzero_ps());
    if constexpr (M::clamp || M::reversed) z = _mm512_min_ps(z, all16(1.0F));
    if constexpr (M::quantize) {
        __m512 const magic = all16(8388608.0F);
        z = _mm512_sub_ps(_mm512_add_ps(_mm512_mul_ps(z, all16(65535.0F)), magic), magic);
    }
    return z;
}

template <class M>
GNOMON_AVX512_INLINE __mmask16 is_nearer16(__mmask16 among, __m512 z, __m512 held) {
    return M::reversed ? _mm512_mask_cmp_ps_mask(among, z, held, _CMP_GT_OQ)
                       : _mm512_mask_cmp_ps_mask(among, z, held, _CMP_LT_OQ);
}

/// Three edge functions over a tile. Both kinds of triangle come down to these.
struct Edges16 {
    std::int32_t value[4];  // At the first sample of the first window; a fourth that is not used.
    std::int32_t step_x[4];
    std::int32_t step_y[4];
    std::int32_t up[4];  // From a block's first sample to its highest value, and to its lowest.
    std::int32_t down[4];
};

/// From values and steps at some pixel to those at the pixel that lies (dx, dy) away.
GNOMON_AVX512_INLINE Edges16 edges_at(__m128i value, __m128i step_x, __m128i step_y, std::int32_t dx, std::int32_t dy) {
    __m128i const zero = _mm_setzero_si128();
    __m128i const up = _mm_add_epi32(_mm_max_epi32(step_x, zero), _mm_max_epi32(step_y, zero));
    __m128i const down = _mm_add_epi32(_mm_min_epi32(step_x, zero), _mm_min_epi32(step_y, zero));
    value = _mm_add_epi32(value, _mm_mullo_epi32(step_x, _mm_set1_epi32(dx)));
    value = _mm_add_epi32(value, _mm_mullo_epi32(step_y, _mm_set1_epi32(dy)));
    Edges16 e;
    _mm_storeu_si128(reinterpret_cast<__m128i*>(e.value), value);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(e.step_x), step_x);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(e.step_y), step_y);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(e.up), _mm_add_epi32(_mm_add_epi32(up, up), up));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(e.down), _mm_add_epi32(_mm_add_epi32(down, down), down));
    return e;
}

/// A regular triangle's depth: of whole blocks.
struct RegularDepth16 {
    __m512 z0, g1, g2;

    GNOMON_AVX512_INLINE __m512 at(__m512i e20, __m512i e01) const {
        return _mm512_add_ps(
            z0, _mm512_add_ps(_mm512_mul_ps(_mm512_cvtepi32_ps(e20), g1), _mm512_mul_ps(_mm512_cvtepi32_ps(e01), g2)));
    }
};

/// Where a window is, in blocks, and which of its blocks are wanted.
struct Window {
    std::int32_t x, y;
    __mmask16 wanted;
};

/// Blocks [x0, x1) x [y0, y1) of a tile.
struct BlockRange {
    std::int32_t x0, y0, x1, y1;
    [[nodiscard]] std::int32_t count() const { return (x1 - x0) * (y1 - y0); }
    [[nodiscard]] Window window(std::int32_t x, std::int32_t y) const {
        std::uint32_t const columns = x1 - x < 4 ? 0xFU >> static_cast<std::uint32_t>(4 - (x1 - x)) : 0xFU;
        std::uint32_t const rows = y1 - y < 4 ? 0xFFFFU >> static_cast<std::uint32_t>(16 - 4 * (y1 - y)) : 0xFFFFU;
        return {x, y, static_cast<__mmask16>((columns * 0x1111U) & rows)};
    }
};

/// An edge function at the first samples of a window's blocks.
GNOMON_AVX512_INLINE __m512i window_edge(Edges16 const& e, int i, __m512i steps, Window const& w,
                                         BlockRange const& range) {
    std::int32_t const at = e.value[i] + e.step_x[i] * (4 * (w.x - range.x0)) + e.step_y[i] * (4 * (w.y - range.y0));
    return _mm512_add_epi32(all16(at), _mm512_slli_epi32(steps, 2));
}

/// Those of the blocks that the edge functions leave at their greatest (`corner`: `Edges16::up`) or least values.
GNOMON_AVX512_INLINE __mmask16 blocks_inside(__mmask16 among, __m512i const (&at)[3], std::int32_t const (&corner)[4]) {
    __m512i const signs = or16(_mm512_add_epi32(at[0], all16(corner[0])), _mm512_add_epi32(at[1], all16(corner[1])),
                               _mm512_add_epi32(at[2], all16(corner[2])));
    return _mm512_mask_cmpge_epi32_mask(among, signs, _mm512_setzero_si512());
}

/// The farthest depths of a window's blocks: four rows of four.
GNOMON_AVX512_INLINE __m512 load_window(float const* at) {
    __m256 const top =
        _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(at)), _mm_loadu_ps(at + blocks_across), 1);
    __m256 const end = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(at + 2 * blocks_across)),
                                            _mm_loadu_ps(at + 3 * blocks_across), 1);
    return joined16(top, end);
}
/// Which samples of the block at `offset` lie within the tile, which may be cut by a border of the image.
GNOMON_AVX512_INLINE __mmask16 inside_tile(TileJob const& job, std::int32_t offset) {
    std::int32_t const block = offset >> 4;
    std::int32_t const columns = job.x1 - job.x0 - (block % blocks_across) * 4;
    std::int32_t const rows = job.y1 - job.y0 - (block / blocks_across) * 4;
    std::uint32_t const in_row = columns < 4 ? 0xFU >> static_cast<std::uint32_t>(4 - columns) : 0xFU;
    std::uint32_t const above = rows < 4 ? 0xFFFFU >> static_cast<std::uint32_t>(16 - 4 * rows) : 0xFFFFU;
    return static_cast<__mmask16>((in_row * 0x1111U) & above);
}

/// Compares and writes a block's covered samples.
///
/// returns: which were written.
template <class M>
GNOMON_AVX512_INLINE __mmask16 write_block(TileJob const& job, std::int32_t offset, __m512 z, __mmask16 covered,
                                           __m512i id) {
    z = stored_depth16<M>(z);
    float* const depth = job.depth + offset;
    __m512 const held = _mm512_load_ps(depth);
    __mmask16 const nearer = is_nearer16<M>(covered, z, held);
    // Neighbours in a mesh meet in a block, each waiting for the one before: no mask on that way but `covered`, and a
    // whole store, from which the next load is served.
    _mm512_store_ps(
        depth, M::reversed ? _mm512_mask_max_ps(held, covered, z, held) : _mm512_mask_min_ps(held, covered, z, held));
    if constexpr (M::ids) {
        std::uint32_t* const to = job.id + offset;
        _mm512_store_si512(to, _mm512_mask_mov_epi32(_mm512_load_si512(to), nearer, id));
    }
    return nearer;
}

template <class M>
GNOMON_AVX512_INLINE __m512 farther16(__m512 a, __m512 b) {
    return M::reversed ? _mm512_min_ps(a, b) : _mm512_max_ps(a, b);
}

/// The farthest depth of each of four blocks, in each quarter four times the block's.
template <class M>
GNOMON_AVX512_INLINE __m512 farthest_of_four(float const* blocks) {
    Four16 const q = transposed_quarters(_mm512_load_si512(blocks), _mm512_load_si512(blocks + 16),
                                         _mm512_load_si512(blocks + 32), _mm512_load_si512(blocks + 48));
    __m512 const rows = farther16<M>(farther16<M>(_mm512_castsi512_ps(q.v[0]), _mm512_castsi512_ps(q.v[1])),
                                     farther16<M>(_mm512_castsi512_ps(q.v[2]), _mm512_castsi512_ps(q.v[3])));
    __m512 const pairs = farther16<M>(rows, _mm512_permute_ps(rows, 0xB1));
    return farther16<M>(pairs, _mm512_permute_ps(pairs, 0x4E));
}

/// Looks the farthest depths of all blocks up in the image.
template <class M>
GNOMON_AVX512_INLINE void refresh_farthest(TileJob const& job) {
    for (std::ptrdiff_t row = 0; row < blocks_across; ++row) {
        float const* const blocks = job.depth + row * blocks_across * 16;
        // Quarter q of vector v has block 4v + q.
        __m512 const ab = _mm512_mask_mov_ps(farthest_of_four<M>(blocks), 0x2222, farthest_of_four<M>(blocks + 64));
        __m512 const cd =
            _mm512_mask_mov_ps(farthest_of_four<M>(blocks + 128), 0x8888, farthest_of_four<M>(blocks + 192));
        __m512 const mixed = _mm512_mask_mov_ps(ab, 0xCCCC, cd);  // Lane 4q + v.
        __m512i const order = _mm512_setr_epi32(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15);
        _mm512_store_ps(job.farthest + row * blocks_across, _mm512_permutexvar_ps(order, mixed));
    }
}

}  // namespace

}  // namespace gnomon::raster::detail
