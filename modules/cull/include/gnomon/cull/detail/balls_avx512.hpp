#pragma once
// The rows of balls with AVX-512: the formula's bits, whatever the balls' sizes.
//
// A lane is a ball, a slice and a border between rows; its right neighbour is the border below, and the two give the row.

#include <gnomon/cull/detail/avx512.hpp>
#include <gnomon/cull/rows.hpp>

#if GNOMON_CULL_AVX2

namespace gnomon::cull::detail {

struct Span16 {
    F16 low, high;
};

/// GnArc
struct Arc16 {
    Span16 span;
    F16 low_at, high_at, unit, rest;
};

/// GnPlaneCut, and the corner of a border on it.
struct Cut16 {
    F16 depth, scale, rest;
    M16 crosses;
    Span16 cap, corner;
};

/// Of each lane: its ball.
struct Ball16 {
    F16 x, y, depth, radius_sq, tangent;
};

/// Of each lane: what cuts the ball at a border.
struct RowCut16 {
    F16 border_y;
    Span16 top;
    Cut16 near, far;
};

/// GnReadyBall
struct Balls16 {
    F16 x, y, depth, radius_sq, tangent;
    Arc16 cap;
    F16 cap_low_scale, cap_high_scale;
    Span16 x_bounds, y_bounds;
};

/// The grid's tables.
struct Tables16 {
    Table16 y, secant, cosine, depth_m, inverse, left, right;
};

GNOMON_WIDE_INLINE Tables16 make_tables(RowGrid const& g) noexcept {
    std::uint32_t const borders = g.rows + 1, planes = g.slices + 1;
    return {make_table(g.y.data(), borders),      make_table(g.secant.data(), borders), make_table(g.cosine.data(), borders),
            make_table(g.depth_m.data(), planes), make_table(g.inverse.data(), planes), make_table(g.left.data(), g.columns),
            make_table(g.right.data(), g.columns)};
}

/// Of each lane: which ball, the border above its row, its slice.
struct Lanes16 {
    I16 ball, border, slice;
};

/// gn_corner
GNOMON_WIDE_INLINE Span16 corner(F16 x, F16 left, F16 inverse) noexcept {
    F16 const zero = wide(0.0F), far = wide(formula::gn_far()), s = root(greatest(left, zero));
    M16 const any = left >= zero;
    return {select(any, (x - s) * inverse, far), select(any, (x + s) * inverse, zero - far)};
}

struct Border16 {
    F16 y, secant, cosine;
};

/// gn_arc_of
GNOMON_WIDE_INLINE Arc16 arc_of(F16 x, F16 w, F16 rest, F16 tangent, Border16 const& border) noexcept {
    F16 const rho = root(greatest(rest, wide(0.0F)));
    F16 const along = tangent * w, across = rho * x, side = tangent * x, lift = rho * w;
    F16 const high_w = along - across, low_w = along + across, short_tangent = tangent * border.cosine;
    return {{(side - lift) / low_w * border.secant, (side + lift) / high_w * border.secant}, short_tangent * low_w, short_tangent * high_w,
            tangent * tangent + rho * rho, rest};
}

/// gn_flat_arc_of
GNOMON_WIDE_INLINE Arc16 flat_arc_of(F16 x, F16 depth, F16 rest) noexcept {
    F16 const rho = root(greatest(rest, wide(0.0F)));
    return {{x - rho, x + rho}, depth, depth, wide(1.0F), rest};
}

/// gn_border_arc
template <bool perspective>
GNOMON_WIDE_INLINE Arc16 border_arc(Ball16 const& b, Border16 const& border) noexcept {
    F16 const off = perspective ? (b.y - border.y * b.depth) * border.cosine : b.y - border.y, rest = b.radius_sq - off * off;
    if constexpr (!perspective) return flat_arc_of(b.x, b.depth, rest);
    return arc_of(b.x, (b.y * border.y + b.depth) * border.cosine, rest, b.tangent, border);
}

/// gn_cap_arc
template <bool perspective>
GNOMON_WIDE_INLINE Arc16 cap_arc(F16 x, F16 depth, F16 radius_sq) noexcept {
    if constexpr (!perspective) return flat_arc_of(x, depth, radius_sq);
    F16 const rest = x * x + depth * depth - radius_sq, zero = wide(0.0F), one = wide(1.0F);
    return arc_of(x, depth, radius_sq, root(greatest(rest, zero)), {zero, one, one});
}

/// gn_ready_ball
template <bool perspective>
GNOMON_WIDE_INLINE void make_ready(F16 x, F16 y, F16 depth, F16 given, Balls16& b) noexcept {
    F16 const radius = given + (magnitude(x) + magnitude(y) + magnitude(depth) + given) * wide(1.9073486328125e-6F), radius_sq = radius * radius;
    F16 const far = wide(formula::gn_far()), zero = wide(0.0F);
    b.x = x, b.y = y, b.depth = depth, b.radius_sq = radius_sq;
    b.tangent = root(greatest(x * x + y * y + depth * depth - radius_sq, zero));
    b.cap = cap_arc<perspective>(x, depth, radius_sq);
    b.cap_low_scale = b.cap_high_scale = wide(1.0F);
    b.y_bounds = {y - radius, y + radius};
    b.x_bounds = b.cap.span;
    if constexpr (perspective) {
        M16 const bounded = depth > wide(1.125F) * radius;
        Span16 const y_bounds = cap_arc<true>(y, depth, radius_sq).span;
        b.cap_low_scale = b.cap.low_at / b.cap.unit;
        b.cap_high_scale = b.cap.high_at / b.cap.unit;
        b.x_bounds = {select(bounded, b.x_bounds.low, zero - far), select(bounded, b.x_bounds.high, far)};
        b.y_bounds = {select(bounded, y_bounds.low, zero - far), select(bounded, y_bounds.high, far)};
    }
}

/// gn_plane_cut and gn_border_corner
template <bool perspective>
GNOMON_WIDE_INLINE Cut16 cut_of(Ball16 const& b, F16 border_y, F16 plane, F16 inverse) noexcept {
    F16 const off = plane - b.depth, rest = b.radius_sq - off * off, scale = perspective ? plane : wide(1.0F);
    F16 const beside = border_y * scale - b.y;
    return {plane, scale, rest, rest >= wide(0.0F), corner(b.x, rest, inverse), corner(b.x, rest - beside * beside, inverse)};
}

/// gn_ends and gn_within
GNOMON_WIDE_INLINE Span16 within(Arc16 const& arc, Cut16 const& near, Cut16 const& far) noexcept {
    F16 const none = wide(formula::gn_far()), near_at = near.depth * arc.unit, far_at = far.depth * arc.unit;
    M16 const any = arc.rest >= wide(0.0F);
    F16 const low = select(any, arc.span.low, none), high = select(any, arc.span.high, wide(0.0F) - none);
    return {select(near.crosses & (arc.low_at <= near_at), near.corner.low, select(far.crosses & (arc.low_at >= far_at), far.corner.low, low)),
            select(near.crosses & (arc.high_at <= near_at), near.corner.high, select(far.crosses & (arc.high_at >= far_at), far.corner.high, high))};
}

/// gn_slice_cap, gn_joined, and the bounds of the whole ball.
GNOMON_WIDE_INLINE Span16 join(Balls16 const& b, I16 ball, F16 y, RowCut16 const& cut) noexcept {
    auto const& [border_y, top, near, far] = cut;
    F16 const unit = lookup(b.cap.unit, ball), near_at = near.depth * unit, far_at = far.depth * unit, next_y = next_lane(border_y);
    F16 const low_at = lookup(b.cap.low_at, ball), high_at = lookup(b.cap.high_at, ball);
    M16 const low_near = near.crosses & (low_at <= near_at), low_far = far.crosses & (low_at >= far_at);
    M16 const high_near = near.crosses & (high_at <= near_at), high_far = far.crosses & (high_at >= far_at);
    F16 const cap_low = select(low_near, near.cap.low, select(low_far, far.cap.low, lookup(b.cap.span.low, ball)));
    F16 const cap_high = select(high_near, near.cap.high, select(high_far, far.cap.high, lookup(b.cap.span.high, ball)));
    F16 const low_scale = select(low_near, near.scale, select(low_far, far.scale, lookup(b.cap_low_scale, ball)));
    F16 const high_scale = select(high_near, near.scale, select(high_far, far.scale, lookup(b.cap_high_scale, ball)));
    M16 const low_in = and_not(border_y * low_scale <= y, next_y * low_scale <= y);
    M16 const high_in = and_not(border_y * high_scale <= y, next_y * high_scale <= y);
    F16 const low = least(top.low, next_lane(top.low)), high = greatest(top.high, next_lane(top.high));
    return {greatest(select(low_in, least(low, cap_low), low), lookup(b.x_bounds.low, ball)),
            least(select(high_in, greatest(high, cap_high), high), lookup(b.x_bounds.high, ball))};
}

/// The span of each lane's row.
template <bool perspective, bool small>
GNOMON_WIDE_INLINE Span16 row_spans(Tables16 const& t, Balls16 const& b, Lanes16 const& at) noexcept {
    Ball16 const ball{lookup(b.x, at.ball), lookup(b.y, at.ball), lookup(b.depth, at.ball), lookup(b.radius_sq, at.ball), lookup(b.tangent, at.ball)};
    F16 const y = lookup<small>(t.y, at.border);
    I16 const next = at.slice + wide(1U);
    Cut16 const near = cut_of<perspective>(ball, y, lookup<small>(t.depth_m, at.slice), lookup<small>(t.inverse, at.slice));
    Cut16 const far = cut_of<perspective>(ball, y, lookup<small>(t.depth_m, next), lookup<small>(t.inverse, next));
    Arc16 const arc = border_arc<perspective>(ball, {y, lookup<small>(t.secant, at.border), lookup<small>(t.cosine, at.border)});
    return join(b, at.ball, ball.y, {y, within(arc, near, far), near, far});
}

}  // namespace gnomon::cull::detail
#endif
