#include <gnomon/vulkan/barrier.hpp>

namespace gnomon::vulkan {

namespace {

void record_barrier(Gpu const& gpu, VkCommandBuffer commands, VkMemoryBarrier2 const& barrier) noexcept {
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &barrier;
    gpu.call.CmdPipelineBarrier2(commands, &info);
}

VkMemoryBarrier2 after_all_writes() noexcept {
    VkMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    return barrier;
}

}  // namespace

void order_all(Gpu const& gpu, VkCommandBuffer commands) noexcept {
    VkMemoryBarrier2 barrier = after_all_writes();
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    record_barrier(gpu, commands, barrier);
}

void order_for_host(Gpu const& gpu, VkCommandBuffer commands) noexcept {
    VkMemoryBarrier2 barrier = after_all_writes();
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
    record_barrier(gpu, commands, barrier);
}

void Order::add(Touched& resource, bool is_write) noexcept {
    // A command of more resources than fit gets its barrier, and those beyond count as touched at once.
    if (pending_ < max_pending) {
        pending_of_[pending_++] = {&resource, is_write};
        return;
    }
    needed_ = true;
    (is_write ? resource.written : resource.read) = epoch_ + 1;
}

void Order::apply(Gpu const& gpu, VkCommandBuffer commands) noexcept {
    if (needed_) {
        order_all(gpu, commands);
        ++epoch_;
    }
    for (std::uint32_t i = 0; i < pending_; ++i)
        (pending_of_[i].is_write ? pending_of_[i].resource->written : pending_of_[i].resource->read) = epoch_;
    needed_ = false;
    pending_ = 0;
}

}  // namespace gnomon::vulkan
