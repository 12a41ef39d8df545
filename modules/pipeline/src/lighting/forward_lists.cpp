// The lists of lights that fragments look up.

#include "forward.hpp"
#include "lighting.hpp"

#include <gnomon/cull/depth_range.hpp>
#include <gnomon/cull/rows.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <numeric>
#include <utility>

namespace gnomon::pipeline {

namespace {

ForwardGrid make_empty(cluster::GridView const& view, std::uint32_t tile) {
    ForwardGrid made;
    made.constants.tile = tile;
    made.constants.columns = view.columns();
    made.constants.rows = view.rows();
    made.constants.slices = view.slices();
    made.depth_m.assign(view.depth_m.begin(), view.depth_m.end());
    made.cells.resize(view.clusters());
    return made;
}

/// Lists of every cluster of a grid.
ForwardGrid list_by(cluster::Grid const& grid, std::uint32_t tile, Lighting& l) {
    cluster::GridView const view = grid.view();
    ForwardGrid made = make_empty(view, tile);
    auto const report = lights::count_lists(cull::make_row_grid(view), l.prepared.culled, {}, l.assignment, made.cells);
    made.indices.resize(report.written);
    lights::fill_lists(l.assignment, std::span<std::uint32_t>(made.indices));
    made.lists = made.cells.size();
    made.pairs = made.indices.size();
    made.left_out = report.lights.bad + std::uint64_t{report.left_out};
    return made;
}

/// Clusters that have samples, whose depths may be off a little, ascending. All of a sample's clusters, if it is near a border.
void find_occupied(LightingRun const& on, cluster::Grid const& grid, Lighting& l) {
    std::vector<std::uint8_t> occupied(grid.clusters(), 0);
    SampleDepth const depth_of(on.frame);
    auto const width = static_cast<std::uint32_t>(on.frame.view.size_px.x);
    on.executor.parallel_for(on.frame.samples.size(), sample_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            std::uint32_t const pixel = on.frame.samples.pixel[i];
            float const depth = depth_of(on.frame.samples.position[i]);
            for (float const off : {-l.prepared.rounding_m, l.prepared.rounding_m}) {
                std::uint32_t const at = cluster::cluster_at(grid, math::uvec2(pixel % width, pixel / width), depth + off);
                std::atomic_ref<std::uint8_t>(occupied[at]).store(1, std::memory_order_relaxed);
            }
        }
    });
    l.clusters.clear();
    cluster::GridView const view = grid.view();
    for (std::size_t i = 0; i < occupied.size(); ++i)
        if (occupied[i] != 0) l.clusters.push_back(cluster::coordinates_of(view, i));
}

/// Lists of `l.clusters`; the other cells have one of all lights that are sound.
ForwardGrid list_occupied(LightingRun const& on, cluster::Grid const& grid, Lighting& l) {
    cluster::GridView const view = grid.view();
    ForwardGrid made = make_empty(view, static_cast<std::uint32_t>(on.params.integer("tile")));
    lights::build_light_tree(l.prepared.culled, ~0U, l.tree_work, l.tree, on.executor);
    cull::RowGrid const rows = cull::make_row_grid(view);
    l.list_cells.resize(l.clusters.size());
    lights::SparseConfig const config{.capacity = 0xFFFFFFFFU - l.prepared.culled.size()};
    auto const report = lights::count_sparse_lists({rows, l.prepared.culled, l.tree, l.clusters}, config, l.sparse, l.list_cells, on.executor);
    made.indices.resize(report.written);
    lights::fill_sparse_lists(l.sparse, l.list_cells, std::span<std::uint32_t>(made.indices), on.executor);
    made.lists = l.clusters.size();
    made.pairs = made.indices.size();
    made.left_out = report.lights.bad + std::uint64_t{report.left_out};
    for (std::uint32_t i = 0; i < l.prepared.culled.size(); ++i)
        if (lights::is_sound(l.prepared.culled[i])) made.indices.push_back(i);
    lights::Cell const all{static_cast<std::uint32_t>(made.pairs), static_cast<std::uint32_t>(made.indices.size() - made.pairs)};
    std::fill(made.cells.begin(), made.cells.end(), all);
    for (std::size_t i = 0; i < l.clusters.size(); ++i)
        made.cells[view.index(l.clusters[i].column, l.clusters[i].row, l.clusters[i].slice)] = l.list_cells[i];
    return made;
}

