#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
// A colour of triangle, pixel, a buffer and a constant; with `visible`, of the triangle that the target holds alone.
#include <gnomon/backend/fragment.glsl>
layout(std430, set = 1, binding = 0) readonly buffer Tints { vec4 tints[]; };
layout(set = 1, binding = 1) uniform utexture2DArray ids;
layout(push_constant) uniform Constants { layout(offset = 64) uint visible; float scale; } c;
void main() {
    if (c.visible != 0u && texelFetch(ids, ivec3(gn_pixel, 0), 0).x != gn_triangle) discard;
    vec4 tint = tints[gn_triangle % 8u];
    gn_color = vec4(tint.x * c.scale, float(gn_pixel.x), float(gn_pixel.y) + tint.y, tint.w);
}
