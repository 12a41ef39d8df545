#version 450
#extension GL_GOOGLE_include_directive : require
// Of sorted pairs: where each bin begins, and the items as far as the list reaches.
#include "gnomon/backend/item.glsl"
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Pairs { uvec2 pairs[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Begins { uint begins[]; };
layout(std430, set = 0, binding = 2) writeonly buffer List { uint list[]; };
layout(push_constant) uniform BinLists { uint count; uint bins; uint capacity; } lists;

// The first pair whose bin is not below this one.
uint begin_of(uint bin) {
    uint low = 0u;
    uint high = lists.count;
    while (low < high) {
        uint middle = low + (high - low) / 2u;
        if (pairs[middle].x < bin) low = middle + 1u;
        else high = middle;
    }
    return low;
}

void main() {
    uint i = GNOMON_ITEM;
    if (i <= lists.bins) begins[i] = begin_of(i);
    if (i < min(lists.count, lists.capacity) && pairs[i].x < lists.bins) list[i] = pairs[i].y;
}
