#version 450
#extension GL_GOOGLE_include_directive : require
// The whole lookup and what it is made of, for parity.test.cpp: position, normal, index of map and settings; 16 words out.
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Inputs { uint inputs[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Outputs { uint outputs[]; };
layout(std430, set = 0, binding = 3) readonly buffer Depths { float depths[]; };

struct Texels {
    int first;
    int stride;
};
#define GN_TEXELS Texels
#define GN_TEXEL(texels, x, y) depths[(texels).first + (y) * (texels).stride + (x)]
#include <gnomon/shadow/formula/lookup.glsl>

struct Case {
    GnShadowMap map;
    GnShadowConfig config;
};
layout(std430, set = 0, binding = 2) readonly buffer Cases { Case cases[]; };
layout(push_constant) uniform Push { uint count; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    uint from = i * 7u;
    vec3 position = vec3(uintBitsToFloat(inputs[from]), uintBitsToFloat(inputs[from + 1u]), uintBitsToFloat(inputs[from + 2u]));
    vec3 normal = vec3(uintBitsToFloat(inputs[from + 3u]), uintBitsToFloat(inputs[from + 4u]), uintBitsToFloat(inputs[from + 5u]));
    GnShadowMap map = cases[inputs[from + 6u]].map;
    GnShadowConfig config = cases[inputs[from + 6u]].config;
    int side = int(map.size_px.x);
    Texels texels = Texels(int(inputs[from + 6u]) * side * side, side);

    GnReceiver at = gn_receiver_at(map, position, normal);
    GnPrepared ready = gn_prepare(map, position, normal, config);
    GnLookup seen = gn_look_up(map, texels, position, normal, config);
    vec4 corner = gn_clip_of_corner(map.clip_from_relative, position - map.eye);
    uint at_word = i * 16u;
    bool compares = at.in_front && !ready.faces_away && ready.at.in_front;
    outputs[at_word] = uint(at.in_front) | uint(ready.faces_away) << 1 | uint(compares) << 2;
    outputs[at_word + 1u] = floatBitsToUint(at.texel.x);
    outputs[at_word + 2u] = floatBitsToUint(at.texel.y);
    outputs[at_word + 3u] = floatBitsToUint(at.depth);
    outputs[at_word + 4u] = floatBitsToUint(at.gradient.x);
    outputs[at_word + 5u] = floatBitsToUint(at.gradient.y);
    outputs[at_word + 6u] = floatBitsToUint(at.tan_angle);
    outputs[at_word + 7u] = floatBitsToUint(at.depth_per_m);
    outputs[at_word + 8u] = uint(gn_taps_at(ready.at.texel.x, config.taps).first);
    outputs[at_word + 9u] = floatBitsToUint(ready.depth);
    outputs[at_word + 10u] = floatBitsToUint(seen.visibility);
    outputs[at_word + 11u] = floatBitsToUint(seen.bias_m);
    outputs[at_word + 12u] = floatBitsToUint(corner.x);
    outputs[at_word + 13u] = floatBitsToUint(corner.y);
    outputs[at_word + 14u] = floatBitsToUint(corner.z);
    outputs[at_word + 15u] = floatBitsToUint(corner.w);
}
