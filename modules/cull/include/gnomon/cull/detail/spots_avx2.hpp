#pragma once
// The spots among eight lights: formula/spot.glsl and spot_rows.glsl, a light a lane, and a direction a lane.

#include <gnomon/cull/detail/cuts_avx2.hpp>

#if GNOMON_CULL_AVX2

namespace gnomon::cull::detail {

struct Line8 {
    F8 slope, inverse, at_eye;
};
struct Side8 {
    F8 middle;
    Line8 first, second;
    F8 bound;
};
struct Silhouette8 {
    F8 upper, start, lean, off;
};
struct Spots8 {
    F8 there;  ///< mask: this light is a spot
    F8 axis_x, axis_y, axis_z, cosine, sine, slack, smallest;
    Span8 depth;
    Silhouette8 outline[2];
    Side8 side[4];
};

/// gn_cone_reach
GNOMON_ROWS_INLINE F8 cone_reach(F8 along, Spots8 const& c) noexcept {
    F8 const one = all(1.0F), zero = all(0.0F);
    F8 const rim = along * c.cosine + root(greatest(one - along * along, zero)) * c.sine;
    return select(along >= c.cosine - all(9.765625e-4F), one, greatest(rim, zero));
}

/// gn_cone_of
GNOMON_ROWS_INLINE void make_cone(Ready8 const& b, F8 const (&axis)[3], F8 cosine, F8 sine, Spots8& c) noexcept {
    F8 const one = all(1.0F);
    F8 const shorten = one / root(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    F8 const scale = one / root(cosine * cosine + sine * sine);
    F8 const size = magnitude(b.x) + magnitude(b.y) + magnitude(b.depth) + b.radius;
    c.axis_x = axis[0] * shorten, c.axis_y = axis[1] * shorten, c.axis_z = axis[2] * shorten;
    c.cosine = cosine * scale;
    c.sine = sine * scale;
    c.slack = size * all(7.62939453125e-6F) + b.radius * all(6.103515625e-5F);
    c.smallest = size * all(0.03125F);
    c.depth.high = b.depth + b.radius * cone_reach(c.axis_z, c) + c.slack;
    c.depth.low = b.depth - b.radius * cone_reach(all(0.0F) - c.axis_z, c) - c.slack;
}

/// gn_line_of
GNOMON_ROWS_INLINE Line8 line_of(F8 across, F8 slope, F8 middle, F8 depth, F8 slack) noexcept {
    F8 const least = all(0.125F);
    F8 const inverse = (across >= least) & (all(1.0F) / greatest(across, least));
    return {slope, inverse, middle + (slack + slope * depth) * inverse};
}

/// gn_spot_bound
GNOMON_ROWS_INLINE F8 spot_bound(Ready8 const& b, Spots8 const& c, F8 middle, F8 along) noexcept {
    F8 const zero = all(0.0F), one = all(1.0F), depth = b.depth, r = b.radius, lean = c.axis_z;
    F8 const tangent = root(greatest(middle * middle + depth * depth - b.radius_sq, zero));
    F8 const touching = (tangent * middle + r * depth) / (tangent * depth - r * middle);
    F8 const facing = along - touching * lean;
    F8 const wanted = (c.cosine - all(9.765625e-4F)) * root(one + touching * touching);
    F8 const ball_bound = select(depth > all(1.125F) * r, touching, all(formula::gn_far()));
    F8 const rim = r * c.sine;
    F8 const rim_u = middle + r * c.cosine * along, rim_depth = depth + r * c.cosine * lean;
    F8 const t = rim_u / rim_depth, tilt = along - t * lean;
    F8 const q0 = (one + t * t) * all(1.000003814697265625F) - tilt * tilt;
    F8 const rim_q1 = rim * (t + tilt * lean), whole = rim_depth * rim_depth;
    F8 const open = whole - rim * rim * (one - lean * lean);
    F8 const root_sq = rim_q1 * rim_q1 + open * greatest(q0, zero);
    F8 const rim_end = t + rim * (rim_q1 + root(greatest(root_sq, zero))) / open;
    F8 const ends = greatest(rim_end, middle / depth) + all(8.0F) * c.slack / c.depth.low;
    F8 const bounded = (c.depth.low > c.smallest) & (open > all(0.015625F) * whole);
    return select(and_not(bounded, facing >= wanted), ends, ball_bound);
}

/// gn_side_of
template <bool perspective>
GNOMON_ROWS_INLINE void make_side(Ready8 const& b, Spots8 const& c, F8 middle, F8 along, Side8& s) noexcept {
    F8 const zero = all(0.0F), lean = c.axis_z, sine = c.sine, least = all(0.0625F);
    F8 const shadow_sq = along * along + lean * lean, width_sq = shadow_sq - sine * sine;
    F8 const narrow = (width_sq > all(0.00390625F)) & (shadow_sq > least);
    F8 const width = root(greatest(width_sq, zero)), scale = all(1.0F) / greatest(shadow_sq, least);
    F8 const first = (width * lean - sine * along) * scale, second = (zero - width * lean - sine * along) * scale;
    F8 const first_slope = (zero - (sine * lean + width * along)) * scale, second_slope = (width * along - sine * lean) * scale;
    s.middle = middle;
    s.first = line_of(first & narrow, first_slope, middle, b.depth, c.slack);
    s.second = line_of(second & narrow, second_slope, middle, b.depth, c.slack);
    s.bound = perspective ? spot_bound(b, c, middle, along) : middle + b.radius * cone_reach(along, c) + c.slack;
}

/// gn_silhouette_of
template <bool perspective>
GNOMON_ROWS_INLINE Silhouette8 silhouette_of(Ready8 const& b, F8 const (&n)[3], F8 there, F8 slack) noexcept {
    F8 const zero = all(0.0F), upright = there & (magnitude(n[0]) >= all(0.125F));
    F8 const inverse = all(1.0F) / select(upright, n[0], all(1.0F));
    F8 const start = perspective ? (zero - n[2]) * inverse : (n[0] * b.x + n[1] * b.y) * inverse;
    return {n[0] > zero, start & upright, ((zero - n[1]) * inverse) & upright, select(upright, slack * magnitude(inverse), all(formula::gn_far()))};
}

/// gn_outline_of
template <bool perspective>
GNOMON_ROWS_INLINE void make_outline(Ready8 const& b, Spots8& c) noexcept {
    F8 const zero = all(0.0F), one = all(1.0F);
    F8 const distance_sq = b.x * b.x + b.y * b.y + b.depth * b.depth;
    F8 const apart = distance_sq > all(9.094947017729282e-13F);
    F8 const inverse = one / root(select(apart, distance_sq, one));
    F8 const sx = perspective ? b.x * inverse : zero, sy = perspective ? b.y * inverse : zero, sz = perspective ? b.depth * inverse : one;
    F8 const ahead = c.axis_x * sx + c.axis_y * sy + c.axis_z * sz;
    F8 const x = c.axis_x - sx * ahead, y = c.axis_y - sy * ahead, z = c.axis_z - sz * ahead;
    F8 const across_sq = x * x + y * y + z * z, width_sq = across_sq - c.sine * c.sine;
    F8 const there = apart & (across_sq > all(0.0625F)) & (width_sq > all(0.00390625F));
    F8 const scale = one / greatest(across_sq, all(0.0625F));
    F8 const width = root(greatest(width_sq, zero)) * scale, back = c.sine * scale;
    F8 const tx = (sy * c.axis_z - sz * c.axis_y) * width, ty = (sz * c.axis_x - sx * c.axis_z) * width,
             tz = (sx * c.axis_y - sy * c.axis_x) * width;
    F8 const first[3] = {tx - x * back, ty - y * back, tz - z * back};
    F8 const second[3] = {zero - (tx + x * back), zero - (ty + y * back), zero - (tz + z * back)};
    c.outline[0] = silhouette_of<perspective>(b, first, there, c.slack);
    c.outline[1] = silhouette_of<perspective>(b, second, there, c.slack);
}

/// gn_ready_spot, for the lanes of `c.there`; the others keep their ball's bounds.
template <bool perspective>
GNOMON_ROWS_INLINE void make_spots(Ready8& b, Spots8& c) noexcept {
    F8 const zero = all(0.0F);
    make_outline<perspective>(b, c);
    make_side<perspective>(b, c, b.x, c.axis_x, c.side[0]);
    make_side<perspective>(b, c, b.y, c.axis_y, c.side[1]);
    make_side<perspective>(b, c, zero - b.x, zero - c.axis_x, c.side[2]);
    make_side<perspective>(b, c, zero - b.y, zero - c.axis_y, c.side[3]);
    b.x_bounds.low = select(c.there, greatest(b.x_bounds.low, zero - c.side[2].bound), b.x_bounds.low);
    b.x_bounds.high = select(c.there, least(b.x_bounds.high, c.side[0].bound), b.x_bounds.high);
    b.y_bounds.low = select(c.there, greatest(b.y_bounds.low, zero - c.side[3].bound), b.y_bounds.low);
    b.y_bounds.high = select(c.there, least(b.y_bounds.high, c.side[1].bound), b.y_bounds.high);
}

/// gn_in_depth: cuts the reach of the spots.
GNOMON_ROWS_INLINE void cut_slices(RowGrid const& g, Spots8 const& c, Ready8& b) noexcept {
    I8 const first = greatest(b.slices.first, count_below<false>(g.depth_m.data() + 1, g.slices, c.depth.low));
    I8 const last = least(b.slices.last, count_below<true>(g.depth_m.data(), g.slices, c.depth.high) - all(1));
    b.slices.first = {_mm256_blendv_epi8(b.slices.first.v, first.v, _mm256_castps_si256(c.there.v))};
    b.slices.last = {_mm256_blendv_epi8(b.slices.last.v, last.v, _mm256_castps_si256(c.there.v))};
    b.reaches = and_not(b.reaches, b.slices.first > b.slices.last);
}

/// What `end_on` needs of a spot. Lanes: eight lights, or four directions of one.
struct Aim8 {
    F8 depth, slack;
    Span8 bounds;
};

/// gn_side_cut. `crosses` and `falls` are masks.
struct SideCut8 {
    F8 end, crosses, falls;
};

template <bool perspective>
GNOMON_ROWS_INLINE SideCut8 side_cut(Aim8 const& c, Side8 const& side, Cut8 const& cut) noexcept {
    F8 const zero = all(0.0F);
    if (!cut.crosses) return {zero, zero, zero};
    F8 const s = root(greatest(cut.rest, zero)), z = cut.depth - c.depth, disc = side.middle + s;
    F8 const first = side.middle + (c.slack - side.first.slope * z) * side.first.inverse;
    F8 const second = side.middle + (c.slack - side.second.slope * z) * side.second.inverse;
    F8 fall = perspective ? disc * s + z * cut.depth : z, end = disc + c.slack;
    F8 const by_first = (side.first.inverse > zero) & (first < end);
    end = select(by_first, first, end);
    fall = select(by_first, perspective ? side.first.at_eye : side.first.slope, fall);
    F8 const by_second = (side.second.inverse > zero) & (second < end);
    end = select(by_second, second, end);
    fall = select(by_second, perspective ? side.second.at_eye : side.second.slope, fall);
    F8 const crosses = (cut.rest >= zero) & (cut.depth <= c.bounds.high) & (cut.depth >= c.bounds.low);
    return {end * cut.inverse, crosses, fall >= zero};
}

/// gn_side_within
GNOMON_ROWS_INLINE F8 side_within(F8 bound, SideCut8 const& near, SideCut8 const& far) noexcept {
    F8 const t = select(and_not(far.crosses, far.falls), least(bound, far.end), bound);
    return select(near.crosses & near.falls, least(bound, near.end), t);
}

/// What cuts the rows of a spot in a slice: the ends of the four directions, and the near plane's inverse.
struct Sides8 {
    F8 t[4], inverse;
};

/// gn_cut_by_line
GNOMON_ROWS_INLINE Span8 cut_by_line(Span8 s, Silhouette8 const& line, F8 top, F8 bottom, F8 inverse) noexcept {
    F8 const off = line.off * inverse, at_top = line.lean * top, at_bottom = line.lean * bottom;
    F8 const high = greatest(at_top, at_bottom) + line.start + off, low = least(at_top, at_bottom) + line.start - off;
    return {select(line.upper, s.low, greatest(s.low, low)), select(line.upper, least(s.high, high), s.high)};
}

/// gn_spot_row's cuts of a ball's span.
GNOMON_ROWS_INLINE Span8 cut_row(Span8 ball, Sides8 const& sides, Silhouette8 const (&outline)[2], F8 top, F8 bottom) noexcept {
    F8 const zero = all(0.0F), far = all(formula::gn_far());
    F8 const inside = (top <= sides.t[1]) & (bottom >= zero - sides.t[3]);
    Span8 s{select(inside, greatest(ball.low, zero - sides.t[2]), far), select(inside, least(ball.high, sides.t[0]), zero - far)};
    s = cut_by_line(s, outline[0], top, bottom, sides.inverse);
    return cut_by_line(s, outline[1], top, bottom, sides.inverse);
}

}  // namespace gnomon::cull::detail
#endif
