// Lights against the rows of a grid of clusters, as both backends assign them: what lights::is_sound, lights::may_touch and
// the light tree say of points, spots and directional lights, in one text. Boxes are the CPU's alone.
//
// A tree of the lights' balls finds candidates; the predicate of cull's rows decides.

#ifndef GNOMON_LIGHTS_FORMULA_ASSIGN_GLSL
#define GNOMON_LIGHTS_FORMULA_ASSIGN_GLSL

#include <gnomon/cull/formula/spot_rows.glsl>
#include <gnomon/math/formula/touch.glsl>

GN_BEGIN

// lights::Light, in a storage buffer. Kinds: 0 point, 1 spot, 2 directional, 3 box.
struct GnLight {
    vec3 center;
    float range_m;
    vec3 axis;
    float cos_half;
    vec3 side;
    float sin_half;
    vec3 other;
    uint kind;
    uint layers;
    float importance;
    uint user_a;
    uint user_b;
};

/// Whether a ball takes part: coordinates and radius of at most 2^60, a radius above 0.
GN_FN GN_BOOL gn_is_sound_ball(GN_VEC3 center, GN_FLOAT radius) {
    return abs(center.x) <= 1152921504606846976.0 && abs(center.y) <= 1152921504606846976.0 &&
           abs(center.z) <= 1152921504606846976.0 && radius > 0.0 && radius <= 1152921504606846976.0;
}

/// Whether a spot's axis and angle are ones: a length from 2^-20 to 2^30, a cosine and a sine.
GN_FN GN_BOOL gn_is_sound_cone(GN_VEC3 axis, GN_FLOAT cosine, GN_FLOAT sine) {
    GN_PRECISE GN_FLOAT axis_sq = axis.x * axis.x + axis.y * axis.y + axis.z * axis.z;
    GN_PRECISE GN_FLOAT unit_sq = cosine * cosine + sine * sine;
    return axis_sq >= 9.094947017729282e-13 && axis_sq <= 1152921504606846976.0 && abs(cosine) <= 1.0 && sine >= 0.0 &&
           sine <= 1.0 && unit_sq >= 0.5;
}

/// Whether a light is culled as a spot; wider ones are balls.
GN_PLAIN_FN bool gn_is_narrow_spot(GN_IN(GnLight) light) {
    GN_PRECISE float narrowest = 0.015625f * light.sin_half;
    return light.kind == 1u && light.cos_half >= narrowest;
}

/// The predicate: the span of x / depth (of x) that a sound point, spot or directional light may cover of a row.
GN_FN GN_TYPE(GnSpan) gn_light_span(GN_IN(GnLight) light, GN_IN(GN_TYPE(GnRow)) row, bool perspective) {
    GN_TYPE(GnSpan) everything;
    everything.low = GN_FLOAT(-gn_far());
    everything.high = GN_FLOAT(gn_far());
    if (light.kind == 2u) return everything;
    GN_TYPE(GnReadyBall) ball = gn_ready_ball(GN_VEC3(light.center), GN_FLOAT(light.range_m), perspective);
    if (!gn_is_narrow_spot(light)) return gn_ball_row(ball, row, perspective);
    GN_TYPE(GnReadySpot) spot =
        gn_ready_spot(ball, GN_VEC3(light.axis), GN_FLOAT(light.cos_half), GN_FLOAT(light.sin_half), perspective);
    return gn_spot_row(spot, row, perspective);
}

/// A border between columns or rows, at the nearer or the farther end of a slice.
GN_FN GN_FLOAT gn_border_at(GN_FLOAT border, GN_FLOAT scale) {
    GN_PRECISE GN_FLOAT at = border * scale;
    return gn_max(gn_min(at, GN_FLOAT(4611686018427387904.0)), GN_FLOAT(-4611686018427387904.0));
}

/// The box around one cluster of a row, up to rounding; of open borders and slices up to 2^62.
GN_FN GN_TYPE(GnBox) gn_cluster_box(GN_IN(GN_TYPE(GnRow)) row, GN_FLOAT left, GN_FLOAT right, bool perspective) {
    GN_FLOAT far = gn_min(row.far.depth, GN_FLOAT(4611686018427387904.0));
    GN_FLOAT near_scale = perspective ? row.near.depth : GN_FLOAT(1.0);
    GN_FLOAT far_scale = perspective ? far : GN_FLOAT(1.0);
    GN_TYPE(GnBox) box;
    box.lo = GN_VEC3(gn_min(gn_border_at(left, near_scale), gn_border_at(left, far_scale)),
                     gn_min(gn_border_at(row.top.y, near_scale), gn_border_at(row.top.y, far_scale)), row.near.depth);
    box.hi = GN_VEC3(gn_max(gn_border_at(right, near_scale), gn_border_at(right, far_scale)),
                     gn_max(gn_border_at(row.bottom.y, near_scale), gn_border_at(row.bottom.y, far_scale)), far);
    return box;
}

/// Whether an element of the tree may hold a light that the predicate assigns to a cluster.
///
/// The predicate accepts a light only where the light's ball, moved by what rounding is worth, reaches the cluster: with
/// M the largest coordinate of the ball's box, whose radius it is not above, the ball is widened by 2^-19 of at most 4 M,
/// and a point where a ray merely touches it moves by the root of 2 M times that, M 2^-8. The box is taken wider by twice
/// as much; boxes that hold it are widened by no less. Rounding here is 2^-22 of the coordinates.
GN_FN GN_BOOL gn_may_hold(GN_IN(GN_TYPE(GnBox)) cluster, GN_IN(GN_TYPE(GnBox)) element) {
    GN_FLOAT x = gn_max(abs(element.lo.x), abs(element.hi.x));
    GN_FLOAT y = gn_max(abs(element.lo.y), abs(element.hi.y));
    GN_FLOAT z = gn_max(abs(element.lo.z), abs(element.hi.z));
    GN_PRECISE GN_FLOAT margin = gn_max(x, gn_max(y, z)) * 7.8125e-3;
    GN_PRECISE GN_FLOAT low_x = element.lo.x - margin;
    GN_PRECISE GN_FLOAT low_y = element.lo.y - margin;
    GN_PRECISE GN_FLOAT low_z = element.lo.z - margin;
    GN_PRECISE GN_FLOAT high_x = element.hi.x + margin;
    GN_PRECISE GN_FLOAT high_y = element.hi.y + margin;
    GN_PRECISE GN_FLOAT high_z = element.hi.z + margin;
    return low_x <= cluster.hi.x && low_y <= cluster.hi.y && low_z <= cluster.hi.z && high_x >= cluster.lo.x &&
           high_y >= cluster.lo.y && high_z >= cluster.lo.z;
}

GN_END

#endif  // GNOMON_LIGHTS_FORMULA_ASSIGN_GLSL
