// The alpha test as the CPU makes it: coordinates from the triangle's own clip coordinates at the pixel's centre, and the
// bilinear alpha, all in double.

#include "pass_corner.glsl"

#define REAL double
#include "pass_tap.glsl"

layout(set = 0, binding = 3, std430) readonly buffer Coordinates { vec2 coordinates[]; };
layout(set = 0, binding = 6, std430) readonly buffer Positions { float positions[]; };
layout(set = 0, binding = 7, std430) readonly buffer Indices { uint indices[]; };

/// The texture coordinates of the pixel's centre: corner i weighs as the others' cross product, seen from there.
dvec2 coordinates_here(Item item) {
    uint view = push.first_view + slot % push.layers;
    dvec3 corner[3];
    dvec2 uv_of[3];
    for (int k = 0; k < 3; ++k) {
        uint at = indices[item.first_index + 3u * uint(gl_PrimitiveID) + uint(k)] + item.first_position;
        vec4 clip = clip_of(item, view, vec3(positions[3u * at], positions[3u * at + 1u], positions[3u * at + 2u]));
        corner[k] = dvec3(clip.xyw);
        uv_of[k] = dvec2(coordinates[at + item.uv_shift]);
    }
    dvec2 here = (dvec2(gl_FragCoord.xy) - dvec2(push.viewport_px)) * (2.0LF / dvec2(push.viewport_size_px)) - 1.0LF;
    dvec3 sum = dvec3(0.0LF);
    for (int k = 0; k < 3; ++k) {
        dvec3 p = corner[(k + 1) % 3];
        dvec3 q = corner[(k + 2) % 3];
        double weight = (p.y * q.z - p.z * q.y) * here.x + (p.z * q.x - p.x * q.z) * here.y + (p.x * q.y - p.y * q.x);
        sum += weight * dvec3(uv_of[k], 1.0LF);
    }
    return sum.xy * (1.0LF / sum.z);
}

bool passes(AlphaTest test, Item item) {
    dvec2 at = coordinates_here(item);
    ivec2 x;
    ivec2 y;
    double weight_x;
    double weight_y;
    make_tap(at.x, test.width, test.wrap_u, x, weight_x);
    make_tap(at.y, test.height, test.wrap_v, y, weight_y);
    double top = texel(test, x[0], y[0]) * (1.0LF - weight_x) + texel(test, x[1], y[0]) * weight_x;
    double bottom = texel(test, x[0], y[1]) * (1.0LF - weight_x) + texel(test, x[1], y[1]) * weight_x;
    return top * (1.0LF - weight_y) + bottom * weight_y >= packDouble2x32(test.least_exact);
}
