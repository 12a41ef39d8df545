// A pixel of four samples, each of a triangle: the GLSL half of `shade_samples`. antialias_kernels.hpp has the layout.

#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require

#define GNOMON_SET 0
#include "surface.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 5) readonly buffer Lights { GnShadedLight lights[]; };
layout(std430, set = 0, binding = 6) readonly buffer Cells { uvec2 cells[]; };  // offset, count
layout(std430, set = 0, binding = 7) readonly buffer Indices { uint indices[]; };
layout(std430, set = 0, binding = 8) writeonly buffer Colors { vec4 colors[]; };
layout(set = 0, binding = 9) uniform utexture2DArray ids;

layout(push_constant) uniform Constants {
    uint width, height;
    uint tile;
    uint columns;
    uint edges_only;
} c;

const uint none = 0xFFFFFFFFu;
const vec2 sample_px[4] = vec2[4](vec2(0.375, 0.125), vec2(0.875, 0.375), vec2(0.125, 0.625), vec2(0.625, 0.875));

/// The light of a triangle at an image point, and how many lights were evaluated.
vec4 lit(uint triangle, vec2 px, uvec2 cell) {
    Shaded s = surface_at(triangle, px);
    precise vec3 sum = s.emissive;
    for (uint k = 0u; k < cell.y; ++k) sum += gn_shade(lights[indices[cell.x + k]], s.surface);
    return vec4(sum, float(cell.y));
}

void main() {
    uint item = gl_GlobalInvocationID.x;
    if (item >= c.width * c.height) return;
    uvec2 pixel = uvec2(item % c.width, item / c.width);
    uvec2 cell = cells[pixel.y / c.tile * c.columns + pixel.x / c.tile];
    uint id[4];
    for (int s = 0; s < 4; ++s) id[s] = texelFetch(ids, ivec3(pixel, s), 0).x;
    bool one = id[0] == id[1] && id[0] == id[2] && id[0] == id[3];
    bool each_sample = c.edges_only != 0u && !one;
    vec2 corner = vec2(pixel);
    precise vec4 sum = vec4(0.0);
    for (int s = 0; s < 4; ++s) {
        if (id[s] == none) continue;
        float share = 0.25;
        bool shaded = false;
        for (int k = 0; k < 4 && !each_sample; ++k) {
            if (k < s) shaded = shaded || id[k] == id[s];
            if (k > s && id[k] == id[s]) share += 0.25;
        }
        if (shaded) continue;
        vec4 light = lit(id[s], corner + (each_sample ? sample_px[s] : vec2(0.5)), cell);
        sum.xyz += light.xyz * share;
        sum.w += light.w;
    }
    colors[item] = sum;
}
