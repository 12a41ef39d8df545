#pragma once
// What pipelines of fragment shaders that callers bring have in common: the shader checked, its set, its constants.

#include <gnomon/vulkan/descriptors.hpp>

#include "graphics_pipeline.hpp"
#include "kernel_bindings.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon::vulkan {

/// What a pass of a kernel is given; see backend/fragment.hpp and backend/depth_kernel.hpp for the bindings.
struct FragmentInputs {
    std::span<VkDescriptorBufferInfo const> buffers;
    std::span<VkDescriptorImageInfo const> targets;
    std::span<std::byte const> constants;
};

namespace detail {

struct FragmentSetConfig {
    std::string_view name;
    std::span<std::uint32_t const> spirv;
    KernelShape shape;
    FragmentLimits limits;                             ///< Set 0, or 1 behind `before`.
    VkDescriptorSetLayout before = VK_NULL_HANDLE;     ///< Of set 0, where the kernel has set 1.
    VkPushConstantRange constants{};                   ///< Of the whole layout.
};

class FragmentSet {
  public:
    FragmentSet() noexcept = default;

    /// Compares the shader's own words with the config, then makes the layouts.
    ///
    /// expects: what the config points at outlives the set.
    /// returns: the set, `missing_feature` for more buffers or targets than the device binds, or `shader_rejected` with what differs.
    [[nodiscard]] static Result<FragmentSet> make(GpuRef const& gpu, FragmentSetConfig const& config);

    [[nodiscard]] VkPipelineLayout layout() const noexcept { return layout_.get(); }
    /// The kernel's shader behind a vertex shader that pulls its corners. `build` has the rest.
    [[nodiscard]] Result<UniquePipeline> make_pipeline(std::span<std::uint32_t const> vertex, std::string_view vertex_name,
                                                       GraphicsPipeline build) const;
    /// Binds the set and pushes its constants.
    [[nodiscard]] Result<core::Done> bind(VkCommandBuffer commands, DescriptorRing& sets, FragmentInputs const& inputs) const;

  private:
    GpuRef gpu_;
    FragmentSetConfig config_;
    UniqueSetLayout set_;
    UniquePipelineLayout layout_;
};

}  // namespace detail

}  // namespace gnomon::vulkan
