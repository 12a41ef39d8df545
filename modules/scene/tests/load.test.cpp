#include "gltf_fixture.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/scene/flatten.hpp>
#include <gnomon/scene/load.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <string>

using namespace gnomon;
using namespace fixture;

namespace {

scene::Scene loaded(std::vector<std::byte> const& file, scene::LoadConfig const& config = {}) {
    auto result = load(file, config);
    if (!result) INFO(result.failure().message);
    CAPTURE(result ? std::string() : result.failure().message);
    REQUIRE(result.has_value());
    REQUIRE(scene::validate(*result).has_value());
    return std::move(result).value();
}

scene::Scene changed(std::string_view from, std::string_view to) {
    return loaded(glb(replaced(triangle_json(), from, to), triangle_blob().bytes()));
}

scene::Primitive const& only_primitive(scene::Scene const& s) {
    REQUIRE(s.meshes.size() == 1);
    REQUIRE(s.meshes[0].primitives.size() == 1);
    return s.meshes[0].primitives[0];
}

bool close(math::vec3 const& a, math::vec3 const& b, float tolerance = 1e-6F) {
    return std::abs(a.x - b.x) <= tolerance && std::abs(a.y - b.y) <= tolerance && std::abs(a.z - b.z) <= tolerance;
}

/// Twice the signed area of a triangle in the xy plane: above 0 if it is counter-clockwise seen from +z.
float turn_of(scene::Geometry const& g, std::size_t triangle) {
    math::vec3 const a = g.positions[g.indices[triangle * 3]];
    math::vec3 const b = g.positions[g.indices[triangle * 3 + 1]];
    math::vec3 const c = g.positions[g.indices[triangle * 3 + 2]];
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

constexpr char const* position_and_nothing = R"({"attributes":{"POSITION":0}})";

}  // namespace

TEST_CASE("a GLB with one triangle is read as it stands", "[scene][load]") {
    scene::Scene const s = loaded(glb(triangle_json(), triangle_blob().bytes()));
    CHECK(s.name == "s");
    REQUIRE(s.instances.size() == 1);
    CHECK(s.instances[0].name == "n");
    CHECK(s.instances[0].world_from_mesh[3] == math::dvec4(1.0, 2.0, 3.0, 1.0));
    scene::Primitive const& p = only_primitive(s);
    CHECK(p.positions == std::vector<math::vec3>{{0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}});
    CHECK(p.normals == std::vector<math::vec3>(3, math::vec3(0.0F, 0.0F, 1.0F)));
    CHECK(p.uv0 == std::vector<math::vec2>{{0.0F, 0.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}});
    CHECK(p.uv1.empty());
    CHECK(p.indices == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(s.materials[p.material].name == "paint");
    CHECK(s.notes == scene::Notes{});
}

TEST_CASE("a .gltf takes its buffer from a data URI or a file beside or below it", "[scene][load]") {
    TemporaryFolder const folder;
    folder.save("sub folder/mesh.bin", triangle_blob().bytes());
    folder.save("a.gltf", text(replaced(triangle_json(), R"("byteLength":104)", R"("byteLength":104,"uri":"sub%20folder/mesh.bin")")));
    auto const a = scene::load_gltf(folder / "a.gltf");
    REQUIRE(a.has_value());
    CHECK(scene::count_triangles(*a) == 1);
    // Three corners, no indices: 36 bytes as base64.
    std::string const uri =
        R"("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA")";
    std::string const json = R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
                             R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
                             R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":)" +
                             uri + "}]}";
    scene::Scene const b = loaded(text(json));
    CHECK(only_primitive(b).positions[1] == math::vec3(1.0F, 0.0F, 0.0F));
    CHECK(only_primitive(b).normals[0] == math::vec3(0.0F, 0.0F, 1.0F));
}

TEST_CASE("every component type is converted as glTF defines it", "[scene][load]") {
    struct Row {
        char const* name;
        int type;
        bool normalized;
        Blob blob;  // three corners, 4 components apart
        math::vec3 first;
    };
    auto const i8 = [](int v) { return static_cast<std::int8_t>(v); };
    auto const i16 = [](int v) { return static_cast<std::int16_t>(v); };
    std::vector<Row> rows;
    Blob b;
    rows.push_back({"byte", 5120, false, Blob(b).add(i8(-128), i8(127), i8(3), i8(0), i8(9), i8(0), i8(0), i8(0), i8(0), i8(9), i8(1), i8(0)), {-128.0F, 127.0F, 3.0F}});
    rows.push_back({"byte normalized", 5120, true, Blob(b).add(i8(-128), i8(127), i8(0), i8(0), i8(9), i8(0), i8(0), i8(0), i8(0), i8(9), i8(1), i8(0)), {-1.0F, 1.0F, 0.0F}});
    rows.push_back({"ubyte normalized", 5121, true, Blob(b).add(std::uint32_t{0x00'33'FF'00}, std::uint32_t{0x00'00'00'FF}, std::uint32_t{0xFF00}), {0.0F, 1.0F, 0.2F}});
    rows.push_back({"short", 5122, false, Blob(b).add(i16(-32768), i16(7), i16(0), i16(0), i16(9), i16(0), i16(0), i16(0), i16(0), i16(9), i16(1), i16(0)), {-32768.0F, 7.0F, 0.0F}});
    rows.push_back({"short normalized", 5122, true, Blob(b).add(i16(-32768), i16(32767), i16(0), i16(0), i16(9), i16(0), i16(0), i16(0), i16(0), i16(9), i16(1), i16(0)), {-1.0F, 1.0F, 0.0F}});
    rows.push_back({"ushort normalized", 5123, true, Blob(b).add(std::uint32_t{0xFFFF'0000}, std::uint32_t{0}, std::uint32_t{0xFFFF}, std::uint32_t{0}, std::uint32_t{0}, std::uint32_t{0x3333}), {0.0F, 1.0F, 0.0F}});
    rows.push_back({"uint", 5125, false, Blob(b).add(4000000000U, 1U, 2U, 0U, 9U, 0U, 0U, 0U, 0U, 9U, 1U, 0U), {4000000000.0F, 1.0F, 2.0F}});
    for (Row const& row : rows) {
        CAPTURE(std::string(row.name));
        std::size_t const stride = row.blob.size() / 3;
        scene::Scene const s = loaded(one_primitive(position_and_nothing,
            R"({"bufferView":0,"count":3,"type":"VEC3","componentType":)" + std::to_string(row.type) + R"(,"normalized":)" + (row.normalized ? "true" : "false") + "}",
            R"({"buffer":0,"byteStride":)" + std::to_string(stride) + R"(,"byteLength":)" + std::to_string(row.blob.size()) + "}", row.blob));
        CHECK(close(only_primitive(s).positions[0], row.first));
    }
}

TEST_CASE("indices may be of each unsigned type", "[scene][load]") {
    for (int const type : {5121, 5123, 5125}) {
        Blob blob;
        blob.add(0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F);
        if (type == 5121) blob.add(std::uint8_t{2}, std::uint8_t{0}, std::uint8_t{1});
        if (type == 5123) blob.add(std::uint16_t{2}, std::uint16_t{0}, std::uint16_t{1});
        if (type == 5125) blob.add(2U, 0U, 1U);
        scene::Scene const s = loaded(one_primitive(R"({"attributes":{"POSITION":0},"indices":1})",
            R"({"bufferView":0,"count":3,"type":"VEC3","componentType":5126},{"bufferView":1,"count":3,"type":"SCALAR","componentType":)" + std::to_string(type) + "}",
            R"({"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":)" + std::to_string(blob.size() - 36) + "}", blob));
        CHECK(only_primitive(s).positions[0] == math::vec3(0.0F, 1.0F, 0.0F));
    }
}

TEST_CASE("interleaved attributes are read with their stride", "[scene][load]") {
    Blob blob;
    for (float const x : {0.0F, 1.0F, 2.0F}) blob.add(x, x * x, 5.0F, 0.0F, 0.0F, 1.0F);
    scene::Scene const s = loaded(one_primitive(R"({"attributes":{"POSITION":0,"NORMAL":1}})",
        R"({"bufferView":0,"count":3,"type":"VEC3","componentType":5126},{"bufferView":0,"byteOffset":12,"count":3,"type":"VEC3","componentType":5126})",
        R"({"buffer":0,"byteStride":24,"byteLength":72})", blob));
    CHECK(only_primitive(s).positions[2] == math::vec3(2.0F, 4.0F, 5.0F));
    CHECK(only_primitive(s).normals[2] == math::vec3(0.0F, 0.0F, 1.0F));
}

TEST_CASE("sparse accessors replace elements, over bytes or over zeros", "[scene][load]") {
    Blob blob;
    blob.add(0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F);  // 36
    blob.add(std::uint16_t{1}, std::uint16_t{2});                    // 36: indices
    blob.add(7.0F, 0.0F, 0.0F, 0.0F, 8.0F, 0.0F);                    // 40: values
    std::string const sparse = R"("count":3,"type":"VEC3","componentType":5126,"sparse":{"count":2,"indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":2}}})";
    std::string const views = R"({"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":4},{"buffer":0,"byteOffset":40,"byteLength":24})";
    scene::Scene const over = loaded(one_primitive(position_and_nothing, R"({"bufferView":0,)" + sparse, views, blob));
    CHECK(only_primitive(over).positions == std::vector<math::vec3>{{0.0F, 0.0F, 0.0F}, {7.0F, 0.0F, 0.0F}, {0.0F, 8.0F, 0.0F}});
    scene::Scene const alone = loaded(one_primitive(position_and_nothing, "{" + sparse, views, blob));
    CHECK(only_primitive(alone).positions == only_primitive(over).positions);
}

TEST_CASE("strips and fans become triangles that all face the same way", "[scene][load]") {
    Blob strip;
    for (int i = 0; i < 7; ++i) strip.add(static_cast<float>(i / 2), static_cast<float>(i % 2 == 0 ? 1 : 0), 0.0F);
    Blob fan;
    fan.add(0.0F, 0.0F, 0.0F);
    for (int i = 0; i < 6; ++i) fan.add(static_cast<float>(std::cos(0.5 * i)), static_cast<float>(std::sin(0.5 * i)), 0.0F);
    auto const file = [](int mode, Blob const& blob) {
        return one_primitive(R"({"attributes":{"POSITION":0},"mode":)" + std::to_string(mode) + "}",
                             R"({"bufferView":0,"count":7,"type":"VEC3","componentType":5126})", R"({"buffer":0,"byteLength":84})", blob);
    };
    for (auto const& bytes : {file(5, strip), file(6, fan)}) {
        scene::Geometry const g = scene::flatten(loaded(bytes));
        REQUIRE(g.indices.size() == 5 * 3);
        for (std::size_t t = 0; t < 5; ++t) CHECK(turn_of(g, t) > 0.0F);
    }
    scene::Geometry const list = scene::flatten(loaded(file(4, fan)));
    CHECK(list.indices.size() == 2 * 3);
}

TEST_CASE("points and lines are left out and counted", "[scene][load]") {
    std::string const two = R"("indices":3,"material":0},{"attributes":{"POSITION":0},"mode":1},{"attributes":{"POSITION":0},"mode":0})";
    scene::Scene const s = changed(R"("indices":3,"material":0})", two);
    CHECK(s.notes.points_and_lines == 2);
    CHECK(scene::count_triangles(s) == 1);
}

TEST_CASE("triangles with a corner that is not finite are left out and counted", "[scene][load]") {
    for (float const value : {std::nanf(""), std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()}) {
        Blob blob;
        blob.add(0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 2.0F, value, 0.0F);
        blob.add(std::uint16_t{0}, std::uint16_t{1}, std::uint16_t{2}, std::uint16_t{1}, std::uint16_t{3}, std::uint16_t{2});
        scene::Scene const s = loaded(one_primitive(R"({"attributes":{"POSITION":0},"indices":1})",
            R"({"bufferView":0,"count":4,"type":"VEC3","componentType":5126},{"bufferView":1,"count":6,"type":"SCALAR","componentType":5123})",
            R"({"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12})", blob));
        CHECK(s.notes.non_finite_triangles == 1);
        CHECK(scene::count_triangles(s) == 1);
    }
}

TEST_CASE("normals of zero or NaN are mended with the triangle's own and counted; long ones get length 1", "[scene][load]") {
    Blob blob = triangle_blob();
    Blob bad;
    bad.add(0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F).add(0.0F, 0.0F, 0.0F, std::nanf(""), 0.0F, 1.0F, 0.0F, 5.0F, 0.0F);
    std::vector<std::byte> bytes = blob.bytes();
    std::copy(bad.bytes().begin(), bad.bytes().end(), bytes.begin());
    scene::Scene const s = loaded(glb(triangle_json(), bytes));
    CHECK(s.notes.mended_normals == 2);
    CHECK(only_primitive(s).normals == std::vector<math::vec3>{{0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, 1.0F}, {0.0F, 1.0F, 0.0F}});
}

TEST_CASE("node hierarchies multiply out in double", "[scene][load]") {
    scene::Scene const s = changed(R"("nodes":[{"name":"n","mesh":0,"translation":[1,2,3]}])",
        R"("nodes":[{"translation":[10000000,0,0.015625],"children":[1]},{"scale":[2,2,2],"children":[2]},{"name":"n","mesh":0,"rotation":[0,0,0.70710678118654757,0.70710678118654757],"translation":[0.0009765625,0,0]}])");
    REQUIRE(s.instances.size() == 1);
    math::dmat4 const& m = s.instances[0].world_from_mesh;
    CHECK(m[3] == math::dvec4(10000000.001953125, 0.0, 0.015625, 1.0));
    CHECK(m[0][1] == Approx(2.0));
    CHECK(m[1][0] == Approx(-2.0));
    scene::Geometry const g = scene::flatten(s);
    CHECK(g.origin_m.x == 10'000'384.0);  // 9766 * 1024
    CHECK(g.positions[g.indices[0]].x == static_cast<float>(10000000.001953125 - 10'000'384.0));
}

TEST_CASE("a matrix is column-major, and its last row is taken as 0 0 0 1", "[scene][load]") {
    scene::Scene const s = changed(R"("translation":[1,2,3])", R"("matrix":[0,1,0,0, -1,0,0,0, 0,0,1,0, 5,6,7,1])");
    math::dmat4 const& m = s.instances[0].world_from_mesh;
    CHECK(m[0] == math::dvec4(0.0, 1.0, 0.0, 0.0));
    CHECK(m[3] == math::dvec4(5.0, 6.0, 7.0, 1.0));
}

TEST_CASE("one mesh may stand in many places", "[scene][load]") {
    scene::Scene const s = changed(R"("scenes":[{"name":"s","nodes":[0]}],"nodes":[)", R"("scenes":[{"name":"s","nodes":[0,1]}],"nodes":[{"mesh":0,"scale":[-1,1,1]},)");
    CHECK(s.meshes.size() == 1);
    CHECK(s.instances.size() == 2);
    scene::Geometry const g = scene::flatten(s);
    REQUIRE(g.indices.size() == 6);
    CHECK(turn_of(g, 0) > 0.0F);  // mirrored, and still a front face from +z
    CHECK(turn_of(g, 1) > 0.0F);
    CHECK(g.normals[g.indices[0]] == math::vec3(0.0F, 0.0F, 1.0F));
}

TEST_CASE("EXT_mesh_gpu_instancing multiplies a node", "[scene][load]") {
    Blob blob;
    blob.add(0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F).add(10.0F, 0.0F, 0.0F, 0.0F, 20.0F, 0.0F);
    std::string json = R"({"asset":{"version":"2.0"},"extensionsRequired":["EXT_mesh_gpu_instancing"],"nodes":[{"mesh":0,"translation":[0,0,1],"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":1}}}}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"count":3,"type":"VEC3","componentType":5126},{"bufferView":1,"count":2,"type":"VEC3","componentType":5126}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24}],"buffers":[{"byteLength":60}]})";
    scene::Scene const s = loaded(glb(json, blob.bytes()));
    REQUIRE(s.instances.size() == 2);
    CHECK(s.instances[1].world_from_mesh[3] == math::dvec4(0.0, 20.0, 1.0, 1.0));
}

TEST_CASE("the default scene is read, or the one that is asked for, or all roots", "[scene][load]") {
    std::string const two = replaced(triangle_json(), R"("scenes":[{"name":"s","nodes":[0]}],"nodes":[)",
                                     R"("scenes":[{"name":"s","nodes":[0]},{"name":"t","nodes":[0,1]}],"nodes":[{"mesh":0},)");
    auto const file = [&](std::string const& json) { return glb(json, triangle_blob().bytes()); };
    CHECK(loaded(file(two)).instances.size() == 1);
    CHECK(loaded(file(replaced(two, R"("scene":0)", R"("scene":1)"))).instances.size() == 2);
    scene::LoadConfig config;
    config.scene_index = 1;
    CHECK(loaded(file(two), config).name == "t");
    CHECK(loaded(file(replaced(replaced(two, R"("scene":0,)", ""), R"("scenes")", R"("ignored")"))).instances.size() == 2);
    config.scene_index = 2;
    auto const none = load(file(two), config);
    REQUIRE_FALSE(none.has_value());
    CHECK(none.failure().code == scene::SceneError::bad_config);
}

TEST_CASE("materials keep colour, alpha, sides and the texture's transform", "[scene][load]") {
    std::string json = replaced(triangle_json(), R"({"name":"paint"})",
        R"({"name":"leaf","alphaMode":"MASK","alphaCutoff":0.25,"doubleSided":true,"emissiveFactor":[0.5,0,0],"pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.4],"metallicFactor":0,"roughnessFactor":0.5,)"
        R"("baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"offset":[0.5,2],"scale":[2,3],"rotation":1.5707963267948966}}}}})");
    json = replaced(json, R"("accessors")", R"("textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":33071,"wrapT":33648,"magFilter":9728}],"images":[{"name":"i","uri":"nowhere.png"}],"accessors")");
    scene::Scene const s = loaded(glb(json, triangle_blob().bytes()));
    scene::Material const& m = s.materials[0];
    CHECK(m.alpha_mode == scene::AlphaMode::mask);
    CHECK(m.alpha_cutoff == 0.25F);
    CHECK(m.double_sided);
    CHECK(m.base_color == math::vec4(0.1F, 0.2F, 0.3F, 0.4F));
    CHECK(m.emissive == math::vec3(0.5F, 0.0F, 0.0F));
    CHECK(m.metallic == 0.0F);
    REQUIRE(s.textures.size() == 1);
    CHECK(s.textures[0] == scene::Texture{0, math::Wrap::clamp, math::Wrap::mirror, true});
    // The missing image costs the picture, not the scene.
    CHECK(s.notes.failed_images == 1);
    CHECK(s.images[0].rgba == std::vector<std::uint8_t>(4, 255));
    // uv (1, 0): scaled (2, 0), turned a quarter counter-clockwise as seen (v points down): (0, -2), moved.
    scene::Geometry const g = scene::flatten(s);
    CHECK(g.uv[1].x == Approx(0.5F));
    CHECK(g.uv[1].y == Approx(0.0F).margin(1e-6));
    REQUIRE(g.draws.size() == 1);
    CHECK(g.draws[0] == scene::DrawRange{0, 1, scene::AlphaMode::mask, true});
}

