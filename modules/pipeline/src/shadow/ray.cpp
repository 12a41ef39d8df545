// The technique `ray`: the exact trace, timed like any other, and what the measures ask the truth.

#include "../detail.hpp"
#include "../frame_state.hpp"
#include "kernels.hpp"
#include "../workspace.hpp"

#include <gnomon/pipeline/measures.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace gnomon::pipeline {

namespace {

RayStd constants_of(Frame const& frame, trace::Bvh const& bvh) {
    Surfaces const& s = *frame.state->surfaces;
    predicates::Target const& light = frame.state->light;
    predicates::Target const& eye = frame.state->eye;
    auto const size = [](auto const& list) { return static_cast<std::uint32_t>(list.size()); };
    return {.count = size(frame.samples),
            .nodes = size(bvh.nodes),
            .positions = size(frame.geometry->positions),
            .triangles = size(s.corners),
            .light = {light.xyz.x, light.xyz.y, light.xyz.z},
            .light_at_infinity = light.at_infinity ? 1U : 0U,
            .eye = {eye.xyz.x, eye.xyz.y, eye.xyz.z},
            .eye_at_infinity = eye.at_infinity ? 1U : 0U,
            .masked = s.masked ? 1U : 0U,
            .material_of = s.masked ? size(frame.geometry->triangle_material) : 0,
            .materials = size(s.materials),
            .textures = size(s.textures),
            .corner_uv = size(s.corner_uv)};
}

/// Stages the hierarchy, asks the kernel, and reads its answers.
std::span<backend::StageTime const> trace_all(Verbs& verbs, TechniqueRun const& on, trace::Bvh const& bvh) {
    Workspace::State& state = on.workspace.state();
    Rays& rays = state.rays;
    std::size_t const n = on.frame.samples.size();
    rays.nodes.fit(verbs, bvh.nodes.size() * sizeof(trace::Node));
    rays.blocks.fit(verbs, bvh.blocks.size() * sizeof(trace::Block));
    rays.answers.fit(verbs, n * sizeof(std::uint32_t));
    rays.answer.resize(n);
    on.device.stage("upload");
    rays.nodes.fill<trace::Node>(verbs, bvh.nodes);
    rays.blocks.fill<trace::Block>(verbs, bvh.blocks);
    on.device.stage("trace");
    StagedSurfaces const& s = rays.surfaces;
    std::array const buffers{rays.nodes.get(),    rays.blocks.get(),           s.positions.get(),
                             s.corners.get(),     state.samples.samples.get(), state.samples.reached.get(),
                             s.material_of.get(), s.materials.get(),           s.textures.get(),
                             s.texels.get(),      s.corner_uv.get(),           rays.answers.get()};
    RayStd const constants = constants_of(on.frame, bvh);
    verbs(on.device.run(ray_kernel, {n, buffers, {}, backend::bytes_of(constants)}));
    on.device.stage("");
    verbs(on.device.read(rays.answers.get(), 0, std::as_writable_bytes(std::span(rays.answer))));
    return verbs(on.device.finish());
}

/// Decides exactly what the kernel was unsure of.
///
/// returns: how many that were.
std::uint64_t settle(TechniqueRun const& on, trace::Bvh const& bvh, std::span<std::uint32_t> answers) {
    constexpr auto unsure = static_cast<std::uint32_t>(RayAnswer::unsure);
    FrameState const& state = *on.frame.state;
    auto const count = static_cast<std::uint64_t>(std::count(answers.begin(), answers.end(), unsure));
    if (count == 0) return 0;
    with_opacity(on.frame, state, [&](auto const& opacity) {
        auto const config = config_of(on.frame, state, opacity);
        on.executor.parallel_for(answers.size(), sample_grain, [&](std::size_t begin, std::size_t end) {
            trace::VisibilityStats stats;
            for (std::size_t i = begin; i < end; ++i)
                if (answers[i] == unsure) answers[i] = trace::is_shadowed(bvh, state.samples[i], config, stats) ? 0 : 1;
        });
    });
    return count;
}

Result<TechniqueOutput> run_ray(TechniqueRun const& on) {
    Workspace::State& state = on.workspace.state();
    state.move_to(on.device);
    Verbs verbs(on.device);
    state.samples.fit(verbs, on.frame);
    state.rays.surfaces.fit(verbs, on.frame);
    Stopwatch watch;
    trace::Bvh const bvh = trace::build_bvh(triangles_of(on.frame, *on.frame.state), on.executor);
    double const build_ms = watch.lap_ms();
    auto const stages = trace_all(verbs, on, bvh);
    if (!verbs.good()) return verbs.failure();
    TechniqueOutput output;
    output.stages = {{"build", build_ms}};
    output.stages.insert(output.stages.end(), stages.begin(), stages.end());
    std::vector<std::uint32_t>& answer = state.rays.answer;
    (void)watch.lap_ms();
    std::uint64_t const unsure = settle(on, bvh, answer);
    output.stages.push_back({"settle", watch.lap_ms()});
    output.visibility.resize(answer.size());
    for (std::size_t i = 0; i < answer.size(); ++i) output.visibility[i] = answer[i] == 1 ? 1.0F : 0.0F;
    output.counts = {{"lighting_computations", answer.size()}, {"uncertain_samples", unsure}};
    output.bytes = {{"hierarchy", bvh.nodes.size() * sizeof(trace::Node) + bvh.blocks.size() * sizeof(trace::Block)}};
    return output;
}

/// Whether something blocks sample `i` within `reach_m` of it, toward the light.
bool is_blocked_within(Frame const& frame, FrameState const& state, std::size_t i, float reach_m) {
    math::vec3 const& start = frame.samples.position[i];
    predicates::Target const end = predicates::Target::point(start + toward_light(frame, start) * reach_m);
    return with_opacity(frame, state, [&](auto const& opacity) {
        return trace::is_blocked(state.surfaces->bvh, {start, end}, core::TriangleId(frame.samples.triangle[i]),
                                 opacity);
    });
}

}  // namespace

std::uint64_t count_detached(Frame const& frame, TechniqueOutput const& output, core::ExecutorRef executor) {
    if (output.bias_m.empty()) return 0;
    std::size_t const n = frame.samples.size();
    std::vector<std::uint8_t> detached(n, 0);
    executor.parallel_for(n, sample_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (verdict_of(output.visibility[i], frame.lit[i]) != Verdict::false_lit) continue;
            detached[i] = is_blocked_within(frame, *frame.state, i, output.bias_m[i]) ? 1 : 0;
        }
    });
    std::uint64_t count = 0;
    for (std::uint8_t const d : detached) count += d;
    return count;
}

Technique ray_technique() noexcept {
    return {"ray", "an exact shadow ray for every sample: the truth itself, and what it costs", {}, &run_ray, nullptr};
}

}  // namespace gnomon::pipeline
