#include <gnomon/vulkan/ortho.hpp>
#include <gnomon/vulkan/shader.hpp>

#include "graphics_pipeline.hpp"
#include "kernel_bindings.hpp"
#include "ortho_layout.hpp"

#include "shaders/ortho_alpha_frag.hpp"
#include "shaders/ortho_frag.hpp"
#include "shaders/ortho_vert.hpp"

#include <algorithm>
#include <string>

namespace gnomon::vulkan {

namespace {

/// The greatest power of two up to half a viewport's side. Beyond 2^13 pixels nothing is gained but risk.
std::int32_t reach_of(VkPhysicalDeviceLimits const& limits) noexcept {
    std::uint32_t const most = std::min(limits.maxViewportDimensions[0], limits.maxViewportDimensions[1]);
    std::int32_t reach = 8192;
    while (reach > 1 && static_cast<std::uint32_t>(reach) * 2 > most) reach /= 2;
    return reach;
}

}  // namespace

Result<OrthoPipelines> OrthoPipelines::make(PassPipelinesRef const& passes, OrthoPipelinesConfig const& config) {
    GpuRef const& gpu = passes->gpu();
    if (!gpu->features.shader_float64 || !gpu->features.shader_int64)
        return core::Failure{Error::missing_feature,
                             std::string("passes in whole units need ") +
                                 (gpu->features.shader_float64 ? "shader_int64" : "shader_float64") + ", which " +
                                 gpu->properties.name + " lacks or was not enabled with"};
    VkDescriptorSetLayout const sets[] = {passes->set_layout()};
    auto layout = detail::make_pipeline_layout(gpu, sets, {detail::push_stages, 0, sizeof(detail::OrthoPush)}, "the integer passes");
    if (!layout) return std::move(layout).failure();
    OrthoPipelines made;
    made.passes_ = passes;
    made.cache_ = config.cache;
    made.layout_ = *std::move(layout);
    made.reach_px_ = reach_of(gpu->properties.limits);
    made.edges_by_device_ = config.edges_by_device && gpu->properties.limits.subPixelPrecisionBits >= 8;
    made.codes_by_device_ = config.codes_by_device && made.edges_by_device_ && gpu->features.depth_clamp;
    return made;
}

Result<VkPipeline> OrthoPipelines::get(backend::DepthFormat format, bool masked, std::uint32_t part) {
    bool const is_float = format == backend::DepthFormat::f32;
    UniquePipeline& kept = pipelines_[part * 4 + (is_float ? 2U : 0U) + (masked ? 1U : 0U)];
    if (kept) return kept.get();
    GpuRef const& gpu = passes_->gpu();
    bool const by_device = part == detail::gentle_triangles;
    auto const vertex = make_shader(gpu, ortho_vert, "ortho.vert");
    if (!vertex) return vertex.failure();
    auto const fragment = by_device ? make_shader(gpu, ortho_alpha_frag, "ortho_alpha.frag") : make_shader(gpu, ortho_frag, "ortho.frag");
    if (!fragment) return fragment.failure();
    detail::GraphicsPipeline build;
    build.name = "ortho.vert";
    build.layout = layout_.get();
    build.cache = cache_;
    build.vertex = vertex->get();
    build.fragment = by_device && !masked ? VK_NULL_HANDLE : fragment->get();
    build.has_positions = false;
    build.depth_clamp = by_device;
    build.depth_format = is_float ? VK_FORMAT_D32_SFLOAT : VK_FORMAT_D16_UNORM;
    build.constants[0] = masked ? VK_TRUE : VK_FALSE;
    build.constants[1] = part;
    auto made = detail::make_graphics_pipeline(gpu, build);
    if (!made) return std::move(made).failure();
    kept = *std::move(made);
    return kept.get();
}

}  // namespace gnomon::vulkan
