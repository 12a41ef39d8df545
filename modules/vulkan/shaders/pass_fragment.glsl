// The fragment shader of a pass: alpha test, triangle id, depth where the device cannot clamp it.

#include "pass_interface.glsl"

layout(set = 0, binding = 4, std430) readonly buffer AlphaTests { AlphaTest alpha_tests[]; };
layout(set = 0, binding = 5, std430) readonly buffer Texels { uint texels[]; };

layout(constant_id = 0) const bool is_masked = false;
layout(constant_id = 2) const bool is_unorm16 = false;

layout(location = 0) in vec2 uv;
layout(location = 1) flat in uint triangle;
layout(location = 2) flat in uint slot;
layout(location = 3) in float depth_times_w;
#ifdef GNOMON_IDS
layout(location = 0) out uint id;
#endif

#ifdef GNOMON_EXACT
#include "pass_alpha_exact.glsl"
#else
#include "pass_alpha.glsl"
#endif

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
    if (is_masked) {
        Item item = items[slot / push.layers];
        if (item.alpha != none && !passes(alpha_tests[item.alpha], item)) discard;
    }
#if defined(GNOMON_IDS) && defined(GNOMON_PULLED)
    id = triangle;
#elif defined(GNOMON_IDS)
    id = triangle + uint(gl_PrimitiveID);
#endif
}
