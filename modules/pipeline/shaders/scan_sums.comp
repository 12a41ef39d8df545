// The sum of each tile of 1024 numbers, at most 2^32 - 1: the GLSL half of `scan_sums`.

#version 450
#extension GL_GOOGLE_include_directive : require

#include "gnomon/backend/tile.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer Values { uint values[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Sums { uint sums[]; };
layout(push_constant) uniform Constants { uint count; } c;

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint tile = tile_index();
    uint sum = 0u;
    for (uint k = 0u; k < lane_items; ++k) {
        uint i = tile * tile_items + k * lanes + lane;
        if (i < c.count) sum = add(sum, values[i]);
    }
    uint before = sum_before(lane, sum);
    if (lane == lanes - 1u && tile * tile_items < c.count) sums[tile] = add(before, sum);
}
