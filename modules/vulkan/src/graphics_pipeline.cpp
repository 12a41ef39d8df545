#include "graphics_pipeline.hpp"

#include <iterator>
#include <string>

namespace gnomon::vulkan::detail {

namespace {

/// The stages, which all read the same constants.
struct Stages {
    explicit Stages(GraphicsPipeline const& config) noexcept {
        for (std::uint32_t i = 0; i < 3; ++i) entries[i] = {i, i * 4, 4};
        values.mapEntryCount = 3;
        values.pMapEntries = entries;
        values.dataSize = sizeof config.constants;
        values.pData = config.constants.data();
        add(VK_SHADER_STAGE_VERTEX_BIT, config.vertex);
        add(VK_SHADER_STAGE_GEOMETRY_BIT, config.geometry);
        add(VK_SHADER_STAGE_FRAGMENT_BIT, config.fragment);
    }
    Stages(Stages const&) = delete;
    Stages& operator=(Stages const&) = delete;

    void add(VkShaderStageFlagBits stage, VkShaderModule shader) noexcept {
        if (shader == VK_NULL_HANDLE) return;
        VkPipelineShaderStageCreateInfo& info = infos[count++];
        info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        info.stage = stage;
        info.module = shader;
        info.pName = "main";
        info.pSpecializationInfo = &values;
    }

    VkSpecializationMapEntry entries[3];
    VkSpecializationInfo values{};
    VkPipelineShaderStageCreateInfo infos[3]{};
    std::uint32_t count = 0;
};

constexpr VkVertexInputBindingDescription position_binding{0, 12, VK_VERTEX_INPUT_RATE_VERTEX};
constexpr VkVertexInputAttributeDescription position_attribute{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0};
constexpr VkDynamicState dynamic_states[] = {
    VK_DYNAMIC_STATE_VIEWPORT,          VK_DYNAMIC_STATE_SCISSOR,          VK_DYNAMIC_STATE_CULL_MODE,
    VK_DYNAMIC_STATE_DEPTH_COMPARE_OP,  VK_DYNAMIC_STATE_DEPTH_WRITE_ENABLE, VK_DYNAMIC_STATE_DEPTH_BIAS,
    VK_DYNAMIC_STATE_DEPTH_BIAS_ENABLE,
};

/// What no pass changes, and the few that a kind sets.
struct FixedState {
    explicit FixedState(GraphicsPipeline const& config) noexcept : color_format(config.color_format), blend_of(config.blend) {
        input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
        if (config.has_positions) {
            input.vertexBindingDescriptionCount = 1;
            input.pVertexBindingDescriptions = &position_binding;
            input.vertexAttributeDescriptionCount = 1;
            input.pVertexAttributeDescriptions = &position_attribute;
        }
        assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
        assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
        viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
        viewport.viewportCount = 1;
        viewport.scissorCount = 1;
        raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
        raster.depthClampEnable = config.depth_clamp ? VK_TRUE : VK_FALSE;
        raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
        raster.lineWidth = 1.0F;
        samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
        samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
        depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
        depth.depthTestEnable = VK_TRUE;
        blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
        bool const has_color = config.color_format != VK_FORMAT_UNDEFINED;
        blend.attachmentCount = has_color ? 1 : 0;
        blend.pAttachments = &blend_of;
        dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
        dynamic.dynamicStateCount = static_cast<std::uint32_t>(std::size(dynamic_states));
        dynamic.pDynamicStates = dynamic_states;
        rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
        rendering.colorAttachmentCount = has_color ? 1 : 0;
        rendering.pColorAttachmentFormats = &color_format;
        rendering.depthAttachmentFormat = config.depth_format;
    }
    FixedState(FixedState const&) = delete;
    FixedState& operator=(FixedState const&) = delete;

    VkFormat color_format;
    VkPipelineColorBlendAttachmentState blend_of;
    VkPipelineVertexInputStateCreateInfo input{};
    VkPipelineInputAssemblyStateCreateInfo assembly{};
    VkPipelineViewportStateCreateInfo viewport{};
    VkPipelineRasterizationStateCreateInfo raster{};
    VkPipelineMultisampleStateCreateInfo samples{};
    VkPipelineDepthStencilStateCreateInfo depth{};
    VkPipelineColorBlendStateCreateInfo blend{};
    VkPipelineDynamicStateCreateInfo dynamic{};
    VkPipelineRenderingCreateInfo rendering{};
};

}  // namespace

Result<UniquePipeline> make_graphics_pipeline(GpuRef const& gpu, GraphicsPipeline const& config) {
    Stages const stages(config);
    FixedState const fixed(config);
    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.pNext = &fixed.rendering;
    info.stageCount = stages.count;
    info.pStages = stages.infos;
    info.pVertexInputState = &fixed.input;
    info.pInputAssemblyState = &fixed.assembly;
    info.pViewportState = &fixed.viewport;
    info.pRasterizationState = &fixed.raster;
    info.pMultisampleState = &fixed.samples;
    info.pDepthStencilState = &fixed.depth;
    info.pColorBlendState = &fixed.blend;
    info.pDynamicState = &fixed.dynamic;
    info.layout = config.layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkResult const result = gpu->call.CreateGraphicsPipelines(gpu->device, config.cache, 1, &info, gpu->host, &pipeline);
    if (result < 0) return failure_of(result, "vkCreateGraphicsPipelines with " + std::string(config.name));
    return UniquePipeline(gpu, pipeline);
}

}  // namespace gnomon::vulkan::detail
