// Passes on hard cases: alpha tests, depth bias, what cannot be recorded, what recording costs.

#include "null_driver.hpp"
#include "pass_rig.hpp"
#include "pass_scenes.hpp"

#include <gnomon/check/allocations.hpp>
#include <gnomon/check/check.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

using namespace gnomon;
using namespace gnomon::vulkan::test;

namespace {

/// A quad that fills the view at a slant, its texture repeated a few times.
struct Leaf {
    std::array<math::vec3, 4> positions{math::vec3(-1.2F, -1.1F, -2), math::vec3(1.3F, -1, -2.5F),
                                        math::vec3(1.2F, 1.4F, -4), math::vec3(-1.4F, 1.2F, -3)};
    std::array<math::vec2, 4> uv{math::vec2(-0.7F, -0.3F), math::vec2(1.9F, 0.1F), math::vec2(2.2F, 1.6F), math::vec2(-0.2F, 1.3F)};
    std::array<std::uint32_t, 6> indices{0, 1, 2, 0, 2, 3};
    std::vector<std::uint8_t> texels;
    backend::AlphaTest test;

    Leaf(std::uint64_t seed, math::ivec2 size_px, math::Wrap wrap, std::int32_t channels) {
        Random random{seed};
        auto const count = static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y);
        for (std::size_t i = 0; i < count * static_cast<std::size_t>(channels); ++i)
            texels.push_back(static_cast<std::uint8_t>(random.next() >> 56U));
        test.uv = std::span<math::vec2 const>(uv);
        test.texture = {texels, size_px, wrap, wrap == math::Wrap::repeat ? math::Wrap::mirror : wrap, channels};
        test.factor = 0.9;
        test.cutoff = 0.4;
    }
    [[nodiscard]] backend::Draw draw() const {
        return {.positions = std::span<math::vec3 const>(positions),
                .indices = std::span<std::uint32_t const>(indices),
                .alpha_test = &test};
    }
};

}  // namespace

TEST_CASE("alpha-tested draws are the CPU's, but for a pixel in 4,000 where the device has to decide in float", "[vulkan][pass]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    vulkan::Features few = device->features();
    few.geometry_shader = few.layer_from_vertex_shader = few.depth_clamp = false;
    for (vulkan::Features const& features : {device->features(), few}) {
        std::uint64_t pixels = 0;
        std::uint64_t differ = 0;
        bool const exact = features.shader_float64 && features.geometry_shader;
        PassRig rig(*device, device->gpu_with(features));
        for (int i = 0; i < 6; ++i) {
            Leaf const leaf(static_cast<std::uint64_t>(i), {13 + 7 * i, 9 + 5 * i}, static_cast<math::Wrap>(i % 3), i % 2 == 0 ? 4 : 1);
            Leaf const behind(40, {16, 16}, math::Wrap::clamp, 4);
            std::array<backend::Draw, 2> draws{leaf.draw(), behind.draw()};
            draws[1].first_triangle = 2;
            backend::TargetConfig const config{.size_px = {200, 200}, .triangle_ids = i < 3};
            backend::PassLayer layer = layer_of(camera(config.size_px));
            layer.range = i % 2 == 0 ? backend::DepthRange::clamp : backend::DepthRange::clip;
            std::vector<std::vector<backend::PassLayer>> const passes{{layer}};
            Pixels const cpu = draw_on_cpu(draws, config, passes);
            Difference const d = difference_of(cpu, rig.draw_all(draws, config, passes), 0.0F);
            INFO(d.text());
            CHECK(d.covered > 5000);
            CHECK(d.beyond == 0);
            pixels += d.covered;
            differ += d.coverage + d.other_surface + d.other_id;
        }
        INFO(std::to_string(differ) + " of " + std::to_string(pixels));
        CHECK(differ <= (exact ? 0 : pixels / 4000));
    }
    CHECK(device->live().total() == 0);
    CHECK(device->take_messages() == "");
}

