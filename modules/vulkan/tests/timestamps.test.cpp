#include "test_device.hpp"
#include "words.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/vulkan/barrier.hpp>
#include <gnomon/vulkan/timestamps.hpp>

using namespace gnomon;

TEST_CASE("ticks wrap at the queue's valid bits", "[vulkan][timestamps]") {
    CHECK(vulkan::ms_between(1000, 3000, 64, 1.0F) == check::Approx(2000e-6));
    CHECK(vulkan::ms_between(~std::uint64_t{0}, 4, 64, 1.0F) == check::Approx(5e-6));
    CHECK(vulkan::ms_between((1U << 20U) - 1, 1, 20, 1000.0F) == check::Approx(2e-3));
    // Bits above the valid ones say nothing.
    CHECK(vulkan::ms_between(0xABC0000000000005U, 0x1230000000000009U, 36, 1.0F) == check::Approx(4e-6));
    CHECK(vulkan::ms_between(5, 9, 0, 1.0F) == 0.0);
}

TEST_CASE("stages are timed under their names, in order, more of them than a pool holds", "[vulkan][timestamps]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::GpuRef const gpu = device->gpu();
    REQUIRE(gpu->timestamp_bits > 0);
    vulkan::Buffer const small = vulkan::test::words_buffer(gpu, 16);
    vulkan::Buffer const large = vulkan::test::words_buffer(gpu, 4 << 20U);
    std::int64_t const before = device->live().total();
    {
        vulkan::StageTimer timer(gpu, 2);
        std::uint64_t made = 0;
        for (std::uint64_t frame = 0; frame < 5; ++frame) {
            REQUIRE(timer.begin_frame({frame, frame}));
            VkCommandBuffer const commands = device->begin();
            for (int i = 0; i < 100; ++i) {
                bool const is_large = i == 70;
                REQUIRE(timer.stage(commands, is_large ? "large" : "small"));
                gpu->call.CmdFillBuffer(commands, (is_large ? large : small).handle.get(), 0, VK_WHOLE_SIZE, 1);
                vulkan::order_all(*gpu, commands);
            }
            REQUIRE(timer.end_frame(commands));
            CHECK_FALSE(timer.times(frame, frame));
            device->submit_and_wait();
            auto const times = timer.times(frame, frame + 1);
            REQUIRE(times);
            REQUIRE(times->size() == 100);
            CHECK((*times)[70].name == "large");
            for (vulkan::StageMs const& t : *times) CHECK(t.ms >= 0.0);
            if (frame == 1) made = device->live().calls;
        }
        CHECK(device->live().calls == made);
        CHECK_FALSE(timer.times(2, 5));  // its place belongs to frame 4
        CHECK(timer.times(3, 5));
        // A frame without stages has no times.
        REQUIRE(timer.begin_frame({5, 5}));
        REQUIRE(timer.end_frame(VK_NULL_HANDLE));
        CHECK(timer.times(5, 6)->empty());
    }
    CHECK(device->live().total() == before);
    CHECK(device->take_messages() == "");
}

TEST_CASE("a queue without timestamps gives no times and no errors", "[vulkan][timestamps]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    auto without = std::make_shared<vulkan::Gpu>(*device->gpu());
    without->timestamp_bits = 0;
    vulkan::StageTimer timer(without, 1);
    CHECK_FALSE(timer.has_clock());
    REQUIRE(timer.begin_frame({0, 0}));
    CHECK(timer.stage(VK_NULL_HANDLE, "a"));
    CHECK(timer.end_frame(VK_NULL_HANDLE));
    CHECK(timer.times(0, 1)->empty());
    CHECK(device->live().total() == 0);
}
