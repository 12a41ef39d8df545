// A spot (ball and cone of less than a right angle) against a row: the ball's span, cut by half-planes of the image.
//
// Seen from the eye, what a slice leaves of a spot is a convex region of the image, and a row is a strip of it. Lines
// that hold the region bound the row where they cross the strip: the four sides of its box, slice by slice, and the two
// silhouettes of the cone, planes through eye and apex that touch it, for all slices.
// Along one direction u of the image the spot is a shape in the plane of (u, depth). There it lies in the disc and in the
// two half-planes that touch the cone's shadow (normals n with n . axis = -sin of the half angle), so
//
//     u <= g(depth) = the least of cu + sqrt(r^2 - z^2) and the two lines,    z = depth - centre depth
//
// g is concave, so g / depth rises up to one depth and falls beyond it. Falling on the slice's near plane: its greatest
// value in the slice is the one there; rising on the far plane: that one; otherwise at most the bound t of the whole
// spot, which its ball, its rim or its apex attains.
//
// Nothing is missed: the lines stand off by `slack`, 128 e (|x| + |y| + |depth| + r) + 2^-14 r, more than what normals
// (4 e / 2^-4 of r), products and a wrongly judged fall (a shift by an error of 48 e of the coordinates, as lines steeper
// than 8 are left out) amount to. All that is left out only widens.

#ifndef GNOMON_CULL_FORMULA_SPOT_GLSL
#define GNOMON_CULL_FORMULA_SPOT_GLSL

#include <gnomon/cull/formula/rows.glsl>

GN_BEGIN

/// The line u <= middle + (slack - n_depth z) inverse, none where `inverse` is 0. `at_eye`: u on the line at depth 0.
GN_STRUCT(GnLine) {
    GN_FLOAT slope;
    GN_FLOAT inverse;
    GN_FLOAT at_eye;
};

/// One direction of the image. `bound`: of u / depth (of u) over the whole spot.
GN_STRUCT(GnSide) {
    GN_FLOAT middle;
    GN_TYPE(GnLine) first;
    GN_TYPE(GnLine) second;
    GN_FLOAT bound;
};

/// A cone about an axis of length 1, `slack` and the spot's bounds of depth.
GN_STRUCT(GnCone) {
    GN_VEC3 axis;
    GN_FLOAT cosine;
    GN_FLOAT sine;
    GN_FLOAT slack;
    GN_FLOAT smallest;  // depth from where on bounds of the whole spot are made
    GN_TYPE(GnSpan) depth;
};

/// Of a unit ball in a cone of the axis component `along`: how far it reaches that way.
GN_FN GN_FLOAT gn_cone_reach(GN_FLOAT along, GN_FLOAT cosine, GN_FLOAT sine) {
    GN_PRECISE GN_FLOAT rest = 1.0 - along * along;
    GN_PRECISE GN_FLOAT rim = along * cosine + gn_sqrt(gn_max(rest, GN_FLOAT(0.0))) * sine;
    GN_PRECISE GN_FLOAT edge = cosine - 9.765625e-4;
    return GN_SELECT(along >= edge, GN_FLOAT(1.0), gn_max(rim, GN_FLOAT(0.0)));
}

/// expects: an axis of length above 0 whose square is a float, cosine and sine not both 0.
GN_FN GN_TYPE(GnCone) gn_cone_of(GN_IN(GN_TYPE(GnBall)) ball, GN_VEC3 axis, GN_FLOAT cosine, GN_FLOAT sine) {
    GN_PRECISE GN_FLOAT axis_sq = axis.x * axis.x + axis.y * axis.y + axis.z * axis.z;
    GN_FLOAT shorten = gn_div(GN_FLOAT(1.0), gn_sqrt(axis_sq));
    GN_PRECISE GN_FLOAT unit_sq = cosine * cosine + sine * sine;
    GN_FLOAT scale = gn_div(GN_FLOAT(1.0), gn_sqrt(unit_sq));
    GN_PRECISE GN_FLOAT size = abs(ball.center.x) + abs(ball.center.y) + abs(ball.center.z) + ball.radius;
    GN_PRECISE GN_TYPE(GnCone) c;
    c.axis = axis * shorten;
    c.cosine = cosine * scale;
    c.sine = sine * scale;
    c.slack = size * 7.62939453125e-6 + ball.radius * 6.103515625e-5;
    c.smallest = size * 0.03125;
    c.depth.high = ball.center.z + ball.radius * gn_cone_reach(c.axis.z, c.cosine, c.sine) + c.slack;
    GN_PRECISE GN_FLOAT back = -c.axis.z;
    c.depth.low = ball.center.z - ball.radius * gn_cone_reach(back, c.cosine, c.sine) - c.slack;
    return c;
}

