#include "any_light.hpp"

#include <gnomon/check/allocations.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>
#include <gnomon/lights.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace gnomon;

namespace {

/// Clusters of a grid that have samples: some of them, in any order, some twice.
std::vector<cluster::ClusterCoordinates> draw_clusters(test::Draw& draw, cull::RowGrid const& grid) {
    std::vector<cluster::ClusterCoordinates> list;
    unsigned const share = 1 + draw.below(4);
    for (std::uint32_t k = 0; k < grid.slices; ++k)
        for (std::uint32_t j = 0; j < grid.rows; ++j)
            for (std::uint32_t i = 0; i < grid.columns; ++i)
                for (unsigned copy = 0; copy < 2; ++copy)
                    if (draw.below(copy == 0 ? share : 20) == 0) list.push_back({i, j, k});
    if (draw.below(2) == 0)
        for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[draw.below(static_cast<unsigned>(i))]);
    return list;
}

struct SparseLists {
    std::vector<lights::Cell> cells;
    std::vector<std::uint16_t> indices;
    lights::ListsReport report;
    std::vector<lights::LightPairs> pairs;

    SparseLists(lights::SparseInput const& in, lights::SparseConfig const& config, core::ExecutorRef executor) : cells(in.clusters.size()) {
        lights::SparseWorkspace work;
        report = lights::count_sparse_lists(in, config, work, cells, executor);
        indices.resize(report.written);
        lights::fill_sparse_lists<std::uint16_t>(work, cells, indices, executor);
        pairs = work.pairs;
    }
    [[nodiscard]] std::span<std::uint16_t const> of(std::size_t c) const {
        return std::span(indices).subspan(cells[c].offset, cells[c].count);
    }
};

/// returns: how many pairs there are.
std::size_t compare_sparse(test::Draw& draw) {
    test::HardGrid const hard = test::make_hard_grid(draw);
    cull::RowGrid const grid = cull::make_row_grid(hard.view());
    std::vector<lights::Light> list;
    unsigned const points_only = draw.below(3);
    for (unsigned n = draw.below(150); n > 0; --n) {
        list.push_back(test::make_any_light(draw, hard, grid));
        if (points_only == 0 && list.back().kind != lights::Kind::directional) list.back().kind = lights::Kind::point;
    }
    std::uint32_t const layers = draw.below(2) != 0 ? ~0U : 4U;
    std::vector<cluster::ClusterCoordinates> const clusters = draw_clusters(draw, grid);
    core::ThreadExecutor const threads(3);
    core::SerialExecutor const serial;
    lights::LightTreeWorkspace tree_work;
    lights::LightTree tree;
    lights::build_light_tree(list, layers, tree_work, tree, threads);
    SparseLists const made({grid, list, tree, clusters}, {}, serial);
    SparseLists const parallel({grid, list, tree, clusters}, {}, threads);
    SparseLists const one_by_one({grid, list, tree, clusters}, {.lanes = false}, serial);
    CHECK(made.cells == parallel.cells);
    CHECK(made.indices == parallel.indices);
    CHECK(made.cells == one_by_one.cells);
    CHECK(made.indices == one_by_one.indices);
    std::vector<lights::Cell> cells(grid.clusters());
    lights::Workspace work;
    auto const report = lights::count_lists(grid, list, {.layers = layers}, work, cells);
    std::vector<std::uint16_t> indices(report.written);
    lights::fill_lists<std::uint16_t>(work, indices);
    CHECK(made.report.lights == report.lights);
    bool same = true;
    std::size_t offset = 0;
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        lights::Cell const cell = cells[(std::size_t{clusters[c].slice} * grid.rows + clusters[c].row) * grid.columns + clusters[c].column];
        same = same && std::ranges::equal(made.of(c), std::span(indices).subspan(cell.offset, cell.count)) && made.cells[c].offset == offset;
        offset += cell.count;
    }
    CHECK(same);
    CHECK(made.report.needed == offset);
    CHECK(made.report.written == offset);
    return offset;
}

}  // namespace

TEST_CASE("the lists of any clusters of a grid are those of the whole grid's assignment, for any number of threads and lanes",
          "[lights][sparse][property]") {
    test::Draw draw{21};
    std::size_t pairs = 0;
    for (int i = 0; i < 16; ++i) pairs += compare_sparse(draw);
    CHECK(pairs > 2000);
}

TEST_CASE("the lists of any clusters of a grid, 4,000 scenes", "[lights][sparse][.full]") {
    test::Draw draw{22};
    std::size_t pairs = 0;
    for (int i = 0; i < 4000; ++i) pairs += compare_sparse(draw);
    CHECK(pairs > 1000000);
}
