#include <gnomon/vulkan/ring.hpp>

#include <string>

namespace gnomon::vulkan {

namespace {

/// Frames are apart by what any offset needs to be a multiple of: storage buffers, flushes, copies.
constexpr VkDeviceSize granule = 256;

constexpr VkDeviceSize up_to(VkDeviceSize value, VkDeviceSize step) noexcept { return (value + step - 1) / step * step; }

}  // namespace

Result<HostRing> HostRing::make(GpuRef const& gpu, RingConfig const& config) {
    if (config.frames == 0 || config.bytes_per_frame == 0 || config.use == MemoryUse::device)
        return core::Failure{Error::bad_argument, "a ring of " + std::to_string(config.frames) + " frames of " +
                                                      std::to_string(config.bytes_per_frame) +
                                                      " bytes: it needs at least 1 of each, and memory that the host sees"};
    HostRing ring;
    ring.gpu_ = gpu;
    ring.frames_ = config.frames;
    ring.stride_ = up_to(config.bytes_per_frame, granule);
    VkBufferUsageFlags const copies =
        config.use == MemoryUse::upload ? VK_BUFFER_USAGE_TRANSFER_SRC_BIT : VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    auto buffer = make_buffer(gpu, ring.stride_ * config.frames, config.usage != 0 ? config.usage : copies, config.use);
    if (!buffer) return std::move(buffer).failure();
    ring.buffer_ = *std::move(buffer);
    return ring;
}

Result<core::Done> HostRing::begin_frame(FrameCount const& count) {
    auto const slot = slot_of(count, frames_);
    if (!slot) return slot.failure();
    now_ = *slot;
    used_ = 0;
    needed_ = 0;
    return core::Done{};
}

Result<HostSlice> HostRing::take(VkDeviceSize bytes, VkDeviceSize alignment) {
    GNOMON_EXPECT(alignment != 0 && alignment <= granule && (alignment & (alignment - 1)) == 0);
    needed_ = up_to(needed_, alignment) + bytes;
    VkDeviceSize const start = up_to(used_, alignment);
    if (start > stride_ || bytes > stride_ - start)
        return core::Failure{Error::too_large, "a frame needs " + std::to_string(needed_) + " bytes of a ring that has " +
                                                   std::to_string(stride_) +
                                                   ": make it with so many bytes per frame"};
    used_ = start + bytes;
    HostSlice slice;
    slice.buffer = buffer_.handle.get();
    slice.offset = now_ * stride_ + start;
    slice.bytes = buffer_.mapped().subspan(static_cast<std::size_t>(slice.offset), static_cast<std::size_t>(bytes));
    slice.memory = buffer_.allocation.memory();
    return slice;
}

Result<core::Done> HostRing::flush() {
    return vulkan::flush(*gpu_, buffer_.allocation.memory(), now_ * stride_, used_);
}

}  // namespace gnomon::vulkan
