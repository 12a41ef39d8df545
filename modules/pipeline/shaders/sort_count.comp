// How many pairs of each tile have each digit, counts[digit * tiles + tile]: the GLSL half of `sort_count`.

#version 450
#extension GL_GOOGLE_include_directive : require

#include "sort_digits.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer Pairs { uvec2 pairs[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Counts { uint counts[]; };

shared uint of_digit[digits];

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint tile = tile_index();
    if (lane < digits) of_digit[lane] = 0u;
    barrier();
    for (uint k = 0u; k < lane_items; ++k) {
        uint i = tile * tile_items + k * lanes + lane;
        if (i < c.count) atomicAdd(of_digit[digit_of(pairs[i].x)], 1u);
    }
    barrier();
    if (lane < digits && tile < tile_count()) counts[lane * tile_count() + tile] = of_digit[lane];
}
