#version 450
#extension GL_GOOGLE_include_directive : require
// View samples in float, for parity_reconstruct.test.cpp: camera, image point, three corners in; 11 words out.
#include <gnomon/sample/formula/reconstruct.glsl>
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Inputs { uint inputs[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Outputs { uint outputs[]; };
layout(std430, set = 0, binding = 2) readonly buffer Cameras { GnRayCamera cameras[]; };
layout(push_constant) uniform Push { uint count; };

vec3 corner_at(uint from) {
    return vec3(uintBitsToFloat(inputs[from]), uintBitsToFloat(inputs[from + 1u]), uintBitsToFloat(inputs[from + 2u]));
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    uint from = i * 12u;
    vec2 px = vec2(uintBitsToFloat(inputs[from + 1u]), uintBitsToFloat(inputs[from + 2u]));
    GnReconstructed made = gn_reconstruct(cameras[inputs[from]], px, corner_at(from + 3u), corner_at(from + 6u), corner_at(from + 9u));
    float values[10] = float[10](made.position.x, made.position.y, made.position.z, made.error.x, made.error.y,
                                 made.error.z, made.normal.x, made.normal.y, made.normal.z, made.normal_error);
    for (uint k = 0u; k < 10u; ++k) outputs[i * 11u + k] = floatBitsToUint(values[k]);
    outputs[i * 11u + 10u] = uint(made.usable);
}
