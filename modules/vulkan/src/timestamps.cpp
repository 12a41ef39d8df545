#include <gnomon/vulkan/timestamps.hpp>

#include <algorithm>
#include <string>

namespace gnomon::vulkan {

Result<core::Done> StageTimer::begin_frame(FrameCount const& count) {
    auto const slot = slot_of(count, static_cast<std::uint32_t>(slots_.size()));
    if (!slot) return slot.failure();
    now_ = *slot;
    slots_[now_].names.clear();
    slots_[now_].written = 0;
    slots_[now_].frame = count.recording;
    return core::Done{};
}

Result<core::Done> StageTimer::add_pool(Slot& slot) {
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = pool_queries;
    VkQueryPool pool = VK_NULL_HANDLE;
    VkResult const result = gpu_->call.CreateQueryPool(gpu_->device, &info, gpu_->host, &pool);
    if (result != VK_SUCCESS) return failure_of(result, "vkCreateQueryPool for timestamps");
    slot.pools.emplace_back(gpu_, pool);
    return core::Done{};
}

Result<core::Done> StageTimer::write(VkCommandBuffer commands) {
    Slot& slot = slots_[now_];
    std::uint32_t const pool = slot.written / pool_queries;
    std::uint32_t const query = slot.written % pool_queries;
    if (pool == slot.pools.size())
        if (auto added = add_pool(slot); !added) return added;
    VkQueryPool const handle = slot.pools[pool].get();
    if (query == 0) gpu_->call.CmdResetQueryPool(commands, handle, 0, pool_queries);
    gpu_->call.CmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, handle, query);
    ++slot.written;
    return core::Done{};
}

Result<core::Done> StageTimer::stage(VkCommandBuffer commands, std::string_view name) {
    if (!has_clock()) return core::Done{};
    if (auto ok = write(commands); !ok) return ok;
    slots_[now_].names.push_back(name);
    return core::Done{};
}

Result<core::Done> StageTimer::end_frame(VkCommandBuffer commands) {
    Slot const& slot = slots_[now_];
    if (slot.names.empty() || slot.written > slot.names.size()) return core::Done{};
    return write(commands);
}

Result<core::Done> StageTimer::read_ticks(Slot const& slot) {
    ticks_.resize(slot.written);
    for (std::uint32_t first = 0; first < slot.written; first += pool_queries) {
        std::uint32_t const count = std::min(pool_queries, slot.written - first);
        VkResult const result = gpu_->call.GetQueryPoolResults(
            gpu_->device, slot.pools[first / pool_queries].get(), 0, count, count * sizeof(std::uint64_t),
            ticks_.data() + first, sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT);
        if (result != VK_SUCCESS) return failure_of(result, "vkGetQueryPoolResults of timestamps");
    }
    return core::Done{};
}

Result<std::span<StageMs const>> StageTimer::times(std::uint64_t frame, std::uint64_t finished) {
    Slot const& slot = slots_[frame % slots_.size()];
    if (frame >= finished || slot.frame != frame)
        return core::Failure{Error::bad_argument, "times of frame " + std::to_string(frame) +
                                                      ": it is not known to have finished, or its place in the ring has "
                                                      "been used again"};
    times_.clear();
    if (slot.written > slot.names.size()) {
        if (auto ok = read_ticks(slot); !ok) return std::move(ok).failure();
        float const period_ns = gpu_->properties.limits.timestampPeriod;
        for (std::size_t i = 0; i < slot.names.size(); ++i) {
            if (slot.names[i].empty()) continue;
            times_.push_back({slot.names[i], ms_between(ticks_[i], ticks_[i + 1], gpu_->timestamp_bits, period_ns)});
        }
    }
    return std::span<StageMs const>(times_);
}

}  // namespace gnomon::vulkan
