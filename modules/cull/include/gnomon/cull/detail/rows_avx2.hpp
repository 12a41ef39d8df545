#pragma once
// The rows of balls with AVX2: the formula's bits, without what the formula computes in vain.
//
// Two shapes of work. Balls that reach at most 4 rows, 4 slices and 8 columns go eight at a time, a ball a lane, in step
// over their borders; larger ones one at a time, a border a lane. Arcs are made once a border, corners once a border and
// plane, for both slices beside it.

#include <gnomon/cull/detail/ready_avx2.hpp>

#if GNOMON_CULL_AVX2

#include <bit>

namespace gnomon::cull::detail {

inline constexpr int small_rows = 4, small_slices = 4, small_columns = 8;

/// GnPlaneCut
struct Cut8 {
    F8 depth, scale, inverse, rest;
    Span8 cap;
    bool crosses;  ///< any lane's plane crosses its ball; otherwise nothing but `rest` is set
};

/// GnCap
struct Cap8 {
    Span8 span;
    F8 low_scale, high_scale;
};

/// gn_corner
GNOMON_ROWS_INLINE Span8 corner(F8 x, F8 off, F8 rest, F8 inverse) noexcept {
    F8 const left = rest - off * off, zero = all(0.0F), far = all(formula::gn_far());
    F8 const s = root(greatest(left, zero)), any = left >= zero;
    return {select(any, (x - s) * inverse, far), select(any, (x + s) * inverse, zero - far)};
}

/// gn_border_arc
template <bool perspective>
GNOMON_ROWS_INLINE Arc8 border_arc(Ready8 const& b, Border8 const& border) noexcept {
    if constexpr (!perspective) {
        F8 const off = b.y - border.y;
        return flat_arc_of(b.x, b.depth, b.radius_sq - off * off);
    }
    F8 const off = (b.y - border.y * b.depth) * border.cosine;
    return arc_of(b.x, (b.y * border.y + b.depth) * border.cosine, b.radius_sq - off * off, b.tangent, border);
}

/// gn_ends and gn_within
GNOMON_ROWS_INLINE Span8 within(Arc8 const& arc, Cut8 const& near, Span8 near_corner, Cut8 const& far, Span8 far_corner) noexcept {
    F8 const zero = all(0.0F), none = all(formula::gn_far()), any = arc.rest >= zero;
    Span8 s{select(any, arc.span.low, none), select(any, arc.span.high, zero - none)};
    if (far.crosses) {
        F8 const at = far.depth * arc.unit, here = far.rest >= zero;
        s.low = select(here & (arc.low_at >= at), far_corner.low, s.low);
        s.high = select(here & (arc.high_at >= at), far_corner.high, s.high);
    }
    if (near.crosses) {
        F8 const at = near.depth * arc.unit, here = near.rest >= zero;
        s.low = select(here & (arc.low_at <= at), near_corner.low, s.low);
        s.high = select(here & (arc.high_at <= at), near_corner.high, s.high);
    }
    return s;
}

/// gn_slice_cap
GNOMON_ROWS_INLINE Cap8 slice_cap(Ready8 const& b, Cut8 const& near, Cut8 const& far) noexcept {
    F8 const zero = all(0.0F);
    Cap8 c{b.cap.span, b.cap_low_scale, b.cap_high_scale};
    if (far.crosses) {
        F8 const at = far.depth * b.cap.unit, here = far.rest >= zero;
        F8 const low = here & (b.cap.low_at >= at), high = here & (b.cap.high_at >= at);
        c.span = {select(low, far.cap.low, c.span.low), select(high, far.cap.high, c.span.high)};
        c.low_scale = select(low, far.scale, c.low_scale);
        c.high_scale = select(high, far.scale, c.high_scale);
    }
    if (near.crosses) {
        F8 const at = near.depth * b.cap.unit, here = near.rest >= zero;
        F8 const low = here & (b.cap.low_at <= at), high = here & (b.cap.high_at <= at);
        c.span = {select(low, near.cap.low, c.span.low), select(high, near.cap.high, c.span.high)};
        c.low_scale = select(low, near.scale, c.low_scale);
        c.high_scale = select(high, near.scale, c.high_scale);
    }
    return c;
}

/// A row of a slice: its borders, the cap, and what the ball covers of the borders.
struct Row8 {
    F8 y, next_y;
    Span8 top, bottom;
};

/// gn_joined, and the bounds of the whole ball.
GNOMON_ROWS_INLINE Span8 joined(Ready8 const& b, Row8 const& row, Cap8 const& cap) noexcept {
    F8 const low_in = and_not(row.y * cap.low_scale <= b.y, row.next_y * cap.low_scale <= b.y);
    F8 const high_in = and_not(row.y * cap.high_scale <= b.y, row.next_y * cap.high_scale <= b.y);
    F8 const low = least(row.top.low, row.bottom.low), high = greatest(row.top.high, row.bottom.high);
    return {greatest(select(low_in, least(low, cap.span.low), low), b.x_bounds.low),
            least(select(high_in, greatest(high, cap.span.high), high), b.x_bounds.high)};
}

GNOMON_ROWS_INLINE void set_cut(Ready8 const& b, F8 depth, F8 scale, F8 inverse, Cut8& c) noexcept {
    c.depth = depth, c.scale = scale, c.inverse = inverse;
    c.cap = corner(b.x, all(0.0F), c.rest, inverse);
}

/// The plane `k` of each lane; lanes beyond the last plane get it.
GNOMON_ROWS_INLINE void gather_cut(RowGrid const& g, Ready8 const& b, I8 k, F8 lanes, Cut8& c) noexcept {
    I8 const at = least(k, all(static_cast<std::int32_t>(g.slices)));
    F8 const depth = gather(g.depth_m.data(), at), off = depth - b.depth, zero = all(0.0F);
    c = {zero, zero, zero, b.radius_sq - off * off, {zero, zero}, false};
    c.crosses = bits_of((c.rest >= zero) & lanes) != 0;
    if (c.crosses) set_cut(b, depth, gather(g.scale.data(), at), gather(g.inverse.data(), at), c);
}

/// Calls `sink.row(lane, slice, row, low, high)` for the rows of the balls of `lanes` (a mask) that are not empty: slice
/// and row counted from each ball's first. All of them must be small.
template <bool perspective, class Sink>
GNOMON_ROWS_INLINE void visit_small(RowGrid const& g, Ready8 const& b, F8 lanes, Sink& sink) noexcept {
    I8 const rows = b.row_last - b.row_first, slices = b.slice_last - b.slice_first;
    int slice_count = 1, row_count = 1;
    while (slice_count < small_slices && bits_of((slices > all(slice_count - 1)) & lanes) != 0) ++slice_count;
    while (row_count < small_rows && bits_of((rows > all(row_count - 1)) & lanes) != 0) ++row_count;

    Cut8 cut[small_slices + 1];
    Cap8 cap[small_slices];
    Span8 above[small_slices];
    for (int k = 0; k <= slice_count; ++k) gather_cut(g, b, b.slice_first + all(k), lanes, cut[k]);
    for (int k = 0; k < slice_count; ++k) cap[k] = slice_cap(b, cut[k], cut[k + 1]);

    F8 y = all(0.0F);
    for (int j = 0; j <= row_count; ++j) {
        I8 const at = least(b.row_first + all(j), all(static_cast<std::int32_t>(g.rows)));
        F8 const next_y = gather(g.y.data(), at);
        Arc8 const arc = border_arc<perspective>(b, {next_y, gather(g.secant.data(), at), gather(g.cosine.data(), at)});
        F8 const in_rows = and_not(lanes, all(j - 1) > rows);
        Span8 near_corner{all(0.0F), all(0.0F)}, far_corner = near_corner;
        for (int k = 0; k <= slice_count; ++k) {
            near_corner = far_corner;
            if (cut[k].crosses) far_corner = corner(b.x, next_y * cut[k].scale - b.y, cut[k].rest, cut[k].inverse);
            if (k == 0) continue;
            Span8 const below = within(arc, cut[k - 1], near_corner, cut[k], far_corner);
            if (j > 0) {
                Span8 const s = joined(b, {y, next_y, above[k - 1], below}, cap[k - 1]);
                std::uint32_t some = bits_of(and_not((s.low <= s.high) & in_rows, all(k - 1) > slices));
                if (some != 0) {
                    alignas(32) float low[8], high[8];
                    store(low, s.low);
                    store(high, s.high);
                    for (; some != 0; some &= some - 1) {
                        auto const lane = static_cast<std::uint32_t>(std::countr_zero(some));
                        sink.small_row(lane, static_cast<std::uint32_t>(k - 1), static_cast<std::uint32_t>(j - 1), low[lane], high[lane]);
                    }
                }
            }
            above[k - 1] = below;
        }
        y = next_y;
    }
}

GNOMON_ROWS_INLINE F8 pick(F8 const& from, std::uint32_t lane) noexcept { return spread(reinterpret_cast<float const*>(&from) + lane); }
GNOMON_ROWS_INLINE std::uint32_t pick(I8 const& from, std::uint32_t lane) noexcept {
    return reinterpret_cast<std::uint32_t const*>(&from)[lane];
}

/// One ball of eight, in every lane.
GNOMON_ROWS_INLINE void pick(Ready8 const& from, std::uint32_t lane, Ready8& r) noexcept {
    r.x = pick(from.x, lane), r.y = pick(from.y, lane), r.depth = pick(from.depth, lane);
    r.radius_sq = pick(from.radius_sq, lane), r.tangent = pick(from.tangent, lane);
    r.cap.span = {pick(from.cap.span.low, lane), pick(from.cap.span.high, lane)};
    r.cap.low_at = pick(from.cap.low_at, lane), r.cap.high_at = pick(from.cap.high_at, lane), r.cap.unit = pick(from.cap.unit, lane);
    r.cap_low_scale = pick(from.cap_low_scale, lane), r.cap_high_scale = pick(from.cap_high_scale, lane);
    r.x_bounds = {pick(from.x_bounds.low, lane), pick(from.x_bounds.high, lane)};
}

/// The same plane in every lane, with the corners of the lanes' borders on it.
GNOMON_ROWS_INLINE Span8 spread_cut(RowGrid const& g, Ready8 const& b, F8 y, std::uint32_t k, Cut8& c) noexcept {
    F8 const depth = spread(g.depth_m.data() + k), off = depth - b.depth, zero = all(0.0F);
    c = {zero, zero, zero, b.radius_sq - off * off, {zero, zero}, false};
    c.crosses = (bits_of(c.rest >= zero) & 1U) != 0;
    if (!c.crosses) return {zero, zero};
    set_cut(b, depth, spread(g.scale.data() + k), spread(g.inverse.data() + k), c);
    return corner(b.x, y * c.scale - b.y, c.rest, c.inverse);
}

/// Calls `sink.row(slice, row, low, high)` for the rows of one ball of eight, slice and row counted from the grid's first.
template <bool perspective, class Sink>
GNOMON_ROWS_INLINE void visit_large(RowGrid const& g, Ready8 const& eight, std::uint32_t lane, Sink& sink) noexcept {
    Ready8 b;
    pick(eight, lane, b);
    std::uint32_t const first = pick(eight.row_first, lane), last = pick(eight.row_last, lane);
    std::uint32_t const slice_first = pick(eight.slice_first, lane), slice_last = pick(eight.slice_last, lane);
    for (std::uint32_t j = first; j <= last; j += 7) {
        std::uint32_t const rows = last - j + 1 < 7 ? last - j + 1 : 7;
        F8 const y = load(g.y.data() + j), next_y = load(g.y.data() + j + 1);
        Arc8 const arc = border_arc<perspective>(b, {y, load(g.secant.data() + j), load(g.cosine.data() + j)});
        Cut8 near;
        Span8 near_corner = spread_cut(g, b, y, slice_first, near);
        for (std::uint32_t k = slice_first; k <= slice_last; ++k) {
            Cut8 far;
            Span8 const far_corner = spread_cut(g, b, y, k + 1, far);
            Span8 const top = within(arc, near, near_corner, far, far_corner);
            Span8 const s = joined(b, {y, next_y, top, {next_lane(top.low), next_lane(top.high)}}, slice_cap(b, near, far));
            std::uint32_t some = bits_of(s.low <= s.high) & ((1U << rows) - 1U);
            alignas(32) float low[8], high[8];
            store(low, s.low);
            store(high, s.high);
            for (; some != 0; some &= some - 1) {
                auto const i = static_cast<std::uint32_t>(std::countr_zero(some));
                sink.large_row(k, j + i, low[i], high[i]);
            }
            near = far;
            near_corner = far_corner;
        }
    }
}

/// All balls: `sink.eight(n, ready)` before each eight; `sink.large(lane, ready)` before the rows of a large one,
/// which come after those of the small ones and in the order of lanes; `sink.done()` after each eight.
template <bool perspective, class Sink>
GNOMON_ROWS_INLINE void visit_balls(RowGrid const& g, float const* const (&xyzr)[4], std::size_t count, Sink& sink) noexcept {
    Ready8 b;
    for (std::size_t n = 0; n < count; n += 8) {
        make_ready<perspective>(load(xyzr[0] + n), load(xyzr[1] + n), load(xyzr[2] + n), load(xyzr[3] + n), b);
        find_reach(g, b);
        std::uint32_t const there = count - n < 8 ? (1U << (count - n)) - 1U : 255U;
        F8 const big = (b.row_last - b.row_first > all(small_rows - 1)) | (b.slice_last - b.slice_first > all(small_slices - 1)) |
                       (b.column_last - b.column_first > all(small_columns - 1));
        std::uint32_t const some = bits_of(b.reaches) & there;
        if (some == 0) continue;
        sink.eight(n, b);
        std::uint32_t large = bits_of(big) & some;
        if (large != some) {
            alignas(32) static constexpr std::int32_t bit[8] = {1, 2, 4, 8, 16, 32, 64, 128};
            __m256i const bits = _mm256_load_si256(reinterpret_cast<__m256i const*>(bit));
            __m256i const set = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(some & ~large)), bits);
            visit_small<perspective>(g, b, {_mm256_castsi256_ps(_mm256_cmpeq_epi32(set, bits))}, sink);
        }
        for (; large != 0; large &= large - 1) {
            auto const lane = static_cast<std::uint32_t>(std::countr_zero(large));
            sink.large(lane, b);
            visit_large<perspective>(g, b, lane, sink);
        }
        sink.done();
    }
}

}  // namespace gnomon::cull::detail
#endif
