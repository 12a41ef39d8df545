// What a fragment kernel's GLSL half gets and gives; see gnomon/backend/fragment.hpp.
#ifndef GNOMON_BACKEND_FRAGMENT_GLSL
#define GNOMON_BACKEND_FRAGMENT_GLSL

//     #version 450
//     #extension GL_GOOGLE_include_directive : require
//     #include <gnomon/backend/fragment.glsl>
//     layout(std430, set = 1, binding = 0) readonly buffer Colors { vec4 colors[]; };
//     layout(push_constant) uniform Constants { layout(offset = 64) uint first; } c;
//     void main() { gn_color = colors[gn_triangle - c.first]; }

layout(early_fragment_tests) in;

layout(location = 1) flat in uint gn_triangle;
layout(location = 0) out vec4 gn_color;

#define gn_pixel uvec2(gl_FragCoord.xy)

#endif  // GNOMON_BACKEND_FRAGMENT_GLSL
