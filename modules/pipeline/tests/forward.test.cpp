// Forward shading: textures, holes, overdraw.

#include <gnomon/check/check.hpp>
#include <gnomon/pipeline/lighting.hpp>
#include <gnomon/scene.hpp>

#include "../src/lighting/lighting.hpp"
#include "../src/lighting/surface_table.hpp"
#include "../src/workspace.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace {

using namespace gnomon;

/// The procedural tree under random textures, a third of them with holes, and point lights in it.
struct TexturedTree {
    scene::Scene scene;
    scene::Geometry geometry;
    std::vector<pipeline::Light> lights;

    TexturedTree() {
        scene = scene::make_procedural({.name = "tree"}).value();
        geometry = scene::flatten(scene);
        std::uint32_t seed = 1;
        auto const next = [&] { return seed = seed * 1664525U + 1013904223U; };
        for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
            scene::Image image{"paint", math::ivec2(13 + static_cast<int>(i) * 8, 32), {}};
            image.rgba.resize(static_cast<std::size_t>(image.size_px.x * image.size_px.y) * 4);
            for (std::uint8_t& byte : image.rgba) byte = static_cast<std::uint8_t>(next() >> 24U);
            scene.images.push_back(std::move(image));
            scene.textures.push_back({static_cast<std::uint32_t>(scene.images.size() - 1), math::Wrap::mirror,
                                      i % 2 == 0 ? math::Wrap::repeat : math::Wrap::clamp});
            scene::Material& material = scene.materials[i];
            material.base_color_texture.texture = static_cast<std::uint32_t>(scene.textures.size() - 1);
            material.alpha_mode = i % 3 == 0 ? scene::AlphaMode::mask : scene::AlphaMode::opaque;
            material.metallic = 0.25F * static_cast<float>(i % 4);
            material.roughness = 0.2F + 0.1F * static_cast<float>(i % 5);
        }
        geometry.uv.clear();
        for (math::vec3 const& p : geometry.positions) geometry.uv.emplace_back(p.x * 0.7F, p.y + p.z);
        for (int i = 0; i < 40; ++i) {
            auto const unit = [&] { return static_cast<double>(next() >> 8U) * 0x1p-24; };
            math::dvec3 at(0.0);
            for (math::axis_t axis = 0; axis < 3; ++axis)
                at[axis] = static_cast<double>(geometry.bounds.lo[axis]) +
                           unit() * static_cast<double>(geometry.bounds.hi[axis] - geometry.bounds.lo[axis]);
            pipeline::Light light = pipeline::bulb(at + geometry.origin_m, 3.0F);
            light.intensity = 20.0F;
            lights.push_back(light);
        }
    }

    [[nodiscard]] pipeline::Frame frame(math::View const& view, pipeline::SampleRule rule) const {
        core::SerialExecutor serial;
        return pipeline::make_frame(scene, geometry, {view, pipeline::sun({0.3, -1.0, 0.2}), false, nullptr, rule}, serial).value();
    }
};

pipeline::LightingOutput light_by(std::string_view name, pipeline::Frame const& frame, std::span<pipeline::Light const> lights,
                                  pipeline::Workspace& workspace) {
    auto const* const technique = pipeline::find_lighting_technique(name).value();
    core::SerialExecutor serial;
    auto output = technique->run({frame, lights, pipeline::make_params(*technique).value(), workspace,
                                  workspace.own_backend(serial), serial});
    INFO((output ? std::string() : output.failure().message));
    REQUIRE(output.has_value());
    return std::move(output).value();
}

}  // namespace

TEST_CASE("forward shading gives the deferred image through textures, mips and holes, of any view", "[pipeline][lighting][forward]") {
    TexturedTree const tree;
    math::View perspective = scene::make_view(tree.scene.cameras.front(), math::ivec2(120, 90)).value();
    math::View const ortho =
        math::make_orthographic({.eye_m = perspective.eye_m, .target_m = perspective.eye_m - perspective.back,
                                 .window_m = {.left = -4.0, .right = 4.0, .bottom = -3.0, .top = 3.0}, .near_m = 0.1,
                                 .far_m = 200.0, .size_px = math::ivec2(120, 90)})
            .value();
    pipeline::Workspace workspace;  // kept: what belongs to a view is staged again, the rest is not
    for (math::View const& view : {perspective, ortho}) {
        auto const frame = tree.frame(view, pipeline::SampleRule::formula);
        REQUIRE(frame.samples.size() > 1000);
        auto const deferred = light_by("deferred", frame, tree.lights, workspace);
        for (std::string_view const name : {"forward", "tiled-forward", "tiled-forward-prez", "clustered-forward"}) {
            CAPTURE(name);
            auto const output = light_by(name, frame, tree.lights, workspace);
            std::size_t differ = 0;
            for (std::size_t i = 0; i < frame.samples.size(); ++i) differ += output.radiance[i] != deferred.radiance[i] ? 1U : 0U;
            CHECK(differ == 0);
        }
    }
}

