// The technique `shadow-map-cached`: the maps of `shadow-map`, of which the image of the static casters is kept.

#include "cached_lights.hpp"
#include "light_fit.hpp"
#include "../workspace.hpp"
#include "shadow_map_params.hpp"

#include <algorithm>
#include <array>
#include <atomic>

namespace gnomon::pipeline {

namespace {

constexpr std::array<ParamInfo, 6> own_params{{
    {"rest", ParamKind::integer, "300", 0, 1e6, "frames", {}, "after so long without a move a caster counts as static"},
    {"batch", ParamKind::integer, "128", 1, 65536, "triangles", {}, "what is drawn or left out together: at most so many triangles that lie close"},
    {"budget", ParamKind::integer, "0", 0, 1e9, "triangles", {},
     "static casters drawn in one frame: maps beyond it wait and show what they showed, those first that no sample looks into; 0: no limit"},
    {"wait", ParamKind::integer, "30", 0, 1e6, "frames", {}, "a map that is looked into waits no longer, whatever the budget"},
    {"move", ParamKind::real, "0", 0, 1e6, "m", {}, "a light that went no farther keeps its maps, which show it where it was"},
    {"turn", ParamKind::real, "0", 0, 10, "degrees", {}, "the same of a light that turned"},
}};

constexpr auto params_info = [] {
    std::array<ParamInfo, shadow_map_params.size() + own_params.size()> all{};
    std::copy(shadow_map_params.begin(), shadow_map_params.end(), all.begin());
    std::copy(own_params.begin(), own_params.end(), all.begin() + shadow_map_params.size());
    return all;
}();

void count(CachedLights const& lights, ShadowMapOptions const& options, std::size_t samples, TechniqueOutput& output) {
    CachedWork const& work = lights.work();
    std::uint64_t const texels = std::uint64_t{map_texels(options)} * lights.maps() * 2;
    output.counts = {{"triangles_drawn", work.static_triangles + work.active_triangles},
                     {"static_triangles", work.static_triangles},
                     {"draw_calls", work.draw_calls},
                     {"lighting_computations", samples},
                     {"texels_allocated", texels},
                     {"texels_rewritten", work.texels_copied + work.texels_cleared},
                     {"maps_postponed", work.maps_postponed}};
    output.bytes = {{"shadow_maps", texels * (is_narrow(options) ? 2U : 4U)}};
    for (std::size_t m = 0; m < lights.maps(); ++m)
        if (lights.reason(m) != cache::Reason::none) add_one(cache::name_of(lights.reason(m)), output.redraw_reasons);
}

/// The maps that a sample looks into, as bits.
std::uint8_t looked_into(Frame const& frame, ShadowMaps const& shadow, core::ExecutorRef executor) {
    std::atomic<unsigned> maps{0};
    executor.parallel_for(frame.samples.size(), sample_grain, [&](std::size_t begin, std::size_t end) {
        unsigned here = 0;
        for (std::size_t i = begin; i < end; ++i)
            if (frame.reached[i] != 0) here |= 1U << map_of(frame.samples.position[i], shadow.at.position, shadow.views.size());
        maps |= here;
    });
    return static_cast<std::uint8_t>(maps.load());
}

CasterConfig casters_of(Params const& params) {
    CasterConfig casters;
    casters.rest.rest_ticks = static_cast<std::uint64_t>(params.integer("rest"));
    casters.batch_triangles = static_cast<std::uint32_t>(params.integer("batch"));
    return casters;
}

/// Fits the maps and decides what of each is kept.
Result<std::vector<StageTime>> plan_maps(Verbs& verbs, TechniqueRun const& on, ShadowMapOptions const& options) {
    CachedLightRuns& runs = on.workspace.state().cached_lights;
    ShadowMaps& shadow = runs.shadow;
    runs.lights.follow(verbs, on.frame, options, casters_of(on.params), on.executor);
    Stopwatch watch;
    LightPlace const at = runs.lights.place(on.frame, {on.params.number("move"), on.params.number("turn")});
    double const nearest_m = runs.nearest(*on.frame.geometry, at, on.executor);
    if (auto ok = fit_views(on.frame, at, shadow, options, nearest_m); !ok) return std::move(ok).failure();
    double const fit_ms = watch.lap_ms();
    auto const fresh = fit_target(verbs, shadow, options, 2);
    if (!fresh) return std::move(fresh).failure();
    runs.lights.fit_content(verbs, shadow, *fresh);
    (void)watch.lap_ms();
    MapsWanted wanted{.light = {at.light, options}, .fresh = *fresh};
    if (int const budget = on.params.integer("budget"); budget > 0) {
        wanted.budget = cache::BudgetConfig{static_cast<std::uint64_t>(budget), static_cast<std::uint64_t>(on.params.integer("wait"))};
        wanted.looked_into = looked_into(on.frame, shadow, on.executor);
    }
    runs.lights.plan(shadow, wanted);
    return std::vector<StageTime>{{"fit", fit_ms}, {"plan", watch.lap_ms()}};
}

constexpr std::string_view maps_caption =
    "A column for each map: the only one, or the faces of a cube. Top: the finished maps, active casters in amber. Middle: what was kept of the static "
    "casters' map, in blue. Bottom: what was drawn to it, in red; pale red where nothing was kept and nothing drawn.";

/// The colour of the map that each sample looks into.
std::vector<math::vec3> tint_of(Frame const& frame, ShadowMaps const& shadow) {
    std::vector<math::vec3> tint;
    for (std::size_t i = 0; i < frame.samples.size(); ++i)
        tint.push_back(frame.reached[i] == 0 ? math::vec3(1.0F) : map_tints[map_of(frame.samples.position[i], shadow.at.position, shadow.views.size())]);
    return tint;
}

Result<TechniqueOutput> run_cached(TechniqueRun const& on) {
    ShadowMapOptions const options = read_shadow_map_options(on.params);
    std::size_t const n = on.frame.samples.size();
    Workspace::State& state = on.workspace.state();
    state.move_to(on.device);
    CachedLightRuns& runs = state.cached_lights;
    ShadowMaps& shadow = runs.shadow;
    Verbs verbs(on.device);
    state.samples.fit(verbs, on.frame);
    fit_answers(verbs, shadow, n);
    auto const planned = plan_maps(verbs, on, options);
    if (!planned) return core::Failure(planned.failure());
    std::vector<MapSteps> steps;
    runs.lights.draw(verbs, shadow, on.debug ? &steps : nullptr);
    on.device.stage("lookup");
    look_up_all(verbs, on, shadow, options);
    on.device.stage("");
    auto output = read_lookup(verbs, on, shadow);
    if (!output) {
        runs.lights.forget();
        return output;
    }
    output->stages.insert(output->stages.begin(), planned->begin(), planned->end());
    count(runs.lights, options, n, *output);
    if (on.debug) {
        output->pictures.push_back({"maps", maps_caption, picture_of_maps(steps, format_of(shadow))});
        output->tint = tint_of(on.frame, shadow);
    }
    return output;
}

Result<core::Done> examine_cached(TechniqueRun const& on, TechniqueOutput& output) {
    ShadowMaps& shadow = on.workspace.state().cached_lights.shadow;
    Verbs verbs(on.device);
    fit_draws(verbs, on.frame, shadow, read_shadow_map_options(on.params).cull);
    if (!verbs.good()) return verbs.failure();
    return examine_maps(on, shadow, output);
}

}  // namespace

Technique shadow_map_cached_technique() noexcept {
    return {"shadow-map-cached", "the same maps; the image of static casters is kept until one of them or the light changes", params_info,
            &run_cached, &examine_cached, false, true};
}

}  // namespace gnomon::pipeline
