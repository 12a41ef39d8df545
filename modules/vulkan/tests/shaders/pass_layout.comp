#version 450
// Uses the passes' structs, so that a test can read their layouts.
#extension GL_GOOGLE_include_directive : require

#include "../../shaders/pass_interface.glsl"

layout(local_size_x = 1) in;
layout(set = 0, binding = 4, std430) readonly buffer AlphaTests { AlphaTest alpha_tests[]; };
layout(set = 0, binding = 2, std430) writeonly buffer Out { uint value[]; };

void main() {
    value[0] = views[0].layer + items[0].alpha + alpha_tests[0].wrap_u + push.layers;
}
