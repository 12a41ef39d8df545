// The fragment shader of a pass: alpha test, triangle id, depth where the device cannot clamp it.

#include "pass_interface.glsl"

layout(set = 0, binding = 4, std430) readonly buffer AlphaTests { AlphaTest alpha_tests[]; };
layout(set = 0, binding = 5, std430) readonly buffer Texels { uint texels[]; };

layout(constant_id = 0) const bool is_masked = false;
layout(constant_id = 2) const bool is_unorm16 = false;

layout(location = 0) in vec2 uv;
layout(location = 1) flat in uint triangle;
layout(location = 2) flat in uint alpha;
layout(location = 3) in float depth_times_w;
#ifdef GNOMON_IDS
layout(location = 0) out uint id;
#endif

const uint repeat = 0u;
const uint clamped = 1u;

/// The tap of math::make_tap: first texel, weight of the second.
void make_tap(float u, int size, uint wrap, out ivec2 at, out float weight) {
    float reduced = u >= 0.0 && u < 1.0 ? u : u - floor(u);
    if (wrap == clamped) reduced = clamp(u, 0.0, 1.0);
    if (wrap > clamped) reduced = u - 2.0 * floor(u * 0.5);
    if (!(reduced >= 0.0 && reduced <= 2.0)) reduced = 0.0;
    float place = reduced * float(size) - 0.5;
    float low = floor(place);
    weight = place - low;
    at = ivec2(int(low), int(low) + 1);
    for (int i = 0; i < 2; ++i) {
        if (wrap == repeat) at[i] = at[i] < 0 ? size - 1 : at[i] < size ? at[i] : 0;
        else if (wrap == clamped) at[i] = at[i] < 0 ? 0 : at[i] < size ? at[i] : size - 1;
        else at[i] = at[i] < 0 ? 0 : at[i] < size ? at[i] : at[i] < 2 * size ? 2 * size - 1 - at[i] : 0;
    }
}

float texel(AlphaTest test, int column, int row) {
    uint at = test.first_texel + uint(row) * uint(test.width) + uint(column);
    return float((texels[at >> 2] >> ((at & 3u) * 8u)) & 255u);
}

/// math::alpha_at times 255; a constant alpha comes out as it is.
bool passes(AlphaTest test) {
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

#ifdef GNOMON_CLAMP
/// The depth that the fixed functions would give, with their bias: constant in units of the format, slope of the plane.
float biased_depth() {
    float depth = depth_times_w * gl_FragCoord.w;
    float unit = is_unorm16 ? 1.0 / 65536.0 : uintBitsToFloat(max(floatBitsToUint(abs(depth)) & 0x7F800000u, 0x0C000000u) - 0x0B800000u);
    if (push.bias_constant != 0.0 || push.bias_slope != 0.0)
        depth += unit * push.bias_constant + push.bias_slope * max(abs(dFdx(depth)), abs(dFdy(depth)));
    return clamp(depth, 0.0, 1.0);
}
#endif

void main() {
#ifdef GNOMON_CLAMP
    gl_FragDepth = biased_depth();
#endif
    if (is_masked && alpha != none && !passes(alpha_tests[alpha])) discard;
#if defined(GNOMON_IDS) && defined(GNOMON_PULLED)
    id = triangle;
#elif defined(GNOMON_IDS)
    id = triangle + uint(gl_PrimitiveID);
#endif
}