namespace {

/// Pixels of a leaf that the device decides otherwise than the CPU, although alpha is farther than `slack` from the
/// cutoff.
std::size_t wrong_pixels(PassRig& rig, Leaf& leaf, double slack) {
    backend::Draw const draw = leaf.draw();
    backend::TargetConfig const config{.size_px = {256, 256}};
    std::vector<std::vector<backend::PassLayer>> const passes{{layer_of(camera(config.size_px))}};
    Pixels const gpu = rig.draw_all({&draw, 1}, config, passes);
    double const cutoff = leaf.test.cutoff;
    leaf.test.cutoff = cutoff - slack;
    Pixels const more = draw_on_cpu({&draw, 1}, config, passes);
    leaf.test.cutoff = cutoff + slack;
    Pixels const less = draw_on_cpu({&draw, 1}, config, passes);
    leaf.test.cutoff = cutoff;
    std::size_t wrong = 0;
    std::size_t open = 0;
    for (std::size_t p = 0; p < gpu.depth.size(); ++p) {
        wrong += gpu.depth[p] != 0.0F && more.depth[p] == 0.0F ? 1U : 0U;
        wrong += gpu.depth[p] == 0.0F && less.depth[p] != 0.0F ? 1U : 0U;
        open += (more.depth[p] != 0.0F) != (less.depth[p] != 0.0F) ? 1U : 0U;
    }
    CHECK(open < 800);
    return wrong;
}

}  // namespace

TEST_CASE("alpha tests are the CPU's in double, and err by no more than their bound in float", "[vulkan][pass]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    vulkan::Features without = device->features();
    without.shader_float64 = false;
    PassRig exact(*device, device->gpu());
    PassRig single(*device, device->gpu_with(without));
    for (int i = 0; i < 5; ++i) {
        math::ivec2 const texture_px{i == 4 ? 1024 : 16 << i, i == 3 ? 1000 : 32};
        Leaf leaf(static_cast<std::uint64_t>(i), texture_px, static_cast<math::Wrap>(i % 3), 1);
        // Texels off by 2^-20 of the farthest coordinate; alpha changes by at most 1 from one to the next.
        double const slack = (2.2 * texture_px.x + 1.6 * texture_px.y) * 0x1p-20 + 0x1p-20;
        CAPTURE(i);
        CHECK(wrong_pixels(single, leaf, slack) == 0);
        if (device->features().shader_float64 && device->features().geometry_shader)
            CHECK(wrong_pixels(exact, leaf, 0.0) == 0);
    }
    CHECK(device->take_messages() == "");
}

TEST_CASE("alpha at the cutoff passes, a hair below it does not", "[vulkan][pass]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    PassRig rig(*device, device->gpu());
    for (int alpha : {0, 1, 77, 128, 254, 255})
        for (int beside : {-1, 0, 1}) {
            Leaf leaf(1, {4, 4}, math::Wrap::repeat, 1);
            std::fill(leaf.texels.begin(), leaf.texels.end(), static_cast<std::uint8_t>(alpha));
            leaf.test.factor = 0.75;
            double const at = alpha / 255.0 * 0.75;
            leaf.test.cutoff = beside == 0 ? at : std::nextafter(static_cast<float>(at), beside > 0 ? 2.0F : -1.0F);
            backend::Draw const draw = leaf.draw();
            backend::TargetConfig const config{.size_px = {32, 32}};
            Pixels const drawn = rig.draw_all({&draw, 1}, config, std::vector<std::vector<backend::PassLayer>>{{layer_of(camera(config.size_px))}});
            bool const covers = std::any_of(drawn.depth.begin(), drawn.depth.end(), [](float z) { return z != 0.0F; });
            INFO(std::to_string(alpha) + " " + std::to_string(beside));
            CHECK(covers == (at >= leaf.test.cutoff));
        }
    CHECK(device->take_messages() == "");
}

TEST_CASE("a positive bias moves depths away from the eye, by steps and by slope", "[vulkan][pass]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    std::array<math::vec3, 3> const corners{math::vec3(-3, -3, 0), math::vec3(3, -3, 0), math::vec3(0, 3, 0)};
    backend::Draw const draw{.positions = std::span<math::vec3 const>(corners), .indices = {}};
    vulkan::Features no_clamp = device->features();
    no_clamp.depth_clamp = false;
    for (vulkan::Features const& features : {device->features(), no_clamp}) {
        PassRig rig(*device, device->gpu_with(features));
        vulkan::DrawList list = rig.keep({&draw, 1});
        vulkan::Target target = rig.make({.size_px = {64, 64}});
        for (math::Depth depth : {math::Depth::reversed, math::Depth::forward})
            for (backend::DepthRange range : {backend::DepthRange::clip, backend::DepthRange::clamp}) {
                // z = 0.6 + x / 8: a step of 1/256 a pixel, in the power of two [0.5, 1).
                backend::PassLayer layer;
                layer.depth = depth;
                layer.range = range;
                layer.clip_from_relative[0][2] = 0.125F;
                layer.clip_from_relative[3][2] = 0.75F;
                auto const middle = [&](vulkan::DepthBias const& bias) {
                    rig.draw(list, target, {&layer, 1}, bias);
                    return static_cast<double>(rig.read(target).depth[32 * 64 + 32]);
                };
                double const away = depth == math::Depth::reversed ? -1.0 : 1.0;
                double const plain = middle({});
                double const stepped = (middle({.constant = 1000.0F}) - plain) * away;
                double const sloped = (middle({.slope = 2.0F}) - plain) * away;
                CHECK(std::abs(stepped - 1000.0 * 0x1p-24) <= 1e-6);
                CHECK(std::abs(sloped - 2.0 / 256.0) <= 1e-6);
            }
    }
    CHECK(device->take_messages() == "");
}

