#pragma once
// A device for the benchmarks, lavapipe where there is one, without validation, and a host for the backend on it.

#include <gnomon/vulkan/backend.hpp>

#include <vulkan/vulkan.h>

#include <cstdint>
#include <cstring>

namespace gnomon::vulkan::bench {

class LavapipeGpu {
  public:
    explicit LavapipeGpu(bool indirect) {
        VkApplicationInfo app{};
        app.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
        app.apiVersion = VK_API_VERSION_1_3;
        VkInstanceCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
        info.pApplicationInfo = &app;
        if (vkCreateInstance(&info, nullptr, &instance_) != VK_SUCCESS || !pick()) return;
        auto const functions = load_instance_functions(&vkGetInstanceProcAddr, instance_);
        if (!functions) return;
        Features features = supported_features(*functions, physical_);
        features.sparse_residency = false;
        features.multi_draw_indirect = features.multi_draw_indirect && indirect;
        if (!make_device(features)) return;
        GpuConfig config;
        config.loader = &vkGetInstanceProcAddr;
        config.instance = instance_;
        config.physical = physical_;
        config.device = device_;
        config.enabled = features;
        if (auto made = make_gpu(config)) gpu_ = *made;
    }
    ~LavapipeGpu() {
        gpu_.reset();
        if (device_ != VK_NULL_HANDLE) {
            vkDestroyFence(device_, fence_, nullptr);
            vkDestroyCommandPool(device_, pool_, nullptr);
            vkDestroyDevice(device_, nullptr);
        }
        if (instance_ != VK_NULL_HANDLE) vkDestroyInstance(instance_, nullptr);
    }
    LavapipeGpu(LavapipeGpu const&) = delete;
    LavapipeGpu& operator=(LavapipeGpu const&) = delete;

    [[nodiscard]] GpuRef const& gpu() const noexcept { return gpu_; }
    [[nodiscard]] bool is_lavapipe() const noexcept { return is_lavapipe_; }
    [[nodiscard]] Host host() noexcept {
        return {this,
                [](void* self, VkCommandBuffer& out) { return static_cast<LavapipeGpu*>(self)->begin(out); },
                [](void* self, VkCommandBuffer) { return static_cast<LavapipeGpu*>(self)->submit(); }};
    }

  private:
    bool pick() {
        std::uint32_t count = 16;
        VkPhysicalDevice all[16];
        vkEnumeratePhysicalDevices(instance_, &count, all);
        for (std::uint32_t i = 0; i < count; ++i) {
            VkPhysicalDeviceProperties properties;
            vkGetPhysicalDeviceProperties(all[i], &properties);
            bool const lavapipe = std::strstr(properties.deviceName, "llvmpipe") != nullptr;
            if (i == 0 || lavapipe) physical_ = all[i];
            is_lavapipe_ = is_lavapipe_ || lavapipe;
        }
        return physical_ != VK_NULL_HANDLE;
    }
    bool make_device(Features const& features) {
        float const priority = 1.0F;
        VkDeviceQueueCreateInfo queue{};
        queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
        queue.queueCount = 1;
        queue.pQueuePriorities = &priority;
        FeatureChain const chain(features);
        VkDeviceCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
        info.pNext = chain.head();
        info.queueCreateInfoCount = 1;
        info.pQueueCreateInfos = &queue;
        if (vkCreateDevice(physical_, &info, nullptr, &device_) != VK_SUCCESS) return false;
        vkGetDeviceQueue(device_, 0, 0, &queue_);
        VkCommandPoolCreateInfo pool{};
        pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
        pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
        if (vkCreateCommandPool(device_, &pool, nullptr, &pool_) != VK_SUCCESS) return false;
        VkCommandBufferAllocateInfo buffer{};
        buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        buffer.commandPool = pool_;
        buffer.commandBufferCount = 1;
        VkFenceCreateInfo fence{};
        fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        return vkAllocateCommandBuffers(device_, &buffer, &commands_) == VK_SUCCESS &&
               vkCreateFence(device_, &fence, nullptr, &fence_) == VK_SUCCESS;
    }
    VkResult begin(VkCommandBuffer& out) {
        VkCommandBufferBeginInfo info{};
        info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
        out = commands_;
        return vkBeginCommandBuffer(commands_, &info);
    }
    VkResult submit() {
        VkSubmitInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        info.commandBufferCount = 1;
        info.pCommandBuffers = &commands_;
        VkResult result = vkEndCommandBuffer(commands_);
        if (result == VK_SUCCESS) result = vkQueueSubmit(queue_, 1, &info, fence_);
        if (result == VK_SUCCESS) result = vkWaitForFences(device_, 1, &fence_, VK_TRUE, ~std::uint64_t{0});
        return result == VK_SUCCESS ? vkResetFences(device_, 1, &fence_) : result;
    }

    bool is_lavapipe_ = false;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    GpuRef gpu_;
};

}  // namespace gnomon::vulkan::bench
