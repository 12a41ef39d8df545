// The boxes of one level of the tree, from the level below: the GLSL half of `tree_nodes`.

#version 450
#extension GL_GOOGLE_include_directive : require

#include <gnomon/math/formula/touch.glsl>

#include "device_state.glsl"
#include "gnomon/backend/item.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer TreeItems { float tree_items[]; };
layout(std430, set = 0, binding = 1) readonly buffer State { DeviceState state; };
layout(std430, set = 0, binding = 2) buffer Nodes { float nodes[]; };
layout(push_constant) uniform Constants { uint level; } c;

GnBox child_box(uint child) {
    if (c.level == 1u) {
        uint slots = state.item_slots;
        vec3 center = vec3(tree_items[child], tree_items[slots + child], tree_items[2u * slots + child]);
        return gn_box_of(GnSphere(center, tree_items[3u * slots + child]));
    }
    uint slots = state.node_slots;
    uint at = state.first[c.level - 1u] + child;
    return GnBox(vec3(nodes[at], nodes[slots + at], nodes[2u * slots + at]),
                 vec3(nodes[3u * slots + at], nodes[4u * slots + at], nodes[5u * slots + at]));
}

void main() {
    uint node = GNOMON_ITEM;
    if (c.level > state.levels) return;
    uint count = state.count[c.level];
    if (node >= (count + 31u) / 32u * 32u) return;
    float infinite = uintBitsToFloat(0x7F800000u);
    GnBox sum = GnBox(vec3(infinite), vec3(-infinite));
    uint end = node < count ? min(node * 32u + 32u, state.count[c.level - 1u]) : 0u;
    for (uint child = node * 32u; child < end; ++child) {
        GnBox box = child_box(child);
        for (uint axis = 0u; axis < 3u; ++axis) {
            sum.lo[axis] = gn_min(sum.lo[axis], box.lo[axis]);
            sum.hi[axis] = gn_max(sum.hi[axis], box.hi[axis]);
        }
    }
    uint slots = state.node_slots;
    uint at = state.first[c.level] + node;
    for (uint axis = 0u; axis < 3u; ++axis) {
        nodes[axis * slots + at] = sum.lo[axis];
        nodes[(axis + 3u) * slots + at] = sum.hi[axis];
    }
}
