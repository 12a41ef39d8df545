#include "test_device.hpp"
#include "words.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/vulkan/barrier.hpp>
#include <gnomon/vulkan/kernel.hpp>

#include "shaders/add_comp.hpp"
#include "shaders/affine_comp.hpp"
#include "shaders/texels_comp.hpp"
#include "shaders/wide_comp.hpp"

#include <cstring>

using namespace gnomon;
using vulkan::test::whole;
using vulkan::test::words_buffer;
using vulkan::test::words_of;

namespace {

struct AffineConstants {
    std::uint32_t count;
    std::uint32_t scale;
    std::uint32_t bias;
};

vulkan::ComputeConfig affine_config() {
    return {.name = "affine", .spirv = vulkan::test::affine_comp, .buffers = 2, .targets = 0, .constant_bytes = 12};
}

}  // namespace

TEST_CASE("dispatches that follow each other see each other's results", "[vulkan][kernel]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::GpuRef const gpu = device->gpu();
    auto const kernel = vulkan::ComputeKernel::make(gpu, affine_config());
    REQUIRE(kernel);
    CHECK_FALSE(kernel->may_write(0));
    CHECK(kernel->may_write(1));
    vulkan::DescriptorRing sets(gpu, 1);
    std::uint32_t constexpr n = 1000;
    vulkan::Buffer const a = words_buffer(gpu, n);
    vulkan::Buffer const b = words_buffer(gpu, n);
    for (std::uint32_t i = 0; i < n; ++i) words_of(a)[i] = i;
    REQUIRE(sets.begin_frame({0, 0}));
    VkCommandBuffer const commands = device->begin();
    vulkan::Order order;
    vulkan::Touched ta;
    vulkan::Touched tb;
    std::uint32_t expected[n];
    for (std::uint32_t i = 0; i < n; ++i) expected[i] = i;
    for (std::uint32_t pass = 0; pass < 150; ++pass) {  // more than a pool's sets
        bool const is_even = pass % 2 == 0;
        AffineConstants const c{n, 3, pass};
        VkDescriptorBufferInfo const buffers[] = {whole(is_even ? a : b), whole(is_even ? b : a)};
        order.reads(is_even ? ta : tb);
        order.writes(is_even ? tb : ta);
        order.apply(*gpu, commands);
        REQUIRE(kernel->record(commands, sets, {n, buffers, {}, std::as_bytes(std::span(&c, 1))}));
        for (std::uint32_t& e : expected) e = e * 3 + pass;
    }
    vulkan::order_for_host(*gpu, commands);
    device->submit_and_wait();
    CHECK(order.barriers() == 149);
    CHECK(std::memcmp(words_of(a).data(), expected, sizeof expected) == 0);
    CHECK(device->take_messages() == "");
}

TEST_CASE("commands that share nothing share a barrier, those that do get one", "[vulkan][barrier]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::GpuRef const gpu = device->gpu();
    VkCommandBuffer const commands = device->begin();
    vulkan::Order order;
    vulkan::Touched many[100];
    auto const after = [&] {
        order.apply(*gpu, commands);
        return order.barriers();
    };
    order.writes(many[0]);
    CHECK(after() == 0);
    order.writes(many[1]);
    CHECK(after() == 0);
    order.reads(many[0]);  // after a write
    CHECK(after() == 1);
    order.reads(many[0]);
    order.reads(many[1]);  // written before that barrier
    CHECK(after() == 1);
    order.writes(many[1]);  // after a read
    CHECK(after() == 2);
    order.writes(many[1]);  // after a write
    CHECK(after() == 3);
    for (vulkan::Touched& t : many) order.writes(t);  // more than it keeps book of at once
    CHECK(after() == 4);
    order.reads(many[99]);
    CHECK(after() == 5);
    order.all();
    CHECK(after() == 6);
    device->submit_and_wait();
    CHECK(device->take_messages() == "");
}

TEST_CASE("synchronization validation sees a barrier that is missing", "[vulkan][kernel]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::GpuRef const gpu = device->gpu();
    vulkan::Buffer const a = words_buffer(gpu, 64);
    auto const b = vulkan::make_buffer(gpu, 256, VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                       vulkan::MemoryUse::device);
    REQUIRE(b);
    auto const kernel = vulkan::ComputeKernel::make(gpu, affine_config());
    REQUIRE(kernel);
    vulkan::DescriptorRing sets(gpu, 1);
    REQUIRE(sets.begin_frame({0, 0}));
    VkDescriptorBufferInfo const buffers[] = {whole(*b), whole(a)};
    AffineConstants const c{64, 1, 0};
    VkCommandBuffer const commands = device->begin();
    gpu->call.CmdFillBuffer(commands, b->handle.get(), 0, VK_WHOLE_SIZE, 7);
    REQUIRE(kernel->record(commands, sets, {64, buffers, {}, std::as_bytes(std::span(&c, 1))}));
    device->submit_and_wait();
    CHECK(device->take_messages().find("SYNC-HAZARD-READ-AFTER-WRITE") != std::string::npos);
}

