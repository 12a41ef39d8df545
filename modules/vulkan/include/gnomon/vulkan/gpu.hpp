#pragma once
// The caller's device as the adapters see it: handles, functions, features, and hooks for memory. Nothing here is owned.

#include <gnomon/vulkan/error.hpp>
#include <gnomon/vulkan/features.hpp>
#include <gnomon/vulkan/functions.hpp>

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <memory>

namespace gnomon::vulkan {

/// Who touches the memory.
enum class MemoryUse : std::uint8_t {
    device,     ///< The device alone.
    upload,     ///< The host writes, the device reads: host-visible, mapped.
    read_back,  ///< The device writes, the host reads: host-visible, mapped, cached where there is such memory.
};

/// A piece of device memory.
struct Memory {
    VkDeviceMemory handle = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    VkDeviceSize size = 0;
    void* mapped = nullptr;  ///< To the piece's first byte; null for `MemoryUse::device`.
    bool coherent = true;    ///< Else the adapters flush and invalidate.
    void* user = nullptr;    ///< The allocator's own.
};

/// The caller's allocator (VMA, an engine's own). Without one every resource has a VkDeviceMemory of its own.
struct MemoryHooks {
    void* context = nullptr;
    /// Fills `out`; returns VK_SUCCESS or why not.
    VkResult (*allocate)(void* context, VkMemoryRequirements const& need, MemoryUse use, Memory& out) = nullptr;
    void (*release)(void* context, Memory const& memory) = nullptr;
};

struct GpuConfig {
    PFN_vkGetInstanceProcAddr loader = nullptr;
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    std::uint32_t queue_family = 0;  ///< Of the queue that the command buffers go to; graphics and compute.
    Features enabled{};               ///< The optional features that `device` was made with.
    MemoryHooks memory{};
    VkAllocationCallbacks const* host = nullptr;
};

struct Gpu {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    std::uint32_t queue_family = 0;
    VkAllocationCallbacks const* host = nullptr;
    MemoryHooks memory;
    Functions call;
    Features features;
    Properties properties;
    VkPhysicalDeviceMemoryProperties memory_properties{};
    std::uint32_t timestamp_bits = 0;  ///< Valid bits of the queue family's timestamps; 0: it has none.
};

/// Shared by everything that is made on the device. The caller's device must outlive the last of them.
using GpuRef = std::shared_ptr<Gpu const>;

/// Loads the functions and asks the device what it is.
///
/// returns: the device, or what is missing: a handle, Vulkan 1.3, a queue that draws and computes, a feature.
[[nodiscard]] Result<GpuRef> make_gpu(GpuConfig const& config);

/// A handle and how it is destroyed. Moves; the caller sees to it that the device is done with it.
template <class Handle, auto Destroy>
class Unique {
  public:
    Unique() noexcept = default;
    Unique(GpuRef gpu, Handle handle) noexcept : gpu_(std::move(gpu)), handle_(handle) {}
    Unique(Unique&& other) noexcept : gpu_(std::move(other.gpu_)), handle_(std::exchange(other.handle_, VK_NULL_HANDLE)) {}
    Unique& operator=(Unique&& other) noexcept {
        if (this == &other) return *this;
        reset();
        gpu_ = std::move(other.gpu_);
        handle_ = std::exchange(other.handle_, VK_NULL_HANDLE);
        return *this;
    }
    ~Unique() { reset(); }

    [[nodiscard]] Handle get() const noexcept { return handle_; }
    [[nodiscard]] explicit operator bool() const noexcept { return handle_ != VK_NULL_HANDLE; }

  private:
    void reset() noexcept {
        if (handle_ != VK_NULL_HANDLE) (gpu_->call.*Destroy)(gpu_->device, handle_, gpu_->host);
        handle_ = VK_NULL_HANDLE;
    }

    GpuRef gpu_;
    Handle handle_ = VK_NULL_HANDLE;
};

using UniqueBuffer = Unique<VkBuffer, &Functions::DestroyBuffer>;
using UniqueImage = Unique<VkImage, &Functions::DestroyImage>;
using UniqueImageView = Unique<VkImageView, &Functions::DestroyImageView>;
using UniqueShader = Unique<VkShaderModule, &Functions::DestroyShaderModule>;
using UniqueSetLayout = Unique<VkDescriptorSetLayout, &Functions::DestroyDescriptorSetLayout>;
using UniquePipelineLayout = Unique<VkPipelineLayout, &Functions::DestroyPipelineLayout>;
using UniquePipeline = Unique<VkPipeline, &Functions::DestroyPipeline>;
using UniqueDescriptorPool = Unique<VkDescriptorPool, &Functions::DestroyDescriptorPool>;
using UniqueQueryPool = Unique<VkQueryPool, &Functions::DestroyQueryPool>;

}  // namespace gnomon::vulkan
