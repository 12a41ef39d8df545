// The techniques `tiled-deferred` and `tiled-deferred-en`: lights per tile, culled by each tile's range of depths, and by a cone
// of its normals. [Olsson 2014, Paper I, 2 and 6.3; Paper II, 4]

#include "../detail.hpp"
#include "lighting.hpp"
#include "../workspace.hpp"

#include <gnomon/cull/depth_range.hpp>
#include <gnomon/cull/normal_cone.hpp>
#include <gnomon/cull/rows.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>

namespace gnomon::pipeline {

namespace {

std::array<ParamInfo, 2> const& tiled_params() noexcept {
    static std::array<ParamInfo, 2> const all{{gbuffer_param, tile_param}};
    return all;
}

/// The samples of a row of tiles: they stand in the order of their pixels.
std::pair<std::size_t, std::size_t> samples_between(std::span<std::uint32_t const> pixels, std::uint64_t first_pixel, std::uint64_t end_pixel) {
    auto const begin = std::lower_bound(pixels.begin(), pixels.end(), first_pixel);
    auto const end = std::lower_bound(begin, pixels.end(), end_pixel);
    return {static_cast<std::size_t>(begin - pixels.begin()), static_cast<std::size_t>(end - pixels.begin())};
}

/// Each sample's tile, and each tile's nearest and farthest sample. Rows of tiles share none.
void find_tiles(LightingRun const& on, cluster::Grid const& grid, Lighting& l) {
    SampleDepth const depth_of(on.frame);
    auto const width = static_cast<std::uint32_t>(on.frame.view.size_px.x);
    std::span<std::uint32_t const> const pixels(on.frame.samples.pixel);
    std::uint64_t const row_pixels = std::uint64_t{width} * static_cast<std::uint64_t>(on.params.integer("tile"));
    l.list_of_sample.resize(pixels.size());
    l.depth_ranges.assign(grid.clusters(), {});
    on.executor.parallel_for(grid.view().rows(), 1, [&](std::size_t first_row, std::size_t end_row) {
        auto const [begin, end] = samples_between(pixels, first_row * row_pixels, end_row * row_pixels);
        for (std::size_t i = begin; i < end; ++i) {
            float const depth = depth_of(on.frame.samples.position[i]);
            std::uint32_t const tile = cluster::cluster_at(grid, math::uvec2(pixels[i] % width, pixels[i] / width), depth);
            l.list_of_sample[i] = tile;
            l.depth_ranges[tile].add(depth);
        }
    });
}

/// The box of a tile between its nearest and its farthest sample.
math::Aabb box_of(cluster::GridView const& grid, std::size_t tile, cull::DepthRange const& depths) {
    std::size_t const column = tile % grid.columns(), row = tile / grid.columns();
    std::array const depth_m{depths.near_m, depths.far_m};
    return cluster::implicit_bounds({grid.x.subspan(column, 2), grid.y.subspan(row, 2), depth_m, grid.perspective}, {});
}

/// Which lights a tile keeps of those that touch its pyramid.
class TileTest {
  public:
    TileTest(Lighting const& l, cluster::GridView const& grid, std::size_t tile, bool normals) : range_(l.depth_ranges[tile]), normals_(normals) {
        if (!normals || !(range_.near_m <= range_.far_m)) return;
        ball_ = cull::ball_of(box_of(grid, tile, range_));
        ball_.radius += l.prepared.facing_slack_m;
        cone_ = {l.cones[tile].axis, l.cones[tile].cos_half};
    }
    [[nodiscard]] bool keeps(lights::Light const& light) const noexcept {
        if (light.kind == lights::Kind::directional) return true;
        return cull::may_touch(range_, light.center.z, light.range_m) && (!normals_ || cull::may_face(cone_, ball_, light.center));
    }

