#version 450
#extension GL_GOOGLE_include_directive : require
// Scrolled texels and the choice of a cascade, for parity_cascade.test.cpp: 8 words in, 12 out.
layout(std430, set = 0, binding = 2) readonly buffer Texels { float texels_of_map[]; };
#define GN_TEXELS uint
#define GN_TEXEL(texels, x, y) texels_of_map[(texels) + uint((y) * 32 + (x))]
#include <gnomon/cascade/formula/scroll.glsl>
#include <gnomon/cascade/formula/select.glsl>
#include <gnomon/cascade/formula/toroidal.glsl>
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Inputs { uint inputs[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Outputs { uint outputs[]; };
struct Case {
    GnScroll scroll;
    GnCascadeDepths depths;
    GnCascadeMaps maps;
};
layout(std430, set = 0, binding = 3) readonly buffer Cases { Case cases[]; };
layout(push_constant) uniform Push { uint count; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    uint from = i * 8u;
    uint k = inputs[from];
    int x = int(inputs[from + 1u]);
    int y = int(inputs[from + 2u]);
    int code = int(inputs[from + 3u]);
    float depth_m = uintBitsToFloat(inputs[from + 4u]);
    vec3 light_m = vec3(uintBitsToFloat(inputs[from + 5u]), uintBitsToFloat(inputs[from + 6u]), uintBitsToFloat(inputs[from + 7u]));
    GnScroll scroll = cases[k].scroll;
    GnCascadeDepths depths = cases[k].depths;
    GnCascadeMaps maps = cases[k].maps;
    uint at = i * 12u;
    uint map = scroll.unorm16 != 0u ? 0u : 1024u;
    outputs[at] = floatBitsToUint(gn_scrolled_texel(scroll, map, x, y));
    outputs[at + 1u] = uint(gn_scrolled_code(code, int(scroll.add), 65535, scroll.reversed != 0u));
    outputs[at + 2u] = uint(gn_toroidal(x, y, 32));
    GnCascadeChoice by_depth = gn_cascade_by_depth(depths, depth_m);
    outputs[at + 3u] = by_depth.cascade;
    outputs[at + 4u] = by_depth.next;
    outputs[at + 5u] = floatBitsToUint(by_depth.blend);
    GnCascadeChoice by_map = gn_cascade_by_map(maps, light_m);
    outputs[at + 6u] = by_map.cascade;
    outputs[at + 7u] = by_map.next;
    outputs[at + 8u] = floatBitsToUint(by_map.blend);
    vec3 place = gn_in_cascade_map(maps.map[0], light_m);
    outputs[at + 9u] = floatBitsToUint(place.x);
    outputs[at + 10u] = floatBitsToUint(gn_texels_within(maps.map[1], place));
    outputs[at + 11u] = floatBitsToUint(gn_scrolled(depth_m, scroll.add, scroll.last, scroll.reversed != 0u));
}
