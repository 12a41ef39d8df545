// Whether each sample sees the light: the GLSL half of `ray`. kernels.hpp has the layout, trace/filter.hpp the same
// walk in C++. What the filter cannot decide is unsure, and decided exactly by whoever asked.

#version 450
#extension GL_GOOGLE_include_directive : require

#include <gnomon/backend/item.glsl>
#include <gnomon/trace/formula/mask.glsl>
#include <gnomon/trace/formula/own_plane.glsl>

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer Nodes { uvec4 nodes[]; };    // 8 rows each: lo, hi, children
layout(std430, set = 0, binding = 1) readonly buffer Blocks { uvec4 blocks[]; };  // 10 rows each: corners, ids
layout(std430, set = 0, binding = 2) readonly buffer Positions { float positions[]; };
layout(std430, set = 0, binding = 3) readonly buffer Corners { uint corners[]; };
layout(std430, set = 0, binding = 4) readonly buffer Samples { uvec4 samples[]; };  // triangle, position
layout(std430, set = 0, binding = 5) readonly buffer Reached { uint reached[]; };
layout(std430, set = 0, binding = 6) readonly buffer MaterialOf { uint material_of[]; };
layout(std430, set = 0, binding = 7) readonly buffer Materials { uvec4 materials[]; };
layout(std430, set = 0, binding = 8) readonly buffer Textures { uvec4 textures[]; };
layout(std430, set = 0, binding = 9) readonly buffer Texels { uint texels[]; };
layout(std430, set = 0, binding = 10) readonly buffer CornerUv { vec2 corner_uv[]; };
layout(std430, set = 0, binding = 11) writeonly buffer Answers { uint answers[]; };

layout(push_constant) uniform Constants {
    uint count;
    uint node_count;
    uint position_count;
    uint triangle_count;
    float light_x, light_y, light_z;
    uint light_at_infinity;
    float eye_x, eye_y, eye_z;
    uint eye_at_infinity;
    uint masked;
    uint material_of_count;
    uint material_count;
    uint texture_count;
    uint corner_uv_count;
} c;

// trace::Child and core::TriangleId.
const uint none = 0xFFFFFFFFu;
const uint block_flag = 0x80000000u;
// trace::filter_stack.
const uint stack_size = 64u;

// What may be `free`, `blocked` or `unsure` is 0, 1 or 2, as in the formulas.

uint code_at(uvec4 texture_info, int column, int row) {
    uint channels = texture_info.w >> 16;
    uint at = texture_info.x + (uint(row) * texture_info.y + uint(column) + 1u) * channels - 1u;
    return texels[at >> 2] >> ((at & 3u) * 8u) & 0xFFu;
}

int solid_in_texture(uvec4 material, uvec4 info, uint triangle, GnMeeting meeting) {
    uint at = triangle * 3u;
    if (at + 2u >= c.corner_uv_count) return 2;
    vec2 uv_a = corner_uv[at];
    vec2 uv_b = corner_uv[at + 1u];
    vec2 uv_c = corner_uv[at + 2u];
    vec3 values = vec3(uintBitsToFloat(material.y), uintBitsToFloat(material.z), 0.0);
    if (!gn_in_range(vec3(uv_a.x, uv_b.x, uv_c.x)) || !gn_in_range(vec3(uv_a.y, uv_b.y, uv_c.y)) ||
        !gn_in_range(values))
        return 2;
    GnShares shares = gn_shares(meeting);
    if (!shares.usable) return 2;
    GnTap u = gn_tap(gn_coordinate(shares, uv_a.x, uv_b.x, uv_c.x), int(info.y), int(info.w & 0xFFu));
    GnTap v = gn_tap(gn_coordinate(shares, uv_a.y, uv_b.y, uv_c.y), int(info.z), int(info.w >> 8 & 0xFFu));
    vec4 codes = vec4(code_at(info, u.first, v.first), code_at(info, u.second, v.first),
                      code_at(info, u.first, v.second), code_at(info, u.second, v.second));
    return gn_solid(codes, u, v, values.x, values.y);
}

/// Whether the triangle is solid where the segment passes it.
int solid_at(uint triangle, GnMeeting meeting) {
    if (c.masked == 0u || triangle >= c.material_of_count || material_of[triangle] >= c.material_count) return 1;
    uvec4 material = materials[material_of[triangle]];
    if (material.x == 0u) return 1;
    bool textured = material.w < c.texture_count && textures[min(material.w, c.texture_count - 1u)].z != 0u;
    if (!textured) return gn_at_least(uintBitsToFloat(material.y), uintBitsToFloat(material.z));
    return solid_in_texture(material, textures[material.w], triangle, meeting);
}

/// In the frame's order of axes.
vec3 block_corner(GnRay ray, uint block, uint corner, uint lane) {
    uint row = block * 10u + corner * 3u;
    return uintBitsToFloat(uvec3(blocks[row + uint(ray.axis_x)][lane], blocks[row + uint(ray.axis_y)][lane],
                                 blocks[row + uint(ray.axis_z)][lane]));
}

