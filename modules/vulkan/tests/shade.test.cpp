// The verb `shade` on the device: the CPU's fragments, counted and blended in the CPU's order.

#include "pass_scenes.hpp"
#include "test_host.hpp"

#include <gnomon/backend/fragment.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/raster/cpu_backend.hpp>
#include <gnomon/vulkan/backend.hpp>

#include "shaders/shade_colors_frag.hpp"

#include <array>
#include <cmath>
#include <string>
#include <vector>

using namespace gnomon;
using namespace gnomon::vulkan::test;

namespace {

struct TintStd {
    std::uint32_t visible;
    float scale;
};

void tint_fragments(backend::KernelData const& data, std::span<backend::Fragment const> fragments,
                    std::span<backend::FragmentColor> out) {
    auto const c = data.constant<TintStd>();
    auto const tints = data.buffer<math::vec4 const>(0);
    backend::TexelView const& ids = data.targets[0];
    for (std::size_t i = 0; i < fragments.size(); ++i) {
        backend::Fragment const& f = fragments[i];
        std::size_t const at = std::size_t{f.y} * static_cast<std::size_t>(ids.size_px.x) + f.x;
        out[i].discarded = c.visible != 0 && ids.layer<std::uint32_t>(0)[at] != f.triangle;
        math::vec4 const& tint = tints[f.triangle % 8];
        out[i].color = {tint.x * c.scale, static_cast<float>(f.x), static_cast<float>(f.y) + tint.y, tint.w};
    }
}

constexpr backend::FragmentKernel tint_kernel{.name = "tint",
                                              .cpu = &tint_fragments,
                                              .spirv = vulkan::test::shade_colors_frag,
                                              .buffers = 1,
                                              .targets = 1,
                                              .constant_bytes = sizeof(TintStd)};

constexpr math::ivec2 tinted_px{96, 64};

/// Two draws, one of them three times by instances, shaded in a few ways one after the other.
struct Tinted {
    std::vector<std::vector<math::vec4>> images;
    std::vector<float> depth;

    Tinted(backend::Backend& device, Soup const& soup, math::Depth direction) {
        std::array<backend::Draw, 2> draws{soup.draw(), soup.draw()};
        std::array<math::mat4, 3> moves;
        for (std::size_t i = 0; i < 3; ++i) {
            moves[i] = math::mat4(1.0F);
            moves[i][3] = math::vec4(static_cast<float>(i) - 1.0F, 0.5F, -1.0F, 1.0F);
        }
        draws[1].instances = core::StridedSpan<math::mat4>(std::span<math::mat4 const>(moves));
        draws[1].first_triangle = static_cast<std::uint32_t>(backend::triangle_count(draws[0]));
        draws[1].cull = backend::Cull::back;
        auto const list = *device.keep(draws);
        auto const target = *device.make_target({.size_px = tinted_px, .layers = 2, .triangle_ids = true, .color = true});
        auto const other = *device.make_target({.size_px = tinted_px, .triangle_ids = true});
        std::array<math::vec4, 8> tints;
        for (std::size_t i = 0; i < 8; ++i) {
            auto const k = static_cast<float>(i);
            tints[i] = math::vec4(0.5F + k, 0.25F * k, 0.0F, 0.125F * k);
        }
        auto const buffer = *device.make_buffer(sizeof tints);
        REQUIRE(device.write(buffer, 0, backend::bytes_of(tints)));
        backend::PassLayer layer = layer_of(camera(tinted_px, direction));
        REQUIRE(device.draw(list, other, {&layer, 1}));
        auto const shade = [&](backend::TargetId ids_of, TintStd const& constants, backend::FragmentCall call) {
            backend::TargetBinding const ids{ids_of, backend::Plane::triangle};
            call.buffers = {&buffer, 1};
            call.targets = {&ids, 1};
            call.constants = backend::bytes_of(constants);
            auto const shaded = device.shade(list, target, layer, tint_kernel, call);
            INFO((shaded ? std::string() : shaded.failure().message));
            REQUIRE(shaded.has_value());
            CHECK(shaded->triangles == 4 * backend::triangle_count(draws[0]));
            images.emplace_back(std::size_t{96} * 64);
            REQUIRE(device.read({target, layer.layer, backend::Plane::color, {0, 0, tinted_px.x, tinted_px.y}},
                                std::as_writable_bytes(std::span(images.back()))));
        };
        images.reserve(8);
        using backend::Blend;
        using backend::FragmentTest;
        layer.layer = 1;
        shade(other, {0, 1.0F}, {.test = FragmentTest::nearer});
        layer.scissor = backend::Rect{10, 12, 60, 40};
        shade(other, {0, 2.0F}, {.test = FragmentTest::nearer, .color = backend::Load::keep});
        layer.scissor = {};
        shade(other, {0, 1.0F}, {.test = FragmentTest::nearer, .blend = Blend::over});
        depth.resize(std::size_t{96} * 64);
        REQUIRE(device.read({target, 1, backend::Plane::depth, {0, 0, tinted_px.x, tinted_px.y}},
                            std::as_writable_bytes(std::span(depth))));
        layer.layer = 0;
        REQUIRE(device.draw(list, target, {&layer, 1}));
        layer.load = backend::Load::keep;
        shade(target, {1, 1.0F}, {.test = FragmentTest::visible});
        shade(target, {0, 1.0F}, {.test = FragmentTest::behind_nothing, .color = backend::Load::keep});
        REQUIRE(device.finish());
    }
};

}  // namespace

