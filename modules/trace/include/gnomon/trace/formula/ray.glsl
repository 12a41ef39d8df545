// May a segment touch a box, and does it meet a triangle? In float, with proven bounds, in C++ and in GLSL.
//
// Three answers: what the filter cannot decide is unsure, and an exact test has to be asked. It needs no doubles, no
// rounding mode, no denormals and no infinities: Vulkan promises none of them.
//
// What is assumed of the arithmetic. With e = 2^-23, f = 2^-126: sums, differences and products are off by at most e
// times their size (one unit of the last place: any rounding) plus f (inputs and results below 2^-126 may become 0),
// quotients by 2.5 e plus f. A fused multiply-add only leaves a rounding out. All coordinates are at most 2^28
// (`gn_in_range`), so nothing overflows: no number here is above 2^93.
//
// The ray's frame. Axes are renamed and mirrored, which is exact, so that the segment runs from the origin along z
// most, x and y least: x = slope_x z, y = slope_y z with slopes in [0, 1 + 3e]. A slope is a quotient of differences:
// off by at most (1 + e)(1 + 2.5e)/(1 - e) and what may be flushed, 3f / 2^-40 and f: 4.6e slope + 2^-84. (A sun's
// direction is given, not a difference: 2.5e slope + 2^-84.)

#ifndef GNOMON_TRACE_FORMULA_RAY_GLSL
#define GNOMON_TRACE_FORMULA_RAY_GLSL

#include <gnomon/math/formula.glsl>

GN_BEGIN

/// A segment in its own frame.
GN_STRUCT(GnRay) {
    GN_INT axis_x;  ///< Which of the scene's axes is the frame's x: 0, 1 or 2.
    GN_INT axis_y;
    GN_INT axis_z;
    GN_VEC3 start;  ///< Renamed, not mirrored.
    GN_VEC3 sign;   ///< 1, or -1 where the axis is mirrored.
    GN_FLOAT slope_x;
    GN_FLOAT slope_y;
    GN_FLOAT slope_error;  ///< What the rounding of products with a slope comes to: 6e (sun), 8e (lamp).
    GN_FLOAT end;          ///< z of the lamp; 2^60 for a sun, beyond everything.
    GN_BOOL has_end;
    GN_BOOL flat_x;  ///< The segment does not move along x at all: told by the bits, so exactly.
    GN_BOOL flat_y;
    GN_BOOL usable;  ///< Otherwise nothing can be said: the ends are too near to each other.
};

/// How a segment and a triangle lie; the sides' signs agree where it is met.
GN_STRUCT(GnMeeting) {
    GN_INT answer;  ///< 0: certainly free, 1: certainly blocked, 2: unsure.
    GN_VEC3 sides;  ///< Of the edges opposite to the corners: their shares of `total` are the corners' weights.
    GN_FLOAT total;
    GN_FLOAT bound;  ///< Of each side's error; the total's is 5.4 times that.
};

/// Which sides are exactly 0, by the corners that they are opposite to.
GN_STRUCT(GnTies) {
    GN_BOOL a;
    GN_BOOL b;
    GN_BOOL c;
    GN_BOOL parallel;  ///< The segment is parallel to the triangle's plane, exactly.
};

/// Every coordinate is a number within 2^28, told by the bits: NaN may compare as it likes.
GN_FN GN_BOOL gn_in_range(GN_VEC3 p) {
    return (floatBitsToUint(p.x) & 0x7FFFFFFFu) <= 0x4D800000u && (floatBitsToUint(p.y) & 0x7FFFFFFFu) <= 0x4D800000u &&
           (floatBitsToUint(p.z) & 0x7FFFFFFFu) <= 0x4D800000u;
}

GN_FN GN_FLOAT gn_component(GN_VEC3 p, GN_INT axis) {
    return GN_SELECT(axis == 0, p.x, GN_SELECT(axis == 1, p.y, p.z));
}

