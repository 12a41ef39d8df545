#pragma once
// One memory barrier between named stages, for where `order_all` would order too much.

#include <gnomon/vulkan/gpu.hpp>

namespace gnomon::vulkan::detail {

struct BarrierHalf {
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 access;
};

inline void record_barrier(Gpu const& gpu, VkCommandBuffer commands, BarrierHalf const& from, BarrierHalf const& to) {
    VkMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    barrier.srcStageMask = from.stages;
    barrier.srcAccessMask = from.access;
    barrier.dstStageMask = to.stages;
    barrier.dstAccessMask = to.access;
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &barrier;
    gpu.call.CmdPipelineBarrier2(commands, &info);
}

}  // namespace gnomon::vulkan::detail
