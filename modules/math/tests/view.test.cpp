#include <gnomon/check/check.hpp>
#include <gnomon/math/generators.hpp>
#include <gnomon/math/view.hpp>

#include <array>
#include <cmath>
#include <limits>

namespace {

using namespace gnomon;
using math::dvec2;
using math::dvec3;
using math::View;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

bool close(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance; }

math::PerspectiveConfig camera() {
    math::PerspectiveConfig config;
    config.eye_m = dvec3(1.0, 2.0, 3.0);
    config.target_m = dvec3(0.0, 0.0, 0.0);
    config.size_px = math::ivec2(640, 480);
    return config;
}

}  // namespace

TEST_CASE("depth is 0 and 1 at the ends of the range, the other way round when reversed", "[math][view][property]") {
    check::for_all(math::views(), [](View const& view) {
        double const near_depth = math::depth_from_distance(view, view.near_m);
        double const far_depth = math::is_finite(view.far_m) ? math::depth_from_distance(view, view.far_m)
                                                             : math::depth_line(view).scale;
        bool const reversed = view.depth == math::Depth::reversed;
        CHECK(close(near_depth, reversed ? 1.0 : 0.0, 1e-12));
        CHECK(close(far_depth, reversed ? 0.0 : 1.0, 1e-12));
    });
}

TEST_CASE("distance_from_depth undoes depth_from_distance", "[math][view][property]") {
    check::for_all(math::views(), check::floats(0.0, 1.0), [](View const& view, double along) {
        double const far_m = math::is_finite(view.far_m) ? view.far_m : view.near_m * 1000.0;
        double const distance = view.near_m + (far_m - view.near_m) * along;
        double const depth = math::depth_from_distance(view, distance);
        // Reversed-order error of depth = scale + offset/d: the step of a depth of one, in metres, at this distance.
        double const step = view.lens == math::Lens::orthographic ? (far_m - view.near_m)
                                                                  : distance * distance / view.near_m;
        CHECK(close(math::distance_from_depth(view, depth), distance, 16.0 * 2.3e-16 * (step + distance)));
    });
}

TEST_CASE("a pixel's ray projects back onto the pixel at every distance", "[math][view][property]") {
    check::for_all(math::views(), check::floats(0.0, 1.0), check::floats(0.0, 1.0), check::floats(1.0, 1000.0),
                   [](View const& view, double x, double y, double distance) {
                       dvec2 const px(x * view.size_px.x, y * view.size_px.y);
                       math::PixelRay const ray = math::pixel_ray(view, px);
                       dvec3 const seen = math::project(view, ray.start_m + ray.step * distance);
                       double const tolerance = 1e-9 * (view.size_px.x + view.size_px.y);
                       CHECK(close(seen.x, px.x, tolerance));
                       CHECK(close(seen.y, px.y, tolerance));
                   });
}

TEST_CASE("the clip matrix agrees with project", "[math][view][property]") {
    check::for_all(math::views(), check::floats(0.05, 0.95), check::floats(0.05, 0.95), check::floats(0.1, 0.9),
                   [](View const& view, double x, double y, double along) {
                       double const far_m = math::is_finite(view.far_m) ? view.far_m : view.near_m * 100.0;
                       double const distance = view.near_m + (far_m - view.near_m) * along;
                       math::PixelRay const ray = math::pixel_ray(view, dvec2(x * view.size_px.x, y * view.size_px.y));
                       dvec3 const point = ray.start_m + ray.step * distance;
                       math::dvec4 const clip = math::clip_from_relative_exact(view) * math::dvec4(point, 1.0);
                       dvec3 const seen = math::project(view, point);
                       double const size = view.size_px.x + view.size_px.y;
                       CHECK(close((clip.x / clip.w * 0.5 + 0.5) * view.size_px.x, seen.x, 1e-9 * size));
                       CHECK(close((clip.y / clip.w * 0.5 + 0.5) * view.size_px.y, seen.y, 1e-9 * size));
                       CHECK(close(clip.z / clip.w, seen.z, 1e-9));
                   });
}

TEST_CASE("the image's top left is left, up and in front", "[math][view]") {
    auto const view = math::make_perspective(camera()).value();
    math::PixelRay const ray = math::pixel_ray(view, dvec2(0.5, 0.5));
    CHECK(glm::dot(ray.step, view.right) < 0.0);
    CHECK(glm::dot(ray.step, view.up) > 0.0);
    CHECK(glm::dot(ray.step, view.back) == Approx(-1.0));
}

