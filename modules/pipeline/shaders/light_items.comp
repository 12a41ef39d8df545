// Which lights take part, and their balls for the tree: the GLSL half of `light_items`.

#version 450
#extension GL_GOOGLE_include_directive : require

#include <gnomon/lights/formula/assign.glsl>
#include <gnomon/math/formula/bits.glsl>

#include "device_state.glsl"
#include "gnomon/backend/item.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 0) readonly buffer Lights { GnLight lights[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Items { vec4 items[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Everywhere { uint everywhere[]; };
layout(std430, set = 0, binding = 3) buffer State { DeviceState state; };
layout(push_constant) uniform Constants {
    uint count;
    uint layers;
} c;

shared int least[6];
shared uint usable;

void add_light(uint i) {
    GnLight light = lights[i];
    items[i] = vec4(0.0, 0.0, 0.0, -1.0);
    if ((light.layers & c.layers) == 0u) {
        atomicAdd(state.masked, 1u);
        return;
    }
    if (light.kind == 2u) {
        everywhere[atomicAdd(state.everywhere, 1u)] = i;
        return;
    }
    bool sound = light.kind < 2u && gn_is_sound_ball(light.center, light.range_m);
    if (light.kind == 1u) sound = sound && gn_is_sound_cone(light.axis, light.cos_half, light.sin_half);
    if (!sound) {
        atomicAdd(state.bad, 1u);
        return;
    }
    items[i] = vec4(light.center, light.range_m);
    atomicAdd(usable, 1u);
    for (uint axis = 0u; axis < 3u; ++axis) {
        precise float half_center = light.center[axis] * 0.5;
        int place = gn_ordinal(half_center);
        atomicMin(least[axis], place);
        atomicMin(least[axis + 3u], -place);
    }
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    if (lane < 6u) least[lane] = 0x7FFFFFFF;
    if (lane == 6u) usable = 0u;
    barrier();
    uint i = GNOMON_ITEM;
    if (i < c.count) add_light(i);
    barrier();
    if (lane < 6u) atomicMin(state.places[lane], least[lane]);
    if (lane == 6u) atomicAdd(state.usable, usable);
}
