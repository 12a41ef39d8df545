#version 450
#extension GL_GOOGLE_include_directive : require
layout(std430, set = 0, binding = 0) readonly buffer Depths { float slice_depth_m[]; };  // the grid's planes
layout(std430, set = 0, binding = 1) readonly buffer Cells { uvec2 cells[]; };           // offset, count
layout(std430, set = 0, binding = 2) readonly buffer Indices { uint indices[]; };
layout(std430, set = 0, binding = 3) readonly buffer Balls { vec4 balls[]; };            // the engine's own lights
layout(push_constant) uniform Tiles { uint columns; uint rows; uint slices; uint tile_px; } tiles;
layout(location = 0) in vec3 position;  // x right, y down, depth
layout(location = 0) out vec4 color;

#define GN_SLICE_DEPTH(k) slice_depth_m[k]
#include <gnomon/lights/formula/lookup.glsl>

void main() {
    GnClusterCounts grid = GnClusterCounts(tiles.columns, tiles.rows, tiles.slices);
    uvec2 tile = uvec2(gl_FragCoord.xy) / tiles.tile_px;
    uvec2 cell = cells[gn_cluster_index(grid, tile.x, tile.y, gn_slice_at(grid, position.z))];
    float sum = 0.0;
    for (uint k = 0u; k < cell.y; ++k) {
        vec4 ball = balls[indices[cell.x + k]];
        sum += max(0.0, 1.0 - distance(position, ball.xyz) / ball.w);
    }
    color = vec4(sum);
}
