#version 450
// A box of an occlusion query, its corners in the order of math::corner and raster::box_indices.

layout(push_constant) uniform Push {
    vec4 column[4];  // clip_from_relative
    vec3 origin;
    float unused;
    vec3 lo;
    vec3 hi;
} push;

layout(constant_id = 1) const bool clamps_in_shader = false;

layout(location = 0) out float depth_times_w;

const uint corners[36] = uint[36](0u, 4u, 6u, 0u, 6u, 2u, 1u, 3u, 7u, 1u, 7u, 5u, 0u, 1u, 5u, 0u, 5u, 4u,
                                  2u, 6u, 7u, 2u, 7u, 3u, 0u, 2u, 3u, 0u, 3u, 1u, 4u, 5u, 7u, 4u, 7u, 6u);

void main() {
    uint corner = corners[gl_VertexIndex];
    vec3 position = mix(push.lo, push.hi, bvec3((corner & 1u) != 0u, (corner & 2u) != 0u, (corner & 4u) != 0u));
    position -= push.origin;
    vec4 clip = ((push.column[0] * position.x + push.column[1] * position.y) + push.column[2] * position.z) + push.column[3];
    if (!all(lessThanEqual(abs(clip), vec4(1.152921504606846976e18)))) clip = uintBitsToFloat(uvec4(0x7FC00000u));
    depth_times_w = clip.z;
    if (clamps_in_shader) clip.z = 0.0;
    gl_Position = clip;
}