GN_FN GN_FLOAT gn_least(GN_VEC3 p) { return gn_min(gn_min(p.x, p.y), p.z); }
GN_FN GN_FLOAT gn_greatest(GN_VEC3 p) { return gn_max(gn_max(p.x, p.y), p.z); }
GN_FN GN_FLOAT gn_largest_size(GN_VEC3 p) { return gn_max(gn_max(abs(p.x), abs(p.y)), abs(p.z)); }

/// The same number for certain, which == does not tell of two that may be flushed.
GN_FN GN_BOOL gn_same(GN_FLOAT a, GN_FLOAT b) {
    return floatBitsToUint(a) == floatBitsToUint(b) || ((floatBitsToUint(a) | floatBitsToUint(b)) << 1) == 0u;
}

/// Whether a direction without x (`flat_x`), without y or without both lies in the plane of a, b, c for certain: all
/// three have one x, or one y, or two of them differ in z at most. So it is where the sun stands straight above walls.
GN_FN GN_BOOL gn_holds_direction(GN_VEC3 a, GN_VEC3 b, GN_VEC3 c, GN_BOOL flat_x, GN_BOOL flat_y) {
    GN_BOOL ab_x = gn_same(a.x, b.x);
    GN_BOOL bc_x = gn_same(b.x, c.x);
    GN_BOOL ca_x = gn_same(c.x, a.x);
    GN_BOOL ab_y = gn_same(a.y, b.y);
    GN_BOOL bc_y = gn_same(b.y, c.y);
    GN_BOOL ca_y = gn_same(c.y, a.y);
    GN_BOOL along_z = flat_x && flat_y && ((ab_x && ab_y) || (bc_x && bc_y) || (ca_x && ca_y));
    return along_z || (flat_x && ab_x && bc_x) || (flat_y && ab_y && bc_y);
}

/// A direction times the power of two that brings its largest component into [1, 2): exact but for what is flushed,
/// below f.
///
/// returns: zero for a direction that is zero or so small or large that there is no such power.
GN_FN GN_VEC3 gn_scaled(GN_VEC3 direction) {
    GN_UINT exponent = floatBitsToUint(gn_largest_size(direction)) >> 23;
    GN_BOOL ordinary = exponent > 0u && exponent < 254u;
    GN_FLOAT scale = uintBitsToFloat(GN_SELECT(ordinary, GN_UINT(254u) - exponent, GN_UINT(0u)) << 23);
    GN_PRECISE GN_VEC3 scaled = direction * scale;
    return scaled;
}

/// The frame of the segment from `start` to `end`, a point, or else the direction towards a sun.
///
/// expects: `gn_in_range` of both, or `gn_scaled` of a direction.
GN_FN GN_TYPE(GnRay) gn_make_ray(GN_VEC3 start, GN_VEC3 end, GN_BOOL end_is_point) {
    GN_PRECISE GN_FLOAT x = end.x - GN_SELECT(end_is_point, start.x, GN_FLOAT(0.0));
    GN_PRECISE GN_FLOAT y = end.y - GN_SELECT(end_is_point, start.y, GN_FLOAT(0.0));
    GN_PRECISE GN_FLOAT z = end.z - GN_SELECT(end_is_point, start.z, GN_FLOAT(0.0));
    GN_VEC3 extent = GN_VEC3(x, y, z);
    GN_VEC3 size = GN_VEC3(abs(x), abs(y), abs(z));
    GN_TYPE(GnRay) ray;
    ray.axis_z = GN_SELECT(size.x >= size.y && size.x >= size.z, 0, GN_SELECT(size.y >= size.z, 1, 2));
    ray.axis_x = GN_SELECT(ray.axis_z == 2, 0, ray.axis_z + 1);
    ray.axis_y = GN_SELECT(ray.axis_x == 2, 0, ray.axis_x + 1);
    ray.start =
        GN_VEC3(gn_component(start, ray.axis_x), gn_component(start, ray.axis_y), gn_component(start, ray.axis_z));
    ray.sign = GN_VEC3(GN_SELECT(gn_component(extent, ray.axis_x) < 0.0, GN_FLOAT(-1.0), GN_FLOAT(1.0)),
                       GN_SELECT(gn_component(extent, ray.axis_y) < 0.0, GN_FLOAT(-1.0), GN_FLOAT(1.0)),
                       GN_SELECT(gn_component(extent, ray.axis_z) < 0.0, GN_FLOAT(-1.0), GN_FLOAT(1.0)));
    GN_FLOAT along = gn_component(size, ray.axis_z);
    ray.usable = along > 9.094947017729282e-13;  // 2^-40
    GN_FLOAT divisor = GN_SELECT(ray.usable, along, GN_FLOAT(1.0));
    GN_PRECISE GN_FLOAT slope_x = gn_div(gn_component(size, ray.axis_x), divisor);
    GN_PRECISE GN_FLOAT slope_y = gn_div(gn_component(size, ray.axis_y), divisor);
    ray.slope_x = slope_x;
    ray.slope_y = slope_y;
    ray.slope_error = GN_SELECT(end_is_point, GN_FLOAT(9.5367431640625e-7), GN_FLOAT(7.152557373046875e-7));
    ray.end = GN_SELECT(end_is_point, along, GN_FLOAT(1.152921504606847e18));
    ray.has_end = end_is_point;
    GN_VEC3 from =
        GN_VEC3(GN_SELECT(end_is_point, start.x, GN_FLOAT(0.0)), GN_SELECT(end_is_point, start.y, GN_FLOAT(0.0)),
                GN_SELECT(end_is_point, start.z, GN_FLOAT(0.0)));
    ray.flat_x = gn_same(gn_component(from, ray.axis_x), gn_component(end, ray.axis_x));
    ray.flat_y = gn_same(gn_component(from, ray.axis_y), gn_component(end, ray.axis_y));
    return ray;
}

