// The technique `shadow-map`: one map for a sun or a spot, six for a point light.

#include "detail.hpp"

#include <gnomon/pipeline/measures.hpp>
#include <gnomon/projection.hpp>
#include <gnomon/raster/layers.hpp>
#include <gnomon/shadow.hpp>

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

struct Options {
    std::int32_t resolution = 0;
    shadow::Format format = shadow::Format::f32;
    math::Depth depth = math::Depth::reversed;
    raster::Cull cull = raster::Cull::none;
    shadow::LookupConfig lookup;
};

Options read_options(Params const& params) {
    Options o;
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
Result<std::vector<math::View>> light_views(Frame const& frame, Options const& options, core::ExecutorRef executor) {
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

raster::PassConfig pass_config(math::Depth depth) {
    raster::PassConfig config;
    config.depth = depth;
    config.range = raster::DepthRange::clamp;
    return config;
}

std::size_t face_texels(Options const& options) {
    return static_cast<std::size_t>(options.resolution) * static_cast<std::size_t>(options.resolution);
}

}  // namespace

/// What one run leaves for the next, and for `examine_shadow_map`.
struct Workspace::State {
    raster::Workspace raster;
    std::vector<float> f32;
    std::vector<std::uint16_t> unorm16;
    std::vector<math::View> views;
    std::vector<shadow::MapView> maps;
    std::vector<raster::Layer> layers;  ///< One for each map.
    DrawList draws;
    scene::Geometry const* drawn = nullptr;  ///< What `draws` were made of.
    raster::Cull cull = raster::Cull::none;
};

Workspace::Workspace() : state_(std::make_unique<State>()) {}
Workspace::~Workspace() = default;
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;

namespace {

raster::DepthTarget target_of(Workspace::State& state, Options const& options, std::size_t face) {
    std::int32_t const side = options.resolution;
    std::size_t const offset = face * face_texels(options);
    if (options.format == shadow::Format::unorm16) return raster::make_image(state.unorm16.data() + offset, side, side);
    return raster::make_image(state.f32.data() + offset, side, side);
}

/// The map that sees a sample: the only one, or the face in its direction.
std::size_t map_of(Frame const& frame, Workspace::State const& state, std::size_t sample) noexcept {
    if (state.maps.size() == 1) return 0;
    return static_cast<std::size_t>(projection::face_of(frame.samples.position[sample] - frame.light_position));
}

/// Calls `use` with the texels of map `face`, in the format they have.
template <class Use>
void with_texels(Workspace::State const& state, Options const& options, std::size_t face, Use&& use) {
    std::size_t const offset = face * face_texels(options);
    if (options.format == shadow::Format::unorm16)
        use(shadow::Texels<std::uint16_t>{state.unorm16.data() + offset, options.resolution});
    else
        use(shadow::Texels<float>{state.f32.data() + offset, options.resolution});
}

Result<core::Done> allocate(Workspace::State& state, Options const& options, std::size_t faces) {
    bool const narrow = options.format == shadow::Format::unorm16;
    std::size_t const texels = face_texels(options) * faces;
    std::uint64_t const bytes = std::uint64_t{texels} * (narrow ? 2U : 4U);
    if (bytes > max_map_bytes)
        return core::Failure{Error::too_large, "shadow-map.resolution " + std::to_string(options.resolution) +
                                                   " needs " + std::to_string(faces) + " maps of together " +
                                                   std::to_string(bytes >> 20U) + " MiB; the limit is " +
                                                   std::to_string(max_map_bytes >> 20U) +
                                                   " MiB: lower the resolution or use format unorm16"};
    if (narrow && state.unorm16.size() < texels) state.unorm16.resize(texels);
    if (!narrow && state.f32.size() < texels) state.f32.resize(texels);
    return core::Done{};
}

void look_up_all(Frame const& frame, Workspace::State const& state, Options const& options, core::ExecutorRef executor,
                 TechniqueOutput& output) {
    Samples const& samples = frame.samples;
    executor.parallel_for(samples.size(), sample_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (frame.reached[i] == 0) continue;
            std::size_t const face = map_of(frame, state, i);
            with_texels(state, options, face, [&](auto texels) {
                shadow::Lookup const seen =
                    shadow::look_up(state.maps[face], texels, samples.position[i], samples.normal[i], options.lookup);
                output.visibility[i] = seen.visibility;
                output.bias_m[i] = seen.bias_m;
            });
        }
    });
}

bool share_a_corner(scene::Geometry const& g, std::uint32_t a, std::uint32_t b) noexcept {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (g.positions[g.indices[std::size_t{a} * 3 + i]] == g.positions[g.indices[std::size_t{b} * 3 + j]])
                return true;
    return false;
}

