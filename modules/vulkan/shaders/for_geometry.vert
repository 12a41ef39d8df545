#version 450
// The layer for a geometry shader.
#extension GL_GOOGLE_include_directive : require
#define GNOMON_GEOMETRY 1
#include "pass_vertex.glsl"
