// One light added to the pixels of a rectangle: the GLSL half of `shade_volume`. light_kernels.hpp has the layout.

#version 450
#extension GL_GOOGLE_include_directive : require

#include "gbuffer.glsl"

layout(local_size_x = 64) in;

layout(std430, set = 0, binding = 2) readonly buffer Lights { GnShadedLight lights[]; };
layout(std430, set = 0, binding = 3) readonly buffer SampleOf { uint sample_of[]; };
layout(std430, set = 0, binding = 4) buffer Radiance { float radiance[]; };
layout(std430, set = 0, binding = 5) buffer Computations { uint computations[]; };

layout(push_constant) uniform Constants {
    uint x, y, width, height;
    uint image_width;
    uint light;
    uint halves;
    uint orthographic;
    float eye_x, eye_y, eye_z;
    uint stencil;
} c;

void main() {
    uint item = gl_GlobalInvocationID.x;
    if (item >= c.width * c.height) return;
    uint i = sample_of[(c.y + item / c.width) * c.image_width + c.x + item % c.width];
    if (i == 0xFFFFFFFFu) return;
    GnShadedLight light = lights[c.light];
    vec3 position = position_of(i);
    vec3 eye = vec3(c.eye_x, c.eye_y, c.eye_z);
    precise vec3 sight = eye - position;
    vec3 to_eye = c.orthographic != 0u ? eye : gn_unit_or_up(sight);
    bool evaluated = c.stencil != 0u ? gn_see_light(light, position).within : gn_covered(light, position, to_eye);
    if (!evaluated) return;
    precise vec3 sum = vec3(radiance[3u * i], radiance[3u * i + 1u], radiance[3u * i + 2u]);
    sum += gn_shade(light, surface_of(i, c.halves != 0u, eye, c.orthographic != 0u));
    radiance[3u * i] = sum.x;
    radiance[3u * i + 1u] = sum.y;
    radiance[3u * i + 2u] = sum.z;
    computations[i] += 1u;
}
