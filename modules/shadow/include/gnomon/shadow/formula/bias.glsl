// How far a receiver is moved toward the light before it is compared. Metres and texels, never raw depth.

#ifndef GNOMON_SHADOW_FORMULA_BIAS_GLSL
#define GNOMON_SHADOW_FORMULA_BIAS_GLSL

#include <gnomon/math/formula.glsl>
#include <gnomon/shadow/formula/map.glsl>
#include <gnomon/shadow/formula/receiver.glsl>

GN_BEGIN

/// How far, in texels per axis, a stored depth may belong to a point beside the one that is asked for: corners are
/// snapped to 1/256 texel (1/512 off, in the map and, by the interpolated depth, along the plane), and image points
/// round at 8 half units of the last place of the map's size in the pass and again in the lookup.
GN_PLAIN_FN float gn_misplacement_px(GN_IN(GnShadowMap) map) {
    float longest = map.size_px.x > map.size_px.y ? map.size_px.x : map.size_px.y;
    GN_PRECISE float r = 0.00390625f + 9.5367431640625e-7f * longest;  // 16 e
    return r;
}

/// shadow::filter_reach_px: from the receiver's image point to the centre of a texel that `taps` reads, per axis.
GN_PLAIN_FN float gn_filter_reach_px(int taps) {
    GN_PRECISE float r = 0.5f * float(taps < 1 ? 1 : taps);
    return r;
}

GN_FN GN_FLOAT gn_largest(GN_VEC3 v) { return gn_max(gn_max(abs(v.x), abs(v.y)), abs(v.z)); }

/// shadow::automatic_bias: what an unshadowed plane needs to stay lit in this map, in depth.
GN_FN GN_FLOAT gn_automatic_bias(GN_IN(GnShadowMap) map, GN_IN(GN_TYPE(GnReceiver)) at, GN_VEC3 position,
                                 GN_IN(GnShadowConfig) config) {
    GN_PRECISE GN_VEC3 relative = position - GN_VEC3(map.eye);
    GN_PRECISE GN_FLOAT place_m = 2.384185791015625e-7 * (gn_largest(position) + gn_largest(relative));  // 4 e
    GN_PRECISE GN_FLOAT magnitude = abs(map.depth_scale) + abs(at.depth);
    GN_PRECISE GN_FLOAT rounding =
        map.half_code + 9.5367431640625e-7 * (map.perspective != 0u ? magnitude : GN_FLOAT(1.0));
    float reach = config.receiver_plane != 0u ? 0.0f : gn_filter_reach_px(config.taps);
    GN_PRECISE GN_FLOAT beside = gn_misplacement_px(map) + gn_div(place_m, at.texel_m) + reach;
    GN_PRECISE GN_FLOAT bias =
        rounding + place_m * at.depth_per_m + (abs(at.gradient.x) + abs(at.gradient.y)) * beside;
    return bias;
}

/// shadow::bend_allowance_m: the part for surfaces that are not planes.
GN_FN GN_FLOAT gn_bend_allowance_m(GN_IN(GN_TYPE(GnReceiver)) at) {
    GN_PRECISE GN_FLOAT metres = at.texel_m * (0.5 + 0.1 * gn_min(at.tan_angle, 8.0));
    return metres;
}

/// shadow::depth_of_move: depth units for a move toward the light, never past half the way to it.
GN_FN GN_FLOAT gn_depth_of_move(GN_IN(GnShadowMap) map, GN_IN(GN_TYPE(GnReceiver)) at, GN_FLOAT metres) {
    GN_PRECISE GN_FLOAT along_axis = metres * at.depth_per_m;
    GN_FLOAT d = at.distance_m;
    GN_PRECISE GN_FLOAT half_way = 0.5 * d;
    GN_PRECISE GN_FLOAT moved = d - metres;
    GN_PRECISE GN_FLOAT above = abs(map.depth_offset) * gn_min(metres, half_way);
    GN_PRECISE GN_FLOAT below = d * gn_max(moved, half_way);
    return map.perspective != 0u ? gn_div(above, below) : along_axis;
}

GN_STRUCT(GnBias) {
    GN_FLOAT depth;
    GN_FLOAT metres;
};

/// shadow::bias_at: all of it but the normal offset.
GN_FN GN_TYPE(GnBias) gn_bias_at(GN_IN(GnShadowMap) map, GN_IN(GN_TYPE(GnReceiver)) at, GN_VEC3 position,
                                 GN_IN(GnShadowConfig) config) {
    bool automatic = config.automatic != 0u;
    GN_FLOAT unit_m = config.in_texels != 0u ? at.texel_m : GN_FLOAT(1.0);
    GN_FLOAT tangent = gn_min(at.tan_angle, config.max_tan);
    GN_PRECISE GN_FLOAT by_hand = (config.constant + config.slope * tangent) * unit_m;
    GN_PRECISE GN_FLOAT with_bend = by_hand + gn_bend_allowance_m(at);
    GN_FLOAT move = gn_depth_of_move(map, at, automatic ? with_bend : by_hand);
    GN_PRECISE GN_FLOAT with_automatic = move + gn_automatic_bias(map, at, position, config);
    GN_PRECISE GN_TYPE(GnBias) bias;
    bias.depth = automatic ? with_automatic : move;
    bias.metres = gn_div(bias.depth, at.depth_per_m) * at.per_axis;
    return bias;
}

/// shadow::offset_position: `position` moved along `normal` by the config's normal offset.
GN_FN GN_VEC3 gn_offset_position(GN_IN(GN_TYPE(GnReceiver)) at, GN_VEC3 position, GN_VEC3 normal,
                                 GN_IN(GnShadowConfig) config) {
    GN_FLOAT unit_m = config.in_texels != 0u ? at.texel_m : GN_FLOAT(1.0);
    GN_PRECISE GN_FLOAT along = config.normal_offset * unit_m * gn_sine(at.cos_angle);
    GN_PRECISE GN_VEC3 moved = position + normal * along;
    return moved;
}

GN_END

#endif  // GNOMON_SHADOW_FORMULA_BIAS_GLSL