TEST_CASE("what cannot be recorded is refused with the reason, and nothing is recorded", "[vulkan][pass]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    PassRig rig(*device, device->gpu(), {.unorm16 = false, .clamp = false});
    Soup const soup = make_soup(3, 10, 0.8F);
    backend::Draw const draw = soup.draw();
    vulkan::DrawList list = rig.keep({&draw, 1});
    vulkan::Target target = rig.make({.size_px = {8, 8}, .layers = 2});
    vulkan::Target codes = rig.make({.size_px = {8, 8}, .depth = backend::DepthFormat::unorm16});
    backend::PassLayer layer;
    VkCommandBuffer commands = device->begin();
    CHECK(vulkan::record_pass(commands, list, codes, {&layer, 1}).failure().message.find("unorm16") != std::string::npos);
    layer.range = backend::DepthRange::clamp;
    CHECK(vulkan::record_pass(commands, list, target, {&layer, 1}).failure().message.find("clamp") != std::string::npos);
    layer.range = backend::DepthRange::clip;
    layer.layer = 2;
    CHECK(vulkan::record_pass(commands, list, target, {&layer, 1}).failure().code == vulkan::Error::bad_argument);
    layer.layer = 0;
    layer.viewport = backend::Rect{0, 0, 1 << 20, 5};
    CHECK(vulkan::record_pass(commands, list, target, {&layer, 1}).failure().code == vulkan::Error::too_large);
    CHECK(target.layout() == VK_IMAGE_LAYOUT_UNDEFINED);
    CHECK(!vulkan::make_draw_list(rig.pipelines(), {&draw, 1}, {.max_layers = 0}));
    device->submit_and_wait();
    CHECK(device->take_messages() == "");
}

TEST_CASE("recording a frame allocates nothing; its calls do not depend on the number of draws", "[vulkan][pass]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    vulkan::GpuRef const gpu = null_gpu(device->gpu()->properties, device->features());
    auto const pipelines = vulkan::make_pass_pipelines(gpu);
    REQUIRE(pipelines);
    Soup const soup = make_soup(3, 10, 0.8F);
    std::vector<math::mat4> places(3, math::mat4(1.0F));
    std::uint64_t calls_of[2] = {};
    std::string times;
    for (std::size_t n : {std::size_t{12}, std::size_t{3000}}) {
        std::vector<backend::Draw> draws(n, soup.draw());
        for (std::size_t i = 0; i < n; ++i) {
            draws[i].cull = static_cast<backend::Cull>(i % 3);
            if (i % 5 == 0) draws[i].instances = core::StridedSpan<math::mat4>(std::span<math::mat4 const>(places));
        }
        auto list = vulkan::make_draw_list(*pipelines, draws);
        auto target = vulkan::make_target(gpu, {.size_px = {64, 64}, .layers = 6});
        REQUIRE(list);
        REQUIRE(target);
        std::vector<backend::PassLayer> layers(6);
        for (std::uint32_t i = 0; i < 6; ++i) layers[i].layer = i;
        VkCommandBuffer const commands = VK_NULL_HANDLE;
        std::uint64_t const before = check::allocations_made();
        std::uint64_t const makes = null_driver::counts.makes;
        double us = 1e9;
        std::uint64_t calls = 0;
        for (int frame = 0; frame < 1000; ++frame) {
            auto const start = std::chrono::steady_clock::now();
            auto const counts = vulkan::record_pass(commands, *list, *target, layers);
            calls += counts ? counts->draw_calls : 0;
            target->prepare(commands, vulkan::TargetUse::sample);
            us = std::min(us, std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
        }
        CHECK(check::allocations_made() == before);
        CHECK(null_driver::counts.makes == makes);
        calls_of[n > 12 ? 1 : 0] = calls / 1000;
        CHECK(us < 1000.0);
        times += std::to_string(n) + " draws into 6 layers: " + std::to_string(us) + " us; ";
    }
    std::printf("recording a pass of %s\n", times.c_str());
    CHECK(calls_of[0] == 3);
    CHECK(calls_of[1] == 3);
}
