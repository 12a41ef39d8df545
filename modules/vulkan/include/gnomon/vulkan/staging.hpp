#pragma once
// Staging that grows: for uploads that happen once, and for frames whose bytes nobody knows beforehand.

#include <gnomon/vulkan/ring.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::vulkan {

struct StagingConfig {
    VkDeviceSize block_bytes = VkDeviceSize{1} << 20U;  ///< Least size of a block of memory.
    std::uint32_t frames = 2;                           ///< In flight.
    MemoryUse use = MemoryUse::upload;                  ///< Or `read_back`.
    std::uint32_t idle_frames = 16;  ///< A block that so many frames did not use is given back.
};

/// Blocks of mapped memory. A block belongs to one frame until that has finished; then any frame may use it again.
///
/// Frames that need no more than those before make nothing.
class Staging {
  public:
    Staging(GpuRef gpu, StagingConfig const& config) : gpu_(std::move(gpu)), config_(config) {}

    [[nodiscard]] Result<core::Done> begin_frame(FrameCount const& count);
    /// The next bytes of this frame; makes a block when none has room.
    ///
    /// expects: `alignment` a power of two, at most 256.
    /// returns: `out_of_device_memory` and its kin when a block cannot be had; what was taken stays.
    [[nodiscard]] Result<HostSlice> take(VkDeviceSize bytes, VkDeviceSize alignment = 16);
    /// Copies bytes into staging and records the copy from there to `buffer`. Barriers are the caller's.
    [[nodiscard]] Result<core::Done> upload(VkCommandBuffer commands, std::span<std::byte const> bytes, VkBuffer buffer,
                                            VkDeviceSize offset);
    /// Makes what the host wrote visible to the device: call before submitting. Upload only.
    [[nodiscard]] Result<core::Done> flush();

    /// Of all blocks.
    [[nodiscard]] VkDeviceSize held_bytes() const noexcept;

  private:
    struct Block {
        Buffer buffer;
        VkDeviceSize used = 0;
        std::uint64_t frame = 0;  ///< The last that used it.
    };

    [[nodiscard]] Block* block_for(VkDeviceSize bytes, VkDeviceSize alignment) noexcept;

    GpuRef gpu_;
    StagingConfig config_;
    std::vector<Block> blocks_;
    FrameCount count_;
};

}  // namespace gnomon::vulkan
