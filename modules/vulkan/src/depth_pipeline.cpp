#include "depth_pipeline.hpp"

#include "pass_record.hpp"

#include "shaders/rectangle_vert.hpp"

namespace gnomon::vulkan {

Result<DepthPipeline> DepthPipeline::make(GpuRef const& gpu, backend::DepthKernel const& kernel) {
    detail::FragmentSetConfig config;
    config.name = kernel.name;
    config.spirv = kernel.spirv;
    config.shape = {kernel.buffers, kernel.targets};
    config.limits = {0, 0, kernel.constant_bytes};
    config.constants = {VK_SHADER_STAGE_FRAGMENT_BIT, 0, kernel.constant_bytes};
    auto set = detail::FragmentSet::make(gpu, config);
    if (!set) return std::move(set).failure();
    DepthPipeline made;
    made.gpu_ = gpu;
    made.set_ = *std::move(set);
    return made;
}

Result<VkPipeline> DepthPipeline::get(backend::DepthFormat format) {
    bool const is_float = format == backend::DepthFormat::f32;
    UniquePipeline& kept = pipelines_[is_float ? 1 : 0];
    if (kept) return kept.get();
    detail::GraphicsPipeline build;
    build.depth_format = is_float ? VK_FORMAT_D32_SFLOAT : VK_FORMAT_D16_UNORM;
    auto made = set_.make_pipeline(rectangle_vert, "rectangle.vert", build);
    if (!made) return std::move(made).failure();
    kept = *std::move(made);
    return kept.get();
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
