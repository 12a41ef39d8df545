#version 450
// The layer for a geometry shader, or for nobody.
#extension GL_GOOGLE_include_directive : require
#include "pass_vertex.glsl"
