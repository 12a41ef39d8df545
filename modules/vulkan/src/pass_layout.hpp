#pragma once
// The structs of shaders/pass_interface.glsl as C++ sees them, and the bindings. A test reflects the shaders.

#include <cstddef>
#include <cstdint>

namespace gnomon::vulkan::detail {

inline constexpr std::uint32_t max_views = 64;  ///< Of a chunk of a pass.
inline constexpr std::uint32_t view_slots = 16;
inline constexpr std::uint32_t none = ~0U;

struct ViewData {
    float column[4][4];
    float origin[3];
    std::uint32_t layer;
    std::uint32_t groups[2];
    std::uint32_t unused[2];
};
static_assert(sizeof(ViewData) == 96 && offsetof(ViewData, layer) == 76 && offsetof(ViewData, groups) == 80);
inline constexpr std::size_t view_slot_bytes = max_views * sizeof(ViewData);
static_assert(view_slot_bytes % 256 == 0);  // A legal dynamic offset on every device.

struct ItemData {
    std::uint32_t first_triangle;
    std::uint32_t matrix;
    std::uint32_t alpha;
    std::uint32_t uv_shift;
    std::uint32_t groups[2];
    std::uint32_t first_index;
    std::uint32_t first_position;
};
static_assert(sizeof(ItemData) == 32);

struct AlphaData {
    std::uint32_t first_texel;
    std::int32_t width;
    std::int32_t height;
    std::uint32_t wrap_u;
    std::uint32_t wrap_v;
    float least;
    std::uint32_t least_exact[2];
};
static_assert(sizeof(AlphaData) == 32);

struct PassPush {
    std::uint32_t first_view = 0;
    std::uint32_t layers = 1;
    std::uint32_t matrix_views = 0;
    std::uint32_t instanced = 0;
    float bias_constant = 0.0F;
    float bias_slope = 0.0F;
    float viewport_px[2] = {0.0F, 0.0F};
    float viewport_size_px[2] = {1.0F, 1.0F};
};
static_assert(sizeof(PassPush) == 40 && offsetof(PassPush, viewport_px) == 24);

enum Binding : std::uint32_t {
    binding_views,
    binding_items,
    binding_matrices,
    binding_coordinates,
    binding_alpha_tests,
    binding_texels,
    binding_positions,
    binding_indices,
    binding_instances,
    binding_count,
};

}  // namespace gnomon::vulkan::detail
