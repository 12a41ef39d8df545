// Convex shapes that are told apart by a plane: each says how far it reaches in a direction, and which of its points is
// near another. Two shapes are apart for certain where a direction n has max(n.p) over one below min(n.p) over the other.
//
// The direction may be any: a bad one finds no gap, never a false one. e = 2^-24. A direction's largest component is
// about 1, so that no square of it underflows unless it does not matter.

#ifndef GNOMON_MATH_FORMULA_SEPARATE_GLSL
#define GNOMON_MATH_FORMULA_SEPARATE_GLSL

#include <gnomon/math/formula.glsl>
#include <gnomon/math/formula/touch.glsl>

GN_BEGIN

/// max(n.p) over a shape, at most 32 e `magnitude` too small.
GN_STRUCT(GnReach) {
    GN_FLOAT value;
    GN_FLOAT magnitude;
};

/// All points within `range` of `apex` whose direction from it is within an angle of `axis`, a unit vector to 2 e. The
/// cosine and sine are of an angle 2^-20 larger than what is meant, which covers the rounding of all three.
GN_STRUCT(GnSector) {
    GN_VEC3 apex;
    GN_FLOAT range;
    GN_VEC3 axis;
    GN_FLOAT cosine;
    GN_FLOAT sine;
};

/// All points center + a axis_x + b axis_y + c axis_z with a, b, c in [-1, 1]. The axes need not be at right angles.
GN_STRUCT(GnCrate) {
    GN_VEC3 center;
    GN_VEC3 axis_x;
    GN_VEC3 axis_y;
    GN_VEC3 axis_z;
};

GN_FN GN_BOOL gn_is_finite_crate(GN_IN(GN_TYPE(GnCrate)) c) {
    return gn_is_finite3(c.center) && gn_is_finite3(c.axis_x) && gn_is_finite3(c.axis_y) && gn_is_finite3(c.axis_z);
}

GN_FN GN_FLOAT gn_dot3(GN_VEC3 a, GN_VEC3 b) {
    GN_PRECISE GN_FLOAT sum = (a.x * b.x + a.y * b.y) + a.z * b.z;
    return sum;
}

GN_FN GN_FLOAT gn_dot3_magnitude(GN_VEC3 a, GN_VEC3 b) {
    GN_PRECISE GN_FLOAT sum = (abs(a.x * b.x) + abs(a.y * b.y)) + abs(a.z * b.z);
    return sum;
}

GN_FN GN_VEC3 gn_abs3(GN_VEC3 a) { return GN_VEC3(abs(a.x), abs(a.y), abs(a.z)); }

GN_FN GN_FLOAT gn_norm3(GN_VEC3 a) { return gn_sqrt(gn_dot3(a, a)); }

GN_FN GN_FLOAT gn_component(GN_FLOAT x) { return GN_SELECT(abs(x) < 8.67361738e-19, GN_FLOAT(0.0), x); }

/// n with its largest component about 1 in size, without components below 2^-60; not finite where n is 0 or not finite.
GN_FN GN_VEC3 gn_direction(GN_VEC3 n) {
    GN_FLOAT largest = gn_max(gn_max(abs(n.x), abs(n.y)), abs(n.z));
    GN_FLOAT k = gn_div(GN_FLOAT(1.0), largest);
    GN_PRECISE GN_VEC3 r = n * k;
    return GN_VEC3(gn_component(r.x), gn_component(r.y), gn_component(r.z));
}

/// Whether `below` (along n) and `above` (along -n) leave a gap; never where a number is none.
GN_FN GN_BOOL gn_is_gap(GN_IN(GN_TYPE(GnReach)) below, GN_IN(GN_TYPE(GnReach)) above) {
    GN_PRECISE GN_FLOAT sum = below.value + above.value;
    GN_PRECISE GN_FLOAT bound = -2.288818359375e-6 * (below.magnitude + above.magnitude) - 7.52316384526264e-37;  // 38.4 e
    return sum < bound;
}

