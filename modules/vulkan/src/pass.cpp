#include <gnomon/vulkan/pass.hpp>

#include "graphics_pipeline.hpp"
#include "pass_record.hpp"

#include <algorithm>
#include <string>

namespace gnomon::vulkan {

namespace {

using detail::Bundle;
using detail::Chunk;
using detail::DrawCommand;
using detail::Run;

class PassRecorder {
  public:
    PassRecorder(VkCommandBuffer commands, DrawList::State& list, Target& target, DepthBias const& bias)
        : commands_(commands), list_(list), passes_(*list.pipelines), gpu_(*passes_.gpu()), target_(target), bias_(bias) {}

    [[nodiscard]] Result<core::Done> check(std::span<backend::PassLayer const> layers) const {
        for (backend::PassLayer const& layer : layers) {
            if (auto ok = detail::check_layer(gpu_, layer, target_); !ok) return ok;
            PassKind const kind{target_.config().depth, ids(), false, layer.range};
            if (passes_.get(kind) == VK_NULL_HANDLE)
                return core::Failure{Error::bad_argument,
                                     "a pass of a kind that PassPipelinesConfig left out: " +
                                         std::string(kind.format == backend::DepthFormat::f32 ? "f32" : "unorm16") +
                                         (ids() ? ", triangle_ids" : "") +
                                         (layer.range == backend::DepthRange::clamp ? ", clamp" : "")};
        }
        return core::Done{};
    }

    backend::PassCounts record(std::span<backend::PassLayer const> layers) {
        for (backend::PassLayer const& layer : layers)
            for (detail::GroupTriangles const& group : list_.groups)
                counts_.triangles += (group.groups & layer.groups) != 0 ? group.triangles : 0;
        if (!target_.is_defined() && !detail::clears_all(layers, size_px(), 0, target_.config().layers))
            clear_fresh_target(layers);
        bool const one_by_one = passes_.layer_mode() == LayerMode::one_by_one;
        detail::ChunkLimits limits;
        limits.views = list_.instanced != 0 ? list_.config.max_layers : detail::max_views;
        limits.bundle = one_by_one ? 1 : list_.config.max_layers;
        bool is_first = true;
        while (!layers.empty()) {
            bool const clears = is_first && detail::clears_all(layers.first(std::min<std::size_t>(layers.size(), limits.views)),
                                                               size_px(), 0, target_.config().layers);
            Chunk chunk;
            detail::next_chunk(chunk, layers, size_px(), limits);
            if (chunk.view_count != 0) record_chunk(chunk, clears && !one_by_one);
            is_first = false;
        }
        return counts_;
    }

  private:
    [[nodiscard]] bool ids() const noexcept { return target_.config().triangle_ids; }
    [[nodiscard]] math::ivec2 const& size_px() const noexcept { return target_.config().size_px; }

