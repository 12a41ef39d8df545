#include <gnomon/check/check.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/path.hpp>
#include <gnomon/scene/suggest.hpp>

#include "../src/detail/coarse_grid.hpp"
#include "../src/detail/generators.hpp"
#include "../src/detail/grid_mesh.hpp"
#include "../src/detail/turn.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace gnomon;

namespace {

scene::CameraPath path_of(scene::ProceduralConfig const& config, std::string_view name) {
    auto path = scene::make_path(config, name);
    REQUIRE(path.has_value());
    return *std::move(path);
}

bool is_upright(scene::Camera const& c) {
    bool const orthonormal = std::abs(glm::dot(c.right, c.right) - 1.0) < 1e-12 && std::abs(glm::dot(c.up, c.up) - 1.0) < 1e-12 &&
                             std::abs(glm::dot(c.right, c.up)) < 1e-12 &&
                             glm::length(glm::cross(c.right, c.up) - c.back) < 1e-12;
    return math::is_finite(c.eye_m) && orthonormal && c.right.y == 0.0 && c.up.y > 0.0;
}

/// Whether solid things leave room at `eye`: rays in many directions meet fronts only, none of them nearer than `clear_m`.
bool stands_free(scene::detail::CoarseGrid const& grid, math::dvec3 const& eye, double clear_m) {
    for (int z = -2; z <= 2; ++z)
        for (int y = -2; y <= 2; ++y)
            for (int x = -2; x <= 2; ++x) {
                math::dvec3 const direction = math::dvec3(x, y, z) + math::dvec3(0.013, 0.017, 0.011);
                scene::detail::GridHit const hit = grid.cast(eye, direction);
                if (hit.triangle == scene::none) continue;
                if (!hit.front || hit.distance * glm::length(direction) < clear_m) return false;
            }
    return true;
}

}  // namespace

TEST_CASE("sine and cosine without libm are as good as libm's", "[scene][path]") {
    double worst = 0.0;
    for (int i = -4000; i <= 4000; ++i) {
        double const turns = i / 1237.0;
        auto const got = scene::detail::sin_cos(turns);
        long double const angle = 2.0L * 3.14159265358979323846264338328L * static_cast<long double>(turns);
        worst = std::max(worst, static_cast<double>(std::abs(static_cast<long double>(got.sin) - std::sin(angle))));
        worst = std::max(worst, static_cast<double>(std::abs(static_cast<long double>(got.cos) - std::cos(angle))));
    }
    CHECK(worst < 1e-15);
    for (int quarter = -8; quarter <= 8; ++quarter) {
        auto const got = scene::detail::sin_cos(quarter * 0.25);
        CHECK(std::abs(got.sin) + std::abs(got.cos) == 1.0);
    }
}

TEST_CASE("every path has the frames it promises, finite and upright, outside of solid things", "[scene][path]") {
    for (scene::ProceduralInfo const& info : scene::procedural_scenes()) {
        if (info.paths.empty()) continue;
        scene::ProceduralConfig const config{std::string(info.name)};
        auto const made = scene::make_procedural(config);
        REQUIRE(made.has_value());
        scene::Geometry const geometry = scene::flatten(*made);
        scene::detail::CoarseGrid const grid(geometry);
        for (scene::PathInfo const& path_info : info.paths) {
            CAPTURE(config.name, std::string(path_info.name));
            scene::CameraPath const path = path_of(config, path_info.name);
            CHECK(path.name == path_info.name);
            CHECK(path.rate_hz == path_info.rate_hz);
            REQUIRE(path.frames.size() == path_info.frames);
            std::size_t bad = 0;
            for (std::size_t i = 0; i < path.frames.size(); ++i) bad += is_upright(path.frames[i]) ? 0U : 1U;
            CHECK(bad == 0);
            std::vector<std::size_t> in_the_way;
            for (std::size_t i = 0; i < path.frames.size(); i += 7)
                if (!stands_free(grid, path.frames[i].eye_m - geometry.origin_m, path.frames[i].near_m)) in_the_way.push_back(i);
            CHECK(in_the_way == std::vector<std::size_t>());
            for (scene::Camera const& camera : path.frames) REQUIRE(scene::make_view(camera, {64, 36}).has_value());
        }
    }
}

