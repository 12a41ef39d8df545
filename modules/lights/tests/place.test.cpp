#include <gnomon/check/check.hpp>
#include <gnomon/lights/place.hpp>

#include <cmath>

using namespace gnomon;

TEST_CASE("a scene 1e7 m from the origin is placed to the bit as one at it", "[lights]") {
    for (double const away : {0.0, 1e7, -1e7}) {
        math::dvec3 const origin(away, -away, 0.5 * away);
        math::PerspectiveConfig config;
        config.eye_m = origin + math::dvec3(1.0, 2.0, 3.0);
        config.target_m = config.eye_m + math::dvec3(0.0, 0.0, -1.0);
        math::View const view = math::make_perspective(config).value();
        lights::WorldLight light;
        light.position_m = origin + math::dvec3(1.5, 2.25, -1.0);
        light.light = lights::make_spot({}, 2.0F, {0.0F, 1.0F, 0.0F}, 0.5F);
        lights::Light const placed = lights::place(light, view);
        CHECK(placed.center == math::vec3(0.5F, -0.25F, 4.0F));  // up is negative, in front is positive
        CHECK(placed.axis == math::vec3(0.0F, -1.0F, 0.0F));
        CHECK(placed.range_m == 2.0F);
    }
}
