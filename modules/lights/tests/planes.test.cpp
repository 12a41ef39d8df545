#include "../../cull/tests/light_scenes.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/lights/planes.hpp>

#include <bit>

using namespace gnomon;

TEST_CASE("bit planes of the yardsticks' scenes are the same by lanes and one by one", "[lights]") {
    test::YardGrid const yard;
    cull::RowGrid const grid = cull::make_row_grid(yard.view());
    for (auto const& scene : test::light_scenes)
        for (bool const spots : {false, true}) {
            std::vector<lights::Light> list;
            for (auto const& l : test::make_lights(scene, 256))
                list.push_back(spots ? lights::make_spot(l.center, l.range, l.axis, l.half_angle_rad) : lights::make_point(l.center, l.range));
            lights::Workspace work;
            lights::BitPlanes fast, slow;
            lights::assign_planes(grid, list, {}, work, fast);
            lights::assign_planes(grid, list, {.lanes = false}, work, slow);
            std::size_t pairs = 0;
            for (auto const word : fast.words) pairs += static_cast<std::size_t>(std::popcount(word));
            CAPTURE(scene.name, spots, pairs);
            CHECK(fast.words == slow.words);
        }
}
