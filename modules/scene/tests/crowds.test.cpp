#include <gnomon/check/check.hpp>
#include <gnomon/scene/path.hpp>
#include <gnomon/scene/pose.hpp>
#include <gnomon/scene/procedural.hpp>

#include "solidity.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

// `houses`, `robots`, `necropolis`.

using namespace gnomon;

namespace {

scene::Scene crowd_of(char const* name, std::uint64_t triangles = 0, char const* lights = "") {
    scene::ProceduralConfig config{name, triangles};
    config.lights = lights;
    auto made = scene::make_procedural(config);
    REQUIRE(made.has_value());
    REQUIRE(scene::validate(*made).has_value());
    return *std::move(made);
}

std::uint64_t faults_of(scene::Scene const& s) {
    std::uint64_t bad = 0;
    for (scene::Mesh const& mesh : s.meshes) {
        bad += scene::solidity::open_edges(mesh);
        bad += scene::solidity::signed_volume(mesh) > 0.0 ? 0U : 1U;
        for (scene::Primitive const& p : mesh.primitives) bad += p.indices.size() / 3 <= 512 ? 0U : 1U;
    }
    return bad;
}

math::dvec3 place_of(math::dmat4 const& m) { return {m[3][0], m[3][1], m[3][2]}; }

/// Nodes that leave the box, jump further than `step_m` in a quarter of a second, or end apart from where they began.
std::size_t strays(scene::Scene const& s, math::dvec3 const& lo, math::dvec3 const& hi, double step_m) {
    double const duration = scene::duration_s(s.animations[0]);
    scene::Pose before = scene::pose_at(s, {0.0, 0, false});
    scene::Pose const end = scene::pose_at(s, {duration, 0, false});
    std::size_t bad = 0;
    for (std::size_t i = 0; i < s.nodes.size(); ++i)
        for (math::axis_t column = 0; column < 4; ++column)
            for (math::axis_t row = 0; row < 3; ++row)
                bad += std::abs(end.world_from_node[i][column][row] - before.world_from_node[i][column][row]) > 1e-4 ? 1U : 0U;
    for (double time = 0.25; time <= duration; time += 0.25) {
        scene::Pose const now = scene::pose_at(s, {time, 0, false});
        for (std::size_t i = 0; i < s.nodes.size(); ++i) {
            math::dvec3 const p = place_of(now.world_from_node[i]);
            for (math::axis_t axis = 0; axis < 3; ++axis) bad += p[axis] < lo[axis] || p[axis] > hi[axis] ? 1U : 0U;
            bad += glm::length(p - place_of(before.world_from_node[i])) > step_m ? 1U : 0U;
        }
        before = now;
    }
    return bad;
}

}  // namespace

