// Each sample under the lights of its list: the GLSL half of `shade_lists`. light_kernels.hpp has the layout.

#version 450
#extension GL_GOOGLE_include_directive : require

#include "gbuffer.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 2) readonly buffer Lights { GnShadedLight lights[]; };
layout(std430, set = 0, binding = 3) readonly buffer ListOf { uint list_of[]; };
layout(std430, set = 0, binding = 4) readonly buffer Cells { uvec2 cells[]; };  // offset, count
layout(std430, set = 0, binding = 5) readonly buffer Indices { uint indices[]; };
layout(std430, set = 0, binding = 6) buffer Radiance { float radiance[]; };
layout(std430, set = 0, binding = 7) writeonly buffer Computations { uint computations[]; };

layout(push_constant) uniform Constants {
    uint count;
    uint halves;
    uint orthographic;
    float eye_x, eye_y, eye_z;
    uint first, end;
} c;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= c.count) return;
    bool halves = c.halves != 0u;
    uint list = list_of[i];
    uvec2 cell = list != 0xFFFFFFFFu ? cells[list] : uvec2(0u);
    if (c.first != 0u && cell.y <= c.first) return;
    GnSurface surface = surface_of(i, halves, vec3(c.eye_x, c.eye_y, c.eye_z), c.orthographic != 0u);
    precise vec3 sum = emissive_of(i, halves);
    if (c.first != 0u) sum = vec3(radiance[3u * i], radiance[3u * i + 1u], radiance[3u * i + 2u]);
    uint end = min(c.end, cell.y);
    for (uint k = c.first; k < end; ++k) sum += gn_shade(lights[indices[cell.x + k]], surface);
    radiance[3u * i] = sum.x;
    radiance[3u * i + 1u] = sum.y;
    radiance[3u * i + 2u] = sum.z;
    computations[i] = cell.y;
}
