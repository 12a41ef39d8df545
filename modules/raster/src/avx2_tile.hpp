#pragma once
// Samples of one tile, eight at a time. Narrow triangles go row by row; wide ones by blocks of 8 x 8 samples, all eight
// blocks of a row of blocks classified at once. Included by kernel_simd.cpp only.

#include "avx2.hpp"
#include "sample_loop.hpp"

namespace gnomon::raster::detail {

namespace {

/// What a kernel is compiled for. `Clamp`: depths may be below 0 or beyond 1 (`DepthRange::clamp`).
template <bool Reversed, bool Quantize, bool Ids, bool Clamp>
struct Mode {
    static constexpr bool reversed = Reversed;
    static constexpr bool quantize = Quantize;
    static constexpr bool ids = Ids;
    static constexpr bool clamp = Clamp;
};

/// As a target holds it: clamped, and a code for a 16-bit one. Monotone, so it keeps bounds.
template <class M>
GNOMON_AVX2_INLINE __m256 stored_depth(__m256 z) {
    // Without `clamp` no depth is below 0, and one that rounding took beyond 1 fails against any forward target as 1 does.
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
        return _mm256_add_ps(z0, _mm256_add_ps(_mm256_mul_ps(_mm256_cvtepi32_ps(e20), g1), _mm256_mul_ps(_mm256_cvtepi32_ps(e01), g2)));
    }
};

template <class M>
GNOMON_AVX2_INLINE void draw_narrow(TileJob const& job, Record const& r, PixelRange const& range, Writer<M>& writer) {
    std::int32_t const dx = range.x0 - r.min_x;
    std::int32_t const dy = range.y0 - r.min_y;
    __m256i e[3];
    __m256i step[3];
    for (int i = 0; i < 3; ++i) {
        e[i] = _mm256_add_epi32(all_of(r.edge[i] + r.step_x[i] * dx + r.step_y[i] * dy),
                                _mm256_mullo_epi32(iota(), all_of(r.step_x[i])));
        step[i] = all_of(r.step_y[i]);
    }
    RegularDepth const plane{all_of(r.z0), all_of(r.g1), all_of(r.g2)};
    __m256i const counted = first_columns(range.x1 - range.x0);
    writer.to_row(job, std::ptrdiff_t{range.y0 - job.y0} * tile_pitch + (range.x0 - job.x0));
    for (std::int32_t y = range.y0; y < range.y1; ++y, writer.next_row()) {
        writer.write(plane.at(e[2], e[0]), _mm256_or_si256(_mm256_or_si256(e[0], e[1]), e[2]), counted);
        for (int i = 0; i < 3; ++i) e[i] = _mm256_add_epi32(e[i], step[i]);
    }
}

/// An edge function over a tile, from the tile's first pixel. Both kinds of triangle come down to three of these.
struct TileEdge {
    std::int32_t value, step_x, step_y;
};

/// The greatest and the least value of an edge function over each of the eight blocks of a row of blocks.
struct BlockValues {
    __m256i highest, lowest;
};

GNOMON_AVX2_INLINE BlockValues values_in_blocks(TileEdge const& e, std::int32_t row) {
    // Both are at corners: 7 steps along where the step is positive, or negative.
    std::int32_t const up = (e.step_x > 0 ? 7 * e.step_x : 0) + (e.step_y > 0 ? 7 * e.step_y : 0);
    std::int32_t const down = (e.step_x < 0 ? 7 * e.step_x : 0) + (e.step_y < 0 ? 7 * e.step_y : 0);
    __m256i const at = _mm256_add_epi32(all_of(e.value + row * e.step_y), _mm256_mullo_epi32(iota(), all_of(8 * e.step_x)));
    return {_mm256_add_epi32(at, all_of(up)), _mm256_add_epi32(at, all_of(down))};
}

/// Depth of a regular triangle, for whole blocks and for their samples.
struct RegularBlocks {
    RegularDepth plane;

    GNOMON_AVX2_INLINE __m256 at(__m256i const (&e)[3], std::int32_t, std::int32_t) const { return plane.at(e[2], e[0]); }

    /// No covered sample of a block is nearer. The formula grows with both edge functions, and so does its rounding: the
    /// bound is exact without any slack. A covered sample's edge functions are not negative.
    template <class M>
    GNOMON_AVX2_INLINE __m256 nearest(BlockValues const (&e)[3], std::int32_t) const {
        __m256i const zero = _mm256_setzero_si256();
        return M::reversed ? plane.at(e[2].highest, e[0].highest)
                           : plane.at(_mm256_max_epi32(e[2].lowest, zero), _mm256_max_epi32(e[0].lowest, zero));
    }
};

/// The same for a large one: exact integers in double.
struct LargeBlocks {
    DepthGradient g;
    double e20, e01, x20, x01, y20, y01;  // At the tile's first pixel, and per column and row.

