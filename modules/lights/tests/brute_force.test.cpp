#include "any_light.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/lights.hpp>

#include <vector>

using namespace gnomon;

namespace {

/// returns: how many pairs there are.
std::size_t compare_ways(test::Draw& draw) {
    test::HardGrid const hard = test::make_hard_grid(draw);
    cull::RowGrid const grid = cull::make_row_grid(hard.view());
    std::vector<lights::Light> list;
    for (unsigned n = draw.below(70); n > 0; --n) list.push_back(test::make_any_light(draw, hard, grid));
    std::uint32_t const layers = draw.below(2) != 0 ? ~0U : 4U;
    lights::Workspace work;
    lights::BitPlanes fast, slow;
    auto const by_lanes = lights::assign_planes(grid, list, {.layers = layers}, work, fast);
    auto const one_by_one = lights::assign_planes(grid, list, {.layers = layers, .lanes = false}, work, slow);
    CHECK(by_lanes == one_by_one);
    CHECK(fast.words == slow.words);
    std::vector<lights::Cell> cells(grid.clusters());
    auto const report = lights::count_lists(grid, list, {.layers = layers}, work, cells);
    std::vector<std::uint32_t> indices(report.written), brute;
    lights::fill_lists<std::uint32_t>(work, indices);
    bool same = true;
    for (std::uint32_t k = 0; k < grid.slices; ++k)
        for (std::uint32_t j = 0; j < grid.rows; ++j)
            for (std::uint32_t i = 0; i < grid.columns; ++i) {
                std::size_t const c = (std::size_t{k} * grid.rows + j) * grid.columns + i;
                same = same && cells[c].offset == brute.size();
                for (std::uint32_t n = 0; n < list.size(); ++n) {
                    bool const touches = (list[n].layers & layers) != 0 && lights::may_touch(grid, list[n], i, j, k);
                    if (touches) brute.push_back(n);
                    same = same && touches == fast.has(c, n);
                }
                same = same && cells[c].offset + cells[c].count == brute.size();
            }
    CHECK(same);
    CHECK(brute == indices);
    std::vector<lights::Cell> tree_cells(grid.clusters());
    lights::LightTree const tree = lights::build_light_tree(list, layers);
    auto const by_tree = lights::count_lists_by_tree(grid, list, tree, work, tree_cells);
    CHECK(by_tree.lights == report.lights);
    std::vector<std::uint32_t> tree_indices(by_tree.written);
    lights::fill_lists<std::uint32_t>(work, tree_indices);
    CHECK(tree_cells == cells);
    CHECK(tree_indices == indices);
    return brute.size();
}

}  // namespace

TEST_CASE("brute force, scatter by lanes and one by one, tree, planes and lists: all the same lights in the same order", "[lights][property]") {
    test::Draw draw{11};
    std::size_t pairs = 0;
    for (int i = 0; i < 12; ++i) pairs += compare_ways(draw);
    CHECK(pairs > 1000);
}

TEST_CASE("brute force, scatter, planes and lists, 400 scenes", "[lights][.full]") {
    test::Draw draw{12};
    std::size_t pairs = 0;
    for (int i = 0; i < 400; ++i) pairs += compare_ways(draw);
    CHECK(pairs > 100000);
}
