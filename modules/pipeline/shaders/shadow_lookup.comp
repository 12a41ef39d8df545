// How much light arrives at each sample, as the shadow maps see it: the GLSL half of `shadow_lookup`. kernels.hpp has
// the layout.

#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require

#include <gnomon/math/formula/bits.glsl>
#include <gnomon/projection/formula/cube.glsl>
#include <gnomon/shadow/formula/map.glsl>

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer Samples { uvec4 samples[]; };  // triangle, position
layout(std430, set = 0, binding = 1) readonly buffer Normals { float normals[]; };
layout(std430, set = 0, binding = 2) readonly buffer Reached { uint reached[]; };
layout(std430, set = 0, binding = 3) readonly buffer Maps { GnShadowMap maps[]; };
layout(std430, set = 0, binding = 4) writeonly buffer Visibility { float visibility[]; };
layout(std430, set = 0, binding = 5) writeonly buffer BiasM { float bias_m[]; };
layout(set = 0, binding = 6) uniform texture2DArray depths;

layout(push_constant) uniform Constants {
    uint count;
    uint map_count;
    uint unorm16;
    float light_x, light_y, light_z;
    GnShadowConfig config;
} c;

/// A 16-bit texel comes as a float that may be off by its last bits: the code is exact.
float stored_depth(int layer, int x, int y) {
    float texel = texelFetch(depths, ivec3(x, y, layer), 0).x;
    return c.unorm16 != 0u ? gn_depth_of_unorm16(texel) : texel;
}

#define GN_TEXELS int
#define GN_TEXEL(layer, x, y) stored_depth(layer, x, y)

#include <gnomon/shadow/formula/lookup.glsl>

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= c.count) return;
    GnLookup seen = GnLookup(0.0, 0.0);
    if ((reached[i >> 2] >> ((i & 3u) * 8u) & 0xFFu) != 0u) {
        vec3 position = uintBitsToFloat(samples[i].yzw);
        vec3 normal = vec3(normals[3u * i], normals[3u * i + 1u], normals[3u * i + 2u]);
        precise vec3 way = position - vec3(c.light_x, c.light_y, c.light_z);
        uint map = c.map_count == 1u ? 0u : gn_face_of(way);
        seen = gn_look_up(maps[map], int(map), position, normal, c.config);
    }
    visibility[i] = seen.visibility;
    bias_m[i] = seen.bias_m;
}
