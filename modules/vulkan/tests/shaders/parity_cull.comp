#version 450
#extension GL_GOOGLE_include_directive : require
// Tests of shapes against boxes, planes and clusters, for parity_cull.test.cpp: 45 words in, 32 words out.
#include <gnomon/bvh/formula/code.glsl>
#include <gnomon/cull/formula/cell.glsl>
#include <gnomon/cull/formula/normal_cone.glsl>
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Inputs { float inputs[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Outputs { uint outputs[]; };
layout(push_constant) uniform Push { uint count; };

vec3 at(uint from) { return vec3(inputs[from], inputs[from + 1u], inputs[from + 2u]); }

void put(uint to, float x, float y, float z) {
    outputs[to] = floatBitsToUint(x);
    outputs[to + 1u] = floatBitsToUint(y);
    outputs[to + 2u] = floatBitsToUint(z);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    uint f = i * 45u;
    GnSphere ball = GnSphere(at(f), inputs[f + 3u]);
    GnSector cone = GnSector(at(f), inputs[f + 3u], at(f + 4u), inputs[f + 7u], inputs[f + 8u]);
    GnCell cell = GnCell(inputs[f + 9u], inputs[f + 10u], inputs[f + 11u], inputs[f + 12u], inputs[f + 13u], inputs[f + 14u]);
    GnBox box = GnBox(at(f + 15u), at(f + 18u));
    GnCrate crate = GnCrate(at(f), at(f + 21u), at(f + 24u), at(f + 27u));
    GnNormalCone normals = GnNormalCone(at(f + 30u), inputs[f + 33u], inputs[f + 34u]);
    GnPlane plane = GnPlane(at(f + 35u), inputs[f + 38u], at(f + 39u), inputs[f + 42u]);
    GnSphere other = GnSphere(at(f + 18u), inputs[f + 43u]);
    uint o = i * 32u;
    bool flags[16] = bool[16](gn_touches_sphere_cell(ball, cell, true), gn_touches_sphere_cell(ball, cell, false),
                              gn_touches_sector_cell(cone, cell, true, 2), gn_touches_sector_cell(cone, cell, false, 2),
                              gn_touches_crate_cell(crate, cell, true), gn_touches_box_cell(box, cell, true),
                              gn_touches_sphere_box(ball.center, gn_touch_limit(ball.radius), box),
                              gn_touches_sphere_sphere(ball.center, ball.radius, other), gn_touches_plane_box(plane, box),
                              gn_touches_plane_sphere(plane, ball), gn_touches_plane_sector(plane, cone),
                              gn_touches_plane_crate(plane, crate), gn_touches_sector_box(cone, box),
                              gn_touches_sector_sphere(cone, other), gn_touches_crate_box(crate, box),
                              gn_may_face(normals, other, ball.center));
    for (uint k = 0u; k < 16u; ++k) outputs[o + k] = uint(flags[k]);
    GnBox around = gn_box_of(ball);
    put(o + 16u, around.lo.x, around.hi.y, gn_reach_of_sector(cone, normals.axis).value);
    vec3 near_cell = gn_nearest_of_cell(cell, ball.center, true);
    put(o + 19u, near_cell.x, near_cell.y, near_cell.z);
    vec3 near_cone = gn_nearest_of_sector(cone, other.center);
    put(o + 22u, near_cone.x, near_cone.y, near_cone.z);
    vec3 direction = gn_direction(ball.center - other.center);
    put(o + 25u, direction.x, direction.y, gn_reach_of_cell(cell, direction, true).value);
    vec3 near_crate = gn_nearest_of_crate(crate, other.center);
    put(o + 28u, near_crate.x, near_crate.y, near_crate.z);
    vec3 scale = vec3(gn_code_scale(-50.0, 50.0, 1024.0), gn_code_scale(-5.0, inputs[f + 43u], 1024.0), gn_code_scale(1.0, 1.0, 1024.0));
    outputs[o + 31u] = gn_code_30(GnCodeGrid(vec3(-50.0, -5.0, 1.0), 1023.0, scale, 0u), ball.center);
}
