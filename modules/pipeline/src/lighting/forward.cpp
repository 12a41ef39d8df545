// The techniques `forward`, `tiled-forward`, `tiled-forward-prez` and `clustered-forward`: lights evaluated where fragments
// are. [Olsson 2014, Paper I, 3; Paper II, 4]

#include "forward.hpp"
#include "lighting.hpp"
#include "surface_table.hpp"
#include "../workspace.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gnomon::pipeline {

namespace {

enum class ForwardKind : std::uint8_t { all_lights, tiled, tiled_prez, clustered };

std::array<ParamInfo, 1> const& forward_params() noexcept {
    static std::array<ParamInfo, 1> const all{{tile_param}};
    return all;
}

Held<backend::DrawListId> keep(Verbs& verbs, std::span<backend::Draw const> draws) {
    return Held(verbs.device(), verbs(verbs.device().keep(draws)));
}

Result<ForwardGrid> make_lists(ForwardKind kind, LightingRun const& on, Lighting& l) {
    switch (kind) {
        case ForwardKind::all_lights: return list_all(on.frame, l.prepared.shaded.size());
        case ForwardKind::tiled: return list_by_tile(on, l, static_cast<std::uint32_t>(on.params.integer("tile")), nullptr);
        case ForwardKind::tiled_prez: {
            auto const tile = static_cast<std::uint32_t>(on.params.integer("tile"));
            TileRanges const ranges = ranges_of_samples(on.frame, tile);
            return list_by_tile(on, l, tile, &ranges);
        }
        case ForwardKind::clustered: return list_by_sample_clusters(on, l);
    }
    return list_all(on.frame, l.prepared.shaded.size());
}

/// Shades all surfaces as they come, nearer ones over farther ones. Alpha tests are made first, in a pass of depth.
void shade_in_order(Verbs& verbs, Lighting& l, Frame const& frame, ForwardStd constants) {
    ForwardState& f = l.forward;
    ForwardPass pass{f.solid.get(), f.triangles.get(), layer_of(frame), constants};
    record_forward(verbs, l, pass);
    if (!f.has_masked) return;
    pass.layer.load = backend::Load::keep;
    verbs(verbs.device().draw(f.masked.get(), f.target.get(), {&pass.layer, 1}));
    pass.list = f.masked.get();
    pass.constants.once = 1;
    pass.test = backend::FragmentTest::visible;
    pass.color = backend::Load::keep;
    record_forward(verbs, l, pass);
}

/// Depth and ids first, then each pixel once.
void shade_visible(Verbs& verbs, Lighting& l, Frame const& frame, ForwardStd constants) {
    ForwardState& f = l.forward;
    ForwardPass pass{f.all.get(), f.triangles.get(), layer_of(frame), constants, backend::FragmentTest::visible, backend::Load::clear};
    verbs.device().stage("depth_pass");
    verbs(verbs.device().draw(pass.list, f.target.get(), {&pass.layer, 1}));
    verbs.device().stage("shade");
    pass.layer.load = backend::Load::keep;
    pass.constants.once = 1;
    record_forward(verbs, l, pass);
}

LightingOutput gather(Frame const& frame, ForwardGrid const& grid, std::span<math::vec4 const> color) {
    LightingOutput output;
    std::uint64_t computations = 0;
    for (math::vec4 const& c : color) computations += static_cast<std::uint64_t>(c.w);
    for (std::uint32_t const pixel : frame.samples.pixel) {
        math::vec4 const& c = color[pixel];
        output.radiance.emplace_back(c.x, c.y, c.z);
        output.computations.push_back(static_cast<std::uint32_t>(c.w));
    }
    output.counts = {{"lighting_computations", computations},
                     {"light_pairs", grid.pairs},
                     {"lists", grid.lists},
                     {"lights_left_out", grid.left_out}};
    output.bytes = {{"color", color.size_bytes()},
                    {"lists", grid.cells.size() * sizeof(lights::Cell) + grid.indices.size() * sizeof(std::uint32_t)}};
    return output;
}

Result<LightingOutput> run_forward(ForwardKind kind, LightingRun const& on) {
    Verbs verbs(on.device);
    Lighting& l = begin_forward(on, verbs);
    ForwardState& f = l.forward;
    Stopwatch watch;
    auto grid = make_lists(kind, on, l);
    if (!grid) return std::move(grid).failure();
    if (auto ok = check_loops(on.device, *grid, 1); !ok) return std::move(ok).failure();
    std::vector<StageTime> stages{{"assign", watch.lap_ms()}};
    on.device.stage("upload");
    stage_lists(verbs, l, *grid);
    on.device.stage("shade");
    bool const prez = kind == ForwardKind::tiled_prez || kind == ForwardKind::clustered;
    if (prez)
        shade_visible(verbs, l, on.frame, grid->constants);
    else
        shade_in_order(verbs, l, on.frame, grid->constants);
    on.device.stage("");
    math::ivec2 const size = on.frame.view.size_px;
    f.color.resize(pixel_count(size));
    verbs(on.device.read({f.target.get(), 0, backend::Plane::color, {0, 0, size.x, size.y}}, std::as_writable_bytes(std::span(f.color))));
    auto const device_stages = verbs(on.device.finish());
    if (!verbs.good()) return verbs.failure();
    LightingOutput output = gather(on.frame, *grid, f.color);
    output.stages = std::move(stages);
    output.stages.insert(output.stages.end(), device_stages.begin(), device_stages.end());
    return output;
}

}  // namespace

