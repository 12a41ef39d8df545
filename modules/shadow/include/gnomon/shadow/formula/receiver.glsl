// A receiver as the shadow map sees it: where it falls, how deep it lies, how its own plane runs through the map.

#ifndef GNOMON_SHADOW_FORMULA_RECEIVER_GLSL
#define GNOMON_SHADOW_FORMULA_RECEIVER_GLSL

#include <gnomon/math/formula.glsl>
#include <gnomon/math/formula/bits.glsl>
#include <gnomon/math/formula/view.glsl>
#include <gnomon/shadow/formula/map.glsl>

GN_BEGIN

/// See shadow::Receiver.
GN_STRUCT(GnReceiver) {
    GN_VEC2 texel;
    GN_FLOAT depth;
    GN_VEC2 gradient;
    GN_FLOAT distance_m;
    GN_FLOAT per_axis;
    GN_FLOAT texel_m;
    GN_FLOAT depth_per_m;
    GN_FLOAT cos_angle;
    GN_FLOAT tan_angle;
    GN_BOOL in_front;  // the rest means something only if set
};

/// Sine of an angle in [0, 180] degrees from its cosine.
GN_FN GN_FLOAT gn_sine(GN_FLOAT cosine) {
    GN_PRECISE GN_FLOAT square = 1.0 - cosine * cosine;
    return gn_sqrt(gn_max(0.0, square));
}

/// shadow::receiver_at: `position` and its plane in the map.
GN_FN GN_TYPE(GnReceiver) gn_receiver_at(GN_IN(GnShadowMap) map, GN_VEC3 position, GN_VEC3 normal) {
    bool perspective = map.perspective != 0u;
    GN_PRECISE GN_VEC3 relative = position - GN_VEC3(map.eye);
    GN_VEC4 clip = gn_clip_of(map.clip_from_relative, relative);
    GN_TYPE(GnImagePoint) image = gn_image_point(clip, map.size_px, perspective);

    GN_PRECISE GN_TYPE(GnReceiver) at;
    at.in_front = clip.w > 0.0;
    at.texel = image.px;
    at.depth = image.depth;
    at.distance_m = -gn_dot(GN_VEC3(map.back), relative);

    float longest = map.texel.x > map.texel.y ? map.texel.x : map.texel.y;
    GN_FLOAT reach = gn_sqrt(gn_dot(relative, relative));
    GN_FLOAT h = gn_dot(normal, relative);
    GN_FLOAT nb = gn_dot(normal, GN_VEC3(map.back));
    GN_PRECISE GN_FLOAT distance_sq = at.distance_m * at.distance_m;
    at.cos_angle = perspective ? gn_div(-h, reach) : nb;
    at.per_axis = perspective ? gn_div(reach, at.distance_m) : GN_FLOAT(1.0);
    at.texel_m = perspective ? longest * at.distance_m : GN_FLOAT(longest);
    at.depth_per_m = perspective ? gn_div(abs(map.depth_offset), distance_sq) : GN_FLOAT(abs(map.depth_scale));

    GN_FLOAT cosine = gn_max(abs(at.cos_angle), 0.001);
    at.tan_angle = gn_div(gn_sine(at.cos_angle), cosine);
    GN_FLOAT steep = gn_with_sign_of(cosine, perspective ? h : nb);
    GN_PRECISE GN_FLOAT steep_m = steep * reach;
    GN_FLOAT k = perspective ? gn_div(map.depth_offset, steep_m) : gn_div(map.depth_scale, steep);
    at.gradient.x = k * gn_dot(normal, GN_VEC3(map.right)) * map.texel.x;
    at.gradient.y = -k * gn_dot(normal, GN_VEC3(map.up)) * map.texel.y;
    return at;
}

GN_END

#endif  // GNOMON_SHADOW_FORMULA_RECEIVER_GLSL
