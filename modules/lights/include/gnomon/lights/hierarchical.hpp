#pragma once
// Lists by asking a light tree for every row of clusters: the same lists as by scattering lights, in the same order.
//
// The tree only finds candidates, by balls that are wider than the predicate's; the predicate of `cull` decides.
//
// source: [Olsson 2014, Paper II, 3.3-3.4], with rows of clusters in the place of single ones

#include <gnomon/bvh/build.hpp>
#include <gnomon/bvh/query.hpp>
#include <gnomon/core/contract.hpp>
#include <gnomon/lights/admit.hpp>
#include <gnomon/lights/detail/shapes.hpp>
#include <gnomon/lights/lists.hpp>
#include <gnomon/math/bounds.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::lights {

/// The lights of a frame in a tree. Directional lights are beside it: they are everywhere.
struct LightTree {
    bvh::Tree<bvh::Spheres, 32> tree;
    std::vector<std::uint32_t> light;        ///< of each of the tree's ids: ascending indices of the caller's list
    std::vector<std::uint32_t> directional;  ///< ascending
    Report report;
};

/// cost: O(n log n); allocates.
[[nodiscard]] inline LightTree build_light_tree(std::span<Light const> lights, std::uint32_t layers) {
    LightTree t;
    std::vector<float> x, y, depth, radius;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        Light const& l = lights[i];
        if ((l.layers & layers) == 0) {
            ++t.report.masked;
        } else if (!is_sound(l)) {
            ++t.report.bad;
        } else if (l.kind == Kind::directional) {
            t.directional.push_back(static_cast<std::uint32_t>(i));
        } else {
            float const r = bounding_radius_m(l);
            x.push_back(l.center.x);
            y.push_back(l.center.y);
            depth.push_back(l.center.z);
            // Twice the predicate's widening: its own rounding accepts nothing that this ball misses.
            radius.push_back(r + 3.814697265625e-6F * (std::abs(l.center.x) + std::abs(l.center.y) + std::abs(l.center.z) + r));
            t.light.push_back(static_cast<std::uint32_t>(i));
        }
    }
    t.report.taken = static_cast<std::uint32_t>(t.light.size() + t.directional.size());
    t.tree = bvh::build_tree(bvh::Spheres{x, y, depth, radius});
    return t;
}

namespace detail {

/// The box around a row of clusters of one slice.
[[nodiscard]] inline math::Aabb row_box(cull::RowGrid const& g, std::uint32_t row, std::uint32_t slice) noexcept {
    float const most = 4.0F * max_size_m;
    float const near = g.depth_m[slice], far = std::min(g.depth_m[slice + 1], most);
    auto const low = [&](float t) { return std::max(t * (g.perspective ? t < 0.0F ? far : near : 1.0F), -most); };
    auto const high = [&](float t) { return std::min(t * (g.perspective ? t < 0.0F ? near : far : 1.0F), most); };
    math::Aabb box;
    box.lo = math::vec3(low(g.left[0]), low(g.y[row]), near);
    box.hi = math::vec3(high(g.right[g.columns - 1]), high(g.y[row + 1]), far);
    return box;
}

}  // namespace detail

/// `count_lists` by the tree of the same lights; then `fill_lists`. Ignores `config.capacity` and `config.layers`.
///
/// cost: O(rows (nodes + candidates)); allocates when `work` grows.
[[nodiscard]] inline ListsReport count_lists_by_tree(cull::RowGrid const& grid, std::span<Light const> lights, LightTree const& tree,
                                             Workspace& work, std::span<Cell> cells) {
    GNOMON_EXPECT(cells.size() == grid.clusters());
    ListsReport report;
    report.lights = tree.report;
    work.run_count = 0;
    detail::RunSink sink{work, grid.columns};
    std::vector<std::uint32_t> found(tree.light.size());
    for (std::uint32_t k = 0; k < grid.slices; ++k)
        for (std::uint32_t j = 0; j < grid.rows; ++j) {
            bvh::BoxRegion const region{detail::row_box(grid, j, k)};
            std::size_t const hits = bvh::query(tree.tree.view(), region, found);
            auto const add = [&](std::uint32_t light) {
                cull::Columns const columns = cull::columns_of(grid, detail::span_of(grid, lights[light], j, k));
                sink.light(light);
                if (!columns.empty()) sink.row(k * grid.rows + j, columns);
            };
            for (std::size_t i = 0; i < hits; ++i) add(tree.light[found[i]]);
            for (std::uint32_t const light : tree.directional) add(light);
        }
    std::sort(work.runs.begin(), work.runs.begin() + static_cast<std::ptrdiff_t>(work.run_count),
              [](Run const& a, Run const& b) { return a.light != b.light ? a.light < b.light : a.cluster < b.cluster; });
    report.needed = report.written = detail::lay_out(work, cells);
    GNOMON_EXPECT(report.needed <= 0xFFFFFFFFU);
    return report;
}

}  // namespace gnomon::lights