/// The half-plane with the normal (across, depth), if it bounds u from above and is not too steep.
GN_FN GN_TYPE(GnLine) gn_line_of(GN_FLOAT across, GN_FLOAT slope, GN_FLOAT middle, GN_FLOAT depth, GN_FLOAT slack) {
    GN_BOOL bounds = across >= 0.125;
    GN_FLOAT inverse = gn_div(GN_FLOAT(1.0), gn_max(across, GN_FLOAT(0.125)));
    GN_TYPE(GnLine) l;
    l.slope = slope;
    l.inverse = GN_SELECT(bounds, inverse, GN_FLOAT(0.0));
    GN_PRECISE GN_FLOAT at_eye = middle + (slack + slope * depth) * l.inverse;
    l.at_eye = at_eye;
    return l;
}

/// The bound of the whole spot: of its ball where the ball's own point lies in the cone, else of rim and apex.
GN_FN GN_FLOAT gn_spot_bound(GN_IN(GN_TYPE(GnBall)) ball, GN_IN(GN_TYPE(GnCone)) cone, GN_FLOAT middle, GN_FLOAT along) {
    GN_FLOAT depth = ball.center.z;
    GN_FLOAT r = ball.radius;
    GN_FLOAT lean = cone.axis.z;
    GN_PRECISE GN_FLOAT edge = cone.cosine - 9.765625e-4;
    GN_PRECISE GN_FLOAT inside_sq = middle * middle + depth * depth - ball.radius_sq;
    GN_FLOAT tangent = gn_sqrt(gn_max(inside_sq, GN_FLOAT(0.0)));
    GN_PRECISE GN_FLOAT rise = tangent * middle + r * depth;
    GN_PRECISE GN_FLOAT run = tangent * depth - r * middle;
    GN_FLOAT touching = gn_div(rise, run);
    GN_PRECISE GN_FLOAT facing = along - touching * lean;
    GN_PRECISE GN_FLOAT length_sq = 1.0 + touching * touching;
    GN_PRECISE GN_FLOAT wanted = edge * gn_sqrt(length_sq);
    GN_PRECISE GN_FLOAT clear = 1.125 * r;
    GN_FLOAT ball_bound = GN_SELECT(depth > clear, touching, GN_FLOAT(gn_far()));
    // The rim: the circle of radius `rim` about (rim_u, rim_depth) in the plane across the axis. Its end is t + step,
    // step^2 rim_depth^2 = rim^2 (q0 + 2 q1 step + q2 step^2).
    GN_PRECISE GN_FLOAT rim = r * cone.sine;
    GN_PRECISE GN_FLOAT rim_u = middle + r * cone.cosine * along;
    GN_PRECISE GN_FLOAT rim_depth = depth + r * cone.cosine * lean;
    GN_FLOAT t = gn_div(rim_u, rim_depth);
    GN_PRECISE GN_FLOAT tilt = along - t * lean;
    GN_PRECISE GN_FLOAT t_sq = 1.0 + t * t;
    GN_PRECISE GN_FLOAT q0 = t_sq * 1.000003814697265625 - tilt * tilt;
    GN_PRECISE GN_FLOAT q1 = t + tilt * lean;
    GN_PRECISE GN_FLOAT rim_q1 = rim * q1;
    GN_PRECISE GN_FLOAT whole = rim_depth * rim_depth;
    GN_PRECISE GN_FLOAT open = whole - rim * rim * (1.0 - lean * lean);
    GN_PRECISE GN_FLOAT root_sq = rim_q1 * rim_q1 + open * gn_max(q0, GN_FLOAT(0.0));
    GN_PRECISE GN_FLOAT step_by = rim * (rim_q1 + gn_sqrt(gn_max(root_sq, GN_FLOAT(0.0))));
    GN_PRECISE GN_FLOAT rim_end = t + gn_div(step_by, open);
    GN_PRECISE GN_FLOAT eight_slack = 8.0 * cone.slack;
    GN_PRECISE GN_FLOAT ends = gn_max(rim_end, gn_div(middle, depth)) + gn_div(eight_slack, cone.depth.low);
    GN_PRECISE GN_FLOAT least = 0.015625 * whole;
    GN_BOOL bounded = cone.depth.low > cone.smallest && open > least;
    return GN_SELECT(facing >= wanted || !bounded, ball_bound, ends);
}

