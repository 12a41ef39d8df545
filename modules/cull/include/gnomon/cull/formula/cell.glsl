// A cluster as a convex body: how far it reaches in a direction, which of its points is near another, and whether a
// sphere, a cone or a box may touch it. For one cluster or for lanes of them; the borders may lie at infinity.
//
// The method of math's separate.glsl: alternating projections look for the two nearest points, and a pair counts as apart
// only where the direction between them leaves a gap beyond all rounding. Nothing that touches is ever rejected; what
// does not touch is kept only where the projections have not come near enough in their few steps.

#ifndef GNOMON_CULL_FORMULA_CELL_GLSL
#define GNOMON_CULL_FORMULA_CELL_GLSL

#include <gnomon/math/formula.glsl>
#include <gnomon/math/formula/separate.glsl>

GN_BEGIN

/// depth in [near, far], x in [left, right] times depth, y in [top, bottom] times depth; where the view is orthographic,
/// without the factor depth. Whether it is, is the same for all lanes: an argument of every function.
GN_STRUCT(GnCell) {
    GN_FLOAT left;
    GN_FLOAT right;
    GN_FLOAT top;
    GN_FLOAT bottom;
    GN_FLOAT near;
    GN_FLOAT far;
};

/// max(n times [lo, hi]), and 0 for n = 0 though a border lie at infinity.
GN_FN GN_FLOAT gn_reach_between(GN_FLOAT n, GN_FLOAT lo, GN_FLOAT hi) {
    GN_PRECISE GN_FLOAT up = n * hi;
    GN_PRECISE GN_FLOAT down = n * lo;
    return GN_SELECT(n > 0.0, up, GN_SELECT(n < 0.0, down, GN_FLOAT(0.0)));
}

/// Perspective: depth times s with s = n_d + reach of x + reach of y, which errs by 3 e of the three's magnitudes; s is
/// raised by 8 e of them, so that its sign is right, and the far plane counts only if s may be positive. Then the
/// product's e is all that is left: no far cluster's error grows with its far plane.
/// Orthographic: three products, two sums.
GN_FN GN_TYPE(GnReach) gn_reach_of_cell(GN_IN(GN_TYPE(GnCell)) c, GN_VEC3 n, bool perspective) {
    GN_FLOAT x = gn_reach_between(n.x, c.left, c.right);
    GN_FLOAT y = gn_reach_between(n.y, c.top, c.bottom);
    GN_TYPE(GnReach) r;
    if (perspective) {
        GN_PRECISE GN_FLOAT sum = (n.z + x) + y;
        GN_PRECISE GN_FLOAT raised = sum + 4.76837158203125e-7 * ((abs(n.z) + abs(x)) + abs(y));
        GN_PRECISE GN_FLOAT value = raised * GN_SELECT(raised < 0.0, c.near, c.far);
        r.value = value;
        r.magnitude = abs(value);
    } else {
        GN_FLOAT z = gn_reach_between(n.z, c.near, c.far);
        GN_PRECISE GN_FLOAT value = (z + x) + y;
        GN_PRECISE GN_FLOAT magnitude = (abs(z) + abs(x)) + abs(y);
        r.value = value;
        r.magnitude = magnitude;
    }
    return r;
}

/// The border that a point is beyond at a depth, or 0 where it is between them.
GN_FN GN_FLOAT gn_border_beyond(GN_FLOAT p, GN_FLOAT lo, GN_FLOAT hi, GN_FLOAT depth) {
    GN_PRECISE GN_FLOAT low = lo * depth;
    GN_PRECISE GN_FLOAT high = hi * depth;
    return GN_SELECT(low > p, lo, GN_SELECT(high < p, hi, GN_FLOAT(0.0)));
}

/// Newton's method over the depth: with the borders that p is beyond held fast, the nearest depth is a quotient. The
/// squared distance is convex and piecewise quadratic in the depth, so that three steps nearly always end at its least.
GN_FN GN_VEC3 gn_nearest_of_cell(GN_IN(GN_TYPE(GnCell)) c, GN_VEC3 p, bool perspective) {
    GN_FLOAT depth = gn_clamped(p.z, c.near, c.far);
    if (!perspective)
        return GN_VEC3(gn_clamped(p.x, c.left, c.right), gn_clamped(p.y, c.top, c.bottom), depth);
    for (int i = 0; i < 3; ++i) {
        GN_FLOAT x = gn_border_beyond(p.x, c.left, c.right, depth);
        GN_FLOAT y = gn_border_beyond(p.y, c.top, c.bottom, depth);
        GN_PRECISE GN_FLOAT up = (p.z + x * p.x) + y * p.y;
        GN_PRECISE GN_FLOAT down = (1.0 + x * x) + y * y;
        depth = gn_clamped(gn_div(up, down), c.near, c.far);
    }
    GN_PRECISE GN_FLOAT left = c.left * depth;
    GN_PRECISE GN_FLOAT right = c.right * depth;
    GN_PRECISE GN_FLOAT top = c.top * depth;
    GN_PRECISE GN_FLOAT bottom = c.bottom * depth;
    return GN_VEC3(gn_clamped(p.x, left, right), gn_clamped(p.y, top, bottom), depth);
}

