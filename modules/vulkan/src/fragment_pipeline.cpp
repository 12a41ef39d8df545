#include "fragment_pipeline.hpp"

#include <gnomon/vulkan/kernel.hpp>
#include <gnomon/vulkan/shader.hpp>
#include <gnomon/vulkan/spirv.hpp>
#include <gnomon/vulkan/target.hpp>

#include "graphics_pipeline.hpp"
#include "kernel_bindings.hpp"
#include "pass_layout.hpp"

#include "shaders/shaded_vert.hpp"

namespace gnomon::vulkan {

namespace {

static_assert(sizeof(detail::PassPush) <= backend::fragment_constant_offset);

core::Failure<Error> refuse(Error code, backend::FragmentKernel const& kernel, std::string const& why) {
    return {code, "kernel '" + std::string(kernel.name) + "' " + why};
}

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
    Gpu const& gpu = *passes->gpu();
    VkPhysicalDeviceLimits const& limits = gpu.properties.limits;
    if (kernel.buffers > limits.maxPerStageDescriptorStorageBuffers || kernel.targets > limits.maxPerStageDescriptorSampledImages)
        return refuse(Error::missing_feature, kernel,
                      "has " + std::to_string(kernel.buffers) + " buffers; the device binds " +
                          std::to_string(limits.maxPerStageDescriptorStorageBuffers));
    if (!blends_colors(gpu)) return refuse(Error::missing_feature, kernel, "needs a device that blends 32-bit float colours");
    auto const shader = reflect(kernel.spirv, kernel.name);
    if (!shader) return shader.failure();
    if (auto ok = detail::check_fragment_shader(*shader, {kernel.buffers, kernel.targets},
                                                {1, backend::fragment_constant_offset, kernel.constant_bytes}, kernel.name);
        !ok)
        return std::move(ok).failure();
    FragmentPipeline made;
    made.passes_ = passes;
    made.kernel_ = &kernel;
    if (auto ok = made.make_layouts(); !ok) return std::move(ok).failure();
    return made;
}

Result<core::Done> FragmentPipeline::make_layouts() {
    GpuRef const& gpu = passes_->gpu();
    auto set = detail::make_kernel_set_layout(gpu, {kernel_->buffers, kernel_->targets}, VK_SHADER_STAGE_FRAGMENT_BIT, kernel_->name);
    if (!set) return std::move(set).failure();
    set_layout_ = *std::move(set);
    VkDescriptorSetLayout const sets[] = {passes_->set_layout(), set_layout_.get()};
    auto layout = detail::make_pipeline_layout(gpu, sets, {detail::push_stages, 0, backend::max_constant_bytes}, kernel_->name);
    if (!layout) return std::move(layout).failure();
    layout_ = *std::move(layout);
    return core::Done{};
}

Result<VkPipeline> FragmentPipeline::get(backend::Blend blend) {
    UniquePipeline& kept = pipelines_[blend == backend::Blend::over ? 1 : 0];
    if (kept) return kept.get();
    GpuRef const& gpu = passes_->gpu();
    auto const vertex = make_shader(gpu, shaded_vert, "shaded.vert");
    if (!vertex) return vertex.failure();
    auto const fragment = make_shader(gpu, kernel_->spirv, kernel_->name);
    if (!fragment) return fragment.failure();
    detail::GraphicsPipeline build;
    build.name = kernel_->name;
    build.layout = layout_.get();
    build.vertex = vertex->get();
    build.fragment = fragment->get();
    build.has_positions = false;
    build.color_format = color_format;
    build.blend = blend_state(blend);
    auto made = detail::make_graphics_pipeline(gpu, build);
    if (!made) return std::move(made).failure();
    kept = *std::move(made);
    return kept.get();
}

Result<core::Done> FragmentPipeline::bind(VkCommandBuffer commands, DescriptorRing& sets, FragmentInputs const& inputs) const {
    Gpu const& gpu = *passes_->gpu();
    std::uint32_t const count = kernel_->buffers + kernel_->targets;
    if (!inputs.constants.empty())
        gpu.call.CmdPushConstants(commands, layout_.get(), detail::push_stages, backend::fragment_constant_offset,
                                  static_cast<std::uint32_t>(inputs.constants.size()), inputs.constants.data());
    if (count == 0) return core::Done{};
    auto const set = sets.take(set_layout_.get(), {kernel_->buffers, kernel_->targets});
    if (!set) return set.failure();
    detail::write_kernel_set(gpu, *set, inputs.buffers, inputs.targets);
    gpu.call.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 1, 1, &*set, 0, nullptr);
    return core::Done{};
}

}  // namespace gnomon::vulkan
