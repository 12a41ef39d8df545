#version 450
// Alpha test alone; clamps depth in the shader.
#extension GL_GOOGLE_include_directive : require
#define GNOMON_CLAMP 1
#include "pass_fragment.glsl"
