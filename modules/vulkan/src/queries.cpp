#include <gnomon/vulkan/queries.hpp>

#include <gnomon/backend/check.hpp>
#include <gnomon/math/scalar.hpp>
#include <gnomon/vulkan/shader.hpp>

#include "graphics_pipeline.hpp"
#include "pass_record.hpp"

#include "shaders/box_clamped_frag.hpp"
#include "shaders/box_vert.hpp"

#include <algorithm>
#include <string>

namespace gnomon::vulkan {

namespace {

/// Of shaders/box.vert.
struct BoxPush {
    float column[4][4];
    float origin[3];
    float unused;
    float lo[3];
    float unused_lo;
    float hi[3];
};
static_assert(sizeof(BoxPush) == 108);

Result<UniquePipelineLayout> make_box_layout(GpuRef const& gpu) {
    VkPushConstantRange const range{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(BoxPush)};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &range;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkResult const result = gpu->call.CreatePipelineLayout(gpu->device, &info, gpu->host, &layout);
    if (result != VK_SUCCESS) return failure_of(result, "vkCreatePipelineLayout of the queries");
    return UniquePipelineLayout(gpu, layout);
}

Result<UniqueQueryPool> make_pool(GpuRef const& gpu, std::uint32_t capacity) {
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_OCCLUSION;
    info.queryCount = capacity;
    VkQueryPool pool = VK_NULL_HANDLE;
    VkResult const result = gpu->call.CreateQueryPool(gpu->device, &info, gpu->host, &pool);
    if (result != VK_SUCCESS) return failure_of(result, "vkCreateQueryPool of " + std::to_string(capacity) + " queries");
    return UniqueQueryPool(gpu, pool);
}

Result<UniquePipeline> make_box_pipeline(GpuRef const& gpu, VkPipelineLayout layout, PassKind const& kind,
                                         VkPipelineCache cache) {
    bool const clamped = kind.range == backend::DepthRange::clamp;
    bool const clamps_in_shader = clamped && !gpu->features.depth_clamp;
    auto vertex = make_shader(gpu, box_vert, "box.vert");
    if (!vertex) return std::move(vertex).failure();
    detail::GraphicsPipeline build;
    build.name = "box.vert";
    build.layout = layout;
    build.cache = cache;
    build.vertex = vertex->get();
    build.has_positions = false;
    build.depth_clamp = clamped && !clamps_in_shader;
    build.depth_format = kind.format == backend::DepthFormat::f32 ? VK_FORMAT_D32_SFLOAT : VK_FORMAT_D16_UNORM;
    build.constants[1] = clamps_in_shader ? VK_TRUE : VK_FALSE;
    UniqueShader fragment;
    if (clamps_in_shader) {
        auto made = make_shader(gpu, box_clamped_frag, "box_clamped.frag");
        if (!made) return std::move(made).failure();
        fragment = *std::move(made);
        build.fragment = fragment.get();
    }
    return detail::make_graphics_pipeline(gpu, build);
}

constexpr std::size_t place_of_query(backend::DepthFormat format, backend::DepthRange range) noexcept {
    return (format == backend::DepthFormat::unorm16 ? 2U : 0U) | (range == backend::DepthRange::clamp ? 1U : 0U);
}

BoxPush push_of(backend::PassLayer const& view) noexcept {
    detail::ViewData const data = detail::view_data(view);
    BoxPush push{};
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) push.column[c][r] = data.column[c][r];
    for (int i = 0; i < 3; ++i) push.origin[i] = data.origin[i];
    return push;
}

bool has_nan(math::Aabb const& box) noexcept {
    for (math::axis_t i = 0; i < 3; ++i)
        if (box.lo[i] != box.lo[i] || box.hi[i] != box.hi[i]) return true;
    return false;
}

detail::Bundle bundle_of_view(backend::PassLayer const& view, math::ivec2 const& size_px) {
    detail::Bundle bundle;
    bundle.viewport = view.viewport.value_or(backend::Rect{0, 0, size_px.x, size_px.y});
    bundle.area = backend::area_of(view, size_px);
    bundle.depth = view.depth;
    bundle.range = view.range;
    bundle.count = 1;
    return bundle;
}

void set_state(Gpu const& gpu, VkCommandBuffer commands, detail::Bundle const& bundle) {
    detail::set_area(gpu, commands, bundle);
    gpu.call.CmdSetDepthWriteEnable(commands, VK_FALSE);
    gpu.call.CmdSetDepthBiasEnable(commands, VK_FALSE);
    gpu.call.CmdSetDepthBias(commands, 0.0F, 0.0F, 0.0F);
    gpu.call.CmdSetCullMode(commands, VK_CULL_MODE_NONE);
}

core::Failure<Error> left_out(char const* what) {
    return {Error::bad_argument, std::string("queries of a kind that ") + what + " left out: depth format or clamp"};
}

}  // namespace

