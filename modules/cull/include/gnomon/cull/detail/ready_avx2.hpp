#pragma once
// Eight balls at once: the formula's preparation, and which slices, rows and columns each may reach.

#include <gnomon/cull/detail/avx2.hpp>
#include <gnomon/cull/rows.hpp>

#if GNOMON_CULL_AVX2

namespace gnomon::cull::detail {

struct Span8 {
    F8 low, high;
};

/// GnArc.
struct Arc8 {
    Span8 span;
    F8 low_at, high_at, unit, rest;
};

/// GnRowBorder
struct Border8 {
    F8 y, secant, cosine;
};

struct Range8 {
    I8 first, last;
};

/// GnReadyBall, and the ball's reach in the grid: counts from the first slice, row, column to the last, both included.
struct Ready8 {
    F8 x, y, depth, radius, radius_sq, tangent;
    Arc8 cap;
    F8 cap_low_scale, cap_high_scale;
    Span8 x_bounds, y_bounds;
    Range8 slices, rows, columns;
    F8 reaches;  ///< mask: the reach is not empty
};

/// gn_arc_of
GNOMON_ROWS_INLINE Arc8 arc_of(F8 x, F8 w, F8 rest, F8 tangent, Border8 const& border) noexcept {
    F8 const rho = root(greatest(rest, all(0.0F)));
    F8 const along = tangent * w, across = rho * x, side = tangent * x, lift = rho * w;
    F8 const high_w = along - across, low_w = along + across;
    F8 const short_tangent = tangent * border.cosine;
    return {{(side - lift) / low_w * border.secant, (side + lift) / high_w * border.secant},
            short_tangent * low_w, short_tangent * high_w, tangent * tangent + rho * rho, rest};
}

/// gn_flat_arc_of
GNOMON_ROWS_INLINE Arc8 flat_arc_of(F8 x, F8 depth, F8 rest) noexcept {
    F8 const rho = root(greatest(rest, all(0.0F)));
    return {{x - rho, x + rho}, depth, depth, all(1.0F), rest};
}

template <bool perspective>
GNOMON_ROWS_INLINE Arc8 cap_arc(F8 x, F8 depth, F8 radius_sq) noexcept {
    if constexpr (!perspective) return flat_arc_of(x, depth, radius_sq);
    F8 const rest = x * x + depth * depth - radius_sq;
    return arc_of(x, depth, radius_sq, root(greatest(rest, all(0.0F))), {all(0.0F), all(1.0F), all(1.0F)});
}

/// gn_ready_ball
template <bool perspective>
GNOMON_ROWS_INLINE void make_ready(F8 x, F8 y, F8 depth, F8 given, Ready8& r) noexcept {
    F8 const zero = all(0.0F), far = all(formula::gn_far());
    F8 const size = magnitude(x) + magnitude(y) + magnitude(depth) + given;
    F8 const radius = given + size * all(1.9073486328125e-6F);
    F8 const radius_sq = radius * radius;
    r.x = x, r.y = y, r.depth = depth, r.radius = radius, r.radius_sq = radius_sq;
    r.tangent = root(greatest(x * x + y * y + depth * depth - radius_sq, zero));
    r.cap = cap_arc<perspective>(x, depth, radius_sq);
    r.x_bounds = r.cap.span;
    r.cap_low_scale = r.cap_high_scale = all(1.0F);
    r.y_bounds = {y - radius, y + radius};
    if constexpr (perspective) {
        r.cap_low_scale = r.cap.low_at / r.cap.unit;
        r.cap_high_scale = r.cap.high_at / r.cap.unit;
        r.y_bounds = cap_arc<true>(y, depth, radius_sq).span;
        F8 const bounded = depth > all(1.125F) * radius;
        r.x_bounds = {select(bounded, r.x_bounds.low, zero - far), select(bounded, r.x_bounds.high, far)};
        r.y_bounds = {select(bounded, r.y_bounds.low, zero - far), select(bounded, r.y_bounds.high, far)};
    }
}

/// gn_in_slice, by counting planes: those in front of the centre that miss the ball, and those that cross it.
GNOMON_ROWS_INLINE void find_slices(RowGrid const& g, Ready8& r) noexcept {
    I8 missed = all(0), crossing = all(0), before = all(0);
    float const* const planes = g.depth_m.data();
#pragma GCC unroll 4
    for (std::uint32_t k = 0; k <= g.slices; ++k) {
        F8 const at = spread(planes + k);
        F8 const off = at - r.depth;
        F8 const crosses = r.radius_sq - off * off >= all(0.0F), front = at <= r.depth;
        crossing = crossing - minus_one_where(crosses);
        before = before - minus_one_where(front);
        missed = missed - minus_one_where(and_not(front, crosses));
    }
    I8 const last = all(static_cast<std::int32_t>(g.slices) - 1), one = all(1);
    F8 const any = crossing > all(0);
    I8 const first_if = greatest(missed - one, all(0)), last_if = least(missed + crossing - one, last);
    I8 const only = before - one;
    // A lane before the first plane, which reaches nothing, reads a plane like the others.
    r.slices.first = greatest({_mm256_blendv_epi8(only.v, first_if.v, _mm256_castps_si256(any.v))}, all(0));
    r.slices.last = {_mm256_blendv_epi8(only.v, last_if.v, _mm256_castps_si256(any.v))};
    F8 const inside = and_not(before > all(0), only > last);
    r.reaches = any | inside;
}

/// How many of `count` ascending numbers are below x, or at it.
template <bool or_equal>
GNOMON_ROWS_INLINE I8 count_below(float const* from, std::uint32_t count, F8 x) noexcept {
    I8 n = all(0);
    for (std::uint32_t i = 0; i < count; ++i) n = n - minus_one_where(or_equal ? spread(from + i) <= x : spread(from + i) < x);
    return n;
}

/// Which of `count` intervals with ascending ends `bounds` touches: the first and the last.
GNOMON_ROWS_INLINE void find_range(float const* starts, float const* ends, std::uint32_t count, Span8 bounds, Range8& found) noexcept {
    I8 before = all(0), within = all(-1);
#pragma GCC unroll 4
    for (std::uint32_t i = 0; i < count; ++i) {
        before = before - minus_one_where(spread(ends + i) < bounds.low);
        within = within - minus_one_where(spread(starts + i) <= bounds.high);
    }
    found = {before, within};
}

GNOMON_ROWS_INLINE void find_reach(RowGrid const& g, Ready8& r) noexcept {
    find_slices(g, r);
    find_range(g.y.data(), g.y.data() + 1, g.rows, r.y_bounds, r.rows);
    find_range(g.left.data(), g.right.data(), g.columns, r.x_bounds, r.columns);
    r.reaches = and_not(r.reaches, (r.rows.first > r.rows.last) | (r.columns.first > r.columns.last));
}

}  // namespace gnomon::cull::detail
#endif