    GNOMON_AVX2_INLINE __m128 depth(__m256d w20, __m256d w01) const {
        __m256d const sum = _mm256_add_pd(_mm256_mul_pd(w20, _mm256_set1_pd(g.g1)), _mm256_mul_pd(w01, _mm256_set1_pd(g.g2)));
        return _mm256_cvtpd_ps(_mm256_add_pd(_mm256_set1_pd(g.z0), sum));
    }
    /// `start` + `step` * i for four columns or blocks from `first`.
    GNOMON_AVX2_INLINE static __m256d four(double start, double step, double first) {
        __m256d const i = _mm256_add_pd(_mm256_set1_pd(first), _mm256_setr_pd(0.0, 1.0, 2.0, 3.0));
        return _mm256_add_pd(_mm256_set1_pd(start), _mm256_mul_pd(i, _mm256_set1_pd(step)));
    }
    GNOMON_AVX2_INLINE static __m256 eight(__m128 low, __m128 high) {
        return _mm256_insertf128_ps(_mm256_castps128_ps256(low), high, 1);
    }

    GNOMON_AVX2_INLINE __m256 at(__m256i const (&)[3], std::int32_t x, std::int32_t y) const {
        double const a = e20 + y20 * y;
        double const b = e01 + y01 * y;
        return eight(depth(four(a, x20, x), four(b, x01, x)), depth(four(a, x20, x + 4), four(b, x01, x + 4)));
    }

