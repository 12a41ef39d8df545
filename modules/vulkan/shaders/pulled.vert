#version 450
// Corners pulled from buffers, so that a triangle knows its number; one layer at a time.
#extension GL_GOOGLE_include_directive : require
#define GNOMON_PULLED 1
#include "pass_vertex.glsl"
