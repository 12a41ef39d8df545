// Each list in ascending order: the GLSL half of `order_lists`. In short ones a light's place is how many of its list are
// less; long ones are merged, [Batcher 1968] with all comparisons one way, so that a list may have any length.

#version 450
#extension GL_GOOGLE_include_directive : require

#include "device_state.glsl"
#include "gnomon/backend/tile.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer State { DeviceState state; };
layout(std430, set = 0, binding = 1) readonly buffer Cells { uvec2 cells[]; };
layout(std430, set = 0, binding = 2) readonly buffer List { uint list[]; };
layout(std430, set = 0, binding = 3) coherent buffer Ordered { uint ordered[]; };
layout(push_constant) uniform Constants {
    uint groups;
    uint first_step, end_step;
} c;

const uint longest_short = 1024u;

void rank(uvec2 cell, uint lane) {
    for (uint k = lane; k < cell.y; k += lanes) {
        uint light = list[cell.x + k];
        uint before = 0u;
        for (uint other = 0u; other < cell.y; ++other) before += list[cell.x + other] < light ? 1u : 0u;
        ordered[cell.x + before] = light;
    }
}

/// Orders places i and j of the list, i < j; what is beyond the end is greater than all.
void order(uvec2 cell, uint i, uint j) {
    if (j >= cell.y) return;
    uint low = ordered[cell.x + i];
    uint high = ordered[cell.x + j];
    if (high >= low) return;
    ordered[cell.x + i] = high;
    ordered[cell.x + j] = low;
}

void step_done() {
    memoryBarrierBuffer();
    barrier();
}

bool is_step(uint step) { return step >= c.first_step && step < c.end_step; }

void merge(uvec2 cell, uint lane) {
    if (is_step(0u)) {
        for (uint k = lane; k < cell.y; k += lanes) ordered[cell.x + k] = list[cell.x + k];
        step_done();
    }
    uint step = 1u;
    for (uint block = 2u; block / 2u < cell.y; block *= 2u) {
        uint half_block = block / 2u;
        if (is_step(step++)) {
            for (uint pair = lane; pair < cell.y; pair += lanes) {
                uint begin = pair / half_block * block;
                order(cell, begin + pair % half_block, begin + block - 1u - pair % half_block);
            }
            step_done();
        }
        for (uint apart = block / 4u; apart > 0u; apart /= 2u) {
            if (!is_step(step++)) continue;
            for (uint pair = lane; pair < cell.y; pair += lanes) {
                uint i = pair / apart * 2u * apart + pair % apart;
                order(cell, i, i + apart);
            }
            step_done();
        }
    }
}

void main() {
    if (tile_index() >= c.groups) return;  // a grid's last row may be longer
    for (uint cluster = tile_index(); cluster < state.clusters; cluster += c.groups) {
        uvec2 cell = cells[cluster];
        if (cell.y > longest_short) merge(cell, gl_LocalInvocationID.x);
        else if (c.first_step == 0u) rank(cell, gl_LocalInvocationID.x);
    }
}
