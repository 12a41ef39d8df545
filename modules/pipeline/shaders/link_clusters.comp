// Each sample's place among the unique clusters: the GLSL half of `link_clusters`.

#version 450
#extension GL_GOOGLE_include_directive : require

#include "cluster_layout.glsl"
#include "gnomon/backend/item.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer Keys { uint keys[]; };
layout(std430, set = 0, binding = 1) readonly buffer Bits { uint bits[]; };
layout(std430, set = 0, binding = 2) readonly buffer Ranks { uint ranks[]; };
layout(std430, set = 0, binding = 3) writeonly buffer Index { uint index_of[]; };

void main() {
    uint i = GNOMON_ITEM;
    if (i >= c.count) return;
    uint key = keys[i];
    uint place = 0xFFFFFFFFu;
    if (holds(key)) {
        uint number = number_of(key);
        uint below = bits[number >> 5] & ((1u << (number & 31u)) - 1u);
        place = ranks[number >> 5] + uint(bitCount(below));
    }
    index_of[i] = place;
}
