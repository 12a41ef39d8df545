// Forward shading on the device through textures, holes and glass: the CPU's image.

#include "test_host.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/pipeline.hpp>
#include <gnomon/raster/cpu_backend.hpp>
#include <gnomon/scene.hpp>

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

using namespace gnomon;

namespace {

/// The procedural tree under random textures; of its materials one in four has holes, one in four blends.
struct PaintedTree {
    scene::Scene scene = scene::make_procedural({.name = "tree"}).value();
    scene::Geometry geometry = scene::flatten(scene);
    std::vector<pipeline::Light> lights;

    PaintedTree() {
        std::uint32_t seed = 7;
        auto const next = [&] { return seed = seed * 1664525U + 1013904223U; };
        for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
            scene::Image image{"paint", math::ivec2(32, 21), {}};
            image.rgba.resize(std::size_t{32} * 21 * 4);
            for (std::uint8_t& byte : image.rgba) byte = static_cast<std::uint8_t>(next() >> 24U);
            scene.images.push_back(std::move(image));
            scene.textures.push_back({static_cast<std::uint32_t>(scene.images.size() - 1), math::Wrap::mirror, math::Wrap::repeat});
            scene.materials[i].base_color_texture.texture = static_cast<std::uint32_t>(scene.textures.size() - 1);
            scene.materials[i].alpha_mode = i % 2 != 0 ? scene::AlphaMode::opaque : scene::AlphaMode::mask;
            if (i + 1 == scene.materials.size()) scene.materials[i].alpha_mode = scene::AlphaMode::blend;
        }
        geometry.uv.clear();
        for (math::vec3 const& p : geometry.positions) geometry.uv.emplace_back(p.x * 0.9F, p.y + 0.5F * p.z);
        for (int i = 0; i < 30; ++i) {
            math::dvec3 at(0.0);
            for (math::axis_t axis = 0; axis < 3; ++axis) {
                double const share = static_cast<double>(next() >> 8U) * 0x1p-24;
                at[axis] = static_cast<double>(geometry.bounds.lo[axis]) * (1.0 - share) + static_cast<double>(geometry.bounds.hi[axis]) * share;
            }
            lights.push_back(pipeline::bulb(at + geometry.origin_m, 3.0F));
            lights.back().intensity = 15.0F;
        }
    }
};

struct Painted {
    std::vector<std::vector<math::vec3>> opaque;
    std::vector<math::vec3> glass;
    std::vector<std::vector<math::vec3>> smooth;

    Painted(PaintedTree const& tree, pipeline::Frame const& frame, backend::Backend& device) {
        core::SerialExecutor serial;
        pipeline::Workspace workspace;
        for (std::string_view const name : {"forward", "tiled-forward", "tiled-forward-prez", "clustered-forward"}) {
            auto const* const technique = pipeline::find_lighting_technique(name).value();
            auto const params = pipeline::make_params(*technique).value();
            pipeline::LightingRun const on{frame, tree.lights, params, workspace, device, serial};
            auto output = technique->run(on);
            INFO((output ? std::string() : output.failure().message));
            REQUIRE(output.has_value());
            if (name == "clustered-forward") {
                auto blended = pipeline::shade_transparent(on, output->radiance);
                INFO((blended ? std::string() : blended.failure().message));
                REQUIRE(blended.has_value());
                glass = std::move(blended->image);
                for (bool const edges_only : {false, true}) {
                    auto four = pipeline::shade_antialiased(on, {16, edges_only});
                    INFO((four ? std::string() : four.failure().message));
                    REQUIRE(four.has_value());
                    smooth.push_back(std::move(four->image));
                }
            }
            opaque.push_back(std::move(output->radiance));
        }
    }
};

std::size_t differing(std::vector<math::vec3> const& a, std::vector<math::vec3> const& b) {
    REQUIRE(a.size() == b.size());
    std::size_t differ = 0;
    for (std::size_t i = 0; i < a.size(); ++i) differ += a[i] != b[i] ? 1U : 0U;
    return differ;
}

}  // namespace

TEST_CASE("forward shading gives the CPU's image on a device, through textures, holes and glass", "[vulkan][lighting][forward]") {
    vulkan::test::DeviceBackend on;
    core::SerialExecutor serial;
    raster::CpuBackend cpu(serial);
    PaintedTree const tree;
    math::View const view = scene::make_view(tree.scene.cameras.front(), math::ivec2(128, 96)).value();
    pipeline::Shot const shot{view, pipeline::sun({0.3, -1.0, 0.2}), false, nullptr, pipeline::SampleRule::formula, true};
    auto const frame = pipeline::make_frame(tree.scene, tree.geometry, shot, serial);
    REQUIRE(frame.has_value());
    Painted const ours(tree, *frame, cpu);
    Painted const theirs(tree, *frame, *on.gpu);
    // A pixel may differ only where two surfaces have nearly one depth, or an alpha is at its cutoff.
    for (std::size_t i = 0; i < ours.opaque.size(); ++i) {
        CAPTURE(i);
        CHECK(differing(ours.opaque[i], theirs.opaque[i]) * 1000 <= ours.opaque[i].size());
    }
    std::size_t const glass = differing(ours.glass, theirs.glass);
    std::printf("forward: %zu, %zu, %zu, %zu of %zu samples, with glass %zu of %zu pixels otherwise than on the CPU\n",
                differing(ours.opaque[0], theirs.opaque[0]), differing(ours.opaque[1], theirs.opaque[1]),
                differing(ours.opaque[2], theirs.opaque[2]), differing(ours.opaque[3], theirs.opaque[3]), ours.opaque[0].size(), glass,
                ours.glass.size());
    CHECK(glass * 1000 <= ours.glass.size());
    for (std::size_t i = 0; i < 2; ++i) {
        std::size_t const smooth = differing(ours.smooth[i], theirs.smooth[i]);
        std::printf("four samples: %zu of %zu pixels otherwise than on the CPU\n", smooth, ours.smooth[i].size());
        CHECK(smooth * 1000 <= ours.smooth[i].size());
    }
    std::size_t lit = 0;
    for (math::vec3 const& c : ours.glass) lit += c != math::vec3(0.0F) ? 1U : 0U;
    CHECK(lit > ours.opaque[0].size());  // glass before the background too
    CHECK(on.device->take_messages() == "");
}
