#include "vulkan_depth.hpp"

#include "depth_vert.h"

#include <vulkan/vulkan_raii.hpp>

#include <chrono>
#include <cstring>
#include <stdexcept>

namespace lavapipe {

namespace {

constexpr vk::Format depth_format = vk::Format::eD32Sfloat;

/// A buffer that the host sees for its whole life.
struct HostBuffer {
    vk::raii::Buffer buffer = nullptr;
    vk::raii::DeviceMemory memory = nullptr;
    void* mapped = nullptr;
};

std::uint32_t memory_type(vk::raii::PhysicalDevice const& physical, std::uint32_t allowed, vk::MemoryPropertyFlags wanted) {
    auto const properties = physical.getMemoryProperties();
    for (std::uint32_t i = 0; i < properties.memoryTypeCount; ++i)
        if ((allowed >> i & 1U) != 0 && (properties.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    throw std::runtime_error("the Vulkan device has no memory type that the comparison needs");
}

HostBuffer make_buffer(vk::raii::PhysicalDevice const& physical, vk::raii::Device const& device, std::size_t bytes,
                       vk::BufferUsageFlags usage) {
    HostBuffer made;
    made.buffer = vk::raii::Buffer(device, vk::BufferCreateInfo({}, bytes, usage));
    auto const needs = made.buffer.getMemoryRequirements();
    constexpr auto visible = vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;
    made.memory = vk::raii::DeviceMemory(
        device, vk::MemoryAllocateInfo(needs.size, memory_type(physical, needs.memoryTypeBits, visible)));
    made.buffer.bindMemory(*made.memory, 0);
    made.mapped = made.memory.mapMemory(0, VK_WHOLE_SIZE);
    return made;
}

vk::raii::PhysicalDevice pick_cpu_device(vk::raii::Instance const& instance) {
    for (auto& physical : vk::raii::PhysicalDevices(instance))
        if (physical.getProperties().deviceType == vk::PhysicalDeviceType::eCpu) return std::move(physical);
    throw std::runtime_error("no Vulkan device runs on the CPU: install lavapipe (Debian: mesa-vulkan-drivers)");
}

vk::raii::Device make_device(vk::raii::PhysicalDevice const& physical) {
    float const priority = 1.0F;
    vk::DeviceQueueCreateInfo const queue({}, 0, 1, &priority);
    vk::PhysicalDeviceVulkan13Features features;
    features.dynamicRendering = VK_TRUE;
    features.synchronization2 = VK_TRUE;
    vk::DeviceCreateInfo info({}, queue);
    info.pNext = &features;
    return {physical, info};
}

vk::raii::Pipeline make_pipeline(vk::raii::Device const& device, vk::raii::PipelineLayout const& layout, std::uint32_t size) {
    vk::raii::ShaderModule const module(device, vk::ShaderModuleCreateInfo({}, sizeof(depth_vert), depth_vert));
    vk::PipelineShaderStageCreateInfo const stage({}, vk::ShaderStageFlagBits::eVertex, *module, "main");
    vk::VertexInputBindingDescription const binding(0, sizeof(gnomon::math::vec3), vk::VertexInputRate::eVertex);
    vk::VertexInputAttributeDescription const attribute(0, 0, vk::Format::eR32G32B32Sfloat, 0);
    vk::PipelineVertexInputStateCreateInfo const input({}, binding, attribute);
    vk::PipelineInputAssemblyStateCreateInfo const assembly({}, vk::PrimitiveTopology::eTriangleList);
    vk::Viewport const viewport(0, 0, static_cast<float>(size), static_cast<float>(size), 0, 1);
    vk::Rect2D const scissor({0, 0}, {size, size});
    vk::PipelineViewportStateCreateInfo const viewports({}, viewport, scissor);
    vk::PipelineRasterizationStateCreateInfo raster;
    raster.cullMode = vk::CullModeFlagBits::eNone;
    raster.lineWidth = 1.0F;
    vk::PipelineMultisampleStateCreateInfo const samples;
    vk::PipelineDepthStencilStateCreateInfo const depth({}, VK_TRUE, VK_TRUE, vk::CompareOp::eLess);
    vk::PipelineRenderingCreateInfo const rendering(0, {}, depth_format);
    vk::GraphicsPipelineCreateInfo info({}, stage, &input, &assembly, nullptr, &viewports, &raster, &samples, &depth,
                                        nullptr, nullptr, *layout);
    info.pNext = &rendering;
    return {device, nullptr, info};
}

}  // namespace

struct VulkanDepth::State {
    vk::raii::Context context;
    vk::raii::Instance instance;
    vk::raii::PhysicalDevice physical;
    vk::raii::Device device;
    vk::raii::Queue queue;
    std::uint32_t size;
    std::uint32_t index_count;
    HostBuffer positions;
    HostBuffer indices;
    HostBuffer pixels;
    vk::raii::Image image = nullptr;
    vk::raii::DeviceMemory image_memory = nullptr;
    vk::raii::ImageView image_view = nullptr;
    vk::raii::PipelineLayout layout = nullptr;
    vk::raii::Pipeline pipeline = nullptr;
    vk::raii::CommandPool pool = nullptr;
    vk::raii::CommandBuffer commands = nullptr;

    static vk::InstanceCreateInfo const& instance_info() {
        static vk::ApplicationInfo const app("gnomon raster comparison", 0, nullptr, 0, VK_API_VERSION_1_3);
        static vk::InstanceCreateInfo const info({}, &app);
        return info;
    }

    State(std::span<gnomon::math::vec3 const> vertices, std::span<std::uint32_t const> list, int size_px)
        : instance(context, instance_info()), physical(pick_cpu_device(instance)), device(make_device(physical)),
          queue(device, 0, 0), size(static_cast<std::uint32_t>(size_px)),
          index_count(static_cast<std::uint32_t>(list.size())),
          positions(make_buffer(physical, device, vertices.size_bytes(), vk::BufferUsageFlagBits::eVertexBuffer)),
          indices(make_buffer(physical, device, list.size_bytes(), vk::BufferUsageFlagBits::eIndexBuffer)),
          pixels(make_buffer(physical, device, std::size_t{4} * size * size, vk::BufferUsageFlagBits::eTransferDst)) {
        std::memcpy(positions.mapped, vertices.data(), vertices.size_bytes());
        std::memcpy(indices.mapped, list.data(), list.size_bytes());
        make_image();
        vk::PushConstantRange const push(vk::ShaderStageFlagBits::eVertex, 0, sizeof(gnomon::math::mat4));
        layout = vk::raii::PipelineLayout(device, vk::PipelineLayoutCreateInfo({}, {}, push));
        pipeline = make_pipeline(device, layout, size);
        pool = vk::raii::CommandPool(device, {vk::CommandPoolCreateFlagBits::eResetCommandBuffer, 0});
        commands = std::move(vk::raii::CommandBuffers(device, {*pool, vk::CommandBufferLevel::ePrimary, 1}).front());
    }

    void make_image() {
        constexpr auto usage = vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eTransferSrc;
        image = vk::raii::Image(device, vk::ImageCreateInfo({}, vk::ImageType::e2D, depth_format, {size, size, 1}, 1, 1,
                                                            vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal, usage));
        auto const needs = image.getMemoryRequirements();
        image_memory = vk::raii::DeviceMemory(
            device, vk::MemoryAllocateInfo(needs.size, memory_type(physical, needs.memoryTypeBits, {})));
        image.bindMemory(*image_memory, 0);
        vk::ImageSubresourceRange const all(vk::ImageAspectFlagBits::eDepth, 0, 1, 0, 1);
        image_view = vk::raii::ImageView(device, {{}, *image, vk::ImageViewType::e2D, depth_format, {}, all});
    }

    void change_layout(vk::ImageLayout from, vk::ImageLayout to) {
        constexpr auto stage = vk::PipelineStageFlagBits2::eAllCommands;
        constexpr auto access = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite;
        vk::ImageMemoryBarrier2 const barrier(stage, access, stage, access, from, to, VK_QUEUE_FAMILY_IGNORED,
                                              VK_QUEUE_FAMILY_IGNORED, *image,
                                              {vk::ImageAspectFlagBits::eDepth, 0, 1, 0, 1});
        commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, barrier));
    }

