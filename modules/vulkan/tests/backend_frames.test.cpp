#include "frame_rig.hpp"
#include "null_driver.hpp"
#include "test_host.hpp"

#include <gnomon/check/allocations.hpp>
#include <gnomon/check/check.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/raster/cpu_backend.hpp>

#include <algorithm>

GNOMON_COUNT_ALLOCATIONS;

using namespace gnomon;
using namespace gnomon::vulkan::test;

namespace {

/// Fails call 0, `stride`, 2 * `stride` .. of those that make something.
void fail_every(std::uint64_t stride) {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    auto const try_frame = [&](std::uint64_t fails_at, bool fails) {
        TestHost host(*device);
        auto const b = vulkan::Backend::make(device->gpu(), host.host());
        REQUIRE(b);
        if (fails) device->fail_call(fails_at, VK_ERROR_OUT_OF_DEVICE_MEMORY);
        FrameRig rig;
        auto done = rig.make(**b, 3);
        if (done) done = rig.step(**b);
        CHECK(done.has_value() == !fails);
        if (!done) CHECK(done.failure().code == backend::Error::out_of_memory);
        if (host.submits < host.begins) REQUIRE((*b)->finish());  // what is recorded must end
        if (!fails || fails_at % 8 != 0) return;
        FrameRig again;
        REQUIRE(again.make(**b, 3));
        REQUIRE(again.step(**b));
    };
    std::uint64_t const before = device->live().calls;
    try_frame(0, false);
    std::uint64_t const calls = device->live().calls - before;
    CHECK(calls > 30);
    for (std::uint64_t n = 0; n < calls; n += stride) {
        CAPTURE(n);
        try_frame(n, true);
        CHECK(device->live().total() == 0);
    }
    CHECK(device->take_messages().substr(0, 500) == "");
}

}  // namespace

TEST_CASE("frames after the first make no Vulkan object", "[vulkan][backend][memory]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    {
        TestHost host(*device);
        auto const b = vulkan::Backend::make(device->gpu(), host.host());
        REQUIRE(b);
        FrameRig rig;
        REQUIRE(rig.make(**b, 100));
        REQUIRE(rig.step(**b));
        std::uint64_t const made = device->live().calls;
        std::int64_t const live = device->live().total();
        for (int i = 0; i < 30; ++i) REQUIRE(rig.step(**b));
        CHECK(device->live().calls == made);
        CHECK(device->live().total() == live);
    }
    CHECK(device->live().total() == 0);
    CHECK(device->take_messages().substr(0, 500) == "");
}

TEST_CASE("frames after the first ask for no memory", "[vulkan][backend][memory]") {
    auto const device = Device::make();  // for its properties
    REQUIRE(device != nullptr);
    auto const gpu = null_gpu(device->gpu()->properties, device->features());
    auto const b = vulkan::Backend::make(gpu, null_host());
    REQUIRE(b);
    FrameRig rig;
    REQUIRE(rig.make(**b, 100));
    for (int i = 0; i < 2; ++i) REQUIRE(rig.step(**b));
    std::uint64_t const before = check::allocations_made();
    std::uint64_t const makes = null_driver::counts.makes;
    bool ok = true;
    for (int i = 0; i < 30; ++i) ok = rig.step(**b).has_value() && ok;
    CHECK(check::allocations_made() == before);
    CHECK(null_driver::counts.makes == makes);
    CHECK(ok);
}

TEST_CASE("draw calls do not depend on the number of batches", "[vulkan][backend]") {
    auto const device = Device::make();
    REQUIRE(device != nullptr);
    std::uint64_t calls[3] = {};
    std::size_t const batches[3] = {2, 100, 10'000};
    for (int i = 0; i < 3; ++i) {
        auto const b = vulkan::Backend::make(null_gpu(device->gpu()->properties, device->features()), null_host());
        REQUIRE(b);
        FrameRig rig;
        REQUIRE(rig.make(**b, batches[i]));
        std::uint64_t const before = null_driver::counts.draw_calls;
        auto const counts = rig.draw(**b, 0);
        REQUIRE(counts);
        CHECK(counts->triangles == 2 * 8 * batches[i]);
        calls[i] = null_driver::counts.draw_calls - before;
        CHECK(counts->draw_calls == calls[i]);
    }
    CHECK(calls[0] == 2);  // culled and not
    CHECK(calls[1] == calls[0]);
    CHECK(calls[2] == calls[0]);
}

TEST_CASE("whichever call fails while every verb is used, nothing leaks and the next try works", "[vulkan][backend]") {
    fail_every(11);
}

TEST_CASE("the same for every single call", "[vulkan][backend][.full]") { fail_every(1); }

TEST_CASE("a box counts samples on the device where it does on the CPU, and nowhere else", "[vulkan][backend]") {
    DeviceBackend on;
    core::SerialExecutor serial;
    raster::CpuBackend cpu{core::ExecutorRef(serial)};
    Soup const soup = make_soup(5, 60, 1.2F);
    backend::Draw const draw = soup.draw();
    std::vector<math::Aabb> boxes;
    Random random{9};
    for (int i = 0; i < 200; ++i) {
        math::vec3 const middle{random.in(-5, 5), random.in(-5, 5), random.in(-12, 2)};
        math::vec3 const half{random.in(0, 0.6F), random.in(0, 0.6F), random.in(0, 0.6F)};
        boxes.push_back({middle - half, middle + half});
    }
    boxes[3] = math::Aabb{};
    std::vector<std::uint32_t> counts[2];
    backend::Backend* const both[] = {&cpu, on.gpu.get()};
    for (int i = 0; i < 2; ++i) {
        backend::Backend& b = *both[i];
        auto const list = b.keep({&draw, 1});
        auto const target = b.make_target({.size_px = {80, 60}});
        auto const buffer = b.make_buffer(4 * (boxes.size() + 7));
        REQUIRE((list && target && buffer));
        backend::PassLayer const view = layer_of(camera({80, 60}));
        REQUIRE(b.draw(*list, *target, {&view, 1}));
        REQUIRE(b.count_samples(boxes, *target, view, *buffer, 7));
        CHECK_FALSE(b.count_samples(boxes, *target, view, *buffer, 8));
        counts[i].resize(boxes.size());
        REQUIRE(b.read(*buffer, 28, std::as_writable_bytes(std::span(counts[i]))));
        REQUIRE(b.finish());
    }
    std::uint32_t seen = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        CAPTURE(i);
        CHECK((counts[0][i] == 0) == (counts[1][i] == 0));
        CHECK(counts[1][i] >= counts[0][i]);
        CHECK(counts[1][i] <= 2 * counts[0][i]);
        seen += counts[0][i] != 0 ? 1U : 0U;
    }
    CHECK(seen > 10);
    CHECK(seen < 190);
    CHECK(on.device->take_messages().substr(0, 500) == "");
}
