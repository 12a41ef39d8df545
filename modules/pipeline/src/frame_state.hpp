#pragma once
// The hidden part of a frame, and how the truth is asked.

#include <gnomon/core/executor.hpp>
#include <gnomon/pipeline/frame.hpp>
#include <gnomon/predicates/target.hpp>
#include <gnomon/predicates/triangle_list.hpp>
#include <gnomon/sample.hpp>
#include <gnomon/trace.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace gnomon::pipeline {

/// What depends on scene and geometry only, and so may serve many frames.
struct Surfaces {
    std::vector<math::uvec3> corners;  ///< The geometry's indices, three by three.
    trace::Bvh bvh;                    ///< Empty where no truth was asked for yet.
    bool masked = false;               ///< Some triangles have holes; otherwise the lists below are empty.
    std::vector<trace::AlphaMaterial> materials;
    std::vector<math::AlphaTexture> textures;
    std::vector<math::vec2> corner_uv;
};

struct FrameState {
    std::shared_ptr<Surfaces const> surfaces;
    std::vector<sample::ViewSample> samples;
    predicates::Target eye;
    predicates::Target light;
};

[[nodiscard]] inline predicates::TriangleList triangles_of(Frame const& frame, FrameState const& state) noexcept {
    return {frame.geometry->positions, state.surfaces->corners};
}

/// Calls `use` with the opacity of the frame's triangles.
template <class Use>
auto with_opacity(Frame const& frame, FrameState const& state, Use&& use) {
    Surfaces const& s = *state.surfaces;
    if (!s.masked) return use(trace::Solid{});
    return use(trace::AlphaTest{frame.geometry->triangle_material, s.materials, s.textures, s.corner_uv});
}

/// What the truth is asked, but for the samples.
template <class F>
[[nodiscard]] trace::VisibilityConfig<F> config_of(Frame const& frame, FrameState const& state, F const& opacity) {
    return {state.light, trace::OwnPlane{triangles_of(frame, state), state.eye}, opacity};
}

/// 1 for each sample that the light reaches in `bvh`, 0 for the others.
[[nodiscard]] std::vector<std::uint8_t> trace_lit(Frame const& frame, FrameState const& state, trace::Bvh const& bvh,
                                                  core::ExecutorRef executor);

}  // namespace gnomon::pipeline
