#version 450
// A triangle of an integer pass: corners rounded to 1/256 texel and 1/256 depth unit of an absolute light space, its
// plane, and where it lies in a viewport that is so large, and whose side is a power of two, that nothing is rounded
// again and nothing clipped.
#extension GL_GOOGLE_include_directive : require
#extension GL_ARB_gpu_shader_int64 : require

#include "ortho_interface.glsl"
#include "ortho_exact.glsl"

layout(set = 0, binding = 1, std430) readonly buffer Items { Item items[]; };
layout(set = 0, binding = 3, std430) readonly buffer Coordinates { vec2 coordinates[]; };
layout(set = 0, binding = 6, std430) readonly buffer Positions { float positions[]; };
layout(set = 0, binding = 7, std430) readonly buffer Indices { uint indices[]; };

layout(constant_id = 0) const bool is_masked = false;
layout(constant_id = 1) const uint part = all_triangles;

// Doubles in pairs, as every device can pass them on.
layout(location = 0) flat out uvec4 xy_0;
layout(location = 1) flat out uvec4 xy_1;
layout(location = 2) flat out uvec4 xy_2;
layout(location = 3) flat out uvec4 z_and_slope;
layout(location = 4) flat out uvec4 slope_and_area;
layout(location = 5) flat out vec4 uv_01;
layout(location = 6) flat out vec2 uv_2;
layout(location = 7) flat out uvec2 kind_and_item;

uvec4 packed(double a, double b) { return uvec4(unpackDouble2x32(a), unpackDouble2x32(b)); }

double along(dvec4 axis, dvec3 p) {
    precise double sum = (axis.x * p.x + axis.y * p.y) + axis.z * p.z;
    precise double units = sum * axis.w;
    return units;
}

/// returns: false for what the CPU leaves out: NaN, infinities, and what is too far.
bool find_corner(Light light, uint at, out dvec3 corner) {
    vec3 position = vec3(positions[3u * at], positions[3u * at + 1u], positions[3u * at + 2u]);
    precise dvec3 world = light.origin_m.xyz + dvec3(position);
    dvec3 units = dvec3(along(light.right, world), along(light.down, world), along(light.away, world));
    corner = dvec3(rounded(units.x), rounded(units.y), rounded(units.z)) - light.image.xyz;
    bvec3 infinite = equal(floatBitsToUint(position) & 0x7F800000u, uvec3(0x7F800000u));
    return !any(infinite) && all(lessThanEqual(abs(units), dvec3(1125899906842624.0LF))) &&
           all(lessThanEqual(abs(corner), dvec3(1099511627776.0LF)));
}

/// Twice the area, positive when clockwise as looked at.
double area_of(dvec3 corner[3], bool is_far) {
    dvec2 a = corner[1].xy - corner[0].xy;
    dvec2 b = corner[2].xy - corner[0].xy;
    if (is_far) return wide_to_double(wide_cross(a.x, b.y, a.y, b.x));
    return a.x * b.y - a.y * b.x;
}

/// Where the corner of the viewport is that is nothing's.
const vec4 nowhere = vec4(2.0, 2.0, 0.5, 1.0);

/// A place in clip space, from units of the image.
vec4 place(vec2 from_centre, float depth) { return vec4(from_centre * push.per_unit, depth, 1.0); }

/// The depth that the device is to interpolate, from units above the nearest code.
float depth_of(double units) {
    double last = lights[push.light].origin_m.w * 256.0LF;
    return float(((push.flags & is_reversed) != 0u ? last - units : units) / last);
}

/// Whether depths that a device interpolates in float are a sixteenth of a code off at most. With e = 2^-24 it has
/// corners of 2^17 codes to e, slopes to some 8 e (1 + 2 q) of `steep`, q being the square of the triangle's size over
/// its area, and sums their products with how far pixels are from the image's corner and from the triangle's.
bool is_gentle(dvec3 corner[3], double size, double area) {
    double low = min(min(corner[0].z, corner[1].z), corner[2].z);
    double high = max(max(corner[0].z, corner[1].z), corner[2].z);
    dvec2 from = max(max(abs(corner[0].xy), abs(corner[1].xy)), abs(corner[2].xy));
    double steep = (high - low) * size;  // over the area: codes a texel
    double reach = max(from.x, from.y) + size;
    return max(abs(low), abs(high)) <= 33554432.0LF && steep * reach <= gentle_units * area &&
           steep * size * (area + 2.0LF * size * size) <= gentle_units * area * area;
}

