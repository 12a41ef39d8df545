#include "test_host.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/core/executor_threads.hpp>
#include <gnomon/pipeline.hpp>
#include <gnomon/scene.hpp>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

using namespace gnomon;

namespace {

struct RayStage {
    scene::Scene scene;
    scene::Geometry geometry;
    math::View view;
    bool inside = false;  ///< A room, with its lamp below the ceiling.
};

RayStage ray_stage(scene::Scene made, int size_px) {
    RayStage stage{std::move(made), {}, {}, false};
    stage.geometry = scene::flatten(stage.scene);
    scene::SuggestedView const suggested = scene::auto_view(stage.geometry);
    stage.inside = suggested.inside;
    math::PerspectiveConfig config;
    config.eye_m = suggested.eye_m;
    config.target_m = suggested.target_m;
    config.fov_y_rad = suggested.fov_y_rad;
    config.near_m = suggested.near_m;
    config.size_px = math::ivec2(size_px, size_px);
    stage.view = math::make_perspective(config).value();
    return stage;
}

/// A city whose walls and ground have holes: textures of odd sizes, wrapped in all ways, and a material without one.
scene::Scene scene_with_holes() {
    scene::ProceduralConfig config;
    config.name = "city";
    config.triangles = 52'000;
    scene::Scene city = scene::make_procedural(config).value();
    std::uint32_t noise = 1;
    city.images.clear();
    city.textures.clear();
    for (std::uint32_t i = 0; i < 3; ++i) {
        scene::Image image;
        image.size_px = math::ivec2(13 + 20 * static_cast<int>(i), 7 + 9 * static_cast<int>(i));
        image.rgba.resize(static_cast<std::size_t>(4 * image.size_px.x * image.size_px.y));
        for (std::uint8_t& code : image.rgba)
            code = static_cast<std::uint8_t>((noise = noise * 1664525 + 1013904223) >> 24U);
        city.images.push_back(std::move(image));
        city.textures.push_back({i, static_cast<math::Wrap>(i), static_cast<math::Wrap>((i + 1) % 3)});
    }
    scene::Material const plain = city.materials.front();
    city.materials.assign(4, plain);
    for (std::uint32_t i = 0; i < 4; ++i) {
        scene::Material& m = city.materials[i];
        m.alpha_mode = scene::AlphaMode::mask;
        m.alpha_cutoff = i == 1 ? 0.25F : 0.5F;
        m.base_color.w = i == 2 ? 0.9F : 1.0F;
        m.base_color_texture = {};
        m.base_color_texture.texture = i < 3 ? i : scene::none;
    }
    std::uint32_t next = 0;
    for (scene::Mesh& mesh : city.meshes)
        for (scene::Primitive& p : mesh.primitives) {
            p.material = next++ % 4;
            p.uv0.clear();
            for (math::vec3 const& at : p.positions)
                p.uv0.emplace_back(at.x * 0.31F + at.y * 0.17F, at.z * 0.23F - at.y * 0.29F);
        }
    return city;
}

RayStage ray_stage(std::string const& name, std::uint64_t triangles, int size_px) {
    scene::ProceduralConfig config;
    config.name = name;
    config.triangles = triangles;
    auto made = scene::make_procedural(config);
    if (!made) FAIL(made.failure().message);
    return ray_stage(std::move(made).value(), size_px);
}

/// A slanting sun, a lamp in the room or above the things, and a sun straight above.
std::array<pipeline::Light, 3> ray_lights(RayStage const& stage) {
    math::Aabb const& bounds = stage.geometry.bounds;
    math::vec3 const lamp = bounds.lo + (bounds.hi - bounds.lo) * math::vec3(0.4F, stage.inside ? 0.7F : 1.6F, 0.45F);
    return {pipeline::sun(math::dvec3(-0.45, -0.8, -0.4)),
            pipeline::bulb(math::to_double(lamp) + stage.geometry.origin_m),
            pipeline::sun(math::dvec3(0.0, -1.0, 0.0))};
}

struct RayTally {
    std::uint64_t samples = 0;
    std::uint64_t unsure = 0;
    std::uint64_t lit = 0;
    std::uint64_t wrong = 0;
};

RayTally trace_on(backend::Backend& device, RayStage const& stage, pipeline::Light const& light) {
    core::ThreadExecutor const executor(2);
    auto const frame = pipeline::make_frame(stage.scene, stage.geometry, stage.view, light, executor);
    REQUIRE(frame);
    pipeline::Technique const* const technique = pipeline::find_technique("ray").value();
    pipeline::Params const params = pipeline::make_params(*technique).value();
    pipeline::Workspace workspace;
    auto const output = technique->run({*frame, params, workspace, device, executor});
    if (!output) FAIL(output.failure().message);
    RayTally tally;
    tally.samples = frame->samples.size();
    for (std::size_t i = 0; i < tally.samples; ++i) {
        tally.lit += output->visibility[i] == 1.0F ? 1U : 0U;
        tally.wrong += output->visibility[i] != (frame->lit[i] != 0 ? 1.0F : 0.0F) ? 1U : 0U;
    }
    for (pipeline::Count const& count : output->counts)
        if (count.name == "uncertain_samples") tally.unsure = count.value;
    return tally;
}

/// All lights of a stage; the largest fraction that was left to the CPU is at most `unsure`.
void compare_ray(RayStage const& stage, std::string_view name, double unsure) {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    {
        vulkan::test::TestHost host(*device);
        auto const backend = vulkan::Backend::make(device->gpu(), host.host());
        REQUIRE(backend);
        for (pipeline::Light const& light : ray_lights(stage)) {
            RayTally const tally = trace_on(**backend, stage, light);
            std::printf("ray, %.*s: %llu samples, %llu lit, %llu left to the CPU\n", static_cast<int>(name.size()),
                        name.data(), static_cast<unsigned long long>(tally.samples),
                        static_cast<unsigned long long>(tally.lit), static_cast<unsigned long long>(tally.unsure));
            CAPTURE(std::string(name));
            CHECK(tally.samples > 1'000);
            CHECK(tally.wrong == 0);
            CHECK(static_cast<double>(tally.unsure) <= unsure * static_cast<double>(tally.samples));
        }
    }
    CHECK(device->take_messages() == "");
    CHECK(device->live().total() == 0);
}

}  // namespace

TEST_CASE("the ray kernel's answers are the exact ones for every sample, and few are left to the CPU",
          "[vulkan][ray]") {
    compare_ray(ray_stage("city", 52'000, 96), "city", 0.01);
    compare_ray(ray_stage("rayyard", 70'000, 96), "rayyard", 0.01);
    compare_ray(ray_stage("sheet", 0, 96), "sheet", 0.01);
    compare_ray(ray_stage("cage", 0, 96), "cage", 0.01);
}

TEST_CASE("the ray kernel decides masked leaves as the CPU does", "[vulkan][ray]") {
    RayStage const stage = ray_stage(scene_with_holes(), 96);
    std::array<int, 4> triangles{};
    for (std::uint32_t const material : stage.geometry.triangle_material) ++triangles[material];
    for (int const count : triangles) CHECK(count > 500);
    compare_ray(stage, "city with holes", 0.02);
}

TEST_CASE("the ray kernel's answers are the exact ones in whole scenes", "[.full][vulkan][ray]") {
    for (char const* const name : {"city", "rayyard", "sheet", "cage"})
        compare_ray(ray_stage(name, 0, 512), name, 0.005);
    compare_ray(ray_stage("forest", 0, 512), "forest", 0.04);
    char const* const path = std::getenv("GNOMON_SCENE");
    if (path == nullptr) return;
    auto loaded = scene::load_gltf(path);
    REQUIRE(loaded);
    compare_ray(ray_stage(std::move(loaded).value(), 512), path, 0.03);
}
