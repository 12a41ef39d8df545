#include "test_device.hpp"
#include "test_kernels.hpp"
#include "words.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/vulkan/barrier.hpp>
#include <gnomon/vulkan/kernel.hpp>
#include <gnomon/vulkan/read_back.hpp>
#include <gnomon/vulkan/ring.hpp>
#include <gnomon/vulkan/timestamps.hpp>

#include <cstring>
#include <vector>

using namespace gnomon;

namespace {

constexpr std::uint32_t frames_in_flight = 2;

/// A caller with frames in flight: it waits for a frame only when its place is needed again.
class InFlight {
  public:
    explicit InFlight(vulkan::GpuConfig const& config) : device_(config.device) {
        vkGetDeviceQueue(device_, config.queue_family, 0, &queue_);
        VkCommandPoolCreateInfo pool{};
        pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
        pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
        REQUIRE(vkCreateCommandPool(device_, &pool, nullptr, &pool_) == VK_SUCCESS);
        VkCommandBufferAllocateInfo buffers{};
        buffers.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        buffers.commandPool = pool_;
        buffers.commandBufferCount = frames_in_flight;
        REQUIRE(vkAllocateCommandBuffers(device_, &buffers, commands_) == VK_SUCCESS);
        VkFenceCreateInfo fence{};
        fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        for (VkFence& f : fences_) REQUIRE(vkCreateFence(device_, &fence, nullptr, &f) == VK_SUCCESS);
    }
    ~InFlight() {
        vkDeviceWaitIdle(device_);
        for (VkFence const f : fences_) vkDestroyFence(device_, f, nullptr);
        vkDestroyCommandPool(device_, pool_, nullptr);
    }
    InFlight(InFlight const&) = delete;
    InFlight& operator=(InFlight const&) = delete;

    VkCommandBuffer begin() {
        if (count.recording >= frames_in_flight) finish(count.recording - frames_in_flight);
        VkCommandBufferBeginInfo info{};
        info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        VkCommandBuffer const commands = commands_[count.recording % frames_in_flight];
        REQUIRE(vkBeginCommandBuffer(commands, &info) == VK_SUCCESS);
        return commands;
    }
    void submit() {
        std::uint64_t const slot = count.recording++ % frames_in_flight;
        REQUIRE(vkEndCommandBuffer(commands_[slot]) == VK_SUCCESS);
        VkSubmitInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        info.commandBufferCount = 1;
        info.pCommandBuffers = &commands_[slot];
        REQUIRE(vkQueueSubmit(queue_, 1, &info, fences_[slot]) == VK_SUCCESS);
    }
    void finish(std::uint64_t frame) {
        if (frame < count.finished) return;
        VkFence const fence = fences_[frame % frames_in_flight];
        REQUIRE(vkWaitForFences(device_, 1, &fence, VK_TRUE, ~std::uint64_t{0}) == VK_SUCCESS);
        REQUIRE(vkResetFences(device_, 1, &fence) == VK_SUCCESS);
        count.finished = frame + 1;
    }

    vulkan::FrameCount count;

  private:
    VkDevice device_;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_[frames_in_flight] = {};
    VkFence fences_[frames_in_flight] = {};
};

}  // namespace

TEST_CASE("two frames run at once and neither sees the other's bytes", "[vulkan][frame]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::GpuRef const gpu = device->gpu();
    InFlight caller(device->config());
    constexpr std::uint32_t n = 50'000;
    auto ring = vulkan::HostRing::make(gpu, {.bytes_per_frame = n * 4, .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT});
    auto back = vulkan::ReadBack::make(gpu, {.bytes_per_frame = n * 4});
    auto const kernel = vulkan::ComputeKernel::make(gpu, {.name = "affine",
                                                          .spirv = vulkan::test::affine_comp,
                                                          .buffers = 2,
                                                          .targets = 0,
                                                          .constant_bytes = sizeof(vulkan::test::Affine)});
    REQUIRE((ring && back && kernel));
    vulkan::Buffer const result = vulkan::test::words_buffer(gpu, n);
    vulkan::DescriptorRing sets(gpu, frames_in_flight);
    vulkan::StageTimer timer(gpu, frames_in_flight);
    std::vector<vulkan::ReadTicket> tickets;
    std::uint64_t wrong = 0;
    for (std::uint32_t frame = 0; frame < 24; ++frame) {
        VkCommandBuffer const commands = caller.begin();
        if (frame >= frames_in_flight) {  // the oldest has finished: its values, and its times
            std::uint32_t const old = frame - frames_in_flight;
            auto const values = back->values(tickets[old], caller.count.finished);
            REQUIRE(values);
            for (std::uint32_t i = 0; i < n; i += 7) {
                std::uint32_t word = 0;
                std::memcpy(&word, values->data() + i * 4, 4);
                wrong += word != (i + old) * 3 + old ? 1U : 0U;
            }
            CHECK(timer.times(old, caller.count.finished)->size() == 1);
        }
        REQUIRE((ring->begin_frame(caller.count) && back->begin_frame(caller.count)));
        REQUIRE((sets.begin_frame(caller.count) && timer.begin_frame(caller.count)));
        auto const slice = ring->take(n * 4, 256);
        REQUIRE(slice);
        for (std::uint32_t i = 0; i < n; ++i) {
            std::uint32_t const word = i + frame;
            std::memcpy(slice->bytes.data() + i * 4, &word, 4);
        }
        REQUIRE(ring->flush());
        vulkan::order_all(*gpu, commands);  // after the frame before, which used `result` too
        REQUIRE(timer.stage(commands, "affine"));
        vulkan::test::Affine const affine{n, 3, frame};
        VkDescriptorBufferInfo const buffers[] = {{slice->buffer, slice->offset, n * 4}, vulkan::test::whole(result)};
        REQUIRE(kernel->record(commands, sets, {n, buffers, {}, std::as_bytes(std::span(&affine, 1))}));
        REQUIRE(timer.end_frame(commands));
        vulkan::order_all(*gpu, commands);
        auto const ticket = back->copy(commands, result.handle.get(), 0, n * 4);
        REQUIRE(ticket);
        back->end_frame(commands);
        tickets.push_back(*ticket);
        caller.submit();
        CHECK_FALSE(back->values(tickets.back(), caller.count.finished));
    }
    CHECK(wrong == 0);
    caller.finish(22);
    caller.finish(23);
    CHECK(device->take_messages().substr(0, 500) == "");
}