/// In an orthographic view.
GN_FN GN_FLOAT gn_flat_spot_bound(GN_IN(GN_TYPE(GnBall)) ball, GN_IN(GN_TYPE(GnCone)) cone, GN_FLOAT middle, GN_FLOAT along) {
    GN_PRECISE GN_FLOAT bound = middle + ball.radius * gn_cone_reach(along, cone.cosine, cone.sine) + cone.slack;
    return bound;
}

/// A direction of the image: the centre's and the axis' parts along it.
GN_FN GN_TYPE(GnSide) gn_side_of(GN_IN(GN_TYPE(GnBall)) ball, GN_IN(GN_TYPE(GnCone)) cone, GN_FLOAT middle, GN_FLOAT along,
                                 bool perspective) {
    GN_FLOAT lean = cone.axis.z;
    GN_FLOAT sine = cone.sine;
    GN_PRECISE GN_FLOAT shadow_sq = along * along + lean * lean;
    GN_PRECISE GN_FLOAT width_sq = shadow_sq - sine * sine;
    GN_BOOL narrow = width_sq > 0.00390625 && shadow_sq > 0.0625;
    GN_FLOAT width = gn_sqrt(gn_max(width_sq, GN_FLOAT(0.0)));
    GN_FLOAT scale = gn_div(GN_FLOAT(1.0), gn_max(shadow_sq, GN_FLOAT(0.0625)));
    GN_PRECISE GN_FLOAT first = (width * lean - sine * along) * scale;
    GN_PRECISE GN_FLOAT second = (-(width * lean) - sine * along) * scale;
    GN_PRECISE GN_FLOAT first_slope = -(sine * lean + width * along) * scale;
    GN_PRECISE GN_FLOAT second_slope = (width * along - sine * lean) * scale;
    GN_TYPE(GnSide) s;
    s.middle = middle;
    s.first = gn_line_of(GN_SELECT(narrow, first, GN_FLOAT(0.0)), first_slope, middle, ball.center.z, cone.slack);
    s.second = gn_line_of(GN_SELECT(narrow, second, GN_FLOAT(0.0)), second_slope, middle, ball.center.z, cone.slack);
    s.bound = perspective ? gn_spot_bound(ball, cone, middle, along) : gn_flat_spot_bound(ball, cone, middle, along);
    return s;
}

/// A line of the image that the whole spot lies on one side of: x <= start + lean y + off / depth where `upper`, x >= ...
/// - off / depth otherwise. `lean` and `start` 0 and `off` huge: no line.
GN_STRUCT(GnSilhouette) {
    GN_BOOL upper;
    GN_FLOAT start;
    GN_FLOAT lean;
    GN_FLOAT off;
};

/// The line of a plane through the apex whose normal is (n, n depth), the spot on its negative side.
GN_FN GN_TYPE(GnSilhouette) gn_silhouette_of(GN_IN(GN_TYPE(GnBall)) ball, GN_VEC3 n, GN_BOOL there, GN_FLOAT slack,
                                             bool perspective) {
    GN_BOOL upright = there && abs(n.x) >= 0.125;
    GN_FLOAT inverse = gn_div(GN_FLOAT(1.0), GN_SELECT(upright, n.x, GN_FLOAT(1.0)));
    GN_PRECISE GN_FLOAT offset = n.x * ball.center.x + n.y * ball.center.y;
    GN_PRECISE GN_FLOAT start = perspective ? -n.z * inverse : offset * inverse;
    GN_PRECISE GN_FLOAT lean = -n.y * inverse;
    GN_PRECISE GN_FLOAT off = slack * abs(inverse);
    GN_TYPE(GnSilhouette) l;
    l.upper = n.x > 0.0;
    l.start = GN_SELECT(upright, start, GN_FLOAT(0.0));
    l.lean = GN_SELECT(upright, lean, GN_FLOAT(0.0));
    l.off = GN_SELECT(upright, off, GN_FLOAT(gn_far()));
    return l;
}