TEST_CASE("a 2x2 PNG is decoded", "[scene][load]") {
    std::string json = replaced(triangle_json(), R"({"name":"paint"})", R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
    std::string const png =
        "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAFklEQVR4nGP4z8DwHwgbGEA0l4icBgA2qQThZgcFSQAAAABJRU5ErkJggg==";
    json = replaced(json, R"("accessors")", R"("textures":[{"source":0}],"images":[{"uri":"data:image/png;base64,)" + png + R"("}],"accessors")");
    scene::Scene const s = loaded(glb(json, triangle_blob().bytes()));
    for (std::string const& warning : s.notes.warnings) UNSCOPED_INFO(warning);
    CHECK(s.notes.failed_images == 0);
    REQUIRE(s.images.size() == 1);
    CHECK(s.images[0].size_px == math::ivec2(2, 2));
    CHECK(s.images[0].rgba == std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 128, 0, 0, 255, 0, 10, 20, 30, 40});
}

TEST_CASE("cameras and lights stand where their nodes put them", "[scene][load]") {
    std::string json = replaced(triangle_json(), R"("nodes":[{"name":"n")",
        R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","color":[1,0.5,0],"intensity":40,"range":7,"spot":{"innerConeAngle":0.1,"outerConeAngle":0.2}},{"type":"point"},{"type":"directional","name":"sun"}]}},)"
        R"("cameras":[{"type":"perspective","name":"p","perspective":{"yfov":1,"znear":0.5}},{"type":"orthographic","orthographic":{"xmag":2,"ymag":3,"znear":0,"zfar":9}},{"type":"perspective","perspective":{"yfov":0,"znear":0}}],)"
        R"("nodes":[{"children":[1,2,3,4,5,6],"translation":[100,0,0]},{"camera":0,"rotation":[0,0.70710678118654757,0,0.70710678118654757],"scale":[3,3,3]},{"camera":1},{"extensions":{"KHR_lights_punctual":{"light":0}},"rotation":[-0.70710678118654757,0,0,0.70710678118654757]},{"extensions":{"KHR_lights_punctual":{"light":1}}},{"extensions":{"KHR_lights_punctual":{"light":2}}},{"name":"n")");
    json = replaced(json, R"(},{"name":"n")", R"(},{"camera":2},{"name":"n")");
    json = replaced(json, "[1,2,3,4,5,6]", "[1,2,3,4,5,6,7]");
    scene::Scene const s = loaded(glb(json, triangle_blob().bytes()));
    REQUIRE(s.cameras.size() == 2);  // the third has no lens
    CHECK(s.notes.warnings.size() == 1);
    CHECK(s.cameras[0].name == "p");
    CHECK(s.cameras[0].eye_m == math::dvec3(100.0, 0.0, 0.0));
    CHECK(s.cameras[0].back.x == Approx(1.0));
    CHECK(std::isinf(s.cameras[0].far_m));
    CHECK(s.cameras[1].kind == scene::CameraKind::orthographic);
    CHECK(s.cameras[1].half_height_m == 3.0);
    REQUIRE(s.lights.size() == 3);
    CHECK(s.lights[0].kind == scene::LightKind::spot);
    CHECK(s.lights[0].direction.y == Approx(-1.0));
    CHECK(s.lights[0].range_m == 7.0F);
    CHECK(s.lights[0].outer_cone_rad == 0.2F);
    CHECK(s.lights[1].kind == scene::LightKind::point);
    CHECK(std::isinf(s.lights[1].range_m));
    CHECK(s.lights[2].name == "sun");
    CHECK(s.lights[2].direction == math::dvec3(0.0, 0.0, -1.0));
}

