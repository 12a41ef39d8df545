// The technique `shadow-map`: one map for a sun or a spot, six for a point light.

#include "shadow_map.hpp"

#include "kernels.hpp"

#include <gnomon/projection.hpp>
#include <gnomon/raster/target.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::pipeline {

namespace {

constexpr std::array<std::string_view, 2> formats{"f32", "unorm16"};
constexpr std::array<std::string_view, 2> depths{"reversed", "forward"};
constexpr std::array<std::string_view, 2> modes{"auto", "manual"};
constexpr std::array<std::string_view, 2> switches{"on", "off"};
constexpr std::array<std::string_view, 2> units{"texels", "m"};
constexpr std::array<std::string_view, 3> culls{"none", "back", "front"};

constexpr std::array<ParamInfo, 11> params_info{{
    {"resolution",
     ParamKind::integer,
     "2048",
     16,
     raster::max_size_px,
     "texels",
     {},
     "side of the map, or of each of a point light's six maps"},
    {"format", ParamKind::choice, "f32", 0, 0, "", formats, "how a depth is stored"},
    {"depth", ParamKind::choice, "reversed", 0, 0, "", depths,
     "1 at the near plane and 0 at the far one, or the other way"},
    {"pcf",
     ParamKind::integer,
     "3",
     1,
     shadow::max_taps,
     "texels",
     {},
     "width of the filter: 1 compares one texel, 2 blends 2x2, n averages a box of n-1 texels"},
    {"bias", ParamKind::choice, "auto", 0, 0, "", modes,
     "auto: what the map's own errors need, and the three below on top; manual: only those"},
    {"constant", ParamKind::real, "0", -1e4, 1e4, "units", {}, "bias toward the light"},
    {"slope", ParamKind::real, "0", -1e4, 1e4, "units", {}, "bias times tan of the angle between normal and light"},
    {"normal", ParamKind::real, "0", -1e4, 1e4, "units", {}, "shift along the normal, times sin of that angle"},
    {"unit", ParamKind::choice, "texels", 0, 0, "", units, "of the three above"},
    {"plane", ParamKind::choice, "on", 0, 0, "", switches,
     "compare each texel with the receiver's plane, not with its point"},
    {"cull", ParamKind::choice, "none", 0, 0, "", culls, "casters left out of the map by the way they face the light"},
}};

/// What all maps of one run may take, so that a wish for six maps of 16384 texels is an answer and not a crash.
constexpr std::uint64_t max_map_bytes = std::uint64_t{3} << 30U;

/// The smallest distance from the light to the box of a triangle: nothing casts nearer than that.
double nearest_caster(Frame const& frame, core::ExecutorRef executor) {
    scene::Geometry const& g = *frame.geometry;
    std::size_t const n = g.indices.size() / 3;
    constexpr std::size_t grain = 8192;
    std::vector<double> nearest((n + grain - 1) / grain, std::numeric_limits<double>::infinity());
    math::dvec3 const light = math::to_double(frame.light_position);
    executor.parallel_for(nearest.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t chunk = begin; chunk < end; ++chunk)
            for (std::size_t t = chunk * grain; t < std::min(n, (chunk + 1) * grain); ++t) {
                math::Aabb box;
                for (std::size_t c = 0; c < 3; ++c) box = math::extended(box, g.positions[g.indices[t * 3 + c]]);
                nearest[chunk] = std::min(nearest[chunk], projection::distances_to(box, light).near_m);
            }
    });
    double least = std::numeric_limits<double>::infinity();
    for (double const d : nearest) least = std::min(least, d);
    return least;
}

core::Failure<Error> bad_light(core::Failure<projection::Error> const& why) { return {Error::bad_light, why.message}; }

