#pragma once
// What forward techniques keep on the backend, and their lists of lights by tile or cluster.

#include <gnomon/backend/fragment.hpp>
#include <gnomon/lights.hpp>

#include "../detail.hpp"
#include "../staged.hpp"
#include "forward_kernels.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace gnomon::pipeline {

struct Lighting;

/// Of the forward techniques.
struct ForwardState {
    std::shared_ptr<Surfaces const> surfaces_of;  ///< What the geometry, textures and draws were made of.
    StagedBuffer vertices;
    StagedBuffer triangles;
    StagedBuffer materials;
    StagedBuffer texels;
    StagedBuffer rays;
    StagedBuffer depths;
    StagedBuffer cells;
    StagedBuffer indices;
    DrawList draws;
    bool has_masked = false;
    Held<backend::DrawListId> all;     ///< With alpha tests where materials have them.
    Held<backend::DrawListId> solid;   ///< Those without.
    Held<backend::DrawListId> masked;  ///< Those with.
    backend::TargetConfig config;
    Held<backend::TargetId> target;
    std::vector<math::vec4> color;

    /// Stages geometry and textures, unless they are there, the view's rays, and the target.
    void fit(Verbs& verbs, Frame const& frame);
};

/// Which lights are evaluated where: a list for each cluster of a grid; tiles are clusters without an end.
struct ForwardGrid {
    ForwardStd constants;
    std::vector<float> depth_m{0.0F, 0.0F};
    std::vector<lights::Cell> cells;
    std::vector<std::uint32_t> indices;
    std::uint64_t left_out = 0;  ///< Lights that are none, or had no room.
};

/// The view and area of a frame's passes.
[[nodiscard]] backend::PassLayer layer_of(Frame const& frame) noexcept;

/// All lights in one list.
[[nodiscard]] ForwardGrid list_all(Frame const& frame, std::size_t lights);
/// Lights by tile; with `by_depth`, without those before or behind all samples of the tile.
[[nodiscard]] Result<ForwardGrid> list_by_tile(LightingRun const& on, Lighting& l, bool by_depth);
/// Lights by cluster, of all clusters: a fragment need not be a sample.
[[nodiscard]] Result<ForwardGrid> list_by_cluster(LightingRun const& on, Lighting& l);

}  // namespace gnomon::pipeline
