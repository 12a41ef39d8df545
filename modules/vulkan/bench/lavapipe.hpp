#pragma once
// The peer: a headless Vulkan 1.3 depth-only pass on lavapipe, one rasterizer thread. One indexed draw, D32 float,
// compare less, no culling, clear included.

#include <gnomon/math/vec.hpp>

#include <vulkan/vulkan.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <vector>

#include "depth_vert.hpp"

namespace bench {

inline void must(VkResult result, char const* what) {
    if (result == VK_SUCCESS) return;
    std::fprintf(stderr, "lavapipe: %s gave VkResult %d\n", what, static_cast<int>(result));
    std::exit(1);
}
#define GNOMON_VK(call) ::bench::must(call, #call)

struct Push {
    gnomon::math::mat4 matrix;
    gnomon::math::vec4 origin;
};

/// Instance, lavapipe's device, a queue; `device` stays null where there is no lavapipe.
struct Vulkan {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    VkCommandPool pool = VK_NULL_HANDLE;
    char name[VK_MAX_PHYSICAL_DEVICE_NAME_SIZE] = {};

    Vulkan() {
        setenv("LP_NUM_THREADS", "0", 1);  // Rasterize on the queue's own thread.
        VkApplicationInfo app{};
        app.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
        app.apiVersion = VK_API_VERSION_1_3;
        VkInstanceCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
        info.pApplicationInfo = &app;
        if (vkCreateInstance(&info, nullptr, &instance) != VK_SUCCESS) return;
        std::uint32_t count = 16;
        VkPhysicalDevice all[16];
        vkEnumeratePhysicalDevices(instance, &count, all);
        for (std::uint32_t i = 0; i < count; ++i) {
            VkPhysicalDeviceProperties properties;
            vkGetPhysicalDeviceProperties(all[i], &properties);
            if (std::strstr(properties.deviceName, "llvmpipe") == nullptr) continue;
            physical = all[i];
            std::memcpy(name, properties.deviceName, sizeof name);
        }
        if (physical != VK_NULL_HANDLE) make_device();
    }
    ~Vulkan() {
        if (pool != VK_NULL_HANDLE) vkDestroyCommandPool(device, pool, nullptr);
        if (device != VK_NULL_HANDLE) vkDestroyDevice(device, nullptr);
        if (instance != VK_NULL_HANDLE) vkDestroyInstance(instance, nullptr);
    }
    Vulkan(Vulkan const&) = delete;
    Vulkan& operator=(Vulkan const&) = delete;

    void make_device() {
        float const priority = 1.0F;
        VkDeviceQueueCreateInfo queue_info{};
        queue_info.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
        queue_info.queueCount = 1;
        queue_info.pQueuePriorities = &priority;
        VkPhysicalDeviceVulkan13Features features{};
        features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
        features.dynamicRendering = VK_TRUE;
        VkDeviceCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
        info.pNext = &features;
        info.queueCreateInfoCount = 1;
        info.pQueueCreateInfos = &queue_info;
        GNOMON_VK(vkCreateDevice(physical, &info, nullptr, &device));
        vkGetDeviceQueue(device, 0, 0, &queue);
        VkCommandPoolCreateInfo pool_info{};
        pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
        GNOMON_VK(vkCreateCommandPool(device, &pool_info, nullptr, &pool));
    }

    [[nodiscard]] VkDeviceMemory allocate(VkMemoryRequirements const& need) const {
        VkPhysicalDeviceMemoryProperties properties;
        vkGetPhysicalDeviceMemoryProperties(physical, &properties);
        VkMemoryPropertyFlags const visible =
            VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
        VkMemoryAllocateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
        info.allocationSize = need.size;
        for (std::uint32_t i = properties.memoryTypeCount; i-- > 0;)
            if (((need.memoryTypeBits >> i) & 1U) != 0 &&
                (properties.memoryTypes[i].propertyFlags & visible) == visible)
                info.memoryTypeIndex = i;
        VkDeviceMemory memory = VK_NULL_HANDLE;
        GNOMON_VK(vkAllocateMemory(device, &info, nullptr, &memory));
        return memory;
    }

    [[nodiscard]] VkCommandBuffer begin() const {
        VkCommandBufferAllocateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        info.commandPool = pool;
        info.commandBufferCount = 1;
        VkCommandBuffer commands = VK_NULL_HANDLE;
        GNOMON_VK(vkAllocateCommandBuffers(device, &info, &commands));
        VkCommandBufferBeginInfo begin_info{};
        begin_info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        GNOMON_VK(vkBeginCommandBuffer(commands, &begin_info));
        return commands;
    }

    void submit_and_wait(VkCommandBuffer commands) const {
        VkSubmitInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        info.commandBufferCount = 1;
        info.pCommandBuffers = &commands;
        GNOMON_VK(vkQueueSubmit(queue, 1, &info, VK_NULL_HANDLE));
        GNOMON_VK(vkQueueWaitIdle(queue));
    }
};

/// A mapped buffer with `data` in it.
struct DeviceBuffer {
    Vulkan const& vk;
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    void* mapped = nullptr;

    DeviceBuffer(Vulkan const& owner, std::size_t size, VkBufferUsageFlags usage, void const* data = nullptr)
        : vk(owner) {
        VkBufferCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
        info.size = size;
        info.usage = usage;
        GNOMON_VK(vkCreateBuffer(vk.device, &info, nullptr, &buffer));
        VkMemoryRequirements need;
        vkGetBufferMemoryRequirements(vk.device, buffer, &need);
        memory = vk.allocate(need);
        GNOMON_VK(vkBindBufferMemory(vk.device, buffer, memory, 0));
        GNOMON_VK(vkMapMemory(vk.device, memory, 0, VK_WHOLE_SIZE, 0, &mapped));
        if (data != nullptr) std::memcpy(mapped, data, size);
    }
    ~DeviceBuffer() {
        vkDestroyBuffer(vk.device, buffer, nullptr);
        vkFreeMemory(vk.device, memory, nullptr);
    }
    DeviceBuffer(DeviceBuffer const&) = delete;
    DeviceBuffer& operator=(DeviceBuffer const&) = delete;
};

}  // namespace bench
