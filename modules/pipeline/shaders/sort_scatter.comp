// Moves each pair to its place by this pass's digit; pairs of one digit keep their order: the GLSL half of `sort_scatter`.

#version 450
#extension GL_GOOGLE_include_directive : require

#include "sort_digits.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer Pairs { uvec2 pairs[]; };
layout(std430, set = 0, binding = 1) readonly buffer Places { uint places[]; };  // scanned counts
layout(std430, set = 0, binding = 2) writeonly buffer Moved { uvec2 moved[]; };

shared uint next[digits * lanes];

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint tile = tile_index();
    uint first = tile * tile_items + lane * lane_items;  // a lane's pairs are neighbours, so that their order is known
    for (uint d = 0u; d < digits; ++d) next[d * lanes + lane] = 0u;
    for (uint k = 0u; k < lane_items; ++k)
        if (first + k < c.count) next[digit_of(pairs[first + k].x) * lanes + lane] += 1u;
    barrier();
    if (lane < digits && tile < tile_count()) {
        uint place = places[lane * tile_count() + tile];
        for (uint l = 0u; l < lanes; ++l) {
            uint here = next[lane * lanes + l];
            next[lane * lanes + l] = place;
            place += here;
        }
    }
    barrier();
    for (uint k = 0u; k < lane_items; ++k) {
        if (first + k >= c.count) continue;
        uvec2 pair = pairs[first + k];
        uint slot = digit_of(pair.x) * lanes + lane;
        uint place = next[slot];
        next[slot] = place + 1u;
        moved[place] = pair;
    }
}
