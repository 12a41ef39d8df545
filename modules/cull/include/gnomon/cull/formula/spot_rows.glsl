// The rows of a spot: see spot.glsl.

#ifndef GNOMON_CULL_FORMULA_SPOT_ROWS_GLSL
#define GNOMON_CULL_FORMULA_SPOT_ROWS_GLSL

#include <gnomon/cull/formula/spot.glsl>

GN_BEGIN

/// Four directions: right, down, left, up.
GN_STRUCT(GnReadySpot) {
    GN_TYPE(GnReadyBall) ready;  // with the spot's own bounds
    GN_TYPE(GnCone) cone;
    GN_TYPE(GnOutline) outline;
    GN_TYPE(GnSide) side[4];
};

/// expects: as gn_ready_ball and gn_cone_of; a cosine of at least 2^-6 of the sine (wider cones: the ball alone).
GN_FN GN_TYPE(GnReadySpot) gn_ready_spot(GN_IN(GN_TYPE(GnReadyBall)) ball, GN_VEC3 axis, GN_FLOAT cosine, GN_FLOAT sine,
                                         bool perspective) {
    GN_TYPE(GnReadySpot) s;
    s.ready = ball;
    s.cone = gn_cone_of(ball.ball, axis, cosine, sine);
    s.outline = gn_outline_of(ball.ball, s.cone, perspective);
    s.side[0] = gn_side_of(ball.ball, s.cone, ball.ball.center.x, s.cone.axis.x, perspective);
    s.side[1] = gn_side_of(ball.ball, s.cone, ball.ball.center.y, s.cone.axis.y, perspective);
    s.side[2] = gn_side_of(ball.ball, s.cone, -ball.ball.center.x, -s.cone.axis.x, perspective);
    s.side[3] = gn_side_of(ball.ball, s.cone, -ball.ball.center.y, -s.cone.axis.y, perspective);
    GN_PRECISE GN_FLOAT left = -s.side[2].bound;
    GN_PRECISE GN_FLOAT top = -s.side[3].bound;
    s.ready.x.low = gn_max(s.ready.x.low, left);
    s.ready.x.high = gn_min(s.ready.x.high, s.side[0].bound);
    s.ready.y.low = gn_max(s.ready.y.low, top);
    s.ready.y.high = gn_min(s.ready.y.high, s.side[1].bound);
    return s;
}

/// Whether the spot's bounds of depth reach between two planes.
GN_FN GN_BOOL gn_in_depth(GN_IN(GN_TYPE(GnCone)) cone, GN_FLOAT near, GN_FLOAT far) {
    return near <= cone.depth.high && far >= cone.depth.low;
}

/// g / depth on a plane, and whether it falls from there on.
GN_STRUCT(GnSideCut) {
    GN_FLOAT end;
    GN_BOOL crosses;
    GN_BOOL falls;
};

GN_FN GN_TYPE(GnSideCut) gn_side_cut(GN_IN(GN_TYPE(GnBall)) ball, GN_IN(GN_TYPE(GnCone)) cone, GN_IN(GN_TYPE(GnSide)) side,
                                     GN_IN(GN_TYPE(GnPlaneCut)) cut, bool perspective) {
    GN_FLOAT depth = cut.plane.depth;
    GN_FLOAT s = gn_sqrt(gn_max(cut.rest, GN_FLOAT(0.0)));
    GN_PRECISE GN_FLOAT z = depth - ball.center.z;
    GN_PRECISE GN_FLOAT disc = side.middle + s;
    GN_PRECISE GN_FLOAT disc_fall = perspective ? disc * s + z * depth : z;
    GN_PRECISE GN_FLOAT first = side.middle + (cone.slack - side.first.slope * z) * side.first.inverse;
    GN_PRECISE GN_FLOAT second = side.middle + (cone.slack - side.second.slope * z) * side.second.inverse;
    GN_FLOAT first_fall = perspective ? side.first.at_eye : side.first.slope;
    GN_FLOAT second_fall = perspective ? side.second.at_eye : side.second.slope;
    GN_PRECISE GN_FLOAT end = disc + cone.slack;
    GN_FLOAT fall = disc_fall;
    GN_BOOL by_first = side.first.inverse > 0.0 && first < end;
    end = GN_SELECT(by_first, first, end);
    fall = GN_SELECT(by_first, first_fall, fall);
    GN_BOOL by_second = side.second.inverse > 0.0 && second < end;
    end = GN_SELECT(by_second, second, end);
    fall = GN_SELECT(by_second, second_fall, fall);
    GN_PRECISE GN_TYPE(GnSideCut) c;
    c.end = end * cut.plane.inverse;
    c.crosses = cut.rest >= 0.0 && gn_in_depth(cone, depth, depth);
    c.falls = fall >= 0.0;
    return c;
}

