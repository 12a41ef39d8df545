// A ball against a grid of clusters, row by row: per slice and row of the grid the interval of x / depth that it covers.
// ball.glsl says how, and why nothing is missed.

#ifndef GNOMON_CULL_FORMULA_ROWS_GLSL
#define GNOMON_CULL_FORMULA_ROWS_GLSL

#include <gnomon/cull/formula/ball.glsl>

GN_BEGIN

/// What a plane between slices leaves of the ball: the square of its disc's radius (below 0: the plane passes by), and
/// the cap's corner on it.
GN_STRUCT(GnPlaneCut) {
    GN_TYPE(GnSlicePlane) plane;
    GN_FLOAT rest;
    GN_TYPE(GnSpan) cap;
};

/// The ends of the ball on a line parallel to x, `off` from the centre within a plane of depth.
GN_FN GN_TYPE(GnSpan) gn_corner(GN_FLOAT x, GN_FLOAT off, GN_FLOAT rest, GN_FLOAT inverse) {
    GN_PRECISE GN_FLOAT left = rest - off * off;
    GN_FLOAT s = gn_sqrt(gn_max(left, GN_FLOAT(0.0)));
    GN_PRECISE GN_FLOAT low = (x - s) * inverse;
    GN_PRECISE GN_FLOAT high = (x + s) * inverse;
    GN_TYPE(GnSpan) c;
    c.low = GN_SELECT(left >= 0.0, low, GN_FLOAT(gn_far()));
    c.high = GN_SELECT(left >= 0.0, high, GN_FLOAT(-gn_far()));
    return c;
}

GN_FN GN_TYPE(GnPlaneCut) gn_plane_cut(GN_IN(GN_TYPE(GnBall)) ball, GN_IN(GN_TYPE(GnSlicePlane)) plane) {
    GN_PRECISE GN_FLOAT off = plane.depth - ball.center.z;
    GN_PRECISE GN_FLOAT rest = ball.radius_sq - off * off;
    GN_TYPE(GnPlaneCut) c;
    c.plane = plane;
    c.rest = rest;
    c.cap = gn_corner(ball.center.x, GN_FLOAT(0.0), rest, plane.inverse);
    return c;
}

/// Whether the ball reaches between two planes.
GN_FN GN_BOOL gn_in_slice(GN_IN(GN_TYPE(GnBall)) ball, GN_IN(GN_TYPE(GnPlaneCut)) near, GN_IN(GN_TYPE(GnPlaneCut)) far) {
    return near.rest >= 0.0 || far.rest >= 0.0 ||
           (near.plane.depth <= ball.center.z && ball.center.z <= far.plane.depth);
}

/// Whether the ball's own bounds reach between two borders.
GN_FN GN_BOOL gn_in_row(GN_IN(GN_TYPE(GnReadyBall)) ready, GN_FLOAT top, GN_FLOAT bottom) {
    return bottom >= ready.y.low && top <= ready.y.high;
}

GN_FN GN_TYPE(GnSpan) gn_border_corner(GN_IN(GN_TYPE(GnBall)) ball, GN_IN(GN_TYPE(GnRowBorder)) border,
                                       GN_IN(GN_TYPE(GnPlaneCut)) cut) {
    GN_PRECISE GN_FLOAT off = border.y * cut.plane.scale - ball.center.y;
    return gn_corner(ball.center.x, off, cut.rest, cut.plane.inverse);
}

/// Where the ends of an arc's span are within a slice: on the near plane, on the far plane, or (neither) its own.
GN_STRUCT(GnEnds) {
    GN_BOOL low_near;
    GN_BOOL low_far;
    GN_BOOL high_near;
    GN_BOOL high_far;
};

GN_FN GN_TYPE(GnEnds) gn_ends(GN_IN(GN_TYPE(GnArc)) arc, GN_IN(GN_TYPE(GnPlaneCut)) near, GN_IN(GN_TYPE(GnPlaneCut)) far) {
    GN_PRECISE GN_FLOAT near_at = near.plane.depth * arc.unit;
    GN_PRECISE GN_FLOAT far_at = far.plane.depth * arc.unit;
    GN_TYPE(GnEnds) e;
    e.low_near = near.rest >= 0.0 && arc.low_at <= near_at;
    e.low_far = far.rest >= 0.0 && arc.low_at >= far_at;
    e.high_near = near.rest >= 0.0 && arc.high_at <= near_at;
    e.high_far = far.rest >= 0.0 && arc.high_at >= far_at;
    return e;
}

/// What the ball covers of a plane through the eye within a slice: the arc's ends, or the corners where those are beyond.
GN_FN GN_TYPE(GnSpan) gn_within(GN_IN(GN_TYPE(GnArc)) arc, GN_IN(GN_TYPE(GnEnds)) ends, GN_IN(GN_TYPE(GnSpan)) near_corner,
                                GN_IN(GN_TYPE(GnSpan)) far_corner) {
    GN_BOOL any = arc.rest >= 0.0;
    GN_FLOAT low = GN_SELECT(any, arc.span.low, GN_FLOAT(gn_far()));
    GN_FLOAT high = GN_SELECT(any, arc.span.high, GN_FLOAT(-gn_far()));
    GN_TYPE(GnSpan) s;
    s.low = GN_SELECT(ends.low_near, near_corner.low, GN_SELECT(ends.low_far, far_corner.low, low));
    s.high = GN_SELECT(ends.high_near, near_corner.high, GN_SELECT(ends.high_far, far_corner.high, high));
    return s;
}

