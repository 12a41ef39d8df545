// Recording of the integer passes.

#include <gnomon/vulkan/ortho.hpp>

#include <gnomon/backend/check_ortho.hpp>

#include "graphics_pipeline.hpp"
#include "ortho_layout.hpp"
#include "pass_record.hpp"

#include <array>

namespace gnomon::vulkan {

namespace {

using backend::OrthoLayer;
using backend::Rect;
using detail::DrawCommand;

detail::LightData light_data(OrthoLayer const& layer, double last_code) noexcept {
    detail::LightData data{};
    backend::IntegerOrtho const& light = layer.light;
    math::dvec3 const* const axes[] = {&light.right, &light.down, &light.away};
    std::int64_t const image[] = {light.origin_x, light.origin_y, light.origin_z};
    for (std::size_t i = 0; i < 3; ++i) {
        data.axes[i][0] = axes[i]->x;
        data.axes[i][1] = axes[i]->y;
        data.axes[i][2] = axes[i]->z;
        data.axes[i][3] = 256.0 / (i == 2 ? light.depth_unit_m : light.texel_m);
        data.image[i] = static_cast<double>(image[i] * 256);  // at most 2^50
    }
    data.origin_m[0] = layer.origin_m.x;
    data.origin_m[1] = layer.origin_m.y;
    data.origin_m[2] = layer.origin_m.z;
    data.last_code = last_code;
    return data;
}

class OrthoRecorder {
  public:
    OrthoRecorder(VkCommandBuffer commands, OrthoPipelines const& pipelines, DrawList::State& list, Target& target)
        : commands_(commands), pipelines_(pipelines), gpu_(*pipelines.passes()->gpu()), list_(list), target_(target) {}

    /// The pipelines that the layers will need, made where they are not.
    Result<core::Done> make_pipelines(OrthoPipelines& pipelines, bool any_masked) {
        bool const by_device = pipelines.codes_by_device() && !is_float();
        for (std::uint32_t const part : {detail::all_triangles, detail::gentle_triangles, detail::other_triangles}) {
            if (part != detail::all_triangles && !by_device) continue;
            auto const solid = pipelines.get(target_.config().depth, false, part);
            if (!solid) return solid.failure();
            auto const masked = any_masked ? pipelines.get(target_.config().depth, true, part) : solid;
            if (!masked) return masked.failure();
            made_[part] = {*solid, *masked};
        }
        return core::Done{};
    }

    backend::PassCounts record(std::span<OrthoLayer const> layers) {
        if (!target_.is_defined())
            detail::clear_depths(gpu_, commands_, target_,
                                 detail::farthest(layers.empty() ? math::Depth::forward : layers[0].depth));
        while (!layers.empty()) {
            std::size_t const count = std::min<std::size_t>(layers.size(), detail::max_lights);
            record_slot(layers.first(count));
            layers = layers.subspan(count);
        }
        return counts_;
    }

  private:
    /// Of solid and of masked draws.
    struct Pair {
        VkPipeline solid = VK_NULL_HANDLE;
        VkPipeline masked = VK_NULL_HANDLE;
    };

    [[nodiscard]] bool is_float() const noexcept { return target_.config().depth == backend::DepthFormat::f32; }

    /// Null for a draw without triangles.
    [[nodiscard]] DrawCommand const* command_of(std::size_t draw) const noexcept {
        std::uint32_t const at = list_.command_of[draw];
        return at == detail::none ? nullptr : &list_.sorted.commands[at];
    }

    /// So many layers as a slot has lights.
    void record_slot(std::span<OrthoLayer const> layers) {
        std::array<detail::LightData, detail::max_lights> lights;
        for (std::size_t i = 0; i < layers.size(); ++i) lights[i] = light_data(layers[i], is_float() ? 16777216.0 : 65535.0);
        std::uint32_t const offset =
            detail::record_slot(commands_, list_, std::as_bytes(std::span(lights).first(layers.size())));
        gpu_.call.CmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.layout(), 0, 1, &list_.set, 1,
                                        &offset);
        gpu_.call.CmdSetDepthWriteEnable(commands_, VK_TRUE);
        gpu_.call.CmdSetDepthBiasEnable(commands_, VK_FALSE);
        gpu_.call.CmdSetDepthBias(commands_, 0.0F, 0.0F, 0.0F);
        gpu_.call.CmdSetCullMode(commands_, VK_CULL_MODE_NONE);
        for (std::size_t i = 0; i < layers.size(); ++i) record_layer(layers[i], static_cast<std::uint32_t>(i));
    }