/// A point in the ray's frame.
///
/// expects: `p` has its components in the frame's order.
GN_FN GN_VEC3 gn_in_frame(GN_TYPE(GnRay) ray, GN_VEC3 p) {
    GN_PRECISE GN_FLOAT x = (p.x - ray.start.x) * ray.sign.x;
    GN_PRECISE GN_FLOAT y = (p.y - ray.start.y) * ray.sign.y;
    GN_PRECISE GN_FLOAT z = (p.z - ray.start.z) * ray.sign.z;
    return GN_VEC3(x, y, z);
}

/// Whether the closed segment may touch the box; never false where it does. `lo` and `hi` are the box's corners of
/// least and greatest coordinates in the frame (`gn_in_frame` of lo and hi, exchanged along mirrored axes).
///
/// If the segment touches the box at (x, y, z), then with exact numbers
///     max(lo.z, 0) <= z <= min(hi.z, end),  lo.x <= x = slope_x z <= hi.x,  and so for y,
/// hence slope_x max(lo.z, 0) <= hi.x, lo.x <= slope_x min(hi.z, end), and slope_y lo.x <= slope_y slope_x z =
/// slope_x y <= slope_x hi.y. (These conditions are also sufficient: they are the axes along which a box and a line can
/// be separated.) Each compares two numbers that are not negative where it matters, off by at most 4.6e of the slope, e
/// of the plane, e of the product, and flushed parts: (2^-84 + 2f) 2^29 < 2^-54. In sum less than 16e and 2^-53;
/// allowed are 32e and 2^-50.
GN_FN GN_BOOL gn_may_touch(GN_TYPE(GnRay) ray, GN_VEC3 lo, GN_VEC3 hi) {
    GN_FLOAT first = gn_max(lo.z, GN_FLOAT(0.0));
    GN_FLOAT last = gn_min(hi.z, ray.end);
    GN_PRECISE GN_FLOAT last_wide = last * 1.000003814697265625 + 8.881784197001252e-16;
    GN_PRECISE GN_FLOAT hi_x = hi.x * 1.000003814697265625 + 8.881784197001252e-16;
    GN_PRECISE GN_FLOAT hi_y = hi.y * 1.000003814697265625 + 8.881784197001252e-16;
    GN_PRECISE GN_FLOAT x_first = ray.slope_x * first;
    GN_PRECISE GN_FLOAT y_first = ray.slope_y * first;
    GN_PRECISE GN_FLOAT x_last = ray.slope_x * last_wide + 8.881784197001252e-16;
    GN_PRECISE GN_FLOAT y_last = ray.slope_y * last_wide + 8.881784197001252e-16;
    GN_PRECISE GN_FLOAT left_of = ray.slope_y * lo.x;
    GN_PRECISE GN_FLOAT left = ray.slope_x * hi_y + 8.881784197001252e-16;
    GN_PRECISE GN_FLOAT right_of = ray.slope_x * lo.y;
    GN_PRECISE GN_FLOAT right = ray.slope_y * hi_x + 8.881784197001252e-16;
    return first <= last_wide && x_first <= hi_x && y_first <= hi_y && lo.x <= x_last && lo.y <= y_last &&
           left_of <= left && right_of <= right;
}

