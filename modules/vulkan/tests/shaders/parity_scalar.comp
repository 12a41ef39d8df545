#version 450
#extension GL_GOOGLE_include_directive : require
// Every formula of a few scalars, for parity.test.cpp: 4 words in, 18 out.
#include <gnomon/math/formula/bits.glsl>
#include <gnomon/math/formula/view.glsl>
#include <gnomon/projection/formula/cube.glsl>
#include <gnomon/shadow/formula/pcf.glsl>
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Inputs { uvec4 inputs[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Outputs { uint outputs[]; };
layout(push_constant) uniform Push { uint count; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    uvec4 words = inputs[i];
    float a = uintBitsToFloat(words.x);
    float b = uintBitsToFloat(words.y);
    float c = uintBitsToFloat(words.z);
    int taps = 1 + int(words.w % 15u);
    uint at = i * 18u;
    outputs[at] = gn_face_of(vec3(a, b, c));
    outputs[at + 1u] = uint(gn_ordinal(a));
    outputs[at + 2u] = floatBitsToUint(gn_from_ordinal(gn_ordinal(b)));
    outputs[at + 3u] = gn_morton_30(words.x, words.y, words.z);
    outputs[at + 4u] = uint(gn_code_of_depth(gn_to_unit(a)));
    outputs[at + 5u] = floatBitsToUint(gn_depth_of_code(float(words.w & 0xFFFFu)));
    outputs[at + 6u] = floatBitsToUint(gn_depth_of_unorm16(float(words.w & 0xFFFFu) / 65535.0));
    GnTapRow row = gn_taps_at(a, taps);
    outputs[at + 7u] = uint(row.first);
    outputs[at + 8u] = floatBitsToUint(row.fraction);
    outputs[at + 9u] = floatBitsToUint(gn_tap_weight(row, taps, 0));
    outputs[at + 10u] = floatBitsToUint(gn_tap_weight(row, taps, taps - 1));
    outputs[at + 11u] = uint(b < c) | uint(b <= c) << 1 | uint(b == c) << 2 | uint(b != c) << 3;
    outputs[at + 12u] = floatBitsToUint(gn_min(a, b));
    outputs[at + 13u] = floatBitsToUint(gn_max(a, b));
    outputs[at + 14u] = floatBitsToUint(gn_div(a, b));
    outputs[at + 15u] = floatBitsToUint(gn_sqrt(abs(a)));
    outputs[at + 16u] = floatBitsToUint(gn_depth_from_distance(a, b, true, c));
    outputs[at + 17u] = floatBitsToUint(gn_distance_from_depth(a, b, false, c));
}
