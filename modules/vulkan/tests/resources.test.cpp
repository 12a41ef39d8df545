#include "test_device.hpp"

#include <gnomon/check/check.hpp>
#include <gnomon/vulkan/resources.hpp>

using namespace gnomon;

TEST_CASE("buffers and images come and go without a message or a leak", "[vulkan][resources]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    {
        vulkan::GpuRef const gpu = device->gpu();
        auto const buffer = vulkan::make_buffer(gpu, 1000, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, vulkan::MemoryUse::upload);
        REQUIRE(buffer);
        CHECK(buffer->mapped().size() == 1000);
        vulkan::ImageConfig config;
        config.extent = {64, 32};
        config.layers = 6;
        config.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
        REQUIRE(vulkan::make_image(gpu, config));
        CHECK(device->live().total() == 2);  // the buffer and its memory; the image is gone again
    }
    CHECK(device->live().total() == 0);
    CHECK(device->take_messages() == "");
}

TEST_CASE("whichever call fails, nothing is left behind and the failure says which", "[vulkan][resources]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::GpuRef const gpu = device->gpu();
    vulkan::ImageConfig config;
    config.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    for (std::uint64_t n = 0; n < 3; ++n) {
        device->fail_call(n, VK_ERROR_OUT_OF_DEVICE_MEMORY);
        auto const image = vulkan::make_image(gpu, config);
        REQUIRE(!image);
        CHECK(image.failure().code == vulkan::Error::out_of_device_memory);
        CHECK(device->live().total() == 0);
    }
    CHECK(vulkan::make_image(gpu, config));
    CHECK(device->take_messages() == "");
}

TEST_CASE("an image beyond the device's limits is refused with the limit", "[vulkan][resources]") {
    auto const device = vulkan::test::Device::make();
    REQUIRE(device != nullptr);
    vulkan::ImageConfig config;
    config.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    config.extent = {1U << 20U, 16};
    auto const wide = vulkan::make_image(device->gpu(), config);
    REQUIRE(!wide);
    CHECK(wide.failure().code == vulkan::Error::too_large);
    CHECK(wide.failure().message.find("1048576x16x1") != std::string::npos);
    config.extent = {16, 16};
    config.format = VK_FORMAT_ASTC_12x12_SRGB_BLOCK;
    auto const strange = vulkan::make_image(device->gpu(), config);
    REQUIRE(!strange);
    CHECK(strange.failure().code == vulkan::Error::unsupported_format);
    CHECK(device->take_messages() == "");
}
