// Each number of a tile becomes the sum of all before it: the GLSL half of `scan_apply`.

#version 450
#extension GL_GOOGLE_include_directive : require

#include "gnomon/backend/tile.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) buffer Values { uint values[]; };
layout(std430, set = 0, binding = 1) readonly buffer Bases { uint bases[]; };  // scanned sums of tiles
layout(push_constant) uniform Constants {
    uint count;
    uint has_bases;
} c;

shared uint numbers[tile_items + tile_items / 16u];

void main() {
    uint lane = gl_LocalInvocationID.x;
    uint tile = tile_index();
    uint first = tile * tile_items;
    for (uint k = 0u; k < lane_items; ++k) {
        uint place = k * lanes + lane;
        numbers[padded(place)] = first + place < c.count ? values[first + place] : 0u;
    }
    barrier();
    uint sum = 0u;
    for (uint k = 0u; k < lane_items; ++k) sum = add(sum, numbers[padded(lane * lane_items + k)]);
    uint running = sum_before(lane, sum);
    if (c.has_bases != 0u && first < c.count) running = add(running, bases[tile]);
    for (uint k = 0u; k < lane_items; ++k) {
        uint place = padded(lane * lane_items + k);
        uint value = numbers[place];
        numbers[place] = running;
        running = add(running, value);
    }
    barrier();
    for (uint k = 0u; k < lane_items; ++k) {
        uint place = k * lanes + lane;
        if (first + place < c.count) values[first + place] = numbers[padded(place)];
    }
}
