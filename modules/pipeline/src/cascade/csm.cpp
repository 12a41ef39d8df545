// The techniques `csm`, `csm-cached` and `csm-scroll`: the same cascades, drawn in whole units, and what is kept of them.
//
// source: [CSM Scrolling]

#include "cascade_lookup.hpp"
#include "cascade_shadows.hpp"

#include <gnomon/cascade/select.hpp>
#include <gnomon/cascade/view.hpp>
#include <gnomon/shadow/map_view.hpp>

#include "../workspace.hpp"

#include <array>
#include <string>

namespace gnomon::pipeline {

namespace {

constexpr std::array<std::string_view, 2> formats{"unorm16", "f32"};
constexpr std::array<std::string_view, 2> depths{"forward", "reversed"};
constexpr std::array<std::string_view, 2> extents{"diameter", "sphere"};

constexpr std::array<ParamInfo, 15> params_info{{
    {"cascades", ParamKind::integer, "4", 1, cascade::max_cascades, "", {}, "number of maps"},
    {"resolution", ParamKind::integer, "512", 64, 8192, "texels", {}, "side of each map"},
    {"distance", ParamKind::real, "200", 1, 1e5, "m", {}, "how far from the camera shadows go; the nearer of this and the camera's far plane"},
    {"lambda", ParamKind::real, "0.5", 0, 1, "", {}, "splits: 0 uniform, 1 logarithmic"},
    {"overlap", ParamKind::real, "0.1", 0, 1, "", {}, "the part of a cascade that blends into the next"},
    {"extent", ParamKind::choice, "diameter", 0, 0, "", extents, "what of a sub-frustum a map must hold at any turn"},
    {"guard", ParamKind::integer, "0", 0, 1024, "texels", {}, "band about the map proper, which moves this far before anything scrolls"},
    {"length", ParamKind::real, "1000", 1, 1e6, "m", {}, "of the depth range"},
    {"format", ParamKind::choice, "unorm16", 0, 0, "", formats, "how a depth is stored"},
    {"depth", ParamKind::choice, "forward", 0, 0, "", depths, "0 at the near plane and 1 at the far one, or the other way"},
    {"pcf", ParamKind::integer, "3", 1, shadow::max_taps, "texels", {}, "width of the filter, as shadow-map's"},
    {"rest", ParamKind::integer, "300", 0, 1e6, "frames", {}, "after so long without a move a caster counts as static"},
    {"batch", ParamKind::integer, "32", 1, 65536, "triangles", {}, "what is drawn or left out together: at most so many triangles that lie close"},
    {"constant", ParamKind::real, "0", -1e4, 1e4, "texels", {}, "bias toward the light, on top of what the map's own errors need"},
    {"turn", ParamKind::real, "0", 0, 10, "degrees", {}, "a sun that turned no farther keeps its maps, which show it where it was"},
}};

CascadeOptions read_options(Params const& params, CascadeReuse reuse, Frame const& frame) {
    CascadeOptions o;
    o.reuse = reuse;
    cascade::CascadeConfig& c = o.cascades;
    c.direction = -math::to_double(frame.to_light);
    c.splits.count = static_cast<std::uint32_t>(params.integer("cascades"));
    c.splits.lambda = params.number("lambda");
    c.splits.overlap = params.number("overlap");
    c.splits.far_m = std::min(params.number("distance"), frame.view.far_m);
    c.fit.size_px = params.integer("resolution");
    c.fit.filter_px = params.integer("pcf") / 2 + 1;
    c.fit.guard_px = params.integer("guard");
    c.fit.extent = params.word("extent") == "sphere" ? cascade::Extent::sphere : cascade::Extent::diameter;
    c.fit.depth.length_m = params.number("length");
    o.format = params.word("format") == "unorm16" ? backend::DepthFormat::unorm16 : backend::DepthFormat::f32;
    c.fit.depth.codes = o.format == backend::DepthFormat::unorm16 ? cascade::unorm16_codes : cascade::float_codes;
    o.depth = params.word("depth") == "forward" ? math::Depth::forward : math::Depth::reversed;
    o.casters.rest.rest_ticks = static_cast<std::uint64_t>(params.integer("rest"));
    o.casters.batch_triangles = static_cast<std::uint32_t>(params.integer("batch"));
    return o;
}

/// Where the sun is to be for its maps: where it was for them, if it turned no farther than `turn` since.
math::dvec3 held_direction(math::dvec3 const& held, math::dvec3 const& now, double turn_deg) {
    if (turn_deg <= 0.0 || held == math::dvec3(0.0)) return now;
    return turned_at_most(held, now, turn_deg) ? held : now;
}

shadow::LookupConfig lookup_of(Params const& params) {
    shadow::LookupConfig lookup;
    lookup.taps = params.integer("pcf");
    lookup.bias.constant = static_cast<float>(params.number("constant"));
    return lookup;
}

void look_up_all(Verbs& verbs, TechniqueRun const& on, CascadeOptions const& options) {
    Workspace::State& state = on.workspace.state();
    CascadeRuns& runs = state.cascades;
    bool const narrow = options.format == backend::DepthFormat::unorm16;
    cascade::CascadeFrame const& frame = runs.shadows.frame();
    runs.maps.clear();
    for (std::uint32_t k = 0; k < frame.count; ++k)
        runs.maps.push_back(shadow::make_map_view(cascade::view_of(frame, k, options.depth), on.frame.geometry->origin_m,
                                                  narrow ? shadow::Format::unorm16 : shadow::Format::f32));
    runs.map_views.fill<shadow::MapView>(verbs, runs.maps);
    cascade::CascadeDepths const cascades = cascade::cascade_depths(frame);
    runs.depths.fill<cascade::CascadeDepths>(verbs, {&cascades, 1});
    math::vec3 const eye = math::to_float(on.frame.view.eye_m - on.frame.geometry->origin_m);
    math::vec3 const sight = -math::to_float(on.frame.view.back);
    CascadeLookupStd const constants{.count = static_cast<std::uint32_t>(on.frame.samples.size()),
                                     .unorm16 = narrow ? 1U : 0U,
                                     .eye = {eye.x, eye.y, eye.z},
                                     .sight = {sight.x, sight.y, sight.z},
                                     .config = shadow::formula_config(lookup_of(on.params))};
    std::array const buffers{state.samples.samples.get(), state.samples.normals.get(), state.samples.reached.get(),
                             runs.map_views.get(),        runs.visibility.get(),       runs.bias_m.get(), runs.depths.get()};
    std::array const targets{backend::TargetBinding{runs.shadows.target(), backend::Plane::depth}};
    verbs(on.device.run(cascade_lookup_kernel, {on.frame.samples.size(), buffers, targets, backend::bytes_of(constants)}));
}

/// Stages of one name, which come once for each cascade, become one.
std::vector<StageTime> joined(std::span<StageTime const> stages) {
    std::vector<StageTime> out;
    for (StageTime const& stage : stages) {
        auto const same = std::find_if(out.begin(), out.end(), [&](StageTime const& s) { return s.name == stage.name; });
        if (same == out.end()) out.push_back(stage);
        else same->ms += stage.ms;
    }
    return out;
}

constexpr std::array<std::string_view, cascade::max_cascades> triangles_of_map{
    "triangles_map_0", "triangles_map_1", "triangles_map_2", "triangles_map_3",
    "triangles_map_4", "triangles_map_5", "triangles_map_6", "triangles_map_7"};

void count(CascadeShadows const& shadows, CascadeOptions const& options, std::size_t samples, TechniqueOutput& output) {
    CascadeWork all;
    for (CascadeWork const& work : shadows.work()) {
        all.triangles += work.triangles;
        all.batches += work.batches;
        all.draw_calls += work.draw_calls;
        all.texels_scrolled += work.texels_scrolled;
        all.texels_copied += work.texels_copied;
        all.texels_cleared += work.texels_cleared;
        if (options.reuse != CascadeReuse::none && work.reason != cache::Reason::none)
            add_one(cache::name_of(work.reason), output.redraw_reasons);
    }
    auto const side = static_cast<std::uint64_t>(options.cascades.fit.size_px);
    std::uint64_t const copies = options.reuse == CascadeReuse::none ? 1 : options.reuse == CascadeReuse::still ? 2 : 3;
    std::uint64_t const texels = side * side * shadows.work().size() * copies;
    output.counts = {{"triangles_drawn", all.triangles},
                     {"batches_drawn", all.batches},
                     {"draw_calls", all.draw_calls},
                     {"lighting_computations", samples},
                     {"texels_allocated", texels},
                     {"texels_rewritten", all.texels_scrolled + all.texels_copied + all.texels_cleared}};
    for (std::size_t k = 0; k < shadows.work().size(); ++k) {
        output.counts.push_back({triangles_of_map[k], shadows.work()[k].triangles});
        output.map_texel_m.push_back(shadows.frame().cascades[k].volume.texel_m);
    }
    output.bytes = {{"shadow_maps", texels * (options.format == backend::DepthFormat::unorm16 ? 2U : 4U)}};
}

/// The colour of each sample's cascade, by the choice that the lookup makes; white beyond the last.
std::vector<math::vec3> tint_of(Frame const& frame, cascade::CascadeFrame const& cascades) {
    cascade::CascadeDepths const splits = cascade::cascade_depths(cascades);
    math::vec3 const eye = math::to_float(frame.view.eye_m - frame.geometry->origin_m);
    math::vec3 const sight = -math::to_float(frame.view.back);
    auto const color = [&](std::uint32_t k) { return k < cascades.count ? map_tints[k] : math::vec3(1.0F); };
    std::vector<math::vec3> tint;
    for (math::vec3 const& position : frame.samples.position) {
        math::vec3 const way = position - eye;
        auto const choice = cascade::choose_by_depth(splits, (way.x * sight.x + way.y * sight.y) + way.z * sight.z);
        tint.push_back(color(choice.cascade) * (1.0F - choice.blend) + color(choice.next) * choice.blend);
    }
    return tint;
}

constexpr std::string_view maps_caption =
    "A column for each cascade, near to far. Top: the finished maps, active casters in amber. Middle: what was kept of the frame before, moved "
    "along, in blue. Bottom: what was drawn to it, in red; pale red where a strip stayed empty.";

template <CascadeReuse reuse>
Result<TechniqueOutput> run_csm(TechniqueRun const& on) {
    if (on.frame.light.kind != LightKind::directional)
        return core::Failure{Error::bad_light, std::string("cascades are for a directional light, not a ") + name_of(on.frame.light.kind) +
                                                   " one: use shadow-map"};
    CascadeOptions options = read_options(on.params, reuse, on.frame);
    std::size_t const n = on.frame.samples.size();
    Workspace::State& state = on.workspace.state();
    state.move_to(on.device);
    CascadeRuns& runs = state.cascades;
    options.cascades.direction = runs.direction = held_direction(runs.direction, options.cascades.direction, on.params.number("turn"));
    Verbs verbs(on.device);
    state.samples.fit(verbs, on.frame);
    runs.visibility.fit(verbs, n * sizeof(float));
    runs.bias_m.fit(verbs, n * sizeof(float));
    runs.shadows.follow(verbs, on.frame, options, on.executor);
    Stopwatch watch;
    if (auto ok = runs.shadows.prepare(on.frame); !ok) return std::move(ok).failure();
    double const plan_ms = watch.lap_ms();
    std::vector<MapSteps> steps;
    runs.shadows.draw(verbs, on.frame, on.debug ? &steps : nullptr);
    on.device.stage("lookup");
    look_up_all(verbs, on, options);
    on.device.stage("");
    TechniqueOutput output;
    output.visibility.resize(n);
    output.bias_m.resize(n);
    verbs(on.device.read(runs.visibility.get(), 0, std::as_writable_bytes(std::span(output.visibility))));
    verbs(on.device.read(runs.bias_m.get(), 0, std::as_writable_bytes(std::span(output.bias_m))));
    auto const stages = verbs(on.device.finish());
    if (!verbs.good()) {
        runs.shadows.forget();
        return verbs.failure();
    }
    output.stages = joined(stages);
    output.stages.insert(output.stages.begin(), {"plan", plan_ms});
    count(runs.shadows, options, n, output);
    if (on.debug) {
        output.pictures.push_back({"maps", maps_caption, picture_of_maps(steps, runs.shadows.format())});
        output.tint = tint_of(on.frame, runs.shadows.frame());
    }
    return output;
}

}  // namespace

std::array<Technique, 3> cascade_techniques() noexcept {
    return {{{"csm", "cascaded shadow maps, all drawn in every frame", params_info, &run_csm<CascadeReuse::none>, nullptr, true},
             {"csm-cached", "the same; static casters are kept while a map stays where it is", params_info,
              &run_csm<CascadeReuse::still>, nullptr, true, true},
             {"csm-scroll", "the same; static casters are kept and scroll with the map", params_info,
              &run_csm<CascadeReuse::scroll>, nullptr, true, true}}};
}

}  // namespace gnomon::pipeline
