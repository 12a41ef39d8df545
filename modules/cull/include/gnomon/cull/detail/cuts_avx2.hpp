#pragma once
// What planes and borders leave of eight balls, or of one at eight borders: the formula's parts, in vectors.

#include <gnomon/cull/detail/ready_avx2.hpp>

#if GNOMON_CULL_AVX2

namespace gnomon::cull::detail {

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

}  // namespace gnomon::cull::detail
#endif
