// The technique `clustered-deferred`: keys, unique clusters, lights per cluster, shading. [Olsson 2014, Paper II, 3]

#include "../detail.hpp"
#include "lighting.hpp"
#include "../workspace.hpp"

#include <gnomon/cull/rows.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gnomon::pipeline {

namespace {

constexpr std::array<std::string_view, 3> methods{"bitmap", "page-table", "sort"};

std::array<ParamInfo, 3> const& clustered_params() noexcept {
    static std::array<ParamInfo, 3> const all{
        {gbuffer_param, tile_param,
         {"unique", ParamKind::choice, "bitmap", 0, 0, "", methods, "how the unique clusters are found; all find the same"}}};
    return all;
}

using Layout = cluster::KeyLayout<std::uint32_t>;

void find_keys(LightingRun const& on, cluster::Grid const& grid, Layout const& layout, std::vector<std::uint32_t>& keys) {
    keys.resize(on.frame.samples.size());
    SampleDepth const depth_of(on.frame);
    auto const width = static_cast<std::uint32_t>(on.frame.view.size_px.x);
    on.executor.parallel_for(keys.size(), sample_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            std::uint32_t const pixel = on.frame.samples.pixel[i];
            keys[i] = cluster::key_at(grid, layout, math::uvec2(pixel % width, pixel / width), depth_of(on.frame.samples.position[i]));
        }
    });
}

/// returns: how many there are; `unique_keys` and `list_of_sample` hold them.
std::size_t find_unique(LightingRun const& on, Layout const& layout, Lighting& l) {
    l.unique_keys.resize(l.keys.size());
    l.list_of_sample.resize(l.keys.size());
    cluster::UniqueOut<std::uint32_t> const out{l.unique_keys, l.list_of_sample};
    std::span<std::uint32_t const> const keys(l.keys);
    auto executor = on.executor;
    std::string_view const method = on.params.word("unique");
    if (method == "sort") return cluster::unique_by_local_sort(layout, keys, out, l.unique, executor).clusters;
    if (method == "page-table") return cluster::unique_by_page_table(layout, keys, out, l.unique, executor).clusters;
    return cluster::unique_by_bitmap(layout, keys, out, l.unique, executor).clusters;
}

/// Assigns the lights to every cluster of the grid, and takes the cells of those that have samples.
lights::ListsReport assign(cluster::Grid const& grid, std::size_t clusters, Lighting& l) {
    cluster::GridView const view = grid.view();
    cull::RowGrid const rows = cull::make_row_grid(view);
    l.dense_cells.resize(view.clusters());
    lights::ListsReport const report = lights::count_lists(rows, l.prepared.culled, {}, l.assignment, l.dense_cells);
    l.list_indices.resize(report.written);
    lights::fill_lists(l.assignment, std::span<std::uint32_t>(l.list_indices));
    l.list_cells.resize(clusters);
    for (std::size_t i = 0; i < clusters; ++i) {
        cluster::KeyParts const p = cluster::unpack_key(l.unique_keys[i]);
        l.list_cells[i] = l.dense_cells[view.index(p.column, p.row, p.slice)];
    }
    return report;
}

Result<LightingOutput> run_clustered(LightingRun const& on) {
    Verbs verbs(on.device);
    Lighting& l = begin_lighting(on, verbs);
    Stopwatch watch;
    auto grid = make_cluster_grid(on);
    if (!grid) return std::move(grid).failure();
    auto const layout = cluster::make_key_layout<std::uint32_t>(grid->view());
    if (!layout) return core::Failure{Error::bad_value, layout.failure().message};
    double const grid_ms = watch.lap_ms();
    find_keys(on, *grid, *layout, l.keys);
    double const keys_ms = watch.lap_ms();
    std::size_t const clusters = find_unique(on, *layout, l);
    double const unique_ms = watch.lap_ms();
    lights::ListsReport const report = assign(*grid, clusters, l);
    std::vector<StageTime> stages{{"grid", grid_ms}, {"keys", keys_ms}, {"unique", unique_ms}, {"assign", watch.lap_ms()}};
    auto output = shade_lists(on, verbs, std::move(stages));
    if (output) output->counts.push_back({"lights_left_out", report.lights.bad + std::uint64_t{report.left_out}});
    return output;
}

}  // namespace

Result<cluster::Grid> make_cluster_grid(LightingRun const& on) {
    SampleDepth const depth_of(on.frame);
    double deepest = on.frame.view.near_m;
    for (math::vec3 const& p : on.frame.samples.position) deepest = std::max(deepest, static_cast<double>(depth_of(p)));
    auto const tile = static_cast<std::int32_t>(on.params.integer("tile"));
    double const end = std::max(deepest, on.frame.view.near_m + 1e-3 * (1.0 + std::abs(on.frame.view.near_m)));
    auto slices = cluster::make_cubical_slices(on.frame.view, tile, end);
    if (!slices) return core::Failure{Error::bad_value, slices.failure().message};
    auto grid = cluster::make_grid(on.frame.view, math::ivec2(tile, tile), std::move(slices).value());
    if (!grid) return core::Failure{Error::bad_value, grid.failure().message};
    return std::move(grid).value();
}

LightingTechnique clustered_deferred_technique() noexcept {
    return {"clustered-deferred", "lights assigned to clusters of tiles and exponential depth slices", clustered_params(), &run_clustered};
}

}  // namespace gnomon::pipeline
