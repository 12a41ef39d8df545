#pragma once
// Images that passes draw into and kernels read: layers of depth, with triangle ids if asked for.

#include <gnomon/backend/pass.hpp>
#include <gnomon/vulkan/resources.hpp>

#include <cstdint>
#include <vector>

namespace gnomon::vulkan {

/// What commands do with a target. Each has its layout, stages and accesses.
enum class TargetUse : std::uint8_t {
    nothing,      ///< Not used yet: holds anything.
    draw,         ///< Passes.
    shade,        ///< Passes that shade: they read the triangle ids.
    count,        ///< Depth tests that write nothing: occlusion queries.
    sample,       ///< Shaders of any stage read it, in `sampled_layout`.
    copy_from,    ///< Copies read it.
    copy_to,      ///< Copies write it.
    copy_within,  ///< Copies from one layer to another.
};

inline constexpr VkFormat color_format = VK_FORMAT_R32G32B32A32_SFLOAT;

/// A depth image array, one of triangle ids (VK_FORMAT_R32_UINT) where `config().triangle_ids`, and one of colours
/// (`color_format`) where `config().color`.
///
/// Keeps book of its images' layout as commands are recorded: record in the order in which you submit. Usage flags:
/// attachment, sampled, transfer source and destination.
class Target {
  public:
    /// The layout of `depth_view` and `triangle_view` in a descriptor.
    static constexpr VkImageLayout sampled_layout = VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL;

    [[nodiscard]] backend::TargetConfig const& config() const noexcept { return config_; }
    [[nodiscard]] VkImage depth_image() const noexcept { return depth_.handle.get(); }
    /// All layers, VK_IMAGE_VIEW_TYPE_2D_ARRAY.
    [[nodiscard]] VkImageView depth_view() const noexcept { return depth_.array_view.get(); }
    [[nodiscard]] VkFormat depth_format() const noexcept { return depth_.config.format; }
    /// Null without ids.
    [[nodiscard]] VkImage triangle_image() const noexcept { return triangle_.handle.get(); }
    [[nodiscard]] VkImageView triangle_view() const noexcept { return triangle_.array_view.get(); }
    /// Null without colours.
    [[nodiscard]] VkImage color_image() const noexcept { return color_.handle.get(); }
    [[nodiscard]] VkImageView color_view() const noexcept { return color_.array_view.get(); }

    /// The layout that all commands recorded so far leave the images in.
    [[nodiscard]] VkImageLayout layout() const noexcept;
    /// Whether a pass has drawn into it, or a copy.
    [[nodiscard]] bool is_defined() const noexcept { return is_defined_; }
    /// Records the barrier between what the target was used for and `use`, if there must be one.
    void prepare(VkCommandBuffer commands, TargetUse use);

    /// One layer, VK_IMAGE_VIEW_TYPE_2D. Ids have such views only where the device draws one layer at a time.
    [[nodiscard]] VkImageView depth_view_of(std::uint32_t layer) const noexcept;
    [[nodiscard]] VkImageView triangle_view_of(std::uint32_t layer) const noexcept;
    [[nodiscard]] VkImageView color_view_of(std::uint32_t layer) const noexcept;
    /// Whether a pass has shaded it: before, colours are anything.
    [[nodiscard]] bool is_shaded() const noexcept { return is_shaded_; }
    void set_shaded() noexcept { is_shaded_ = true; }

  private:
    friend Result<Target> make_target(GpuRef const& gpu, backend::TargetConfig const& config);

    GpuRef gpu_;
    backend::TargetConfig config_;
    Image depth_;
    Image triangle_;
    Image color_;
    std::vector<UniqueImageView> depth_views_;
    std::vector<UniqueImageView> triangle_views_;
    std::vector<UniqueImageView> color_views_;
    TargetUse use_ = TargetUse::nothing;
    bool is_defined_ = false;
    bool is_shaded_ = false;
};

/// returns: the target; or `bad_argument`, `unsupported_format` (depth formats are D32_SFLOAT and D16_UNORM) or
///          `too_large`.
[[nodiscard]] Result<Target> make_target(GpuRef const& gpu, backend::TargetConfig const& config);

}  // namespace gnomon::vulkan
