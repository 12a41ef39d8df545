// The technique `tiled-deferred-single`: one kernel finds the lights of a tile by its six planes, and shades it; and
// `tiled-deferred-raster`: lights are drawn into the tiles first, by conservative rasterization.
// [Olsson 2014, Paper I, 7, after Lauritzen 2010; and 6.1]

#include "../detail.hpp"
#include "../workspace.hpp"
#include "lighting.hpp"
#include "tile_kernels.hpp"

#include <gnomon/cull/tile_planes.hpp>
#include <gnomon/lights/bounding_ball.hpp>
#include <gnomon/lights/hull.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace gnomon::pipeline {

namespace {

std::array<ParamInfo, 2> const& single_params() noexcept {
    static std::array<ParamInfo, 2> const all{{gbuffer_param, tile_param}};
    return all;
}

/// returns: how many lights are none.
std::uint64_t make_tile_balls(std::span<lights::Light const> lights, std::vector<float>& out) {
    std::size_t const n = (lights.size() + backend::kernel_local_size - 1) / backend::kernel_local_size * backend::kernel_local_size;
    out.assign(4 * n, -1.0F);
    std::uint64_t bad = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        math::Sphere const ball = lights::bounding_ball(lights[i]);
        bad += ball.radius < 0.0F ? 1U : 0U;
        std::array const numbers{ball.center.x, ball.center.y, ball.center.z, ball.radius};
        for (std::size_t k = 0; k < 4; ++k) out[k * n + i] = numbers[k];
    }
    return bad;
}

std::vector<cull::TileBorder> make_borders(cluster::GridView const& grid) {
    std::vector<cull::TileBorder> borders;
    for (std::span<float const> const axis : {grid.x, grid.y})
        for (float const at : axis) borders.push_back(cull::make_tile_border(at, grid.perspective));
    return borders;
}

ShadeTilesStd constants_of(LightingRun const& on, cluster::GridView const& grid, Lighting const& l) {
    auto const size = math::uvec2(on.frame.view.size_px);
    SampleDepth const depth(on.frame);
    math::vec3 const eye = shading_eye(on.frame), from = depth.eye(), forward = depth.forward();
    return {static_cast<std::uint32_t>(on.params.integer("tile")),
            grid.columns(),
            grid.rows(),
            size.x,
            size.y,
            static_cast<std::uint32_t>(l.tile_balls.size() / 4),
            l.format == GBufferFormat::f16 ? 1U : 0U,
            grid.perspective ? 0U : 1U,
            {eye.x, eye.y, eye.z},
            {from.x, from.y, from.z},
            {forward.x, forward.y, forward.z},
            0,
            0,
            0};
}

/// Counts what tiles with samples list.
void add_tile_counts(std::span<std::uint32_t const> lights_of, std::uint64_t bad, LightingOutput& output) {
    std::uint64_t pairs = 0;
    for (std::uint32_t const n : lights_of) pairs += n;
    output.counts.insert(output.counts.end(), {{"light_pairs", pairs}, {"lists", lights_of.size()}, {"lights_left_out", bad}});
}