/// What the bits tell of a segment that does not move along x or y, and a triangle: where a corner has the start's x,
/// x' is exactly 0 there, and a side of two such corners is 0. So it is at the edges of boxes below a sun straight
/// above.
GN_FN GN_TYPE(GnTies) gn_ties(GN_TYPE(GnRay) ray, GN_VEC3 a, GN_VEC3 b, GN_VEC3 c) {
    GN_BOOL ax = ray.flat_x && gn_same(a.x, ray.start.x);
    GN_BOOL bx = ray.flat_x && gn_same(b.x, ray.start.x);
    GN_BOOL cx = ray.flat_x && gn_same(c.x, ray.start.x);
    GN_BOOL ay = ray.flat_y && gn_same(a.y, ray.start.y);
    GN_BOOL by = ray.flat_y && gn_same(b.y, ray.start.y);
    GN_BOOL cy = ray.flat_y && gn_same(c.y, ray.start.y);
    GN_TYPE(GnTies) ties;
    ties.a = (bx && cx) || (by && cy) || (bx && by) || (cx && cy);
    ties.b = (cx && ax) || (cy && ay) || (cx && cy) || (ax && ay);
    ties.c = (ax && bx) || (ay && by) || (ax && ay) || (bx && by);
    ties.parallel = gn_holds_direction(a, b, c, ray.flat_x, ray.flat_y);
    return ties;
}

