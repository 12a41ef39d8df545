#version 450
#extension GL_GOOGLE_include_directive : require
// Slices, keys, grids, bounds and the shader's lookup, for parity_cluster.test.cpp: 16 words in, 21 out.
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Inputs { uint inputs[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Outputs { uint outputs[]; };
layout(std430, set = 0, binding = 3) readonly buffer SliceWords { uint slice_words[]; };
layout(std430, set = 0, binding = 4) readonly buffer Planes { float plane_depths[]; };

uint first_plane;
#define GN_SLICE_DEPTH(k) plane_depths[first_plane + (k)]
#include <gnomon/lights/formula/lookup.glsl>

#define GN_WORDS uint
#define GN_WORD(words, i) slice_words[(words) + (i)]
#include <gnomon/cluster/formula/bounds.glsl>
#include <gnomon/cluster/formula/grid.glsl>
#include <gnomon/cluster/formula/key.glsl>

struct Case {
    GnGrid grid;
    uint words;
    uint planes;
    uint normal_n;
};
layout(std430, set = 0, binding = 2) readonly buffer Cases { Case cases[]; };
layout(push_constant) uniform Push { uint count; };

vec3 at(uint from) { return uintBitsToFloat(uvec3(inputs[from], inputs[from + 1u], inputs[from + 2u])); }

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    uint f = i * 16u;
    Case c = cases[inputs[f + 15u]];
    uint x = inputs[f];
    uint y = inputs[f + 1u];
    float depth = uintBitsToFloat(inputs[f + 2u]);
    vec3 normal = at(f + 3u);
    vec3 lo = at(f + 6u);
    vec3 hi = at(f + 9u);
    vec3 position = at(f + 12u);
    uint o = i * 21u;
    uint column = gn_column_of(c.grid, x);
    uint row = gn_row_of(c.grid, y);
    uint slice = gn_slice_at(c.grid.depth, c.words, depth);
    uint cell = gn_normal_cell(normal, c.normal_n);
    uint key = gn_pack_key(column, row, slice, cell);
    outputs[o] = column;
    outputs[o + 1u] = row;
    outputs[o + 2u] = slice;
    outputs[o + 3u] = gn_cluster_at(c.grid, c.words, x, y, depth);
    outputs[o + 4u] = cell;
    outputs[o + 5u] = key;
    outputs[o + 6u] = gn_key_row(key) ^ gn_key_column(key) << 8 ^ gn_key_slice(key) << 16 ^ gn_key_cell(key) << 26;
    outputs[o + 7u] = gn_wide_key_tile(column, row);
    outputs[o + 8u] = gn_wide_key_inner(slice, cell);
    vec3 image = gn_position_at(c.grid, float(x) + 0.5, float(y) + 0.5, depth);
    for (int k = 0; k < 3; ++k) outputs[o + 9u + uint(k)] = floatBitsToUint(image[k]);
    uint bits = gn_position_bits(position, lo, hi);
    outputs[o + 12u] = bits;
    outputs[o + 13u] = floatBitsToUint(gn_parts_low(bits, lo.x, hi.x));
    outputs[o + 14u] = floatBitsToUint(gn_parts_high(bits >> 10, lo.y, hi.y));
    outputs[o + 15u] = floatBitsToUint(gn_part_begin(lo.z, hi.z, 7.0));
    outputs[o + 16u] = floatBitsToUint(gn_along(position, normal));
    GnClusterCounts counts = GnClusterCounts(c.grid.columns, c.grid.rows, c.grid.depth.slices);
    first_plane = c.planes;
    uint looked_up = gn_slice_at(counts, depth);
    uint cluster = gn_cluster_index(counts, column, row, looked_up);
    outputs[o + 17u] = looked_up;
    outputs[o + 18u] = cluster;
    outputs[o + 19u] = gn_plane_word(inputs[f + 15u], 7u, cluster);
    outputs[o + 20u] = gn_index_of_pair(inputs[f + 12u], x);
}
