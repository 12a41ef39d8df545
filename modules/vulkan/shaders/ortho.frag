#version 450
// Code and alpha test.
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_gpu_shader_int64 : require
#include "ortho_fragment.glsl"