TEST_CASE("more items than one row of groups has become a grid, or are refused", "[vulkan][kernel]") {
    VkPhysicalDeviceLimits limits{};
    limits.maxComputeWorkGroupCount[0] = 65535;
    limits.maxComputeWorkGroupCount[1] = 65535;
    CHECK(*vulkan::grid_of(0, limits, false, "k") == vulkan::Grid{0, 0});
    CHECK(*vulkan::grid_of(65, limits, false, "k") == vulkan::Grid{2, 1});
    CHECK(*vulkan::grid_of(65535 * 64, limits, false, "k") == vulkan::Grid{65535, 1});
    auto const refused = vulkan::grid_of(65535 * 64 + 1, limits, false, "k");
    REQUIRE(!refused);
    CHECK(refused.failure().code == vulkan::Error::too_large);
    CHECK(refused.failure().message.find("4194240") != std::string::npos);
    check::for_all(check::cases(2000), check::integers<std::uint64_t>(0, 0xFFFF'FFFFU - 65), [&](std::uint64_t items) {
        auto const grid = vulkan::grid_of(items, limits, true, "k");
        if (!grid) {
            CHECK(items > (std::uint64_t{1} << 32U) - (65535U << 6U));
            return;
        }
        std::uint64_t const invocations = std::uint64_t{grid->x} * grid->y * 64;
        CHECK(invocations >= items);
        CHECK(invocations <= std::uint64_t{1} << 32U);
        CHECK(invocations - items < 64 * (std::uint64_t{grid->y} + 1));
    });

    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::GpuRef const gpu = device->gpu();
    auto const kernel = vulkan::ComputeKernel::make(gpu, affine_config());
    REQUIRE(kernel);
    vulkan::DescriptorRing sets(gpu, 1);
    REQUIRE(sets.begin_frame({0, 0}));
    std::uint32_t const n = gpu->properties.limits.maxComputeWorkGroupCount[0] < 100000 ? 65535 * 64 + 1234567 : 1000;
    vulkan::Buffer const a = words_buffer(gpu, n);
    vulkan::Buffer const b = words_buffer(gpu, n);
    for (std::uint32_t i = 0; i < n; ++i) words_of(a)[i] = i;
    AffineConstants const c{n, 5, 7};
    VkDescriptorBufferInfo const buffers[] = {whole(a), whole(b)};
    VkCommandBuffer const commands = device->begin();
    REQUIRE(kernel->record(commands, sets, {n, buffers, {}, std::as_bytes(std::span(&c, 1))}));
    vulkan::order_for_host(*gpu, commands);
    device->submit_and_wait();
    std::uint32_t wrong = 0;
    for (std::uint32_t i = 0; i < n; ++i) wrong += words_of(b)[i] != i * 5 + 7 ? 1U : 0U;
    CHECK(wrong == 0);
    CHECK(device->take_messages() == "");
}

TEST_CASE("a shader that is not what its configuration says is refused with the difference", "[vulkan][kernel]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::GpuRef const gpu = device->gpu();
    auto const message_of = [&](vulkan::ComputeConfig const& config) {
        auto const made = vulkan::ComputeKernel::make(gpu, config);
        return made ? std::string("accepted") : made.failure().message;
    };
    CHECK_THAT(message_of({.name = "wide", .spirv = vulkan::test::wide_comp}), check::Contains("8 x 8 x 1"));
    CHECK_THAT(message_of({.name = "affine", .spirv = vulkan::test::affine_comp, .buffers = 1, .constant_bytes = 12}),
               check::Contains("binding 1"));
    CHECK_THAT(message_of({.name = "affine", .spirv = vulkan::test::affine_comp, .buffers = 2, .constant_bytes = 8}),
               check::Contains("reads 12 bytes"));
    CHECK_THAT(message_of({.name = "texels", .spirv = vulkan::test::texels_comp, .buffers = 2, .constant_bytes = 12}),
               check::Contains("binding 1"));
    CHECK_THAT(message_of({.name = "many", .spirv = vulkan::test::affine_comp, .buffers = 13}), check::Contains("13"));
    CHECK_THAT(message_of({.name = "none", .spirv = {}}), check::Contains("no SPIR-V"));
    auto const kernel = vulkan::ComputeKernel::make(gpu, affine_config());
    REQUIRE(kernel);
    vulkan::DescriptorRing sets(gpu, 1);
    auto const refused = kernel->record(VK_NULL_HANDLE, sets, {10, {}, {}, {}});
    REQUIRE(!refused);
    CHECK(refused.failure().code == vulkan::Error::bad_argument);
    CHECK(device->take_messages() == "");
}

