// A ball against a grid of clusters: what it leaves on the planes of the grid. rows.glsl puts a row together of that.
//
// Culling space: x right, y down, depth in front of the eye. A row (the clusters of one slice and one row) is the
// region { near <= depth <= far, top depth <= y <= bottom depth }. Ball and region are convex, so what the ball covers
// of the row is an interval of x / depth, and its ends are those of the best of a few points:
//
//     arc     on a border y = Y depth the ball leaves a disc; the line through the eye that touches it there
//     corner  where that point lies beyond the slice, the ball's end on the line { y = Y depth, depth = D }
//     cap     inside the row: the same two on the plane y = centre.y, which counts in the one row that holds the point
//
// Arcs belong to a border, corners to a border and a plane of depth, so neighbouring rows share them: a row costs less
// than one root. Orthographic views: the same with y = Y, and x instead of x / depth.
//
// Nothing is missed. Let e = 2^-24. Every number here has a rounding error of at most 12 e (|x| + |y| + |depth| + r) for
// window borders up to 8 in size, seen as a shift of the point it belongs to; gn_ball_of makes the radius larger by 32
// such units. A point p that touches the true ball, moved along its own ray from the eye by no more than that, stays in
// the larger one and keeps its x / depth and y / depth; so whichever depth rounding chose for the touching point, the
// larger ball has a point at least as far out there. Where the touching point's depth is ill-conditioned (the eye near
// the ball's surface, a disc of almost no size) its error grows as the root of e, but there the ray leaves the ball only
// with the square of the shift, and the root of 2 r (r' - r) covers it. A row chosen wrongly for the cap is one whose
// border passes as near as that; the arc or corner on it stands in.

#ifndef GNOMON_CULL_FORMULA_BALL_GLSL
#define GNOMON_CULL_FORMULA_BALL_GLSL

#include <gnomon/math/formula.glsl>

GN_BEGIN

/// Larger than every x / depth, y / depth and depth that is compared; an interval from this to its negative is empty.
GN_PLAIN_FN float gn_far() { return 3.4028234663852886e38f; }

/// A border between rows. `secant` = sqrt(1 + y^2) and `cosine` = 1 / secant; both 1 in an orthographic view.
GN_STRUCT(GnRowBorder) {
    GN_FLOAT y;
    GN_FLOAT secant;
    GN_FLOAT cosine;
};

/// A border between slices. `scale`: what tangents are multiplied with, the depth or 1; `inverse` = 1 / scale.
GN_STRUCT(GnSlicePlane) {
    GN_FLOAT depth;
    GN_FLOAT scale;
    GN_FLOAT inverse;
};

GN_STRUCT(GnSpan) {
    GN_FLOAT low;
    GN_FLOAT high;
};

/// `radius` is the widened one. `tangent`: the length of a ray from the eye to where it touches the ball; 0 inside.
GN_STRUCT(GnBall) {
    GN_VEC3 center;
    GN_FLOAT radius;
    GN_FLOAT radius_sq;
    GN_FLOAT tangent;
};

/// What a plane that holds a line parallel to x leaves of the ball: the ends of the span of x / depth, and where they
/// are: an end's depth is `at / unit`, without a division. `rest` < 0: nothing.
GN_STRUCT(GnArc) {
    GN_TYPE(GnSpan) span;
    GN_FLOAT low_at;
    GN_FLOAT high_at;
    GN_FLOAT unit;
    GN_FLOAT rest;
};

GN_FN GN_TYPE(GnBall) gn_ball_of(GN_VEC3 center, GN_FLOAT radius) {
    GN_PRECISE GN_FLOAT size = abs(center.x) + abs(center.y) + abs(center.z) + radius;
    GN_PRECISE GN_FLOAT wide = radius + size * 1.9073486328125e-6;  // 32 e
    GN_PRECISE GN_FLOAT wide_sq = wide * wide;
    GN_PRECISE GN_FLOAT rest = center.x * center.x + center.y * center.y + center.z * center.z - wide_sq;
    GN_TYPE(GnBall) b;
    b.center = center;
    b.radius = wide;
    b.radius_sq = wide_sq;
    b.tangent = gn_sqrt(gn_max(rest, GN_FLOAT(0.0)));
    return b;
}

/// The disc of radius sqrt(rest) about (x, w) in a plane through the eye, w along the plane's own depth axis, which
/// leans from depth by the border's angle.
GN_FN GN_TYPE(GnArc) gn_arc_of(GN_FLOAT x, GN_FLOAT w, GN_FLOAT rest, GN_FLOAT tangent, GN_IN(GN_TYPE(GnRowBorder)) border) {
    GN_FLOAT rho = gn_sqrt(gn_max(rest, GN_FLOAT(0.0)));
    GN_PRECISE GN_FLOAT along = tangent * w;
    GN_PRECISE GN_FLOAT across = rho * x;
    GN_PRECISE GN_FLOAT side = tangent * x;
    GN_PRECISE GN_FLOAT lift = rho * w;
    GN_PRECISE GN_FLOAT high_w = along - across;
    GN_PRECISE GN_FLOAT low_w = along + across;
    GN_PRECISE GN_FLOAT high_x = side + lift;
    GN_PRECISE GN_FLOAT low_x = side - lift;
    GN_PRECISE GN_FLOAT short_tangent = tangent * border.cosine;
    GN_PRECISE GN_TYPE(GnArc) a;
    a.span.high = gn_div(high_x, high_w) * border.secant;
    a.span.low = gn_div(low_x, low_w) * border.secant;
    a.high_at = short_tangent * high_w;
    a.low_at = short_tangent * low_w;
    a.unit = tangent * tangent + rho * rho;
    a.rest = rest;
    return a;
}

