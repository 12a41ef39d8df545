#version 450
// Alpha test alone.
#extension GL_GOOGLE_include_directive : require
#include "pass_fragment.glsl"
