#version 450
// Triangle ids by gl_PrimitiveID.
#extension GL_GOOGLE_include_directive : require
#define GNOMON_IDS 1
#include "pass_fragment.glsl"
