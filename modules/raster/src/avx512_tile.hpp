#pragma once
// Records of one tile. First the blocks that some records touch are listed, window by window, then all listed blocks
// are drawn in one long loop: short loops per triangle would cost more in mispredicted branches than in work. Included
// by kernel_avx512.cpp only.

#include "avx512_large.hpp"

namespace gnomon::raster::detail {

namespace {

/// What the blocks of one record share.
struct alignas(64) Shape {
    __m512i steps[3];
    float z0, g1, g2;
    std::uint32_t id;
};

/// Blocks in the order in which they are drawn.
struct alignas(64) BlockList {
    static constexpr std::int32_t max_blocks = 64;
    static constexpr std::int32_t max_shapes = 32;
    static constexpr std::int32_t max_of_record = blocks_per_tile;
    static constexpr std::int32_t refresh_after = 256;

    Shape shape[max_shapes];
    // Sixteen more than listed: whole vectors are stored.
    std::int32_t offset[max_blocks + max_of_record + 16];
    std::int32_t shape_of[max_blocks + max_of_record + 16];
    std::int32_t edge[3][max_blocks + max_of_record + 16];
    std::int32_t blocks;
    std::int32_t shapes;
    std::int32_t drawn;  // Since the farthest depths were looked up.
};

/// Draws the listed blocks. `Whole`: no border of the image cuts the tile.
template <class M, bool Whole>
GNOMON_AVX512_INLINE __m512i draw_listed(TileJob const& job, BlockList const& list, __m512i written) {
    __m512i const zero = _mm512_setzero_si512();
    for (std::int32_t i = 0; i < list.blocks; ++i) {
        Shape const& s = list.shape[list.shape_of[i]];
        __m512i const e01 = _mm512_add_epi32(s.steps[0], all16(list.edge[0][i]));
        __m512i const e12 = _mm512_add_epi32(s.steps[1], all16(list.edge[1][i]));
        __m512i const e20 = _mm512_add_epi32(s.steps[2], all16(list.edge[2][i]));
        __mmask16 const covered = _mm512_cmpge_epi32_mask(or16(e01, e12, e20), zero);
        RegularDepth16 const depth{all16(s.z0), all16(s.g1), all16(s.g2)};
        std::int32_t const offset = list.offset[i];
        __mmask16 nearer =
            write_block<M>(job, offset, depth.at(e20, e01), covered, all16(static_cast<std::int32_t>(s.id)));
        if constexpr (!Whole) nearer = static_cast<__mmask16>(nearer & inside_tile(job, offset));
        written = _mm512_mask_sub_epi32(written, nearer, written, all16(-1));
    }
    return written;
}

template <class M>
GNOMON_AVX512_INLINE __m512i flush(TileJob const& job, BlockList& list, __m512i written) {
    bool const whole = job.x1 - job.x0 == tile_size && job.y1 - job.y0 == tile_size;
    written = whole ? draw_listed<M, true>(job, list, written) : draw_listed<M, false>(job, list, written);
    list.drawn += list.blocks;
    list.blocks = list.shapes = 0;
    if (list.drawn >= BlockList::refresh_after) {
        refresh_farthest<M>(job);
        list.drawn = 0;
    }
    return written;
}

GNOMON_AVX512_INLINE void append(BlockList& list, Window const& w, __m512i const (&edge)[3], __mmask16 blocks) {
    // Of the first sample of each block, counted from the window's.
    __m512i const offsets =
        _mm512_setr_epi32(0, 16, 32, 48, 256, 272, 288, 304, 512, 528, 544, 560, 768, 784, 800, 816);
    __m512i const at = _mm512_add_epi32(offsets, all16((w.y * blocks_across + w.x) * 16));
    std::int32_t const n = list.blocks;
    _mm512_storeu_si512(list.offset + n, _mm512_maskz_compress_epi32(blocks, at));
    _mm512_storeu_si512(list.shape_of + n, all16(list.shapes));
    for (int i = 0; i < 3; ++i) _mm512_storeu_si512(list.edge[i] + n, _mm512_maskz_compress_epi32(blocks, edge[i]));
    list.blocks = n + __builtin_popcount(blocks);
}

GNOMON_AVX512_INLINE void set_shape(Shape& s, Record const& r, __m512i const (&steps)[3]) {
    for (int i = 0; i < 3; ++i) s.steps[i] = steps[i];
    s.z0 = r.z0;
    s.g1 = r.g1;
    s.g2 = r.g2;
    s.id = r.id;
}

/// A regular triangle over a tile, on its way to the list.
struct Listed {
    Edges16 edges;
    __m512i steps[3];
    RegularDepth16 depth;

