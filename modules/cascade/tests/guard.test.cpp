// Guard bands: maps that stand while the camera moves.

#include "placing.hpp"

#include <gnomon/cascade/guard.hpp>

#include <cmath>
#include <cstdint>

namespace {

namespace placing_guard {

using namespace placing;
using cascade::Action;
using cascade::Place;

TEST_CASE("a map that stays while the camera moves within its guard band still holds the sub-frustum",
          "[cascades][guard]") {
    for_all(cases(200), scenarios(), integers(0, 1000), [&](Scenario const& s, int seed) {
        Cascades state;
        Scenario moving = s;
        for (int i = 0; i < 12; ++i) {
            auto const frame = cascade::plan(state, moving.config, moving.camera);
            if (!frame) return;
            CHECK(corners_outside(moving, *frame) == 0);
            cascade::commit(state, *frame);
            double const texel = frame->cascades[0].volume.texel_m;
            double const angle = static_cast<double>((seed * 31 + i * 17) % 64) / 10.0;
            moving.camera.eye_m +=
                math::dvec3(std::cos(angle), 0.3, std::sin(angle)) * (texel * static_cast<double>((seed + i) % 23));
        }
    });
}

TEST_CASE("a guard band holds the map still until the map proper leaves it", "[cascades][guard]") {
    CascadeConfig config = ordinary();
    config.fit.guard_px = 16;
    config.direction = {0.0, -1.0, 0.0};
    Cascades state;
    int scrolls = 0;
    std::int64_t proper = 0;
    double const step_m = 0.05;
    for (int i = 0; i < 500; ++i) {
        CascadeFrame const frame =
            cascade::plan(state, config, camera_at({i * step_m, 2.0, 0.0}, {0.0, 0.0, -1.0})).value();
        Place const& d = frame.cascades[1].update.shift;
        if (i != 0 && frame.cascades[1].update.action == Action::scroll) {
            ++scrolls;
            CHECK((std::abs(d.x) == 17 || std::abs(d.y) == 17 || std::abs(d.x) == 18 || std::abs(d.y) == 18));
        }
        proper += std::abs(d.x) + std::abs(d.y);
        cascade::commit(state, frame);
    }
    double const texels = 500 * step_m / state.held[1].volume.texel_m;
    CHECK(scrolls > 0);
    CHECK(scrolls <= static_cast<int>(texels / 17.0) + 1);
    CHECK(static_cast<double>(proper) >= texels - 18.0);
}

}  // namespace placing_guard

}  // namespace
