// How much light arrives at each sample, as the cascades see it: the GLSL half of `cascade_lookup`.
// cascade_lookup.hpp has the layout.

#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require

#include <gnomon/math/formula/bits.glsl>
#include <gnomon/cascade/formula/select.glsl>
#include <gnomon/shadow/formula/map.glsl>

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer Samples { uvec4 samples[]; };  // triangle, position
layout(std430, set = 0, binding = 1) readonly buffer Normals { float normals[]; };
layout(std430, set = 0, binding = 2) readonly buffer Reached { uint reached[]; };
layout(std430, set = 0, binding = 3) readonly buffer Maps { GnShadowMap maps[]; };
layout(std430, set = 0, binding = 4) writeonly buffer Visibility { float visibility[]; };
layout(std430, set = 0, binding = 5) writeonly buffer BiasM { float bias_m[]; };
layout(std430, set = 0, binding = 6) readonly buffer Depths { GnCascadeDepths cascades; };
layout(set = 0, binding = 7) uniform texture2DArray depths;

layout(push_constant) uniform Constants {
    uint count;
    uint unorm16;
    float eye_x, eye_y, eye_z;
    float sight_x, sight_y, sight_z;
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
    precise float lit = 0.0;
    precise float bias = 0.0;
    if ((reached[i >> 2] >> ((i & 3u) * 8u) & 0xFFu) != 0u) {
        vec3 position = uintBitsToFloat(samples[i].yzw);
        vec3 normal = vec3(normals[3u * i], normals[3u * i + 1u], normals[3u * i + 2u]);
        precise vec3 way = position - vec3(c.eye_x, c.eye_y, c.eye_z);
        precise float depth_m = (way.x * c.sight_x + way.y * c.sight_y) + way.z * c.sight_z;
        GnCascadeChoice chosen = gn_cascade_by_depth(cascades, depth_m);
        if (chosen.cascade == cascades.count) {
            lit = 1.0;
        } else {
            GnLookup first = gn_look_up(maps[chosen.cascade], int(chosen.cascade), position, normal, c.config);
            precise float weight = 1.0 - chosen.blend;
            lit = weight * first.visibility;
            bias = weight * first.bias_m;
            if (chosen.blend > 0.0 && chosen.next < cascades.count) {
                GnLookup second = gn_look_up(maps[chosen.next], int(chosen.next), position, normal, c.config);
                lit = lit + chosen.blend * second.visibility;
                bias = bias + chosen.blend * second.bias_m;
            }
        }
    }
    visibility[i] = lit;
    bias_m[i] = bias;
}