/// In an orthographic view: the disc about (x, depth).
GN_FN GN_TYPE(GnArc) gn_flat_arc_of(GN_FLOAT x, GN_FLOAT depth, GN_FLOAT rest) {
    GN_FLOAT rho = gn_sqrt(gn_max(rest, GN_FLOAT(0.0)));
    GN_PRECISE GN_TYPE(GnArc) a;
    a.span.high = x + rho;
    a.span.low = x - rho;
    a.high_at = depth;
    a.low_at = depth;
    a.unit = GN_FLOAT(1.0);
    a.rest = rest;
    return a;
}

/// The arc on a border between rows.
GN_FN GN_TYPE(GnArc) gn_border_arc(GN_IN(GN_TYPE(GnBall)) ball, GN_IN(GN_TYPE(GnRowBorder)) border, bool perspective) {
    GN_FLOAT x = ball.center.x;
    GN_FLOAT y = ball.center.y;
    GN_FLOAT depth = ball.center.z;
    if (!perspective) {
        GN_PRECISE GN_FLOAT off = y - border.y;
        GN_PRECISE GN_FLOAT rest = ball.radius_sq - off * off;
        return gn_flat_arc_of(x, depth, rest);
    }
    GN_PRECISE GN_FLOAT off = (y - border.y * depth) * border.cosine;
    GN_PRECISE GN_FLOAT rest = ball.radius_sq - off * off;
    GN_PRECISE GN_FLOAT w = (y * border.y + depth) * border.cosine;
    return gn_arc_of(x, w, rest, ball.tangent, border);
}

/// The cap's arc: on the plane y = centre.y.
GN_FN GN_TYPE(GnArc) gn_cap_arc(GN_IN(GN_TYPE(GnBall)) ball, bool perspective) {
    GN_FLOAT x = ball.center.x;
    GN_FLOAT depth = ball.center.z;
    if (!perspective) return gn_flat_arc_of(x, depth, ball.radius_sq);
    GN_PRECISE GN_FLOAT rest = x * x + depth * depth - ball.radius_sq;
    GN_TYPE(GnRowBorder) level;
    level.y = GN_FLOAT(0.0);
    level.secant = GN_FLOAT(1.0);
    level.cosine = GN_FLOAT(1.0);
    return gn_arc_of(x, depth, ball.radius_sq, gn_sqrt(gn_max(rest, GN_FLOAT(0.0))), level);
}

/// The tables' rows, made once a grid.
GN_FN GN_TYPE(GnRowBorder) gn_row_border(GN_FLOAT y, bool perspective) {
    GN_PRECISE GN_FLOAT square = 1.0 + y * y;
    GN_TYPE(GnRowBorder) b;
    b.y = y;
    b.secant = GN_SELECT(GN_BOOL(perspective) && abs(y) <= gn_far(), gn_sqrt(square), GN_FLOAT(1.0));  // an open border has no arc
    b.cosine = gn_div(GN_FLOAT(1.0), b.secant);
    return b;
}

GN_FN GN_TYPE(GnSlicePlane) gn_slice_plane(GN_FLOAT depth, bool perspective) {
    GN_TYPE(GnSlicePlane) p;
    p.depth = depth;
    p.scale = perspective ? depth : GN_FLOAT(1.0);
    p.inverse = gn_div(GN_FLOAT(1.0), p.scale);
    return p;
}

/// A ball, ready for rows: its cap's arc, with the scales (see GnSlicePlane) of the depths of the arc's ends, and the
/// bounds of the whole ball.
GN_STRUCT(GnReadyBall) {
    GN_TYPE(GnBall) ball;
    GN_TYPE(GnArc) cap;
    GN_FLOAT cap_low_scale;
    GN_FLOAT cap_high_scale;
    GN_TYPE(GnSpan) x;
    GN_TYPE(GnSpan) y;
};

/// expects: coordinates of at most 2^60 in size, a radius above 0.
GN_FN GN_TYPE(GnReadyBall) gn_ready_ball(GN_VEC3 center, GN_FLOAT radius, bool perspective) {
    GN_TYPE(GnReadyBall) r;
    r.ball = gn_ball_of(center, radius);
    r.cap = gn_cap_arc(r.ball, perspective);
    r.x = r.cap.span;
    r.cap_low_scale = GN_FLOAT(1.0);
    r.cap_high_scale = GN_FLOAT(1.0);
    GN_PRECISE GN_FLOAT above = center.y - r.ball.radius;
    GN_PRECISE GN_FLOAT below = center.y + r.ball.radius;
    r.y.low = above;
    r.y.high = below;
    if (perspective) {
        r.cap_low_scale = gn_div(r.cap.low_at, r.cap.unit);
        r.cap_high_scale = gn_div(r.cap.high_at, r.cap.unit);
        GN_TYPE(GnBall) turned = r.ball;  // y in the place of x
        turned.center.x = center.y;
        r.y = gn_cap_arc(turned, true).span;
        // Bounds only where the ball stands clear in front of the eye: elsewhere its rays have no ends.
        GN_PRECISE GN_FLOAT clear = 1.125 * r.ball.radius;
        GN_BOOL bounded = center.z > clear;
        r.x.low = GN_SELECT(bounded, r.x.low, GN_FLOAT(-gn_far()));
        r.x.high = GN_SELECT(bounded, r.x.high, GN_FLOAT(gn_far()));
        r.y.low = GN_SELECT(bounded, r.y.low, GN_FLOAT(-gn_far()));
        r.y.high = GN_SELECT(bounded, r.y.high, GN_FLOAT(gn_far()));
    }
    return r;
}

GN_END

#endif  // GNOMON_CULL_FORMULA_BALL_GLSL
