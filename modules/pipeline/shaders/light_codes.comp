// Each light's Morton code, and the layout of the tree: the GLSL half of `light_codes`.

#version 450
#extension GL_GOOGLE_include_directive : require

#include <gnomon/bvh/formula/code.glsl>

#include "device_state.glsl"
#include "gnomon/backend/item.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer Items { vec4 items[]; };
layout(std430, set = 0, binding = 1) buffer State { DeviceState state; };
layout(std430, set = 0, binding = 2) writeonly buffer Pairs { uvec2 pairs[]; };
layout(push_constant) uniform Constants { uint count; } c;

uint padded_to_32(uint n) { return (n + 31u) / 32u * 32u; }

/// bvh::make_layout.
void lay_out() {
    uint level = 0u;
    uint slots = 0u;
    uint count = state.usable;
    state.count[0] = count;
    state.item_slots = padded_to_32(count);
    while (count > 1u || (level == 0u && count != 0u)) {
        count = padded_to_32(count) / 32u;
        ++level;
        state.count[level] = count;
        state.first[level] = slots;
        slots += padded_to_32(count);
    }
    state.levels = level;
    state.node_slots = slots;
}

float least(uint axis) { return gn_from_ordinal(state.places[axis]); }

float scale_of(uint axis) { return gn_code_scale(least(axis), gn_from_ordinal(-state.places[axis + 3u]), 1024.0); }

void main() {
    uint i = GNOMON_ITEM;
    if (i == 0u) lay_out();
    if (i >= c.count) return;
    vec4 item = items[i];
    uint code = 1u << 30;  // takes no part: after all others
    if (item.w >= 0.0) {
        GnCodeGrid grid = GnCodeGrid(vec3(least(0u), least(1u), least(2u)), 1023.0, vec3(scale_of(0u), scale_of(1u), scale_of(2u)), 0u);
        precise vec3 half_center = item.xyz * 0.5;
        code = gn_code_30(grid, half_center);
    }
    pairs[i] = uvec2(code, i);
}
