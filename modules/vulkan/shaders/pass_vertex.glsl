// The vertex shader of a pass.

#include "pass_interface.glsl"
#include "pass_corner.glsl"

layout(set = 0, binding = 3, std430) readonly buffer Coordinates { vec2 coordinates[]; };
#ifdef GNOMON_PULLED
layout(set = 0, binding = 6, std430) readonly buffer Positions { float positions[]; };
layout(set = 0, binding = 7, std430) readonly buffer Indices { uint indices[]; };
#else
layout(location = 0) in vec3 position_in;
#endif

layout(constant_id = 0) const bool is_masked = false;
layout(constant_id = 1) const bool clamps_in_shader = false;

#ifdef GNOMON_SHADED
vec2 uv;
uint slot;
float depth_times_w;
#else
layout(location = 0) out vec2 uv;
layout(location = 2) flat out uint slot;
layout(location = 3) out float depth_times_w;
#endif
layout(location = 1) flat out uint triangle;  // Of the item's first triangle; of this one where corners are pulled.
#ifdef GNOMON_GEOMETRY
layout(location = 4) flat out uint layer;
#endif

void main() {
    slot = uint(gl_InstanceIndex);
    Item item = items[slot / push.layers];
    uint view = push.first_view + slot % push.layers;
#ifdef GNOMON_PULLED
    uint corner = indices[item.first_index + uint(gl_VertexIndex)] + item.first_position;
    vec3 position = vec3(positions[3u * corner], positions[3u * corner + 1u], positions[3u * corner + 2u]);
    triangle = item.first_triangle + uint(gl_VertexIndex) / 3u;
#else
    uint corner = uint(gl_VertexIndex);
    vec3 position = position_in;
    triangle = item.first_triangle;
#endif
    vec4 clip = clip_of(item, view, position);
    // Corners that are NaN, infinite or beyond 2^60 take their triangle along.
    if (!all(lessThanEqual(abs(clip), vec4(1.152921504606846976e18)))) clip = uintBitsToFloat(uvec4(0x7FC00000u));
    if (all(equal(item.groups & views[view].groups, uvec2(0u)))) clip = vec4(2.0, 2.0, 0.0, 1.0);

    uv = is_masked && item.alpha != none ? coordinates[corner + item.uv_shift] : vec2(0.0);
    depth_times_w = clip.z;
    if (clamps_in_shader) clip.z = 0.0;
    gl_Position = clip;
#ifdef GNOMON_LAYER
    gl_Layer = int(views[view].layer);
#endif
#ifdef GNOMON_GEOMETRY
    layer = views[view].layer;
#endif
}
