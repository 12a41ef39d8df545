#include "test_device.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/vulkan/gpu.hpp>

using namespace gnomon;

TEST_CASE("a device is taken as the caller gives it, or refused with what is missing", "[vulkan][gpu]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    auto const gpu = vulkan::make_gpu(device->config());
    REQUIRE(gpu);
    CHECK((*gpu)->properties.api_version >= VK_API_VERSION_1_3);
    CHECK(std::string((*gpu)->properties.name) != "");

    vulkan::GpuConfig config = device->config();
    config.device = VK_NULL_HANDLE;
    CHECK(vulkan::make_gpu(config).failure().code == vulkan::Error::bad_argument);
    config = device->config();
    config.loader = nullptr;
    CHECK(vulkan::make_gpu(config).failure().code == vulkan::Error::bad_argument);
    config = device->config();
    config.queue_family = 99;
    CHECK(vulkan::make_gpu(config).failure().message.find("99") != std::string::npos);
    config = device->config();
    config.memory.allocate = [](void*, VkMemoryRequirements const&, vulkan::MemoryUse, vulkan::Memory&) { return VK_SUCCESS; };
    CHECK(vulkan::make_gpu(config).failure().message.find("both") != std::string::npos);
    CHECK(device->take_messages() == "");
}