/// Whether the segment meets the triangle whose corners these are, in the frame's order: whether its ends lie strictly
/// on opposite sides of the plane and the line passes the closed interior.
///
/// In the frame, and sheared, so that the segment is the z axis: q = slope z, x' = x - q. Errors, in computed numbers:
///     x:   1.001e |x| + 4f                 q: (4.6 + 1 + 1)e |q| + 2^-84 |z| + 6f, second order included: 6.72e |q| +
///     2^-54.8 x':  2.01e |x| + 7.73e |q| + 2^-54.7 (sun: 5.6e |q|), below E = max over corners of 2.125e |x| +
///     slope_error |q| + 2^-54 u = x1' y2' - y1' x2', with M the largest |x'|, |y'|:  4 M E + 2 E^2 + 4.01e M^2 + 3f,
///     below
///         B = 4 E (M + E) + 4.25e M^2 + 2^-100
///     total = u + v + w:   3 B + 10.1e M^2 < 5.4 B, as e M^2 < B / 4.25
///     T = u z0 + v z1 + w z2, with Z the largest |z|, plus 2^-60 for what is flushed:
///         3 (B Z + 2.01e M^2 Z + 2.01e M^2 Z) + 10.1e M^2 Z < 8.3 B Z
///     end total - T:       (5.4 B + 3 * 6.01e M^2) end + (8.3 B + 6.1e M^2) Z < 9.75 B (end + Z)
/// The constants below are at least 2 % above these; what computing them rounds is less, and 2^-100 stands for what it
/// flushes. If all sides are certainly of one sign, or certainly 0 but for one, the line passes the triangle at z = T /
/// total.
GN_FN GN_TYPE(GnMeeting) gn_meet(GN_TYPE(GnRay) ray, GN_VEC3 corner_a, GN_VEC3 corner_b, GN_VEC3 corner_c) {
    GN_TYPE(GnTies) ties = gn_ties(ray, corner_a, corner_b, corner_c);
    GN_VEC3 a = gn_in_frame(ray, corner_a);
    GN_VEC3 b = gn_in_frame(ray, corner_b);
    GN_VEC3 c = gn_in_frame(ray, corner_c);
    GN_PRECISE GN_VEC3 qx = GN_VEC3(ray.slope_x * a.z, ray.slope_x * b.z, ray.slope_x * c.z);
    GN_PRECISE GN_VEC3 qy = GN_VEC3(ray.slope_y * a.z, ray.slope_y * b.z, ray.slope_y * c.z);
    GN_PRECISE GN_VEC3 x = GN_VEC3(a.x - qx.x, b.x - qx.y, c.x - qx.z);
    GN_PRECISE GN_VEC3 y = GN_VEC3(a.y - qy.x, b.y - qy.y, c.y - qy.z);
    GN_VEC3 z = GN_VEC3(a.z, b.z, c.z);
    GN_FLOAT largest = gn_max(gn_largest_size(GN_VEC3(a.x, b.x, c.x)), gn_largest_size(GN_VEC3(a.y, b.y, c.y)));
    GN_FLOAT largest_q = gn_max(gn_largest_size(qx), gn_largest_size(qy));
    GN_PRECISE GN_FLOAT error = largest * 2.5331974029541016e-7 + largest_q * ray.slope_error + 5.551115123125783e-17;
    GN_FLOAT reach = gn_max(gn_largest_size(x), gn_largest_size(y));
    GN_PRECISE GN_FLOAT bound =
        error * (reach + error) * 4.0 + reach * reach * 5.066394805908203e-7 + 7.888609052210118e-31;

    GN_FLOAT z_first = gn_least(z);
    GN_FLOAT z_last = gn_greatest(z);
    GN_PRECISE GN_FLOAT end_wide = ray.end * 1.000000476837158203125 + 8.673617379884035e-19;
    GN_BOOL beside = gn_least(x) > error || gn_greatest(x) < -error || gn_least(y) > error || gn_greatest(y) < -error ||
                     z_last < 0.0 || z_first > end_wide || ties.parallel;

    GN_PRECISE GN_FLOAT side_a = x.y * y.z - y.y * x.z;
    GN_PRECISE GN_FLOAT side_b = x.z * y.x - y.z * x.x;
    GN_PRECISE GN_FLOAT side_c = x.x * y.y - y.x * x.y;
    GN_VEC3 sides = GN_VEC3(side_a, side_b, side_c);
    GN_BOOL passes = beside || (gn_least(sides) < -bound && gn_greatest(sides) > bound);
    GN_BOOL meets = !(ties.a && ties.b && ties.c) &&
                    (((side_a > bound || ties.a) && (side_b > bound || ties.b) && (side_c > bound || ties.c)) ||
                     ((side_a < -bound || ties.a) && (side_b < -bound || ties.b) && (side_c < -bound || ties.c)));

    GN_PRECISE GN_FLOAT total = side_a + side_b + side_c;
    GN_PRECISE GN_FLOAT at_plane = side_a * z.x + side_b * z.y + side_c * z.z;
    GN_FLOAT sized_total = abs(total);
    GN_FLOAT before = GN_SELECT(total < 0.0, -at_plane, at_plane);
    GN_PRECISE GN_FLOAT depth = gn_largest_size(z) + 8.673617379884035e-19;
    GN_PRECISE GN_FLOAT before_bound = bound * depth * 8.5 + 7.888609052210118e-31;
    GN_PRECISE GN_FLOAT after = ray.end * sized_total - before;
    GN_PRECISE GN_FLOAT after_bound = bound * (depth + ray.end) * 10.0 + 7.888609052210118e-31;
    GN_BOOL behind = meets && (before < -before_bound || (ray.has_end && after < -after_bound));
    GN_BOOL between = before > before_bound && (!ray.has_end || after > after_bound);

    GN_TYPE(GnMeeting) meeting;
    meeting.answer = GN_SELECT(passes || behind, 0, GN_SELECT(meets && between, 1, 2));
    meeting.sides = sides;
    meeting.total = total;
    meeting.bound = bound;
    return meeting;
}

GN_END

#endif  // GNOMON_TRACE_FORMULA_RAY_GLSL
