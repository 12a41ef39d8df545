// May a sphere, a box or half-spaces share a point with a box or a sphere? Conservative: each says no only where exact
// arithmetic on the same floats says no, however operands are subnormal and whether or not those are flushed to zero.
//
// e = 2^-24, half a unit of the last place. Every bound is in the comment of its test; sets are closed.

#ifndef GNOMON_MATH_FORMULA_TOUCH_GLSL
#define GNOMON_MATH_FORMULA_TOUCH_GLSL

#include <gnomon/math/formula.glsl>

GN_BEGIN

GN_STRUCT(GnBox) {
    GN_VEC3 lo;
    GN_VEC3 hi;
};

/// All points within `radius` of `center`; without a point where the radius is negative.
GN_STRUCT(GnSphere) {
    GN_VEC3 center;
    GN_FLOAT radius;
};

/// A half-space dot(normal, p) + offset >= 0. Each coefficient is within 2 e of its magnitude, and 2^-126, of the one
/// that is meant; `norm` is no less than the normal's length.
struct GnPlane {
    vec3 normal;
    float offset;
    vec3 magnitude;  // no less than |normal| + 2^-100, per axis
    float norm;
};

GN_FN GN_BOOL gn_is_finite(GN_FLOAT x) { return abs(x) <= 3.402823466e38; }

GN_FN GN_BOOL gn_is_finite3(GN_VEC3 p) { return gn_is_finite(p.x) && gn_is_finite(p.y) && gn_is_finite(p.z); }

GN_FN GN_BOOL gn_is_empty(GN_IN(GN_TYPE(GnBox)) box) {
    return !(box.lo.x <= box.hi.x && box.lo.y <= box.hi.y && box.lo.z <= box.hi.z);
}

/// No more than x - r, no less than three units of the last place below: the difference errs by at most half a unit
/// u of its last place, |d| 2^-23 lies in [u, 2 u), and what is rounded down by at least u is at most d - u.
GN_FN GN_FLOAT gn_low_end(GN_FLOAT x, GN_FLOAT r) {
    GN_PRECISE GN_FLOAT d = x - r;
    GN_PRECISE GN_FLOAT low = d - abs(d) * 1.1920928955078125e-7;
    return low;
}

/// A box that holds the sphere, by at most three units of the last place a side too large; empty if the sphere is.
GN_FN GN_TYPE(GnBox) gn_box_of(GN_IN(GN_TYPE(GnSphere)) s) {
    GN_TYPE(GnBox) box;
    box.lo = GN_VEC3(gn_low_end(s.center.x, s.radius), gn_low_end(s.center.y, s.radius), gn_low_end(s.center.z, s.radius));
    box.hi = -GN_VEC3(gn_low_end(-s.center.x, s.radius), gn_low_end(-s.center.y, s.radius), gn_low_end(-s.center.z, s.radius));
    return box;
}

/// What a squared distance is compared with: negative, so that nothing touches, for radii that are negative or no number.
///
/// A distance per axis errs by e of itself, its square by 3 e, the sum by 5 e in all, and 2^-148 more where squares
/// underflow. r r (1 + 16 e) in float is at least r^2 (1 + 13 e); 2^-120 covers what underflows or is flushed.
GN_FN GN_FLOAT gn_touch_limit(GN_FLOAT radius) {
    GN_PRECISE GN_FLOAT limit = radius * radius * 1.00000095367431640625 + 7.52316384526264e-37;
    return GN_SELECT(radius >= 0.0 && gn_is_finite(radius), limit, GN_FLOAT(-1.0));
}

/// How far p is from [lo, hi], to e; NaN stays.
GN_FN GN_FLOAT gn_beyond(GN_FLOAT p, GN_FLOAT lo, GN_FLOAT hi) {
    GN_PRECISE GN_FLOAT under = lo - p;
    GN_PRECISE GN_FLOAT over = p - hi;
    return gn_max(gn_max(under, over), 0.0);
}

GN_FN GN_FLOAT gn_length_sq(GN_FLOAT x, GN_FLOAT y, GN_FLOAT z) {
    GN_PRECISE GN_FLOAT sum = (x * x + y * y) + z * z;
    return sum;
}

