// Lists by wide lanes against lists one by one, in grids and of lights of every size.

#include "any_light.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/lights/lists.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

using namespace gnomon;

namespace {

/// The lists' indices as numbers of another width, with room behind them that must stay as it is.
template <class Index>
std::vector<std::uint32_t> filled(lights::Workspace& work, std::size_t written) {
    auto const untouched = static_cast<Index>(~std::uint64_t{0});
    std::vector<Index> indices(written + 40, untouched);
    lights::fill_lists<Index>(work, indices);
    CHECK(std::all_of(indices.begin() + static_cast<std::ptrdiff_t>(written), indices.end(), [&](Index i) { return i == untouched; }));
    return {indices.begin(), indices.begin() + static_cast<std::ptrdiff_t>(written)};
}

/// returns: the pairs.
std::size_t compare_lists(cull::RowGrid const& grid, std::vector<lights::Light> const& list) {
    lights::Workspace wide, scalar;
    std::vector<lights::Cell> cells(grid.clusters()), expected(grid.clusters());
    auto const report = lights::count_lists(grid, list, {}, wide, cells);
    auto const one_by_one = lights::count_lists(grid, list, {.lanes = false}, scalar, expected);
    REQUIRE(report.written == one_by_one.written);
    CHECK(report.lights == one_by_one.lights);
    CHECK(cells == expected);
    std::vector<std::uint32_t> const indices = filled<std::uint16_t>(scalar, report.written);
    CHECK(filled<std::uint16_t>(wide, report.written) == indices);
    if (list.size() < 65'536 && wide.by_rows.used) CHECK(filled<std::uint32_t>(wide, report.written) == indices);
    return report.written;
}

std::vector<lights::Light> hard_points(test::Draw& draw, test::HardGrid const& hard, cull::RowGrid const& grid, unsigned count) {
    std::vector<lights::Light> list;
    for (unsigned i = 0; i < count; ++i) {
        lights::Light light = test::make_any_light(draw, hard, grid);
        if (light.kind == lights::Kind::spot) light.kind = lights::Kind::point;
        list.push_back(light);
    }
    return list;
}

/// A grid of any size, with lights from a cluster's size to the grid's.
std::size_t compare_in_grid(test::Draw& draw, math::ivec3 const& size, bool perspective, unsigned count) {
    test::HardGrid g;
    g.perspective = perspective;
    double const half = perspective ? 1.0 : 50.0;
    for (int i = 0; i <= size.x; ++i) g.x.push_back(static_cast<float>(half * (2.0 * i / size.x - 1)));
    for (int i = 0; i <= size.y; ++i) g.y.push_back(static_cast<float>(half * (2.0 * i / size.y - 1)));
    for (int i = 0; i <= size.z; ++i) g.depth_m.push_back(static_cast<float>(std::pow(500.0, static_cast<double>(i) / size.z)));
    std::vector<lights::Light> list;
    for (unsigned i = 0; i < count; ++i) {
        double const depth = draw.in(0, 120), x = draw.in(-1.2, 1.2), y = draw.in(-1.2, 1.2), range = std::pow(10.0, draw.in(-1, 2));
        double const scale = perspective ? depth : half;
        list.push_back(lights::make_point(math::to_float(math::dvec3(x * scale, y * scale, depth)), static_cast<float>(range)));
    }
    return compare_lists(cull::make_row_grid(g.view()), list);
}

}  // namespace

TEST_CASE("points in hard grids: lists by wide lanes are those one by one", "[lights][property]") {
    test::Draw draw{21};
    std::size_t pairs = 0;
    for (int i = 0; i < 60; ++i) {
        test::HardGrid const hard = test::make_hard_grid(draw);
        cull::RowGrid const grid = cull::make_row_grid(hard.view());
        unsigned const count = draw.below(80);
        pairs += compare_lists(grid, hard_points(draw, hard, grid, count));
    }
    CHECK(pairs > 50'000);
}

TEST_CASE("points in grids of every size: lists by wide lanes are those one by one", "[lights][property]") {
    test::Draw draw{22};
    // Tables in one register, in two, in none; 32 columns and one more; as many rows as a stream takes, and one more; long rows of
    // runs.
    math::ivec3 const sizes[] = {{1, 1, 1}, {15, 15, 15}, {16, 16, 16}, {31, 30, 30}, {32, 31, 31}, {33, 40, 17}, {70, 9, 40}, {3, 1022, 3}, {2, 1023, 3}, {130, 3, 3}, {300, 2, 2}};
    std::size_t pairs = 0;
    for (math::ivec3 const& size : sizes)
        for (bool const perspective : {true, false}) pairs += compare_in_grid(draw, size, perspective, 40);
    for (unsigned const count : {15U, 16U, 17U, 33U, 100U, 500U}) pairs += compare_in_grid(draw, {27, 15, 16}, true, count);
    CHECK(pairs > 100'000);
}

TEST_CASE("lists of no lights are empty, and so are those of lights beside the grid", "[lights]") {
    test::Draw draw{23};
    CHECK(compare_in_grid(draw, {27, 15, 16}, true, 0) == 0);
    test::HardGrid g;
    g.x = {-1.0F, 1.0F}, g.y = {-1.0F, 1.0F}, g.depth_m = {1.0F, 10.0F};
    std::vector<lights::Light> list;
    for (int i = 0; i < 40; ++i) list.push_back(lights::make_point({i % 2 != 0 ? -100.0F : 100.0F, 0.0F, 5.0F}, 1.0F));
    CHECK(compare_lists(cull::make_row_grid(g.view()), list) == 0);
}

TEST_CASE("points in hard grids, 3,000 of them", "[lights][.full]") {
    test::Draw draw{24};
    std::size_t pairs = 0;
    for (int i = 0; i < 3000; ++i) {
        test::HardGrid const hard = test::make_hard_grid(draw);
        cull::RowGrid const grid = cull::make_row_grid(hard.view());
        unsigned const count = draw.below(200);
        pairs += compare_lists(grid, hard_points(draw, hard, grid, count));
    }
    CHECK(pairs > 5'000'000);
}
