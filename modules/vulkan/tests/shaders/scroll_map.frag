#version 450
// A scrolled map's texel, for write_depth.test.cpp.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require

layout(set = 0, binding = 0) uniform texture2DArray old_map;

float old_depth(int layer, int x, int y) { return texelFetch(old_map, ivec3(x, y, layer), 0).x; }

#define GN_TEXELS int
#define GN_TEXEL(layer, x, y) old_depth(layer, x, y)

#include <gnomon/cascade/formula/scroll.glsl>

layout(push_constant) uniform Constants { GnScroll move; };

void main() { gl_FragDepth = gn_scrolled_texel(move, 0, int(gl_FragCoord.x), int(gl_FragCoord.y)); }
