// Approximate explicit bounds: each axis of a cluster's box is cut in ten, each sample sets one bit an axis, and the OR
// of all samples says which parts are taken.
//
// source: [Olsson 2014, Paper III, 4.4]; a unary set an axis, 30 bits in all

#ifndef GNOMON_CLUSTER_FORMULA_BOUNDS_GLSL
#define GNOMON_CLUSTER_FORMULA_BOUNDS_GLSL

#include <gnomon/math/formula.glsl>

GN_BEGIN

/// Where part `k` of [lo, lo + extent] begins: it does not fall as k rises, whatever the rounding.
GN_FN GN_FLOAT gn_part_begin(GN_FLOAT lo, GN_FLOAT extent, GN_FLOAT k) {
    GN_PRECISE GN_FLOAT share = k * 0.1;
    GN_PRECISE GN_FLOAT begin = lo + extent * share;
    return begin;
}

/// The bit of the part that holds `at`: of as many parts as begin at or before it. Both ends where the axis is infinite,
/// which has no parts.
GN_FN GN_UINT gn_part_bit(GN_FLOAT at, GN_FLOAT lo, GN_FLOAT hi) {
    GN_PRECISE GN_FLOAT extent = hi - lo;
    GN_UINT bit = 1u;
    for (int k = 1; k < 10; ++k)
        bit = GN_SELECT(at >= gn_part_begin(lo, extent, GN_FLOAT(k)), GN_UINT(1u << k), bit);
    return GN_SELECT(extent <= 3.4e38, bit, GN_UINT(0x201u));
}

/// A sample's word: x in bits 0-9, y in 10-19, depth in 20-29.
GN_FN GN_UINT gn_position_bits(GN_VEC3 at, GN_VEC3 lo, GN_VEC3 hi) {
    return gn_part_bit(at.x, lo.x, hi.x) | gn_part_bit(at.y, lo.y, hi.y) << 10 | gn_part_bit(at.z, lo.z, hi.z) << 20;
}

/// The lower end of the parts in `field`, whose lowest ten bits are an axis.
GN_FN GN_FLOAT gn_parts_low(GN_UINT field, GN_FLOAT lo, GN_FLOAT hi) {
    GN_PRECISE GN_FLOAT extent = hi - lo;
    GN_FLOAT low = lo;
    for (int k = 1; k < 10; ++k)
        low = GN_SELECT((field & ((1u << k) - 1u)) == 0u, gn_part_begin(lo, extent, GN_FLOAT(k)), low);
    return low;
}

/// The upper end.
GN_FN GN_FLOAT gn_parts_high(GN_UINT field, GN_FLOAT lo, GN_FLOAT hi) {
    GN_PRECISE GN_FLOAT extent = hi - lo;
    GN_FLOAT high = hi;
    for (int k = 9; k > 0; --k)
        high = GN_SELECT(((field & 0x3FFu) >> k) == 0u, gn_min(gn_part_begin(lo, extent, GN_FLOAT(k)), hi), high);
    return high;
}

GN_END

#endif  // GNOMON_CLUSTER_FORMULA_BOUNDS_GLSL