Result<SampleQueries> SampleQueries::make(GpuRef const& gpu, SampleQueriesConfig const& config) {
    if (!gpu->features.precise_occlusion_queries)
        return core::Failure{Error::missing_feature,
                             "sample counts need the feature occlusionQueryPrecise, which " +
                                 std::string(gpu->properties.name) + " has not or was made without"};
    if (config.capacity == 0) return core::Failure{Error::bad_argument, "SampleQueriesConfig::capacity is 0"};
    SampleQueries queries;
    queries.gpu_ = gpu;
    queries.capacity_ = config.capacity;
    auto pool = make_pool(gpu, config.capacity);
    if (!pool) return std::move(pool).failure();
    queries.pool_ = *std::move(pool);
    auto layout = make_box_layout(gpu);
    if (!layout) return std::move(layout).failure();
    queries.layout_ = *std::move(layout);
    for (backend::DepthFormat format : {backend::DepthFormat::f32, backend::DepthFormat::unorm16})
        for (backend::DepthRange range : {backend::DepthRange::clip, backend::DepthRange::clamp}) {
            if (format == backend::DepthFormat::f32 ? !config.f32 : !config.unorm16) continue;
            if (range == backend::DepthRange::clamp && !config.clamp) continue;
            auto made = make_box_pipeline(gpu, queries.layout_.get(), {format, false, false, range}, config.cache);
            if (!made) return std::move(made).failure();
            queries.pipelines_[place_of_query(format, range)] = *std::move(made);
        }
    return queries;
}

VkPipeline SampleQueries::pipeline(backend::DepthFormat format, backend::DepthRange range) const noexcept {
    return pipelines_[place_of_query(format, range)].get();
}

/// Queries [0, count), in renderings of `capacity_`; draw(i) records what query i counts.
struct SampleQueries::Batches {
    std::uint32_t count;
    Target& target;
    std::uint32_t layer;
    CountsOut out;
};

template <class Draw>
void SampleQueries::record_batches(VkCommandBuffer commands, Batches const& batches, Draw draw) {
    auto const& [count, target, layer, out] = batches;
    target.prepare(commands, TargetUse::count);
    detail::Rendering rendering;
    rendering.depth = target.depth_view_of(layer);
    rendering.layout = Target::sampled_layout;
    rendering.reads_only = true;
    rendering.size_px = target.config().size_px;
    for (std::uint32_t first = 0; first < count; first += capacity_) {
        std::uint32_t const size = std::min(capacity_, count - first);
        gpu_->call.CmdResetQueryPool(commands, pool_.get(), 0, size);
        detail::begin_rendering(*gpu_, commands, rendering);
        for (std::uint32_t i = 0; i < size; ++i) {
            gpu_->call.CmdBeginQuery(commands, pool_.get(), i, VK_QUERY_CONTROL_PRECISE_BIT);
            draw(first + i);
            gpu_->call.CmdEndQuery(commands, pool_.get(), i);
        }
        gpu_->call.CmdEndRendering(commands);
        // The device waits for its own queries; the host does not.
        gpu_->call.CmdCopyQueryPoolResults(commands, pool_.get(), 0, size, out.buffer,
                                           out.offset + VkDeviceSize{first} * 4, 4, VK_QUERY_RESULT_WAIT_BIT);
    }
}

