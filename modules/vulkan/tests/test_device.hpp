#pragma once
// A device for the tests: lavapipe where there is one, with the Khronos validation layer and synchronization
// validation on, every message counted, and every call that makes or destroys something counted too.

#include <gnomon/vulkan/gpu.hpp>

#include <vulkan/vulkan.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::vulkan::test {

/// What was made and not yet destroyed, by the name of the function that made it.
struct LiveObjects {
    std::map<std::string, std::int64_t> made;
    std::uint64_t calls = 0;  ///< Of functions that make something, ever.

    [[nodiscard]] std::int64_t total() const;
};

class Device {
  public:
    /// returns: null, after a FAIL that says what to install, where there is no Vulkan or no validation layer.
    static std::unique_ptr<Device> make();
    ~Device();
    Device(Device const&) = delete;
    Device& operator=(Device const&) = delete;

    [[nodiscard]] GpuConfig config() const;
    /// With all features that the device supports.
    [[nodiscard]] GpuRef gpu() const;
    /// The same with fewer, to reach the fallbacks.
    [[nodiscard]] GpuRef gpu_with(Features const& enabled) const;

    /// A command buffer that is being recorded; `submit_and_wait` ends it. One at a time.
    VkCommandBuffer begin();
    void submit_and_wait();

    /// Messages of the validation layer since the last call, one to a line; empty is good.
    [[nodiscard]] std::string take_messages();
    [[nodiscard]] Features const& features() const noexcept { return features_; }
    /// Counted over every Gpu of this device.
    [[nodiscard]] LiveObjects const& live() const noexcept;
    /// The n-th call from now (0: the next) that makes something gives `result` and makes nothing.
    void fail_call(std::uint64_t n, VkResult result);

  private:
    Device() = default;

    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    Features features_;
    std::vector<std::string> messages_;
};

}  // namespace gnomon::vulkan::test
