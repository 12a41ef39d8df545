// A fragment under the lights of its tile or cluster: the GLSL half of `forward`. forward_kernels.hpp has the layout.

#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require

#include <gnomon/backend/fragment.glsl>

#define GNOMON_SET 1
#include "surface.glsl"

layout(std430, set = 1, binding = 5) readonly buffer Lights { GnShadedLight lights[]; };
layout(std430, set = 1, binding = 6) readonly buffer Depths { float slice_depth_m[]; };
layout(std430, set = 1, binding = 7) readonly buffer Cells { uvec2 cells[]; };  // offset, count
layout(std430, set = 1, binding = 8) readonly buffer Indices { uint indices[]; };
layout(set = 1, binding = 9) uniform utexture2DArray ids;

layout(push_constant) uniform Constants {
    layout(offset = 64) uint tile;
    uint columns, rows, slices;
    uint once;
    uint blends;
    uint counts;
} c;

#define GN_SLICE_DEPTH(k) slice_depth_m[k]
#include <gnomon/lights/formula/lookup.glsl>

uvec2 cell_at(vec3 position) {
    precise vec3 from_eye = position - camera.eye;
    GnClusterCounts grid = GnClusterCounts(c.columns, c.rows, c.slices);
    uvec2 tile = min(gn_pixel / c.tile, uvec2(c.columns - 1u, c.rows - 1u));
    return cells[gn_cluster_index(grid, tile.x, tile.y, gn_slice_at(grid, gn_dot(from_eye, camera.forward)))];
}

void main() {
    if (c.once != 0u && texelFetch(ids, ivec3(gn_pixel, 0), 0).x != gn_triangle) discard;
    Shaded s = surface_at(gn_triangle, vec2(gn_pixel) + vec2(0.5));
    uvec2 cell = cell_at(s.surface.position);
    precise vec3 sum = s.emissive;
    if (c.counts == 0u)
        for (uint k = 0u; k < cell.y; ++k) sum += gn_shade(lights[indices[cell.x + k]], s.surface);
    precise vec3 premultiplied = sum * s.opacity;
    gn_color = c.blends != 0u ? vec4(premultiplied, s.opacity) : vec4(sum, float(cell.y));
}
