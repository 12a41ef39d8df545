#version 450
// One layer at a time.
#extension GL_GOOGLE_include_directive : require
#include "pass_vertex.glsl"
