#pragma once
// The set of a kernel's buffers and targets, of any stage: storage buffers from binding 0 on, textures after them.

#include <gnomon/vulkan/resources.hpp>
#include <gnomon/vulkan/spirv.hpp>

#include <span>
#include <string_view>

namespace gnomon::vulkan::detail {

/// How many of each.
struct KernelShape {
    std::uint32_t buffers = 0;
    std::uint32_t targets = 0;
};

[[nodiscard]] Result<UniqueSetLayout> make_kernel_set_layout(GpuRef const& gpu, KernelShape const& shape,
                                                             VkShaderStageFlags stages, std::string_view name);

/// `constants`: a range of no bytes is left out.
[[nodiscard]] Result<UniquePipelineLayout> make_pipeline_layout(GpuRef const& gpu, std::span<VkDescriptorSetLayout const> sets,
                                                                VkPushConstantRange const& constants, std::string_view name);

/// Points all bindings of a set at what a call is given.
void write_kernel_set(Gpu const& gpu, VkDescriptorSet set, std::span<VkDescriptorBufferInfo const> buffers,
                      std::span<VkDescriptorImageInfo const> targets);

/// Whether a fragment shader declares nothing else in set `set`, reads its buffers alone, and no constants beyond.
struct FragmentLimits {
    std::uint32_t set = 0;
    std::uint32_t first_constant = 0;  ///< The byte at which the kernel's own begin.
    std::uint32_t constant_bytes = 0;
};
[[nodiscard]] Result<core::Done> check_fragment_shader(ShaderInterface const& shader, KernelShape const& shape,
                                                       FragmentLimits const& limits, std::string_view name);

}  // namespace gnomon::vulkan::detail
