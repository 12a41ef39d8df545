#include "gltf_fixture.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/scene/load.hpp>
#include <gnomon/scene/procedural.hpp>
#include <gnomon/scene/write.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace gnomon;
using namespace gnomon::check;
using namespace fixture;

namespace {

void comes_back_equal(scene::Scene const& s) {
    TemporaryFolder const folder;
    for (std::string const name : {"a.gltf", "a.glb"}) {
        CAPTURE(name);
        auto const written = scene::write_gltf(s, folder / name);
        CAPTURE(written ? std::string() : written.failure().message);
        REQUIRE(written.has_value());
        auto const read = scene::load_gltf(folder / name);
        CAPTURE(read ? std::string() : read.failure().message);
        REQUIRE(read.has_value());
        CHECK(*read == s);
    }
    CHECK(folder.file_count() == 2);
}

void add_surfaces(scene::Scene& s) {
    s.images.push_back({"dots", {3, 2}, {}});
    for (int i = 0; i < 24; ++i) s.images[0].rgba.push_back(static_cast<std::uint8_t>(i * 11));
    s.images.push_back({"", {1, 1}, {1, 2, 3, 4}});
    s.textures = {{0, math::Wrap::clamp, math::Wrap::mirror, true}, {0, math::Wrap::repeat, math::Wrap::repeat, false}, {1, math::Wrap::repeat, math::Wrap::repeat, false}};
    for (std::uint32_t t = 0; t < 3; ++t) {
        scene::Material m;
        m.name = "material " + std::to_string(t);
        m.base_color = {0.1F, 1.0F / 3.0F, 1e-20F, 0.7F};
        m.base_color_texture.texture = t;
        m.base_color_texture.uv_set = t % 2;
        m.alpha_mode = static_cast<scene::AlphaMode>(t);
        m.alpha_cutoff = 0.3F;
        m.double_sided = t == 1;
        m.emissive = {0.0F, 3.5F, 1e30F};
        s.materials.push_back(m);
    }
    s.materials[1].base_color_texture.offset = {0.1F, -3e9F};
    s.materials[1].base_color_texture.scale = {7.0F, 0.3F};
    s.materials[1].base_color_texture.rotation_rad = 0.7F;
}

void add_meshes(scene::Scene& s) {
    for (std::uint32_t m = 0; m < 3; ++m) {
        scene::Primitive p;
        p.positions = {{0.0F, -0.0F, 1e-45F}, {1.0F, 0.1F, 0.0F}, {3e38F, 1.0F, 1e-10F}, {0.3F, 0.7F, 16777217.0F}};
        p.normals = {{0.0F, 0.0F, 1.0F}, {0.6F, 0.8F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, -1.0F, 0.0F}};
        p.uv0 = {{0.0F, 0.0F}, {1.0F, 0.1F}, {-5.5F, 1e6F}, {0.3F, 0.7F}};
        if (m == 1) p.uv1 = p.uv0;
        p.indices = {0, 1, 2, 2, 1, 3};
        p.material = m;
        s.meshes.push_back({"mesh", {p, p}});
    }
    for (std::uint32_t i = 0; i < 4; ++i) {
        scene::Instance instance;
        instance.name = "instance";
        instance.mesh = i % 3;
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 3; ++r) instance.world_from_mesh[c][r] = std::sin(i * 12.0 + c * 4.0 + r) * std::pow(10.0, r * 4 - 2);
        s.instances.push_back(instance);
    }
}

void add_cameras_and_lights(scene::Scene& s) {
    s.cameras.push_back(scene::looking_at("p", {1e7 + 0.1, 2.0, 3.0}, {1e7, 0.3, -0.7}, 0.9));
    s.cameras.push_back(scene::looking_at("o", {0.0, 10.0, 0.0}, {0.0, 0.0, 0.0}, 0.9));
    s.cameras[1].kind = scene::CameraKind::orthographic;
    s.cameras[1].fov_y_rad = scene::Camera{}.fov_y_rad;
    s.cameras[1].far_m = 123.456;
    s.cameras[1].near_m = 0.0;
    s.cameras[1].half_width_m = 0.1;
    for (int kind = 0; kind < 3; ++kind) {
        scene::Light l;
        l.name = "light";
        l.kind = static_cast<scene::LightKind>(kind);
        l.position_m = {0.1, -1e7, 3.0};
        l.direction = glm::normalize(math::dvec3(0.3, -0.9, 0.1));
        l.color = {0.1F, 0.2F, 0.3F};
        l.intensity = 54351.4F;
        if (kind == 1) l.range_m = 12.3F;
        if (kind == 2) l.inner_cone_rad = 0.1F;
        s.lights.push_back(l);
    }
}

