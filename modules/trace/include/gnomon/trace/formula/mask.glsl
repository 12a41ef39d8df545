// Is a point of an alpha-masked triangle solid? In float, with a bound of the error, in C++ and in GLSL.
//
// What trace's `AlphaTest` decides in double: mip 0, bilinear between texel centres, factor * alpha >= cutoff is solid.
// Answers: 0 certainly a hole, 1 certainly solid, 2 unsure. Arithmetic is as imprecise as ray.glsl says; e = 2^-23. The
// double's own error is some 2^-29 of these bounds, less than they are rounded up by.
//
// Along a row of texels alpha is a continuous function of the coordinate, wrapped or not, of slope at most 255 codes a
// texel. So an error of the coordinate costs at most that, and between the same four texels their own difference.

#ifndef GNOMON_TRACE_FORMULA_MASK_GLSL
#define GNOMON_TRACE_FORMULA_MASK_GLSL

#include <gnomon/trace/formula/ray.glsl>

GN_BEGIN

/// How a point of a triangle is mixed of its corners: a + share_b (b - a) + share_c (c - a).
GN_STRUCT(GnShares) {
    GN_FLOAT b;
    GN_FLOAT c;
    GN_FLOAT error;  ///< Of each.
    GN_BOOL usable;  ///< Otherwise the triangle is seen so obliquely that nothing can be said.
};

/// The texels on both sides of a coordinate, the weight of the second, and the error of that.
GN_STRUCT(GnTap) {
    GN_INT first;
    GN_INT second;
    GN_FLOAT weight;
    GN_FLOAT error;
};

/// Where the segment passes the triangle.
///
///     |side / total - exact| <= (B + 5.4 B) / (total - 5.4 B) + 2.5e < 7 B / total + 2.5e,  for total > 64 B
///
/// expects: `meeting.answer` is not 0.
GN_FN GN_TYPE(GnShares) gn_shares(GN_TYPE(GnMeeting) meeting) {
    GN_TYPE(GnShares) shares;
    GN_PRECISE GN_FLOAT least_total = meeting.bound * 64.0;
    shares.usable = abs(meeting.total) > least_total;
    GN_FLOAT total = GN_SELECT(shares.usable, meeting.total, GN_FLOAT(1.0));
    shares.b = gn_div(meeting.sides.y, total);
    shares.c = gn_div(meeting.sides.z, total);
    GN_PRECISE GN_FLOAT error = gn_div(meeting.bound, abs(total)) * 8.0 + 4.76837158203125e-7;
    shares.error = error;
    return shares;
}

/// A texture coordinate of the point, and its error: for each difference (error + 6e), for the first corner 2e.
///
/// expects: the corners' coordinates a, b, c are `gn_in_range`.
GN_FN GN_VEC2 gn_coordinate(GN_TYPE(GnShares) shares, GN_FLOAT a, GN_FLOAT b, GN_FLOAT c) {
    GN_PRECISE GN_FLOAT to_b = b - a;
    GN_PRECISE GN_FLOAT to_c = c - a;
    GN_PRECISE GN_FLOAT at = a + (to_b * shares.b + to_c * shares.c);
    GN_PRECISE GN_FLOAT error = (abs(to_b) + abs(to_c)) * (shares.error + 7.152557373046875e-7) +
                                abs(a) * 2.384185791015625e-7 + 7.888609052210118e-31;
    return GN_VEC2(at, error);
}

/// expects: |x| < 2^31.
GN_FN GN_FLOAT gn_floor(GN_FLOAT x) {
    GN_FLOAT cut = GN_FLOAT(GN_INT(x));
    GN_PRECISE GN_FLOAT below = cut - GN_SELECT(cut > x, GN_FLOAT(1.0), GN_FLOAT(0.0));
    return below;
}

/// `wrap`: 0 repeats, 1 clamps, 2 mirrors. expects: -1 <= i <= size, or 2 size when mirrored.
GN_FN GN_INT gn_wrapped(GN_INT i, GN_INT size, GN_INT wrap) {
    GN_INT below = GN_SELECT(wrap == 0, size - 1, GN_INT(0));
    GN_INT mirrored = GN_SELECT(i < size * 2, size * 2 - 1 - i, GN_INT(0));
    GN_INT above = GN_SELECT(wrap == 0, GN_INT(0), GN_SELECT(wrap == 1, size - 1, mirrored));
    return GN_SELECT(i < 0, below, GN_SELECT(i < size, i, above));
}

