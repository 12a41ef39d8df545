// Any bytes as a glTF file: a scene that keeps its own rules, at any time of its clips, or a sentence. Nothing that is
// allocated on the way is out of proportion to the file.
//
// The last byte chooses the time, the rest is the file.

#include "../tests/motion_fixture.hpp"

#include <gnomon/check/fuzz.hpp>
#include <gnomon/scene.hpp>

#include <cstddef>

namespace {

using namespace gnomon;

constexpr std::uint64_t most_values = 1U << 14U;

scene::LoadConfig tight() {
    scene::LoadConfig config;
    config.limits.max_triangles = most_values;
    config.limits.max_vertices = most_values;
    config.limits.max_motion_values = most_values;
    config.limits.max_zero_elements = 1U << 12U;
    config.limits.max_nodes = 1U << 10U;
    config.limits.max_depth = 64;
    config.limits.max_json_depth = 32;
    config.limits.max_json_values = 1U << 14U;
    config.limits.max_image_side_px = 512;
    config.limits.max_image_bytes = 1U << 20U;
    return config;
}

void check_failure(core::Failure<scene::SceneError> const& failure) {
    GNOMON_FUZZ_CHECK(failure.message.size() > 10 && failure.message.size() < 1000);
    GNOMON_FUZZ_CHECK(failure.message.find(';') != std::string::npos);
}

/// What flattening gives may be drawn without a further look.
void check_geometry(scene::Geometry const& g, scene::Scene const& s) {
    GNOMON_FUZZ_CHECK(g.normals.size() == g.positions.size() && g.uv.size() == g.positions.size());
    GNOMON_FUZZ_CHECK(g.triangle_material.size() * 3 == g.indices.size() && g.triangle_instance.size() * 3 == g.indices.size());
    GNOMON_FUZZ_CHECK(g.indices.size() / 3 + g.non_finite_triangles <= scene::count_triangles(s));
    for (std::uint32_t const index : g.indices) {
        GNOMON_FUZZ_CHECK(index < g.positions.size());
        GNOMON_FUZZ_CHECK(math::is_finite(g.positions[index]) && math::is_finite(g.normals[index]));
        GNOMON_FUZZ_CHECK(math::contains(g.bounds, g.positions[index]));
    }
}

void run(std::span<std::uint8_t const> bytes) {
    if (bytes.empty()) return;
    double const time_s = bytes.back() / 16.0 - 1.0;
    auto const file = std::as_bytes(bytes.first(bytes.size() - 1));
    auto const loaded = scene::load_gltf_bytes(file, "", tight());
    if (!loaded) return check_failure(loaded.failure());
    GNOMON_FUZZ_CHECK(scene::validate(*loaded).has_value());
    GNOMON_FUZZ_CHECK(scene::count_triangles(*loaded) <= most_values);
    scene::Pose const pose = scene::pose_at(*loaded, {time_s, scene::all_clips, (bytes.back() & 1U) != 0});
    for (scene::CameraPose const& camera : pose.cameras) GNOMON_FUZZ_CHECK(math::is_finite(camera.eye_m) && math::is_finite(camera.back));
    scene::Geometry moved = scene::flatten(*loaded);
    check_geometry(moved, *loaded);
    check_geometry(scene::flatten(*loaded, pose), *loaded);
    scene::update(moved, *loaded, pose);
    check_geometry(moved, *loaded);
}

void add(check::FuzzSeeds& out, char const* name, std::vector<std::byte> const& file) {
    std::vector<std::uint8_t> bytes;
    for (std::byte const b : file) bytes.push_back(std::to_integer<std::uint8_t>(b));
    bytes.push_back(40);
    out.add(name, std::move(bytes));
}

/// One triangle with a 2x2 picture of four colours, cut out by its alpha.
std::vector<std::byte> textured() {
    std::string const image = "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAFklEQVR42mNk+M/AwMDAxAAFjIwMDAAMEQEBKXWB7gAAAABJRU5ErkJggg==";
    std::string const json = fixture::replaced(
        fixture::triangle_json(), R"({"name":"paint"})",
        R"({"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"offset":[0.5,0],"rotation":1,"scale":[2,2]}}}}})");
    return fixture::glb(fixture::replaced(json, R"("accessors")", R"("textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":33648}],"images":[{"uri":"data:image/png;base64,)" + image + R"("}],"accessors")"),
                        fixture::triangle_blob().bytes());
}

std::vector<std::byte> hierarchy() {
    return fixture::glb(fixture::replaced(fixture::triangle_json(), R"("nodes":[{"name":"n","mesh":0,"translation":[1,2,3]}])",
                                          R"("nodes":[{"scale":[2,-2,2],"children":[1,2]},{"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,6,7,1],"mesh":0},{"mesh":0,"rotation":[0,0.6,0,0.8],"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}}}}])"),
                        fixture::triangle_blob().bytes());
}

std::vector<std::byte> embedded() {
    std::string const uri = R"("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA")";
    return fixture::text(R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":6}]}],)"
                         R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":)" +
                         uri + "}]}");
}

void seeds(check::FuzzSeeds& out) {
    add(out, "triangle", fixture::glb(fixture::triangle_json(), fixture::triangle_blob().bytes()));
    add(out, "moving", fixture::moving_file());
    add(out, "textured", textured());
    add(out, "hierarchy", hierarchy());
    add(out, "embedded", embedded());
}

}  // namespace

GNOMON_FUZZ_TARGET(run, seeds)
