#version 450
// The layer from the vertex shader.
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_shader_viewport_layer_array : require
#define GNOMON_LAYER 1
#include "pass_vertex.glsl"
