// The box of each cluster's samples, as places of floats in their order: the GLSL half of `bound_clusters`.

#version 450
#extension GL_GOOGLE_include_directive : require

#include <gnomon/math/formula/bits.glsl>
#include <gnomon/math/formula/touch.glsl>

#include "gnomon/backend/item.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer Samples { uvec4 samples[]; };
layout(std430, set = 0, binding = 1) readonly buffer Index { uint index_of[]; };
layout(std430, set = 0, binding = 2) buffer Places { int places[]; };

#define GN_WORDS uint
#define GN_WORD(words, i) 0u
#include <gnomon/cluster/formula/grid.glsl>

layout(push_constant) uniform Constants {
    uint count;
    float eye_x, eye_y, eye_z;
    float right_x, right_y, right_z;
    float down_x, down_y, down_z;
    float forward_x, forward_y, forward_z;
} c;

const uint run_items = 16u;

void main() {
    uint first = GNOMON_ITEM * run_items;
    int box[6] = int[6](0, 0, 0, 0, 0, 0);
    uint last_cluster = 0xFFFFFFFFu;
    for (uint k = 0u; k <= run_items; ++k) {
        uint i = first + k;
        uint cluster = k < run_items && i < c.count ? index_of[i] : 0xFFFFFFFFu;
        if (cluster != last_cluster && last_cluster != 0xFFFFFFFFu)
            for (uint side = 0u; side < 6u; ++side) atomicMin(places[6u * last_cluster + side], box[side]);
        if (cluster != last_cluster)
            for (uint side = 0u; side < 6u; ++side) box[side] = 0x7FFFFFFF;
        last_cluster = cluster;
        if (cluster == 0xFFFFFFFFu) continue;
        precise vec3 offset = uintBitsToFloat(samples[i].yzw) - vec3(c.eye_x, c.eye_y, c.eye_z);
        vec3 at = vec3(gn_along(offset, vec3(c.right_x, c.right_y, c.right_z)), gn_along(offset, vec3(c.down_x, c.down_y, c.down_z)),
                       gn_along(offset, vec3(c.forward_x, c.forward_y, c.forward_z)));
        if (!gn_is_finite3(at)) continue;
        for (uint axis = 0u; axis < 3u; ++axis) {
            int place = gn_ordinal(at[axis]);
            box[axis] = min(box[axis], place);
            box[axis + 3u] = min(box[axis + 3u], -place);
        }
    }
}
