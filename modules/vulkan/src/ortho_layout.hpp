#pragma once
// The structs of shaders/ortho_interface.glsl as C++ sees them. A test reflects the shaders.

#include "pass_layout.hpp"

#include <cstddef>
#include <cstdint>

namespace gnomon::vulkan::detail {

struct LightData {
    double axes[3][4];      ///< Right, down, away; then 256 units a texel, or a depth unit, over its metres.
    double origin_m[3];
    double last_code;
    double image[4];        ///< Where it begins, in units.
    double unused[12];
};
static_assert(sizeof(LightData) == 256 && offsetof(LightData, last_code) == 120 && offsetof(LightData, image) == 128);

inline constexpr std::uint32_t max_lights = 24;  ///< Of a view slot.
static_assert(max_lights * sizeof(LightData) <= view_slot_bytes);

enum OrthoFlag : std::uint32_t {
    is_reversed = 1,
    clips_range = 2,
};

/// Which triangles a pipeline draws: constant 1 of shaders/ortho.vert.
enum OrthoPart : std::uint32_t {
    all_triangles,
    gentle_triangles,  ///< Those whose depths the device interpolates.
    other_triangles,
};

struct OrthoPush {
    std::int32_t area_px[4] = {0, 0, 0, 0};
    std::int32_t centre_px[2] = {0, 0};
    float per_unit = 0.0F;
    float per_code = 0.0F;
    std::int32_t most_units = 0;
    std::int32_t most_size = 0;
    std::uint32_t light = 0;
    std::uint32_t cull = 0;
    std::uint32_t flags = 0;
};
static_assert(sizeof(OrthoPush) == 52 && offsetof(OrthoPush, most_units) == 32);

}  // namespace gnomon::vulkan::detail