Result<core::Done> SampleQueries::record_boxes(VkCommandBuffer commands, std::span<math::Aabb const> boxes,
                                               Target& target, backend::PassLayer const& view, CountsOut const& out) {
    if (auto ok = detail::check_layer(*gpu_, view, target); !ok) return ok;
    VkPipeline const bound = pipeline(target.config().depth, view.range);
    if (bound == VK_NULL_HANDLE) return left_out("SampleQueriesConfig");
    if (boxes.empty()) return core::Done{};
    detail::Bundle const bundle = bundle_of_view(view, target.config().size_px);
    if (bundle.area.width <= 0) {
        gpu_->call.CmdFillBuffer(commands, out.buffer, out.offset, boxes.size() * 4, 0);
        return core::Done{};
    }
    gpu_->call.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, bound);
    set_state(*gpu_, commands, bundle);
    BoxPush push = push_of(view);
    gpu_->call.CmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof push, &push);
    constexpr std::uint32_t corners_at = offsetof(BoxPush, lo);
    Batches const batches{static_cast<std::uint32_t>(boxes.size()), target, view.layer, out};
    record_batches(commands, batches, [&](std::uint32_t i) {
        math::Aabb const& box = boxes[i];
        if (math::is_empty(box) || has_nan(box)) return;
        for (math::axis_t axis = 0; axis < 3; ++axis) {
            push.lo[axis] = box.lo[axis];
            push.hi[axis] = box.hi[axis];
        }
        gpu_->call.CmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_VERTEX_BIT, corners_at,
                                    sizeof push - corners_at, push.lo);
        gpu_->call.CmdDraw(commands, 36, 1, 0, 0);
    });
    return core::Done{};
}

Result<core::Done> SampleQueries::record_draws(VkCommandBuffer commands, DrawList& draws, Target& target,
                                               backend::PassLayer const& view, CountsOut const& out) {
    DrawList::State& list = draws.state();
    PassPipelines const& passes = *list.pipelines;
    if (auto ok = detail::check_layer(*gpu_, view, target); !ok) return ok;
    PassKind kind{target.config().depth, false, false, view.range};
    if (passes.get(kind) == VK_NULL_HANDLE) return left_out("PassPipelinesConfig");
    if (list.positions.empty()) return core::Done{};
    detail::Bundle const bundle = bundle_of_view(view, target.config().size_px);
    if (bundle.area.width <= 0) {
        gpu_->call.CmdFillBuffer(commands, out.buffer, out.offset, list.positions.size() * 4, 0);
        return core::Done{};
    }
    backend::PassLayer alone = view;  // The rendering has this layer alone.
    alone.layer = 0;
    detail::Chunk chunk;
    chunk.views[0] = &alone;
    chunk.view_count = 1;
    detail::bind_list(commands, list, detail::record_views(commands, list, chunk));
    gpu_->call.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, passes.get(kind));
    set_state(*gpu_, commands, bundle);
    detail::PassPush push;
    push.matrix_views = 1;
    detail::set_viewport(push, bundle.viewport);
    gpu_->call.CmdPushConstants(commands, passes.layout(), detail::push_stages, 0, sizeof push, &push);
    auto const draw = [&](std::uint32_t i) {
        std::uint32_t const at = list.command_of[i];
        if (at == detail::none) return;
        detail::DrawCommand const& c = list.sorted.commands[at];
        kind.masked = c.state.masked;
        gpu_->call.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, passes.get(kind));
        gpu_->call.CmdSetCullMode(commands, detail::cull_of(c.state.cull));
        gpu_->call.CmdDrawIndexed(commands, c.corners, c.instances, list.first_index() + c.first_index,
                                  static_cast<std::int32_t>(c.first_position), c.first_item);
    };
    record_batches(commands, {static_cast<std::uint32_t>(list.positions.size()), target, view.layer, out}, draw);
    return core::Done{};
}

}  // namespace gnomon::vulkan