    void record_layer(OrthoLayer const& layer, std::uint32_t light) {
        backend::for_each_draw(layer, list_.command_of.size(), [&](std::size_t i) {
            if (DrawCommand const* const c = command_of(i)) counts_.triangles += c->corners / 3;
        });
        Rect const area = backend::area_of(layer, target_.config().size_px);
        if (area.width <= 0 || area.height <= 0) return;
        target_.prepare(commands_, TargetUse::draw);
        detail::Rendering rendering;
        rendering.depth = target_.depth_view_of(layer.layer);
        rendering.size_px = target_.config().size_px;
        detail::begin_rendering(gpu_, commands_, rendering);
        set_area(layer, area);
        bool const by_device = made_[detail::gentle_triangles].solid != VK_NULL_HANDLE && layer.range == backend::DepthRange::clamp;
        detail::OrthoPush const push = push_of(layer, area, light);
        if (by_device) draw(layer, push, made_[detail::gentle_triangles]);
        draw(layer, push, made_[by_device ? detail::other_triangles : detail::all_triangles]);
        gpu_.call.CmdEndRendering(commands_);
    }

    [[nodiscard]] math::ivec2 centre() const noexcept {
        return {target_.config().size_px.x / 2, target_.config().size_px.y / 2};
    }

    void set_area(OrthoLayer const& layer, Rect const& area) {
        detail::Bundle bundle;
        std::int32_t const reach = pipelines_.reach_px();
        bundle.viewport = {centre().x - reach, centre().y - reach, 2 * reach, 2 * reach};
        bundle.area = area;
        bundle.depth = layer.depth;
        detail::set_area(gpu_, commands_, bundle);
        if (layer.load == backend::Load::clear) detail::clear_area(gpu_, commands_, bundle, 0, false);
    }

    [[nodiscard]] detail::OrthoPush push_of(OrthoLayer const& layer, Rect const& area, std::uint32_t light) const noexcept {
        std::int32_t const reach = pipelines_.reach_px();
        detail::OrthoPush push;
        push.area_px[0] = area.x;
        push.area_px[1] = area.y;
        push.area_px[2] = area.x + area.width;
        push.area_px[3] = area.y + area.height;
        push.centre_px[0] = centre().x;
        push.centre_px[1] = centre().y;
        push.per_unit = 1.0F / static_cast<float>(reach * 256);
        push.per_code = is_float() ? 0x1p-24F : 1.0F / 65535.0F;
        push.most_units = pipelines_.edges_by_device() ? reach * 256 : -1;
        push.most_size = OrthoPipelines::device_size_px * 256;
        push.light = light;
        push.flags = (layer.depth == math::Depth::reversed ? detail::is_reversed : 0U) |
                     (layer.range == backend::DepthRange::clip ? detail::clips_range : 0U);
        return push;
    }

    void draw(OrthoLayer const& layer, detail::OrthoPush push, Pair const& pipelines) {
        VkPipeline bound = VK_NULL_HANDLE;
        bool is_first = true;
        backend::for_each_draw(layer, list_.command_of.size(), [&](std::size_t i) {
            if (command_of(i) == nullptr) return;
            DrawCommand const& c = *command_of(i);
            VkPipeline const pipeline = c.state.masked ? pipelines.masked : pipelines.solid;
            if (pipeline != bound) gpu_.call.CmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
            bound = pipeline;
            auto const cull = static_cast<std::uint32_t>(c.state.cull);
            if (is_first || cull != push.cull) {
                push.cull = cull;
                gpu_.call.CmdPushConstants(commands_, pipelines_.layout(), detail::push_stages, 0, sizeof push, &push);
            }
            is_first = false;
            gpu_.call.CmdDraw(commands_, c.corners, 1, 0, c.first_item);
            ++counts_.draw_calls;
        });
    }

    VkCommandBuffer commands_;
    OrthoPipelines const& pipelines_;
    Gpu const& gpu_;
    DrawList::State& list_;
    Target& target_;
    std::array<Pair, 3> made_;  ///< By OrthoPart.
    backend::PassCounts counts_;
};

bool is_masked(DrawList::State const& list) noexcept {
    for (detail::Run const& run : list.sorted.runs)
        if (run.state.masked) return true;
    return false;
}

}  // namespace

Result<backend::PassCounts> record_ortho(VkCommandBuffer commands, OrthoPipelines& pipelines, DrawList& draws, Target& target,
                                         std::span<backend::OrthoLayer const> layers) {
    OrthoRecorder recorder(commands, pipelines, draws.state(), target);
    if (auto ok = recorder.make_pipelines(pipelines, is_masked(draws.state())); !ok) return std::move(ok).failure();
    return recorder.record(layers);
}

}  // namespace gnomon::vulkan