  private:
    cull::DepthRange range_;
    math::Sphere ball_;
    cull::NormalCone cone_;
    bool normals_;
};

/// Takes the lights out of the lists that lie before or behind all samples of the tile, or behind all of their surfaces.
void cull_tiles(cluster::GridView const& grid, bool normals, Lighting& l) {
    std::uint32_t kept = 0;
    l.list_cells.resize(l.dense_cells.size());
    for (std::size_t tile = 0; tile < l.dense_cells.size(); ++tile) {
        TileTest const test(l, grid, tile, normals);
        lights::Cell const cell = l.dense_cells[tile];
        std::uint32_t const begin = kept;
        for (std::uint32_t k = 0; k < cell.count; ++k) {
            std::uint32_t const index = l.list_indices[cell.offset + k];
            if (test.keeps(l.prepared.culled[index])) l.list_indices[kept++] = index;
        }
        l.list_cells[tile] = {begin, kept - begin};
    }
    l.list_indices.resize(kept);
}

/// `normals`: lights behind all surfaces of a tile are culled by a cone of their normals.
Result<lights::ListsReport> find_lists(LightingRun const& on, bool normals, std::vector<StageTime>& stages) {
    Lighting& l = on.workspace.state().lighting;
    Stopwatch watch;
    auto grid = make_tile_grid(on);
    if (!grid) return std::move(grid).failure();
    find_tiles(on, *grid, l);
    stages.push_back({"tiles", watch.lap_ms()});
    if (normals) {
        turn_normals(on, l.format, l.sample_vectors);
        l.cones.resize(grid->clusters());
        auto executor = on.executor;
        (void)cluster::explicit_cones(l.list_of_sample, l.sample_vectors, l.cones, l.reduction, executor);
        widen(l.cones);
        stages.push_back({"bounds", watch.lap_ms()});
    }
    l.dense_cells.resize(grid->clusters());
    auto const report = lights::count_lists(cull::make_row_grid(grid->view()), l.prepared.culled, {}, l.assignment, l.dense_cells);
    l.list_indices.resize(report.written);
    lights::fill_lists(l.assignment, std::span<std::uint32_t>(l.list_indices));
    cull_tiles(grid->view(), normals, l);
    stages.push_back({"assign", watch.lap_ms()});
    return report;
}

Result<LightingOutput> run_tiled(LightingRun const& on, bool normals) {
    Verbs verbs(on.device);
    (void)begin_lighting(on, verbs);
    std::vector<StageTime> stages;
    auto report = find_lists(on, normals, stages);
    if (!report) return std::move(report).failure();
    auto output = shade_lists(on, verbs, std::move(stages));
    if (output) output->counts.push_back({"lights_left_out", report->lights.bad + std::uint64_t{report->left_out}});
    return output;
}

}  // namespace

Result<cluster::Grid> make_tile_grid(LightingRun const& on) {
    auto const tile = static_cast<std::int32_t>(on.params.integer("tile"));
    std::array<float, 2> const planes{static_cast<float>(on.frame.view.near_m), std::numeric_limits<float>::infinity()};
    auto slices = cluster::make_slices(std::span<float const>(planes));
    if (!slices) return core::Failure{Error::bad_value, slices.failure().message};
    auto grid = cluster::make_grid(on.frame.view, math::ivec2(tile, tile), std::move(slices).value());
    if (!grid) return core::Failure{Error::bad_value, grid.failure().message};
    return std::move(grid).value();
}

Result<lights::ListsReport> find_tiled_lists(LightingRun const& on, std::vector<StageTime>& stages) { return find_lists(on, false, stages); }

LightingTechnique tiled_deferred_technique() noexcept {
    return {"tiled-deferred", "lights assigned to tiles of pixels, culled by each tile's nearest and farthest sample",
            tiled_params(), [](LightingRun const& on) { return run_tiled(on, false); }};
}

LightingTechnique tiled_deferred_en_technique() noexcept {
    return {"tiled-deferred-en", "and but for lights behind all surfaces of a tile, by a cone of normals", tiled_params(),
            [](LightingRun const& on) { return run_tiled(on, true); }};
}

}  // namespace gnomon::pipeline
