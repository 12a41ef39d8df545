#include <gnomon/vulkan/read_back.hpp>

#include <gnomon/vulkan/barrier.hpp>

#include <string>

namespace gnomon::vulkan {

void copy_part(Gpu const& gpu, VkCommandBuffer commands, ImagePart const& part, HostSlice const& slice) noexcept {
    VkBufferImageCopy region{};
    region.bufferOffset = slice.offset;
    region.imageSubresource = {part.aspect, 0, part.layer, 1};
    region.imageOffset = {part.offset.x, part.offset.y, 0};
    region.imageExtent = {part.extent.width, part.extent.height, 1};
    gpu.call.CmdCopyImageToBuffer(commands, part.image, part.layout, slice.buffer, 1, &region);
}

Result<ReadBack> ReadBack::make(GpuRef const& gpu, RingConfig config) {
    config.use = MemoryUse::read_back;
    config.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    auto ring = HostRing::make(gpu, config);
    if (!ring) return std::move(ring).failure();
    ReadBack back;
    back.gpu_ = gpu;
    back.ring_ = *std::move(ring);
    return back;
}

Result<core::Done> ReadBack::begin_frame(FrameCount const& count) {
    if (auto ok = ring_.begin_frame(count); !ok) return ok;
    count_ = count;
    return core::Done{};
}

Result<ReadTicket> ReadBack::copy(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size) {
    auto const slice = ring_.take(size);
    if (!slice) return slice.failure();
    VkBufferCopy const region{offset, slice->offset, size};
    if (size > 0) gpu_->call.CmdCopyBuffer(commands, buffer, slice->buffer, 1, &region);
    return ReadTicket{count_.recording, *slice};
}

Result<ReadTicket> ReadBack::copy(VkCommandBuffer commands, ImagePart const& part) {
    auto const slice = ring_.take(VkDeviceSize{part.extent.width} * part.extent.height * part.pixel_bytes);
    if (!slice) return slice.failure();
    if (!slice->bytes.empty()) copy_part(*gpu_, commands, part, *slice);
    return ReadTicket{count_.recording, *slice};
}

void ReadBack::order_host(VkCommandBuffer commands) const noexcept { order_for_host(*gpu_, commands); }

Result<std::span<std::byte const>> ReadBack::values(ReadTicket const& ticket, std::uint64_t finished) const {
    if (ticket.frame >= finished)
        return core::Failure{Error::bad_argument, "frame " + std::to_string(ticket.frame) + " is read back before it is "
                                                      "known to have finished; " +
                                                      std::to_string(finished) + " frames have"};
    if (count_.recording >= ticket.frame + ring_.frames())
        return core::Failure{Error::bad_argument, "frame " + std::to_string(ticket.frame) + " was read too late: its " +
                                                      "place belongs to frame " + std::to_string(count_.recording)};
    HostSlice const& slice = ticket.slice;
    if (auto ok = invalidate(*gpu_, slice.memory, slice.offset, slice.bytes.size()); !ok) return std::move(ok).failure();
    return std::span<std::byte const>(slice.bytes);
}

}  // namespace gnomon::vulkan