Lighting& begin_forward(LightingRun const& on, Verbs& verbs) {
    Workspace::State& state = on.workspace.state();
    state.move_to(on.device);
    prepare_lights(on.frame, on.lights, state.lighting.prepared);
    state.lighting.forward.fit(verbs, on.frame);
    return state.lighting;
}

void record_forward(Verbs& verbs, Lighting& l, ForwardPass const& pass) {
    ForwardState& f = l.forward;
    std::array const buffers{f.vertices.get(), pass.triangles, f.materials.get(), f.texels.get(), f.rays.get(),
                             l.lights.get(),   f.depths.get(), f.cells.get(),     f.indices.get()};
    backend::TargetBinding const ids{f.target.get(), backend::Plane::triangle};
    bool const over = pass.constants.blends != 0;
    backend::FragmentCall const call{.buffers = buffers,
                                     .targets = {&ids, 1},
                                     .constants = backend::bytes_of(pass.constants),
                                     .test = pass.test,
                                     .blend = over ? backend::Blend::over : backend::Blend::replace_and_add,
                                     .color = pass.color};
    verbs(verbs.device().shade(pass.list, f.target.get(), pass.layer, forward_kernel, call));
}

Result<core::Done> check_loops(backend::Backend const& device, ForwardGrid const& grid, std::uint32_t times) {
    std::uint64_t longest = 0;
    for (lights::Cell const& cell : grid.cells) longest = std::max<std::uint64_t>(longest, cell.count);
    std::uint64_t const others = 128;  // other rounds of a fragment
    if (longest * times + others <= device.limits().loop_rounds) return core::Done{};
    return core::Failure{Error::too_large, std::to_string(longest) + " lights in a list, which a fragment takes in one loop; those of this device end after " +
                                               std::to_string(device.limits().loop_rounds) + " rounds: shade deferred, or use fewer lights"};
}

void stage_lists(Verbs& verbs, Lighting& l, ForwardGrid const& grid) {
    l.lights.fill<lights::ShadedLight>(verbs, l.prepared.shaded);
    l.forward.depths.fill<float>(verbs, grid.depth_m);
    l.forward.cells.fill<lights::Cell>(verbs, grid.cells);
    l.forward.indices.fill<std::uint32_t>(verbs, grid.indices);
}

void ForwardState::fit(Verbs& verbs, Frame const& frame) {
    rays.fill<CameraRays>(verbs, std::array{make_camera_rays(frame.view, frame.geometry->origin_m)});
    if (config.size_px != frame.view.size_px) {
        target = {};
        config = {.size_px = frame.view.size_px, .triangle_ids = true, .color = true};
        target = Held(verbs.device(), verbs(verbs.device().make_target(config)));
    }
    if (surfaces_of == frame.state->surfaces && leaves_out_blended == frame.leaves_out_blended) return;
    surfaces_of = nullptr;
    vertices.fill<VertexStd>(verbs, make_vertices(*frame.geometry));
    triangles.fill<TriangleStd>(verbs, make_triangles(*frame.geometry));
    MaterialTable const table(*frame.scene, {});
    materials.fill<MaterialStd>(verbs, table.materials);
    texels.fill<std::uint32_t>(verbs, table.texels);
    all = {};
    solid = {};
    masked = {};
    draws = make_draws(*frame.scene, *frame.geometry, raster::Cull::none,
                       frame.leaves_out_blended ? Blended::left_out : Blended::as_masked);
    std::vector<backend::Draw> without, with;
    for (backend::Draw const& draw : draws.draws) (draw.alpha_test == nullptr ? without : with).push_back(draw);
    has_masked = !with.empty();
    all = keep(verbs, draws.draws);
    solid = keep(verbs, without);
    masked = keep(verbs, with);
    leaves_out_blended = frame.leaves_out_blended;
    if (verbs.good()) surfaces_of = frame.state->surfaces;
}

backend::PassLayer layer_of(Frame const& frame) noexcept {
    backend::PassLayer layer;
    layer.origin = math::to_float(frame.view.eye_m - frame.geometry->origin_m);
    layer.clip_from_relative = math::clip_from_relative(frame.view);
    layer.depth = frame.view.depth;
    return layer;
}

LightingTechnique forward_technique() noexcept {
    return {"forward", "every light for every fragment, overdraw included", {},
            [](LightingRun const& on) { return run_forward(ForwardKind::all_lights, on); }};
}

LightingTechnique tiled_forward_technique() noexcept {
    return {"tiled-forward", "each fragment under the lights of its tile, overdraw included", forward_params(),
            [](LightingRun const& on) { return run_forward(ForwardKind::tiled, on); }};
}

LightingTechnique tiled_forward_prez_technique() noexcept {
    return {"tiled-forward-prez", "after a pass of depth: lights by tile, culled by each tile's nearest and farthest sample", forward_params(),
            [](LightingRun const& on) { return run_forward(ForwardKind::tiled_prez, on); }};
}

LightingTechnique clustered_forward_technique() noexcept {
    return {"clustered-forward", "after a pass of depth: each visible fragment under the lights of its cluster", forward_params(),
            [](LightingRun const& on) { return run_forward(ForwardKind::clustered, on); }};
}

}  // namespace gnomon::pipeline
