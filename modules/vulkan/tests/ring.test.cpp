#include "test_device.hpp"
#include "words.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/vulkan/barrier.hpp>
#include <gnomon/vulkan/read_back.hpp>
#include <gnomon/vulkan/staging.hpp>

#include <cstring>
#include <vector>

using namespace gnomon;
using vulkan::test::words_buffer;
using vulkan::test::words_of;

TEST_CASE("a frame takes the place of one that has finished, never of one that may run", "[vulkan][frame]") {
    check::for_all(check::integers<std::uint64_t>(0, 1000), check::integers<std::uint64_t>(0, 1000),
                   check::integers<std::uint32_t>(1, 4), [](std::uint64_t recording, std::uint64_t finished,
                                                            std::uint32_t frames) {
                       bool const is_safe = recording < finished + frames;  // frame `recording - frames` is done
                       auto const slot = vulkan::slot_of({recording, finished}, frames);
                       CHECK(slot.has_value() == is_safe);
                       if (slot) CHECK(*slot == recording % frames);
                       else CHECK(slot.failure().code == vulkan::Error::bad_argument);
                   });
    CHECK(vulkan::slot_of({2, 0}, 2).failure().message.find("frame 2 would overwrite frame 0") == 0);
    CHECK_FALSE(vulkan::slot_of({0, 0}, 0));
}

TEST_CASE("a ring's frames do not overlap, and overflow says what is needed", "[vulkan][ring]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::GpuRef const gpu = device->gpu();
    {
        auto ring = vulkan::HostRing::make(gpu, {.bytes_per_frame = 1000, .frames = 3});
        REQUIRE(ring);
        CHECK(ring->capacity() == 1024);
        CHECK(device->live().total() == 2);
        for (std::uint64_t frame = 0; frame < 7; ++frame) {
            REQUIRE(ring->begin_frame({frame, frame < 2 ? 0 : frame - 2}));
            auto const first = ring->take(10, 4);
            auto const second = ring->take(100, 64);
            REQUIRE((first && second));
            CHECK(first->offset == frame % 3 * 1024);
            CHECK(second->offset == first->offset + 64);
            CHECK(second->bytes.size() == 100);
            std::memset(second->bytes.data(), 1, second->bytes.size());
            auto const much = ring->take(2000, 16);
            REQUIRE(!much);
            CHECK(much.failure().code == vulkan::Error::too_large);
            CHECK(much.failure().message.find("2176") != std::string::npos);
            CHECK(ring->needed() == 2176);  // 164, up to 176, and 2000 more
            CHECK(ring->take(768, 256).value().offset == first->offset + 256);  // what was taken stays, what fits still does
            CHECK_FALSE(ring->take(1));
            CHECK(ring->flush());
        }
        CHECK_FALSE(ring->begin_frame({7, 4}));
        auto again = vulkan::HostRing::make(gpu, {.bytes_per_frame = ring->needed(), .frames = 1});
        REQUIRE(again);
        REQUIRE(again->begin_frame({0, 0}));
        CHECK((again->take(10, 4) && again->take(100, 64) && again->take(2000, 16) && again->take(1, 16)));
    }
    CHECK_FALSE(vulkan::HostRing::make(gpu, {.bytes_per_frame = 0}));
    CHECK_FALSE(vulkan::HostRing::make(gpu, {.bytes_per_frame = 16, .use = vulkan::MemoryUse::device}));
    CHECK(device->live().total() == 0);
    CHECK(device->take_messages() == "");
}

