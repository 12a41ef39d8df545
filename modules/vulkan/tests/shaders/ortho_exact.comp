#version 450
// The integer passes' own arithmetic, for ortho_exact.test.cpp: four doubles in, four out.
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_gpu_shader_int64 : require

#include "../../shaders/ortho_exact.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Inputs { double numbers[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Outputs { double results[]; };
layout(push_constant) uniform Push { uint count; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    uint at = 4u * i;
    Wide cross = wide_cross(numbers[at], numbers[at + 1u], numbers[at + 2u], numbers[at + 3u]);
    double value = wide_to_double(cross);
    double by = max(abs(value), 1.0LF);
    results[at] = value;
    results[at + 1u] = double(sign_of(cross));
    results[at + 2u] = quotient(numbers[at], by);
    results[at + 3u] = numbers[at] / by;  // the device's own, to be counted
}
