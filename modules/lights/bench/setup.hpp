#pragma once
// The grid and the lights of the yardsticks.

#include "../../cull/tests/light_scenes.hpp"

#include <gnomon/lights.hpp>

#include <cstdint>
#include <vector>

namespace gnomon::bench {

struct Setup {
    test::YardGrid yard;
    cull::RowGrid grid;
    std::vector<lights::Light> lights;

    Setup(std::int64_t scene, std::int64_t count, bool spots) : grid(cull::make_row_grid(yard.view())) {
        for (test::SceneLight const& l : test::make_lights(test::light_scenes[scene], static_cast<std::size_t>(count))) {
            if (spots) lights.push_back(lights::make_spot(l.center, l.range, l.axis, l.half_angle_rad));
            else lights.push_back(lights::make_point(l.center, l.range));
        }
    }
};

}  // namespace gnomon::bench