TEST_CASE("fragments get the CPU's colours on a device, in the CPU's order", "[vulkan][shade]") {
    DeviceBackend on;
    core::SerialExecutor serial;
    raster::CpuBackend cpu(serial);
    for (math::Depth const direction : {math::Depth::reversed, math::Depth::forward}) {
        Soup const soup = make_soup(direction == math::Depth::reversed ? 11U : 12U, 120, 0.8F);
        Tinted const ours(cpu, soup, direction);
        Tinted const theirs(*on.gpu, soup, direction);
        REQUIRE(ours.images.size() == theirs.images.size());
        for (std::size_t i = 0; i < ours.images.size(); ++i) {
            CAPTURE(i);
            std::size_t differ = 0;
            std::size_t shaded = 0;
            for (std::size_t p = 0; p < ours.images[i].size(); ++p) {
                differ += ours.images[i][p] != theirs.images[i][p] ? 1U : 0U;
                shaded += ours.images[i][p] != math::vec4(0.0F) ? 1U : 0U;
            }
            CHECK(differ == 0);
            CHECK(shaded > 1000);
        }
    }
    CHECK(on.device->take_messages() == "");
}

TEST_CASE("a fragment kernel whose shader is otherwise than it says is refused", "[vulkan][shade]") {
    DeviceBackend on;
    Soup const soup = make_soup(1, 4, 0.5F);
    backend::Draw const draw = soup.draw();
    auto const list = *on.gpu->keep({&draw, 1});
    auto const target = *on.gpu->make_target({.size_px = tinted_px, .color = true});
    static constexpr backend::FragmentKernel no_buffers{.name = "none", .cpu = &tint_fragments, .spirv = vulkan::test::shade_colors_frag};
    static constexpr backend::FragmentKernel no_gpu_half{.name = "host", .cpu = &tint_fragments, .spirv = {}};
    for (backend::FragmentKernel const* const kernel : {&no_buffers, &no_gpu_half}) {
        auto const refused = on.gpu->shade(list, target, layer_of(camera(tinted_px)), *kernel, {});
        REQUIRE_FALSE(refused.has_value());
        CHECK(refused.failure().code == backend::Error::missing_feature);
        CHECK(refused.failure().message.find(kernel->name) != std::string::npos);
    }
    REQUIRE(on.gpu->finish());
    CHECK(on.device->take_messages() == "");
}