    void record_draw(gnomon::math::mat4 const& matrix) {
        commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
        change_layout(vk::ImageLayout::eUndefined, vk::ImageLayout::eDepthAttachmentOptimal);
        vk::RenderingAttachmentInfo depth;
        depth.imageView = *image_view;
        depth.imageLayout = vk::ImageLayout::eDepthAttachmentOptimal;
        depth.loadOp = vk::AttachmentLoadOp::eClear;
        depth.storeOp = vk::AttachmentStoreOp::eStore;
        depth.clearValue.depthStencil = vk::ClearDepthStencilValue(1.0F, 0);
        commands.beginRendering({{}, {{0, 0}, {size, size}}, 1, 0, 0, nullptr, &depth});
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline);
        commands.bindVertexBuffers(0, *positions.buffer, {0});
        commands.bindIndexBuffer(*indices.buffer, 0, vk::IndexType::eUint32);
        commands.pushConstants<gnomon::math::mat4>(*layout, vk::ShaderStageFlagBits::eVertex, 0, matrix);
        commands.drawIndexed(index_count, 1, 0, 0, 0);
        commands.endRendering();
        commands.end();
    }

    void submit_and_wait() {
        vk::CommandBufferSubmitInfo const buffer(*commands);
        queue.submit2(vk::SubmitInfo2({}, {}, buffer));
        queue.waitIdle();
    }
};

VulkanDepth::VulkanDepth(std::span<gnomon::math::vec3 const> positions, std::span<std::uint32_t const> indices, int size_px)
    : state_(std::make_unique<State>(positions, indices, size_px)) {}

VulkanDepth::~VulkanDepth() = default;

std::string VulkanDepth::device_name() const { return state_->physical.getProperties().deviceName.data(); }

double VulkanDepth::draw_ms(gnomon::math::mat4 const& clip_from_position) {
    state_->record_draw(clip_from_position);
    auto const begin = std::chrono::steady_clock::now();
    state_->submit_and_wait();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

std::vector<float> VulkanDepth::read_back() {
    State& s = *state_;
    s.commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    s.change_layout(vk::ImageLayout::eDepthAttachmentOptimal, vk::ImageLayout::eTransferSrcOptimal);
    vk::BufferImageCopy const copy(0, 0, 0, {vk::ImageAspectFlagBits::eDepth, 0, 0, 1}, {}, {s.size, s.size, 1});
    s.commands.copyImageToBuffer(*s.image, vk::ImageLayout::eTransferSrcOptimal, *s.pixels.buffer, copy);
    s.commands.end();
    s.submit_and_wait();
    std::vector<float> depth(std::size_t{s.size} * s.size);
    std::memcpy(depth.data(), s.pixels.mapped, depth.size() * sizeof(float));
    return depth;
}

}  // namespace lavapipe