/// The normals of the two planes through eye and apex that touch the cone: n . axis = -sine, n . apex = 0.
GN_STRUCT(GnOutline) {
    GN_TYPE(GnSilhouette) first;
    GN_TYPE(GnSilhouette) second;
};

GN_FN GN_TYPE(GnOutline) gn_outline_of(GN_IN(GN_TYPE(GnBall)) ball, GN_IN(GN_TYPE(GnCone)) cone, bool perspective) {
    GN_VEC3 c = ball.center;
    GN_VEC3 a = cone.axis;
    GN_PRECISE GN_FLOAT distance_sq = c.x * c.x + c.y * c.y + c.z * c.z;
    GN_BOOL apart = distance_sq > 9.094947017729282e-13;  // 2^-40: not at the eye
    GN_FLOAT inverse = gn_div(GN_FLOAT(1.0), gn_sqrt(GN_SELECT(apart, distance_sq, GN_FLOAT(1.0))));
    GN_PRECISE GN_VEC3 sight = c * inverse;
    if (!perspective) sight = GN_VEC3(GN_FLOAT(0.0), GN_FLOAT(0.0), GN_FLOAT(1.0));
    GN_PRECISE GN_FLOAT ahead = a.x * sight.x + a.y * sight.y + a.z * sight.z;
    GN_PRECISE GN_VEC3 across = a - sight * ahead;
    GN_PRECISE GN_FLOAT across_sq = across.x * across.x + across.y * across.y + across.z * across.z;
    GN_PRECISE GN_FLOAT width_sq = across_sq - cone.sine * cone.sine;
    GN_BOOL there = apart && across_sq > 0.0625 && width_sq > 0.00390625;
    GN_FLOAT scale = gn_div(GN_FLOAT(1.0), gn_max(across_sq, GN_FLOAT(0.0625)));
    GN_PRECISE GN_FLOAT width = gn_sqrt(gn_max(width_sq, GN_FLOAT(0.0))) * scale;
    GN_PRECISE GN_FLOAT back = cone.sine * scale;
    GN_PRECISE GN_FLOAT turn_x = sight.y * a.z - sight.z * a.y;
    GN_PRECISE GN_FLOAT turn_y = sight.z * a.x - sight.x * a.z;
    GN_PRECISE GN_FLOAT turn_z = sight.x * a.y - sight.y * a.x;
    GN_VEC3 turn = GN_VEC3(turn_x, turn_y, turn_z);
    GN_PRECISE GN_VEC3 first = turn * width - across * back;
    GN_PRECISE GN_VEC3 turned = turn * width + across * back;
    GN_PRECISE GN_VEC3 second = turned * GN_FLOAT(-1.0);
    GN_TYPE(GnOutline) o;
    o.first = gn_silhouette_of(ball, first, there, cone.slack, perspective);
    o.second = gn_silhouette_of(ball, second, there, cone.slack, perspective);
    return o;
}

/// A row's span cut by one line. `inverse`: of the least scale (see GnSlicePlane) of the spot in the slice.
GN_FN GN_TYPE(GnSpan) gn_cut_by_line(GN_IN(GN_TYPE(GnSpan)) span, GN_IN(GN_TYPE(GnSilhouette)) line, GN_FLOAT top,
                                     GN_FLOAT bottom, GN_FLOAT inverse) {
    GN_PRECISE GN_FLOAT off = line.off * inverse;
    GN_PRECISE GN_FLOAT at_top = line.lean * top;
    GN_PRECISE GN_FLOAT at_bottom = line.lean * bottom;
    GN_PRECISE GN_FLOAT high = gn_max(at_top, at_bottom) + line.start + off;
    GN_PRECISE GN_FLOAT low = gn_min(at_top, at_bottom) + line.start - off;
    GN_TYPE(GnSpan) s;
    s.high = GN_SELECT(line.upper, gn_min(span.high, high), span.high);
    s.low = GN_SELECT(line.upper, span.low, gn_max(span.low, low));
    return s;
}

GN_END

#endif  // GNOMON_CULL_FORMULA_SPOT_GLSL
