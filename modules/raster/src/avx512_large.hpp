#pragma once
// Triangles of more than 1024 pixels: depth in double from exact integers. Included by kernel_avx512.cpp only.

#include "avx512_blocks.hpp"

namespace gnomon::raster::detail {

namespace {

/// Depth over a tile.
struct LargeDepth16 {
    DepthGradient g;
    double e20, e01, x20, x01, y20, y01;  // At the tile's first pixel, and per column and row.
    Double16 steps20, steps01;            // Of a block's samples.

    GNOMON_AVX512_INLINE __m256 depth(__m512d w20, __m512d w01) const {
        __m512d const sum =
            _mm512_add_pd(_mm512_mul_pd(w20, _mm512_set1_pd(g.g1)), _mm512_mul_pd(w01, _mm512_set1_pd(g.g2)));
        return _mm512_cvtpd_ps(_mm512_add_pd(_mm512_set1_pd(g.z0), sum));
    }
    GNOMON_AVX512_INLINE __m512 at(std::int32_t x, std::int32_t y) const {
        __m512d const a = _mm512_set1_pd(e20 + x20 * x + y20 * y);
        __m512d const b = _mm512_set1_pd(e01 + x01 * x + y01 * y);
        return joined16(depth(_mm512_add_pd(a, steps20.low), _mm512_add_pd(b, steps01.low)),
                        depth(_mm512_add_pd(a, steps20.high), _mm512_add_pd(b, steps01.high)));
    }
    template <bool Least>
    GNOMON_AVX512_INLINE static double extreme(double step) {
        return (step < 0.0) == Least ? 3.0 * step : 0.0;
    }
    GNOMON_AVX512_INLINE static __m512d in_blocks(double at, __m512d steps) {
        __m512d const v = _mm512_add_pd(_mm512_set1_pd(at), _mm512_mul_pd(steps, _mm512_set1_pd(4.0)));
        return _mm512_max_pd(v, _mm512_setzero_pd());
    }
    /// No covered sample of a window's blocks is nearer (`Least`) or farther; the window starts at (x, y).
    template <bool Least>
    GNOMON_AVX512_INLINE __m512 bound(std::int32_t x, std::int32_t y) const {
        double const a = e20 + x20 * x + y20 * y + extreme<Least>(x20) + extreme<Least>(y20);
        double const b = e01 + x01 * x + y01 * y + extreme<Least>(x01) + extreme<Least>(y01);
        return joined16(depth(in_blocks(a, steps20.low), in_blocks(b, steps01.low)),
                        depth(in_blocks(a, steps20.high), in_blocks(b, steps01.high)));
    }
};

/// The edge over the tile in 32 bits. Where it does not change sign within the tile, only the sign is kept; where it
/// does, all its values are within 63 (|step_x| + |step_y|) < 2^31.
///
/// returns: false when the whole tile is outside.
inline bool narrow_edge16(ShiftedEdge& e) {
    std::int64_t const x = std::int64_t{e.step_x} * (tile_size - 1);
    std::int64_t const y = std::int64_t{e.step_y} * (tile_size - 1);
    std::int64_t const highest = e.value + (x > 0 ? x : 0) + (y > 0 ? y : 0);
    std::int64_t const lowest = e.value + (x < 0 ? x : 0) + (y < 0 ? y : 0);
    if (lowest >= 0) e = {0, 0, 0, 0};
    return highest >= 0;
}

GNOMON_AVX512_INLINE LargeDepth16 large_depth16(Oriented const& t, ShiftedEdge const& e20, ShiftedEdge const& e01) {
    LargeDepth16 d{depth_gradient(t, e20.fraction, e01.fraction),
                   static_cast<double>(e20.value),
                   static_cast<double>(e01.value),
                   static_cast<double>(e20.step_x),
                   static_cast<double>(e01.step_x),
                   static_cast<double>(e20.step_y),
                   static_cast<double>(e01.step_y),
                   {},
                   {}};
    d.steps20 = block_steps(d.x20, d.y20);
    d.steps01 = block_steps(d.x01, d.y01);
    return d;
}

template <class M>
GNOMON_AVX512 std::uint64_t draw_large16(TileJob const& job, Record const& r, BlockRange const& range) {
    Oriented const t = oriented_of_large(r);
    ShiftedEdge e[3];
    for (int i = 0; i < 3; ++i) e[i] = shifted_edge(t, i, job.x0, job.y0);
    LargeDepth16 const depth = large_depth16(t, e[2], e[0]);
    for (ShiftedEdge& edge : e)
        if (!narrow_edge16(edge)) return 0;
    auto const value = [&](int i) { return static_cast<std::int32_t>(e[i].value); };
    Edges16 const edges = edges_at(
        _mm_setr_epi32(value(0), value(1), value(2), 0), _mm_setr_epi32(e[0].step_x, e[1].step_x, e[2].step_x, 0),
        _mm_setr_epi32(e[0].step_y, e[1].step_y, e[2].step_y, 0), 4 * range.x0, 4 * range.y0);
    __m512i const steps[3] = {block_steps(e[0].step_x, e[0].step_y), block_steps(e[1].step_x, e[1].step_y),
                              block_steps(e[2].step_x, e[2].step_y)};
    std::uint64_t written = 0;
    for (std::int32_t wy = range.y0; wy < range.y1; wy += 4)
        for (std::int32_t wx = range.x0; wx < range.x1; wx += 4) {
            Window const window = range.window(wx, wy);
            __m512i at_blocks[3];
            alignas(64) std::int32_t at[3][16];
            for (int i = 0; i < 3; ++i) {
                at_blocks[i] = window_edge(edges, i, steps[i], window, range);
                _mm512_store_si512(at[i], at_blocks[i]);
            }
            __m512 const held = load_window(job.farthest + wy * blocks_across + wx);
            __m512 const nearest = stored_depth16<M>(depth.bound<!M::reversed>(4 * wx, 4 * wy));
            __mmask16 const seen = blocks_inside(is_nearer16<M>(window.wanted, nearest, held), at_blocks, edges.up);
            for (std::uint32_t left = seen; left != 0; left &= left - 1) {
                int const b = __builtin_ctz(left);
                std::int32_t const x = 4 * (wx + (b & 3));
                std::int32_t const y = 4 * (wy + (b >> 2));
                __m512i const outside =
                    or16(_mm512_add_epi32(all16(at[0][b]), steps[0]), _mm512_add_epi32(all16(at[1][b]), steps[1]),
                         _mm512_add_epi32(all16(at[2][b]), steps[2]));
                auto const offset = static_cast<std::int32_t>(blocked_offset(x, y));
                __mmask16 const covered = _mm512_cmpge_epi32_mask(outside, _mm512_setzero_si512());
                __mmask16 const nearer =
                    write_block<M>(job, offset, depth.at(x, y), covered, all16(static_cast<std::int32_t>(r.id)));
                written += static_cast<std::uint64_t>(__builtin_popcount(nearer & inside_tile(job, offset)));
            }
        }
    return written;
}

}  // namespace

}  // namespace gnomon::raster::detail
