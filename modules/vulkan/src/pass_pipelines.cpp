#include <gnomon/vulkan/pass_pipelines.hpp>

#include <gnomon/vulkan/shader.hpp>

#include "graphics_pipeline.hpp"
#include "pass_layout.hpp"

#include "shaders/depth_clamped_frag.hpp"
#include "shaders/depth_exact_frag.hpp"
#include "shaders/depth_frag.hpp"
#include "shaders/for_geometry_vert.hpp"
#include "shaders/ids_clamped_frag.hpp"
#include "shaders/ids_exact_frag.hpp"
#include "shaders/ids_frag.hpp"
#include "shaders/instances_comp.hpp"
#include "shaders/layered_geom.hpp"
#include "shaders/layered_vert.hpp"
#include "shaders/plain_vert.hpp"
#include "shaders/pulled_ids_clamped_frag.hpp"
#include "shaders/pulled_ids_frag.hpp"
#include "shaders/pulled_layered_vert.hpp"
#include "shaders/pulled_vert.hpp"

#include <span>
#include <string_view>

namespace gnomon::vulkan {

namespace {

constexpr std::size_t place_of(PassKind const& kind) noexcept {
    return (kind.format == backend::DepthFormat::unorm16 ? 8U : 0U) | (kind.triangle_ids ? 4U : 0U) |
           (kind.masked ? 2U : 0U) | (kind.range == backend::DepthRange::clamp ? 1U : 0U);
}

constexpr PassKind kind_at(std::size_t place) noexcept {
    return {(place & 8U) != 0 ? backend::DepthFormat::unorm16 : backend::DepthFormat::f32, (place & 4U) != 0,
            (place & 2U) != 0, (place & 1U) != 0 ? backend::DepthRange::clamp : backend::DepthRange::clip};
}

bool is_wanted(PassPipelinesConfig const& config, PassKind const& kind) noexcept {
    bool const format = kind.format == backend::DepthFormat::f32 ? config.f32 : config.unorm16;
    return format && (config.triangle_ids || !kind.triangle_ids) && (config.alpha_tests || !kind.masked) &&
           (config.clamp || kind.range == backend::DepthRange::clip);
}

LayerMode layer_mode_of(Features const& features) noexcept {
    if (features.layer_from_vertex_shader) return LayerMode::vertex_shader;
    return features.geometry_shader ? LayerMode::geometry_shader : LayerMode::one_by_one;
}

struct Source {
    std::span<std::uint32_t const> words;
    std::string_view name;
};

Source vertex_source(LayerMode mode, bool pulled) noexcept {
    if (mode == LayerMode::geometry_shader) return {for_geometry_vert, "for_geometry.vert"};
    if (mode == LayerMode::vertex_shader)
        return pulled ? Source{pulled_layered_vert, "pulled_layered.vert"} : Source{layered_vert, "layered.vert"};
    return pulled ? Source{pulled_vert, "pulled.vert"} : Source{plain_vert, "plain.vert"};
}

Source exact_source(bool ids) noexcept {
    return ids ? Source{ids_exact_frag, "ids_exact.frag"} : Source{depth_exact_frag, "depth_exact.frag"};
}

Source fragment_source(bool ids, bool pulled, bool clamped) noexcept {
    if (!ids) return clamped ? Source{depth_clamped_frag, "depth_clamped.frag"} : Source{depth_frag, "depth.frag"};
    if (!pulled) return clamped ? Source{ids_clamped_frag, "ids_clamped.frag"} : Source{ids_frag, "ids.frag"};
    return clamped ? Source{pulled_ids_clamped_frag, "pulled_ids_clamped.frag"}
                   : Source{pulled_ids_frag, "pulled_ids.frag"};
}

Result<UniqueSetLayout> make_set_layout(GpuRef const& gpu) {
    VkDescriptorSetLayoutBinding bindings[detail::binding_count];
    for (std::uint32_t i = 0; i < detail::binding_count; ++i)
        bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1,
                       VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
    bindings[detail::binding_views].descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
    bindings[detail::binding_views].stageFlags |= VK_SHADER_STAGE_COMPUTE_BIT;
    bindings[detail::binding_matrices].stageFlags |= VK_SHADER_STAGE_COMPUTE_BIT;
    bindings[detail::binding_alpha_tests].stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT;
    bindings[detail::binding_texels].stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT;
    bindings[detail::binding_instances].stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
    VkDescriptorSetLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    info.bindingCount = detail::binding_count;
    info.pBindings = bindings;
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    VkResult const result = gpu->call.CreateDescriptorSetLayout(gpu->device, &info, gpu->host, &layout);
    if (result != VK_SUCCESS) return failure_of(result, "vkCreateDescriptorSetLayout of the passes");
    return UniqueSetLayout(gpu, layout);
}

Result<UniquePipelineLayout> make_layout(GpuRef const& gpu, VkDescriptorSetLayout set) {
    VkPushConstantRange const range{detail::push_stages, 0, sizeof(detail::PassPush)};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = 1;
    info.pSetLayouts = &set;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &range;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkResult const result = gpu->call.CreatePipelineLayout(gpu->device, &info, gpu->host, &layout);
    if (result != VK_SUCCESS) return failure_of(result, "vkCreatePipelineLayout of the passes");
    return UniquePipelineLayout(gpu, layout);
}

Result<UniquePipeline> make_instances(GpuRef const& gpu, VkPipelineLayout layout, VkPipelineCache cache) {
    auto shader = make_shader(gpu, instances_comp, "instances.comp");
    if (!shader) return std::move(shader).failure();
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = shader->get();
    info.stage.pName = "main";
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkResult const result = gpu->call.CreateComputePipelines(gpu->device, cache, 1, &info, gpu->host, &pipeline);
    if (result < 0) return failure_of(result, "vkCreateComputePipelines of instances.comp");
    return UniquePipeline(gpu, pipeline);
}

/// The pipeline of one kind; its shader modules live as long as the call.
Result<UniquePipeline> make_pipeline(PassPipelines const& passes, PassKind const& kind, VkPipelineCache cache) {
    GpuRef const& gpu = passes.gpu();
    bool const pulled = kind.triangle_ids && passes.pulls_ids();
    bool const clamped = kind.range == backend::DepthRange::clamp;
    bool const clamps_in_shader = clamped && !gpu->features.depth_clamp;
    Source const vertex = vertex_source(passes.layer_mode(), pulled);
    auto vertex_shader = make_shader(gpu, vertex.words, vertex.name);
    if (!vertex_shader) return std::move(vertex_shader).failure();
    detail::GraphicsPipeline build;
    build.name = vertex.name;
    build.layout = passes.layout();
    build.cache = cache;
    build.vertex = vertex_shader->get();
    build.has_positions = !pulled;
    build.depth_clamp = clamped && !clamps_in_shader;
    build.depth_format = kind.format == backend::DepthFormat::f32 ? VK_FORMAT_D32_SFLOAT : VK_FORMAT_D16_UNORM;
    build.color_format = kind.triangle_ids ? VK_FORMAT_R32_UINT : VK_FORMAT_UNDEFINED;
    build.constants = {kind.masked ? VK_TRUE : VK_FALSE, clamps_in_shader ? VK_TRUE : VK_FALSE,
                       kind.format == backend::DepthFormat::unorm16 ? VK_TRUE : VK_FALSE};
    UniqueShader geometry;
    if (passes.layer_mode() == LayerMode::geometry_shader) {
        auto made = make_shader(gpu, layered_geom, "layered.geom");
        if (!made) return std::move(made).failure();
        geometry = *std::move(made);
        build.geometry = geometry.get();
    }
    UniqueShader fragment;
    if (kind.triangle_ids || kind.masked || clamps_in_shader) {
        bool const exact = kind.masked && !clamps_in_shader && passes.tests_alpha_exactly();
        Source const source =
            exact ? exact_source(kind.triangle_ids) : fragment_source(kind.triangle_ids, pulled, clamps_in_shader);
        auto made = make_shader(gpu, source.words, source.name);
        if (!made) return std::move(made).failure();
        fragment = *std::move(made);
        build.fragment = fragment.get();
    }
    return detail::make_graphics_pipeline(gpu, build);
}

}  // namespace

VkPipeline PassPipelines::get(PassKind const& kind) const noexcept { return pipelines_[place_of(kind)].get(); }

Result<PassPipelinesRef> make_pass_pipelines(GpuRef const& gpu, PassPipelinesConfig const& config) {
    auto passes = std::make_shared<PassPipelines>();
    passes->gpu_ = gpu;
    passes->config_ = config;
    passes->layer_mode_ = layer_mode_of(gpu->features);
    auto set_layout = make_set_layout(gpu);
    if (!set_layout) return std::move(set_layout).failure();
    passes->set_layout_ = *std::move(set_layout);
    auto layout = make_layout(gpu, passes->set_layout());
    if (!layout) return std::move(layout).failure();
    passes->layout_ = *std::move(layout);
    if (gpu->features.shader_float64) {
        auto instances = make_instances(gpu, passes->layout(), config.cache);
        if (!instances) return std::move(instances).failure();
        passes->instances_ = *std::move(instances);
    }
    for (std::size_t i = 0; i < passes->pipelines_.size(); ++i) {
        PassKind const kind = kind_at(i);
        if (!is_wanted(config, kind)) continue;
        auto pipeline = make_pipeline(*passes, kind, config.cache);
        if (!pipeline) return std::move(pipeline).failure();
        passes->pipelines_[i] = *std::move(pipeline);
    }
    return PassPipelinesRef(std::move(passes));
}

}  // namespace gnomon::vulkan