TEST_CASE("samples by the formula lie where the exact ones do, and have their surfaces", "[pipeline][forward]") {
    TexturedTree const tree;
    math::View const view = scene::make_view(tree.scene.cameras.front(), math::ivec2(160, 120)).value();
    auto const exact = tree.frame(view, pipeline::SampleRule::exact);
    auto const formula = tree.frame(view, pipeline::SampleRule::formula);
    REQUIRE(exact.samples.size() == formula.samples.size());
    CHECK(exact.samples.triangle == formula.samples.triangle);
    std::size_t far = 0, turned = 0, moved = 0;
    for (std::size_t i = 0; i < exact.samples.size(); ++i) {
        math::vec3 const way = exact.samples.position[i] - formula.samples.position[i];
        far += glm::dot(way, way) > 1e-8F ? 1U : 0U;  // a tenth of a millimetre
        turned += glm::dot(exact.samples.shading_normal[i], formula.samples.shading_normal[i]) < 0.999F ? 1U : 0U;
        math::vec2 const uv = exact.samples.uv[i] - formula.samples.uv[i];
        moved += std::abs(uv.x) + std::abs(uv.y) > 1e-3F ? 1U : 0U;
    }
    // Edge-on triangles are all that float places otherwise.
    CHECK(far * 200 <= exact.samples.size());
    CHECK(turned * 200 <= exact.samples.size());
    CHECK(moved * 200 <= exact.samples.size());
}

TEST_CASE("a pass of depth takes the overdraw out of forward shading", "[pipeline][forward]") {
    TexturedTree const tree;
    math::View const view = scene::make_view(tree.scene.cameras.front(), math::ivec2(96, 72)).value();
    auto const frame = tree.frame(view, pipeline::SampleRule::formula);
    pipeline::Workspace workspace;
    std::uint64_t const samples = frame.samples.size();
    auto const every = light_by("forward", frame, tree.lights, workspace).counts.front().value;
    auto const tiled = light_by("tiled-forward", frame, tree.lights, workspace).counts.front().value;
    auto const prez = light_by("tiled-forward-prez", frame, tree.lights, workspace).counts.front().value;
    auto const clustered = light_by("clustered-forward", frame, tree.lights, workspace).counts.front().value;
    CHECK(every % tree.lights.size() == 0);
    CHECK(every >= samples * tree.lights.size());
    CHECK(tiled < every);
    CHECK(prez < tiled);
    CHECK(clustered <= prez);
}

TEST_CASE("clustered forward shading evaluates what clustered deferred does, by lists of the clusters with samples", "[pipeline][lighting][forward]") {
    TexturedTree const tree;
    math::View const view = scene::make_view(tree.scene.cameras.front(), math::ivec2(128, 96)).value();
    pipeline::Workspace workspace;
    for (pipeline::SampleRule const rule : {pipeline::SampleRule::formula, pipeline::SampleRule::exact}) {
        auto const frame = tree.frame(view, rule);
        auto const forward = light_by("clustered-forward", frame, tree.lights, workspace);
        auto const deferred = light_by("clustered-deferred", frame, tree.lights, workspace);
        std::size_t otherwise = 0;
        for (std::size_t i = 0; i < frame.samples.size(); ++i) otherwise += forward.computations[i] != deferred.computations[i] ? 1U : 0U;
        // Where samples are exact, a fragment's position is another by some 1e-7: now and then it is in the next cluster.
        CHECK(otherwise <= (rule == pipeline::SampleRule::formula ? 0 : frame.samples.size() / 100));
        for (std::uint32_t const n : forward.computations) REQUIRE(n < tree.lights.size());  // none fell back on all lights
    }
}

TEST_CASE("a fragment in a cluster without samples is under all lights", "[pipeline][lighting][forward]") {
    TexturedTree const tree;
    math::View const view = scene::make_view(tree.scene.cameras.front(), math::ivec2(120, 90)).value();
    pipeline::Workspace workspace;
    auto frame = tree.frame(view, pipeline::SampleRule::formula);
    (void)light_by("clustered-forward", frame, tree.lights, workspace);
    std::vector<math::vec4> const whole = workspace.state().lighting.forward.color;
    std::size_t const half = frame.samples.size() / 2;
    frame.samples.pixel.resize(half);
    frame.samples.triangle.resize(half);
    frame.samples.position.resize(half);
    auto const output = light_by("clustered-forward", frame, tree.lights, workspace);
    std::vector<math::vec4> const& cut = workspace.state().lighting.forward.color;
    REQUIRE(cut.size() == whole.size());
    std::size_t fallen = 0, differ = 0;
    for (std::size_t i = 0; i < cut.size(); ++i) {
        differ += cut[i].x != whole[i].x || cut[i].y != whole[i].y || cut[i].z != whole[i].z ? 1U : 0U;
        fallen += cut[i].w >= static_cast<float>(tree.lights.size()) ? 1U : 0U;
    }
    CHECK(differ == 0);
    CHECK(fallen > half / 4);
}
