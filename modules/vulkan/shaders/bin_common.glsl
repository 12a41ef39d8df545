// What the shaders of the binned lists share: a tile of 1024 items, sorted by four bits of their bin at a time.
#ifndef VULKAN_SHADERS_BIN_COMMON_GLSL
#define VULKAN_SHADERS_BIN_COMMON_GLSL

#include "gnomon/backend/tile.glsl"

const uint digits = 16u;

layout(push_constant) uniform BinPass { uint count; uint bins; uint shift; uint is_first; } pass;

// What is in no bin comes after all bins.
uint bin_in(uint key) { return min(key, pass.bins); }
uint digit_of(uint bin) { return (bin >> pass.shift) & (digits - 1u); }
uint tile_count() { return (pass.count + tile_items - 1u) / tile_items; }

#endif
