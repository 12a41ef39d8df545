#version 450
// Uses the integer passes' structs, so that a test can read their layouts.
#extension GL_GOOGLE_include_directive : require

#include "../../shaders/ortho_interface.glsl"

layout(local_size_x = 1) in;
layout(set = 0, binding = 2, std430) writeonly buffer Out { double value[]; };

void main() { value[push.light] = lights[0].image.x; }