/// The tap at a coordinate: three roundings of numbers up to 2 size.
///
/// expects: a size of 1 to 2^24, a coordinate below 2^30.
GN_FN GN_TYPE(GnTap) gn_tap(GN_VEC2 coordinate, GN_INT size, GN_INT wrap) {
    GN_PRECISE GN_FLOAT repeated = coordinate.x - gn_floor(coordinate.x);
    GN_PRECISE GN_FLOAT half_way = coordinate.x * 0.5;
    GN_PRECISE GN_FLOAT mirrored = coordinate.x - gn_floor(half_way) * 2.0;
    GN_FLOAT clamped = gn_min(gn_max(coordinate.x, GN_FLOAT(0.0)), GN_FLOAT(1.0));
    GN_FLOAT reduced = GN_SELECT(wrap == 0, repeated, GN_SELECT(wrap == 1, clamped, mirrored));
    GN_PRECISE GN_FLOAT place = reduced * GN_FLOAT(size) - 0.5;
    GN_FLOAT below = gn_floor(place);
    GN_TYPE(GnTap) tap;
    tap.first = gn_wrapped(GN_INT(below), size, wrap);
    tap.second = gn_wrapped(GN_INT(below) + 1, size, wrap);
    GN_PRECISE GN_FLOAT weight = place - below;
    GN_PRECISE GN_FLOAT error = (coordinate.y + 7.152557373046875e-7) * GN_FLOAT(size);
    tap.weight = weight;
    tap.error = error;
    return tap;
}

/// The answer without a texture: factor >= cutoff, where neither may be flushed.
GN_FN GN_INT gn_at_least(GN_FLOAT factor, GN_FLOAT cutoff) {
    GN_UINT f = floatBitsToUint(factor) & 0x7FFFFFFFu;
    GN_UINT o = floatBitsToUint(cutoff) & 0x7FFFFFFFu;
    GN_BOOL plain =
        (f == 0u || (f >= 0x800000u && f < 0x7F800000u)) && (o == 0u || (o >= 0x800000u && o < 0x7F800000u));
    return GN_SELECT(plain, GN_SELECT(factor >= cutoff, 1, 0), 2);
}

/// The answer from four texels' codes, 0 to 255: first and second of the first row in x and y, of the second in z and
/// w.
///
/// expects: factor and cutoff at most 2^28.
GN_FN GN_INT gn_solid(GN_VEC4 codes, GN_TYPE(GnTap) u, GN_TYPE(GnTap) v, GN_FLOAT factor, GN_FLOAT cutoff) {
    GN_PRECISE GN_FLOAT top_step = codes.y - codes.x;
    GN_PRECISE GN_FLOAT bottom_step = codes.w - codes.z;
    GN_PRECISE GN_FLOAT top = codes.x + top_step * u.weight;
    GN_PRECISE GN_FLOAT bottom = codes.z + bottom_step * u.weight;
    GN_PRECISE GN_FLOAT code = top + (bottom - top) * v.weight;
    GN_PRECISE GN_FLOAT u_room = 1.0 - u.error;
    GN_PRECISE GN_FLOAT v_room = 1.0 - v.error;
    GN_BOOL inside = u.weight >= u.error && u.weight <= u_room && v.weight >= v.error && v.weight <= v_room;
    GN_PRECISE GN_FLOAT left_step = codes.z - codes.x;
    GN_PRECISE GN_FLOAT right_step = codes.w - codes.y;
    GN_FLOAT u_slope = GN_SELECT(inside, gn_max(abs(top_step), abs(bottom_step)), GN_FLOAT(255.0));
    GN_FLOAT v_slope = GN_SELECT(inside, gn_max(abs(left_step), abs(right_step)), GN_FLOAT(255.0));
    // 2e and more of the result for each of its roundings: 32e * 255.
    GN_PRECISE GN_FLOAT code_error = (u.error * u_slope + v.error * v_slope) * 1.0625 + 0.0009727478027343750;
    GN_PRECISE GN_FLOAT limit = cutoff * 255.0;
    GN_PRECISE GN_FLOAT above = code * factor - limit;
    GN_PRECISE GN_FLOAT bound = code_error * abs(factor) + abs(limit) * 4.76837158203125e-7;
    return GN_SELECT(above > bound, 1, GN_SELECT(above < -bound, 0, 2));
}

GN_END

#endif  // GNOMON_TRACE_FORMULA_MASK_GLSL
