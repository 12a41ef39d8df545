// The alpha test in float, from interpolated coordinates and four texels.

#define REAL float
#include "pass_tap.glsl"

/// math::alpha_at times 255; a constant alpha comes out as it is.
bool passes(AlphaTest test, Item item) {
    ivec2 x;
    ivec2 y;
    vec2 weight;
    make_tap(uv.x, test.width, test.wrap_u, x, weight.x);
    make_tap(uv.y, test.height, test.wrap_v, y, weight.y);
    float top = texel(test, x[0], y[0]);
    top += (texel(test, x[1], y[0]) - top) * weight.x;
    float bottom = texel(test, x[0], y[1]);
    bottom += (texel(test, x[1], y[1]) - bottom) * weight.x;
    return top + (bottom - top) * weight.y >= test.least;
}
