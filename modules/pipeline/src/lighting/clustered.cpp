// The techniques `clustered-deferred...`: keys, unique clusters, lights of each, shading. [Olsson 2014, Paper II, 3 and 4]

#include "../detail.hpp"
#include "lighting.hpp"
#include "../workspace.hpp"

#include <gnomon/cull/rows.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace gnomon::pipeline {

namespace {

/// The suffixes of [Olsson 2014, Paper II, table 1].
struct Variant {
    std::uint32_t normal_n = 0;     ///< nk: parts of a side of a cube face; 0: no normals in keys.
    bool explicit_bounds = false;   ///< eb: boxes of samples.
    bool explicit_normals = false;  ///< en: cones of normals.
    bool page_table = false;        ///< pt: unique clusters by one.

    [[nodiscard]] bool cones() const noexcept { return normal_n != 0 || explicit_normals; }
};

constexpr std::array<std::string_view, 3> methods{"bitmap", "page-table", "sort"};

std::span<ParamInfo const> clustered_params(bool page_table) noexcept {
    static std::array<ParamInfo, 3> const all{
        {gbuffer_param, tile_param,
         {"unique", ParamKind::choice, "bitmap", 0, 0, "", methods, "how the unique clusters are found, where a table of the keys fits; all find the same"}}};
    return std::span(all).first(page_table ? 2 : 3);
}

template <cluster::Key K>
void find_keys(LightingRun const& on, cluster::Grid const& grid, cluster::KeyLayout<K> const& layout, Lighting const& l,
               std::vector<K>& keys) {
    keys.resize(on.frame.samples.size());
    SampleDepth const depth_of(on.frame);
    auto const width = static_cast<std::uint32_t>(on.frame.view.size_px.x);
    on.executor.parallel_for(keys.size(), sample_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            std::uint32_t const pixel = on.frame.samples.pixel[i];
            math::vec3 const normal = layout.normal_n != 0 ? l.sample_vectors[i] : math::vec3(0.0F);
            keys[i] = cluster::key_at(grid, layout, math::uvec2(pixel % width, pixel / width), depth_of(on.frame.samples.position[i]), normal);
        }
    });
}

/// A table of more than 64 MiB is none.
constexpr std::uint64_t most_bits = std::uint64_t{1} << 28U;

template <cluster::Key K>
std::size_t find_unique(LightingRun const& on, Variant const& variant, cluster::KeyLayout<K> const& layout, KeySet<K>& set,
                        std::span<std::uint32_t> list_of_sample) {
    set.unique.resize(set.keys.size());
    cluster::UniqueOut<K> const out{set.unique, list_of_sample};
    std::span<K const> const keys(set.keys);
    auto executor = on.executor;
    std::string_view const method = variant.page_table ? "page-table" : on.params.word("unique");
    if (method == "page-table" && layout.domain() <= 4 * most_bits && cluster::fits_table(layout))
        return cluster::unique_by_page_table(layout, keys, out, set.work, executor).clusters;
    if (method == "bitmap" && layout.domain() <= most_bits) return cluster::unique_by_bitmap(layout, keys, out, set.work, executor).clusters;
    return cluster::unique_by_local_sort(layout, keys, out, set.work, executor).clusters;
}

struct ClusteredRun {
    LightingRun const& on;
    Variant const& variant;
    cluster::Grid const& grid;
};

/// The unique clusters of the samples, to `l.clusters` and `l.normal_cells`; `l.list_of_sample` says which is whose.
template <cluster::Key K>
void find_clusters(ClusteredRun const& run, cluster::KeyLayout<K> const& layout, KeySet<K>& set, std::vector<StageTime>& stages) {
    auto const& [on, variant, grid] = run;
    Lighting& l = on.workspace.state().lighting;
    Stopwatch watch;
    if (layout.normal_n != 0) turn_normals(on, l.format, l.sample_vectors);
    find_keys(on, grid, layout, l, set.keys);
    stages.push_back({"keys", watch.lap_ms()});
    l.list_of_sample.resize(set.keys.size());
    std::size_t const count = find_unique(on, variant, layout, set, l.list_of_sample);
    l.clusters.resize(count);
    l.normal_cells.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        cluster::KeyParts const p = cluster::unpack_key(set.unique[i]);
        l.clusters[i] = {p.column, p.row, p.slice};
        l.normal_cells[i] = p.cell;
    }
    stages.push_back({"unique", watch.lap_ms()});
}

