// The technique `shadow-map`: one map for a sun or a spot, six for a point light.

#include "shadow_map.hpp"

#include "kernels.hpp"
#include "light_fit.hpp"
#include "../workspace.hpp"
#include "shadow_map_params.hpp"

#include <array>

namespace gnomon::pipeline {

namespace {

/// What all maps of one run may take, so that a wish for six maps of 16384 texels is an answer and not a crash.
constexpr std::uint64_t max_map_bytes = std::uint64_t{3} << 30U;

/// Draws the maps and looks every sample up; what is staged only once is staged before anything is timed.
Result<TechniqueOutput> run_shadow_map(TechniqueRun const& on) {
    ShadowMapOptions const options = read_shadow_map_options(on.params);
    std::size_t const n = on.frame.samples.size();
    Workspace::State& state = on.workspace.state();
    state.move_to(on.device);
    ShadowMaps& shadow = state.shadow;
    Verbs verbs(on.device);
    fit_draws(verbs, on.frame, shadow, options.cull);
    state.samples.fit(verbs, on.frame);
    fit_answers(verbs, shadow, n);
    Stopwatch watch;
    double const nearest_m = NearestCaster{}(*on.frame.geometry, place_of(on.frame), on.executor);
    if (auto ok = fit_views(on.frame, place_of(on.frame), shadow, options, nearest_m); !ok) return std::move(ok).failure();
    double const fit_ms = watch.lap_ms();
    if (auto ok = fit_target(verbs, shadow, options, 1); !ok) return std::move(ok).failure();

    on.device.stage("depth_pass");
    backend::PassCounts const drawn = verbs(on.device.draw(shadow.list.get(), shadow.target.get(), shadow.layers));
    on.device.stage("lookup");
    look_up_all(verbs, on, shadow, options);
    on.device.stage("");
    auto result = read_lookup(verbs, on, shadow);
    if (!result) return std::move(result).failure();
    TechniqueOutput output = std::move(result).value();
    output.stages.insert(output.stages.begin(), {"fit", fit_ms});
    std::uint64_t const texels = std::uint64_t{map_texels(options)} * shadow.views.size();
    output.counts = {{"triangles_drawn", drawn.triangles},
                     {"draw_calls", drawn.draw_calls},
                     {"lighting_computations", n},
                     {"texels_allocated", texels},
                     {"texels_rewritten", texels}};
    output.bytes = {{"shadow_maps", texels * (is_narrow(options) ? 2U : 4U)}};
    return output;
}

Result<core::Done> examine_shadow_map(TechniqueRun const& on, TechniqueOutput& output) { return examine_maps(on, on.workspace.state().shadow, output); }

}  // namespace

void fit_answers(Verbs& verbs, ShadowMaps& shadow, std::size_t samples) {
    shadow.visibility.fit(verbs, samples * sizeof(float));
    shadow.bias_m.fit(verbs, samples * sizeof(float));
}

void fit_draws(Verbs& verbs, Frame const& frame, ShadowMaps& shadow, raster::Cull cull) {
    if (shadow.drawn == frame.state->surfaces && shadow.cull == cull) return;
    shadow.drawn = nullptr;
    shadow.list = {};
    shadow.draws = make_draws(*frame.scene, *frame.geometry, cull);
    shadow.cull = cull;
    shadow.list = Held(verbs.device(), verbs(verbs.device().keep(shadow.draws.draws)));
    if (verbs.good()) shadow.drawn = frame.state->surfaces;
}

Result<bool> fit_target(Verbs& verbs, ShadowMaps& shadow, ShadowMapOptions const& options, std::size_t copies) {
    std::size_t const maps = shadow.views.size();
    std::uint64_t const bytes = map_texels(options) * maps * copies * (is_narrow(options) ? 2U : 4U);
    if (bytes > max_map_bytes)
        return core::Failure{Error::too_large, "a shadow map's resolution " + std::to_string(options.resolution) +
                                                   " needs " + std::to_string(maps * copies) + " maps of together " +
                                                   std::to_string(bytes >> 20U) + " MiB; the limit is " +
                                                   std::to_string(max_map_bytes >> 20U) +
                                                   " MiB: lower the resolution or use format unorm16"};
    backend::TargetConfig const wanted{
        .size_px = math::ivec2(options.resolution, options.resolution),
        .layers = static_cast<std::uint32_t>(maps),
        .depth = is_narrow(options) ? backend::DepthFormat::unorm16 : backend::DepthFormat::f32};
    bool const fits = !shadow.target.get().is_none() && shadow.config.size_px == wanted.size_px &&
                      shadow.config.layers == wanted.layers && shadow.config.depth == wanted.depth;
    if (fits) return false;
    shadow.target = {};
    shadow.target = Held(verbs.device(), verbs(verbs.device().make_target(wanted)));
    shadow.config = wanted;
    return true;
}

Result<core::Done> fit_views(Frame const& frame, LightPlace const& at, ShadowMaps& shadow, ShadowMapOptions const& options, double nearest_m) {
    auto views = light_views(frame, at, options, nearest_m);
    if (!views) return std::move(views).failure();
    shadow.at = at;
    shadow.views = std::move(views).value();
    shadow.maps.clear();
    shadow.layers.clear();
    for (math::View const& view : shadow.views) {
        shadow.maps.push_back(shadow::make_map_view(view, frame.geometry->origin_m, options.format));
        shadow.layers.push_back(layer_of(frame, shadow, options, shadow.maps.size() - 1));
        shadow.layers.back().layer = static_cast<std::uint32_t>(shadow.maps.size() - 1);
    }
    return core::Done{};
}

void look_up_all(Verbs& verbs, TechniqueRun const& on, ShadowMaps& shadow, ShadowMapOptions const& options) {
    Workspace::State& state = on.workspace.state();
    shadow.map_views.fill<shadow::MapView>(verbs, shadow.maps);
    std::array const buffers{state.samples.samples.get(), state.samples.normals.get(), state.samples.reached.get(),
                             shadow.map_views.get(),      shadow.visibility.get(),     shadow.bias_m.get()};
    std::array const targets{backend::TargetBinding{shadow.target.get(), backend::Plane::depth}};
    ShadowLookupStd const constants = to_std(on.frame, shadow, options);
    verbs(on.device.run(shadow_lookup_kernel, {on.frame.samples.size(), buffers, targets, backend::bytes_of(constants)}));
}

Result<TechniqueOutput> read_lookup(Verbs& verbs, TechniqueRun const& on, ShadowMaps const& shadow) {
    TechniqueOutput output;
    output.visibility.resize(on.frame.samples.size());
    output.bias_m.resize(on.frame.samples.size());
    verbs(on.device.read(shadow.visibility.get(), 0, std::as_writable_bytes(std::span(output.visibility))));
    verbs(on.device.read(shadow.bias_m.get(), 0, std::as_writable_bytes(std::span(output.bias_m))));
    auto const stages = verbs(on.device.finish());
    if (!verbs.good()) return verbs.failure();
    output.stages.assign(stages.begin(), stages.end());
    return output;
}

ShadowMapOptions read_shadow_map_options(Params const& params) {
    ShadowMapOptions o;
    o.resolution = params.integer("resolution");
    o.format = params.word("format") == "unorm16" ? shadow::Format::unorm16 : shadow::Format::f32;
    o.depth = params.word("depth") == "forward" ? math::Depth::forward : math::Depth::reversed;
    o.cull = params.word("cull") == "none"   ? raster::Cull::none
             : params.word("cull") == "back" ? raster::Cull::back
                                             : raster::Cull::front;
    o.fit = params.word("fit") == "tight" ? RangeFit::tight : RangeFit::steps;
    o.lookup.taps = params.integer("pcf");
    o.lookup.bias.automatic = params.word("bias") == "auto";
    o.lookup.bias.receiver_plane = params.word("plane") == "on";
    o.lookup.bias.constant = static_cast<float>(params.number("constant"));
    o.lookup.bias.slope = static_cast<float>(params.number("slope"));
    o.lookup.bias.normal_offset = static_cast<float>(params.number("normal"));
    o.lookup.bias.unit = params.word("unit") == "m" ? shadow::BiasUnit::metres : shadow::BiasUnit::texels;
    return o;
}

backend::PassLayer layer_of(Frame const& frame, ShadowMaps const& shadow, ShadowMapOptions const& options,
                            std::size_t map) {
    math::View const& view = shadow.views[map];
    return {.origin = math::to_float(view.eye_m - frame.geometry->origin_m),
            .clip_from_relative = math::clip_from_relative(view),
            .depth = options.depth,
            .range = backend::DepthRange::clamp};
}

Technique shadow_map_technique() noexcept {
    return {"shadow-map", "a depth map from the light, filtered by percentage-closer comparison", shadow_map_params,
            &run_shadow_map, &examine_shadow_map};
}

}  // namespace gnomon::pipeline
