#pragma once
// Read-back without waiting: what frame n copies is read when the caller knows that frame n has finished.
//
// With f frames in flight the values are f - 1 frames old at least, and can be read until frame n + f is begun; nothing
// in flight is ever overwritten, because that frame cannot begin before frame n has finished.

#include <gnomon/vulkan/ring.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::vulkan {

/// A copy that was recorded: where its bytes will be.
struct ReadTicket {
    std::uint64_t frame = 0;
    HostSlice slice;
};

/// A rectangle of one layer of an image.
struct ImagePart {
    VkImage image = VK_NULL_HANDLE;
    VkImageLayout layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    VkImageAspectFlags aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
    std::uint32_t layer = 0;
    VkOffset2D offset{0, 0};
    VkExtent2D extent{0, 0};
    std::uint32_t pixel_bytes = 4;
};

/// Records the copy of an image's part to packed rows at `slice`. Barriers are the caller's.
///
/// expects: slice.offset a multiple of 4 and of the pixel's bytes; slice.bytes holds the part.
void copy_part(Gpu const& gpu, VkCommandBuffer commands, ImagePart const& part, HostSlice const& slice) noexcept;

class ReadBack {
  public:
    /// expects: config.use is looked at no more: the memory is for reading back.
    [[nodiscard]] static Result<ReadBack> make(GpuRef const& gpu, RingConfig config);

    [[nodiscard]] Result<core::Done> begin_frame(FrameCount const& count);
    /// Records a copy. What wrote the bytes must be ordered before by the caller (barrier.hpp).
    ///
    /// returns: `too_large` with the bytes that the frame needs, when they do not fit.
    [[nodiscard]] Result<ReadTicket> copy(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size);
    [[nodiscard]] Result<ReadTicket> copy(VkCommandBuffer commands, ImagePart const& part);
    /// Makes the frame's copies visible to the host: record it after the last of them.
    void end_frame(VkCommandBuffer commands) const noexcept { order_host(commands); }
    /// The bytes, once `finished` frames are done and until the ring comes round.
    ///
    /// returns: `bad_argument` when the frame is not known to be finished, or its place has been given away.
    [[nodiscard]] Result<std::span<std::byte const>> values(ReadTicket const& ticket, std::uint64_t finished) const;

    [[nodiscard]] VkDeviceSize needed() const noexcept { return ring_.needed(); }

  private:
    void order_host(VkCommandBuffer commands) const noexcept;

    GpuRef gpu_;
    HostRing ring_;
    FrameCount count_;
};

}  // namespace gnomon::vulkan
