// The technique `clustered-deferred-device`: clustered shading whose keys, unique clusters, light tree and lists the backend
// makes itself. The host makes the grid and places the lights, both in double. [Olsson 2014, Paper II, 3, 4]

#include "../detail.hpp"
#include "../workspace.hpp"
#include "device_lists.hpp"
#include "lighting.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace gnomon::pipeline {

namespace {

std::array<ParamInfo, 2> const& clustered_device_params() noexcept {
    static std::array<ParamInfo, 2> const all{{gbuffer_param, tile_param}};
    return all;
}

/// Times of a stage that is recorded twice are added up.
void add_stages(std::span<StageTime const> more, std::vector<StageTime>& stages) {
    for (StageTime const& stage : more) {
        auto const same = std::find_if(stages.begin(), stages.end(), [&](StageTime const& s) { return s.name == stage.name; });
        if (same != stages.end()) same->ms += stage.ms;
        else stages.push_back(stage);
    }
}

void record_count(LightingRun const& on, Verbs& verbs, DeviceListsInput const& in, DeviceLists& lists) {
    on.device.stage("keys");
    lists.find_keys(verbs, in);
    on.device.stage("unique");
    lists.find_unique(verbs, in);
    on.device.stage("bvh");
    lists.build_tree(verbs, in);
    on.device.stage("assign");
    lists.count(verbs, in);
    on.device.stage("");
}

void record_shade(LightingRun const& on, Verbs& verbs, DeviceLists const& lists, LightingOutput& output) {
    Workspace::State& state = on.workspace.state();
    Lighting& l = state.lighting;
    std::size_t const n = on.frame.samples.size();
    on.device.stage("shade");
    std::array const buffers{state.samples.samples.get(), l.gbuffer.get(),     l.lights.get(),   lists.index.get(),
                             lists.cells.get(),           lists.ordered.get(), l.radiance.get(), l.computations.get()};
    bool const orthographic = on.frame.view.lens == math::Lens::orthographic;
    math::vec3 const eye = shading_eye(on.frame);
    ShadeListsStd const c{static_cast<std::uint32_t>(n), l.format == GBufferFormat::f16 ? 1U : 0U, orthographic ? 1U : 0U, {eye.x, eye.y, eye.z}, 0, 0};
    run_shade_lists(verbs, buffers, c, lists.sizes().state.longest);
    on.device.stage("");
    output.radiance.resize(n);
    output.computations.resize(n);
    verbs(on.device.read(l.radiance.get(), 0, std::as_writable_bytes(std::span(output.radiance))));
    verbs(on.device.read(l.computations.get(), 0, std::as_writable_bytes(std::span(output.computations))));
}

void add_counts(LightingRun const& on, Lighting const& l, DeviceListsSizes const& sizes, LightingOutput& output) {
    std::uint64_t computations = 0;
    for (std::uint32_t const c : output.computations) computations += c;
    output.counts = {{"lighting_computations", computations},
                     {"light_pairs", sizes.pairs},
                     {"lists", sizes.state.clusters},
                     {"lights_left_out", sizes.state.bad}};
    output.bytes = {{"gbuffer", on.frame.samples.size() * words_of(l.format) * sizeof(std::uint32_t)},
                    {"lists", sizes.state.clusters * sizeof(lights::Cell) + sizes.pairs * sizeof(std::uint32_t)}};
}

Result<LightingOutput> run_clustered_device(LightingRun const& on) {
    Verbs verbs(on.device);
    Lighting& l = begin_lighting(on, verbs);
    Stopwatch watch;
    auto const grid = make_cluster_grid(on);
    if (!grid) return grid.failure();
    auto const layout = make_device_layout(grid->view());
    if (!layout) return layout.failure();
    LightingOutput output;
    output.stages = {{"grid", watch.lap_ms()}};
    Workspace::State& state = on.workspace.state();
    DeviceListsInput const in{on.frame, *grid, *layout, l.prepared.culled, state.samples.samples.get(), state.samples.normals.get()};
    DeviceLists& lists = l.on_device;
    l.radiance.fit(verbs, on.frame.samples.size() * sizeof(math::vec3));
    l.computations.fit(verbs, on.frame.samples.size() * sizeof(std::uint32_t));
    on.device.stage("upload");
    l.lights.fill<lights::ShadedLight>(verbs, l.prepared.shaded);
    if (auto ok = lists.upload(verbs, in); !ok) return std::move(ok).failure();
    record_count(on, verbs, in, lists);
    add_stages(verbs(on.device.finish()), output.stages);
    if (!verbs.good()) return verbs.failure();
    if (lists.sizes().pairs == ~0U)
        return core::Failure{Error::too_large, "light lists of 2^32 - 1 lights or more: fewer or smaller lights, or larger tiles"};
    on.device.stage("assign");
    lists.fill(verbs, in);
    record_shade(on, verbs, lists, output);
    add_stages(verbs(on.device.finish()), output.stages);
    if (!verbs.good()) return verbs.failure();
    add_counts(on, l, lists.sizes(), output);
    return output;
}

}  // namespace

LightingTechnique clustered_deferred_device_technique() noexcept {
    return {"clustered-deferred-device", "clustered-deferred with clusters, light tree and lists made by the backend", clustered_device_params(),
            &run_clustered_device};
}

}  // namespace gnomon::pipeline
