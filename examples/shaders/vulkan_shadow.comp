#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
// The program's own shader: looks down on a floor of 10 m, and asks Gnomon how much of the sun arrives at each pixel.

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2DArray shadow_map;

// What the lookup reads: here one layer of an image. An atlas, a page table, anything else would do.
#define GN_TEXELS int
#define GN_TEXEL(layer, column, row) texelFetch(shadow_map, ivec3(column, row, layer), 0).x
#include <gnomon/shadow/formula/lookup.glsl>

layout(std430, set = 0, binding = 1) readonly buffer Light { GnShadowMap map; GnShadowConfig config; } light;
layout(std430, set = 0, binding = 2) writeonly buffer Picture { float visibility[]; } picture;

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    uvec2 size = gl_NumWorkGroups.xy * gl_WorkGroupSize.xy;
    vec2 on_floor = (vec2(pixel) + 0.5) / vec2(size) * 10.0 - 5.0;
    GnLookup seen = gn_look_up(light.map, 0, vec3(on_floor.x, 0.0, on_floor.y), vec3(0.0, 1.0, 0.0), light.config);
    picture.visibility[pixel.y * size.x + pixel.x] = seen.visibility;
}
