#pragma once
// The rows of balls, eight borders at a time: the formula's bits, without the parts that the formula computes in vain.
//
// A light's work: where it is among the planes of the grid (three searches by comparison), the arcs of the borders that
// it may touch, then slice by slice the corners on the planes that cross it. Corners of a plane serve both slices.

#include <gnomon/cull/rows.hpp>
#include <gnomon/math/lanes.hpp>

#if GNOMON_VECTOR_EXTENSION && defined(__x86_64__)
#define GNOMON_CULL_AVX2 1
#include <immintrin.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#define GNOMON_ROWS_INLINE [[gnu::target("avx2,bmi,bmi2,popcnt,lzcnt"), gnu::always_inline]] inline
#define GNOMON_ROWS_TARGET [[gnu::target("avx2,bmi,bmi2,popcnt,lzcnt"), gnu::flatten]]

namespace gnomon::cull::detail {

using L8 = math::Lanes<float, 8>;
using M8 = L8::Mask;
using Ready8 = formula::GnReadyBall<L8>;

inline constexpr std::uint32_t max_slices_avx2 = 127;  ///< What the kernel's stack holds; beyond: the scalar loop.

[[nodiscard]] inline bool has_avx2() noexcept {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("popcnt");
}

/// Eight prepared balls, as numbers: `field[f][lane]`.
struct alignas(32) ReadyFields {
    static constexpr std::size_t count = sizeof(Ready8) / sizeof(L8);
    float field[count][8];
};

GNOMON_ROWS_INLINE std::uint32_t bits_of(M8 const& mask) noexcept {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(reinterpret_cast<__m256i>(mask.v))));
}

/// Each lane's right neighbour; the last lane keeps its own.
GNOMON_ROWS_INLINE L8 next_lane(L8 const& a) noexcept {
    return {_mm256_permutevar8x32_ps(a.v, _mm256_setr_epi32(1, 2, 3, 4, 5, 6, 7, 7))};
}

GNOMON_ROWS_INLINE void make_ready(float const* x, float const* y, float const* depth, float const* radius, bool perspective,
                                   ReadyFields& out) noexcept {
    formula::Vec3<L8> const center(L8::load(x), L8::load(y), L8::load(depth));
    Ready8 const ready = formula::gn_ready_ball(center, formula::Float<L8>(L8::load(radius)), perspective);
    std::memcpy(out.field, &ready, sizeof(ready));
}

/// One of eight, in every lane.
GNOMON_ROWS_INLINE Ready8 spread(ReadyFields const& from, std::size_t lane) noexcept {
    L8 all[ReadyFields::count];
    for (std::size_t f = 0; f < ReadyFields::count; ++f) all[f] = {_mm256_broadcast_ss(&from.field[f][lane])};
    Ready8 r;
    std::memcpy(&r, all, sizeof(r));
    return r;
}

/// How many of `count` ascending numbers are below `x` (or equal, if `or_equal`). Reads up to 7 more: NaN, not counted.
template <bool or_equal>
GNOMON_ROWS_INLINE std::uint32_t count_below(float const* from, std::uint32_t count, L8 const& x) noexcept {
    std::uint32_t n = 0;
    for (std::uint32_t i = 0; i < count; i += 8) {
        L8 const at = L8::load(from + i);
        n += static_cast<std::uint32_t>(std::popcount(bits_of(or_equal ? at <= x : at < x)));
    }
    return n;
}

/// Slices, rows and columns of a grid that a ball may reach, both ends included; empty where a first is past its last.
struct Reach {
    std::uint32_t slice_first, slice_last, row_first, row_last, column_first, column_last;
};

/// `rest[k]` becomes the rest of the plane k (see GnPlaneCut).
GNOMON_ROWS_INLINE bool find_slices(RowGrid const& g, formula::GnBall<L8> const& ball, float* rest, Reach& reach) noexcept {
    std::uint32_t below = 0, crossing = 0, before = 0;
    L8 const zero = L8::all(0.0F), depth = ball.center.z.v;
    for (std::uint32_t k = 0; k <= g.slices; k += 8) {
        L8 const at = L8::load(g.depth_m.data() + k);
        L8 const off = at - depth;
        L8 const left = ball.radius_sq.v - off * off;
        left.store(rest + k);
        std::uint32_t const crosses = bits_of(left >= zero), front = bits_of(at <= depth);
        crossing += static_cast<std::uint32_t>(std::popcount(crosses));
        before += static_cast<std::uint32_t>(std::popcount(front));
        below += static_cast<std::uint32_t>(std::popcount(front & ~crosses));
    }
    if (crossing > 0) {
        reach.slice_first = below > 0 ? below - 1 : 0;
        reach.slice_last = below + crossing - 1 < g.slices ? below + crossing - 1 : g.slices - 1;
        return true;
    }
    reach.slice_first = reach.slice_last = before - 1;
    return before > 0 && before <= g.slices;
}

GNOMON_ROWS_INLINE bool find_reach(RowGrid const& g, Ready8 const& ready, float* rest, Reach& reach) noexcept {
    if (!find_slices(g, ready.ball, rest, reach)) return false;
    reach.row_first = count_below<false>(g.y.data() + 1, g.rows, ready.y.low.v);
    std::uint32_t const rows = count_below<true>(g.y.data(), g.rows, ready.y.high.v);
    reach.column_first = count_below<false>(g.right.data(), g.columns, ready.x.low.v);
    std::uint32_t const columns = count_below<true>(g.left.data(), g.columns, ready.x.high.v);
    reach.row_last = (rows < g.rows ? rows : g.rows) - 1;
    reach.column_last = columns - 1;
    return rows > reach.row_first && columns > reach.column_first;
}

