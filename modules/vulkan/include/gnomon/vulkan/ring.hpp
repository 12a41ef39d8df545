#pragma once
// A ring in mapped memory: bytes for one frame at a time, of a fixed number of frames in flight.

#include <gnomon/vulkan/frame.hpp>
#include <gnomon/vulkan/resources.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::vulkan {

/// A piece of a mapped buffer.
struct HostSlice {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    std::span<std::byte> bytes;
    Memory memory;  ///< Of the whole buffer, for `invalidate`.
};

struct RingConfig {
    VkDeviceSize bytes_per_frame = 0;
    std::uint32_t frames = 2;                 ///< In flight.
    MemoryUse use = MemoryUse::upload;        ///< Or `read_back`.
    VkBufferUsageFlags usage = 0;             ///< 0: copies from it (upload) or to it (read_back).
};

class HostRing {
  public:
    HostRing() noexcept = default;

    /// cost: memory of `bytes_per_frame` (rounded up to 256) times `frames`.
    [[nodiscard]] static Result<HostRing> make(GpuRef const& gpu, RingConfig const& config);

    /// Frees the place of the frame that is `frames` older.
    [[nodiscard]] Result<core::Done> begin_frame(FrameCount const& count);
    /// The next bytes of this frame.
    ///
    /// expects: `alignment` a power of two, at most 256.
    /// returns: `too_large` with the bytes that the frame needs by now, when they do not fit; what was taken stays.
    [[nodiscard]] Result<HostSlice> take(VkDeviceSize bytes, VkDeviceSize alignment = 16);
    /// Makes what the host wrote in this frame visible to the device: call before submitting. Upload only.
    [[nodiscard]] Result<core::Done> flush();

    /// Bytes that this frame has asked for, those that did not fit included: what to make the ring for.
    [[nodiscard]] VkDeviceSize needed() const noexcept { return needed_; }
    [[nodiscard]] VkDeviceSize capacity() const noexcept { return stride_; }
    [[nodiscard]] std::uint32_t frames() const noexcept { return frames_; }

  private:
    GpuRef gpu_;
    Buffer buffer_;
    VkDeviceSize stride_ = 0;
    std::uint32_t frames_ = 0;
    std::uint32_t now_ = 0;
    VkDeviceSize used_ = 0;
    VkDeviceSize needed_ = 0;
};

}  // namespace gnomon::vulkan
