#version 450
#extension GL_GOOGLE_include_directive : require
// Item i is written counts[i] times from its offset on, as far as the list reaches.
#include "gnomon/backend/item.glsl"
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Counts { uint counts[]; };
layout(std430, set = 0, binding = 1) readonly buffer Offsets { uint offsets[]; };
layout(std430, set = 0, binding = 2) writeonly buffer List { uint list[]; };
layout(push_constant) uniform FillCall { uint count; uint capacity; } call;
void main() {
    uint i = GNOMON_ITEM;
    if (i >= call.count) return;
    uint first = offsets[i];
    if (first >= call.capacity) return;
    uint times = min(counts[i], call.capacity - first);
    for (uint k = 0u; k < times; ++k) list[first + k] = i;
}
