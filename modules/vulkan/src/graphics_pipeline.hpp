#pragma once
// One graphics pipeline for dynamic rendering: triangles into a depth image, all that can be is dynamic state.

#include <gnomon/vulkan/gpu.hpp>

#include <array>
#include <string_view>

namespace gnomon::vulkan::detail {

inline constexpr VkShaderStageFlags push_stages =
    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT;

struct GraphicsPipeline {
    std::string_view name;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipelineCache cache = VK_NULL_HANDLE;
    VkShaderModule vertex = VK_NULL_HANDLE;
    VkShaderModule geometry = VK_NULL_HANDLE;  ///< Or none.
    VkShaderModule fragment = VK_NULL_HANDLE;  ///< Or none.
    bool has_positions = true;                 ///< Three floats at location 0, packed.
    bool depth_clamp = false;
    VkFormat depth_format = VK_FORMAT_D32_SFLOAT;
    VkFormat color_format = VK_FORMAT_UNDEFINED;  ///< Or none.
    VkPipelineColorBlendAttachmentState blend{
        .blendEnable = VK_FALSE,
        .srcColorBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstColorBlendFactor = VK_BLEND_FACTOR_ZERO,
        .colorBlendOp = VK_BLEND_OP_ADD,
        .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstAlphaBlendFactor = VK_BLEND_FACTOR_ZERO,
        .alphaBlendOp = VK_BLEND_OP_ADD,
        .colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT,
    };
    std::array<VkBool32, 3> constants{};          ///< constant_id 0, 1, 2 of every stage.
};

[[nodiscard]] Result<UniquePipeline> make_graphics_pipeline(GpuRef const& gpu, GraphicsPipeline const& config);

}  // namespace gnomon::vulkan::detail