int meet_lane(GnRay ray, uint block, uint lane, uint own) {
    uint id = blocks[block * 10u + 9u][lane];
    if (id == none || id == own) return 0;
    GnMeeting meeting = gn_meet(ray, block_corner(ray, block, 0u, lane), block_corner(ray, block, 1u, lane),
                                block_corner(ray, block, 2u, lane));
    if (meeting.answer == 0) return 0;
    int solid = solid_at(id, meeting);
    return solid == 1 ? meeting.answer : solid;
}

/// Whether the segment may touch the box in a node's lane. Along a mirrored axis the box begins at hi.
bool touches(GnRay ray, uint row, uint lane) {
    ivec3 axis = ivec3(ray.axis_x, ray.axis_y, ray.axis_z);
    bvec3 mirrored = lessThan(ray.sign, vec3(0.0));
    uvec3 lo_row = row + uvec3(axis + mix(ivec3(0), ivec3(3), mirrored));
    uvec3 hi_row = row + uvec3(axis + mix(ivec3(3), ivec3(0), mirrored));
    vec3 lo = uintBitsToFloat(uvec3(nodes[lo_row.x][lane], nodes[lo_row.y][lane], nodes[lo_row.z][lane]));
    vec3 hi = uintBitsToFloat(uvec3(nodes[hi_row.x][lane], nodes[hi_row.y][lane], nodes[hi_row.z][lane]));
    return gn_may_touch(ray, gn_in_frame(ray, lo), gn_in_frame(ray, hi));
}

/// Whether the filter may be asked about all that is in the hierarchy.
bool root_in_range() {
    bool all_in = true;
    for (uint lane = 0u; lane < 4u; ++lane) {
        vec3 lo = uintBitsToFloat(uvec3(nodes[0][lane], nodes[1][lane], nodes[2][lane]));
        vec3 hi = uintBitsToFloat(uvec3(nodes[3][lane], nodes[4][lane], nodes[5][lane]));
        all_in = all_in && (nodes[6][lane] == none || (gn_in_range(lo) && gn_in_range(hi)));
    }
    return all_in;
}

/// Whether anything but `own` blocks the segment.
int blocked_by_any(GnRay ray, uint own) {
    if (!root_in_range()) return 2;
    uint stack[stack_size];
    uint size = 1u;
    stack[0] = 0u;
    bool unsure = false;
    while (size != 0u) {
        uint at = stack[--size];
        if ((at & block_flag) != 0u) {
            for (uint lane = 0u; lane < 4u; ++lane) {
                int met = meet_lane(ray, at & ~block_flag, lane, own);
                if (met == 1) return 1;
                unsure = unsure || met == 2;
            }
            continue;
        }
        uvec4 children = nodes[at * 8u + 6u];
        for (uint lane = 0u; lane < 4u; ++lane) {
            if (children[lane] == none || !touches(ray, at * 8u, lane)) continue;
            if (size == stack_size)
                unsure = true;
            else
                stack[size++] = children[lane];
        }
    }
    return unsure ? 2 : 0;
}

vec3 position_at(uint i) { return vec3(positions[3u * i], positions[3u * i + 1u], positions[3u * i + 2u]); }

/// Whether the sample's own plane has eye and light on opposite sides: then it is in shadow.
int turned_away(uint triangle, vec3 eye, vec3 light) {
    if (triangle >= c.triangle_count) return 2;
    uvec3 at = uvec3(corners[3u * triangle], corners[3u * triangle + 1u], corners[3u * triangle + 2u]);
    if (any(greaterThanEqual(at, uvec3(c.position_count)))) return 2;
    vec3 p = position_at(at.x);
    vec3 q = position_at(at.y);
    vec3 r = position_at(at.z);
    if (!gn_in_range(p) || !gn_in_range(q) || !gn_in_range(r)) return 2;
    return gn_turned_away(gn_plane_side(p, q, r, eye, c.eye_at_infinity == 0u),
                          gn_plane_side(p, q, r, light, c.light_at_infinity == 0u));
}

/// RayAnswer: 0 in shadow, 1 lit, 2 unsure.
uint answer_of(uint i) {
    if ((reached[i >> 2] >> ((i & 3u) * 8u) & 0xFFu) == 0u) return 0u;
    uint own = samples[i].x;
    vec3 start = uintBitsToFloat(samples[i].yzw);
    vec3 light = vec3(c.light_x, c.light_y, c.light_z);
    vec3 eye = vec3(c.eye_x, c.eye_y, c.eye_z);
    bool light_is_point = c.light_at_infinity == 0u;
    bool eye_is_point = c.eye_at_infinity == 0u;
    if (own == none) return 1u;
    if (!gn_in_range(start) || (light_is_point && !gn_in_range(light)) || (eye_is_point && !gn_in_range(eye)))
        return 2u;
    light = light_is_point ? light : gn_scaled(light);
    eye = eye_is_point ? eye : gn_scaled(eye);
    int away = turned_away(own, eye, light);
    if (away == 1) return 0u;
    GnRay ray = gn_make_ray(start, light, light_is_point);
    if (!ray.usable) return 2u;
    int blocked = c.node_count == 0u ? 0 : blocked_by_any(ray, own);
    if (blocked == 1) return 0u;
    return blocked == 2 || away == 2 ? 2u : 1u;
}

void main() {
    uint i = GNOMON_ITEM;
    if (i < c.count) answers[i] = answer_of(i);
}