TEST_CASE("a thousand equal houses come in 1.01M and 60k triangles, closed", "[scene][crowds]") {
    scene::Scene const many = crowd_of("houses");
    scene::Scene const few = crowd_of("houses", 60'000);
    CHECK(scene::count_triangles(many) == 1'012'320);
    CHECK(scene::count_triangles(few) == 60'320);
    CHECK(scene::count_unique_triangles(many) < 2000);
    CHECK(faults_of(many) == 0);
    CHECK(faults_of(few) == 0);
    CHECK(many.lights == few.lights);
    REQUIRE(many.lights.size() == 256);
    for (scene::Light const& light : many.lights) {
        CHECK(light.range_m == 8.0F);
        CHECK(light.intensity == many.lights[0].intensity);
    }
    CHECK(scene::solidity::hash_of(few) == 11827724057509104242U);
    CHECK_FALSE(scene::make_procedural({"houses", 100}).has_value());
}

TEST_CASE("the zoom begins 300 m before a house and ends in it", "[scene][crowds]") {
    scene::Scene const s = crowd_of("houses", 60'000);
    auto const path = scene::make_path({"houses"}, "zoom");
    REQUIRE(path.has_value());
    math::dvec3 const first = path->frames.front().eye_m;
    math::dvec3 const last = path->frames.back().eye_m;
    CHECK(std::abs(first.z - last.z - 301.7) < 1e-9);
    bool inside = false;
    for (scene::Instance const& i : s.instances) {
        math::dvec3 const p = last - place_of(i.world_from_mesh);
        inside = inside || (i.name == "house" && std::abs(p.x) < 4.7 && std::abs(p.z) < 3.7 && p.y > 0.0 && p.y < 2.6);
    }
    CHECK(inside);
}

TEST_CASE("eleven robots and their street have 180k triangles, closed", "[scene][crowds]") {
    scene::Scene const s = crowd_of("robots");
    CHECK(scene::count_triangles(s) == 180'294);
    CHECK(std::count_if(s.instances.begin(), s.instances.end(), [](auto const& i) { return i.name == "robot"; }) == 11);
    CHECK(faults_of(s) == 0);
    CHECK(scene::solidity::hash_of(s) == 6966200321944778250U);
    CHECK(s.lights.size() == 924);
    for (scene::Light const& light : s.lights) {
        CHECK(light.range_m == 12.5F);
        CHECK(std::abs(light.position_m.x) < 14.55);
        CHECK(std::abs(light.position_m.z) < 200.0);
    }
    CHECK_FALSE(scene::make_procedural({"robots", 0, 1, 0.0, 0, "12"}).has_value());
}

TEST_CASE("the robots stay in the street and apart, and carry the few lights", "[scene][crowds]") {
    scene::Scene const s = crowd_of("robots", 0, "few");
    REQUIRE(s.lights.size() == 11);
    CHECK(strays(s, {-14.0, -0.1, -200.0}, {14.0, 3.0, 200.0}, 3.0) == 0);
    double nearest = 1e9;
    for (double time = 0.0; time < 120.0; time += 0.5) {
        scene::Pose const now = scene::pose_at(s, {time});
        std::vector<math::dvec3> robots;
        for (std::size_t i = 0; i < s.nodes.size(); ++i)
            if (s.nodes[i].name == "robot") robots.push_back(place_of(now.world_from_node[i]));
        REQUIRE(robots.size() == 11);
        for (std::size_t a = 0; a < 11; ++a) {
            for (std::size_t b = a + 1; b < 11; ++b) nearest = std::min(nearest, glm::length(robots[a] - robots[b]));
            scene::Light const light = scene::posed_light(s, now, static_cast<std::uint32_t>(a));
            CHECK(light.range_m == 40.0F);
            if (glm::length(light.position_m - robots[a]) > 3.7) CHECK(glm::length(light.position_m - robots[a]) <= 3.7);
        }
    }
    CHECK(nearest > 1.45);
}

TEST_CASE("the necropolis has 600k triangles or as many as asked for, closed", "[scene][crowds]") {
    scene::Scene const s = crowd_of("necropolis");
    CHECK(scene::count_triangles(s) == 599'870);
    CHECK(scene::count_triangles(crowd_of("necropolis", 2'580'000)) == 2'579'970);
    CHECK(faults_of(s) == 0);
    CHECK(std::count_if(s.instances.begin(), s.instances.end(), [](auto const& i) { return i.name == "spirit"; }) == 40);
    CHECK(scene::solidity::hash_of(s) == 14037248035063462919U);
    CHECK_FALSE(scene::make_procedural({"necropolis", 1000}).has_value());
}

TEST_CASE("the lights of the necropolis are 275 with ranges log-uniform from 2 to 60 m, and 101 that fly", "[scene][crowds]") {
    scene::Scene const s = crowd_of("necropolis");
    REQUIRE(s.lights.size() == 376);
    std::size_t moving = 0;
    std::size_t below_middle = 0;
    for (scene::Light const& light : s.lights) {
        CHECK(light.range_m >= 2.0F);
        CHECK(light.range_m <= 60.0F);
        moving += light.node == scene::none ? 0U : 1U;
        below_middle += light.range_m < 10.954F ? 1U : 0U;  // the square root of 2 * 60
    }
    CHECK(moving == 101);
    CHECK(below_middle > 150);
    CHECK(below_middle < 226);
    CHECK(crowd_of("necropolis", 0, "static").lights.size() == 275);
    CHECK(crowd_of("necropolis", 0, "300").lights.size() == 300);
    scene::ProceduralConfig config{"necropolis"};
    config.lights = "377";
    CHECK_FALSE(scene::make_procedural(config).has_value());
    CHECK(strays(s, {-100.0, -20.0, -120.0}, {100.0, 45.0, 100.0}, 25.0) == 0);
}
