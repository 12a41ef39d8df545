// Files that lie: each is answered with one sentence that names what is wrong, or loads without what is broken.
#include "gltf_fixture.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/scene/load.hpp>

#include <string>
#include <vector>

using namespace gnomon;
using namespace fixture;

namespace {

using scene::SceneError;

void check_sentence(core::Failure<SceneError> const& failure) {
    CAPTURE(failure.message);
    CHECK(failure.message.size() > 10);
    CHECK(failure.message.size() < 500);
    CHECK(failure.message.find('\n') == std::string::npos);
    CHECK(failure.message.find(';') != std::string::npos);  // what is wrong; what to do
}

void refuses(std::vector<std::byte> const& file, SceneError code, std::string const& says) {
    auto const result = load(file);
    CAPTURE(says);
    REQUIRE_FALSE(result.has_value());
    check_sentence(result.failure());
    CAPTURE(result.failure().message);
    CHECK(result.failure().code == code);
    CHECK(result.failure().message.find(says) != std::string::npos);
}

void refuses_change(std::string const& from, std::string const& to, SceneError code, std::string const& says) {
    CAPTURE(from);
    CAPTURE(to);
    refuses(glb(replaced(triangle_json(), from, to), triangle_blob().bytes()), code, says);
}

void refuses_malformed(std::string const& from, std::string const& to, std::string const& says) {
    refuses_change(from, to, SceneError::malformed, says);
}

std::string with_images(std::string const& images) {
    std::string const json = replaced(triangle_json(), R"({"name":"paint"})", R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
    return replaced(json, R"("accessors")", R"("textures":[{"source":0}],"images":)" + images + R"(,"accessors")");
}

}  // namespace

TEST_CASE("indices out of range are named", "[scene][hostile]") {
    refuses_malformed(R"("POSITION":0)", R"("POSITION":9)", "accessor 9");
    refuses_malformed(R"("NORMAL":1)", R"("NORMAL":4)", "accessor 4");
    refuses_malformed(R"("indices":3)", R"("indices":77)", "indices");
    refuses_malformed(R"("material":0)", R"("material":1)", "material 1");
    refuses_malformed(R"("mesh":0)", R"("mesh":1)", "mesh 1");
    refuses_malformed(R"("mesh":0)", R"("mesh":0,"camera":0)", "camera 0");
    refuses_malformed(R"("mesh":0)", R"("mesh":0,"children":[5])", "child 5");
    refuses_malformed(R"("mesh":0)", R"("mesh":0,"extensions":{"KHR_lights_punctual":{"light":0}})", "light");
    refuses_malformed(R"("nodes":[0])", R"("nodes":[3])", "node 3");
    refuses_malformed(R"("scene":0)", R"("scene":4)", "scene 4");
    refuses_malformed(R"({"bufferView":0)", R"({"bufferView":8)", "buffer view 8");
    refuses_malformed(R"({"buffer":0)", R"({"buffer":2)", "buffer 2");
    refuses_malformed(R"({"name":"paint"})", R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":3}}})", "texture 3");
}

TEST_CASE("numbers that are negative, broken, too large or no numbers are named, not wrapped", "[scene][hostile]") {
    refuses_malformed(R"("mesh":0)", R"("mesh":-1)", "'mesh' is -1");
    refuses_malformed(R"("mesh":0)", R"("mesh":4294967296)", "4294967296");
    refuses_malformed(R"("mesh":0)", R"("mesh":"0")", "'mesh' is \"0\"");
    refuses_malformed(R"("mesh":0)", R"("mesh":0.5)", "0.5");
    refuses_malformed(R"("POSITION":0)", R"("POSITION":-2)", "'POSITION' is -2");
    refuses_malformed(R"("count":3)", R"("count":-3)", "'count' is -3");
    refuses_malformed(R"("count":3)", R"("count":18446744073709551615)", "18446744073709551615");
    refuses_malformed(R"("count":3)", R"("count":1e9)", "1e9");
    refuses_malformed(R"("byteOffset":36)", R"("byteOffset":-36)", "'byteOffset' is -36");
    refuses_malformed(R"("nodes":[0])", R"("nodes":[-1])", "'nodes' is -1");
    refuses_malformed(R"("byteLength":104)", R"("byteLength":null)", "'byteLength' is null");
    refuses_malformed(R"([1,2,3])", R"([1,2,1e999])", "not valid glTF");
}

TEST_CASE("ranges beyond their container are named", "[scene][hostile]") {
    refuses_malformed(R"("count":3)", R"("count":2147483647)", "2147483647 elements");
    refuses_malformed(R"("count":3)", R"("count":4)", "4 elements");
    refuses_malformed(R"("componentType":5126,"count":3,"type":"VEC3")", R"("componentType":5126,"byteOffset":2147483647,"count":3,"type":"VEC3")", "2147483647");
    refuses_malformed(R"("byteOffset":96,"byteLength":6)", R"("byteOffset":2147483647,"byteLength":6)", "2147483647");
    refuses_malformed(R"("byteOffset":96,"byteLength":6)", R"("byteOffset":96,"byteLength":2147483647)", "2147483647");
    refuses_malformed(R"("byteLength":104)", R"("byteLength":105)", "105");
    refuses_malformed(R"("byteLength":104)", R"("byteLength":100)", "buffer view 3");
    refuses_malformed(R"("byteLength":104)", R"("uri":"")", "byteLength");
}

TEST_CASE("wrong strides and types are named", "[scene][hostile]") {
    refuses_malformed(R"("byteOffset":0,"byteLength":36)", R"("byteOffset":0,"byteLength":36,"byteStride":8)", "stride of 8");
    refuses_malformed(R"("byteOffset":0,"byteLength":36)", R"("byteOffset":0,"byteLength":36,"byteStride":16)", "16 apart");
    refuses_malformed(R"("byteOffset":0,"byteLength":36)", R"("byteOffset":0,"byteLength":36,"byteStride":252)", "252 apart");
    refuses_malformed(R"("byteOffset":0,"byteLength":36)", R"("byteOffset":0,"byteLength":36,"byteStride":7)", "byteStride");
    refuses_malformed(R"("componentType":5126)", R"("componentType":5124)", "5124");
    refuses_malformed(R"("componentType":5126)", R"("componentType":5130)", "5130");
    refuses_malformed(R"("componentType":5126)", R"("componentType":1)", "not valid glTF");
    refuses_malformed(R"("type":"VEC3")", R"("type":"VEC2")", "POSITION has 2 components");
    refuses_malformed(R"("type":"VEC3")", R"("type":"MAT3")", "matrices");
    refuses_malformed(R"("type":"VEC3")", R"("type":"VEC9")", "VEC9");
    refuses_malformed(R"("componentType":5123)", R"("componentType":5122)", "5122");
    refuses_malformed(R"("type":"SCALAR")", R"("type":"VEC2")", "accessor 3");
    refuses_malformed(R"("componentType":5126,"count":3,"type":"VEC2")", R"("componentType":5126,"count":2,"type":"VEC2")", "TEXCOORD_0");
    refuses_malformed(R"("indices":3)", R"("indices":3,"mode":7)", "mode 7");
}

TEST_CASE("an index beyond the vertices is named with its value", "[scene][hostile]") {
    Blob blob;
    blob.add(0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F).add(0U, 1U, 4294967295U);
    refuses(one_primitive(R"({"attributes":{"POSITION":0},"indices":1})",
                          R"({"bufferView":0,"count":3,"type":"VEC3","componentType":5126},{"bufferView":1,"count":3,"type":"SCALAR","componentType":5125})",
                          R"({"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":12})", blob),
            SceneError::malformed, "index 4294967295");
}

TEST_CASE("broken sparse accessors are named", "[scene][hostile]") {
    Blob blob;
    blob.add(0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F).add(std::uint16_t{2}, std::uint16_t{1}, 0U).pad_to(80);
    auto const sparse = [&](std::string const& part, std::string const& says) {
        refuses(one_primitive(R"({"attributes":{"POSITION":0}})", R"({"bufferView":0,"count":3,"type":"VEC3","componentType":5126,"sparse":)" + part + "}",
                              R"({"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":8},{"buffer":0,"byteOffset":40,"byteLength":24})", blob),
                SceneError::malformed, says);
    };
    std::string const good = R"({"count":2,"indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":2}})";
    sparse(good, "sparse index 1");  // not ascending
    sparse(replaced(good, R"("count":2)", R"("count":4)"), "4 sparse");
    sparse(replaced(good, R"("count":2)", R"("count":0)"), "0 sparse");
    sparse(replaced(good, "5123", "5126"), "5126");
    sparse(replaced(good, R"("bufferView":1)", R"("bufferView":9)"), "buffer view 9");
    sparse(replaced(good, R"("bufferView":2)", R"("bufferView":2,"byteOffset":20)"), "byte 20");
    sparse("7", "SparseAccessor");
}

TEST_CASE("node loops and double parents are named", "[scene][hostile]") {
    refuses_malformed(R"("mesh":0)", R"("mesh":0,"children":[0])", "node 0 is an ancestor of itself");
    refuses_malformed(R"("nodes":[{"name":"n","mesh":0)", R"("nodes":[{"children":[1]},{"children":[0]},{"mesh":0)", "ancestor of itself");
    refuses_malformed(R"("nodes":[{"name":"n","mesh":0)", R"("nodes":[{"children":[2,2]},{},{"mesh":0)", "child of both");
    refuses_malformed(R"("nodes":[{"name":"n","mesh":0)", R"("nodes":[{"children":[2]},{"children":[2]},{"mesh":0)", "child of both");
    refuses_malformed(R"("translation":[1,2,3])", R"("translation":[1,2])", "wrong length");
    refuses_malformed(R"("translation":[1,2,3])", R"("matrix":[1,2,3])", "matrix of 3");
    refuses_malformed(R"("translation":[1,2,3])", R"("scale":[1e200,1,1],"children":[1]},{"scale":[1e200,1,1])", "too large");
}

TEST_CASE("files that are no glTF are told apart", "[scene][hostile]") {
    refuses({}, SceneError::not_gltf, "empty");
    refuses(text("hello"), SceneError::not_gltf, "hello");
    refuses(text("\x7F" "ELF"), SceneError::not_gltf, "neither JSON nor GLB");
    refuses(text("[1]"), SceneError::not_gltf, "neither JSON nor GLB");
    refuses(text("{"), SceneError::malformed, "cut off");
    refuses(text("{   }"), SceneError::malformed, "asset");
    refuses(text("{}{}"), SceneError::malformed, "after its closing bracket");
    refuses(text("{]"), SceneError::malformed, "bracket");
    refuses(text(R"({"a)"), SceneError::malformed, "string without an end");
    refuses(text(R"({"asset":{"version":"1.0"}})"), SceneError::not_gltf, "1.0");
    refuses(text(R"({"asset":{"version":"2.0"}})"), SceneError::empty, "no triangles");
    refuses(text("{\"asset\":{\"version\":\"2.0\"},\"a\":\"\xFF\xFE\"}"), SceneError::malformed, "not valid glTF");
    refuses(text("{\"asset\":{\"version\":\"2.0\"},,}"), SceneError::malformed, "not valid glTF");
}

TEST_CASE("a file of glTF 1.0 is told by its objects where arrays belong", "[scene][hostile]") {
    refuses(text(R"({"accessors":{"a":{"bufferView":"view_1"}},"asset":{"version":"1.0"}})"), SceneError::not_gltf, "glTF 1.0");
}

TEST_CASE("a compressed mesh is refused for its extension, not for the bytes that this leaves out", "[scene][hostile]") {
    std::string const json = replaced(triangle_json(), R"({"bufferView":3,)", "{");
    refuses(glb(replaced(json, R"("scene":0)", R"("extensionsRequired":["KHR_draco_mesh_compression"],"scene":0)"), triangle_blob().bytes()),
            SceneError::unsupported_extension, "KHR_draco");
}

TEST_CASE("root members that glTF does not define may hold anything", "[scene][hostile]") {
    auto const s = load_changed(R"("scene":0)", R"("techniques":[{"attributes":{"a_normal":"normal"},"count":-1}],"extensionsRequired":["KHR_technique_webgl"],"scene":0)");
    CAPTURE(s ? std::string() : s.failure().message);
    REQUIRE(s.has_value());
    CHECK(s->notes.warnings.size() == 1);
}

TEST_CASE("damaged GLB containers are told apart", "[scene][hostile]") {
    std::vector<std::byte> const good = glb(triangle_json(), triangle_blob().bytes());
    auto const with = [&](std::size_t at, std::uint8_t value) {
        std::vector<std::byte> bytes = good;
        bytes[at] = static_cast<std::byte>(value);
        return bytes;
    };
    refuses(with(0, 'G'), SceneError::not_gltf, "neither JSON nor GLB");
    refuses(with(4, 1), SceneError::not_gltf, "version 1");
    refuses(with(11, 0x7F), SceneError::malformed, "cut off");
    refuses(with(15, 0x7F), SceneError::malformed, "cut off");
    refuses(with(16, 'X'), SceneError::malformed, "not JSON");
    std::size_t const chunk = 20 + (triangle_json().size() + 3) / 4 * 4;
    refuses(with(chunk + 3, 0xFF), SceneError::malformed, "cut off");
    refuses(with(chunk + 4, 'X'), SceneError::malformed, "neither a URI nor a GLB chunk");
}

TEST_CASE("a GLB cut off at any byte is refused, or whole", "[scene][hostile]") {
    std::vector<std::byte> const good = glb(triangle_json(), triangle_blob().bytes());
    for (std::size_t size = 0; size < good.size(); ++size) {
        auto const result = load({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)});
        CHECK_FALSE(result.has_value());
    }
    CHECK(load(good).has_value());
}

TEST_CASE("JSON cut off at any byte is refused", "[scene][hostile]") {
    std::string const json = triangle_json();
    for (std::size_t size = 0; size < json.size(); ++size) {
        auto const result = load(glb(json.substr(0, size), triangle_blob().bytes()));
        CHECK_FALSE(result.has_value());
    }
}

TEST_CASE("any one changed byte gives a scene or a sentence", "[scene][hostile]") {
    std::vector<std::byte> const good = glb(triangle_json(), triangle_blob().bytes());
    std::size_t scenes = 0;
    std::uint32_t noise = 12345;
    for (std::size_t at = 0; at < good.size(); ++at)
        for (int i = 0; i < 3; ++i) {
            noise = noise * 1664525U + 1013904223U;
            std::vector<std::byte> bytes = good;
            bytes[at] ^= static_cast<std::byte>(1U + (noise >> 24U) % 255U);
            auto const result = load(bytes);
            scenes += result.has_value() ? 1U : 0U;
            if (result.has_value())
                CHECK(scene::validate(*result).has_value());
            else
                CHECK(!result.failure().message.empty());
        }
    CHECK(scenes > 0);
}

TEST_CASE("a required extension that is not read is named", "[scene][hostile]") {
    for (std::string const name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_texture_basisu", "VENDOR_secret"})
        refuses_change(R"("scene":0)", R"("scene":0,"extensionsRequired":[")" + name + R"("])", SceneError::unsupported_extension, name);
    auto const shading = load_changed(R"("scene":0)", R"("scene":0,"extensionsRequired":["KHR_materials_clearcoat","KHR_mesh_quantization"])");
    REQUIRE(shading.has_value());
    CHECK(shading->notes.warnings.size() == 1);
}

TEST_CASE("brackets nested beyond the limit are refused before anything recurses", "[scene][hostile]") {
    std::string const deep = std::string(100'000, '[') + std::string(100'000, ']');
    refuses(text(R"({"asset":{"version":"2.0","extras":)" + deep + "}}"), SceneError::over_limit, "max_json_depth");
    refuses(text(std::string("{\"a\":") + std::string(1'000'000, '[')), SceneError::over_limit, "max_json_depth");
}

TEST_CASE("what a file may ask for is bounded by the limits", "[scene][hostile]") {
    auto const limited = [](auto change, std::vector<std::byte> const& file, std::string const& says) {
        scene::LoadConfig config;
        change(config.limits);
        auto const result = load(file, config);
        CAPTURE(says);
        REQUIRE_FALSE(result.has_value());
        check_sentence(result.failure());
        CHECK(result.failure().code == SceneError::over_limit);
        CHECK(result.failure().message.find(says) != std::string::npos);
    };
    std::vector<std::byte> const good = glb(triangle_json(), triangle_blob().bytes());
    limited([](scene::Limits& l) { l.max_file_bytes = 100; }, good, "max_file_bytes");
    limited([](scene::Limits& l) { l.max_triangles = 0; }, good, "max_triangles");
    limited([](scene::Limits& l) { l.max_vertices = 2; }, good, "max_vertices");
    limited([](scene::Limits& l) { l.max_json_values = 10; }, good, "max_json_values");
    limited([](scene::Limits& l) { l.max_nodes = 1; }, glb(replaced(triangle_json(), R"("nodes":[{"name")", R"("nodes":[{},{"name")"), triangle_blob().bytes()), "max_nodes");
    std::string const many = replaced(triangle_json(), R"("scenes":[{"name":"s","nodes":[0]}],"nodes":[)", R"("scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0},)");
    limited([](scene::Limits& l) { l.max_triangles = 1; }, glb(many, triangle_blob().bytes()), "max_triangles");
    limited([](scene::Limits&) {}, glb(replaced(triangle_json(), R"({"bufferView":0,"componentType":5126,"count":3)", R"({"componentType":5126,"count":2000000000)"), triangle_blob().bytes()), "max_zero_elements");
    std::string materials;
    for (int i = 0; i < 70'000; ++i) materials += "{},";
    limited([](scene::Limits&) {}, glb(replaced(triangle_json(), R"({"name":"paint"})", materials + "{}"), triangle_blob().bytes()), "materials");
}

TEST_CASE("many buffers that name one chunk or one file cost it once or reach the limit", "[scene][hostile]") {
    std::string buffers = R"("buffers":[{"byteLength":104})";
    for (int i = 0; i < 1000; ++i) buffers += R"(,{"byteLength":104})";
    refuses(glb(replaced(triangle_json(), R"("buffers":[{"byteLength":104})", buffers), triangle_blob().bytes()), SceneError::malformed, "buffer 1 has neither");
    TemporaryFolder const folder;
    folder.save("mesh.bin", triangle_blob().bytes());
    std::string const named = R"({"byteLength":104,"uri":"mesh.bin"})";
    std::string list = named;
    for (int i = 0; i < 1000; ++i) list += "," + named;
    folder.save("a.gltf", text(replaced(triangle_json(), R"({"byteLength":104})", list)));
    scene::LoadConfig config;
    config.limits.max_file_bytes = 100'000;
    auto const result = scene::load_gltf(folder / "a.gltf", config);
    REQUIRE_FALSE(result.has_value());
    CHECK(result.failure().code == SceneError::over_limit);
}

TEST_CASE("missing, odd and escaping files are refused by name", "[scene][hostile]") {
    TemporaryFolder const folder;
    folder.save("secret.bin", triangle_blob().bytes());
    folder.save("in/mesh.bin", triangle_blob().bytes());
    auto const with_uri = [&](std::string const& uri) {
        folder.save("in/a.gltf", text(replaced(triangle_json(), R"({"byteLength":104})", R"({"byteLength":104,"uri":")" + uri + R"("})")));
        return scene::load_gltf(folder / "in/a.gltf");
    };
    REQUIRE(with_uri("mesh.bin").has_value());
    REQUIRE(with_uri("./mesh.bin").has_value());
    for (std::string const uri : {"../secret.bin", "%2e%2e/secret.bin", "..%2fsecret.bin", "x/../../secret.bin", "/etc/passwd", "%2Fetc/passwd",
                                  "file:///etc/passwd", "http://example.org/a.bin", "C:/a.bin", R"(..\\secret.bin)", "a%00.bin", "data:nonsense", "data:,x",
                                  "data:application/octet-stream;base64,@@@@", "data:application/octet-stream;base64,AAAAA"}) {
        CAPTURE(uri);
        auto const result = with_uri(uri);
        REQUIRE_FALSE(result.has_value());
        check_sentence(result.failure());
        CHECK(result.failure().code == SceneError::malformed);
    }
    CHECK(with_uri("none.bin").failure().code == SceneError::not_found);
    CHECK(with_uri(".").failure().code == SceneError::unreadable);
    CHECK(with_uri("data:application/octet-stream;base64,AAAA").failure().message.find("3 bytes") != std::string::npos);
    auto const missing = scene::load_gltf(folder / "none.glb");
    REQUIRE_FALSE(missing.has_value());
    check_sentence(missing.failure());
    CHECK(missing.failure().code == SceneError::not_found);
    CHECK(missing.failure().message.find("none.glb") != std::string::npos);
    auto const directory = scene::load_gltf(folder / "in");
    REQUIRE_FALSE(directory.has_value());
    CHECK(directory.failure().code == SceneError::unreadable);
    CHECK_FALSE(scene::load_gltf("/dev/zero").has_value());
    CHECK_FALSE(scene::load_gltf("").has_value());
    CHECK_FALSE(scene::load_gltf(std::string("a\0b", 3)).has_value());
    CHECK_FALSE(scene::load_gltf(std::string(100'000, 'x')).has_value());
}

TEST_CASE("a broken image costs the picture, not the scene", "[scene][hostile]") {
    for (std::string const images : {
             R"([{}])", R"([{"uri":7}])", R"([{"uri":""}])", R"([{"uri":"none.png"}])", R"([{"uri":"../../etc/passwd"}])",
             R"([{"uri":"data:image/png;base64,@@@"}])", R"([{"uri":"data:image/png;base64,"}])", R"([{"uri":"data:image/png;base64,AAAA"}])",
             R"([{"bufferView":0,"mimeType":"image/png"}])", R"([{"bufferView":9}])", R"([{"bufferView":0,"uri":"x.png"}])", R"([null])",
             // A PNG header that says 60000x60000, and one that says 16000x16000 with nothing behind it.
             R"([{"uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAA6mAAAOpgCAYAAAAAAAAA"}])",
             R"([{"uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAPoAAAD6ACAYAAAAAAAAA"}])"}) {
        CAPTURE(images);
        auto const result = load(glb(with_images(images), triangle_blob().bytes()));
        CAPTURE(result ? std::string() : result.failure().message);
        REQUIRE(result.has_value());
        CHECK(result->notes.failed_images == 1);
        CHECK(result->notes.warnings.size() == 1);
        REQUIRE(result->images.size() == 1);
        CHECK(result->images[0].size_px == math::ivec2(1, 1));
    }
    refuses(glb(with_images("[]"), triangle_blob().bytes()), SceneError::malformed, "image 0");
}

TEST_CASE("keys spelled with escapes do not lead past the checks", "[scene][hostile]") {
    refuses_malformed(R"("buffers":[{"byteLength":104}])", R"("b\u0075ffers":[{"byteLength":104,"uri":"/dev/zero"}])", "not found");
    auto const images = load_changed(R"("accessors")", R"("im\u0061ges":[{"uri":"/dev/zero"}],"accessors")");
    CHECK(images.has_value());
}

TEST_CASE("a scene whose every triangle is not finite is empty, and says so", "[scene][hostile]") {
    Blob blob;
    for (int i = 0; i < 9; ++i) blob.add(0x7FC0'0000U);
    refuses(one_primitive(R"({"attributes":{"POSITION":0}})", R"({"bufferView":0,"count":3,"type":"VEC3","componentType":5126})", R"({"buffer":0,"byteLength":36})", blob),
            SceneError::empty, "1 with NaN");
    refuses_change(R"("indices":3)", R"("indices":3,"mode":1)", SceneError::empty, "points and lines");
    refuses_change(R"("nodes":[0])", R"("nodes":[])", SceneError::empty, "no triangles");
}
