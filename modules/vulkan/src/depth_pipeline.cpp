#include "depth_pipeline.hpp"

#include <gnomon/vulkan/shader.hpp>
#include <gnomon/vulkan/spirv.hpp>

#include "graphics_pipeline.hpp"
#include "kernel_bindings.hpp"
#include "pass_record.hpp"

#include "shaders/rectangle_vert.hpp"

namespace gnomon::vulkan {

Result<DepthPipeline> DepthPipeline::make(GpuRef const& gpu, backend::DepthKernel const& kernel) {
    VkPhysicalDeviceLimits const& limits = gpu->properties.limits;
    if (kernel.buffers > limits.maxPerStageDescriptorStorageBuffers || kernel.targets > limits.maxPerStageDescriptorSampledImages)
        return core::Failure{Error::missing_feature, "kernel '" + std::string(kernel.name) + "' has " +
                                                         std::to_string(kernel.buffers) + " buffers; the device binds " +
                                                         std::to_string(limits.maxPerStageDescriptorStorageBuffers)};
    auto const shader = reflect(kernel.spirv, kernel.name);
    if (!shader) return shader.failure();
    detail::KernelShape const shape{kernel.buffers, kernel.targets};
    if (auto ok = detail::check_fragment_shader(*shader, shape, {0, 0, kernel.constant_bytes}, kernel.name); !ok)
        return std::move(ok).failure();
    auto set = detail::make_kernel_set_layout(gpu, shape, VK_SHADER_STAGE_FRAGMENT_BIT, kernel.name);
    if (!set) return std::move(set).failure();
    VkDescriptorSetLayout const sets[] = {set->get()};
    auto layout = detail::make_pipeline_layout(gpu, sets, {VK_SHADER_STAGE_FRAGMENT_BIT, 0, kernel.constant_bytes}, kernel.name);
    if (!layout) return std::move(layout).failure();
    DepthPipeline made;
    made.gpu_ = gpu;
    made.kernel_ = &kernel;
    made.set_layout_ = *std::move(set);
    made.layout_ = *std::move(layout);
    return made;
}

Result<VkPipeline> DepthPipeline::get(backend::DepthFormat format) {
    bool const is_float = format == backend::DepthFormat::f32;
    UniquePipeline& kept = pipelines_[is_float ? 1 : 0];
    if (kept) return kept.get();
    auto const vertex = make_shader(gpu_, rectangle_vert, "rectangle.vert");
    if (!vertex) return vertex.failure();
    auto const fragment = make_shader(gpu_, kernel_->spirv, kernel_->name);
    if (!fragment) return fragment.failure();
    detail::GraphicsPipeline build;
    build.name = kernel_->name;
    build.layout = layout_.get();
    build.vertex = vertex->get();
    build.fragment = fragment->get();
    build.has_positions = false;
    build.depth_format = is_float ? VK_FORMAT_D32_SFLOAT : VK_FORMAT_D16_UNORM;
    auto made = detail::make_graphics_pipeline(gpu_, build);
    if (!made) return std::move(made).failure();
    kept = *std::move(made);
    return kept.get();
}

Result<core::Done> DepthPipeline::bind(VkCommandBuffer commands, DescriptorRing& sets, FragmentInputs const& inputs) const {
    if (!inputs.constants.empty())
        gpu_->call.CmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                                    static_cast<std::uint32_t>(inputs.constants.size()), inputs.constants.data());
    if (kernel_->buffers + kernel_->targets == 0) return core::Done{};
    auto const set = sets.take(set_layout_.get(), {kernel_->buffers, kernel_->targets});
    if (!set) return set.failure();
    detail::write_kernel_set(*gpu_, *set, inputs.buffers, inputs.targets);
    gpu_->call.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &*set, 0, nullptr);
    return core::Done{};
}

void DepthPipeline::draw(VkCommandBuffer commands, VkPipeline pipeline, Target& target, backend::DepthCall const& call) const {
    if (!target.is_defined()) detail::clear_depths(*gpu_, commands, target, 1.0F);
    target.prepare(commands, TargetUse::draw);
    detail::Rendering rendering;
    rendering.depth = target.depth_view_of(call.layer);
    rendering.size_px = target.config().size_px;
    detail::begin_rendering(*gpu_, commands, rendering);
    detail::Bundle bundle;
    bundle.viewport = bundle.area = call.rect;
    detail::set_area(*gpu_, commands, bundle);
    gpu_->call.CmdSetDepthCompareOp(commands, VK_COMPARE_OP_ALWAYS);
    gpu_->call.CmdSetDepthWriteEnable(commands, VK_TRUE);
    gpu_->call.CmdSetDepthBiasEnable(commands, VK_FALSE);
    gpu_->call.CmdSetDepthBias(commands, 0.0F, 0.0F, 0.0F);
    gpu_->call.CmdSetCullMode(commands, VK_CULL_MODE_NONE);
    gpu_->call.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    gpu_->call.CmdDraw(commands, 3, 1, 0, 0);
    gpu_->call.CmdEndRendering(commands);
}

}  // namespace gnomon::vulkan