/// The end of one direction within a slice.
GN_FN GN_FLOAT gn_side_within(GN_FLOAT bound, GN_IN(GN_TYPE(GnSideCut)) near, GN_IN(GN_TYPE(GnSideCut)) far) {
    GN_FLOAT t = GN_SELECT(far.crosses && !far.falls, gn_min(bound, far.end), bound);
    return GN_SELECT(near.crosses && near.falls, gn_min(bound, near.end), t);
}

/// A row's span cut by what the four directions leave. `t`: the ends of the directions within the slice.
GN_STRUCT(GnSides) {
    GN_FLOAT t[4];
};

GN_FN GN_TYPE(GnSpan) gn_cut_by_sides(GN_IN(GN_TYPE(GnSpan)) span, GN_IN(GN_TYPE(GnSides)) sides, GN_FLOAT top, GN_FLOAT bottom) {
    GN_PRECISE GN_FLOAT left = -sides.t[2];
    GN_PRECISE GN_FLOAT up = -sides.t[3];
    GN_TYPE(GnSpan) s;
    s.high = gn_min(span.high, sides.t[0]);
    s.low = gn_max(span.low, left);
    GN_BOOL inside = top <= sides.t[1] && bottom >= up;
    s.high = GN_SELECT(inside, s.high, GN_FLOAT(-gn_far()));
    s.low = GN_SELECT(inside, s.low, GN_FLOAT(gn_far()));
    return s;
}

/// The interval of x / depth (of x) that a spot may cover of a row.
GN_FN GN_TYPE(GnSpan) gn_spot_row(GN_IN(GN_TYPE(GnReadySpot)) spot, GN_IN(GN_TYPE(GnRow)) row, bool perspective) {
    GN_TYPE(GnSpan) s = gn_ball_row(spot.ready, row, perspective);
    GN_TYPE(GnPlaneCut) near = gn_plane_cut(spot.ready.ball, row.near);
    GN_TYPE(GnPlaneCut) far = gn_plane_cut(spot.ready.ball, row.far);
    GN_TYPE(GnSides) sides;
    for (int i = 0; i < 4; ++i) {
        GN_TYPE(GnSideCut) on_near = gn_side_cut(spot.ready.ball, spot.cone, spot.side[i], near, perspective);
        GN_TYPE(GnSideCut) on_far = gn_side_cut(spot.ready.ball, spot.cone, spot.side[i], far, perspective);
        sides.t[i] = gn_side_within(spot.side[i].bound, on_near, on_far);
    }
    s = gn_cut_by_sides(s, sides, row.top.y, row.bottom.y);
    s = gn_cut_by_line(s, spot.outline.first, row.top.y, row.bottom.y, row.near.inverse);
    s = gn_cut_by_line(s, spot.outline.second, row.top.y, row.bottom.y, row.near.inverse);
    GN_BOOL reached = gn_in_depth(spot.cone, row.near.depth, row.far.depth);
    s.low = GN_SELECT(reached, s.low, GN_FLOAT(gn_far()));
    s.high = GN_SELECT(reached, s.high, GN_FLOAT(-gn_far()));
    return s;
}

GN_END

#endif  // GNOMON_CULL_FORMULA_SPOT_ROWS_GLSL
