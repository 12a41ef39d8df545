#version 450
#extension GL_GOOGLE_include_directive : require
// Moves each item to its place by this pass's digit. Items of one digit keep their order.
#include "bin_common.glsl"
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Items { uint items[]; };
// Scanned: where the items of a digit of a tile begin.
layout(std430, set = 0, binding = 1) readonly buffer Places { uint places[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Moved { uvec2 moved[]; };

shared uint next[digits * lanes];

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint tile = tile_index();
    uint first = tile * tile_items + lane * lane_items;  // a lane's items are neighbours, so that their order is known
    uint keys[lane_items];
    for (uint d = 0u; d < digits; ++d) next[d * lanes + lane] = 0u;
    for (uint k = 0u; k < lane_items; ++k) {
        uint i = first + k;
        if (i < pass.count) {
            keys[k] = bin_in(items[pass.is_first != 0u ? i : i * 2u]);
            next[digit_of(keys[k]) * lanes + lane] += 1u;
        }
    }
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
        uint i = first + k;
        if (i < pass.count) {
            uint slot = digit_of(keys[k]) * lanes + lane;
            uint place = next[slot];
            next[slot] = place + 1u;
            moved[place] = uvec2(keys[k], pass.is_first != 0u ? i : items[i * 2u + 1u]);
        }
    }
}