/// Sphere: the direction to the centre from the nearest point is the best there is.
GN_FN GN_BOOL gn_touches_sphere_cell(GN_IN(GN_TYPE(GnSphere)) s, GN_IN(GN_TYPE(GnCell)) c, bool perspective) {
    GN_PRECISE GN_VEC3 difference = s.center - gn_nearest_of_cell(c, s.center, perspective);
    GN_VEC3 n = gn_direction(difference);
    GN_BOOL apart = gn_is_gap(gn_reach_of_cell(c, n, perspective), gn_reach_of_sphere(s, -n));
    return !apart && s.radius >= 0.0 && gn_is_finite(s.radius) && gn_is_finite3(s.center);
}

GN_FN GN_BOOL gn_gap_of_sector_cell(GN_IN(GN_TYPE(GnSector)) s, GN_IN(GN_TYPE(GnCell)) c, GN_VEC3 difference, bool perspective) {
    GN_VEC3 n = gn_direction(difference);
    return gn_is_gap(gn_reach_of_cell(c, n, perspective), gn_reach_of_sector(s, -n));
}

/// Cone, by `steps` alternating projections: 2 keep few of those apart, 3 hardly any (see the README's figures).
GN_FN GN_BOOL gn_touches_sector_cell(GN_IN(GN_TYPE(GnSector)) s, GN_IN(GN_TYPE(GnCell)) c, bool perspective, int steps) {
    GN_VEC3 b = gn_nearest_of_cell(c, s.apex, perspective);
    GN_PRECISE GN_VEC3 first = s.apex - b;
    GN_BOOL apart = gn_gap_of_sector_cell(s, c, first, perspective);
    for (int i = 0; i < steps; ++i) {
        if (!GN_ANY(!apart)) return false;
        GN_VEC3 a = gn_nearest_of_sector(s, b);
        GN_PRECISE GN_VEC3 forth = a - b;
        apart = apart || gn_gap_of_sector_cell(s, c, forth, perspective);
        b = gn_nearest_of_cell(c, a, perspective);
        GN_PRECISE GN_VEC3 back = a - b;
        apart = apart || gn_gap_of_sector_cell(s, c, back, perspective);
    }
    return !apart && s.range >= 0.0;
}

GN_FN GN_BOOL gn_gap_of_crate_cell(GN_IN(GN_TYPE(GnCrate)) s, GN_IN(GN_TYPE(GnCell)) c, GN_VEC3 difference, bool perspective) {
    GN_VEC3 n = gn_direction(difference);
    return gn_is_gap(gn_reach_of_cell(c, n, perspective), gn_reach_of_crate(s, -n));
}

/// A box of any orientation.
GN_FN GN_BOOL gn_touches_crate_cell(GN_IN(GN_TYPE(GnCrate)) s, GN_IN(GN_TYPE(GnCell)) c, bool perspective) {
    GN_VEC3 b = gn_nearest_of_cell(c, s.center, perspective);
    GN_BOOL apart = false;
    for (int i = 0; i < 4; ++i) {
        if (!GN_ANY(!apart)) return false;
        GN_VEC3 a = gn_nearest_of_crate(s, b);
        GN_PRECISE GN_VEC3 forth = a - b;
        apart = apart || gn_gap_of_crate_cell(s, c, forth, perspective);
        b = gn_nearest_of_cell(c, a, perspective);
        GN_PRECISE GN_VEC3 back = a - b;
        apart = apart || gn_gap_of_crate_cell(s, c, back, perspective);
    }
    return !apart && gn_is_finite_crate(s);
}

GN_FN GN_BOOL gn_gap_of_box_cell(GN_IN(GN_TYPE(GnBox)) box, GN_IN(GN_TYPE(GnCell)) c, GN_VEC3 difference, bool perspective) {
    GN_VEC3 n = gn_direction(difference);
    return gn_is_gap(gn_reach_of_cell(c, n, perspective), gn_reach_of_box(box, -n));
}

/// A box along the axes of the view.
GN_FN GN_BOOL gn_touches_box_cell(GN_IN(GN_TYPE(GnBox)) box, GN_IN(GN_TYPE(GnCell)) c, bool perspective) {
    GN_PRECISE GN_VEC3 middle = (box.lo + box.hi) * 0.5;
    GN_VEC3 b = gn_nearest_of_cell(c, middle, perspective);
    GN_BOOL apart = false;
    for (int i = 0; i < 3; ++i) {
        if (!GN_ANY(!apart)) return false;
        GN_VEC3 a = gn_nearest_of_box(box, b);
        GN_PRECISE GN_VEC3 forth = a - b;
        apart = apart || gn_gap_of_box_cell(box, c, forth, perspective);
        b = gn_nearest_of_cell(c, a, perspective);
        GN_PRECISE GN_VEC3 back = a - b;
        apart = apart || gn_gap_of_box_cell(box, c, back, perspective);
    }
    return !apart && !gn_is_empty(box) && gn_is_finite3(box.lo) && gn_is_finite3(box.hi);
}

GN_END

#endif  // GNOMON_CULL_FORMULA_CELL_GLSL
