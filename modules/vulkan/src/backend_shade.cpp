// Passes of fragment kernels: the verb `shade`.

#include "backend_state.hpp"
#include "graphics_pipeline.hpp"
#include "pass_record.hpp"

namespace gnomon::vulkan {

namespace {

using detail::Bundle;

/// A pass that shades one layer of a target.
class ShadeRecorder {
  public:
    ShadeRecorder(VkCommandBuffer commands, DrawList::State& list, Target& target, backend::PassLayer const& layer)
        : commands_(commands), list_(list), gpu_(*list.pipelines->gpu()), target_(target), layer_(layer) {
        math::ivec2 const size = target.config().size_px;
        bundle_.viewport = layer.viewport.value_or(backend::Rect{0, 0, size.x, size.y});
        bundle_.area = backend::area_of(layer, size);
        bundle_.subpixel = layer.subpixel;
        bundle_.depth = layer.depth;
        bundle_.range = layer.range;
        bundle_.count = 1;
    }

    [[nodiscard]] bool is_empty() const noexcept { return bundle_.area.width <= 0 || bundle_.area.height <= 0; }

    /// Views, set 0 and the pass's constants; before the rendering begins.
    void prepare(FragmentPipeline const& pipeline) {
        clear_what_is_new();
        backend::PassLayer alone = layer_;  // The rendering has this layer alone.
        alone.layer = 0;
        detail::Chunk chunk;
        chunk.views[0] = &alone;
        chunk.view_count = 1;
        std::uint32_t const offset = detail::record_views(commands_, list_, chunk);
        gpu_.call.CmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout(), 0, 1, &list_.set, 1,
                                        &offset);
        detail::PassPush push;
        push.matrix_views = 1;
        detail::set_viewport(push, bundle_.viewport);
        gpu_.call.CmdPushConstants(commands_, pipeline.layout(), detail::push_stages, 0, sizeof push, &push);
        target_.prepare(commands_, TargetUse::shade);
    }

    backend::PassCounts draw(VkPipeline pipeline, backend::FragmentCall const& call) {
        begin();
        detail::set_area(gpu_, commands_, bundle_);
        clear(call.color == backend::Load::clear);
        bool const is_nearer = call.test == backend::FragmentTest::nearer;
        if (call.test == backend::FragmentTest::visible) gpu_.call.CmdSetDepthCompareOp(commands_, VK_COMPARE_OP_EQUAL);
        gpu_.call.CmdSetDepthWriteEnable(commands_, is_nearer ? VK_TRUE : VK_FALSE);
        gpu_.call.CmdSetDepthBiasEnable(commands_, VK_FALSE);
        gpu_.call.CmdSetDepthBias(commands_, 0.0F, 0.0F, 0.0F);
        gpu_.call.CmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        backend::PassCounts counts;
        for (detail::GroupTriangles const& group : list_.groups)
            counts.triangles += (group.groups & layer_.groups) != 0 ? group.triangles : 0;
        for (detail::DrawCommand const& c : list_.order(true).commands) {
            gpu_.call.CmdSetCullMode(commands_, detail::cull_of(c.state.cull));
            gpu_.call.CmdDraw(commands_, c.corners, c.instances, 0, c.first_item);
            ++counts.draw_calls;
        }
        gpu_.call.CmdEndRendering(commands_);
        return counts;
    }

