#pragma once
// A host for vulkan::Backend on the tests' device, which can be made to fail.

#include "test_device.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/vulkan/backend.hpp>

#include <cstdint>
#include <memory>
#include <utility>

namespace gnomon::vulkan::test {

struct TestHost {
    explicit TestHost(Device& d) : device(&d) {}

    [[nodiscard]] Host host() {
        return {this,
                [](void* self, VkCommandBuffer& out) { return static_cast<TestHost*>(self)->begin(out); },
                [](void* self, VkCommandBuffer) { return static_cast<TestHost*>(self)->submit(); }};
    }

    VkResult begin(VkCommandBuffer& out) {
        ++begins;
        if (begin_result != VK_SUCCESS) return std::exchange(begin_result, VK_SUCCESS);
        out = device->begin();
        return VK_SUCCESS;
    }
    VkResult submit() {
        ++submits;
        device->submit_and_wait();  // in any case: what is being recorded must end somehow
        return std::exchange(submit_result, VK_SUCCESS);
    }

    Device* device;
    std::uint64_t begins = 0;
    std::uint64_t submits = 0;
    VkResult begin_result = VK_SUCCESS;   ///< Of the next begin.
    VkResult submit_result = VK_SUCCESS;  ///< Of the next submit.
};

/// The tests' device, a host, and a backend over both.
struct DeviceBackend {
    std::unique_ptr<Device> device = Device::make();
    TestHost host{found(device)};
    std::unique_ptr<Backend> gpu;

    explicit DeviceBackend(OrthoPipelinesConfig const& ortho = {}) {
        auto made = Backend::make(device->gpu(), host.host(), ortho);
        REQUIRE(made.has_value());
        gpu = *std::move(made);
    }

  private:
    static Device& found(std::unique_ptr<Device> const& device) {
        REQUIRE(device != nullptr);
        return *device;
    }
};

}  // namespace gnomon::vulkan::test
