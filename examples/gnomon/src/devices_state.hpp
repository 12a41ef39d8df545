#pragma once
// The Vulkan-Hpp side of devices.hpp. Only the few files that talk to Vulkan include it.

#include "devices.hpp"

#include <vulkan/vulkan_raii.hpp>

namespace gnomon::command {

struct VulkanDevice::State {
    vk::raii::Context context;
    vk::raii::Instance instance = nullptr;
    vk::raii::PhysicalDevice physical = nullptr;
    vk::raii::Device device = nullptr;
    vk::raii::Queue queue = nullptr;
    vk::raii::CommandPool pool = nullptr;
    vk::raii::CommandBuffer commands = nullptr;
    vk::raii::Fence fence = nullptr;
    std::uint32_t queue_family = 0;
    DeviceInfo info;
};

}  // namespace gnomon::command