  private:
    /// What nothing was ever drawn into holds anything, NaN too.
    void clear_what_is_new() {
        if (target_.is_defined() && target_.is_shaded()) return;
        bool const is_new = !target_.is_defined();
        target_.prepare(commands_, TargetUse::copy_to);
        VkImageSubresourceRange range{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, target_.config().layers};
        VkClearColorValue color{};
        gpu_.call.CmdClearColorImage(commands_, target_.color_image(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &color, 1, &range);
        target_.set_shaded();
        if (!is_new) return;
        color.uint32[0] = backend::no_triangle;
        if (target_.config().triangle_ids)
            gpu_.call.CmdClearColorImage(commands_, target_.triangle_image(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &color, 1,
                                         &range);
        VkClearDepthStencilValue const depth{detail::farthest(layer_.depth), 0};
        range.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
        gpu_.call.CmdClearDepthStencilImage(commands_, target_.depth_image(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &depth, 1,
                                            &range);
    }

    void begin() {
        detail::Rendering rendering;
        rendering.depth = target_.depth_view_of(layer_.layer);
        rendering.triangle = target_.color_view_of(layer_.layer);
        rendering.size_px = target_.config().size_px;
        detail::begin_rendering(gpu_, commands_, rendering);
    }

    void clear(bool color) {
        VkClearAttachment clears[2]{};
        std::uint32_t count = 0;
        if (layer_.load == backend::Load::clear) {
            clears[count].aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
            clears[count++].clearValue.depthStencil.depth = detail::farthest(layer_.depth);
        }
        if (color) clears[count++].aspectMask = VK_IMAGE_ASPECT_COLOR_BIT;
        if (count == 0) return;
        VkClearRect rect{};
        rect.rect = {{bundle_.area.x, bundle_.area.y},
                     {static_cast<std::uint32_t>(bundle_.area.width), static_cast<std::uint32_t>(bundle_.area.height)}};
        rect.layerCount = 1;
        gpu_.call.CmdClearAttachments(commands_, count, clears, 1, &rect);
    }

    VkCommandBuffer commands_;
    DrawList::State& list_;
    Gpu const& gpu_;
    Target& target_;
    backend::PassLayer const& layer_;
    Bundle bundle_;
};

bool has_alpha_tests(DrawList::State const& list) noexcept {
    for (detail::Run const& run : list.sorted.runs)
        if (run.state.masked) return true;
    return false;
}

}  // namespace

backend::Result<backend::PassCounts> Backend::shade(backend::DrawListId list, backend::TargetId target,
                                                    backend::PassLayer const& layer, backend::FragmentKernel const& kernel,
                                                    backend::FragmentCall const& call) {
    State& state = *state_;
    DrawList* const draws = state.lists.find(list);
    if (draws == nullptr) return backend::unknown_id("shade", "draw list", list.value);
    Target* const goal = state.targets.find(target);
    if (goal == nullptr) return backend::unknown_id("shade", "target", target.value);
    backend::ShadedTarget const shaded{target, &goal->config(), has_alpha_tests(draws->state())};
    if (auto ok = backend::check(kernel, call, layer, shaded, limits()); !ok) return std::move(ok).failure();
    Bindings found;
    if (auto ok = state.find("shade", call.buffers, call.targets, found); !ok) return std::move(ok).failure();
    auto const pipeline = state.compiled(kernel);
    if (!pipeline) return to_backend(pipeline.failure());
    auto const blending = (*pipeline)->get(call.blend);
    if (!blending) return to_backend(blending.failure());
    auto const commands = state.commands();
    if (!commands) return to_backend(commands.failure());
    if (auto ok = detail::check_layer(*state.gpu, layer, *goal); !ok) return to_backend(std::move(ok).failure());
    ShadeRecorder recorder(*commands, draws->state(), *goal, layer);
    if (recorder.is_empty()) return backend::PassCounts{};
    for (std::size_t i = 0; i < call.buffers.size(); ++i) state.order.reads(found.buffers[i]->touched);
    state.order.apply(*state.gpu, *commands);
    for (std::size_t i = 0; i < call.targets.size(); ++i)
        if (found.targets[i] != goal) found.targets[i]->prepare(*commands, TargetUse::sample);
    recorder.prepare(**pipeline);
    FragmentInputs const inputs{{found.infos, call.buffers.size()}, {found.images, call.targets.size()}, call.constants};
    if (auto ok = (*pipeline)->bind(*commands, state.sets, inputs); !ok) return to_backend(std::move(ok).failure());
    return recorder.draw(*blending, call);
}

}  // namespace gnomon::vulkan
