#version 450
#extension GL_GOOGLE_include_directive : require
// The ray's formulas for ray_parity.test.cpp: 20 words in (corners, start, end, eye, flags), 4 out.
#include <gnomon/trace/formula/own_plane.glsl>
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Inputs { uvec4 inputs[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Outputs { uint outputs[]; };
layout(push_constant) uniform Push { uint count; };

vec3 renamed(GnRay ray, vec3 p) {
    return vec3(gn_component(p, ray.axis_x), gn_component(p, ray.axis_y), gn_component(p, ray.axis_z));
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    uvec4 w[5] = uvec4[](inputs[5u * i], inputs[5u * i + 1u], inputs[5u * i + 2u], inputs[5u * i + 3u], inputs[5u * i + 4u]);
    vec3 a = uintBitsToFloat(w[0].xyz);
    vec3 b = uintBitsToFloat(uvec3(w[0].w, w[1].xy));
    vec3 c = uintBitsToFloat(uvec3(w[1].zw, w[2].x));
    vec3 start = uintBitsToFloat(w[2].yzw);
    vec3 end = uintBitsToFloat(w[3].xyz);
    vec3 eye = uintBitsToFloat(uvec3(w[3].w, w[4].xy));
    bool end_is_point = w[4].z != 0u;
    end = end_is_point ? end : gn_scaled(end);
    GnRay ray = gn_make_ray(start, end, end_is_point);
    GnMeeting meeting = gn_meet(ray, renamed(ray, a), renamed(ray, b), renamed(ray, c));
    vec3 lo = gn_in_frame(ray, renamed(ray, min(min(a, b), c)));
    vec3 hi = gn_in_frame(ray, renamed(ray, max(max(a, b), c)));
    bvec3 mirrored = lessThan(ray.sign, vec3(0.0));
    outputs[4u * i] = ray.usable ? uint(meeting.answer) : 2u;
    outputs[4u * i + 1u] = !ray.usable || gn_may_touch(ray, mix(lo, hi, mirrored), mix(hi, lo, mirrored)) ? 1u : 0u;
    outputs[4u * i + 2u] = uint(gn_turned_away(gn_plane_side(a, b, c, eye, true), gn_plane_side(a, b, c, end, end_is_point)));
    outputs[4u * i + 3u] = floatBitsToUint(meeting.bound);
}