/// Sphere and box; `limit` is gn_touch_limit(radius). A box without a point may count as touched.
GN_FN GN_BOOL gn_touches_sphere_box(GN_VEC3 center, GN_FLOAT limit, GN_IN(GN_TYPE(GnBox)) box) {
    GN_FLOAT x = gn_beyond(center.x, box.lo.x, box.hi.x);
    GN_FLOAT y = gn_beyond(center.y, box.lo.y, box.hi.y);
    GN_FLOAT z = gn_beyond(center.z, box.lo.z, box.hi.z);
    return gn_length_sq(x, y, z) <= limit;
}

/// Two spheres: the sum of the radii, rounded, is at least (1 - e) of itself, its limit at least (1 + 11 e) of the
/// square; the squared distance errs by 5 e. A negative radius touches nothing.
GN_FN GN_BOOL gn_touches_sphere_sphere(GN_VEC3 center, GN_FLOAT radius, GN_IN(GN_TYPE(GnSphere)) s) {
    GN_PRECISE GN_FLOAT reach = radius + s.radius;
    GN_PRECISE GN_FLOAT limit = reach * reach * 1.00000095367431640625 + 7.52316384526264e-37;
    GN_PRECISE GN_VEC3 d = center - s.center;
    return gn_length_sq(d.x, d.y, d.z) <= limit && radius >= 0.0 && s.radius >= 0.0;
}

/// Two boxes: comparisons, so exact.
GN_FN GN_BOOL gn_touches_box_box(GN_IN(GN_TYPE(GnBox)) a, GN_IN(GN_TYPE(GnBox)) b) {
    return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z &&
           b.lo.z <= a.hi.z;
}

/// Whether `value`, a sum of up to four products and an offset, may be zero or more: each term errs by at most 2 e of
/// its coefficient, e of the product and 4 e of the sums, 7 e (1 + e) of `magnitude` in all, itself rounded by as much.
GN_FN GN_BOOL gn_may_be_inside(GN_FLOAT value, GN_FLOAT magnitude) {
    GN_PRECISE GN_FLOAT bound = -5.9604644775390625e-7 * magnitude - 7.52316384526264e-37;  // 10 e
    return !(value < bound);
}

/// Half-space and box, by the corner that lies farthest inside. The magnitude is of the corner that lies farthest out:
/// so a larger box is never rejected where one inside it is not, rounding included.
GN_FN GN_BOOL gn_touches_plane_box(GN_IN(GnPlane) plane, GN_IN(GN_TYPE(GnBox)) box) {
    GN_FLOAT x = plane.normal.x >= 0.0f ? box.hi.x : box.lo.x;
    GN_FLOAT y = plane.normal.y >= 0.0f ? box.hi.y : box.lo.y;
    GN_FLOAT z = plane.normal.z >= 0.0f ? box.hi.z : box.lo.z;
    GN_FLOAT far_x = gn_max(abs(box.lo.x), abs(box.hi.x));
    GN_FLOAT far_y = gn_max(abs(box.lo.y), abs(box.hi.y));
    GN_FLOAT far_z = gn_max(abs(box.lo.z), abs(box.hi.z));
    GN_PRECISE GN_FLOAT value = (x * plane.normal.x + y * plane.normal.y) + (z * plane.normal.z + plane.offset);
    GN_PRECISE GN_FLOAT magnitude = (far_x * plane.magnitude.x + far_y * plane.magnitude.y) +
                                    (far_z * plane.magnitude.z + abs(plane.offset));
    return gn_may_be_inside(value, magnitude);
}

/// Half-space and sphere.
GN_FN GN_BOOL gn_touches_plane_sphere(GN_IN(GnPlane) plane, GN_IN(GN_TYPE(GnSphere)) s) {
    GN_VEC3 c = s.center;
    GN_PRECISE GN_FLOAT reach = s.radius * plane.norm;
    GN_PRECISE GN_FLOAT value =
        ((c.x * plane.normal.x + c.y * plane.normal.y) + (c.z * plane.normal.z + plane.offset)) + reach;
    GN_PRECISE GN_FLOAT magnitude = ((abs(c.x) * plane.magnitude.x + abs(c.y) * plane.magnitude.y) +
                                     (abs(c.z) * plane.magnitude.z + abs(plane.offset))) + reach;
    return gn_may_be_inside(value, magnitude) && s.radius >= 0.0;
}

GN_END

#endif  // GNOMON_MATH_FORMULA_TOUCH_GLSL