/// All maps are drawn in one pass: six small faces one by one would leave threads idle.
void list_layers(Frame const& frame, Workspace::State& state, Options const& options) {
    state.layers.clear();
    for (std::size_t face = 0; face < state.views.size(); ++face)
        state.layers.push_back({.target = target_of(state, options, face),
                                .origin = math::to_float(state.views[face].eye_m - frame.geometry->origin_m),
                                .clip_from_relative = math::clip_from_relative(state.views[face]),
                                .config = pass_config(options.depth)});
}

Result<TechniqueOutput> run_shadow_map(Frame const& frame, Params const& params, Workspace& workspace,
                                       core::ExecutorRef executor) {
    Options const options = read_options(params);
    Workspace::State& state = workspace.state();
    if (state.drawn != frame.geometry || state.cull != options.cull) {
        state.draws = make_draws(*frame.scene, *frame.geometry, options.cull);
        state.drawn = frame.geometry;
        state.cull = options.cull;
    }
    TechniqueOutput output;
    output.visibility.assign(frame.samples.size(), 0.0F);
    output.bias_m.assign(frame.samples.size(), 0.0F);

    Stopwatch watch;
    auto views = light_views(frame, options, executor);
    if (!views) return std::move(views).failure();
    state.views = std::move(views).value();
    state.maps.clear();
    for (math::View const& view : state.views)
        state.maps.push_back(shadow::make_map_view(view, frame.geometry->origin_m, options.format));
    double const fit_ms = watch.lap_ms();
    if (auto ok = allocate(state, options, state.views.size()); !ok) return std::move(ok).failure();

    (void)watch.lap_ms();
    list_layers(frame, state, options);
    std::uint64_t triangles = 0;
    for (raster::PassStats const& face : raster::layered_pass(state.draws.draws, state.layers, state.raster, executor))
        triangles += face.triangles;
    double const draw_ms = watch.lap_ms();
    look_up_all(frame, state, options, executor, output);
    output.stages = {{"fit", fit_ms}, {"depth_pass", draw_ms}, {"lookup", watch.lap_ms()}};
    std::uint64_t const texels = std::uint64_t{face_texels(options)} * state.views.size();
    output.counts = {{"triangles_drawn", triangles},
                     {"draw_calls", state.draws.draws.size() * state.views.size()},
                     {"lighting_computations", frame.samples.size()},
                     {"texels_allocated", texels},
                     {"texels_rewritten", texels}};
    output.bytes = {{"shadow_maps", texels * (options.format == shadow::Format::unorm16 ? 2U : 4U)}};
    return output;
}

/// Draws the maps again with triangle ids, and asks each shadowed sample whose triangles shadow it.
void examine_shadow_map(Frame const& frame, Params const& params, Workspace& workspace, core::ExecutorRef executor,
                        TechniqueOutput& output) {
    Options const options = read_options(params);
    Workspace::State& state = workspace.state();
    std::size_t const n = frame.samples.size();
    output.own_hit.assign(n, 0);
    std::vector<std::uint32_t> ids(face_texels(options));
    std::vector<float> depth(face_texels(options));
    for (std::size_t face = 0; face < state.views.size(); ++face) {
        state.draws.look_from(state.views[face], frame.geometry->origin_m);
        raster::camera_pass(state.draws.draws,
                            {raster::make_image(depth.data(), options.resolution, options.resolution),
                             raster::make_image(ids.data(), options.resolution, options.resolution)},
                            pass_config(options.depth), state.raster, executor);
        executor.parallel_for(n, sample_grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (verdict_of(output.visibility[i], frame.lit[i]) != Verdict::false_shadow) continue;
                if (map_of(frame, state, i) != face) continue;
                shadow::Prepared const ready = shadow::prepare(state.maps[face], frame.samples.position[i],
                                                               frame.samples.normal[i], options.lookup);
                if (ready.faces_away) {
                    output.own_hit[i] = 1;  // its own plane, judged in float
                    continue;
                }
                float own = 0.0F;
                float all = 0.0F;
                auto const tally = [&](std::int32_t x, std::int32_t y, float weight, bool blocked) {
                    if (!blocked) return;
                    std::uint32_t const id =
                        ids[static_cast<std::size_t>(y) * static_cast<std::size_t>(options.resolution) +
                            static_cast<std::size_t>(x)];
                    std::uint32_t const self = frame.samples.triangle[i];
                    bool const mine = id != raster::no_triangle && share_a_corner(*frame.geometry, id, self);
                    all += weight;
                    own += mine ? weight : 0.0F;
                };
                with_texels(state, options, face, [&](auto texels) {
                    shadow::for_each_tap(state.maps[face], texels, ready, options.lookup.taps, tally);
                });
                output.own_hit[i] = all > 0.0F && own >= 0.5F * all ? 1 : 0;
            }
        });
    }
}

}  // namespace

Technique shadow_map_technique() noexcept {
    return {"shadow-map", "a depth map from the light, filtered by percentage-closer comparison", params_info,
            &run_shadow_map, &examine_shadow_map};
}

}  // namespace gnomon::pipeline
