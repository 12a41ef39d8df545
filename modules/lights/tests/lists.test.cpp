#include "../../cull/tests/light_scenes.hpp"

#include <gnomon/check/allocations.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/lights/lists.hpp>
#include <gnomon/lights/planes.hpp>

#include <vector>

using namespace gnomon;

GNOMON_COUNT_ALLOCATIONS;

namespace {

struct MadeLists {
    std::vector<lights::Cell> cells;
    std::vector<std::uint16_t> indices;
    lights::ListsReport report;
};

MadeLists make_lists(cull::RowGrid const& grid, std::vector<lights::Light> const& list, lights::ListsConfig const& config) {
    MadeLists made;
    lights::Workspace work;
    made.cells.resize(grid.clusters());
    made.report = lights::count_lists(grid, list, config, work, made.cells);
    made.indices.resize(made.report.written);
    lights::fill_lists<std::uint16_t>(work, made.indices);
    return made;
}

std::vector<lights::Light> yard_lights(test::LightScene const& scene, std::size_t count, bool spots) {
    std::vector<lights::Light> list;
    for (auto const& l : test::make_lights(scene, count))
        list.push_back(spots ? lights::make_spot(l.center, l.range, l.axis, l.half_angle_rad) : lights::make_point(l.center, l.range));
    return list;
}

}  // namespace

TEST_CASE("lists and planes hold the same lights, in ascending order, by lanes and one by one", "[lights]") {
    test::YardGrid const yard;
    cull::RowGrid const grid = cull::make_row_grid(yard.view());
    for (auto const& scene : test::light_scenes)
        for (bool const spots : {false, true}) {
            auto const list = yard_lights(scene, 200, spots);
            MadeLists const fast = make_lists(grid, list, {}), slow = make_lists(grid, list, {.lanes = false});
            CHECK(fast.cells == slow.cells);
            CHECK(fast.indices == slow.indices);
            lights::Workspace work;
            lights::BitPlanes planes;
            lights::assign_planes(grid, list, {}, work, planes);
            bool same = true;
            for (std::size_t c = 0; c < grid.clusters(); ++c) {
                std::size_t at = fast.cells[c].offset;
                for (std::uint32_t i = 0; i < list.size(); ++i)
                    if (planes.has(c, i)) same = same && at < fast.indices.size() && fast.indices[at++] == i;
                same = same && at == std::size_t{fast.cells[c].offset} + fast.cells[c].count;
            }
            CHECK(same);
        }
}

TEST_CASE("a capacity that is too small leaves out the least important lights, whole, and names them", "[lights]") {
    test::YardGrid const yard;
    cull::RowGrid const grid = cull::make_row_grid(yard.view());
    auto list = yard_lights(test::light_scenes[3], 64, false);
    for (std::size_t i = 0; i < list.size(); ++i) list[i].importance = static_cast<float>(i % 7);
    MadeLists const whole = make_lists(grid, list, {});
    lights::Workspace work;
    std::vector<lights::Cell> cells(grid.clusters());
    std::uint64_t const capacity = whole.report.needed / 3;
    auto const report = lights::count_lists(grid, list, {.capacity = capacity}, work, cells);
    CHECK(report.needed == whole.report.needed);
    CHECK(report.written <= capacity);
    REQUIRE(report.left_out > 0);
    std::vector<lights::Light> rest = list;
    for (std::uint32_t i = 0; i < report.left_out; ++i) rest[work.pairs[i].light].layers = 0;
    for (std::uint32_t i = 1; i < report.left_out; ++i) CHECK(work.pairs[i - 1].importance <= work.pairs[i].importance);
    CHECK(report.written + work.pairs[report.left_out - 1].pairs > capacity);
    std::vector<std::uint16_t> indices(report.written);
    lights::fill_lists<std::uint16_t>(work, indices);
    MadeLists const without = make_lists(grid, rest, {});
    CHECK(without.cells == cells);
    CHECK(without.indices == indices);
}

TEST_CASE("bad lights are left out and counted, and change nothing for the others", "[lights]") {
    test::YardGrid const yard;
    cull::RowGrid const grid = cull::make_row_grid(yard.view());
    auto good = yard_lights(test::light_scenes[3], 16, false);
    auto const nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    auto list = good;
    list.push_back(lights::make_point({nan, 0, 5}, 1));
    list.push_back(lights::make_point({0, inf, 5}, 1));
    list.push_back(lights::make_point({0, 0, 1e30F}, 1));
    list.push_back(lights::make_point({0, 0, 5}, nan));
    list.push_back(lights::make_point({0, 0, 5}, inf));
    list.push_back(lights::make_point({0, 0, 5}, 0));
    list.push_back(lights::make_point({0, 0, 5}, -1));
    list.push_back(lights::make_spot({0, 0, 5}, 1, {0, 0, 0}, 1));
    list.push_back(lights::make_box({0, 0, 5}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}));
    MadeLists const a = make_lists(grid, good, {}), b = make_lists(grid, list, {});
    CHECK(b.report.lights == lights::Report{16, 9, 0});
    CHECK(a.cells == b.cells);
    CHECK(a.indices == b.indices);
}

TEST_CASE("assignment allocates nothing after the first frame", "[lights]") {
    test::YardGrid const yard;
    cull::RowGrid const grid = cull::make_row_grid(yard.view());
    auto list = yard_lights(test::light_scenes[2], 100, true);
    list.push_back(lights::make_directional());
    lights::Workspace work;
    lights::BitPlanes planes;
    std::vector<lights::Cell> cells(grid.clusters());
    std::vector<std::uint16_t> indices;
    auto const frame = [&] {
        lights::assign_planes(grid, list, {}, work, planes);
        auto const report = lights::count_lists(grid, list, {}, work, cells);
        if (indices.size() < report.written) indices.resize(report.written);
        lights::fill_lists<std::uint16_t>(work, indices);
    };
    frame();
    std::uint64_t const before = check::allocations_made();
    frame();
    CHECK(check::allocations_made() == before);
}
