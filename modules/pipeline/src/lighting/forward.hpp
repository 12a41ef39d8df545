#pragma once
// What forward techniques keep on the backend, and their lists of lights by tile or cluster.

#include <gnomon/backend/fragment.hpp>
#include <gnomon/cluster.hpp>
#include <gnomon/lights.hpp>

#include "../detail.hpp"
#include "../staged.hpp"
#include "forward_kernels.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace gnomon::pipeline {

/// A draw list of some of a frame's triangles, on the backend.
struct KeptDraws {
    DrawList draws;  ///< Pointed into by the list.
    Held<backend::DrawListId> list;

    [[nodiscard]] bool empty() const noexcept { return draws.draws.empty(); }
};

/// Of the forward techniques.
struct Forward {
    std::shared_ptr<Surfaces const> surfaces_of;  ///< What the first four buffers and the draws were made of.
    StagedBuffer vertices;
    StagedBuffer triangles;
    StagedBuffer materials;
    StagedBuffer texels;
    StagedBuffer rays;
    StagedBuffer depths;
    KeptDraws all;     ///< With alpha tests where materials have them.
    KeptDraws solid;   ///< Those without.
    KeptDraws masked;  ///< Those with.
    backend::TargetConfig config;
    Held<backend::TargetId> target;
    std::vector<math::vec4> color;

    /// Stages geometry and textures, unless they are there, the view's rays, and the target.
    void fit(Verbs& verbs, Frame const& frame);
};

/// Which lights are evaluated where: a list for each cluster of a grid, tiles being clusters without an end.
struct ForwardGrid {
    ForwardStd constants;
    std::vector<float> depth_m{0.0F, 0.0F};
    std::vector<lights::Cell> cells;
    std::vector<std::uint32_t> indices;
    std::uint64_t left_out = 0;  ///< Lights that are no lights, or do not fit.
};

}  // namespace gnomon::pipeline
