// Transparent surfaces through the grid, against every light on every fragment, drawn triangle by triangle.

#include <gnomon/check/check.hpp>
#include <gnomon/lights/shade.hpp>
#include <gnomon/pipeline/lighting.hpp>
#include <gnomon/raster/cpu_backend.hpp>
#include <gnomon/scene.hpp>

#include "../src/lighting/lighting.hpp"
#include "../src/lighting/surface_table.hpp"
#include "../src/lighting/transparent.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace {

using namespace gnomon;

/// Crossed panes of glass, each of its own colour and opacity, before a wall that fills a part of the picture.
struct Panes {
    scene::Scene scene;
    scene::Geometry geometry;
    std::vector<pipeline::Light> lights;
    math::View view;

    Panes() {
        scene.materials.resize(8);
        for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
            auto const k = static_cast<float>(i);
            scene.materials[i].base_color = math::vec4(0.9F - 0.1F * k, 0.2F + 0.08F * k, 0.5F, i == 0 ? 1.0F : 0.15F + 0.1F * k);
            scene.materials[i].alpha_mode = i == 0 ? scene::AlphaMode::opaque : scene::AlphaMode::blend;
            scene.materials[i].double_sided = true;
        }
        quad({-4, -2, -9}, {5, 0, 0}, {0, 3, 0}, 0);
        quad({-5, -2.5F, -4}, {10, 0, -8}, {0, 0.2F, 0}, 0);
        std::uint32_t seed = 3;
        auto const unit = [&] { return static_cast<float>((seed = seed * 1664525U + 1013904223U) >> 8U) * 0x1p-24F; };
        for (std::uint32_t i = 0; i < 24; ++i) {
            float const x = unit() * 8.0F - 4.0F;
            float const y = unit() * 4.0F - 2.0F;
            float const z = -3.0F - unit() * 9.0F;
            float const turn = unit() * 3.0F;
            quad({x, y, z}, {std::cos(turn) * 2.0F, 0.3F, std::sin(turn) * 2.0F}, {0.2F, 1.5F, 0.4F}, 1 + i % 7);
        }
        for (int i = 0; i < 60; ++i) {
            double const x = static_cast<double>(unit()) * 10.0 - 5.0;
            double const y = static_cast<double>(unit()) * 6.0 - 3.0;
            double const z = -2.0 - static_cast<double>(unit()) * 11.0;
            pipeline::Light light = pipeline::bulb(math::dvec3(x, y, z), 1.8F);
            light.intensity = 3.0F;
            lights.push_back(light);
        }
        geometry.bounds = {math::vec3(-6, -4, -16), math::vec3(6, 4, -1)};
        view = math::make_perspective({.eye_m = math::dvec3(0, 0, 0), .target_m = math::dvec3(0, 0, -5), .near_m = 0.3, .far_m = 60.0,
                                       .size_px = math::ivec2(144, 96)})
                   .value();
    }
    void quad(math::vec3 const& at, math::vec3 const& u, math::vec3 const& v, std::uint32_t material) {
        auto const first = static_cast<std::uint32_t>(geometry.positions.size());
        math::vec3 const normal = glm::normalize(glm::cross(u, v));
        for (math::vec3 const& p : {at, at + u, at + v, at + u + v}) {
            geometry.positions.push_back(p);
            geometry.normals.push_back(normal);
            geometry.uv.emplace_back(0.0F, 0.0F);
        }
        auto const begun = static_cast<std::uint32_t>(geometry.triangle_material.size());
        for (std::uint32_t const k : {0U, 1U, 2U, 2U, 1U, 3U}) geometry.indices.push_back(first + k);
        geometry.triangle_material.insert(geometry.triangle_material.end(), 2, material);
        geometry.ranges.push_back({.first_triangle = begun, .triangle_count = 2, .material = material});
    }
    [[nodiscard]] pipeline::Frame frame() const {
        pipeline::Shot shot{view, pipeline::sun({0.3, -1.0, 0.2}), false, nullptr, pipeline::SampleRule::formula, true};
        core::SerialExecutor serial;
        return pipeline::make_frame(scene, geometry, shot, serial).value();
    }
};

/// Every light on every fragment, in the same order.
struct BruteForce {
    std::vector<math::vec3> image;
    std::vector<std::uint32_t> fragments;

