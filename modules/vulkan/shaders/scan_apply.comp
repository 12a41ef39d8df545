#version 450
#extension GL_GOOGLE_include_directive : require
// Each number becomes the sum of all before it, at most 2^32 - 1. `results` may be `values`.
#include "gnomon/backend/tile.glsl"
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) buffer Values { uint values[]; };
// Sums of all tiles before each tile, in the low words.
layout(std430, set = 0, binding = 1) readonly buffer Bases { uvec2 bases[]; };
layout(std430, set = 0, binding = 2) buffer Results { uint results[]; };
layout(push_constant) uniform ScanLevel { uint count; uint stride; uint has_bases; } level;

shared uint numbers[tile_items + tile_items / 16u];

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint tile = tile_index();
    uint first = tile * tile_items;
    for (uint k = 0u; k < lane_items; ++k) {
        uint place = k * lanes + lane;
        uint i = first + place;
        uint value = 0u;
        if (i < level.count) {
            value = values[i * level.stride];
            if (level.stride == 2u && values[i * 2u + 1u] != 0u) value = most;
        }
        numbers[padded(place)] = value;
    }
    barrier();
    uint sum = 0u;
    for (uint k = 0u; k < lane_items; ++k) sum = add(sum, numbers[padded(lane * lane_items + k)]);
    uint running = sum_before(lane, sum);
    if (level.has_bases != 0u && first < level.count) running = add(running, bases[tile].x);
    for (uint k = 0u; k < lane_items; ++k) {
        uint place = padded(lane * lane_items + k);
        uint value = numbers[place];
        numbers[place] = running;
        running = add(running, value);
    }
    barrier();
    for (uint k = 0u; k < lane_items; ++k) {
        uint place = k * lanes + lane;
        uint i = first + place;
        if (i < level.count) results[i * level.stride] = numbers[padded(place)];
    }
}
