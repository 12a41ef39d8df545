// The cluster key of each sample: the GLSL half of `cluster_keys`. device_kernels.hpp has the layout of these kernels.

#version 450
#extension GL_GOOGLE_include_directive : require

#include "gnomon/backend/item.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer Samples { uvec4 samples[]; };  // triangle, position
layout(std430, set = 0, binding = 1) readonly buffer Pixels { uint pixels[]; };
layout(std430, set = 0, binding = 2) readonly buffer Normals { float normals[]; };
layout(std430, set = 0, binding = 3) readonly buffer SliceWords { uint slice_words[]; };
layout(std430, set = 0, binding = 4) writeonly buffer Keys { uint keys[]; };

#define GN_WORDS uint
#define GN_WORD(words, i) slice_words[(words) + (i)]
#include <gnomon/cluster/formula/grid.glsl>
#include <gnomon/cluster/formula/key.glsl>

layout(push_constant) uniform Constants {
    GnGrid grid;
    uint count;
    uint width;
    float eye_x, eye_y, eye_z;
    float forward_x, forward_y, forward_z;
    uint normal_n;
    uint packed;  // 0: keys are dense numbers
} c;

void main() {
    uint i = GNOMON_ITEM;
    if (i >= c.count) return;
    precise vec3 offset = uintBitsToFloat(samples[i].yzw) - vec3(c.eye_x, c.eye_y, c.eye_z);
    float depth = gn_along(offset, vec3(c.forward_x, c.forward_y, c.forward_z));
    uint cell = 0u;
    if (c.normal_n != 0u) cell = gn_normal_cell(vec3(normals[3u * i], normals[3u * i + 1u], normals[3u * i + 2u]), c.normal_n);
    uint column = gn_column_of(c.grid, pixels[i] % c.width);
    uint row = gn_row_of(c.grid, pixels[i] / c.width);
    uint slice = gn_slice_at(c.grid.depth, 0u, depth);
    uint cells = c.normal_n != 0u ? 6u * c.normal_n * c.normal_n : 1u;
    uint number = ((row * c.grid.columns + column) * c.grid.depth.slices + slice) * cells + cell;
    keys[i] = c.packed != 0u ? gn_pack_key(column, row, slice, cell) : number;
}