    BruteForce(Panes const& panes, pipeline::Frame const& frame, std::span<math::vec3 const> radiance) {
        core::SerialExecutor serial;
        raster::CpuBackend device(serial);
        std::size_t const pixels = static_cast<std::size_t>(frame.view.size_px.x * frame.view.size_px.y);
        backend::Rect const all{0, 0, frame.view.size_px.x, frame.view.size_px.y};
        auto const target = *device.make_target({.size_px = frame.view.size_px, .triangle_ids = true});
        backend::PassLayer layer = pipeline::layer_of(frame);
        std::vector<float> held(pixels), depth(pixels);
        std::vector<std::uint32_t> ids(pixels);
        auto const draw = [&](std::span<backend::Draw const> draws, std::vector<float>& to) {
            auto const list = *device.keep(draws);
            REQUIRE(device.draw(list, target, {&layer, 1}));
            REQUIRE(device.read({target, 0, backend::Plane::depth, all}, std::as_writable_bytes(std::span(to))));
            REQUIRE(device.read({target, 0, backend::Plane::triangle, all}, std::as_writable_bytes(std::span(ids))));
            REQUIRE(device.release(list));
        };
        draw(pipeline::make_draws(panes.scene, panes.geometry, raster::Cull::none, pipeline::Blended::left_out).draws, held);
        pipeline::PreparedLights prepared;
        pipeline::prepare_lights(frame, panes.lights, prepared);
        pipeline::MaterialTable const table(panes.scene, {});
        auto const vertices = pipeline::make_vertices(panes.geometry);
        auto const triangles = pipeline::make_triangles(panes.geometry);
        pipeline::SurfaceData const surfaces{vertices, triangles, table.materials, table.texels,
                                             pipeline::make_camera_rays(frame.view, panes.geometry.origin_m)};
        std::vector<math::vec4> color(pixels, math::vec4(0.0F));
        fragments.assign(pixels, 0);
        for (std::uint32_t const t : pipeline::sort_back_to_front(frame)) {
            backend::Draw one{.positions = std::span<math::vec3 const>(panes.geometry.positions),
                              .indices = std::span<std::uint32_t const>(panes.geometry.indices).subspan(std::size_t{t} * 3, 3)};
            draw({&one, 1}, depth);
            for (std::size_t i = 0; i < pixels; ++i) {
                if (ids[i] != 0 || !(depth[i] > held[i])) continue;
                auto const x = static_cast<float>(i % static_cast<std::size_t>(frame.view.size_px.x)) + 0.5F;
                auto const y = static_cast<float>(i / static_cast<std::size_t>(frame.view.size_px.x)) + 0.5F;
                math::vec4 const c = shaded(surfaces.at(t, {x, y}), frame, prepared.shaded);
                float const rest = 1.0F - c.w;
                color[i] = {c.x + color[i].x * rest, c.y + color[i].y * rest, c.z + color[i].z * rest, c.w + color[i].w * rest};
                ++fragments[i];
            }
        }
        for (std::size_t i = 0; i < pixels; ++i) {
            std::uint32_t const s = frame.sample_of_pixel[i];
            math::vec3 const under = s != pipeline::no_sample ? radiance[s] : math::vec3(0.0F);
            image.push_back(math::vec3(color[i].x, color[i].y, color[i].z) + under * (1.0F - color[i].w));
        }
    }

    static math::vec4 shaded(pipeline::SurfaceStd const& s, pipeline::Frame const& frame, std::span<lights::ShadedLight const> lights) {
        using Vec3 = formula::Vec3<float>;
        math::vec3 const eye = math::to_float(frame.view.eye_m - frame.geometry->origin_m);
        Vec3 const p(s.position);
        formula::GnSurface<float> const surface{p, Vec3(s.normal), gn_unit_or_up(Vec3(eye) - p), Vec3(s.diffuse), Vec3(s.specular), s.shininess};
        Vec3 sum(s.emissive);
        for (lights::ShadedLight const& light : lights) sum = sum + gn_shade(light, surface);
        math::vec3 const c = math::vec3(sum) * s.opacity;
        return {c.x, c.y, c.z, s.opacity};
    }
};

}  // namespace

TEST_CASE("transparent surfaces get the image of all lights on all fragments, through tiles and clusters, over a deferred image",
          "[pipeline][lighting][transparent]") {
    Panes const panes;
    pipeline::Frame const frame = panes.frame();
    auto const* const deferred = pipeline::find_lighting_technique("tiled-deferred").value();
    core::SerialExecutor serial;
    pipeline::Workspace workspace;
    pipeline::Params const params = pipeline::make_params(*deferred).value();
    pipeline::LightingRun const on{frame, panes.lights, params, workspace, workspace.own_backend(serial), serial};
    auto const opaque = deferred->run(on);
    REQUIRE(opaque.has_value());
    BruteForce const truth(panes, frame, opaque->radiance);
    std::uint64_t fragments = 0;
    for (std::uint32_t const n : truth.fragments) fragments += n;
    REQUIRE(fragments > truth.fragments.size() / 4);
    REQUIRE(*std::max_element(truth.fragments.begin(), truth.fragments.end()) >= 4);  // layers on layers
    std::vector<std::uint64_t> computations;
    for (pipeline::TransparencyConfig const config :
         {pipeline::TransparencyConfig{16, false, false}, {16, false, true}, {16, true, false}}) {
        CAPTURE(config.clusters, config.nearest);
        auto const output = pipeline::shade_transparent(on, opaque->radiance, config);
        INFO((output ? std::string() : output.failure().message));
        REQUIRE(output.has_value());
        std::size_t differ = 0;
        for (std::size_t i = 0; i < truth.image.size(); ++i) differ += output->image[i] != truth.image[i] ? 1U : 0U;
        CHECK(differ == 0);
        computations.push_back(output->counts.front().value);
        CHECK(computations.back() * 4 < fragments * panes.lights.size());
    }
    CHECK(computations[1] < computations[0]);  // the nearest transparent depth takes lights away
    CHECK(computations[2] < computations[0]);
}

TEST_CASE("a frame that leaves blended surfaces out shows what is behind them", "[pipeline][transparent]") {
    Panes const panes;
    pipeline::Frame const frame = panes.frame();
    for (std::uint32_t const t : frame.samples.triangle) CHECK(panes.geometry.triangle_material[t] == 0);
    auto const order = pipeline::sort_back_to_front(frame);
    CHECK(order.size() == 48);
    float before = std::numeric_limits<float>::infinity();
    for (std::uint32_t const t : order) {
        float sum = 0.0F;
        for (std::size_t k = 0; k < 3; ++k) sum -= panes.geometry.positions[panes.geometry.indices[std::size_t{t} * 3 + k]].z;
        CHECK(sum <= before + 1e-4F);
        before = sum;
    }
}