    template <class M>
    GNOMON_AVX2_INLINE __m256 nearest(BlockValues const (&)[3], std::int32_t row) const {
        auto const extreme = [](double step) { return (step > 0.0) == M::reversed ? 7.0 * step : 0.0; };
        double const a = e20 + y20 * row + extreme(x20) + extreme(y20);
        double const b = e01 + y01 * row + extreme(x01) + extreme(y01);
        __m256d w20[2] = {four(a, 8.0 * x20, 0.0), four(a, 8.0 * x20, 4.0)};
        __m256d w01[2] = {four(b, 8.0 * x01, 0.0), four(b, 8.0 * x01, 4.0)};
        for (int i = 0; i < 2; ++i) {
            w20[i] = _mm256_max_pd(w20[i], _mm256_setzero_pd());
            w01[i] = _mm256_max_pd(w01[i], _mm256_setzero_pd());
        }
        return eight(depth(w20[0], w01[0]), depth(w20[1], w01[1]));
    }
};

/// Blocks of one row of blocks: a bit for each that may have a sample to write, and that is covered wholly (exact).
struct BlockRow {
    std::uint32_t touched, full;
};

template <class M, class Depth>
GNOMON_AVX2_INLINE BlockRow classify(TileJob const& job, TileEdge const (&edge)[3], std::int32_t row, Depth const& depth) {
    BlockValues const e[3] = {values_in_blocks(edge[0], row), values_in_blocks(edge[1], row), values_in_blocks(edge[2], row)};
    __m256i const outside = _mm256_or_si256(_mm256_or_si256(e[0].highest, e[1].highest), e[2].highest);
    __m256i const cut = _mm256_or_si256(_mm256_or_si256(e[0].lowest, e[1].lowest), e[2].lowest);
    __m256 const nearest = stored_depth<M>(depth.template nearest<M>(e, row));
    __m256 const visible = is_nearer<M>(nearest, _mm256_loadu_ps(job.farthest + row));
    auto const seen = static_cast<std::uint32_t>(_mm256_movemask_ps(visible));
    return {~sign_bits(outside) & seen, ~sign_bits(cut) & 0xFFU};
}

template <class M>
GNOMON_AVX2_INLINE float farthest_of(__m256 v) {
    __m256 const pairs = farther_of<M>(v, _mm256_permute2f128_ps(v, v, 1));
    __m256 const quads = farther_of<M>(pairs, _mm256_permute_ps(pairs, 0x4E));
    return _mm256_cvtss_f32(farther_of<M>(quads, _mm256_permute_ps(quads, 0xB1)));
}

/// What all blocks of a record share.
struct BlockJob {
    TileEdge edge[3];
    __m256i lane[3];  // Steps of the eight columns.
};

/// Rows [y0, y1) of the block whose first column is `x`, and the block's farthest depth when all eight are drawn.
template <class M, bool Full, class Depth>
GNOMON_AVX2_INLINE void draw_block(TileJob const& job, BlockJob const& b, PixelRange const& range, std::int32_t x,
                                   Depth const& depth, Writer<M>& writer) {
    __m256i const counted = first_columns(range.x1 - x);
    __m256i e[3];
    __m256i step[3];
    for (int i = 0; i < 3; ++i) {
        TileEdge const& edge = b.edge[i];
        e[i] = _mm256_add_epi32(all_of(edge.value + x * edge.step_x + range.y0 * edge.step_y), b.lane[i]);
        step[i] = all_of(edge.step_y);
    }
    writer.to_row(job, std::ptrdiff_t{range.y0} * tile_pitch + x);
    __m256 farthest = all_of(M::reversed ? 65536.0F : -1.0F);
    for (std::int32_t y = range.y0; y < range.y1; ++y, writer.next_row()) {
        __m256i const outside = Full ? _mm256_setzero_si256() : _mm256_or_si256(_mm256_or_si256(e[0], e[1]), e[2]);
        farthest = farther_of<M>(farthest, writer.write(depth.at(e, x, y), outside, counted));
        for (int i = 0; i < 3; ++i) e[i] = _mm256_add_epi32(e[i], step[i]);
    }
    if (range.y1 - range.y0 == 8) job.farthest[range.y0 + (x >> 3)] = farthest_of<M>(farthest);
}

/// `range` counted from the tile's first pixel.
template <class M, class Depth>
GNOMON_AVX2_INLINE void draw_blocks(TileJob const& job, TileEdge const (&edge)[3], PixelRange const& range,
                                    Depth const& depth, Writer<M>& writer) {
    BlockJob b;
    for (int i = 0; i < 3; ++i) {
        b.edge[i] = edge[i];
        b.lane[i] = _mm256_mullo_epi32(iota(), all_of(edge[i].step_x));
    }
    std::uint32_t const wanted = (0xFFU << (range.x0 >> 3)) & (0xFFU >> (7 - ((range.x1 - 1) >> 3)));
    for (std::int32_t row = range.y0 & ~7; row < range.y1; row += 8) {
        BlockRow const blocks = classify<M>(job, edge, row, depth);
        PixelRange rows = range;
        rows.y0 = row > range.y0 ? row : range.y0;
        rows.y1 = row + 8 < range.y1 ? row + 8 : range.y1;
        for (std::uint32_t left = blocks.touched & wanted; left != 0; left &= left - 1) {
            int const block = __builtin_ctz(left);
            if (((blocks.full >> block) & 1U) != 0)
                draw_block<M, true>(job, b, rows, block * 8, depth, writer);
            else
                draw_block<M, false>(job, b, rows, block * 8, depth, writer);
        }
    }
}

GNOMON_AVX2_INLINE PixelRange from_tile(TileJob const& job, PixelRange const& range) {
    return {range.x0 - job.x0, range.y0 - job.y0, range.x1 - job.x0, range.y1 - job.y0};
}

template <class M>
GNOMON_AVX2 void draw_wide(TileJob const& job, Record const& r, PixelRange const& range, Writer<M>& writer) {
    TileEdge edge[3];
    for (int i = 0; i < 3; ++i)
        edge[i] = {r.edge[i] + r.step_x[i] * (job.x0 - r.min_x) + r.step_y[i] * (job.y0 - r.min_y), r.step_x[i], r.step_y[i]};
    RegularBlocks const depth{{all_of(r.z0), all_of(r.g1), all_of(r.g2)}};
    draw_blocks<M>(job, edge, from_tile(job, range), depth, writer);
}

/// The edge over the tile in 32 bits. Where it does not change sign within the tile, only the sign is kept; where it
/// does, all its values are within 63 (|step_x| + |step_y|) < 2^31.
///
/// returns: false when the whole tile is outside.
GNOMON_AVX2_INLINE bool narrow_edge(ShiftedEdge const& e, TileEdge& out) {
    std::int64_t const x = std::int64_t{e.step_x} * (tile_size - 1);
    std::int64_t const y = std::int64_t{e.step_y} * (tile_size - 1);
    std::int64_t const highest = e.value + (x > 0 ? x : 0) + (y > 0 ? y : 0);
    std::int64_t const lowest = e.value + (x < 0 ? x : 0) + (y < 0 ? y : 0);
    if (highest < 0) return false;
    out = lowest >= 0 ? TileEdge{0, 0, 0} : TileEdge{static_cast<std::int32_t>(e.value), e.step_x, e.step_y};
    return true;
}

template <class M>
GNOMON_AVX2 void draw_large_x8(TileJob const& job, Record const& r, PixelRange const& range, Writer<M>& writer) {
    Oriented const t = oriented_of_large(r);
    ShiftedEdge e[3];
    TileEdge edge[3];
    for (int i = 0; i < 3; ++i) {
        e[i] = shifted_edge(t, i, job.x0, job.y0);
        if (!narrow_edge(e[i], edge[i])) return;
    }
    LargeBlocks const depth{depth_gradient(t, e[2].fraction, e[0].fraction),
                            static_cast<double>(e[2].value),
                            static_cast<double>(e[0].value),
                            static_cast<double>(e[2].step_x),
                            static_cast<double>(e[0].step_x),
                            static_cast<double>(e[2].step_y),
                            static_cast<double>(e[0].step_y)};
    draw_blocks<M>(job, edge, from_tile(job, range), depth, writer);
}

template <class M>
GNOMON_AVX2 std::uint64_t draw_tile_x8(TileJob const& job, Record const* records, std::uint32_t const* entries, std::size_t count) {
    std::uint64_t masked = 0;
    Writer<M> writer{job.depth, job.id, _mm256_setzero_si256(), _mm256_setzero_si256()};
    for (std::size_t i = 0; i < count; ++i) {
        // The records of a tile lie scattered over the chunk's.
        if (i + 4 < count) __builtin_prefetch(records + entries[i + 4]);
        Record const& r = records[entries[i]];
        PixelRange const range = range_in_tile(job, r);
        if (range.x1 <= range.x0 || range.y1 <= range.y0) continue;
        writer.record_id = all_of(static_cast<std::int32_t>(r.id));
        if (r.tag == 0 && range.x1 - range.x0 <= 8)
            draw_narrow<M>(job, r, range, writer);
        else if (r.tag == 0)
            draw_wide<M>(job, r, range, writer);
        else if (r.tag == 1)
            draw_large_x8<M>(job, r, range, writer);
        else
            masked += job.masked(job, r);
    }
    alignas(32) std::uint32_t written[8];
    _mm256_store_si256(reinterpret_cast<__m256i*>(written), writer.written);
    for (std::uint32_t n : written) masked += n;
    return masked;
}

template <bool Ids, bool Quantize, bool Clamp>
GNOMON_AVX2_INLINE std::uint64_t draw_either_way(TileJob const& job, Record const* records, std::uint32_t const* entries,
                                                 std::size_t count) {
    return job.reversed ? draw_tile_x8<Mode<true, Quantize, Ids, Clamp>>(job, records, entries, count)
                        : draw_tile_x8<Mode<false, Quantize, Ids, Clamp>>(job, records, entries, count);
}

GNOMON_AVX2 std::uint64_t avx2_tile(TileJob const& job, Record const* records, std::uint32_t const* entries, std::size_t count) {
    if (job.id != nullptr)
        return job.clamp ? draw_either_way<true, false, true>(job, records, entries, count)
                         : draw_either_way<true, false, false>(job, records, entries, count);
    if (job.quantize)
        return job.clamp ? draw_either_way<false, true, true>(job, records, entries, count)
                         : draw_either_way<false, true, false>(job, records, entries, count);
    return job.clamp ? draw_either_way<false, false, true>(job, records, entries, count)
                     : draw_either_way<false, false, false>(job, records, entries, count);
}

/// Fills the tile's images with the farthest depth and no triangle.
GNOMON_AVX2 void avx2_clear(TileJob const& job, float farthest, std::uint32_t no_id) {
    __m256 const z = all_of(farthest);
    __m256i const none = all_of(static_cast<std::int32_t>(no_id));
    std::ptrdiff_t const end = std::ptrdiff_t{job.y1 - job.y0} * tile_pitch;
    for (std::ptrdiff_t i = 0; i < end; i += 8) _mm256_store_ps(job.depth + i, z);
    for (int i = 0; i < blocks_per_tile; i += 8) _mm256_store_ps(job.farthest + i, z);
    if (job.id == nullptr) return;
    for (std::ptrdiff_t i = 0; i < end; i += 8) _mm256_store_si256(reinterpret_cast<__m256i*>(job.id + i), none);
}

/// Copies the rows of a whole tile past the caches. The image's rows begin on cache lines.
GNOMON_AVX2 void avx2_stream(TileRows const& to, void const* from) {
    char const* source = static_cast<char const*>(from);
    char* row = static_cast<char*>(to.first);
    for (std::int32_t y = 0; y < to.count; ++y, row += to.stride_bytes, source += tile_pitch * 4)
        for (std::ptrdiff_t i = 0; i < tile_size * 4; i += 32)
            _mm256_stream_si256(reinterpret_cast<__m256i*>(row + i), _mm256_load_si256(reinterpret_cast<__m256i const*>(source + i)));
    _mm_sfence();  // Ordered before whatever tells another thread that the tile is done.
}

}  // namespace

}  // namespace gnomon::raster::detail
