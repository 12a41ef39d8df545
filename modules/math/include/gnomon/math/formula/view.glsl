// A point in a view's image: clip coordinates, pixels, and depth as a line or as its reciprocal.
//
// Clip space is Vulkan's: depth in [0, 1], y down; pixel (0, 0) is top left with its centre at (0.5, 0.5).

#ifndef GNOMON_MATH_FORMULA_VIEW_GLSL
#define GNOMON_MATH_FORMULA_VIEW_GLSL

#include <gnomon/math/formula.glsl>

GN_BEGIN

/// Depth at `distance` along the axis of sight, by the view's depth line; see math::depth_line.
GN_FN GN_FLOAT gn_depth_from_distance(GN_FLOAT scale, GN_FLOAT offset, bool perspective, GN_FLOAT distance) {
    GN_PRECISE GN_FLOAT part = perspective ? gn_div(offset, distance) : scale * distance;
    GN_PRECISE GN_FLOAT depth = part + (perspective ? scale : offset);
    return depth;
}

/// The distance that has `depth`; infinite at an infinite far plane.
GN_FN GN_FLOAT gn_distance_from_depth(GN_FLOAT scale, GN_FLOAT offset, bool perspective, GN_FLOAT depth) {
    GN_PRECISE GN_FLOAT part = depth - (perspective ? scale : offset);
    return perspective ? gn_div(offset, part) : gn_div(part, scale);
}

GN_FN GN_FLOAT gn_dot(GN_VEC3 a, GN_VEC3 b) {
    GN_PRECISE GN_FLOAT r = a.x * b.x + a.y * b.y + a.z * b.z;
    return r;
}

/// Clip coordinates of a position relative to the eye, summed in pairs: of what a lookup asks about.
GN_FN GN_VEC4 gn_clip_of(GN_IN(mat4) m, GN_VEC3 p) {
    GN_PRECISE GN_VEC4 clip;
    clip.x = (m[0].x * p.x + m[1].x * p.y) + (m[2].x * p.z + m[3].x);
    clip.y = (m[0].y * p.x + m[1].y * p.y) + (m[2].y * p.z + m[3].y);
    clip.z = (m[0].z * p.x + m[1].z * p.y) + (m[2].z * p.z + m[3].z);
    clip.w = (m[0].w * p.x + m[1].w * p.y) + (m[2].w * p.z + m[3].w);
    return clip;
}

/// The same, summed from left to right: of a triangle's corner, as every pass transforms it.
GN_FN GN_VEC4 gn_clip_of_corner(GN_IN(mat4) m, GN_VEC3 p) {
    GN_PRECISE GN_VEC4 clip;
    clip.x = ((m[0].x * p.x + m[1].x * p.y) + m[2].x * p.z) + m[3].x;
    clip.y = ((m[0].y * p.x + m[1].y * p.y) + m[2].y * p.z) + m[3].y;
    clip.z = ((m[0].z * p.x + m[1].z * p.y) + m[2].z * p.z) + m[3].z;
    clip.w = ((m[0].w * p.x + m[1].w * p.y) + m[2].w * p.z) + m[3].w;
    return clip;
}

GN_STRUCT(GnImagePoint) {
    GN_VEC2 px;      // y down, a pixel's centre at +0.5
    GN_FLOAT depth;  // not clamped
};

/// Where clip coordinates lie in an image of `size_px`.
///
/// expects: clip.w above 0, and 1 where the view is no `perspective`.
GN_FN GN_TYPE(GnImagePoint) gn_image_point(GN_VEC4 clip, vec2 size_px, bool perspective) {
    GN_FLOAT inverse_w = perspective ? gn_div(1.0, clip.w) : GN_FLOAT(1.0);
    GN_PRECISE GN_TYPE(GnImagePoint) at;
    at.px.x = (clip.x * inverse_w * 0.5 + 0.5) * size_px.x;
    at.px.y = (clip.y * inverse_w * 0.5 + 0.5) * size_px.y;
    at.depth = clip.z * inverse_w;
    return at;
}

GN_END

#endif  // GNOMON_MATH_FORMULA_VIEW_GLSL
