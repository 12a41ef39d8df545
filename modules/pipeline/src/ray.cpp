// The technique `ray`: the exact trace, timed like any other, and what the measures ask the truth.

#include "detail.hpp"
#include "frame_state.hpp"

#include <gnomon/pipeline/measures.hpp>

#include <cmath>

namespace gnomon::pipeline {

namespace {

Result<TechniqueOutput> run_ray(Frame const& frame, Params const&, Workspace&, core::ExecutorRef executor) {
    FrameState const& state = *frame.state;
    TechniqueOutput output;
    Stopwatch watch;
    trace::Bvh const bvh = trace::build_bvh(triangles_of(frame, state), executor);
    double const build_ms = watch.lap_ms();
    std::vector<std::uint8_t> const lit = trace_lit(frame, state, bvh, executor);
    output.stages = {{"build", build_ms}, {"trace", watch.lap_ms()}};
    output.visibility.resize(lit.size());
    for (std::size_t i = 0; i < lit.size(); ++i) output.visibility[i] = lit[i] != 0 ? 1.0F : 0.0F;
    output.counts = {{"lighting_computations", lit.size()}};
    output.bytes = {{"hierarchy", bvh.nodes.size() * sizeof(trace::Node) + bvh.blocks.size() * sizeof(trace::Block)}};
    return output;
}

/// Whether something blocks sample `i` within `reach_m` of it, toward the light.
bool is_blocked_within(Frame const& frame, FrameState const& state, std::size_t i, float reach_m) {
    math::vec3 const& start = frame.samples.position[i];
    predicates::Target const end = predicates::Target::point(start + toward_light(frame, start) * reach_m);
    return with_opacity(frame, state, [&](auto const& opacity) {
        return trace::is_blocked(state.surfaces->bvh, {start, end}, core::TriangleId(frame.samples.triangle[i]), opacity);
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