    /// Nearest depth of squares whose edge functions start at `e`: no covered sample is nearer. The formula grows with
    /// both edge functions, and so does its rounding: the bound is exact without any slack. A covered sample's edge
    /// functions are not negative.
    template <class M>
    GNOMON_AVX512_INLINE __m512 nearest(__m512i e20, __m512i e01, std::int32_t scale) const {
        if constexpr (M::reversed)
            return stored_depth16<M>(depth.at(_mm512_add_epi32(e20, all16(edges.up[2] * scale)),
                                              _mm512_add_epi32(e01, all16(edges.up[0] * scale))));
        __m512i const zero = _mm512_setzero_si512();
        return stored_depth16<M>(depth.at(_mm512_max_epi32(_mm512_add_epi32(e20, all16(edges.down[2] * scale)), zero),
                                          _mm512_max_epi32(_mm512_add_epi32(e01, all16(edges.down[0] * scale)), zero)));
    }
};

GNOMON_AVX512_INLINE Listed make_listed(TileJob const& job, Record const& r, BlockRange const& range) {
    return {edges_at(_mm_loadu_si128(reinterpret_cast<__m128i const*>(r.edge)),
                     _mm_loadu_si128(reinterpret_cast<__m128i const*>(r.step_x)),
                     _mm_loadu_si128(reinterpret_cast<__m128i const*>(r.step_y)), job.x0 - r.min_x + 4 * range.x0,
                     job.y0 - r.min_y + 4 * range.y0),
            {block_steps(r.step_x[0], r.step_y[0]), block_steps(r.step_x[1], r.step_y[1]),
             block_steps(r.step_x[2], r.step_y[2])},
            {all16(r.z0), all16(r.g1), all16(r.g2)}};
}

/// Lists the blocks of one window.
template <class M>
GNOMON_AVX512_INLINE void list_window(TileJob const& job, Listed const& t, Window const& w, BlockRange const& range,
                                      BlockList& list) {
    __m512 const held = load_window(job.farthest + w.y * blocks_across + w.x);
    __m512i const at20 = window_edge(t.edges, 2, t.steps[2], w, range);
    __m512i const at01 = window_edge(t.edges, 0, t.steps[0], w, range);
    __mmask16 const near = is_nearer16<M>(w.wanted, t.nearest<M>(at20, at01, 1), held);
    if (near == 0) return;
    __m512i const at[3] = {at01, window_edge(t.edges, 1, t.steps[1], w, range), at20};
    append(list, w, at, blocks_inside(near, at, t.edges.up));
}

/// Lists the blocks that a triangle of a few windows touches.
template <class M>
GNOMON_AVX512_INLINE void list_windows(TileJob const& job, Record const& r, BlockRange const& range, BlockList& list) {
    Listed const t = make_listed(job, r, range);
    std::int32_t const first = list.blocks;
    for (std::int32_t y = range.y0; y < range.y1; y += 4)
        for (std::int32_t x = range.x0; x < range.x1; x += 4) list_window<M>(job, t, range.window(x, y), range, list);
    if (list.blocks != first) set_shape(list.shape[list.shapes++], r, t.steps);
}

/// The farthest depth of each of the tile's sixteen squares of 4 x 4 blocks.
template <class M>
GNOMON_AVX512_INLINE __m512 farthest_of_squares(float const* farthest) {
    __m512 rows[4];
    for (int i = 0; i < 4; ++i) {
        float const* const from = farthest + i * 4 * blocks_across;
        __m512 const v = farther16<M>(
            farther16<M>(_mm512_load_ps(from), _mm512_load_ps(from + blocks_across)),
            farther16<M>(_mm512_load_ps(from + 2 * blocks_across), _mm512_load_ps(from + 3 * blocks_across)));
        __m512 const pairs = farther16<M>(v, _mm512_permute_ps(v, 0xB1));
        rows[i] = farther16<M>(pairs, _mm512_permute_ps(pairs, 0x4E));  // Four times in each quarter.
    }
    __m512i const quarter = _mm512_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28, 0, 0, 0, 0, 0, 0, 0, 0);
    __m512 const top = _mm512_permutex2var_ps(rows[0], quarter, rows[1]);
    __m512 const end = _mm512_permutex2var_ps(rows[2], quarter, rows[3]);
    return _mm512_shuffle_f32x4(top, end, 0x44);
}

/// Lists the blocks that a wide triangle touches: first all of the tile's squares of 4 x 4 blocks at once.
template <class M>
GNOMON_AVX512_INLINE void list_wide(TileJob const& job, Record const& r, BlockRange const& range, BlockList& list) {
    BlockRange const tile{0, 0, range.x1, range.y1};
    Listed const t = make_listed(job, r, tile);
    __m512i at[3];
    for (int i = 0; i < 3; ++i) at[i] = _mm512_add_epi32(all16(t.edges.value[i]), _mm512_slli_epi32(t.steps[i], 4));
    BlockRange const squares{range.x0 >> 2, range.y0 >> 2, (range.x1 + 3) >> 2, (range.y1 + 3) >> 2};
    __mmask16 const from_first =
        static_cast<__mmask16>((0xFU << static_cast<std::uint32_t>(squares.x0) & 0xFU) * 0x1111U &
                               0xFFFFU << static_cast<std::uint32_t>(4 * squares.y0));
    __mmask16 const wanted = static_cast<__mmask16>(squares.window(0, 0).wanted & from_first);
    __mmask16 const near = is_nearer16<M>(wanted, t.nearest<M>(at[2], at[0], 5), farthest_of_squares<M>(job.farthest));
    std::int32_t up[4];
    for (int i = 0; i < 3; ++i) up[i] = t.edges.up[i] * 5;  // 15 samples on.
    std::int32_t const first = list.blocks;
    for (std::uint32_t left = blocks_inside(near, at, up); left != 0; left &= left - 1) {
        int const square = __builtin_ctz(left);
        list_window<M>(job, t, tile.window((square & 3) * 4, (square >> 2) * 4), tile, list);
    }
    if (list.blocks != first) set_shape(list.shape[list.shapes++], r, t.steps);
}

/// Lane i of a vector of four, in all lanes.
template <int I>
GNOMON_AVX512_INLINE __m128i lane_of(__m128i v) {
    return _mm_shuffle_epi32(v, I * 0x55);
}
/// An edge function at the first samples of 2 x 2 blocks.
template <int I>
GNOMON_AVX512_INLINE __m128i four_blocks(__m128i value, __m128i across, __m128i down) {
    __m128i const x = _mm_and_si128(lane_of<I>(across), _mm_setr_epi32(0, -1, 0, -1));
    __m128i const y = _mm_and_si128(lane_of<I>(down), _mm_setr_epi32(0, 0, -1, -1));
    return _mm_add_epi32(lane_of<I>(value), _mm_add_epi32(x, y));
}

GNOMON_AVX512_INLINE void store4(std::int32_t* to, __m128i v) { _mm_storeu_si128(reinterpret_cast<__m128i*>(to), v); }

/// The same for one that lies within 2 x 2 blocks.
template <class M>
GNOMON_AVX512_INLINE void list_small(TileJob const& job, Record const& r, BlockRange const& range, BlockList& list) {
    std::int32_t const first = range.y0 * blocks_across + range.x0;
    __m128 const held =
        _mm_loadh_pi(_mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<__m128i const*>(job.farthest + first))),
                     reinterpret_cast<__m64 const*>(job.farthest + first + blocks_across));
    // Its blocks: one column less clears bits 1 and 3, one row less bits 2 and 3. No sample has a depth below z0.
    auto const wanted =
        static_cast<__mmask8>((range.x1 - range.x0 == 2 ? 0xFU : 0x5U) & (range.y1 - range.y0 == 2 ? 0xFU : 0x3U));
    __mmask8 near = wanted;
    if constexpr (!M::reversed && !M::quantize && !M::clamp)
        near = _mm_mask_cmp_ps_mask(wanted, _mm_set1_ps(r.z0), held, _CMP_LT_OQ);
    if (near == 0) return;
    __m128i const step_x = _mm_loadu_si128(reinterpret_cast<__m128i const*>(r.step_x));
    __m128i const step_y = _mm_loadu_si128(reinterpret_cast<__m128i const*>(r.step_y));
    __m128i value = _mm_loadu_si128(reinterpret_cast<__m128i const*>(r.edge));
    value = _mm_add_epi32(value, _mm_mullo_epi32(step_x, _mm_set1_epi32(job.x0 - r.min_x + 4 * range.x0)));
    value = _mm_add_epi32(value, _mm_mullo_epi32(step_y, _mm_set1_epi32(job.y0 - r.min_y + 4 * range.y0)));
    __m128i const zero = _mm_setzero_si128();
    __m128i const once = _mm_add_epi32(_mm_max_epi32(step_x, zero), _mm_max_epi32(step_y, zero));
    __m128i const up = _mm_add_epi32(once, _mm_add_epi32(once, once));
    __m128i const across = _mm_slli_epi32(step_x, 2);
    __m128i const down = _mm_slli_epi32(step_y, 2);
    __m128i const e01 = four_blocks<0>(value, across, down);
    __m128i const e12 = four_blocks<1>(value, across, down);
    __m128i const e20 = four_blocks<2>(value, across, down);
    __m128i const signs = _mm_ternarylogic_epi32(_mm_add_epi32(e01, lane_of<0>(up)), _mm_add_epi32(e12, lane_of<1>(up)),
                                                 _mm_add_epi32(e20, lane_of<2>(up)), 0xFE);
    __mmask8 const seen = _mm_mask_cmpge_epi32_mask(near, signs, zero);
    __m512i const steps[3] = {block_steps(r.step_x[0], r.step_y[0]), block_steps(r.step_x[1], r.step_y[1]),
                              block_steps(r.step_x[2], r.step_y[2])};
    set_shape(list.shape[list.shapes], r, steps);
    __m128i const offsets =
        _mm_add_epi32(_mm_set1_epi32(first * 16), _mm_setr_epi32(0, 16, 16 * blocks_across, 16 * blocks_across + 16));
    std::int32_t const n = list.blocks;
    store4(list.offset + n, _mm_maskz_compress_epi32(seen, offsets));
    store4(list.shape_of + n, _mm_set1_epi32(list.shapes));
    store4(list.edge[0] + n, _mm_maskz_compress_epi32(seen, e01));
    store4(list.edge[1] + n, _mm_maskz_compress_epi32(seen, e12));
    store4(list.edge[2] + n, _mm_maskz_compress_epi32(seen, e20));
    list.blocks = n + __builtin_popcount(seen);
    ++list.shapes;
}

