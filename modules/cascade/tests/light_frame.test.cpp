#include <gnomon/cascade/light_frame.hpp>
#include <gnomon/cascade/sub_frustum.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/math/generators.hpp>

#include <cmath>
#include <limits>

namespace {

namespace frames {

using namespace gnomon;
using namespace gnomon::check;
using cascade::LightFrame;

TEST_CASE("a light's frame is right-handed and of unit length for any direction and up, and always the same",
          "[light_frame]") {
    for_all(math::directions(), math::directions(), floats(1e-30, 1e30),
            [](math::dvec3 const& way, math::dvec3 const& up, double length) {
                LightFrame const light = cascade::make_light_frame(way * length, up).value();
                CHECK(light == cascade::make_light_frame(way * length, up).value());
                CHECK(std::abs(cascade::along(light.right, light.down)) < 1e-15);
                CHECK(std::abs(cascade::along(light.right, light.away)) < 1e-15);
                CHECK(std::abs(cascade::along(light.down, light.away)) < 1e-15);
                math::dvec3 const cross = glm::cross(light.right, light.down) - light.away;
                CHECK(cascade::along(cross, cross) < 1e-30);
                CHECK(cascade::along(light.away, way) > 0.999999);
            });
}

TEST_CASE("a sun overhead has a frame, and an upright one keeps the world's up upward", "[light_frame]") {
    LightFrame const noon = cascade::make_light_frame({0.0, -1.0, 0.0}).value();
    CHECK(noon.away == math::dvec3(0.0, -1.0, 0.0));
    CHECK(std::abs(cascade::along(noon.right, noon.right) - 1.0) < 1e-15);
    LightFrame const low = cascade::make_light_frame({1.0, -0.2, 0.0}).value();
    CHECK(low.down.y < -0.9);
    double const nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(cascade::make_light_frame({0.0, -1.0, 0.0}, {nan, 0.0, 0.0}).value() == noon);
}

TEST_CASE(
    "the diameter is the farthest pair's, and the sphere holds the corners and is not larger than the diameter allows",
    "[sub_frustum]") {
    for_all(math::views(), floats(0.1, 50.0), floats(0.01, 100.0),
            [](math::View const& view, double begin, double length) {
                auto const corners = cascade::corners_in_view(view, {begin, begin + length, begin + length});
                double const diameter = cascade::diameter_m(corners);
                cascade::BoundingSphere const sphere = cascade::bounding_sphere(corners);
                double farthest = 0.0;
                for (unsigned i = 0; i < 8; ++i) {
                    CHECK(glm::distance(corners[i], sphere.center_in_view) <= sphere.radius_m * (1.0 + 1e-14));
                    for (unsigned j = 0; j < 8; ++j)
                        farthest = std::fmax(farthest, glm::distance(corners[i], corners[j]));
                }
                CHECK(std::abs(farthest - diameter) <= 1e-14 * diameter);
                CHECK(2.0 * sphere.radius_m >= diameter * (1.0 - 1e-14));
                bool const centred = view.window.left == -view.window.right && view.window.bottom == -view.window.top;
                if (!centred || view.lens != math::Lens::perspective) return;
                // The closed form: the middle at depth (n + f) / 2 (1 + tan^2 of the corner), or on the far window.
                double const tan_sq = view.window.right * view.window.right + view.window.top * view.window.top;
                double const end = begin + length;
                double const at = std::fmin(end, 0.5 * (begin + end) * (1.0 + tan_sq));
                double const radius = std::sqrt((end - at) * (end - at) + tan_sq * end * end);
                CHECK(std::abs(sphere.radius_m - radius) <= 1e-9 * radius);
            });
}

}  // namespace frames

}  // namespace