/// By keys of 32 bits, or of 64 where those do not hold the grid.
Result<core::Done> find_clusters(ClusteredRun const& run, std::vector<StageTime>& stages) {
    Lighting& l = run.on.workspace.state().lighting;
    auto const narrow = cluster::make_key_layout<std::uint32_t>(run.grid.view(), run.variant.normal_n);
    if (narrow) {
        find_clusters(run, *narrow, l.keys, stages);
        return core::Done{};
    }
    auto const wide = cluster::make_key_layout<std::uint64_t>(run.grid.view(), run.variant.normal_n);
    if (!wide) return core::Failure{Error::bad_value, wide.failure().message};
    find_clusters(run, *wide, l.wide_keys, stages);
    return core::Done{};
}

void find_boxes(LightingRun const& on, Lighting& l) {
    l.sample_vectors.resize(on.frame.samples.size());
    on.executor.parallel_for(l.sample_vectors.size(), sample_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            math::dvec3 const world = on.frame.geometry->origin_m + math::to_double(on.frame.samples.position[i]);
            l.sample_vectors[i] = cluster::culling_position(on.frame.view, world);
        }
    });
    l.boxes.resize(l.clusters.size());
    auto executor = on.executor;
    (void)cluster::explicit_bounds(l.list_of_sample, l.sample_vectors, l.boxes, l.reduction, executor);
}

/// Explicit cones, those of the keys' cells, or of both the narrower.
void find_cones(LightingRun const& on, Variant const& variant, Lighting& l) {
    l.cones.resize(l.clusters.size());
    auto executor = on.executor;
    if (variant.explicit_normals) {
        turn_normals(on, l.format, l.sample_vectors);
        (void)cluster::explicit_cones(l.list_of_sample, l.sample_vectors, l.cones, l.reduction, executor);
    }
    if (variant.normal_n != 0) {
        std::vector<cluster::NormalCone> const cells = cluster::make_cell_cones(variant.normal_n);
        for (std::size_t i = 0; i < l.cones.size(); ++i) {
            cluster::NormalCone const& cell = cells[l.normal_cells[i]];
            if (!variant.explicit_normals || cell.cos_half > l.cones[i].cos_half) l.cones[i] = cell;
        }
    }
    widen(l.cones);
}

/// The lists of `l.clusters`.
lights::ListsReport assign(LightingRun const& on, cluster::Grid const& grid, Variant const& variant, Lighting& l) {
    cull::RowGrid const rows = cull::make_row_grid(grid.view());
    lights::SparseInput in{rows, l.prepared.culled, l.tree, l.clusters};
    if (variant.explicit_bounds) in.boxes = l.boxes;
    if (variant.cones()) in.cones = l.cones;
    l.list_cells.resize(l.clusters.size());
    lights::SparseConfig const config{.facing_slack_m = l.prepared.facing_slack_m};
    lights::ListsReport const report = lights::count_sparse_lists(in, config, l.sparse, l.list_cells, on.executor);
    l.list_indices.resize(report.written);
    lights::fill_sparse_lists(l.sparse, l.list_cells, std::span<std::uint32_t>(l.list_indices), on.executor);
    return report;
}

/// `list_of_sample`, `list_cells` and `list_indices` of a lighting whose lights are prepared.
Result<lights::ListsReport> find_lists(LightingRun const& on, Variant const& variant, std::vector<StageTime>& stages) {
    Lighting& l = on.workspace.state().lighting;
    Stopwatch watch;
    auto grid = make_cluster_grid(on);
    if (!grid) return std::move(grid).failure();
    stages.push_back({"grid", watch.lap_ms()});
    auto found = find_clusters({on, variant, *grid}, stages);
    if (!found) return std::move(found).failure();
    (void)watch.lap_ms();
    if (variant.explicit_bounds) find_boxes(on, l);
    if (variant.cones()) find_cones(on, variant, l);
    if (variant.explicit_bounds || variant.cones()) stages.push_back({"bounds", watch.lap_ms()});
    lights::build_light_tree(l.prepared.culled, ~0U, l.tree_work, l.tree, on.executor);
    stages.push_back({"tree", watch.lap_ms()});
    lights::ListsReport const report = assign(on, *grid, variant, l);
    stages.push_back({"assign", watch.lap_ms()});
    return report;
}