    /// What is not cleared by the first pass would hold anything, NaN too.
    void clear_fresh_target(std::span<backend::PassLayer const> layers) {
        detail::clear_depths(gpu_, commands_, target_,
                             detail::farthest(layers.empty() ? math::Depth::reversed : layers[0].depth));
        if (!ids()) return;
        VkClearColorValue color{};
        color.uint32[0] = backend::no_triangle;
        VkImageSubresourceRange const range{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, target_.config().layers};
        gpu_.call.CmdClearColorImage(commands_, target_.triangle_image(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &color, 1,
                                     &range);
    }

    void record_chunk(Chunk const& chunk, bool clears) {
        std::uint32_t const offset = detail::record_views(commands_, list_, chunk);
        target_.prepare(commands_, TargetUse::draw);
        detail::bind_list(commands_, list_, offset);
        gpu_.call.CmdSetDepthWriteEnable(commands_, VK_TRUE);
        bool const one_by_one = passes_.layer_mode() == LayerMode::one_by_one;
        std::uint32_t open_layer = detail::none;
        if (!one_by_one) begin(chunk, clears, 0);
        for (std::uint32_t b = 0; b < chunk.bundle_count; ++b) {
            Bundle const& bundle = chunk.bundles[b];
            std::uint32_t const layer = chunk.views[bundle.first_view]->layer;
            if (one_by_one && layer != open_layer) {
                if (open_layer != detail::none) gpu_.call.CmdEndRendering(commands_);
                begin(chunk, false, layer);
                open_layer = layer;
            }
            detail::set_area(gpu_, commands_, bundle);
            if (!clears) clear(chunk, bundle, one_by_one);
            draw(chunk, bundle);
        }
        gpu_.call.CmdEndRendering(commands_);
    }

    void begin(Chunk const& chunk, bool clears, std::uint32_t layer) {
        bool const one_by_one = passes_.layer_mode() == LayerMode::one_by_one;
        detail::Rendering rendering;
        rendering.depth = one_by_one ? target_.depth_view_of(layer) : target_.depth_view();
        if (ids()) rendering.triangle = one_by_one ? target_.triangle_view_of(layer) : target_.triangle_view();
        rendering.size_px = size_px();
        rendering.layers = one_by_one ? 1 : target_.config().layers;
        rendering.clears = clears;
        rendering.clear_depth = detail::farthest(chunk.views[0]->depth);
        detail::begin_rendering(gpu_, commands_, rendering);
    }

    void clear(Chunk const& chunk, Bundle const& bundle, bool one_by_one) {
        for (std::uint32_t i = 0; i < bundle.count; ++i) {
            backend::PassLayer const& view = *chunk.views[bundle.first_view + i];
            if (view.load == backend::Load::clear)
                detail::clear_area(gpu_, commands_, bundle, one_by_one ? 0 : view.layer, ids());
        }
    }

    /// The calls of one bundle: one for each run of draws of a kind, or one for each draw where the device cannot.
    void draw(Chunk const& chunk, Bundle const& bundle) {
        bool const reversed = bundle.depth == math::Depth::reversed;
        detail::PassPush push;
        push.first_view = bundle.first_view;
        push.layers = bundle.count;
        push.matrix_views = chunk.view_count;
        push.bias_constant = reversed ? -bias_.constant : bias_.constant;
        push.bias_slope = reversed ? -bias_.slope : bias_.slope;
        detail::set_viewport(push, bundle.viewport, bundle.subpixel);
        gpu_.call.CmdPushConstants(commands_, passes_.layout(), detail::push_stages, 0, sizeof push, &push);
        bool const has_bias = bias_.constant != 0.0F || bias_.slope != 0.0F;
        gpu_.call.CmdSetDepthBiasEnable(commands_, has_bias ? VK_TRUE : VK_FALSE);
        gpu_.call.CmdSetDepthBias(commands_, push.bias_constant, 0.0F, push.bias_slope);
        detail::CommandOrder const& order = list_.order(ids());
        PassKind kind{target_.config().depth, ids(), false, bundle.range};
        VkPipeline bound = VK_NULL_HANDLE;
        for (Run const& run : order.runs) {
            kind.masked = run.state.masked;
            VkPipeline const pipeline = passes_.get(kind);
            if (pipeline != bound) gpu_.call.CmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
            bound = pipeline;
            gpu_.call.CmdSetCullMode(commands_, detail::cull_of(run.state.cull));
            if (order.indexed.size != 0)
                draw_indirect(order, run, bundle.count);
            else
                draw_direct(order, run, bundle.count);
        }
    }

    void draw_indirect(detail::CommandOrder const& order, Run const& run, std::uint32_t layers) {
        bool const pulled = ids() && passes_.pulls_ids();
        VkDeviceSize const stride = pulled ? sizeof(VkDrawIndirectCommand) : sizeof(VkDrawIndexedIndirectCommand);
        VkDeviceSize const first = VkDeviceSize{layers - 1} * order.commands.size() + run.first;
        VkDeviceSize offset = (pulled ? order.pulled.offset : order.indexed.offset) + first * stride;
        std::uint32_t const most = std::max(1U, gpu_.properties.limits.maxDrawIndirectCount);
        for (std::uint32_t left = run.count; left != 0;) {
            std::uint32_t const count = std::min(left, most);
            auto const call = pulled ? gpu_.call.CmdDrawIndirect : gpu_.call.CmdDrawIndexedIndirect;
            call(commands_, list_.fixed.handle.get(), offset, count, static_cast<std::uint32_t>(stride));
            ++counts_.draw_calls;
            left -= count;
            offset += count * stride;
        }
    }

    void draw_direct(detail::CommandOrder const& order, Run const& run, std::uint32_t layers) {
        bool const pulled = ids() && passes_.pulls_ids();
        for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
            DrawCommand const& c = order.commands[i];
            if (pulled)
                gpu_.call.CmdDraw(commands_, c.corners, c.instances * layers, 0, c.first_item * layers);
            else
                gpu_.call.CmdDrawIndexed(commands_, c.corners, c.instances * layers,
                                         list_.first_index() + c.first_index,
                                         static_cast<std::int32_t>(c.first_position), c.first_item * layers);
            ++counts_.draw_calls;
        }
    }

    VkCommandBuffer commands_;
    DrawList::State& list_;
    PassPipelines const& passes_;
    Gpu const& gpu_;
    Target& target_;
    DepthBias bias_;
    backend::PassCounts counts_;
};

}  // namespace

Result<backend::PassCounts> record_pass(VkCommandBuffer commands, DrawList& draws, Target& target,
                                        std::span<backend::PassLayer const> layers, DepthBias const& bias) {
    PassRecorder recorder(commands, draws.state(), target, bias);
    if (auto ok = recorder.check(layers); !ok) return std::move(ok).failure();
    return recorder.record(layers);
}

}  // namespace gnomon::vulkan
