// A bit for each key that a sample has: the GLSL half of `mark_clusters`.

#version 450
#extension GL_GOOGLE_include_directive : require

#include "cluster_layout.glsl"
#include "device_state.glsl"
#include "gnomon/backend/item.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer Keys { uint keys[]; };
layout(std430, set = 0, binding = 1) buffer Bits { uint bits[]; };
layout(std430, set = 0, binding = 2) buffer State { DeviceState state; };

void main() {
    uint i = GNOMON_ITEM;
    if (i >= c.count) return;
    uint key = keys[i];
    if (!holds(key)) {
        if (key == no_key) atomicAdd(state.background, 1u);
        else atomicAdd(state.invalid, 1u);
        return;
    }
    // A run's first sample speaks for those after it.
    if (i % 64u != 0u && keys[i - 1u] == key) return;
    uint number = number_of(key);
    atomicOr(bits[number >> 5], 1u << (number & 31u));
}
