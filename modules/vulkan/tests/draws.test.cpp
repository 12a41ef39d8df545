#include "pass_rig.hpp"
#include "pass_scenes.hpp"

#include <gnomon/check/check.hpp>

#include <array>
#include <limits>

using namespace gnomon;
using namespace gnomon::vulkan::test;

TEST_CASE("bad data is left out and counted, and changes nothing else", "[vulkan][draws]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    PassRig rig(*device, device->gpu());
    Soup soup = make_soup(3, 100, 0.8F);
    soup.indices[10] = 100000;
    soup.indices[31] = 0xFFFFFFFFU;
    soup.positions[soup.indices[60]].y = std::numeric_limits<float>::quiet_NaN();
    soup.positions[soup.indices[90]].x = std::numeric_limits<float>::infinity();
    soup.positions[soup.indices[120]].z = 1e30F;
    soup.indices.push_back(1);
    Soup const other = make_soup(4, 20, 0.8F);
    backend::AlphaTest const broken;
    std::vector<std::uint16_t> const narrow{0, 1, 2, 3, 4, 5};
    std::array<backend::Draw, 5> draws{soup.draw(), other.draw(), other.draw(), backend::Draw{}, soup.draw()};
    draws[1].alpha_test = &broken;
    draws[2].indices = std::span<std::uint16_t const>(narrow);
    draws[2].first_triangle = 77;
    draws[4].positions = {};
    backend::TargetConfig const config{.size_px = {120, 120}, .triangle_ids = true};
    std::vector<std::vector<backend::PassLayer>> const passes{{layer_of(camera(config.size_px))}};
    Difference const d = difference_of(draw_on_cpu(draws, config, passes), rig.draw_all(draws, config, passes), 0.0F);
    INFO(d.text());
    CHECK(d.covered > 3000);
    CHECK(d.coverage + d.other_surface + d.other_id + d.beyond <= 2);
    vulkan::DrawList const list = rig.keep(draws);
    CHECK(list.faults().bad_index_triangles == 2 + 100);
    CHECK(list.faults().not_finite_triangles >= 2);
    CHECK(list.faults().loose_indices == 2);
    CHECK(list.faults().broken_alpha_tests == 1);
    CHECK(device->take_messages() == "");
}

TEST_CASE("moved positions are drawn where they went", "[vulkan][draws]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    PassRig rig(*device, device->gpu());
    Soup soup = make_soup(3, 80, 0.8F);
    Soup const still = make_soup(8, 30, 0.8F);
    std::array<backend::Draw, 2> draws{soup.draw(), still.draw()};
    backend::TargetConfig const config{.size_px = {120, 120}};
    std::vector<std::vector<backend::PassLayer>> const passes{{layer_of(camera(config.size_px))}};
    vulkan::DrawList list = rig.keep(draws);
    vulkan::Target target = rig.make(config);
    auto ring = vulkan::HostRing::make(rig.gpu(), {.bytes_per_frame = 4096, .frames = 2});
    REQUIRE(ring);
    for (std::uint64_t frame = 0; frame < 5; ++frame) {
        for (math::vec3& p : soup.positions) p = p + math::vec3(0.1F, -0.05F, 0.03F);
        REQUIRE(ring->begin_frame({frame, frame}));
        VkCommandBuffer commands = device->begin();
        auto const moved = vulkan::record_update(commands, list, 0, std::span<math::vec3 const>(soup.positions), *ring);
        REQUIRE(moved);
        CHECK(*moved == 0);
        REQUIRE(vulkan::record_pass(commands, list, target, passes[0]));
        CHECK(vulkan::record_update(commands, list, 2, std::span<math::vec3 const>(soup.positions), *ring).failure().code ==
              vulkan::Error::bad_argument);
        CHECK(vulkan::record_update(commands, list, 0, std::span<math::vec3 const>(soup.positions), *ring).failure().code ==
              vulkan::Error::too_large);
        REQUIRE(ring->flush());
        device->submit_and_wait();
        Difference const d = difference_of(draw_on_cpu(draws, config, passes), rig.read(target), 0.0F);
        INFO(d.text());
        CHECK(d.covered > 1000);
        CHECK(d.coverage + d.other_surface + d.beyond <= 2);
    }
    CHECK(device->take_messages() == "");
}

TEST_CASE("whichever call fails, a list, a target, the pipelines and the queries leave nothing behind", "[vulkan][draws]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    Soup const soup = make_soup(3, 10, 0.8F);
    backend::Draw const draw = soup.draw();
    vulkan::GpuRef const gpu = device->gpu_with({});
    auto const pipelines = vulkan::make_pass_pipelines(gpu, {});
    REQUIRE(pipelines);
    std::int64_t const before = device->live().total();
    auto const fails_everywhere = [&](auto make) {
        for (std::uint64_t n = 0;; ++n) {
            std::uint64_t const calls = device->live().calls;
            device->fail_call(n, VK_ERROR_OUT_OF_DEVICE_MEMORY);
            auto const made = make();
            if (made) {
                device->fail_call(0, VK_SUCCESS);
                CHECK(n >= 6);
                return;
            }
            CHECK(made.failure().code == vulkan::Error::out_of_device_memory);
            CHECK(device->live().calls == calls + n + 1);
            CHECK(device->live().total() == before);
        }
    };
    fails_everywhere([&] { return vulkan::make_draw_list(*pipelines, {&draw, 1}); });
    fails_everywhere([&] { return vulkan::make_target(gpu, {.size_px = {8, 8}, .layers = 3, .triangle_ids = true}); });
    fails_everywhere([&] { return vulkan::make_pass_pipelines(gpu, {.unorm16 = false, .alpha_tests = false}); });
    CHECK(device->take_messages() == "");
}