TEST_CASE("the city's street is walked at 10 m/s at eye height, the head turning 30 degrees each way", "[scene][path]") {
    scene::CameraPath const path = path_of({"city"}, "street");
    REQUIRE(path.frames.size() == 300);
    double widest = 0.0;
    double narrowest = 0.0;
    for (std::size_t i = 0; i < path.frames.size(); ++i) {
        scene::Camera const& c = path.frames[i];
        CHECK(c.eye_m.y == 1.7);
        if (i > 0) CHECK(std::abs(glm::length(c.eye_m - path.frames[i - 1].eye_m) * path.rate_hz - 10.0) < 1e-9);
        double const yaw_deg = std::atan2(-c.back.x, -c.back.z) * 180.0 / 3.14159265358979;
        widest = std::max(widest, yaw_deg);
        narrowest = std::min(narrowest, yaw_deg);
    }
    CHECK(std::abs(widest - 30.0) < 0.1);
    CHECK(std::abs(narrowest + 30.0) < 0.1);
    CHECK(path_of({"city", 52'000, 9}, "street") == path);
    for (scene::Camera const& c : path_of({"city"}, "air").frames) CHECK(c.eye_m.y == 120.0);
}

TEST_CASE("an unknown path or scene is refused with the known ones", "[scene][path]") {
    auto const refuses = [](scene::ProceduralConfig const& config, char const* path, char const* says) {
        auto const result = scene::make_path(config, path);
        REQUIRE_FALSE(result.has_value());
        CAPTURE(result.failure().message);
        CHECK(result.failure().message.find(says) != std::string::npos);
    };
    refuses({"city"}, "flight", "'flight'");
    refuses({"city"}, "", "street, air");
    refuses({"sheet"}, "street", "none");
    refuses({"atlantis"}, "street", "atlantis");
    refuses({"cubes", 7}, "street", "7");
    CHECK(scene::procedural_paths("atlantis").empty());
    CHECK(scene::procedural_paths("city").size() == 2);
}

TEST_CASE("an orbit goes once round outside the bounds", "[scene][path]") {
    auto const yard = scene::make_procedural({"cubes"});
    REQUIRE(yard.has_value());
    scene::Geometry const outside = scene::flatten(*yard);
    scene::CameraPath const orbit = scene::orbit(outside, 24);
    REQUIRE(orbit.frames.size() == 24);
    math::dvec3 const middle = outside.origin_m + math::to_double((outside.bounds.lo + outside.bounds.hi) * 0.5F);
    double const step = glm::length(orbit.frames[1].eye_m - orbit.frames[0].eye_m);
    for (std::size_t i = 0; i < 24; ++i) {
        scene::Camera const& c = orbit.frames[i];
        CHECK(is_upright(c));
        CHECK(c.eye_m.y == orbit.frames[0].eye_m.y);
        CHECK(std::abs(glm::length(orbit.frames[(i + 1) % 24].eye_m - c.eye_m) - step) < 1e-6 * step);
        CHECK(glm::length(c.eye_m - middle) > static_cast<double>(outside.bounds.hi.x));
        CHECK(glm::dot(glm::normalize(middle - c.eye_m), -c.back) > 0.999);
    }
    CHECK(scene::orbit(scene::Geometry{}, 3).frames.size() == 3);
}

TEST_CASE("an orbit of a room turns on the spot", "[scene][path]") {
    scene::Scene room;
    scene::detail::Lattice walls;
    walls.cells = math::ivec3(8);
    std::uint32_t const paint = scene::detail::add_material(room, "paint", {0.5F, 0.5F, 0.5F});
    scene::Mesh box = scene::detail::box_mesh(walls, paint, paint, true);
    for (scene::Primitive& p : box.primitives)
        for (std::size_t i = 0; i < p.indices.size(); i += 3) std::swap(p.indices[i], p.indices[i + 1]);
    scene::detail::add_instance(room, "room", scene::detail::add_mesh(room, "room", std::move(box)), {20.0, 5.0, 12.0},
                                {7.0, 1.0, -3.0});
    scene::CameraPath const turn = scene::orbit(scene::flatten(room), 8);
    REQUIRE(turn.frames.size() == 8);
    CHECK(turn.name == "turn");
    for (std::size_t i = 0; i < 8; ++i) {
        CHECK(turn.frames[i].eye_m == turn.frames[0].eye_m);
        CHECK(std::abs(glm::length(turn.frames[i].back - turn.frames[(i + 1) % 8].back) -
                       glm::length(turn.frames[0].back - turn.frames[1].back)) < 1e-12);
    }
    CHECK(std::abs(turn.frames[0].eye_m.x - 7.0) < 10.0);
    CHECK(glm::dot(turn.frames[0].back, turn.frames[4].back) < -0.9);
}
