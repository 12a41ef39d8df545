#pragma once
// What forward techniques keep on the backend, and their lists of lights by tile or cluster.

#include <gnomon/backend/fragment.hpp>
#include <gnomon/cull/depth_range.hpp>
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
    bool leaves_out_blended = false;
    Held<backend::DrawListId> all;     ///< With alpha tests where materials have them.
    Held<backend::DrawListId> solid;   ///< Those without.
    Held<backend::DrawListId> masked;  ///< Those with.
    backend::TargetConfig config;
    Held<backend::TargetId> target;
    std::vector<math::vec4> color;
    // Of `shade_transparent`:
    StagedBuffer sorted_triangles;
    Held<backend::TargetId> front;  ///< The nearest transparent triangles.
    math::ivec2 front_px{0, 0};
    // Of `shade_antialiased`:
    Held<backend::TargetId> samples;  ///< Ids; an array layer for each sample.
    math::ivec2 samples_px{0, 0};

    /// Stages geometry and textures, unless they are there, the view's rays, and the target.
    void fit(Verbs& verbs, Frame const& frame);
};

/// Which lights are evaluated where: a list for each cluster of a grid; tiles are clusters without an end.
struct ForwardGrid {
    ForwardStd constants;
    std::vector<float> depth_m{0.0F, 0.0F};
    std::vector<lights::Cell> cells;
    std::vector<std::uint32_t> indices;
    std::size_t lists = 0;       ///< Cells that have one of their own; the others share one of all lights.
    std::size_t pairs = 0;       ///< Indices of those.
    std::uint64_t left_out = 0;  ///< Lights that are none, or had no room.
};

/// One pass of the fragment kernel.
struct ForwardPass {
    backend::DrawListId list;
    backend::BufferId triangles;
    backend::PassLayer layer;
    ForwardStd constants;
    backend::FragmentTest test = backend::FragmentTest::nearer;
    backend::Load color = backend::Load::clear;
};
void record_forward(Verbs& verbs, Lighting& l, ForwardPass const& pass);

/// Sets up the workspace, the lights and what is drawn.
[[nodiscard]] Lighting& begin_forward(LightingRun const& on, Verbs& verbs);

/// A fragment takes its list in one loop, `times` over.
///
/// returns: `too_large` where a list is longer than the device's loops.
[[nodiscard]] Result<core::Done> check_loops(backend::Backend const& device, ForwardGrid const& grid, std::uint32_t times);

/// Stages lights and lists.
void stage_lists(Verbs& verbs, Lighting& l, ForwardGrid const& grid);

/// The view and area of a frame's passes.
[[nodiscard]] backend::PassLayer layer_of(Frame const& frame) noexcept;

/// All lights in one list.
[[nodiscard]] ForwardGrid list_all(Frame const& frame, std::size_t lights);
/// The nearest and farthest depth of each tile, row by row.
struct TileRanges {
    std::uint32_t tile = 32;  ///< Pixels.
    std::uint32_t columns = 0;
    std::vector<cull::DepthRange> ranges;

    TileRanges(math::ivec2 const& size_px, std::uint32_t tile_px);
    [[nodiscard]] cull::DepthRange& of(std::uint32_t x, std::uint32_t y) noexcept {
        return ranges[std::size_t{y / tile} * columns + x / tile];
    }
};
/// Of a frame's samples.
[[nodiscard]] TileRanges ranges_of_samples(Frame const& frame, std::uint32_t tile_px);
/// Lights by tile; with `ranges`, without those before or behind all of the tile's.
[[nodiscard]] Result<ForwardGrid> list_by_tile(LightingRun const& on, Lighting& l, std::uint32_t tile_px, TileRanges const* ranges);
/// Lights by cluster, of the clusters that have samples: a fragment in another one, as where the device shows another of two
/// surfaces at one depth, is under all lights. The run has a parameter `tile`.
[[nodiscard]] Result<ForwardGrid> list_by_sample_clusters(LightingRun const& on, Lighting& l);
/// Lights by cluster, of all clusters up to a depth: for fragments that are no samples.
[[nodiscard]] Result<ForwardGrid> list_by_cluster(LightingRun const& on, Lighting& l, std::uint32_t tile_px, double deepest_m);

}  // namespace gnomon::pipeline
