#include <gnomon/check/check.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/procedural.hpp>

#include <cmath>
#include <limits>
#include <vector>

using namespace gnomon;
using namespace gnomon::check;

namespace {

/// Materials: opaque, opaque double-sided, mask, blend. One mesh per material: a triangle in the xy plane that faces +z.
scene::Scene four_materials() {
    scene::Scene s;
    s.materials.resize(4);
    s.materials[1].double_sided = true;
    s.materials[2].alpha_mode = scene::AlphaMode::mask;
    s.materials[3].alpha_mode = scene::AlphaMode::blend;
    for (std::uint32_t m = 0; m < 4; ++m) {
        scene::Primitive p;
        p.positions = {{0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
        p.normals.assign(3, math::vec3(0.0F, 0.0F, 1.0F));
        p.indices = {0, 1, 2};
        p.material = m;
        s.meshes.push_back({"", {p}});
    }
    return s;
}

scene::Instance at(std::uint32_t mesh, math::dvec3 const& position, math::dvec3 const& scale = math::dvec3(1.0)) {
    scene::Instance i;
    i.mesh = mesh;
    for (int axis = 0; axis < 3; ++axis) {
        i.world_from_mesh[axis][axis] = scale[axis];
        i.world_from_mesh[3][axis] = position[axis];
    }
    return i;
}

}  // namespace

TEST_CASE("ranges and draws cover all triangles in order, grouped by alpha mode and sides", "[scene][flatten]") {
    scene::Scene s = four_materials();
    for (std::uint32_t const mesh : {3U, 0U, 2U, 1U, 0U, 3U, 2U}) s.instances.push_back(at(mesh, {0.0, 0.0, 0.0}));
    scene::Geometry const g = scene::flatten(s);
    REQUIRE(g.indices.size() == 7 * 3);
    REQUIRE(g.triangle_material.size() == 7);
    REQUIRE(g.triangle_instance.size() == 7);
    CHECK(g.triangle_material == std::vector<std::uint32_t>{0, 0, 1, 2, 2, 3, 3});
    CHECK(g.triangle_instance == std::vector<std::uint32_t>{1, 4, 3, 2, 6, 0, 5});
    std::uint32_t next = 0;
    for (scene::Range const& range : g.ranges) {
        CHECK(range.first_triangle == next);
        next += range.triangle_count;
        for (std::uint32_t t = range.first_triangle; t < next; ++t) {
            CHECK(g.triangle_material[t] == range.material);
            CHECK(g.triangle_instance[t] == range.instance);
        }
    }
    CHECK(next == 7);
    CHECK(g.draws == std::vector<scene::DrawRange>{{0, 2, scene::AlphaMode::opaque, false},
                                                   {2, 1, scene::AlphaMode::opaque, true},
                                                   {3, 2, scene::AlphaMode::mask, false},
                                                   {5, 2, scene::AlphaMode::blend, false}});
}

TEST_CASE("the origin is the scene's centre in whole steps, and what is near keeps its last bit", "[scene][flatten]") {
    scene::Scene s = four_materials();
    s.instances.push_back(at(0, {0.25, -3.0, 100.0}));
    CHECK(scene::flatten(s).origin_m == math::dvec3(0.0));
    double const tiny = 0x1p-14;
    s.instances[0] = at(0, {1e7 + tiny, -1e7, 5e6});
    scene::Geometry const g = scene::flatten(s);
    for (int axis = 0; axis < 3; ++axis) CHECK(std::fmod(g.origin_m[axis], scene::origin_step_m) == 0.0);
    CHECK(math::to_double(g.positions[0]) + g.origin_m == math::dvec3(1e7 + tiny, -1e7, 5e6));
    CHECK(scene::to_work_space(g, {1e7 + tiny, -1e7, 5e6}) == g.positions[0]);
    scene::Geometry const forced = scene::flatten(s, {math::dvec3(0.0)});
    CHECK(forced.origin_m == math::dvec3(0.0));
    CHECK(forced.positions[0].x == 1e7F);
}

TEST_CASE("a mirrored instance keeps its front faces and its normals' side", "[scene][flatten]") {
    scene::Scene s = four_materials();
    s.instances = {at(0, {0.0, 0.0, 0.0}, {-1.0, 1.0, 1.0}), at(0, {0.0, 0.0, 0.0}, {-2.0, -3.0, -4.0})};
    scene::Geometry const g = scene::flatten(s);
    for (std::size_t t = 0; t < 2; ++t) {
        math::vec3 const a = g.positions[g.indices[3 * t]];
        math::vec3 const n = glm::cross(g.positions[g.indices[3 * t + 1]] - a, g.positions[g.indices[3 * t + 2]] - a);
        CHECK(glm::dot(n, g.normals[g.indices[3 * t]]) > 0.0F);
    }
    CHECK(g.normals[0] == math::vec3(0.0F, 0.0F, 1.0F));
    CHECK(g.normals[3] == math::vec3(0.0F, 0.0F, -1.0F));
}

TEST_CASE("uneven scales turn normals as they turn planes", "[scene][flatten]") {
    scene::Scene s = four_materials();
    scene::Primitive& p = s.meshes[0].primitives[0];
    p.positions = {{1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, {0.0F, 0.0F, 1.0F}};
    p.normals.assign(3, glm::normalize(math::vec3(1.0F)));
    s.instances.push_back(at(0, {0.0, 0.0, 0.0}, {1.0, 10.0, 100.0}));
    scene::Geometry const g = scene::flatten(s);
    math::vec3 const face = glm::normalize(glm::cross(g.positions[1] - g.positions[0], g.positions[2] - g.positions[0]));
    CHECK(glm::dot(face, g.normals[0]) > 0.99999F);
}

TEST_CASE("flatten survives scenes of nothing and transforms to nothing", "[scene][flatten]") {
    CHECK(scene::flatten(scene::Scene{}).indices.empty());
    scene::Scene s = four_materials();
    CHECK(math::is_empty(scene::flatten(s).bounds));
    s.instances = {at(0, {1.0, 2.0, 3.0}, {0.0, 0.0, 0.0})};
    scene::Geometry const point = scene::flatten(s);
    CHECK(point.indices.size() == 3);
    for (math::vec3 const& n : point.normals) CHECK(glm::length(n) == Approx(1.0F));
    s.instances = {at(0, {0.0, 0.0, 0.0}), at(0, {1e300, 0.0, 0.0})};
    scene::Geometry const far = scene::flatten(s, {math::dvec3(0.0)});
    CHECK(far.indices.size() == 3);
    CHECK(far.non_finite_triangles == 1);
    CHECK(math::is_finite(far.bounds.hi));
}

TEST_CASE("bounds hold every corner, and instances that touch share the corner's float", "[scene][flatten]") {
    for_all(cases(200), integers(-1000000, 1000000), integers(-1000000, 1000000), [](int x, int z) {
        scene::Scene s = four_materials();
        // Corner (1, 0, 0) of the first is corner (0, 0, 0) of the second.
        s.instances = {at(0, {x * 0.5, 0.0, z * 0.25}), at(1, {x * 0.5 + 1.0, 0.0, z * 0.25})};
        scene::Geometry const g = scene::flatten(s);
        CHECK(g.positions[1] == g.positions[3]);
        for (math::vec3 const& p : g.positions) CHECK(math::contains(g.bounds, p));
    });
}
