#include "mesh_facts.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/path.hpp>

#include "../src/detail/branching.hpp"
#include "../src/detail/leaf_image.hpp"
#include "../src/detail/solid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

using namespace gnomon;

namespace {

scene::Scene built(scene::ProceduralConfig const& config) {
    auto result = scene::make_procedural(config);
    REQUIRE(result.has_value());
    return std::move(result).value();
}

/// A scene of solids, and what is fixed about it.
struct SolidScene {
    char const* name;
    std::uint64_t triangles;
    std::uint64_t fingerprint;
    std::vector<std::string> open;  ///< Objects that need not be closed.
};

std::vector<SolidScene> solid_scenes() {
    return {
        {"atrium", 250'918, 6953867976954392509U, {}},
        {"cage", 12'000, 2303780379613837607U, {}},
        {"forest", 599'992, 542227219060939942U, {"ground", "ferns"}},
        {"gate", 87'988, 13399590078521868671U, {"lawn"}},
        {"poles", 96'192, 4718232516195392984U, {"plane"}},
        {"tree", 40'066, 2026464555207442703U, {}},
    };
}

bool has(std::vector<std::string> const& names, std::string const& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

TEST_CASE("the scenes of solids have their triangles, in objects of at most about 500", "[scene][solids]") {
    for (SolidScene const& fixed : solid_scenes()) {
        CAPTURE(std::string(fixed.name));
        scene::Scene const s = built({fixed.name});
        CHECK(scene::count_triangles(s) == fixed.triangles);
        std::size_t too_large = 0;
        for (scene::Mesh const& mesh : s.meshes)
            for (scene::Primitive const& p : mesh.primitives) too_large += p.indices.size() > 3 * 512 ? 1U : 0U;
        CHECK(too_large == 0);
    }
}

TEST_CASE("the scenes of solids are the same on every machine", "[scene][solids]") {
    for (SolidScene const& fixed : solid_scenes()) {
        CAPTURE(std::string(fixed.name));
        CHECK(test::fingerprint(built({fixed.name})) == fixed.fingerprint);
    }
}

TEST_CASE("objects are closed where that is promised, and no triangle is without area", "[scene][solids]") {
    for (SolidScene const& fixed : solid_scenes()) {
        scene::Scene const s = built({fixed.name});
        for (scene::Mesh const& mesh : s.meshes) {
            CAPTURE(std::string(fixed.name), mesh.name);
            test::EdgeFacts const facts = test::edge_facts(s, mesh);
            CHECK(facts.degenerate == 0);
            if (!has(fixed.open, mesh.name)) CHECK(facts.closed == facts.edges);
        }
    }
}

TEST_CASE("the fuzz is 400,000 single triangles with sides of 0.1 m, inside 40x20x40 m", "[scene][solids]") {
    scene::Scene const s = built({"fuzzy"});
    std::size_t count = 0;
    std::size_t wrong = 0;
    for (scene::Instance const& i : s.instances) {
        if (i.name != "fuzz") continue;
        test::EdgeFacts const facts = test::edge_facts(s, s.meshes[i.mesh]);
        wrong += facts.open == facts.edges && facts.degenerate == 0 ? 0U : 1U;
        for (scene::Primitive const& p : s.meshes[i.mesh].primitives)
            for (std::size_t k = 0; k < p.indices.size(); k += 3, ++count)
                for (std::size_t e = 0; e < 3; ++e) {
                    math::dvec3 const a = math::to_double(p.positions[p.indices[k + e]]);
                    math::dvec3 const b = math::to_double(p.positions[p.indices[k + (e + 1) % 3]]);
                    math::dvec3 const world = a + math::dvec3(i.world_from_mesh[3]);
                    bool const inside = std::abs(world.x) <= 20.0 && std::abs(world.z) <= 20.0 && world.y >= 0.0 && world.y <= 20.0;
                    wrong += inside && std::abs(glm::length(b - a) - 0.1) < 1e-6 ? 0U : 1U;
                }
    }
    CHECK(count == 400'000);
    CHECK(wrong == 0);
    CHECK(s.lights.at(0).position_m == math::dvec3(11.3, 40.7, -17.9));
    CHECK(s.cameras.at(0).eye_m == math::dvec3(-3.1, 1.7, -52.3));
}

TEST_CASE("the citadel's objects look closed and are open", "[scene][solids]") {
    scene::Scene const s = built({"citadel"});
    CHECK(scene::count_triangles(s) == 59'980);
    CHECK(test::fingerprint(s) == 10659490691566795848U);
    for (std::string const name : {"tower", "wall", "stairs", "house", "keep", "keep roof", "gatehouse", "pine", "hill"}) {
        CAPTURE(name);
        std::size_t found = 0;
        for (scene::Mesh const& mesh : s.meshes) {
            if (mesh.name != name) continue;
            ++found;
            test::EdgeFacts const facts = test::edge_facts(s, mesh);
            CHECK(facts.degenerate == 0);
            CHECK(facts.open > 0);
            CHECK(facts.closed > 0);
            CHECK(facts.open + facts.closed == facts.edges);
            if (name != "stairs") CHECK(facts.closed > facts.open);  // an open edge is the exception
        }
        CHECK(found > 0);
    }
}

TEST_CASE("the gate is 4 m before the eye and the house 80 m, with 30 trees between", "[scene][solids]") {
    scene::Scene const s = built({"gate"});
    double const eye_z = s.cameras.at(0).eye_m.z;
    std::size_t trees = 0;
    for (scene::Instance const& i : s.instances) {
        double const away = eye_z - i.world_from_mesh[3].z;
        if (i.name == "pillars") CHECK(std::abs(away - 4.0) < 1e-9);
        if (i.name == "house walls") CHECK(std::abs(away - 80.0) < 1e-9);
        if (i.name != "tree") continue;
        ++trees;
        CHECK(away > 4.0);
        CHECK(away < 80.0);
    }
    CHECK(trees == 30);
    CHECK(s.lights.size() == 2);
}

TEST_CASE("poles are as thick and as high as is fixed, and so many", "[scene][solids]") {
    scene::Scene const s = built({"poles"});
    std::size_t count = 0;
    for (scene::Instance const& i : s.instances) {
        if (i.name != "pole") continue;
        ++count;
        float top = 0.0F;
        float radius = 0.0F;
        for (math::vec3 const& p : s.meshes[i.mesh].primitives[0].positions) {
            top = std::max(top, p.y);
            if (p.y == 0.0F) radius = std::max(radius, std::abs(p.x));
        }
        CHECK(top >= 3.0F);
        CHECK(top <= 8.0F);
        CHECK(radius >= 0.02F);
        CHECK(radius <= 0.08F);
    }
    CHECK(count == 400);
}

TEST_CASE("the forest's leaves are masked, double-sided, and neither all there nor all gone", "[scene][solids]") {
    scene::Scene const s = built({"forest"});
    std::size_t trees = 0;
    for (scene::Instance const& i : s.instances) trees += i.name == "tree" ? 1U : 0U;
    CHECK(trees == 100);
    std::uint64_t leaves = 0;
    for (scene::Mesh const& mesh : s.meshes)
        for (scene::Primitive const& p : mesh.primitives) {
            scene::Material const& m = s.materials[p.material];
            if (m.base_color_texture.texture == scene::none) continue;
            leaves += p.indices.size() / 3;
            CHECK(m.alpha_mode == scene::AlphaMode::mask);
            CHECK(m.double_sided);
            CHECK(p.uv0.size() == p.positions.size());
        }
    CHECK(leaves > 30'000);
    scene::Image const image = scene::detail::paint_leaves(64);
    REQUIRE(image.rgba.size() == 4 * 64 * 64);
    std::size_t solid = 0;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) solid += image.rgba[i] >= 128 ? 1U : 0U;
    CHECK(solid > 64 * 64 / 4);
    CHECK(solid < 64 * 64 * 3 / 4);
}

TEST_CASE("a tree has the triangles that its shape says, whatever the seed", "[scene][solids]") {
    std::array<scene::detail::BranchLevel, 3> const levels{{{1, 8, 5}, {4, 5, 3}, {3, 3, 2}}};
    scene::detail::TreeShape const shape{6.0, 0.1, 0.3, 0.4, levels};
    for (std::uint64_t seed : {1U, 2U, 3U}) {
        scene::detail::Pcg32 random(seed);
        scene::detail::Tree const tree = scene::detail::grow_tree(shape, random);
        CHECK(tree.bark.triangles.size() == scene::detail::count_tree_triangles(shape));
        CHECK(tree.twigs.size() == 4 * 3 * 2);
        for (scene::detail::Twig const& twig : tree.twigs) CHECK(math::is_finite(twig.at_m));
    }
}

namespace {

/// Six times the volume that a closed solid encloses: positive if its faces look out.
double volume_of(scene::detail::Solid const& solid) {
    double sum = 0.0;
    for (auto const& t : solid.triangles)
        sum += glm::dot(solid.points[t[0]], glm::cross(solid.points[t[1]], solid.points[t[2]]));
    return sum / 6.0;
}

}  // namespace

TEST_CASE("lofts face outwards and enclose the volume they should", "[scene][solids]") {
    namespace d = scene::detail;
    d::Solid box;
    d::add_box(box, {-1.0, 2.0, 3.0}, {1.0, 5.0, 7.0});
    CHECK(std::abs(volume_of(box) - 24.0) < 1e-12);
    d::Solid cone;
    std::array<d::Level, 2> const levels{{{1.0, 0.0}, {0.0, 3.0}}};
    d::add_lathe(cone, {4.0, 1.0, 0.0}, levels, 400);
    CHECK(std::abs(volume_of(cone) - 3.14159265) < 1e-3);
    d::Solid pipe;
    std::array<math::dvec3, 3> const line{{{0.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, {0.0, 4.0, 0.0}}};
    std::array<double, 3> const radii{0.5, 0.5, 0.5};
    d::add_tube(pipe, line, radii, 400);
    CHECK(std::abs(volume_of(pipe) - 3.14159265) < 1e-3);
    d::Arch const arch{{1.0, 2.0, 3.0}, 1.0, 2.0, 0.5, 400};
    d::Solid bow;
    d::add_arch(bow, arch);
    CHECK(std::abs(volume_of(bow) - 0.5 * 3.0 * 3.14159265 * 0.5) < 1e-3);
    d::Solid wall;
    d::add_spandrel(wall, arch, 2.5, 5.0);
    CHECK(std::abs(volume_of(wall) - 0.5 * (5.0 * 3.0 - 0.5 * 3.14159265)) < 1e-3);
}
