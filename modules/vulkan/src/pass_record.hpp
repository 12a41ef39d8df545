#pragma once
// The parts of recording that passes and queries share: views, matrices, the rendering, viewport and clears.

#include <gnomon/vulkan/draws.hpp>
#include <gnomon/vulkan/target.hpp>

#include "draw_list.hpp"
#include "pass_layout.hpp"
#include "pass_plan.hpp"

namespace gnomon::vulkan::detail {

/// Writes the chunk's views, and the matrices that instances have in them, into the list's next slot.
///
/// returns: the slot's dynamic offset.
std::uint32_t record_views(VkCommandBuffer commands, DrawList::State& list, Chunk const& chunk);

/// Writes what a pass of its own kind has in place of views into the list's next slot, for a list without instances.
///
/// expects: at most `view_slot_bytes`, a multiple of 4.
/// returns: the slot's dynamic offset.
std::uint32_t record_slot(VkCommandBuffer commands, DrawList::State& list, std::span<std::byte const> bytes);

/// Which images a rendering has, and what it begins with.
struct Rendering {
    VkImageView depth = VK_NULL_HANDLE;
    VkImageView triangle = VK_NULL_HANDLE;  ///< Or none.
    VkImageLayout layout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL;
    math::ivec2 size_px{0, 0};
    std::uint32_t layers = 1;
    bool reads_only = false;
    bool clears = false;
    float clear_depth = 0.0F;
};

void begin_rendering(Gpu const& gpu, VkCommandBuffer commands, Rendering const& rendering);

[[nodiscard]] constexpr float farthest(math::Depth depth) noexcept { return depth == math::Depth::reversed ? 0.0F : 1.0F; }

/// Every layer's every depth, of what holds anything until then, NaN too. Leaves the target in `TargetUse::copy_to`.
void clear_depths(Gpu const& gpu, VkCommandBuffer commands, Target& target, float depth);

/// Set, positions, indices.
void bind_list(VkCommandBuffer commands, DrawList::State const& list, std::uint32_t offset);

[[nodiscard]] constexpr VkCullModeFlags cull_of(backend::Cull cull) noexcept {
    return cull == backend::Cull::none   ? VK_CULL_MODE_NONE
           : cull == backend::Cull::back ? VK_CULL_MODE_BACK_BIT
                                         : VK_CULL_MODE_FRONT_BIT;
}

/// Viewport, scissor and depth compare of a bundle.
void set_area(Gpu const& gpu, VkCommandBuffer commands, Bundle const& bundle);

/// Where a fragment shader finds its pixel in clip space.
inline void set_viewport(PassPush& push, backend::Rect const& viewport, math::ivec2 const& subpixel = {0, 0}) noexcept {
    push.viewport_px[0] = static_cast<float>(viewport.x) + static_cast<float>(subpixel.x) / 256.0F;
    push.viewport_px[1] = static_cast<float>(viewport.y) + static_cast<float>(subpixel.y) / 256.0F;
    push.viewport_size_px[0] = static_cast<float>(viewport.width);
    push.viewport_size_px[1] = static_cast<float>(viewport.height);
}

/// Clears the bundle's area in one layer of the rendering.
void clear_area(Gpu const& gpu, VkCommandBuffer commands, Bundle const& bundle, std::uint32_t layer, bool triangle_ids);

[[nodiscard]] Result<core::Done> check_layer(Gpu const& gpu, backend::PassLayer const& layer, Target const& target);

}  // namespace gnomon::vulkan::detail