/// A plane's cut in every lane, and the border corners on it; `crosses`: whether it meets the ball at all.
struct PlaneCorners {
    formula::GnPlaneCut<L8> cut;
    formula::GnSpan<L8> corner;
    bool crosses;
};

GNOMON_ROWS_INLINE PlaneCorners make_corners(RowGrid const& g, formula::GnBall<L8> const& ball, std::uint32_t k, float rest,
                                             formula::GnRowBorder<L8> const& border) noexcept {
    PlaneCorners c;
    c.crosses = rest >= 0.0F;
    if (!c.crosses) {
        L8 const far = L8::all(formula::gn_far());
        c.cut.rest.v = L8::all(-1.0F);
        c.cut.plane.depth.v = c.cut.plane.scale.v = c.cut.plane.inverse.v = L8::all(0.0F);
        c.cut.cap.low.v = c.corner.low.v = far;
        c.cut.cap.high.v = c.corner.high.v = -far;
        return c;
    }
    c.cut.plane.depth.v = L8::all(g.depth_m[k]);
    c.cut.plane.scale.v = L8::all(g.scale[k]);
    c.cut.plane.inverse.v = L8::all(g.inverse[k]);
    c.cut.rest.v = L8::all(rest);
    c.cut.cap = formula::gn_corner(ball.center.x, formula::Float<L8>(0.0F), c.cut.rest, c.cut.plane.inverse);
    c.corner = formula::gn_border_corner(ball, border, c.cut);
    return c;
}

/// What a ball covers of seven rows of a slice: between each lane's border and the next.
GNOMON_ROWS_INLINE formula::GnSpan<L8> row_spans(Ready8 const& ready, formula::GnRowBorder<L8> const& border,
                                                 formula::GnArc<L8> const& arc, PlaneCorners const& near,
                                                 PlaneCorners const& far) noexcept {
    formula::GnSpan<L8> top;
    formula::GnCap<L8> cap;
    if (near.crosses || far.crosses) {
        top = formula::gn_within(arc, formula::gn_ends(arc, near.cut, far.cut), near.corner, far.corner);
        cap = formula::gn_slice_cap(ready, near.cut, far.cut);
    } else {
        formula::Bool<L8> const any = arc.rest >= formula::Float<L8>(0.0F);
        top.low = gn_select(any, arc.span.low, formula::Float<L8>(formula::gn_far()));
        top.high = gn_select(any, arc.span.high, formula::Float<L8>(-formula::gn_far()));
        cap = {ready.cap.span, ready.cap_low_scale, ready.cap_high_scale};
    }
    formula::GnSpan<L8> const bottom{{next_lane(top.low.v)}, {next_lane(top.high.v)}};
    formula::Float<L8> const y = ready.ball.center.y, next_y{next_lane(border.y.v)};
    formula::Bool<L8> const low_inside = formula::gn_below(border.y, cap.low_scale, y) && !formula::gn_below(next_y, cap.low_scale, y);
    formula::Bool<L8> const high_inside =
        formula::gn_below(border.y, cap.high_scale, y) && !formula::gn_below(next_y, cap.high_scale, y);
    formula::GnSpan<L8> s = formula::gn_joined(top, bottom, cap.span, low_inside, high_inside);
    s.low = gn_max(s.low, ready.x.low);
    s.high = gn_min(s.high, ready.x.high);
    return s;
}

/// Calls `sink.row(row index, low, high)` for every row of every slice where the ball's span is not empty, by borders,
/// then slices. The row index is slice * rows + row. Before: `sink.begin(reach)`.
template <bool perspective, class Sink>
GNOMON_ROWS_INLINE void visit_ball(RowGrid const& g, ReadyFields const& fields, std::size_t lane, Sink& sink) noexcept {
    alignas(32) float rest[max_slices_avx2 + 1 + 8];
    Ready8 const ready = spread(fields, lane);
    Reach reach;
    if (!find_reach(g, ready, rest, reach)) return;
    sink.begin(reach);
    for (std::uint32_t j = reach.row_first; j <= reach.row_last; j += 7) {
        std::uint32_t const count = reach.row_last - j + 1 < 7 ? reach.row_last - j + 1 : 7;
        formula::GnRowBorder<L8> border;
        border.y.v = L8::load(g.y.data() + j);
        border.secant.v = L8::load(g.secant.data() + j);
        border.cosine.v = L8::load(g.cosine.data() + j);
        formula::GnArc<L8> const arc = formula::gn_border_arc(ready.ball, border, perspective);
        PlaneCorners near = make_corners(g, ready.ball, reach.slice_first, rest[reach.slice_first], border);
        for (std::uint32_t k = reach.slice_first; k <= reach.slice_last; ++k) {
            PlaneCorners const far = make_corners(g, ready.ball, k + 1, rest[k + 1], border);
            formula::GnSpan<L8> const s = row_spans(ready, border, arc, near, far);
            std::uint32_t some = bits_of(s.low.v <= s.high.v) & ((1U << count) - 1U);
            alignas(32) float low[8], high[8];
            s.low.v.store(low);
            s.high.v.store(high);
            for (; some != 0; some &= some - 1) {
                auto const i = static_cast<std::uint32_t>(std::countr_zero(some));
                sink.row(k * g.rows + j + i, low[i], high[i]);
            }
            near = far;
        }
    }
}

}  // namespace gnomon::cull::detail
#else
#define GNOMON_CULL_AVX2 0
#endif
