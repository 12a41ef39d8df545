// A sample of an integer pass: the alpha test, and its code by the plane through the corners, as the CPU rounds it, unless
// the device is to find it.

#include "ortho_interface.glsl"
#include "ortho_exact.glsl"

layout(set = 0, binding = 1, std430) readonly buffer Items { Item items[]; };
layout(set = 0, binding = 4, std430) readonly buffer AlphaTests { AlphaTest alpha_tests[]; };
layout(set = 0, binding = 5, std430) readonly buffer Texels { uint texels[]; };

#define REAL double
#include "pass_tap.glsl"

layout(constant_id = 0) const bool is_masked = false;

layout(location = 0) flat in uvec4 xy_0;
layout(location = 1) flat in uvec4 xy_1;
layout(location = 2) flat in uvec4 xy_2;
layout(location = 3) flat in uvec4 z_and_slope;
layout(location = 4) flat in uvec4 slope_and_area;
layout(location = 5) flat in vec4 uv_01;
layout(location = 6) flat in vec2 uv_2;
layout(location = 7) flat in uvec2 kind_and_item;

dvec2 unpacked(uvec4 pair) { return dvec2(packDouble2x32(pair.xy), packDouble2x32(pair.zw)); }

/// The edge function of the edge from a to b, at p; positive inside.
double edge(dvec2 a, dvec2 b, dvec2 p) {
    precise double e = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    return e;
}

Wide far_edge(dvec2 a, dvec2 b, dvec2 p) { return wide_cross(b.x - a.x, p.y - a.y, b.y - a.y, p.x - a.x); }

/// The top-left rule, from the sign of an edge function.
bool is_inside(int sign, dvec2 a, dvec2 b) {
    dvec2 d = b - a;
    return sign > 0 || (sign == 0 && (d.y < 0.0LF || (d.y == 0.0LF && d.x > 0.0LF)));
}

/// The edge functions opposite to the second and the third corner, and whether the sample is covered.
bool find_edges(out double edge_20, out double edge_01) {
    dvec2 a = unpacked(xy_0);
    dvec2 b = unpacked(xy_1);
    dvec2 c = unpacked(xy_2);
    dvec2 p = dvec2(ivec2(gl_FragCoord.xy) * 256 + 128);
    if (kind_and_item.x == by_far_cover) {
        Wide ca = far_edge(c, a, p);
        Wide ab = far_edge(a, b, p);
        edge_20 = wide_to_double(ca);
        edge_01 = wide_to_double(ab);
        return is_inside(sign_of(ca), c, a) && is_inside(sign_of(ab), a, b) && is_inside(sign_of(far_edge(b, c, p)), b, c);
    }
    edge_20 = edge(c, a, p);
    edge_01 = edge(a, b, p);
    if (kind_and_item.x == by_device) return true;
    return is_inside(int(sign(edge_20)), c, a) && is_inside(int(sign(edge_01)), a, b) &&
           is_inside(int(sign(edge(b, c, p))), b, c);
}

/// The CPU's alpha test: coordinates by the weights of the depth, bilinear alpha.
bool passes(AlphaTest test, double edge_20, double edge_01) {
    double per_area = unpacked(slope_and_area).y;
    precise double b1 = edge_20 * per_area;
    precise double b2 = edge_01 * per_area;
    dvec2 uv0 = dvec2(uv_01.xy);
    precise dvec2 at = uv0 + ((dvec2(uv_01.zw) - uv0) * b1 + (dvec2(uv_2) - uv0) * b2);
    ivec2 x;
    ivec2 y;
    double weight_x;
    double weight_y;
    make_tap(at.x, test.width, test.wrap_u, x, weight_x);
    make_tap(at.y, test.height, test.wrap_v, y, weight_y);
    precise double top = texel(test, x[0], y[0]) * (1.0LF - weight_x) + texel(test, x[1], y[0]) * weight_x;
    precise double bottom = texel(test, x[0], y[1]) * (1.0LF - weight_x) + texel(test, x[1], y[1]) * weight_x;
    precise double alpha = top * (1.0LF - weight_y) + bottom * weight_y;
    return alpha >= packDouble2x32(test.least_exact);
}

#ifndef GNOMON_DEPTH_BY_DEVICE
float depth_of(double edge_20, double edge_01) {
    dvec2 z = unpacked(z_and_slope);
    precise double sum = edge_20 * z.y + edge_01 * unpacked(slope_and_area).x;
    precise double places = ((z.x + rounded(sum)) + 0.5LF) * 0.00390625LF;  // halves up: never a tie
    double code = rounded(places);
    double last = lights[push.light].origin_m.w;
    if ((push.flags & clips_range) != 0u && (code < 0.0LF || code > last)) discard;
    code = clamp(code, 0.0LF, last);
    if ((push.flags & is_reversed) != 0u) code = last - code;
    return float(code) * push.per_code;
}
#endif

void main() {
    double edge_20;
    double edge_01;
    if (!find_edges(edge_20, edge_01)) discard;
    if (is_masked) {
        uint alpha = items[kind_and_item.y].alpha;
        if (alpha != none && !passes(alpha_tests[alpha], edge_20, edge_01)) discard;
    }
#ifndef GNOMON_DEPTH_BY_DEVICE
    gl_FragDepth = depth_of(edge_20, edge_01);
#endif
}