/// The views that the maps are drawn with.
Result<std::vector<math::View>> light_views(Frame const& frame, ShadowMapOptions const& options,
                                            core::ExecutorRef executor) {
    double const margin = 0.5 * options.lookup.taps + 1.0;
    math::dvec3 const origin = frame.geometry->origin_m;
    if (frame.light.kind == LightKind::directional) {
        projection::DirectionalConfig config;
        config.origin_m = origin;
        config.size_px = math::ivec2(options.resolution, options.resolution);
        config.margin_px = margin;
        config.depth = options.depth;
        math::dvec3 const way = -math::to_double(frame.to_light);
        auto view = projection::directional_view(way, frame.bounds, {}, config);
        if (!view) return bad_light(view.failure());
        return std::vector<math::View>{*view};
    }
    math::dvec3 const position = math::to_double(frame.light_position);
    double const farthest = projection::distances_to(frame.bounds, position).far_m;
    double const nearest = nearest_caster(frame, executor);
    auto const range_m = static_cast<double>(frame.light.range_m);
    auto const outer = static_cast<double>(frame.light.outer_cone_rad);
    if (frame.light.kind == LightKind::spot && outer < projection::widest_spot_rad) {
        projection::SpotConfig config;
        double const corner = std::sqrt(2.0) * std::tan(outer) * 1.1;
        projection::DepthRange const range =
            projection::depth_range(nearest, farthest, range_m, 1.0 / std::sqrt(1.0 + corner * corner));
        config.position_m = origin + position;
        config.direction = frame.light.direction;
        config.outer_cone_rad = outer;
        config.near_m = range.near_m;
        config.far_m = range.far_m;
        config.size_px = math::ivec2(options.resolution, options.resolution);
        config.margin_px = margin;
        config.depth = options.depth;
        auto view = projection::spot_view(config);
        if (!view) return bad_light(view.failure());
        return std::vector<math::View>{*view};
    }
    projection::DepthRange const range = projection::depth_range(nearest, farthest, range_m, 0.5);
    auto views = projection::cube_views(
        {origin + position, range.near_m, range.far_m, options.resolution, margin, options.depth});
    if (!views) return bad_light(views.failure());
    return std::vector<math::View>(views->begin(), views->end());
}

/// The list of this geometry and side, staged again only where it changed.
void fit_draws(Verbs& verbs, Frame const& frame, ShadowMaps& shadow, raster::Cull cull) {
    if (shadow.drawn == frame.state->surfaces && shadow.cull == cull) return;
    shadow.drawn = nullptr;
    shadow.list = {};
    shadow.draws = make_draws(*frame.scene, *frame.geometry, cull);
    shadow.cull = cull;
    shadow.list = Held(verbs.device(), verbs(verbs.device().keep(shadow.draws.draws)));
    if (verbs.good()) shadow.drawn = frame.state->surfaces;
}

Result<core::Done> fit_target(Verbs& verbs, ShadowMaps& shadow, ShadowMapOptions const& options) {
    std::size_t const maps = shadow.views.size();
    std::uint64_t const bytes = map_texels(options) * maps * (is_narrow(options) ? 2U : 4U);
    if (bytes > max_map_bytes)
        return core::Failure{Error::too_large, "shadow-map.resolution " + std::to_string(options.resolution) +
                                                   " needs " + std::to_string(maps) + " maps of together " +
                                                   std::to_string(bytes >> 20U) + " MiB; the limit is " +
                                                   std::to_string(max_map_bytes >> 20U) +
                                                   " MiB: lower the resolution or use format unorm16"};
    backend::TargetConfig const wanted{
        .size_px = math::ivec2(options.resolution, options.resolution),
        .layers = static_cast<std::uint32_t>(maps),
        .depth = is_narrow(options) ? backend::DepthFormat::unorm16 : backend::DepthFormat::f32};
    bool const fits = !shadow.target.get().is_none() && shadow.config.size_px == wanted.size_px &&
                      shadow.config.layers == wanted.layers && shadow.config.depth == wanted.depth;
    if (fits) return core::Done{};
    shadow.target = {};
    shadow.target = Held(verbs.device(), verbs(verbs.device().make_target(wanted)));
    shadow.config = wanted;
    return core::Done{};
}

