#pragma once
// Lists of every cluster of a grid by asking a light tree for each row: the same lists as by scattering lights, in the same
// order. Where few of the clusters matter, ask for those alone: sparse.hpp.
//
// The tree only finds candidates, by balls that are wider than the predicate's; the predicate of `cull` decides.
//
// source: [Olsson 2014, Paper II, 3.3-3.4], with rows of clusters in the place of single ones

#include <gnomon/bvh/query.hpp>
#include <gnomon/core/contract.hpp>
#include <gnomon/lights/admit.hpp>
#include <gnomon/lights/detail/shapes.hpp>
#include <gnomon/lights/detail/wide_box.hpp>
#include <gnomon/lights/light_tree.hpp>
#include <gnomon/lights/lists.hpp>
#include <gnomon/math/bounds.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::lights {

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
    detail::RunSink sink{work};
    std::vector<std::uint32_t> found(tree.tree.ids.size());
    for (std::uint32_t k = 0; k < grid.slices; ++k)
        for (std::uint32_t j = 0; j < grid.rows; ++j) {
            detail::WideBox const region{detail::row_box(grid, j, k)};
            std::size_t const hits = bvh::query(tree.tree.view(), region, found);
            auto const add = [&](std::uint32_t light) {
                cull::Columns const columns = cull::columns_of(grid, detail::span_of(grid, lights[light], j, k));
                sink.light(light);
                if (!columns.empty()) sink.row(k * grid.rows + j, columns);
            };
            for (std::size_t i = 0; i < hits; ++i) add(found[i]);
            for (std::uint32_t const light : tree.directional) add(light);
        }
    std::sort(work.runs.begin(), work.runs.begin() + static_cast<std::ptrdiff_t>(work.run_count),
              [](Run const& a, Run const& b) { return a.light != b.light ? a.light < b.light : a.row < b.row; });
    report.needed = report.written = detail::lay_out(grid, lights.size(), true, work, cells);
    GNOMON_EXPECT(report.needed <= 0xFFFFFFFFU);
    return report;
}

}  // namespace gnomon::lights
