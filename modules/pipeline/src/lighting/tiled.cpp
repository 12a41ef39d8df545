// The technique `tiled-deferred`: lights per tile, culled by each tile's range of depths. [Olsson 2014, Paper I, 2 and 6.3]

#include "../detail.hpp"
#include "lighting.hpp"
#include "../workspace.hpp"

#include <gnomon/cull/depth_range.hpp>
#include <gnomon/cull/rows.hpp>

#include <array>
#include <limits>
#include <utility>

namespace gnomon::pipeline {

namespace {

std::array<ParamInfo, 2> const& tiled_params() noexcept {
    static std::array<ParamInfo, 2> const all{{gbuffer_param, tile_param}};
    return all;
}

/// Tiles alone: one slice without an end.
Result<cluster::Grid> make_tile_grid(LightingRun const& on) {
    auto const tile = static_cast<std::int32_t>(on.params.integer("tile"));
    std::array<float, 2> const planes{static_cast<float>(on.frame.view.near_m), std::numeric_limits<float>::infinity()};
    auto slices = cluster::make_slices(std::span<float const>(planes));
    if (!slices) return core::Failure{Error::bad_value, slices.failure().message};
    auto grid = cluster::make_grid(on.frame.view, math::ivec2(tile, tile), std::move(slices).value());
    if (!grid) return core::Failure{Error::bad_value, grid.failure().message};
    return std::move(grid).value();
}

/// Each sample's tile, and each tile's nearest and farthest sample.
void find_tiles(LightingRun const& on, cluster::Grid const& grid, Lighting& l) {
    SampleDepth const depth_of(on.frame);
    auto const width = static_cast<std::uint32_t>(on.frame.view.size_px.x);
    l.list_of_sample.resize(on.frame.samples.size());
    l.depth_ranges.assign(grid.clusters(), {});
    for (std::size_t i = 0; i < l.list_of_sample.size(); ++i) {
        std::uint32_t const pixel = on.frame.samples.pixel[i];
        float const depth = depth_of(on.frame.samples.position[i]);
        std::uint32_t const tile = cluster::cluster_at(grid, math::uvec2(pixel % width, pixel / width), depth);
        l.list_of_sample[i] = tile;
        l.depth_ranges[tile].add(depth);
    }
}

/// Takes the lights out of the lists that lie before or behind all samples of the tile.
void cull_by_depth(Lighting& l) {
    std::uint32_t kept = 0;
    l.list_cells.resize(l.dense_cells.size());
    for (std::size_t tile = 0; tile < l.dense_cells.size(); ++tile) {
        lights::Cell const cell = l.dense_cells[tile];
        std::uint32_t const begin = kept;
        for (std::uint32_t k = 0; k < cell.count; ++k) {
            std::uint32_t const index = l.list_indices[cell.offset + k];
            lights::Light const& light = l.prepared.culled[index];
            bool const everywhere = light.kind == lights::Kind::directional;
            if (everywhere || cull::may_touch(l.depth_ranges[tile], light.center.z, light.range_m)) l.list_indices[kept++] = index;
        }
        l.list_cells[tile] = {begin, kept - begin};
    }
    l.list_indices.resize(kept);
}

Result<LightingOutput> run_tiled(LightingRun const& on) {
    Verbs verbs(on.device);
    Lighting& l = begin_lighting(on, verbs);
    Stopwatch watch;
    auto grid = make_tile_grid(on);
    if (!grid) return std::move(grid).failure();
    find_tiles(on, *grid, l);
    double const tiles_ms = watch.lap_ms();
    l.dense_cells.resize(grid->clusters());
    auto const report = lights::count_lists(cull::make_row_grid(grid->view()), l.prepared.culled, {}, l.assignment, l.dense_cells);
    l.list_indices.resize(report.written);
    lights::fill_lists(l.assignment, std::span<std::uint32_t>(l.list_indices));
    cull_by_depth(l);
    auto output = shade_lists(on, verbs, {{"tiles", tiles_ms}, {"assign", watch.lap_ms()}});
    if (output) output->counts.push_back({"lights_left_out", report.lights.bad + std::uint64_t{report.left_out}});
    return output;
}

}  // namespace

LightingTechnique tiled_deferred_technique() noexcept {
    return {"tiled-deferred", "lights assigned to tiles of pixels, culled by each tile's nearest and farthest sample",
            tiled_params(), &run_tiled};
}

}  // namespace gnomon::pipeline