TEST_CASE("a primitive keeps only its own part of a long shared vertex array", "[scene][load]") {
    Blob blob;
    for (int i = 0; i < 100; ++i) blob.add(static_cast<float>(i), static_cast<float>(i * i), 0.0F);
    for (int i = 0; i < 100; ++i) blob.add(0.0F, 0.0F, 1.0F);
    blob.add(std::uint16_t{90}, std::uint16_t{10}, std::uint16_t{50});
    scene::Scene const s = loaded(one_primitive(R"({"attributes":{"POSITION":0,"NORMAL":1},"indices":2})",
        R"({"bufferView":0,"count":100,"type":"VEC3","componentType":5126},{"bufferView":1,"count":100,"type":"VEC3","componentType":5126},{"bufferView":2,"count":3,"type":"SCALAR","componentType":5123})",
        R"({"buffer":0,"byteLength":1200},{"buffer":0,"byteOffset":1200,"byteLength":1200},{"buffer":0,"byteOffset":2400,"byteLength":6})", blob));
    CHECK(only_primitive(s).positions.size() == 3);
    CHECK(only_primitive(s).indices == std::vector<std::uint32_t>{2, 0, 1});
    CHECK(only_primitive(s).positions[2] == math::vec3(90.0F, 8100.0F, 0.0F));
}

TEST_CASE("a chain of nodes as deep as the limit is read", "[scene][load]") {
    auto const chain = [](int depth) {
        std::string nodes = R"("nodes":[)";
        for (int i = 0; i < depth - 1; ++i) nodes += R"({"translation":[1,0,0],"children":[)" + std::to_string(i + 1) + "]},";
        return nodes + R"({"name":"n","mesh":0}])";
    };
    scene::Scene const s = changed(R"("nodes":[{"name":"n","mesh":0,"translation":[1,2,3]}])", chain(1024));
    CHECK(s.instances[0].world_from_mesh[3].x == 1023.0);
    auto const deeper = load_changed(R"("nodes":[{"name":"n","mesh":0,"translation":[1,2,3]}])", chain(10'000));
    REQUIRE_FALSE(deeper.has_value());
    CHECK(deeper.failure().code == scene::SceneError::over_limit);
    CHECK(deeper.failure().message.find("max_depth") != std::string::npos);
}