/// A scene with something of everything, and numbers that are hard to print.
scene::Scene everything() {
    scene::Scene s;
    s.name = "every \"thing\" \\ \n \xC3\xBC";
    add_surfaces(s);
    add_meshes(s);
    add_cameras_and_lights(s);
    return s;
}

}  // namespace

TEST_CASE("every procedural scene comes back equal from the file it is written to", "[scene][write]") {
    for (scene::ProceduralInfo const& info : scene::procedural_scenes()) {
        if (info.default_triangles > 300'000) continue;  // the same parts, only more of them
        CAPTURE(std::string(info.name));
        auto const s = scene::make_procedural({std::string(info.name), 0, 1, 0.0, 0});
        REQUIRE(s.has_value());
        comes_back_equal(*s);
    }
    auto const far = scene::make_procedural({"sheet", 0, 1, 131072.0, 0});
    REQUIRE(far.has_value());
    comes_back_equal(*far);
}

TEST_CASE("a scene with something of everything comes back equal", "[scene][write]") {
    scene::Scene const s = everything();
    auto const valid = scene::validate(s);
    CAPTURE(valid ? std::string() : valid.failure().message);
    REQUIRE(valid.has_value());
    comes_back_equal(s);
}

TEST_CASE("any finite number comes back to the last bit", "[scene][write][property]") {
    TemporaryFolder const folder;
    for_all(cases(200), integers(-1000000000, 1000000000), integers(-300, 300), [&](int digits, int exponent) {
        scene::Scene s = everything();
        double const number = static_cast<double>(digits) / 3.0 * std::pow(10.0, exponent * 0.5);
        s.instances[0].world_from_mesh[3][0] = number;
        s.cameras[0].eye_m.y = number;
        s.lights[2].position_m.z = -number;
        float const small = static_cast<float>(std::fmod(number, 1e6));
        s.materials[1].base_color_texture.offset.x = small;
        s.materials[0].base_color.y = small;
        REQUIRE(scene::write_gltf(s, folder / "a.glb").has_value());
        auto const read = scene::load_gltf(folder / "a.glb");
        REQUIRE(read.has_value());
        CHECK(*read == s);
    });
}

TEST_CASE("what cannot be written leaves nothing behind", "[scene][write]") {
    TemporaryFolder const folder;
    scene::Scene const s = everything();
    auto const refused = [&](scene::Scene const& bad, std::string const& path, scene::SceneError code) {
        auto const result = scene::write_gltf(bad, path);
        CAPTURE(path);
        REQUIRE_FALSE(result.has_value());
        CAPTURE(result.failure().message);
        CHECK(result.failure().code == code);
        CHECK(result.failure().message.find(';') != std::string::npos);
    };
    refused(s, folder / "a.obj", scene::SceneError::bad_config);
    refused(s, folder / "no/such/folder/a.glb", scene::SceneError::not_writable);
    std::filesystem::create_directory(folder / "b.glb");
    refused(s, folder / "b.glb", scene::SceneError::not_writable);
    scene::Scene bad = s;
    bad.meshes[0].primitives[0].indices[0] = 4;
    refused(bad, folder / "a.glb", scene::SceneError::malformed);
    bad = s;
    bad.lights[0].intensity = std::numeric_limits<float>::infinity();
    refused(bad, folder / "a.glb", scene::SceneError::malformed);
    CHECK(folder.file_count() == 1);
    CHECK_FALSE(scene::write_gltf(s, "/dev/full/a.glb").has_value());
}

TEST_CASE("a file is replaced only by a whole one", "[scene][write]") {
    TemporaryFolder const folder;
    REQUIRE(scene::write_gltf(everything(), folder / "a.glb").has_value());
    scene::Scene bad = everything();
    bad.instances[0].world_from_mesh[3][0] = std::nan("");
    CHECK_FALSE(scene::write_gltf(bad, folder / "a.glb").has_value());
    auto const read = scene::load_gltf(folder / "a.glb");
    REQUIRE(read.has_value());
    CHECK(*read == everything());
}
