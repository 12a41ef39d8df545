#version 450
#extension GL_GOOGLE_include_directive : require
// How many items of each tile have each digit: counts[digit * tiles + tile].
#include "bin_common.glsl"
layout(local_size_x = 64) in;
// (bin, item) pairs; in the first pass the bins alone.
layout(std430, set = 0, binding = 0) readonly buffer Items { uint items[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Counts { uint counts[]; };

shared uint of_lane[digits * lanes];

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint tile = tile_index();
    for (uint d = 0u; d < digits; ++d) of_lane[d * lanes + lane] = 0u;
    for (uint k = 0u; k < lane_items; ++k) {
        uint i = tile * tile_items + k * lanes + lane;
        if (i < pass.count) {
            uint key = items[pass.is_first != 0u ? i : i * 2u];
            of_lane[digit_of(bin_in(key)) * lanes + lane] += 1u;
        }
    }
    barrier();
    if (lane < digits && tile < tile_count()) {
        uint sum = 0u;
        for (uint l = 0u; l < lanes; ++l) sum += of_lane[lane * lanes + l];
        counts[lane * tile_count() + tile] = sum;
    }
}
