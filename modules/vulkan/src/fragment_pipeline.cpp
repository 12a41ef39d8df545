#include "fragment_pipeline.hpp"

#include <gnomon/vulkan/target.hpp>

#include "pass_layout.hpp"

#include "shaders/shaded_vert.hpp"

#include <string>

namespace gnomon::vulkan {

namespace {

static_assert(sizeof(detail::PassPush) <= backend::fragment_constant_offset);

bool blends_colors(Gpu const& gpu) noexcept {
    VkFormatProperties properties{};
    gpu.call.GetPhysicalDeviceFormatProperties(gpu.physical, color_format, &properties);
    return (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT) != 0;
}

VkPipelineColorBlendAttachmentState blend_state(backend::Blend blend) noexcept {
    VkPipelineColorBlendAttachmentState state = detail::GraphicsPipeline{}.blend;
    state.blendEnable = VK_TRUE;
    state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    if (blend == backend::Blend::replace_and_add) return state;
    state.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    return state;
}

}  // namespace

Result<FragmentPipeline> FragmentPipeline::make(PassPipelinesRef const& passes, backend::FragmentKernel const& kernel) {
    if (!blends_colors(*passes->gpu()))
        return core::Failure{Error::missing_feature, "kernel '" + std::string(kernel.name) + "' needs a device that blends 32-bit float colours"};
    detail::FragmentSetConfig config;
    config.name = kernel.name;
    config.spirv = kernel.spirv;
    config.shape = {kernel.buffers, kernel.targets};
    config.limits = {1, backend::fragment_constant_offset, kernel.constant_bytes};
    config.before = passes->set_layout();
    config.constants = {detail::push_stages, 0, backend::max_constant_bytes};
    auto set = detail::FragmentSet::make(passes->gpu(), config);
    if (!set) return std::move(set).failure();
    FragmentPipeline made;
    made.passes_ = passes;
    made.set_ = *std::move(set);
    return made;
}

Result<VkPipeline> FragmentPipeline::get(backend::Blend blend) {
    UniquePipeline& kept = pipelines_[blend == backend::Blend::over ? 1 : 0];
    if (kept) return kept.get();
    detail::GraphicsPipeline build;
    build.color_format = color_format;
    build.blend = blend_state(blend);
    auto made = set_.make_pipeline(shaded_vert, "shaded.vert", build);
    if (!made) return std::move(made).failure();
    kept = *std::move(made);
    return kept.get();
}

}  // namespace gnomon::vulkan
