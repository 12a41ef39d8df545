#version 450
#extension GL_GOOGLE_include_directive : require
// The 64-bit sum (low word, high word) of each tile of 1024 numbers.
#include "gnomon/backend/tile.glsl"
layout(local_size_x = 64) in;
// Numbers of 32 bits (stride 1), or sums of the level below: low and high words (stride 2).
layout(std430, set = 0, binding = 0) readonly buffer Values { uint values[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Totals { uvec2 totals[]; };
layout(push_constant) uniform ScanLevel { uint count; uint stride; uint has_bases; } level;

shared uvec2 sums[lanes];

uvec2 add_wide(uvec2 a, uvec2 b) {
    uint carry;
    uint low = uaddCarry(a.x, b.x, carry);
    return uvec2(low, a.y + b.y + carry);
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint tile = tile_index();
    uvec2 sum = uvec2(0u);
    for (uint k = 0u; k < lane_items; ++k) {
        uint i = tile * tile_items + k * lanes + lane;
        if (i < level.count) {
            uint high = level.stride == 2u ? values[i * 2u + 1u] : 0u;
            sum = add_wide(sum, uvec2(values[i * level.stride], high));
        }
    }
    sums[lane] = sum;
    for (uint step = lanes / 2u; step > 0u; step /= 2u) {
        barrier();
        if (lane < step) sums[lane] = add_wide(sums[lane], sums[lane + step]);
    }
    uint tiles = max(1u, (level.count + tile_items - 1u) / tile_items);
    if (lane == 0u && tile < tiles) totals[tile] = sums[0];
}
