#version 450
// Alpha test alone.
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_gpu_shader_int64 : require
#define GNOMON_DEPTH_BY_DEVICE 1
#include "ortho_fragment.glsl"