/// Takes the lights out that lie before or behind all of a tile's range.
void cull_tiles(std::span<cull::DepthRange const> ranges, std::span<lights::Light const> lights, ForwardGrid& grid) {
    std::uint32_t kept = 0;
    for (std::size_t tile = 0; tile < grid.cells.size(); ++tile) {
        lights::Cell const cell = grid.cells[tile];
        std::uint32_t const begin = kept;
        for (std::uint32_t k = 0; k < cell.count; ++k) {
            std::uint32_t const index = grid.indices[cell.offset + k];
            lights::Light const& light = lights[index];
            bool const everywhere = light.kind == lights::Kind::directional;
            if (everywhere || cull::may_touch(ranges[tile], light.center.z, light.range_m)) grid.indices[kept++] = index;
        }
        grid.cells[tile] = {begin, kept - begin};
    }
    grid.indices.resize(kept);
    grid.pairs = kept;
}

}  // namespace

TileRanges::TileRanges(math::ivec2 const& size_px, std::uint32_t tile_px)
    : tile(tile_px),
      columns((static_cast<std::uint32_t>(size_px.x) + tile_px - 1) / tile_px),
      ranges(std::size_t{columns} * ((static_cast<std::uint32_t>(size_px.y) + tile_px - 1) / tile_px)) {}

TileRanges ranges_of_samples(Frame const& frame, std::uint32_t tile_px) {
    TileRanges made(frame.view.size_px, tile_px);
    SampleDepth const depth_of(frame);
    auto const width = static_cast<std::uint32_t>(frame.view.size_px.x);
    for (std::size_t i = 0; i < frame.samples.size(); ++i) {
        std::uint32_t const pixel = frame.samples.pixel[i];
        made.of(pixel % width, pixel / width).add(depth_of(frame.samples.position[i]));
    }
    return made;
}

ForwardGrid list_all(Frame const& frame, std::size_t lights) {
    ForwardGrid made;
    made.constants.tile = static_cast<std::uint32_t>(std::max(frame.view.size_px.x, frame.view.size_px.y));
    made.cells = {{0, static_cast<std::uint32_t>(lights)}};
    made.indices.resize(lights);
    std::iota(made.indices.begin(), made.indices.end(), 0U);
    made.lists = 1;
    made.pairs = lights;
    return made;
}

Result<ForwardGrid> list_by_tile(LightingRun const& on, Lighting& l, std::uint32_t tile_px, TileRanges const* ranges) {
    auto const tile = static_cast<std::int32_t>(tile_px);
    std::array<float, 2> const planes{static_cast<float>(on.frame.view.near_m), std::numeric_limits<float>::infinity()};
    auto slices = cluster::make_slices(std::span<float const>(planes));
    if (!slices) return core::Failure{Error::bad_value, slices.failure().message};
    auto grid = cluster::make_grid(on.frame.view, math::ivec2(tile, tile), std::move(slices).value());
    if (!grid) return core::Failure{Error::bad_value, grid.failure().message};
    ForwardGrid made = list_by(*grid, tile_px, l);
    if (ranges != nullptr) cull_tiles(ranges->ranges, l.prepared.culled, made);
    return made;
}

Result<ForwardGrid> list_by_sample_clusters(LightingRun const& on, Lighting& l) {
    auto grid = make_cluster_grid(on);
    if (!grid) return std::move(grid).failure();
    find_occupied(on, *grid, l);
    return list_occupied(on, *grid, l);
}

Result<ForwardGrid> list_by_cluster(LightingRun const& on, Lighting& l, std::uint32_t tile_px, double deepest_m) {
    auto grid = make_cluster_grid(on.frame.view, static_cast<std::int32_t>(tile_px), deepest_m);
    if (!grid) return std::move(grid).failure();
    return list_by(*grid, tile_px, l);
}

}  // namespace gnomon::pipeline