/// The pixels whose centres the bounds hold, in the area.
ivec4 pixels_of(dvec2 low, dvec2 high) {
    dvec4 area = dvec4(push.area_px);
    dvec2 first = max(floor((low + 127.0LF) * 0.00390625LF), area.xy);
    dvec2 last = min(floor((high - 129.0LF) * 0.00390625LF), area.zw - 1.0LF);
    if (first.x > last.x || first.y > last.y) return ivec4(0, 0, -1, -1);
    return ivec4(ivec2(first), ivec2(last));
}

/// A triangle whose lower left half is the pixels and a rim of two.
vec4 cover(ivec4 pixels, uint k) {
    vec2 at = vec2(pixels.xy - push.centre_px) - 2.0;
    vec2 size = vec2(pixels.zw - pixels.xy) + 5.0;
    if (k == 1u) at.x += 2.0 * size.x;
    if (k == 2u) at.y += 2.0 * size.y;
    return place(at * 256.0, 0.5);
}

vec4 place_of(dvec3 corner[3], dvec2 size, uint k, ivec4 pixels, out uint kind) {
    dvec2 middle = dvec2(push.centre_px * 256);
    dvec2 out_most = max(max(abs(corner[0].xy - middle), abs(corner[1].xy - middle)), abs(corner[2].xy - middle));
    bool is_near = max(out_most.x, out_most.y) <= double(push.most_units) && max(size.x, size.y) <= double(push.most_size);
    kind = is_near ? by_device : by_cover;
    if (is_near) return place(vec2(corner[k].xy - middle), part == gentle_triangles ? depth_of(corner[k].z) : 0.5);
    return cover(pixels, k);
}

void main() {
    uint item_at = uint(gl_InstanceIndex);
    Item item = items[item_at];
    Light light = lights[push.light];
    uint k = uint(gl_VertexIndex) % 3u;
    uint at[3];
    dvec3 corner[3];
    bool is_sound = true;
    for (uint i = 0u; i < 3u; ++i) {
        at[i] = indices[item.first_index + uint(gl_VertexIndex) - k + i] + item.first_position;
        is_sound = find_corner(light, at[i], corner[i]) && is_sound;
    }
    gl_Position = nowhere;
    if (!is_sound) return;
    dvec2 low = min(min(corner[0].xy, corner[1].xy), corner[2].xy);
    dvec2 high = max(max(corner[0].xy, corner[1].xy), corner[2].xy);
    dvec2 size = high - low;
    bool is_far = max(size.x, size.y) > 33554432.0LF;  // 2^25: else all edge functions in the bounds are below 2^52
    double area = area_of(corner, is_far);
    ivec4 pixels = pixels_of(low, high);
    bool is_culled = (push.cull == 1u && area > 0.0LF) || (push.cull == 2u && area < 0.0LF);
    if (area == 0.0LF || is_culled || pixels.x > pixels.z) return;

    uint kind;
    gl_Position = place_of(corner, size, k, pixels, kind);
    if (part != all_triangles) {
        bool gentle = kind == by_device && is_gentle(corner, max(size.x, size.y), abs(area));
        if (gentle != (part == gentle_triangles)) gl_Position = nowhere;
    }
    kind_and_item = uvec2(is_far ? by_far_cover : kind, item_at);
    // Turned so that the area is positive.
    bool turned = area < 0.0LF;
    dvec3 second = turned ? corner[2] : corner[1];
    dvec3 third = turned ? corner[1] : corner[2];
    area = abs(area);
    xy_0 = packed(corner[0].x, corner[0].y);
    xy_1 = packed(second.x, second.y);
    xy_2 = packed(third.x, third.y);
    z_and_slope = packed(corner[0].z, quotient(second.z - corner[0].z, area));
    slope_and_area = packed(quotient(third.z - corner[0].z, area), is_masked ? quotient(1.0LF, area) : 0.0LF);
    if (!is_masked || item.alpha == none) return;
    uv_01 = vec4(coordinates[at[0] + item.uv_shift], coordinates[at[turned ? 2 : 1] + item.uv_shift]);
    uv_2 = coordinates[at[turned ? 1 : 2] + item.uv_shift];
}
