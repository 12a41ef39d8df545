#include <gnomon/check/check.hpp>
#include <gnomon/math/frustum.hpp>
#include <gnomon/math/generators.hpp>

#include <limits>

namespace {
using namespace gnomon;
using math::Aabb;
using math::dvec3;
using math::Frustum;
using math::vec3;
using math::View;
}  // namespace

TEST_CASE("a point is inside the planes exactly when it projects into the image and the depth range",
          "[math][frustum][property]") {
    auto const around = check::floats(-0.5, 1.5);
    check::for_all(math::views(), around, around, around, [](View const& view, double x, double y, double along) {
        double const far_m = math::is_finite(view.far_m) ? view.far_m : view.near_m * 100.0;
        double const distance = view.near_m + (far_m - view.near_m) * along;
        if (view.lens == math::Lens::perspective && !(distance > 0.0)) return;
        // Rounding decides near a border, so points there are not asked.
        for (double const t : {x, y, along})
            if (std::abs(t) < 1e-6 || std::abs(t - 1.0) < 1e-6) return;
        math::PixelRay const ray = math::pixel_ray(view, math::dvec2(x * view.size_px.x, y * view.size_px.y));
        bool const beyond = along > 1.0 && math::is_finite(view.far_m);
        bool const expected = x > 0.0 && x < 1.0 && y > 0.0 && y < 1.0 && along > 0.0 && !beyond;
        CHECK(math::frustum_of(view).contains(ray.start_m + ray.step * distance) == expected);
    });
}

TEST_CASE("a box with a visible point is never rejected", "[math][frustum][property]") {
    auto const within = check::floats(0.0, 1.0);
    check::for_all(check::cases(5000), math::views(), within, within, within, check::floats(0.0F, 10.0F),
                   [](View const& view, double x, double y, double along, float size) {
                       double const far_m = math::is_finite(view.far_m) ? view.far_m : view.near_m * 100.0;
                       math::PixelRay const ray =
                           math::pixel_ray(view, math::dvec2(x * view.size_px.x, y * view.size_px.y));
                       vec3 const point = math::to_float(ray.start_m + ray.step * (view.near_m + (far_m - view.near_m) * along));
                       Frustum const frustum = math::frustum_of(view);
                       if (!frustum.contains(math::to_double(point))) return;
                       CHECK(frustum.may_touch({point, point}));
                       CHECK(frustum.may_touch({point - vec3(size), point}));
                       CHECK(frustum.may_touch({point, point + vec3(size)}));
                   });
}

TEST_CASE("boxes clearly outside each plane are rejected", "[math][frustum]") {
    math::PerspectiveConfig config;
    config.far_m = 100.0;
    auto const frustum = math::frustum_of(math::make_perspective(config).value());
    auto const cube = [](float x, float y, float z) { return Aabb{vec3(x, y, z) - vec3(1.0F), vec3(x, y, z) + vec3(1.0F)}; };
    CHECK(frustum.may_touch(cube(0.0F, 0.0F, -10.0F)));
    CHECK_FALSE(frustum.may_touch(cube(-20.0F, 0.0F, -10.0F)));
    CHECK_FALSE(frustum.may_touch(cube(20.0F, 0.0F, -10.0F)));
    CHECK_FALSE(frustum.may_touch(cube(0.0F, -20.0F, -10.0F)));
    CHECK_FALSE(frustum.may_touch(cube(0.0F, 20.0F, -10.0F)));
    CHECK_FALSE(frustum.may_touch(cube(0.0F, 0.0F, 2.0F)));
    CHECK_FALSE(frustum.may_touch(cube(0.0F, 0.0F, -102.0F)));
    CHECK_FALSE(frustum.may_touch(Aabb{}));
}

TEST_CASE("side planes are the same for every depth convention, and none is NaN", "[math][frustum][property]") {
    check::for_all(math::views(), [](View view) {
        Frustum const first = math::frustum_of(view);
        for (math::Depth const depth : {math::Depth::forward, math::Depth::reversed})
            for (double const far_m : {view.far_m, std::numeric_limits<double>::infinity()}) {
                view.depth = depth;
                view.far_m = far_m;
                Frustum const other = math::frustum_of(view);
                for (std::size_t i = 0; i < 5; ++i) {
                    CHECK(first.planes[i].normal == other.planes[i].normal);
                    CHECK(first.planes[i].offset == other.planes[i].offset);
                }
                CHECK(math::is_finite(other.planes[5].normal));
                CHECK(math::is_finite(other.planes[5].offset));
            }
    });
}

TEST_CASE("an infinite view sees a box 1e7 metres away", "[math][frustum]") {
    auto const frustum = math::frustum_of(math::make_perspective({}).value());
    CHECK(frustum.may_touch(Aabb{vec3(-1.0F, -1.0F, -1e7F), vec3(1.0F, 1.0F, -1e7F)}));
    CHECK_FALSE(frustum.may_touch(Aabb{vec3(-1.0F, -1.0F, 1e7F), vec3(1.0F, 1.0F, 1e7F)}));
}