/// Three products and two sums of what is given exactly: 4 e. The length of n errs by 4 e, times the radius 5 e.
GN_FN GN_TYPE(GnReach) gn_reach_of_sphere(GN_IN(GN_TYPE(GnSphere)) s, GN_VEC3 n) {
    GN_PRECISE GN_FLOAT ball = s.radius * gn_norm3(n);
    GN_TYPE(GnReach) r;
    GN_PRECISE GN_FLOAT value = gn_dot3(s.center, n) + ball;
    GN_PRECISE GN_FLOAT magnitude = gn_dot3_magnitude(s.center, n) + ball;
    r.value = value;
    r.magnitude = magnitude;
    return r;
}

GN_FN GN_TYPE(GnReach) gn_reach_of_box(GN_IN(GN_TYPE(GnBox)) box, GN_VEC3 n) {
    GN_VEC3 p = GN_VEC3(GN_SELECT(n.x >= 0.0, box.hi.x, box.lo.x), GN_SELECT(n.y >= 0.0, box.hi.y, box.lo.y),
                        GN_SELECT(n.z >= 0.0, box.hi.z, box.lo.z));
    GN_TYPE(GnReach) r;
    r.value = gn_dot3(p, n);
    r.magnitude = gn_dot3_magnitude(p, n);
    return r;
}

/// Each of the three reaches errs by 4 e of its own magnitude.
GN_FN GN_TYPE(GnReach) gn_reach_of_crate(GN_IN(GN_TYPE(GnCrate)) c, GN_VEC3 n) {
    GN_PRECISE GN_FLOAT half_size = (abs(gn_dot3(c.axis_x, n)) + abs(gn_dot3(c.axis_y, n))) + abs(gn_dot3(c.axis_z, n));
    GN_PRECISE GN_FLOAT half_magnitude =
        (gn_dot3_magnitude(c.axis_x, n) + gn_dot3_magnitude(c.axis_y, n)) + gn_dot3_magnitude(c.axis_z, n);
    GN_TYPE(GnReach) r;
    GN_PRECISE GN_FLOAT value = gn_dot3(c.center, n) + half_size;
    GN_PRECISE GN_FLOAT magnitude = gn_dot3_magnitude(c.center, n) + half_magnitude;
    r.value = value;
    r.magnitude = magnitude;
    return r;
}

/// max(n.u) over the unit vectors u of the sector's cone, or 0 for the apex: |n| where n lies in the cone, else
///     |n| cos(phi - theta) = cos(theta) n.axis + sin(theta) |n - (n.axis) axis|
/// The rest is taken as a vector: its length errs by 10 e |n|, where the difference of squares would lose half the digits.
GN_FN GN_FLOAT gn_reach_of_cone(GN_IN(GN_TYPE(GnSector)) s, GN_VEC3 n) {
    GN_FLOAT along = gn_dot3(n, s.axis);
    GN_PRECISE GN_VEC3 rest = n - s.axis * along;
    GN_FLOAT size = gn_norm3(n);
    GN_PRECISE GN_FLOAT border = s.cosine * size;
    GN_PRECISE GN_FLOAT beside = s.cosine * along + s.sine * gn_norm3(rest);
    return GN_SELECT(along >= border, size, gn_max(beside, GN_FLOAT(0.0)));
}

/// 16 e of |n| for the cone, which is at most 28 e of the range times n's largest component, in `magnitude` by |n|.
GN_FN GN_TYPE(GnReach) gn_reach_of_sector(GN_IN(GN_TYPE(GnSector)) s, GN_VEC3 n) {
    GN_PRECISE GN_FLOAT cap = s.range * gn_reach_of_cone(s, n);
    GN_TYPE(GnReach) r;
    GN_PRECISE GN_FLOAT value = gn_dot3(s.apex, n) + cap;
    GN_PRECISE GN_FLOAT magnitude = gn_dot3_magnitude(s.apex, n) + s.range * gn_norm3(n);
    r.value = value;
    r.magnitude = magnitude;
    return r;
}

// Points near another: only as good as they are, no bound.

GN_FN GN_FLOAT gn_clamped(GN_FLOAT x, GN_FLOAT lo, GN_FLOAT hi) { return gn_min(gn_max(x, lo), hi); }

