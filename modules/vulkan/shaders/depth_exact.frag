#version 450
// Alpha test alone, in double.
#extension GL_GOOGLE_include_directive : require
#define GNOMON_EXACT 1
#include "pass_fragment.glsl"
