#include <gnomon/check/check.hpp>
#include <gnomon/math/generators.hpp>
#include <gnomon/projection.hpp>

#include <cmath>
#include <limits>
#include <string>

namespace {

using namespace gnomon;
using math::Aabb;
using math::dvec3;
using math::vec3;
using math::View;

/// A position through the float pipeline, as a depth pass and a lookup do it: image point in texels, and depth.
vec3 in_map(View const& view, dvec3 const& origin_m, vec3 const& position) {
    vec3 const relative = position - math::to_float(view.eye_m - origin_m);
    math::vec4 const clip = math::clip_from_relative(view) * math::vec4(relative.x, relative.y, relative.z, 1.0F);
    return vec3((clip.x / clip.w * 0.5F + 0.5F) * static_cast<float>(view.size_px.x),
                (clip.y / clip.w * 0.5F + 0.5F) * static_cast<float>(view.size_px.y), clip.z / clip.w);
}

bool holds_corners(View const& view, dvec3 const& origin_m, Aabb const& box, float margin_px) {
    for (unsigned i = 0; i < 8; ++i) {
        vec3 const at = in_map(view, origin_m, math::corner(box, i));
        auto const width = static_cast<float>(view.size_px.x);
        auto const height = static_cast<float>(view.size_px.y);
        bool const inside = at.x >= margin_px && at.x <= width - margin_px && at.y >= margin_px &&
                            at.y <= height - margin_px && at.z >= 0.0F && at.z <= 1.0F;
        if (!inside) return false;
    }
    return true;
}

}  // namespace

TEST_CASE("a sun's map holds every corner of its casters, with the margin free", "[projection][property]") {
    auto const unit = check::floats(-1.0, 1.0);
    auto const place = check::floats(-2000.0F, 2000.0F);
    auto const extent = check::floats(0.0F, 900.0F);
    auto const boxes = check::map(check::tuple_of(place, place, place, extent, extent, extent), [](auto const& t) {
        auto const [x, y, z, a, b, c] = t;
        return Aabb{vec3(x, y, z), vec3(x + a, y + b, z + c)};
    });
    check::for_all(check::cases(3000), unit, unit, unit, boxes, check::booleans(), check::integers(0, 4),
                   [](double x, double y, double z, Aabb const& box, bool reversed, int margin) {
                       dvec3 const direction(x, y, z);
                       if (direction == dvec3(0.0)) return;
                       projection::DirectionalConfig config;
                       config.depth = reversed ? math::Depth::reversed : math::Depth::forward;
                       config.margin_px = margin;
                       auto const view = projection::directional_view(direction, box, {}, config);
                       REQUIRE(view);
                       // The margin is measured in floats, which know a texel to about 1/1000.
                       CHECK(holds_corners(*view, dvec3(0.0), box, static_cast<float>(margin) - 0.01F));
                   });
}

TEST_CASE("a sun's window is tight: some corner lies within half a texel of each margin", "[projection]") {
    projection::DirectionalConfig config;
    config.margin_px = 3.0;
    Aabb const box{vec3(-500.0F, 0.0F, -500.0F), vec3(500.0F, 78.0F, 500.0F)};
    View const view = projection::directional_view(dvec3(-0.45, -0.8, -0.4), box, {}, config).value();
    vec3 lo(1e9F);
    vec3 hi(-1e9F);
    for (unsigned i = 0; i < 8; ++i) {
        vec3 const at = in_map(view, dvec3(0.0), math::corner(box, i));
        lo = glm::min(lo, at);
        hi = glm::max(hi, at);
    }
    CHECK(lo.x == Approx(3.0).margin(0.5));
    CHECK(lo.y == Approx(3.0).margin(0.5));
    CHECK(hi.x == Approx(1021.0).margin(0.5));
    CHECK(hi.y == Approx(1021.0).margin(0.5));
    CHECK(lo.z == Approx(0.0).margin(1e-4));
    CHECK(hi.z == Approx(1.0).margin(1e-4));
}

TEST_CASE("receivers narrow the window, casters keep the depth range", "[projection]") {
    Aabb const casters{vec3(-100.0F, 0.0F, -100.0F), vec3(100.0F, 50.0F, 100.0F)};
    Aabb const receivers{vec3(-5.0F, 0.0F, -5.0F), vec3(5.0F, 2.0F, 5.0F)};
    View const wide = projection::directional_view(dvec3(0.3, -1.0, 0.1), casters, {}, {}).value();
    View const narrow = projection::directional_view(dvec3(0.3, -1.0, 0.1), casters, receivers, {}).value();
    CHECK(narrow.window.right - narrow.window.left < 0.1 * (wide.window.right - wide.window.left));
    CHECK(narrow.near_m == wide.near_m);
    CHECK(narrow.far_m == wide.far_m);
    CHECK(holds_corners(narrow, dvec3(0.0), receivers, 1.9F));
    // A receiver far behind the casters lies in the depth range too, so it compares as itself.
    Aabb const below{vec3(-5.0F, -900.0F, -5.0F), vec3(5.0F, -899.0F, 5.0F)};
    View const deep = projection::directional_view(dvec3(0.0, -1.0, 0.0), casters, below, {}).value();
    CHECK(holds_corners(deep, dvec3(0.0), below, 1.9F));
}

