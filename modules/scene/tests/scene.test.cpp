#include <gnomon/check/check.hpp>
#include <gnomon/scene/procedural.hpp>
#include <gnomon/scene/scene.hpp>

#include <cmath>
#include <string>

using namespace gnomon;

namespace {

scene::Scene small() {
    scene::Scene s;
    s.materials.emplace_back();
    scene::Primitive p;
    p.positions = {{0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
    p.normals.assign(3, math::vec3(0.0F, 0.0F, 1.0F));
    p.indices = {0, 1, 2};
    p.material = 0;
    s.meshes.push_back({"", {p}});
    s.instances.push_back({"", 0, math::dmat4(1.0)});
    s.images.push_back({"", {1, 1}, {0, 0, 0, 0}});
    s.textures.push_back({0, math::Wrap::repeat, math::Wrap::repeat, false});
    s.cameras.emplace_back();
    s.lights.emplace_back();
    return s;
}

template <class Change>
void breaks(Change change, std::string const& says) {
    scene::Scene s = small();
    change(s);
    auto const result = scene::validate(s);
    CAPTURE(says);
    REQUIRE_FALSE(result.has_value());
    CAPTURE(result.failure().message);
    CHECK(result.failure().message.find(says) != std::string::npos);
    CHECK(result.failure().message.find(';') != std::string::npos);
}

}  // namespace

TEST_CASE("validate accepts a whole scene and names what is broken in any other", "[scene]") {
    float const nan = std::nanf("");
    CHECK(scene::validate(small()).has_value());
    CHECK(scene::validate(scene::Scene{}).has_value());
    breaks([](scene::Scene& s) { s.meshes[0].primitives[0].indices[2] = 3; }, "index 3");
    breaks([](scene::Scene& s) { s.meshes[0].primitives[0].indices.pop_back(); }, "2 indices");
    breaks([](scene::Scene& s) { s.meshes[0].primitives[0].normals.pop_back(); }, "2 normals");
    breaks([](scene::Scene& s) { s.meshes[0].primitives[0].uv0.resize(2); }, "texture coordinates");
    breaks([](scene::Scene& s) { s.meshes[0].primitives[0].material = scene::none; }, "material 4294967295");
    breaks([=](scene::Scene& s) { s.meshes[0].primitives[0].positions[1].y = nan; }, "NaN");
    breaks([](scene::Scene& s) { s.instances[0].mesh = 1; }, "mesh 1");
    breaks([](scene::Scene& s) { s.instances[0].world_from_mesh[3][1] = std::nan(""); }, "matrix");
    breaks([](scene::Scene& s) { s.textures[0].image = 1; }, "image 1");
    breaks([](scene::Scene& s) { s.images[0].rgba.pop_back(); }, "3 bytes");
    breaks([](scene::Scene& s) { s.images[0].size_px = {0, 4}; }, "0x4");
    breaks([](scene::Scene& s) { s.materials[0].base_color_texture.texture = 1; }, "texture 1");
    breaks([](scene::Scene& s) { s.materials[0].base_color_texture.uv_set = 2; }, "set 2");
    breaks([=](scene::Scene& s) { s.materials[0].roughness = nan; }, "material 0");
    breaks([](scene::Scene& s) { s.cameras[0].near_m = 0.0; }, "camera 0");
    breaks([](scene::Scene& s) { s.cameras[0].far_m = 0.05; }, "camera 0");
    breaks([](scene::Scene& s) { s.cameras[0].back = math::dvec3(0.0); }, "camera 0");
    breaks([](scene::Scene& s) { s.lights[0].direction = math::dvec3(0.0); }, "light 0");
    breaks([](scene::Scene& s) { s.lights[0].range_m = 0.0F; }, "light 0");
}

TEST_CASE("triangles are counted as drawn and as stored", "[scene]") {
    scene::Scene s = small();
    s.instances.push_back(s.instances[0]);
    CHECK(scene::count_triangles(s) == 2);
    CHECK(scene::count_unique_triangles(s) == 1);
}

TEST_CASE("looking_at gives an upright orthonormal frame, straight down too", "[scene]") {
    for (math::dvec3 const target : {math::dvec3(3.0, -2.0, 5.0), math::dvec3(0.0, -1.0, 0.0), math::dvec3(0.0, 4.0, 0.0), math::dvec3(1e-3, 0.0, 0.0)}) {
        scene::Camera const c = scene::looking_at("c", math::dvec3(0.0), target, 1.0);
        CHECK(glm::dot(-c.back, glm::normalize(target)) == Approx(1.0));
        CHECK(glm::dot(c.right, c.back) == Approx(0.0).margin(1e-12));
        CHECK(glm::length(c.up) == Approx(1.0));
        CHECK(c.up.y >= -1e-12);
        math::dvec3 const cross = glm::cross(c.right, c.up);
        CHECK(glm::dot(cross, c.back) == Approx(1.0));
    }
}
