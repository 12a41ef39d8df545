#include <gnomon/vulkan/staging.hpp>

#include <algorithm>
#include <cstring>

namespace gnomon::vulkan {

namespace {

constexpr VkDeviceSize aligned(VkDeviceSize value, VkDeviceSize step) noexcept { return (value + step - 1) & ~(step - 1); }

}  // namespace

Result<core::Done> Staging::begin_frame(FrameCount const& count) {
    if (auto slot = slot_of(count, config_.frames); !slot) return std::move(slot).failure();
    count_ = count;
    auto const is_idle = [&](Block const& block) {
        return block.frame < count.finished && count.recording - block.frame > config_.idle_frames;
    };
    blocks_.erase(std::remove_if(blocks_.begin(), blocks_.end(), is_idle), blocks_.end());
    return core::Done{};
}

Staging::Block* Staging::block_for(VkDeviceSize bytes, VkDeviceSize alignment) noexcept {
    for (Block& block : blocks_) {
        if (block.frame != count_.recording) continue;
        VkDeviceSize const start = aligned(block.used, alignment);
        if (start <= block.buffer.size && bytes <= block.buffer.size - start) return &block;
    }
    // A block of a finished frame: the smallest that fits, so that large ones stay for those that need them.
    Block* best = nullptr;
    for (Block& block : blocks_) {
        bool const is_free = block.frame < count_.finished && block.frame != count_.recording;
        if (is_free && bytes <= block.buffer.size && (best == nullptr || block.buffer.size < best->buffer.size))
            best = &block;
    }
    if (best != nullptr) {
        best->used = 0;
        best->frame = count_.recording;
    }
    return best;
}

Result<HostSlice> Staging::take(VkDeviceSize bytes, VkDeviceSize alignment) {
    GNOMON_EXPECT(alignment != 0 && alignment <= 256 && (alignment & (alignment - 1)) == 0);
    Block* block = block_for(bytes, alignment);
    if (block == nullptr) {
        VkBufferUsageFlags const usage = config_.use == MemoryUse::upload ? VK_BUFFER_USAGE_TRANSFER_SRC_BIT
                                                                          : VK_BUFFER_USAGE_TRANSFER_DST_BIT;
        auto buffer = make_buffer(gpu_, std::max<VkDeviceSize>({bytes, config_.block_bytes, 1}), usage, config_.use);
        if (!buffer) return std::move(buffer).failure();
        blocks_.push_back({*std::move(buffer), 0, count_.recording});
        block = &blocks_.back();
    }
    HostSlice slice;
    slice.buffer = block->buffer.handle.get();
    slice.offset = aligned(block->used, alignment);
    slice.bytes =
        block->buffer.mapped().subspan(static_cast<std::size_t>(slice.offset), static_cast<std::size_t>(bytes));
    slice.memory = block->buffer.allocation.memory();
    block->used = slice.offset + bytes;
    return slice;
}

Result<core::Done> Staging::flush() {
    for (Block const& block : blocks_) {
        if (block.frame != count_.recording || block.used == 0) continue;
        if (auto ok = vulkan::flush(*gpu_, block.buffer.allocation.memory(), 0, block.used); !ok) return ok;
    }
    return core::Done{};
}

VkDeviceSize Staging::held_bytes() const noexcept {
    VkDeviceSize sum = 0;
    for (Block const& block : blocks_) sum += block.buffer.size;
    return sum;
}

Result<core::Done> Staging::upload(VkCommandBuffer commands, std::span<std::byte const> bytes, VkBuffer buffer,
                                   VkDeviceSize offset) {
    if (bytes.empty()) return core::Done{};
    auto const slice = take(bytes.size());
    if (!slice) return slice.failure();
    std::memcpy(slice->bytes.data(), bytes.data(), bytes.size());
    VkBufferCopy const region{slice->offset, offset, bytes.size()};
    gpu_->call.CmdCopyBuffer(commands, slice->buffer, buffer, 1, &region);
    return core::Done{};
}

}  // namespace gnomon::vulkan
