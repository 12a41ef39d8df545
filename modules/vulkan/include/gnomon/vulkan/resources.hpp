#pragma once
// Buffers and images with their memory, from the caller's hooks.

#include <gnomon/vulkan/gpu.hpp>

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::vulkan {

/// Memory that goes back to where it came from.
class Allocation {
  public:
    Allocation() noexcept = default;
    Allocation(GpuRef gpu, Memory const& memory) noexcept : gpu_(std::move(gpu)), memory_(memory) {}
    Allocation(Allocation&& other) noexcept;
    Allocation& operator=(Allocation&& other) noexcept;
    ~Allocation();

    [[nodiscard]] Memory const& memory() const noexcept { return memory_; }

  private:
    GpuRef gpu_;
    Memory memory_;
};

/// returns: memory that fits, or why not; the message says how many bytes were asked for and what for.
[[nodiscard]] Result<Allocation> allocate(GpuRef const& gpu, VkMemoryRequirements const& need, MemoryUse use,
                                          std::string_view what);

/// Makes the host's writes to [offset, offset + size) visible to the device, or the device's to the host. Both do
/// nothing on coherent memory.
[[nodiscard]] Result<core::Done> flush(Gpu const& gpu, Memory const& memory, VkDeviceSize offset, VkDeviceSize size);
[[nodiscard]] Result<core::Done> invalidate(Gpu const& gpu, Memory const& memory, VkDeviceSize offset, VkDeviceSize size);

struct Buffer {
    Allocation allocation;  ///< Before the handle: freed after it.
    UniqueBuffer handle;
    VkDeviceSize size = 0;

    /// The mapped bytes; empty for `MemoryUse::device`.
    [[nodiscard]] std::span<std::byte> mapped() const noexcept {
        auto* const bytes = static_cast<std::byte*>(allocation.memory().mapped);
        return {bytes, bytes == nullptr ? 0 : static_cast<std::size_t>(size)};
    }
};

/// expects: size > 0.
[[nodiscard]] Result<Buffer> make_buffer(GpuRef const& gpu, VkDeviceSize size, VkBufferUsageFlags usage, MemoryUse use);

/// A 2D image array of one mip.
struct ImageConfig {
    VkFormat format = VK_FORMAT_D32_SFLOAT;
    VkExtent2D extent{1, 1};
    std::uint32_t layers = 1;
    VkImageUsageFlags usage = 0;
};

struct Image {
    Allocation allocation;
    UniqueImage handle;
    UniqueImageView array_view;  ///< All layers, VK_IMAGE_VIEW_TYPE_2D_ARRAY.
    ImageConfig config;
    VkImageAspectFlags aspect = 0;
};

/// returns: the image, or `unsupported_format` or `too_large` with the device's limit.
[[nodiscard]] Result<Image> make_image(GpuRef const& gpu, ImageConfig const& config);

[[nodiscard]] VkImageAspectFlags aspect_of(VkFormat format) noexcept;

}  // namespace gnomon::vulkan