GN_FN GN_VEC3 gn_nearest_of_box(GN_IN(GN_TYPE(GnBox)) box, GN_VEC3 p) {
    return GN_VEC3(gn_clamped(p.x, box.lo.x, box.hi.x), gn_clamped(p.y, box.lo.y, box.hi.y),
                   gn_clamped(p.z, box.lo.z, box.hi.z));
}

/// In the plane of the axis and p: p itself pulled within range, or its foot on the border of the slice of pie.
GN_FN GN_VEC3 gn_nearest_of_sector(GN_IN(GN_TYPE(GnSector)) s, GN_VEC3 p) {
    GN_PRECISE GN_VEC3 v = p - s.apex;
    GN_FLOAT along = gn_dot3(v, s.axis);
    GN_PRECISE GN_VEC3 rest = v - s.axis * along;
    GN_FLOAT beside = gn_norm3(rest);
    GN_FLOAT size = gn_norm3(v);
    GN_PRECISE GN_FLOAT border = s.cosine * size;
    GN_PRECISE GN_FLOAT foot = along * s.cosine + beside * s.sine;
    GN_FLOAT k = gn_clamped(foot, GN_FLOAT(0.0), s.range);
    GN_PRECISE GN_FLOAT aside = k * s.sine;
    GN_FLOAT per_rest = GN_SELECT(beside > 0.0, gn_div(aside, beside), GN_FLOAT(0.0));
    GN_FLOAT per_size = GN_SELECT(size > s.range, gn_div(s.range, size), GN_FLOAT(1.0));
    GN_PRECISE GN_VEC3 on_border = s.apex + (s.axis * (k * s.cosine) + rest * per_rest);
    GN_PRECISE GN_VEC3 inside = s.apex + v * per_size;
    GN_BOOL within = along >= border;
    return GN_VEC3(GN_SELECT(within, inside.x, on_border.x), GN_SELECT(within, inside.y, on_border.y),
                   GN_SELECT(within, inside.z, on_border.z));
}

/// expects: axes at right angles; else the point is only near the nearest.
GN_FN GN_VEC3 gn_nearest_of_crate(GN_IN(GN_TYPE(GnCrate)) c, GN_VEC3 p) {
    GN_PRECISE GN_VEC3 v = p - c.center;
    GN_FLOAT x = gn_clamped(gn_div(gn_dot3(v, c.axis_x), gn_max(gn_dot3(c.axis_x, c.axis_x), 1e-30)), GN_FLOAT(-1.0), GN_FLOAT(1.0));
    GN_FLOAT y = gn_clamped(gn_div(gn_dot3(v, c.axis_y), gn_max(gn_dot3(c.axis_y, c.axis_y), 1e-30)), GN_FLOAT(-1.0), GN_FLOAT(1.0));
    GN_FLOAT z = gn_clamped(gn_div(gn_dot3(v, c.axis_z), gn_max(gn_dot3(c.axis_z, c.axis_z), 1e-30)), GN_FLOAT(-1.0), GN_FLOAT(1.0));
    GN_PRECISE GN_VEC3 nearest = c.center + ((c.axis_x * x + c.axis_y * y) + c.axis_z * z);
    return nearest;
}

/// Half-space and sector: the bounds of plane and reach together stay below 40 e.
GN_FN GN_BOOL gn_touches_plane_sector(GN_IN(GnPlane) plane, GN_IN(GN_TYPE(GnSector)) s) {
    GN_TYPE(GnReach) r = gn_reach_of_sector(s, GN_VEC3(plane.normal));
    GN_PRECISE GN_FLOAT value = r.value + plane.offset;
    GN_PRECISE GN_FLOAT fourth = (gn_dot3(gn_abs3(s.apex), GN_VEC3(plane.magnitude)) + s.range * plane.norm) + abs(plane.offset);
    GN_PRECISE GN_FLOAT magnitude = fourth * 4.0;
    return gn_may_be_inside(value, magnitude) && s.range >= 0.0;
}

