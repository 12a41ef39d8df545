// How many clusters each word of bits holds, for the scan, which leaves their sum after the last: the GLSL half of `rank_clusters`.

#version 450
#extension GL_GOOGLE_include_directive : require

#include "gnomon/backend/item.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer Bits { uint bits[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Ranks { uint ranks[]; };
layout(push_constant) uniform Constants { uint words; } c;

void main() {
    uint i = GNOMON_ITEM;
    if (i > c.words) return;
    ranks[i] = i < c.words ? uint(bitCount(bits[i])) : 0u;
}