TEST_CASE("staging grows once, uploads arrive whole, and idle memory goes back", "[vulkan][staging]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::GpuRef const gpu = device->gpu();
    vulkan::Buffer const goal = words_buffer(gpu, 3000);
    std::int64_t const before = device->live().total();
    {
        vulkan::Staging staging(gpu, {.block_bytes = 4096, .frames = 1, .idle_frames = 3});
        std::uint64_t made = 0;
        for (std::uint32_t frame = 0; frame < 6; ++frame) {
            REQUIRE(staging.begin_frame({frame, frame}));
            VkCommandBuffer const commands = device->begin();
            std::vector<std::uint32_t> values(3000);
            for (std::uint32_t i = 0; i < 3000; ++i) values[i] = i ^ (frame << 16U);
            auto const bytes = std::as_bytes(std::span(values));
            for (std::size_t at = 0; at < 12000;) {  // pieces of 1 to 4999 bytes
                std::size_t const piece = std::min<std::size_t>(12000 - at, at % 7 == 0 ? 4999 : 1 + at * 31 % 900);
                REQUIRE(staging.upload(commands, bytes.subspan(at, piece), goal.handle.get(), at));
                at += piece;
            }
            REQUIRE(staging.flush());
            vulkan::order_for_host(*gpu, commands);
            device->submit_and_wait();
            CHECK(std::memcmp(goal.mapped().data(), values.data(), 12000) == 0);
            if (frame == 0) made = device->live().calls;
        }
        CHECK(device->live().calls == made);  // frames after the first make nothing
        CHECK(staging.held_bytes() >= 12000);
        REQUIRE(staging.begin_frame({8, 8}));
        CHECK(staging.held_bytes() >= 12000);
        REQUIRE(staging.begin_frame({9, 9}));
        CHECK(staging.held_bytes() == 0);
        device->fail_call(1, VK_ERROR_OUT_OF_DEVICE_MEMORY);
        CHECK(staging.take(100).failure().code == vulkan::Error::out_of_device_memory);
        CHECK(staging.take(100));
    }
    CHECK(device->live().total() == before);
    CHECK(device->take_messages() == "");
}

TEST_CASE("staging gives no byte to two frames in flight", "[vulkan][staging]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::Staging staging(device->gpu(), {.block_bytes = 1024, .frames = 3});
    std::vector<std::vector<vulkan::HostSlice>> in_flight(3);
    check::for_all(check::cases(1), check::just(0), [&](int) {
        for (std::uint64_t frame = 0; frame < 60; ++frame) {
            REQUIRE(staging.begin_frame({frame, frame < 2 ? 0 : frame - 2}));
            in_flight[frame % 3].clear();
            for (std::uint64_t k = 0; k < frame * 7 % 5; ++k) {
                auto const slice = staging.take(1 + frame * 131 % 800, 16);
                REQUIRE(slice);
                for (auto const& slices : in_flight)
                    for (vulkan::HostSlice const& other : slices) {
                        bool const is_apart = other.buffer != slice->buffer ||
                                              other.offset + other.bytes.size() <= slice->offset ||
                                              slice->offset + slice->bytes.size() <= other.offset;
                        CHECK(is_apart);
                    }
                in_flight[frame % 3].push_back(*slice);
            }
        }
    });
    CHECK(device->take_messages() == "");
}

TEST_CASE("values of a frame are read once it has finished and before the ring comes round", "[vulkan][read_back]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::GpuRef const gpu = device->gpu();
    vulkan::Buffer const source = words_buffer(gpu, 4);
    auto back = vulkan::ReadBack::make(gpu, {.bytes_per_frame = 64, .frames = 2});
    REQUIRE(back);
    std::vector<vulkan::ReadTicket> tickets;
    for (std::uint64_t frame = 0; frame < 10; ++frame) {
        // The caller learns of a frame's end one frame late, as a fence of two frames in flight tells it.
        std::uint64_t const finished = frame < 2 ? 0 : frame - 1;
        REQUIRE(back->begin_frame({frame, finished}));
        VkCommandBuffer const commands = device->begin();
        gpu->call.CmdFillBuffer(commands, source.handle.get(), 0, 16, static_cast<std::uint32_t>(frame) + 100);
        vulkan::order_all(*gpu, commands);
        auto const ticket = back->copy(commands, source.handle.get(), 4, 8);
        REQUIRE(ticket);
        back->end_frame(commands);
        device->submit_and_wait();
        tickets.push_back(*ticket);
        CHECK_FALSE(back->values(tickets[frame], frame));  // not known to be done
        if (frame > 0) {
            auto const values = back->values(tickets[frame - 1], frame);  // one frame old: the latency
            REQUIRE(values);
            std::uint32_t words[2];
            std::memcpy(words, values->data(), 8);
            CHECK((words[0] == frame + 99 && words[1] == frame + 99));
        }
        if (frame > 1) CHECK_FALSE(back->values(tickets[frame - 2], frame));  // overwritten
    }
    CHECK_FALSE(back->begin_frame({10, 8}));  // frame 8 may still run
    REQUIRE(back->begin_frame({10, 9}));
    CHECK(back->copy(device->begin(), source.handle.get(), 0, 300).failure().message.find("300") != std::string::npos);
    device->submit_and_wait();
    CHECK(device->take_messages() == "");
}
