// Items in the tree's order, an array for each number: the GLSL half of `tree_leaves`.

#version 450
#extension GL_GOOGLE_include_directive : require

#include "device_state.glsl"
#include "gnomon/backend/item.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer Items { vec4 items[]; };
layout(std430, set = 0, binding = 1) readonly buffer Sorted { uvec2 sorted[]; };
layout(std430, set = 0, binding = 2) readonly buffer State { DeviceState state; };
layout(std430, set = 0, binding = 3) writeonly buffer TreeItems { float tree_items[]; };
layout(std430, set = 0, binding = 4) writeonly buffer Ids { uint ids[]; };

void main() {
    uint slot = GNOMON_ITEM;
    uint slots = state.item_slots;
    if (slot >= slots) return;
    vec4 item = vec4(0.0, 0.0, 0.0, -1.0);
    if (slot < state.usable) {
        uint id = sorted[slot].y;
        item = items[id];
        ids[slot] = id;
    }
    for (uint k = 0u; k < 4u; ++k) tree_items[k * slots + slot] = item[k];
}
