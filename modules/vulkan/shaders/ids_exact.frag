#version 450
// Triangle ids by gl_PrimitiveID; alpha test in double.
#extension GL_GOOGLE_include_directive : require
#define GNOMON_IDS 1
#define GNOMON_EXACT 1
#include "pass_fragment.glsl"
