#include <gnomon/check/check.hpp>
#include <gnomon/scene/path.hpp>
#include <gnomon/scene/pose.hpp>
#include <gnomon/scene/procedural.hpp>

#include "solidity.hpp"

#include <cmath>
#include <map>
#include <string>

using namespace gnomon;

namespace {

scene::Scene town_of(double moving_percent) {
    scene::ProceduralConfig config{"town"};
    config.moving_percent = moving_percent;
    auto made = scene::make_procedural(config);
    REQUIRE(made.has_value());
    return *std::move(made);
}

std::map<std::string, int> counts_by_name(scene::Scene const& s) {
    std::map<std::string, int> counts;
    for (scene::Instance const& i : s.instances) ++counts[i.name];
    return counts;
}

}  // namespace

TEST_CASE("the town has its ground, 400 buildings and 3000 small things in 500k triangles", "[scene][town]") {
    scene::Scene const s = town_of(0.0);
    auto counts = counts_by_name(s);
    CHECK(counts["ground"] == 1);
    CHECK(counts["building"] == 400);
    CHECK(s.instances.size() == 1 + 400 + 3000);
    CHECK(std::abs(static_cast<double>(scene::count_triangles(s)) - 500e3) < 0.02 * 500e3);
    scene::Mesh const& ground = s.meshes[s.instances[0].mesh];
    std::size_t ground_triangles = 0;
    for (scene::Primitive const& p : ground.primitives) ground_triangles += p.indices.size() / 3;
    CHECK(ground_triangles == 20'376);
    CHECK(scene::solidity::hash_of(s) == 6316595629374074243U);
}

TEST_CASE("all that stands in the town is closed and faces outward, in chunks", "[scene][town]") {
    scene::Scene const s = town_of(0.0);
    std::uint64_t bad = 0;
    for (scene::Mesh const& mesh : s.meshes) {
        bad += scene::solidity::open_edges(mesh);
        bad += scene::solidity::signed_volume(mesh) > 0.0 ? 0U : 1U;
        for (scene::Primitive const& p : mesh.primitives) bad += p.indices.size() / 3 <= 512 ? 0U : 1U;
    }
    CHECK(bad == 0);
}

TEST_CASE("the town's buildings are 6 to 20 m high, its small things 0.3 to 3.3 m", "[scene][town]") {
    scene::Scene const s = town_of(0.0);
    scene::Geometry const g = scene::flatten(s);
    for (std::size_t i = 0; i < s.instances.size(); ++i) {
        scene::Instance const& instance = s.instances[i];
        if (instance.name == "ground") continue;
        double const over = static_cast<double>(g.instance_bounds[i].hi.y) + g.origin_m.y - instance.world_from_mesh[3][1];
        bool const building = instance.name == "building";
        CAPTURE(instance.name, over);
        bool const fits = building ? over >= 6.0 && over <= 20.3 : over >= 0.3 && over <= 3.05;
        if (!fits) CHECK(fits);
    }
}

TEST_CASE("a share of the town's small things moves, and starts from where it stands otherwise", "[scene][town]") {
    scene::Scene const still = town_of(0.0);
    CHECK(still.animations.empty());
    scene::Geometry const at_rest = scene::flatten(still);
    for (double const percent : {5.0, 20.0}) {
        scene::Scene const s = town_of(percent);
        REQUIRE(scene::validate(s).has_value());
        std::size_t moving = 0;
        for (scene::Instance const& i : s.instances) moving += i.node == scene::none ? 0U : 1U;
        CHECK(moving == static_cast<std::size_t>(30.0 * percent));
        scene::Geometry const start = scene::flatten(s);
        REQUIRE(start.positions.size() == at_rest.positions.size());
        float apart = 0.0F;
        for (std::size_t i = 0; i < start.positions.size(); ++i)
            for (math::axis_t axis = 0; axis < 3; ++axis)
                apart = std::max(apart, std::abs(start.positions[i][axis] - at_rest.positions[i][axis]));
        CHECK(apart < 1e-4F);
    }
}

TEST_CASE("what moves in the town stays in it, does not jump, and ends where it began", "[scene][town]") {
    scene::Scene const s = town_of(20.0);
    REQUIRE(s.animations.size() == 1);
    CHECK(scene::duration_s(s.animations[0]) == 40.0);
    scene::Pose before = scene::pose_at(s, {0.0, 0, false});
    scene::Pose const end = scene::pose_at(s, {40.0, 0, false});
    auto const place = [](math::dmat4 const& m) { return math::dvec3(m[3][0], m[3][1], m[3][2]); };
    for (std::size_t i = 0; i < s.nodes.size(); ++i) {
        CHECK(glm::length(place(end.world_from_node[i]) - place(before.world_from_node[i])) < 1e-5);
        CHECK(std::abs(end.world_from_node[i][0][0] - before.world_from_node[i][0][0]) < 1e-5);
    }
    std::size_t bad = 0;
    for (int frame = 1; frame <= 400; ++frame) {
        scene::Pose const now = scene::pose_at(s, {0.1 * frame, 0, false});
        for (std::size_t i = 0; i < s.nodes.size(); ++i) {
            math::dvec3 const p = place(now.world_from_node[i]);
            bad += std::abs(p.x) > 300.0 || std::abs(p.z) > 300.0 || p.y < 0.0 || p.y > 10.0 ? 1U : 0U;
            bad += glm::length(p - place(before.world_from_node[i])) > 0.9 ? 1U : 0U;
        }
        before = now;
    }
    CHECK(bad == 0);
}

TEST_CASE("no two of the town's cars meet", "[scene][town]") {
    scene::Scene const s = town_of(20.0);
    std::vector<std::uint32_t> cars;
    for (std::uint32_t i = 0; i < s.nodes.size(); ++i)
        if (s.nodes[i].name == "car") cars.push_back(i);
    CHECK(cars.size() == 240);
    double nearest = 1e9;
    for (int frame = 0; frame < 80; ++frame) {
        scene::Pose const now = scene::pose_at(s, {0.5 * frame});
        for (std::size_t a = 0; a < cars.size(); ++a)
            for (std::size_t b = a + 1; b < cars.size(); ++b) {
                auto const& m = now.world_from_node[cars[a]];
                auto const& n = now.world_from_node[cars[b]];
                nearest = std::min(nearest, std::hypot(m[3][0] - n[3][0], m[3][2] - n[3][2]));
            }
    }
    CHECK(nearest > 3.0);
}

TEST_CASE("the town takes from 0 to 20 percent of movement, and no other scene does", "[scene][town]") {
    auto const refuses = [](char const* name, double percent) {
        scene::ProceduralConfig config{name};
        config.moving_percent = percent;
        return !scene::make_procedural(config).has_value();
    };
    CHECK(refuses("town", 20.1));
    CHECK(refuses("town", -1.0));
    CHECK(refuses("town", std::nan("")));
    CHECK(refuses("cubes", 5.0));
    scene::ProceduralConfig lit{"town"};
    lit.lights = "many";
    CHECK_FALSE(scene::make_procedural(lit).has_value());
}
