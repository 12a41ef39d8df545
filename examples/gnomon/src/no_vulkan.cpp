// In place of devices.cpp where the command was built without the module vulkan.

#include "devices.hpp"

#include <exception>

namespace gnomon::command {

struct VulkanDevice::State {};

namespace {

core::Failure<Exit> not_built() {
    return failure("there is no Vulkan here: this gnomon was built without it; build it where glslc and Vulkan's headers "
                   "are installed (Debian: glslc libvulkan-dev), or use --backend cpu");
}

}  // namespace

VulkanDevice::VulkanDevice(std::unique_ptr<State> state) : state_(std::move(state)) {}
VulkanDevice::~VulkanDevice() = default;

// Nobody has a device to call these of.
DeviceInfo const& VulkanDevice::info() const noexcept { std::terminate(); }
backend::Backend& VulkanDevice::backend() noexcept { std::terminate(); }

Outcome<std::vector<DeviceInfo>> vulkan_devices() { return not_built(); }
Outcome<std::unique_ptr<VulkanDevice>> VulkanDevice::open(std::optional<std::string> const&) { return not_built(); }

}  // namespace gnomon::command