template <class M>
GNOMON_AVX512 std::uint64_t draw_tile16(TileJob const& job, Record const* records, std::uint32_t const* entries,
                                        std::size_t count) {
    std::uint64_t others = 0;
    __m512i written = _mm512_setzero_si512();
    BlockList list;
    list.blocks = list.shapes = list.drawn = 0;
    for (std::size_t i = 0; i < count; ++i) {
        // The records of a tile lie scattered over the chunk's.
        if (i + 8 < count) __builtin_prefetch(records + entries[i + 8]);
        Record const& r = records[entries[i]];
        PixelRange const p = range_in_tile(job, r);
        if (p.x1 <= p.x0 || p.y1 <= p.y0) continue;
        BlockRange const range{(p.x0 - job.x0) >> 2, (p.y0 - job.y0) >> 2, (p.x1 - job.x0 + 3) >> 2,
                               (p.y1 - job.y0 + 3) >> 2};
        if (r.tag == 0) {
            if (range.x1 - range.x0 <= 2 && range.y1 - range.y0 <= 2)
                list_small<M>(job, r, range, list);
            else if (range.count() > 64)
                list_wide<M>(job, r, range, list);
            else
                list_windows<M>(job, r, range, list);
            if (list.shapes == BlockList::max_shapes || list.blocks >= BlockList::max_blocks)
                written = flush<M>(job, list, written);
            continue;
        }
        written = flush<M>(job, list, written);
        list.drawn += r.tag == 1 ? range.count() : 0;
        others += r.tag == 1 ? draw_large16<M>(job, r, range) : job.masked(job, r);
    }
    written = flush<M>(job, list, written);
    return others + static_cast<std::uint32_t>(_mm512_reduce_add_epi32(written));
}

template <bool Ids, bool Quantize, bool Clamp>
GNOMON_AVX512_INLINE std::uint64_t draw_either_way16(TileJob const& job, Record const* records,
                                                     std::uint32_t const* entries, std::size_t count) {
    return job.reversed ? draw_tile16<Mode<true, Quantize, Ids, Clamp>>(job, records, entries, count)
                        : draw_tile16<Mode<false, Quantize, Ids, Clamp>>(job, records, entries, count);
}

GNOMON_AVX512 std::uint64_t avx512_tile(TileJob const& job, Record const* records, std::uint32_t const* entries,
                                        std::size_t count) {
    if (job.id != nullptr)
        return job.clamp ? draw_either_way16<true, false, true>(job, records, entries, count)
                         : draw_either_way16<true, false, false>(job, records, entries, count);
    if (job.quantize)
        return job.clamp ? draw_either_way16<false, true, true>(job, records, entries, count)
                         : draw_either_way16<false, true, false>(job, records, entries, count);
    return job.clamp ? draw_either_way16<false, false, true>(job, records, entries, count)
                     : draw_either_way16<false, false, false>(job, records, entries, count);
}

}  // namespace

}  // namespace gnomon::raster::detail
