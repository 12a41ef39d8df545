// A sample as shading reads it, from the samples and the G-buffer of light_kernels.hpp.

#include <gnomon/lights/formula/shade.glsl>
#include <gnomon/math/formula/bits.glsl>

layout(std430, set = 0, binding = 0) readonly buffer Samples { uvec4 samples[]; };  // triangle, position
layout(std430, set = 0, binding = 1) readonly buffer GBuffer { uint gbuffer[]; };

float number_of(uint sample_index, uint number, bool halves) {
    if (!halves) return uintBitsToFloat(gbuffer[16u * sample_index + number]);
    uint word = gbuffer[8u * sample_index + (number >> 1)];
    return gn_float_of_half((number & 1u) == 0u ? word & 0xFFFFu : word >> 16);
}

vec3 numbers_of(uint sample_index, uint first, bool halves) {
    return vec3(number_of(sample_index, first, halves), number_of(sample_index, first + 1u, halves),
                number_of(sample_index, first + 2u, halves));
}

vec3 position_of(uint sample_index) { return uintBitsToFloat(samples[sample_index].yzw); }

/// What no light adds.
vec3 emissive_of(uint sample_index, bool halves) { return numbers_of(sample_index, 12u, halves); }

GnSurface surface_of(uint sample_index, bool halves, vec3 eye, bool orthographic) {
    GnSurface s;
    s.position = position_of(sample_index);
    s.normal = numbers_of(sample_index, 0u, halves);
    precise vec3 sight = eye - s.position;
    s.to_eye = orthographic ? eye : gn_unit_or_up(sight);
    s.diffuse = numbers_of(sample_index, 4u, halves);
    s.specular = numbers_of(sample_index, 8u, halves);
    s.shininess = number_of(sample_index, 11u, halves);
    return s;
}
