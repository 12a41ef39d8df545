// The keys of the bits that are set, ascending: the GLSL half of `store_clusters`.

#version 450
#extension GL_GOOGLE_include_directive : require

#include "cluster_layout.glsl"
#include "device_state.glsl"
#include "gnomon/backend/item.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer Bits { uint bits[]; };
layout(std430, set = 0, binding = 1) readonly buffer Ranks { uint ranks[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Unique { uint unique_keys[]; };
layout(std430, set = 0, binding = 3) buffer State { DeviceState state; };

void main() {
    uint i = GNOMON_ITEM;  // a word of bits
    if (i >= c.count) return;
    if (i == 0u) state.clusters = ranks[c.count];
    uint at = ranks[i];
    for (uint left = bits[i]; left != 0u; left &= left - 1u) unique_keys[at++] = key_of(i * 32u + uint(findLSB(left)));
}
