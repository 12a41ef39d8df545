#pragma once
// A triangle by blocks of 8 x 8 samples: all eight blocks of a row of blocks are classified at once, by their corners
// and by their farthest depth. Included by kernel_simd.cpp only.

#include "avx2_samples.hpp"
#include "sample_loop.hpp"

namespace gnomon::raster::detail {

namespace {

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
    __m256i const at =
        _mm256_add_epi32(all_of(e.value + row * e.step_y), _mm256_mullo_epi32(iota(), all_of(8 * e.step_x)));
    return {_mm256_add_epi32(at, all_of(up)), _mm256_add_epi32(at, all_of(down))};
}

/// Depth of a regular triangle, for whole blocks and for their samples.
struct RegularBlocks {
    RegularDepth plane;

    GNOMON_AVX2_INLINE __m256 at(__m256i const (&e)[3], std::int32_t, std::int32_t) const {
        return plane.at(e[2], e[0]);
    }

    /// No covered sample of a block is nearer. The formula grows with both edge functions, and so does its rounding:
    /// the bound is exact without any slack. A covered sample's edge functions are not negative.
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
        __m256d const sum =
            _mm256_add_pd(_mm256_mul_pd(w20, _mm256_set1_pd(g.g1)), _mm256_mul_pd(w01, _mm256_set1_pd(g.g2)));
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
GNOMON_AVX2_INLINE BlockRow classify(TileJob const& job, TileEdge const (&edge)[3], std::int32_t row,
                                     Depth const& depth) {
    BlockValues const e[3] = {values_in_blocks(edge[0], row), values_in_blocks(edge[1], row),
                              values_in_blocks(edge[2], row)};
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
template <class M, bool Full, class Depth, class W>
GNOMON_AVX2_INLINE void draw_block(TileJob const& job, BlockJob const& b, PixelRange const& range, std::int32_t x,
                                   Depth const& depth, W& writer) {
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
template <class M, class Depth, class W>
GNOMON_AVX2_INLINE void draw_blocks(TileJob const& job, TileEdge const (&edge)[3], PixelRange const& range,
                                    Depth const& depth, W& writer) {
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

}  // namespace

}  // namespace gnomon::raster::detail
