#include <gnomon/check/check.hpp>
#include <gnomon/scene/procedural.hpp>
#include <gnomon/scene/suggest.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

using namespace gnomon;

namespace {

/// A box as triangles: its fronts outside, or inside as a room has them.
scene::Scene box_scene(math::vec3 const& lo, math::vec3 const& hi, bool room) {
    scene::Scene s;
    s.materials.emplace_back();
    scene::Primitive p;
    for (unsigned i = 0; i < 8; ++i) {
        p.positions.emplace_back((i & 1U) != 0 ? hi.x : lo.x, (i & 2U) != 0 ? hi.y : lo.y, (i & 4U) != 0 ? hi.z : lo.z);
        p.normals.emplace_back(0.0F, 1.0F, 0.0F);
    }
    constexpr std::array<std::array<std::uint32_t, 4>, 6> faces{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (auto const& f : faces)
        for (std::uint32_t const corner : {0U, 1U, 2U, 0U, 2U, 3U}) p.indices.push_back(f[room ? (4 - corner) % 4 : corner]);
    p.material = 0;
    s.meshes.push_back({"", {p}});
    s.instances.push_back({"", 0, math::dmat4(1.0)});
    return s;
}

bool is_usable(scene::SuggestedView const& v) {
    return math::is_finite(v.eye_m) && math::is_finite(v.target_m) && v.eye_m != v.target_m && v.near_m > 0.0 &&
           v.fov_y_rad > 0.1 && v.fov_y_rad < 2.0;
}

}  // namespace

TEST_CASE("a box is looked at from outside and above, a room from inside", "[scene][suggest]") {
    scene::SuggestedView const box = scene::auto_view(box_scene({-1.0F, 0.0F, -2.0F}, {1.0F, 2.0F, 2.0F}, false));
    CHECK(is_usable(box));
    CHECK_FALSE(box.inside);
    CHECK(box.eye_m.y > 2.0);
    scene::SuggestedView const room = scene::auto_view(box_scene({-3.0F, 0.0F, -8.0F}, {3.0F, 4.0F, 8.0F}, true));
    CHECK(is_usable(room));
    CHECK(room.inside);
    CHECK((std::abs(room.eye_m.x) < 3.0 && room.eye_m.y > 0.0 && room.eye_m.y < 4.0 && std::abs(room.eye_m.z) < 8.0));
    math::dvec3 const along = glm::normalize(room.target_m - room.eye_m);
    CHECK(std::abs(along.z) > 0.8);  // down the long axis
}

TEST_CASE("every corner of a box is in the suggested picture", "[scene][suggest]") {
    for (math::vec3 const size : {math::vec3(1.0F), math::vec3(1e-4F, 1e-4F, 3e-4F), math::vec3(1e4F, 2e4F, 1e4F), math::vec3(1.0F, 9.0F, 1.0F)}) {
        scene::Scene const s = box_scene(-size, size, false);
        scene::SuggestedView const v = scene::auto_view(s);
        REQUIRE(is_usable(v));
        auto const view = math::make_perspective({v.eye_m, v.target_m, {0.0, 1.0, 0.0}, v.fov_y_rad, v.near_m,
                                                  std::numeric_limits<double>::infinity(), {100, 100}, math::Depth::reversed});
        REQUIRE(view.has_value());
        for (math::vec3 const& corner : s.meshes[0].primitives[0].positions) {
            math::dvec3 const px = math::project(*view, math::to_double(corner) - v.eye_m);
            CHECK((px.x >= 0.0 && px.x <= 100.0 && px.y >= 0.0 && px.y <= 100.0));
            CHECK((px.z > 0.0 && px.z < 1.0));  // beyond the near plane
        }
    }
}

TEST_CASE("a view is suggested for nothing, for a point and for a line", "[scene][suggest]") {
    CHECK(is_usable(scene::auto_view(scene::Geometry{})));
    CHECK(is_usable(scene::auto_view(box_scene(math::vec3(5.0F), math::vec3(5.0F), false))));
    CHECK(is_usable(scene::auto_view(box_scene({0.0F, 0.0F, 0.0F}, {0.0F, 7.0F, 0.0F}, false))));
    CHECK(is_usable(scene::auto_view(box_scene({0.0F, 0.0F, 0.0F}, {1e30F, 0.0F, 1e30F}, false))));
}

TEST_CASE("a view far from the origin is that of the same scene near it", "[scene][suggest]") {
    auto const near = scene::make_procedural({"sheet", 0, 1, 0.0, 0});
    auto const far = scene::make_procedural({"sheet", 0, 1, 131072.0, 0});
    REQUIRE(near.has_value());
    REQUIRE(far.has_value());
    math::dvec3 const moved = scene::auto_view(*far).eye_m - scene::auto_view(*near).eye_m;
    CHECK(glm::length(moved - math::dvec3(131072.0)) < 1e-6);
}

TEST_CASE("a camera's view has its axes, its field and its range", "[scene][suggest]") {
    scene::Camera camera = scene::looking_at("c", {1.0, 2.0, 3.0}, {4.0, 1.0, -2.0}, 1.0);
    camera.near_m = 0.25;
    auto const view = scene::make_view(camera, {200, 100});
    REQUIRE(view.has_value());
    CHECK(view->right == camera.right);
    CHECK(view->back == camera.back);
    CHECK(view->near_m == 0.25);
    CHECK(view->window.top == Approx(std::tan(0.5)));
    CHECK(view->window.right == Approx(2.0 * std::tan(0.5)));
    camera.kind = scene::CameraKind::orthographic;
    camera.half_height_m = 5.0;
    camera.far_m = 100.0;
    auto const flat = scene::make_view(camera, {200, 100});
    REQUIRE(flat.has_value());
    CHECK(flat->lens == math::Lens::orthographic);
    CHECK(flat->window.right == Approx(10.0));
    CHECK_FALSE(scene::make_view(camera, {0, 100}).has_value());
    camera.far_m = 0.1;
    CHECK_FALSE(scene::make_view(camera, {200, 100}).has_value());
}

TEST_CASE("the default sun is a directional light that shines downward", "[scene][suggest]") {
    scene::Light const sun = scene::default_sun();
    CHECK(sun.kind == scene::LightKind::directional);
    CHECK(glm::length(sun.direction) == Approx(1.0));
    CHECK(sun.direction.y < -0.5);
}

TEST_CASE("an open place gets the sun, a closed room a lamp within it", "[scene][suggest]") {
    scene::Scene const city = scene::make_procedural({.name = "city", .triangles = 52'000}).value();
    scene::Geometry const streets = scene::flatten(city);
    math::View const above = scene::make_view(city.cameras.front(), {64, 64}).value();
    CHECK(scene::auto_light(streets, above).kind == scene::LightKind::directional);

    scene::Scene const closed = box_scene(math::vec3(-2.0F), math::vec3(2.0F), true);
    scene::Geometry const room = scene::flatten(closed);
    math::View const inside =
        scene::make_view(scene::looking_at("", {1.5, 0.0, 1.5}, {-2.0, -0.5, -2.0}, 1.2), {64, 64}).value();
    scene::Light const lamp = scene::auto_light(room, inside);
    REQUIRE(lamp.kind == scene::LightKind::point);
    CHECK(math::contains(room.bounds, math::to_float(lamp.position_m)));
    CHECK(lamp.position_m.y > 0.0);
}