GN_FN GN_TYPE(GnSpan) gn_border_span(GN_IN(GN_TYPE(GnBall)) ball, GN_IN(GN_TYPE(GnRowBorder)) border,
                                     GN_IN(GN_TYPE(GnArc)) arc, GN_IN(GN_TYPE(GnPlaneCut)) near,
                                     GN_IN(GN_TYPE(GnPlaneCut)) far) {
    return gn_within(arc, gn_ends(arc, near, far), gn_border_corner(ball, border, near), gn_border_corner(ball, border, far));
}

/// The cap within a slice: its ends, and the scales of their depths.
GN_STRUCT(GnCap) {
    GN_TYPE(GnSpan) span;
    GN_FLOAT low_scale;
    GN_FLOAT high_scale;
};

GN_FN GN_TYPE(GnCap) gn_slice_cap(GN_IN(GN_TYPE(GnReadyBall)) ready, GN_IN(GN_TYPE(GnPlaneCut)) near,
                                  GN_IN(GN_TYPE(GnPlaneCut)) far) {
    GN_TYPE(GnEnds) ends = gn_ends(ready.cap, near, far);
    GN_TYPE(GnCap) c;
    c.span = gn_within(ready.cap, ends, near.cap, far.cap);
    c.low_scale = GN_SELECT(ends.low_near, near.plane.scale, GN_SELECT(ends.low_far, far.plane.scale, ready.cap_low_scale));
    c.high_scale = GN_SELECT(ends.high_near, near.plane.scale, GN_SELECT(ends.high_far, far.plane.scale, ready.cap_high_scale));
    return c;
}

/// Whether a point (y, scale) lies on or below a border.
GN_FN GN_BOOL gn_below(GN_FLOAT border_y, GN_FLOAT scale, GN_FLOAT y) {
    GN_PRECISE GN_FLOAT at = border_y * scale;
    return at <= y;
}

/// Joins what the ball covers of a row's two borders with the cap's ends, where they lie in the row.
GN_FN GN_TYPE(GnSpan) gn_joined(GN_IN(GN_TYPE(GnSpan)) top, GN_IN(GN_TYPE(GnSpan)) bottom, GN_IN(GN_TYPE(GnSpan)) cap,
                                GN_BOOL low_inside, GN_BOOL high_inside) {
    GN_FLOAT low = gn_min(top.low, bottom.low);
    GN_FLOAT high = gn_max(top.high, bottom.high);
    GN_TYPE(GnSpan) s;
    s.low = GN_SELECT(low_inside, gn_min(low, cap.low), low);
    s.high = GN_SELECT(high_inside, gn_max(high, cap.high), high);
    return s;
}

/// Whether a span touches a column: the predicate's last word. An empty span touches none.
GN_FN GN_BOOL gn_touches(GN_IN(GN_TYPE(GnSpan)) span, GN_FLOAT left, GN_FLOAT right) {
    return left <= span.high && right >= span.low && span.low <= span.high;
}

/// A row of one slice: between two borders, between two planes.
GN_STRUCT(GnRow) {
    GN_TYPE(GnRowBorder) top;
    GN_TYPE(GnRowBorder) bottom;
    GN_TYPE(GnSlicePlane) near;
    GN_TYPE(GnSlicePlane) far;
};

/// The interval of x / depth (of x, in an orthographic view) that the ball covers of a row.
GN_FN GN_TYPE(GnSpan) gn_ball_row(GN_IN(GN_TYPE(GnReadyBall)) ready, GN_IN(GN_TYPE(GnRow)) row, bool perspective) {
    GN_TYPE(GnPlaneCut) near = gn_plane_cut(ready.ball, row.near);
    GN_TYPE(GnPlaneCut) far = gn_plane_cut(ready.ball, row.far);
    GN_TYPE(GnArc) top_arc = gn_border_arc(ready.ball, row.top, perspective);
    GN_TYPE(GnArc) bottom_arc = gn_border_arc(ready.ball, row.bottom, perspective);
    GN_TYPE(GnSpan) top = gn_border_span(ready.ball, row.top, top_arc, near, far);
    GN_TYPE(GnSpan) bottom = gn_border_span(ready.ball, row.bottom, bottom_arc, near, far);
    GN_TYPE(GnCap) cap = gn_slice_cap(ready, near, far);
    GN_FLOAT y = ready.ball.center.y;
    GN_BOOL low_inside = gn_below(row.top.y, cap.low_scale, y) && !gn_below(row.bottom.y, cap.low_scale, y);
    GN_BOOL high_inside = gn_below(row.top.y, cap.high_scale, y) && !gn_below(row.bottom.y, cap.high_scale, y);
    GN_TYPE(GnSpan) s = gn_joined(top, bottom, cap.span, low_inside, high_inside);
    s.low = gn_max(s.low, ready.x.low);
    s.high = gn_min(s.high, ready.x.high);
    GN_BOOL reached = gn_in_slice(ready.ball, near, far) && gn_in_row(ready, row.top.y, row.bottom.y);
    s.low = GN_SELECT(reached, s.low, GN_FLOAT(gn_far()));
    s.high = GN_SELECT(reached, s.high, GN_FLOAT(-gn_far()));
    return s;
}

GN_END

#endif  // GNOMON_CULL_FORMULA_ROWS_GLSL