/// Half-space and crate.
GN_FN GN_BOOL gn_touches_plane_crate(GN_IN(GnPlane) plane, GN_IN(GN_TYPE(GnCrate)) c) {
    GN_VEC3 m = GN_VEC3(plane.magnitude);
    GN_TYPE(GnReach) r = gn_reach_of_crate(c, GN_VEC3(plane.normal));
    GN_PRECISE GN_FLOAT value = r.value + plane.offset;
    GN_PRECISE GN_FLOAT axes = (gn_dot3(gn_abs3(c.axis_x), m) + gn_dot3(gn_abs3(c.axis_y), m)) + gn_dot3(gn_abs3(c.axis_z), m);
    GN_PRECISE GN_FLOAT fourth = (gn_dot3(gn_abs3(c.center), m) + axes) + abs(plane.offset);
    GN_PRECISE GN_FLOAT magnitude = fourth * 4.0;
    return gn_may_be_inside(value, magnitude) && gn_is_finite_crate(c);
}

/// Sector and sphere, by the direction from the sector's nearest point.
GN_FN GN_BOOL gn_touches_sector_sphere(GN_IN(GN_TYPE(GnSector)) s, GN_IN(GN_TYPE(GnSphere)) ball) {
    GN_PRECISE GN_VEC3 difference = gn_nearest_of_sector(s, ball.center) - ball.center;
    GN_VEC3 n = gn_direction(difference);
    return !gn_is_gap(gn_reach_of_sphere(ball, n), gn_reach_of_sector(s, -n)) && s.range >= 0.0 && ball.radius >= 0.0;
}

GN_FN GN_BOOL gn_gap_of_sector_box(GN_IN(GN_TYPE(GnSector)) s, GN_IN(GN_TYPE(GnBox)) box, GN_VEC3 of_sector, GN_VEC3 of_box) {
    GN_PRECISE GN_VEC3 difference = of_sector - of_box;
    GN_VEC3 n = gn_direction(difference);
    return gn_is_gap(gn_reach_of_box(box, n), gn_reach_of_sector(s, -n));
}

/// Sector and box, by the directions between the nearest points that alternating projections find.
GN_FN GN_BOOL gn_touches_sector_box(GN_IN(GN_TYPE(GnSector)) s, GN_IN(GN_TYPE(GnBox)) box) {
    GN_VEC3 b = gn_nearest_of_box(box, s.apex);
    GN_BOOL apart = gn_gap_of_sector_box(s, box, s.apex, b);
    for (int i = 0; i < 3; ++i) {
        if (!GN_ANY(!apart)) return false;
        GN_VEC3 a = gn_nearest_of_sector(s, b);
        apart = apart || gn_gap_of_sector_box(s, box, a, b);
        b = gn_nearest_of_box(box, a);
        apart = apart || gn_gap_of_sector_box(s, box, a, b);
    }
    return !apart && s.range >= 0.0;
}

GN_FN GN_BOOL gn_gap_of_crate_box(GN_IN(GN_TYPE(GnCrate)) c, GN_IN(GN_TYPE(GnBox)) box, GN_VEC3 difference) {
    GN_VEC3 n = gn_direction(difference);
    return gn_is_gap(gn_reach_of_box(box, n), gn_reach_of_crate(c, -n));
}

/// Crate and box: as sector and box.
GN_FN GN_BOOL gn_touches_crate_box(GN_IN(GN_TYPE(GnCrate)) c, GN_IN(GN_TYPE(GnBox)) box) {
    GN_VEC3 b = gn_nearest_of_box(box, c.center);
    GN_BOOL apart = false;
    for (int i = 0; i < 4; ++i) {
        if (!GN_ANY(!apart)) return false;
        GN_VEC3 a = gn_nearest_of_crate(c, b);
        GN_PRECISE GN_VEC3 forth = a - b;
        apart = apart || gn_gap_of_crate_box(c, box, forth);
        b = gn_nearest_of_box(box, a);
        GN_PRECISE GN_VEC3 back = a - b;
        apart = apart || gn_gap_of_crate_box(c, box, back);
    }
    return !apart && gn_is_finite_crate(c);
}

GN_END

#endif  // GNOMON_MATH_FORMULA_SEPARATE_GLSL