TEST_CASE("a sun straight overhead, underfoot and level has a view", "[projection]") {
    Aabb const box{vec3(-10.0F, 0.0F, -3.0F), vec3(10.0F, 5.0F, 3.0F)};
    for (dvec3 const& direction : {dvec3(0.0, -1.0, 0.0), dvec3(0.0, 1.0, 0.0), dvec3(1.0, 0.0, 0.0),
                                   dvec3(0.0, -1e-300, 0.0), dvec3(0.0, -1e300, 1e280), dvec3(1e-12, -1.0, 0.0)}) {
        auto const view = projection::directional_view(direction, box, {}, {});
        REQUIRE(view);
        CHECK(std::abs(glm::dot(view->right, view->up)) < 1e-12);
        CHECK(holds_corners(*view, dvec3(0.0), box, 1.9F));
    }
}

TEST_CASE("flat, thin and one-point bounds have a view", "[projection]") {
    for (Aabb const& box : {Aabb{vec3(1.0F, 2.0F, 3.0F), vec3(1.0F, 2.0F, 3.0F)}, Aabb{vec3(0.0F), vec3(0.0F)},
                            Aabb{vec3(-5.0F, 0.0F, -5.0F), vec3(5.0F, 0.0F, 5.0F)},
                            Aabb{vec3(0.0F, 0.0F, 0.0F), vec3(0.0F, 100.0F, 0.0F)}}) {
        auto const view = projection::directional_view(dvec3(0.0, -1.0, 0.0), box, {}, {});
        REQUIRE(view);
        CHECK(view->window.left < view->window.right);
        CHECK(view->window.bottom < view->window.top);
        CHECK(view->near_m < view->far_m);
        CHECK(holds_corners(*view, dvec3(0.0), box, 1.9F));
    }
}

TEST_CASE("1e7 m from the origin the map is as tight and holds as much", "[projection]") {
    dvec3 const origin(1e7 + 384.0, -1e7 + 640.0, 1e7 + 384.0);
    Aabb const box{vec3(-500.0F, 0.0F, -500.0F), vec3(500.0F, 78.0F, 500.0F)};
    projection::DirectionalConfig config;
    View const here = projection::directional_view(dvec3(-0.45, -0.8, -0.4), box, {}, config).value();
    config.origin_m = origin;
    View const there = projection::directional_view(dvec3(-0.45, -0.8, -0.4), box, {}, config).value();
    CHECK(there.window.right - there.window.left == Approx(here.window.right - here.window.left).epsilon(1e-6));
    CHECK(holds_corners(there, origin, box, 1.9F));
}

TEST_CASE("a margin wider than the map leaves one texel for the scene", "[projection]") {
    projection::DirectionalConfig config;
    config.size_px = math::ivec2(4, 4);
    config.margin_px = 100.0;
    Aabb const box{vec3(-1.0F), vec3(1.0F)};
    View const view = projection::directional_view(dvec3(0.0, -1.0, 0.0), box, {}, config).value();
    CHECK(view.window.right - view.window.left == Approx(8.0).epsilon(1e-4));
}

TEST_CASE("a senseless sun is refused by name", "[projection]") {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    double const inf = std::numeric_limits<double>::infinity();
    Aabb const box{vec3(-1.0F), vec3(1.0F)};
    using projection::Error;
    auto const zero = projection::directional_view(dvec3(0.0, 0.0, -0.0), box, {}, {});
    REQUIRE_FALSE(zero);
    CHECK(zero.failure().code == Error::no_direction);
    CHECK(zero.failure().message.find("(0, 0, -0)") != std::string::npos);
    for (double const bad : {nan, inf, -inf}) {
        auto const view = projection::directional_view(dvec3(0.0, bad, 0.0), box, {}, {});
        REQUIRE_FALSE(view);
        CHECK(view.failure().code == Error::not_finite);
    }
    auto const nothing = projection::directional_view(dvec3(0.0, -1.0, 0.0), {}, {}, {});
    REQUIRE_FALSE(nothing);
    CHECK(nothing.failure().code == Error::empty_bounds);
    projection::DirectionalConfig config;
    config.size_px = math::ivec2(0, 16);
    auto const empty = projection::directional_view(dvec3(0.0, -1.0, 0.0), box, {}, config);
    REQUIRE_FALSE(empty);
    CHECK(empty.failure().code == Error::empty_map);
}
