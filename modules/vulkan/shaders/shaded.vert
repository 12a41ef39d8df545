#version 450
// Corners pulled from buffers, for fragment kernels, which are told their triangle and nothing else. Positions are those
// of the other vertex shaders, to the bit: no product is contracted into a sum.
#extension GL_GOOGLE_include_directive : require
#define GNOMON_PULLED 1
#define GNOMON_SHADED 1
#include "pass_vertex.glsl"
