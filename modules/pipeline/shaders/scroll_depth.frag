// A scrolled map's texel: the GLSL half of `scroll_depth`. cascade_shadows.hpp has the layout.

#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require

layout(set = 0, binding = 0) uniform texture2DArray old_map;

float old_depth(int layer, int x, int y) { return texelFetch(old_map, ivec3(x, y, layer), 0).x; }

#define GN_TEXELS int
#define GN_TEXEL(layer, x, y) old_depth(layer, x, y)

#include <gnomon/cascade/formula/scroll.glsl>

layout(push_constant) uniform Constants { GnScroll move; } c;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    gl_FragDepth = gn_scrolled_texel(c.move, 0, at.x, at.y);
}
