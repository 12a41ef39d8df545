#version 450
// Triangle ids by gl_PrimitiveID; clamps depth in the shader.
#extension GL_GOOGLE_include_directive : require
#define GNOMON_IDS 1
#define GNOMON_CLAMP 1
#include "pass_fragment.glsl"