Result<LightingOutput> run_clustered(LightingRun const& on, Variant const& variant) {
    Verbs verbs(on.device);
    (void)begin_lighting(on, verbs);
    std::vector<StageTime> stages;
    auto report = find_lists(on, variant, stages);
    if (!report) return std::move(report).failure();
    auto output = shade_lists(on, verbs, std::move(stages));
    if (output) output->counts.push_back({"lights_left_out", report->lights.bad + std::uint64_t{report->left_out}});
    return output;
}

template <Variant variant>
LightingTechnique technique(std::string_view name, std::string_view summary) noexcept {
    return {name, summary, clustered_params(variant.page_table), [](LightingRun const& on) { return run_clustered(on, variant); }};
}

}  // namespace

double deepest_sample(Frame const& frame, core::ExecutorRef executor) {
    SampleDepth const depth_of(frame);
    std::span<math::vec3 const> const positions(frame.samples.position);
    std::vector<float> deepest_of((positions.size() + sample_grain - 1) / sample_grain, -std::numeric_limits<float>::infinity());
    executor.parallel_for(deepest_of.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t part = begin; part < end; ++part) {
            std::size_t const first = part * sample_grain;
            float deepest = deepest_of[part];
            for (math::vec3 const& p : positions.subspan(first, std::min(sample_grain, positions.size() - first)))
                deepest = std::max(deepest, depth_of(p));
            deepest_of[part] = deepest;
        }
    });
    double deepest = frame.view.near_m;
    for (float const d : deepest_of) deepest = std::max(deepest, static_cast<double>(d));
    return deepest;
}

Result<cluster::Grid> make_cluster_grid(math::View const& view, std::int32_t tile_px, double deepest_m) {
    double const end = std::max(deepest_m, view.near_m + 1e-3 * (1.0 + std::abs(view.near_m)));
    auto slices = cluster::make_cubical_slices(view, tile_px, end);
    if (!slices) return core::Failure{Error::bad_value, slices.failure().message};
    auto grid = cluster::make_grid(view, math::ivec2(tile_px, tile_px), std::move(slices).value());
    if (!grid) return core::Failure{Error::bad_value, grid.failure().message};
    return std::move(grid).value();
}

Result<cluster::Grid> make_cluster_grid(LightingRun const& on) {
    return make_cluster_grid(on.frame.view, static_cast<std::int32_t>(on.params.integer("tile")), deepest_sample(on.frame, on.executor));
}

Result<lights::ListsReport> find_clustered_lists(LightingRun const& on, std::vector<StageTime>& stages) {
    return find_lists(on, {}, stages);
}

std::span<LightingTechnique const> clustered_deferred_techniques() noexcept {
    static std::array const all{
        technique<Variant{}>("clustered-deferred", "lights assigned to clusters of tiles and exponential depth slices"),
        technique<Variant{.page_table = true}>("clustered-deferred-pt", "clusters found by a page table"),
        technique<Variant{.explicit_bounds = true}>("clustered-deferred-eb", "and to the box of a cluster's samples"),
        technique<Variant{.explicit_normals = true}>("clustered-deferred-en", "but for lights behind all surfaces, by a cone of normals"),
        technique<Variant{.explicit_bounds = true, .explicit_normals = true}>("clustered-deferred-eb-en", "boxes of samples and cones of normals"),
        technique<Variant{.normal_n = 3}>("clustered-deferred-nk3", "clusters by normal too, of 3x3 to a face of a cube"),
        technique<Variant{.normal_n = 3, .page_table = true}>("clustered-deferred-nk3-pt", "clusters by normal too, found by a page table"),
        technique<Variant{.normal_n = 3, .explicit_bounds = true, .explicit_normals = true}>(
            "clustered-deferred-nk3-eb-en", "clusters by normal too, boxes of samples and cones of normals"),
    };
    return all;
}

}  // namespace gnomon::pipeline