/// Draws the lights' hulls into the tiles' marks.
void record_marks(LightingRun const& on, Verbs& verbs, cluster::GridView const& grid, Lighting& l) {
    std::vector<lights::Hull> hulls;
    for (lights::Light const& light : l.prepared.culled) hulls.push_back(lights::make_hull(light, grid.perspective));
    std::vector<float> window(grid.x.begin(), grid.x.end());
    window.insert(window.end(), grid.y.begin(), grid.y.end());
    auto const words = static_cast<std::uint32_t>(l.tile_balls.size() / 4 / 32);
    on.device.stage("upload");
    l.hulls.fill<lights::Hull>(verbs, hulls);
    l.window.fill<float>(verbs, window);
    l.marks.fit(verbs, grid.clusters() * words * sizeof(std::uint32_t));
    on.device.stage("insert");
    std::array const cleared{l.marks.get()};
    ClearWordsStd const clear{static_cast<std::uint32_t>(grid.clusters() * words), 0};
    verbs(on.device.run(clear_words_kernel, {clear.count, cleared, {}, backend::bytes_of(clear)}));
    std::array const buffers{l.hulls.get(), l.window.get(), l.marks.get()};
    std::uint32_t const band_rows = std::max(1U, most_iterations / grid.columns());
    std::uint32_t const bands = (grid.rows() + band_rows - 1) / band_rows;
    std::size_t const items = hulls.size() * lights::hull_faces * bands;
    MarkTilesStd const c{static_cast<std::uint32_t>(items), grid.columns(), grid.rows(), words, grid.perspective ? 0U : 1U, bands, band_rows};
    verbs(on.device.run(mark_tiles_kernel, {items, buffers, {}, backend::bytes_of(c)}));
}

Result<LightingOutput> run_tiles(LightingRun const& on, bool marked) {
    Verbs verbs(on.device);
    Lighting& l = begin_lighting(on, verbs);
    Workspace::State& state = on.workspace.state();
    Stopwatch watch;
    auto const grid = make_tile_grid(on);
    if (!grid) return grid.failure();
    cluster::GridView const view = grid->view();
    std::uint64_t const bad = make_tile_balls(l.prepared.culled, l.tile_balls);
    std::vector<StageTime> stages{{"balls", watch.lap_ms()}};
    std::size_t const n = on.frame.samples.size();
    std::vector<std::uint32_t> lights_of(view.clusters());
    l.radiance.fit(verbs, n * sizeof(math::vec3));
    l.computations.fit(verbs, n * sizeof(std::uint32_t));
    l.lights_of.fit(verbs, std::span(lights_of).size_bytes());
    if (marked) record_marks(on, verbs, view, l);
    else l.marks.fit(verbs, 0);
    on.device.stage("upload");
    l.lights.fill<lights::ShadedLight>(verbs, l.prepared.shaded);
    l.sample_of.fill<std::uint32_t>(verbs, on.frame.sample_of_pixel);
    l.balls.fill<float>(verbs, l.tile_balls);
    l.borders.fill<cull::TileBorder>(verbs, make_borders(view));
    on.device.stage("shade");
    std::array const buffers{state.samples.samples.get(), l.gbuffer.get(),  l.lights.get(),       l.sample_of.get(), l.balls.get(),
                             l.borders.get(),             l.radiance.get(), l.computations.get(), l.lights_of.get(), l.marks.get()};
    ShadeTilesStd c = constants_of(on, view, l);
    c.marked = marked ? 1U : 0U;
    std::uint32_t const step = lights_of_run(c.tile);
    do {
        c.end = std::min(c.lights, c.first + step);
        verbs(on.device.run(shade_tiles_kernel, {view.clusters() * backend::kernel_local_size, buffers, {}, backend::bytes_of(c)}));
        c.first = c.end;
    } while (c.first < c.lights);
    on.device.stage("");
    verbs(on.device.read(l.lights_of.get(), 0, std::as_writable_bytes(std::span(lights_of))));
    auto output = read_image(on, verbs, std::move(stages));
    if (output) add_tile_counts(lights_of, bad, *output);
    return output;
}

}  // namespace

LightingTechnique tiled_deferred_single_technique() noexcept {
    return {"tiled-deferred-single", "one kernel tests all lights against a tile's six planes, lists them and shades", single_params(),
            [](LightingRun const& on) { return run_tiles(on, false); }};
}

LightingTechnique tiled_deferred_raster_technique() noexcept {
    return {"tiled-deferred-raster", "lights drawn into an image of one pixel a tile, by conservative rasterization of their hulls", single_params(),
            [](LightingRun const& on) { return run_tiles(on, true); }};
}

}  // namespace gnomon::pipeline
