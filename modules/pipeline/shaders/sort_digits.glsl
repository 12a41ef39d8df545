// What counting and scattering by a digit share: pairs (key, value) in tiles of 1024, five bits of the key at a time.
#ifndef PIPELINE_SHADERS_SORT_DIGITS_GLSL
#define PIPELINE_SHADERS_SORT_DIGITS_GLSL

#include "gnomon/backend/tile.glsl"

const uint digits = 32u;

layout(push_constant) uniform Constants {
    uint count;
    uint shift;
} c;

uint digit_of(uint key) { return (key >> c.shift) & (digits - 1u); }
uint tile_count() { return (c.count + tile_items - 1u) / tile_items; }

#endif