/// The views of the light, as the pass and the lookup need them.
Result<core::Done> fit_views(TechniqueRun const& on, ShadowMaps& shadow, ShadowMapOptions const& options) {
    auto views = light_views(on.frame, options, on.executor);
    if (!views) return std::move(views).failure();
    shadow.views = std::move(views).value();
    shadow.maps.clear();
    shadow.layers.clear();
    for (math::View const& view : shadow.views) {
        shadow.maps.push_back(shadow::make_map_view(view, on.frame.geometry->origin_m, options.format));
        shadow.layers.push_back(layer_of(on.frame, shadow, options, shadow.maps.size() - 1));
        shadow.layers.back().layer = static_cast<std::uint32_t>(shadow.maps.size() - 1);
    }
    return core::Done{};
}

void look_up_all(Verbs& verbs, TechniqueRun const& on, ShadowMapOptions const& options) {
    Workspace::State& state = on.workspace.state();
    ShadowMaps& shadow = state.shadow;
    shadow.map_views.fill<shadow::MapView>(verbs, shadow.maps);
    std::array const buffers{state.samples.samples.get(), state.samples.normals.get(), state.samples.reached.get(),
                             shadow.map_views.get(),      shadow.visibility.get(),     shadow.bias_m.get()};
    std::array const targets{backend::TargetBinding{shadow.target.get(), backend::Plane::depth}};
    ShadowLookupStd const constants = to_std(on.frame, options, shadow.maps.size());
    verbs(
        on.device.run(shadow_lookup_kernel, {on.frame.samples.size(), buffers, targets, backend::bytes_of(constants)}));
}

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
    shadow.visibility.fit(verbs, n * sizeof(float));
    shadow.bias_m.fit(verbs, n * sizeof(float));
    Stopwatch watch;
    if (auto ok = fit_views(on, shadow, options); !ok) return std::move(ok).failure();
    double const fit_ms = watch.lap_ms();
    if (auto ok = fit_target(verbs, shadow, options); !ok) return std::move(ok).failure();

    on.device.stage("depth_pass");
    backend::PassCounts const drawn = verbs(on.device.draw(shadow.list.get(), shadow.target.get(), shadow.layers));
    on.device.stage("lookup");
    look_up_all(verbs, on, options);
    on.device.stage("");
    TechniqueOutput output;
    output.visibility.resize(n);
    output.bias_m.resize(n);
    verbs(on.device.read(shadow.visibility.get(), 0, std::as_writable_bytes(std::span(output.visibility))));
    verbs(on.device.read(shadow.bias_m.get(), 0, std::as_writable_bytes(std::span(output.bias_m))));
    auto const stages = verbs(on.device.finish());
    if (!verbs.good()) return verbs.failure();
    output.stages = {{"fit", fit_ms}};
    output.stages.insert(output.stages.end(), stages.begin(), stages.end());
    std::uint64_t const texels = std::uint64_t{map_texels(options)} * shadow.views.size();
    output.counts = {{"triangles_drawn", drawn.triangles},
                     {"draw_calls", drawn.draw_calls},
                     {"lighting_computations", n},
                     {"texels_allocated", texels},
                     {"texels_rewritten", texels}};
    output.bytes = {{"shadow_maps", texels * (is_narrow(options) ? 2U : 4U)}};
    return output;
}

}  // namespace

ShadowMapOptions read_shadow_map_options(Params const& params) {
    ShadowMapOptions o;
    o.resolution = params.integer("resolution");
    o.format = params.word("format") == "unorm16" ? shadow::Format::unorm16 : shadow::Format::f32;
    o.depth = params.word("depth") == "forward" ? math::Depth::forward : math::Depth::reversed;
    o.cull = params.word("cull") == "none"   ? raster::Cull::none
             : params.word("cull") == "back" ? raster::Cull::back
                                             : raster::Cull::front;
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
    return {"shadow-map", "a depth map from the light, filtered by percentage-closer comparison", params_info,
            &run_shadow_map, &examine_shadow_map};
}

}  // namespace gnomon::pipeline
