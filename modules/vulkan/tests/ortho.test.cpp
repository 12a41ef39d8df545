#include "ortho_rig.hpp"

#include <gnomon/check/check.hpp>

#include <cstdio>

using namespace gnomon;
using namespace gnomon::vulkan::test;

namespace {

constexpr std::uint32_t ortho_layers = 48;

backend::TargetConfig ortho_config(Random& random) {
    backend::TargetConfig config{.size_px = {96, 80}, .layers = ortho_layers};
    config.size_px.x -= static_cast<std::int32_t>(random.next() % 30);
    config.depth = random.next() % 2 == 0 ? backend::DepthFormat::f32 : backend::DepthFormat::unorm16;
    return config;
}

/// A draw and two passes of one layer each for every layer: clear all and draw, then keep and draw into a part.
struct OrthoFrame {
    OrthoScene scene;
    OrthoPasses passes{2};

    OrthoFrame(Random& random, backend::TargetConfig const& config, std::uint64_t kinds_from) {
        constexpr double distances[] = {0.0, 1e4, 1e7};
        for (std::uint32_t layer = 0; layer < config.layers; ++layer) {
            bool const plain = random.next() % 3 == 0;
            double const far_m = distances[random.next() % 3];
            OrthoView view = random_view(random, config, far_m, plain);
            view.layer.layer = layer;
            view.layer.depth = random.next() % 2 == 0 ? math::Depth::forward : math::Depth::reversed;
            view.layer.range = random.next() % 2 == 0 ? backend::DepthRange::clamp : backend::DepthRange::clip;
            for (std::size_t pass = 0; pass < 2; ++pass) {
                add_draw(random, view, kinds_from + layer + 5 * pass);
                view.layer.draws = std::span<std::uint32_t const>(&scene.places.back(), 1);
                passes[pass].push_back(view.layer);
                view.layer.load = backend::Load::keep;
                auto const x = static_cast<std::int32_t>(random.next() % 40);
                auto const y = static_cast<std::int32_t>(random.next() % 40);
                view.layer.scissor = backend::Rect{x - 5, y - 5, 50, 60};
                if (random.next() % 4 == 0) view.layer.light.origin_x += 3;
            }
        }
    }

  private:
    void add_draw(Random& random, OrthoView const& view, std::uint64_t kind) {
        Soup& soup = scene.soups.emplace_back();
        auto const count = 1 + random.next() % 6;
        for (std::uint64_t i = 0; i < count; ++i) add_triangle(soup, random, view, kind);
        backend::Draw draw = soup.draw();
        constexpr backend::Cull culls[] = {backend::Cull::none, backend::Cull::none, backend::Cull::back, backend::Cull::front};
        draw.cull = culls[random.next() % 4];
        if (random.next() % 3 == 0) draw.alpha_test = add_alpha_test(scene, random, soup);
        scene.places.push_back(static_cast<std::uint32_t>(scene.draws.size()));
        scene.draws.push_back(draw);
    }
};

OrthoDifference compare_frames(OrthoRig& rig, std::uint64_t seed, int frames) {
    OrthoDifference sum;
    for (int i = 0; i < frames; ++i) {
        Random random{seed + static_cast<std::uint64_t>(i)};
        backend::TargetConfig const config = ortho_config(random);
        OrthoFrame const frame(random, config, random.next());
        auto const cpu = draw_ortho_on_cpu(frame.scene.draws, config, frame.passes);
        auto const gpu = rig.draw(frame.scene.draws, config, frame.passes);
        OrthoDifference const d = ortho_difference(cpu, gpu, config.depth == backend::DepthFormat::f32 ? 1.0F : 65535.0F);
        if (d.differing != 0) std::printf("frame %d: %s\n", i, d.text().c_str());
        sum += d;
    }
    return sum;
}

}  // namespace

TEST_CASE("integer passes are the CPU's, bit for bit", "[vulkan][ortho]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    OrthoRig rig(*device);
    CHECK(rig.pipelines().edges_by_device());
    OrthoDifference const d = compare_frames(rig, 100, 10);
    std::printf("ortho, edges by the device: %s\n", d.text().c_str());
    CHECK(d.differing == 0);
    CHECK(d.written > d.texels / 10);
    CHECK(device->take_messages() == "");
}

TEST_CASE("integer passes are the CPU's where the fragment shader finds what is covered", "[vulkan][ortho]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    OrthoRig rig(*device, {.edges_by_device = false});
    OrthoDifference const d = compare_frames(rig, 200, 6);
    std::printf("ortho, edges by the shader: %s\n", d.text().c_str());
    CHECK(d.differing == 0);
    CHECK(d.written > d.texels / 10);
    CHECK(device->take_messages() == "");
}
