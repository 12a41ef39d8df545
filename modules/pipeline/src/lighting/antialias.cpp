// Images of four samples a pixel: shaded once a fragment, or where the samples of a pixel differ. [Olsson 2014, Paper I, 2.1
// and 3.1]

#include "antialias_kernels.hpp"
#include "forward.hpp"
#include "lighting.hpp"
#include "../workspace.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace gnomon::pipeline {

namespace {

/// Each sample is an array layer: the frame's view, moved until the sample lies at the pixel's centre.
std::array<backend::PassLayer, antialias_samples> sample_layers(Frame const& frame) noexcept {
    std::array<backend::PassLayer, antialias_samples> layers;
    for (std::uint32_t s = 0; s < antialias_samples; ++s) {
        layers[s] = layer_of(frame);
        layers[s].layer = s;
        layers[s].subpixel = {static_cast<std::int32_t>((0.5F - sample_px[s].x) * 256.0F),
                              static_cast<std::int32_t>((0.5F - sample_px[s].y) * 256.0F)};
    }
    return layers;
}

void fit_samples(Verbs& verbs, Frame const& frame, ForwardState& f) {
    if (f.samples_px == frame.view.size_px) return;
    f.samples = {};
    f.samples_px = frame.view.size_px;
    f.samples = Held(verbs.device(), verbs(verbs.device().make_target({.size_px = f.samples_px, .layers = antialias_samples, .triangle_ids = true})));
}

}  // namespace

Result<AntialiasedOutput> shade_antialiased(LightingRun const& on, AntialiasConfig const& config) {
    GNOMON_EXPECT(config.tile_px > 0);
    Verbs verbs(on.device);
    Lighting& l = begin_forward(on, verbs);
    ForwardState& f = l.forward;
    fit_samples(verbs, on.frame, f);
    Stopwatch watch;
    auto const grid = list_by_tile(on, l, static_cast<std::uint32_t>(config.tile_px), nullptr);
    if (!grid) return grid.failure();
    if (auto ok = check_loops(on.device, *grid, antialias_samples); !ok) return std::move(ok).failure();
    std::vector<StageTime> stages{{"assign", watch.lap_ms()}};
    on.device.stage("depth_pass");
    auto const layers = sample_layers(on.frame);
    verbs(on.device.draw(f.all.get(), f.samples.get(), layers));
    on.device.stage("shade");
    stage_lists(verbs, l, *grid);
    std::size_t const pixels = pixel_count(on.frame.view.size_px);
    f.color.resize(pixels);
    l.radiance.fit(verbs, pixels * sizeof(math::vec4));
    std::array const buffers{f.vertices.get(), f.triangles.get(), f.materials.get(), f.texels.get(),  f.rays.get(),
                             l.lights.get(),   f.cells.get(),     f.indices.get(),   l.radiance.get()};
    backend::TargetBinding const ids{f.samples.get(), backend::Plane::triangle};
    ShadeSamplesStd const constants{static_cast<std::uint32_t>(on.frame.view.size_px.x), static_cast<std::uint32_t>(on.frame.view.size_px.y),
                                    grid->constants.tile, grid->constants.columns, config.edges_only ? 1U : 0U};
    verbs(on.device.run(shade_samples_kernel, {pixels, buffers, {&ids, 1}, backend::bytes_of(constants)}));
    on.device.stage("");
    verbs(on.device.read(l.radiance.get(), 0, std::as_writable_bytes(std::span(f.color))));
    auto const device_stages = verbs(on.device.finish());
    if (!verbs.good()) return verbs.failure();
    AntialiasedOutput output;
    std::uint64_t computations = 0;
    for (math::vec4 const& c : f.color) {
        output.image.emplace_back(c.x, c.y, c.z);
        computations += static_cast<std::uint64_t>(c.w);
    }
    output.counts = {{"lighting_computations", computations}, {"light_pairs", grid->pairs}, {"lists", grid->lists}};
    output.stages = std::move(stages);
    output.stages.insert(output.stages.end(), device_stages.begin(), device_stages.end());
    return output;
}

}  // namespace gnomon::pipeline