TEST_CASE("a frame is orthonormal and right-handed for any direction and up", "[math][view][property]") {
    check::for_all(math::directions(), math::directions(), [](dvec3 const& direction, dvec3 const& up) {
        for (double const scale : {1e-150, 1.0, 1e150})
            for (dvec3 const& some_up : {up, direction, -direction, dvec3(0.0), dvec3(not_a_number), dvec3(0.0, 1.0, 0.0)}) {
                View const view = math::looking_along(View{}, direction * scale, some_up);
                CHECK(close(glm::dot(view.right, view.right), 1.0, 1e-12));
                CHECK(close(glm::dot(view.up, view.up), 1.0, 1e-12));
                CHECK(close(glm::dot(view.right, view.back), 0.0, 1e-12));
                CHECK(close(glm::dot(glm::cross(view.right, view.up), view.back), 1.0, 1e-12));
            }
    });
}

TEST_CASE("a light straight overhead has a frame", "[math][view]") {
    View const view = math::looking_along(View{}, dvec3(0.0, -1.0, 0.0), dvec3(0.0, 1.0, 0.0));
    CHECK(view.back == dvec3(0.0, 1.0, 0.0));
    CHECK(close(glm::dot(view.right, view.right), 1.0, 1e-15));
}

TEST_CASE("jitter moves the image by fractions of a pixel", "[math][view][property]") {
    check::for_all(math::views(), check::floats(-1.0, 1.0), check::floats(-1.0, 1.0),
                   [](View const& view, double dx, double dy) {
                       math::PixelRay const ray = math::pixel_ray(view, dvec2(1.0, 2.0));
                       dvec3 const moved = math::project(math::jittered(view, dvec2(dx, dy)), ray.start_m + ray.step * 2.0);
                       double const tolerance = 1e-9 * (view.size_px.x + view.size_px.y);
                       CHECK(close(moved.x, 1.0 - dx, tolerance));
                       CHECK(close(moved.y, 2.0 - dy, tolerance));
                   });
}

TEST_CASE("matrices do not depend on where in the world the eye stands", "[math][view]") {
    auto config = camera();
    auto const here = math::make_perspective(config).value();
    config.eye_m += dvec3(1e7, -1e7, 1e7);
    config.target_m += dvec3(1e7, -1e7, 1e7);
    auto const there = math::make_perspective(config).value();
    CHECK(math::clip_from_relative(here) == math::clip_from_relative(there));
}

TEST_CASE("a view that cannot be is refused with its value", "[math][view]") {
    auto const code = [](auto change) {
        auto config = camera();
        change(config);
        return math::make_perspective(config).failure();
    };
    CHECK(code([](auto& c) { c.eye_m.x = not_a_number; }).code == math::ViewError::not_finite);
    CHECK(code([](auto& c) { c.target_m.z = inf; }).code == math::ViewError::not_finite);
    CHECK(code([](auto& c) { c.target_m = c.eye_m; }).code == math::ViewError::no_direction);
    CHECK(code([](auto& c) { c.fov_y_rad = 0.0; }).code == math::ViewError::bad_field);
    CHECK(code([](auto& c) { c.fov_y_rad = 3.2; }).code == math::ViewError::bad_field);
    CHECK(code([](auto& c) { c.fov_y_rad = not_a_number; }).code == math::ViewError::bad_field);
    CHECK(code([](auto& c) { c.near_m = 0.0; }).code == math::ViewError::bad_depth_range);
    CHECK(code([](auto& c) { c.far_m = c.near_m; }).code == math::ViewError::bad_depth_range);
    CHECK(code([](auto& c) { c.near_m = not_a_number; }).code == math::ViewError::bad_depth_range);
    auto const empty = code([](auto& c) { c.size_px.y = 0; });
    CHECK(empty.code == math::ViewError::empty_image);
    CHECK_THAT(empty.message, Catch::Matchers::Contains("640x0"));
}

TEST_CASE("an orthographic view needs a window with an area and two finite ends", "[math][view]") {
    math::OrthographicConfig config;
    REQUIRE(math::make_orthographic(config));
    config.far_m = inf;
    CHECK(math::make_orthographic(config).failure().code == math::ViewError::bad_depth_range);
    config.far_m = 1.0;
    config.window_m = {1.0, 1.0, -1.0, 1.0};
    CHECK(math::make_orthographic(config).failure().code == math::ViewError::bad_field);
    config.window_m = {-1.0, not_a_number, -1.0, 1.0};
    CHECK(math::make_orthographic(config).failure().code == math::ViewError::bad_field);
}