TEST_CASE("a kernel fetches the texels of a target's layer", "[vulkan][kernel]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::GpuRef const gpu = device->gpu();
    vulkan::ImageConfig config;
    config.extent = {16, 8};
    config.layers = 3;
    config.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    auto const image = vulkan::make_image(gpu, config);
    REQUIRE(image);
    auto const kernel = vulkan::ComputeKernel::make(
        gpu, {.name = "texels", .spirv = vulkan::test::texels_comp, .buffers = 1, .targets = 1, .constant_bytes = 12});
    REQUIRE(kernel);
    vulkan::DescriptorRing sets(gpu, 1);
    REQUIRE(sets.begin_frame({0, 0}));
    vulkan::Buffer const out = words_buffer(gpu, 128);
    VkCommandBuffer const commands = device->begin();
    VkImageMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
    barrier.image = image->handle.get();
    barrier.subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 3};
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.imageMemoryBarrierCount = 1;
    info.pImageMemoryBarriers = &barrier;
    gpu->call.CmdPipelineBarrier2(commands, &info);
    for (std::uint32_t layer = 0; layer < 3; ++layer) {
        VkClearDepthStencilValue const value{0.25F * static_cast<float>(layer + 1), 0};
        VkImageSubresourceRange const range{VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, layer, 1};
        gpu->call.CmdClearDepthStencilImage(commands, image->handle.get(), VK_IMAGE_LAYOUT_GENERAL, &value, 1, &range);
    }
    vulkan::order_all(*gpu, commands);
    std::uint32_t const where[] = {16, 8, 2};
    VkDescriptorBufferInfo const buffer = whole(out);
    VkDescriptorImageInfo const target{VK_NULL_HANDLE, image->array_view.get(), VK_IMAGE_LAYOUT_GENERAL};
    REQUIRE(kernel->record(commands, sets, {128, {&buffer, 1}, {&target, 1}, std::as_bytes(std::span(where))}));
    vulkan::order_for_host(*gpu, commands);
    device->submit_and_wait();
    for (std::uint32_t const word : words_of(out)) CHECK(word == 0x3F400000U);  // 0.75
    CHECK(device->take_messages() == "");
}

TEST_CASE("whichever call of a kernel's making fails, nothing is left behind", "[vulkan][kernel]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::GpuRef const gpu = device->gpu();
    std::uint64_t const before = device->live().calls;
    {
        auto const kernel = vulkan::ComputeKernel::make(gpu, affine_config());
        REQUIRE(kernel);
    }
    std::uint64_t const calls = device->live().calls - before;
    CHECK(calls == 4);
    for (std::uint64_t n = 0; n < calls; ++n) {
        device->fail_call(n, VK_ERROR_OUT_OF_HOST_MEMORY);
        auto const kernel = vulkan::ComputeKernel::make(gpu, affine_config());
        REQUIRE(!kernel);
        CHECK(kernel.failure().code == vulkan::Error::out_of_host_memory);
        CHECK(device->live().total() == 0);
    }
    vulkan::DescriptorRing sets(gpu, 1);
    auto const kernel = vulkan::ComputeKernel::make(gpu, affine_config());
    REQUIRE(kernel);
    REQUIRE(sets.begin_frame({0, 0}));
    vulkan::Buffer const buffer = words_buffer(gpu, 4);
    VkDescriptorBufferInfo const buffers[] = {whole(buffer), whole(buffer)};
    std::uint32_t const constants[3] = {};
    device->fail_call(0, VK_ERROR_OUT_OF_DEVICE_MEMORY);  // the first pool of sets
    auto const refused = kernel->record(VK_NULL_HANDLE, sets, {4, buffers, {}, std::as_bytes(std::span(constants))});
    REQUIRE(!refused);
    CHECK(refused.failure().code == vulkan::Error::out_of_device_memory);
    CHECK(device->take_messages() == "");
}
