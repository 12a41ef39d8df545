// Each list in ascending order: a light's place is how many of its list are less. The GLSL half of `order_lists`.

#version 450
#extension GL_GOOGLE_include_directive : require

#include "device_state.glsl"
#include "gnomon/backend/tile.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer State { DeviceState state; };
layout(std430, set = 0, binding = 1) readonly buffer Cells { uvec2 cells[]; };
layout(std430, set = 0, binding = 2) readonly buffer List { uint list[]; };
layout(std430, set = 0, binding = 3) writeonly buffer Ordered { uint ordered[]; };
layout(push_constant) uniform Constants { uint groups; } c;

void main() {
    for (uint cluster = tile_index(); cluster < state.clusters; cluster += c.groups) {
        uvec2 cell = cells[cluster];
        for (uint k = gl_LocalInvocationID.x; k < cell.y; k += lanes) {
            uint light = list[cell.x + k];
            uint before = 0u;
            for (uint other = 0u; other < cell.y; ++other) before += list[cell.x + other] < light ? 1u : 0u;
            ordered[cell.x + before] = light;
        }
    }
}
