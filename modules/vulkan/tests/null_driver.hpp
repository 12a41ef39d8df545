#pragma once
// A driver that does nothing and asks for no memory but what is mapped: what is counted or timed on it is the module's own.

#include <gnomon/vulkan/gpu.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <type_traits>
#include <vector>

namespace gnomon::vulkan::test {

namespace null_driver {

struct Counts {
    std::uint64_t makes = 0;       ///< Objects, memory, pipelines.
    std::uint64_t draw_calls = 0;  ///< And dispatches.
    std::uint64_t commands = 0;    ///< Everything named Cmd.
};
inline Counts counts;

/// Handles hold the size of what they stand for, so that nothing must be kept.
template <class Handle>
Handle handle_of(VkDeviceSize size) noexcept {
    return reinterpret_cast<Handle>(static_cast<std::uintptr_t>(++counts.makes << 40U | size));
}
template <class Handle>
VkDeviceSize size_of(Handle handle) noexcept {
    return reinterpret_cast<std::uintptr_t>(handle) & ((std::uintptr_t{1} << 40U) - 1);
}

template <class Function>
struct Answer;
template <class R, class... A>
struct Answer<R(VKAPI_PTR*)(A...)> {
    static VKAPI_ATTR R VKAPI_CALL nothing(A...) {
        if constexpr (!std::is_void_v<R>) return R{};
    }
    static VKAPI_ATTR R VKAPI_CALL command(A...) { ++counts.commands; }
    static VKAPI_ATTR R VKAPI_CALL draw(A...) {
        ++counts.commands;
        ++counts.draw_calls;
    }
};
template <class Info, class Handle>
VKAPI_ATTR VkResult VKAPI_CALL make(VkDevice, Info const*, VkAllocationCallbacks const*, Handle* out) {
    *out = handle_of<Handle>(1);
    return VK_SUCCESS;
}
template <class Info>
VKAPI_ATTR VkResult VKAPI_CALL make_pipelines(VkDevice, VkPipelineCache, std::uint32_t n, Info const*,
                                              VkAllocationCallbacks const*, VkPipeline* out) {
    for (std::uint32_t i = 0; i < n; ++i) out[i] = handle_of<VkPipeline>(1);
    return VK_SUCCESS;
}

inline VKAPI_ATTR VkResult VKAPI_CALL make_buffer(VkDevice, VkBufferCreateInfo const* info, VkAllocationCallbacks const*,
                                                  VkBuffer* out) {
    *out = handle_of<VkBuffer>(info->size);
    return VK_SUCCESS;
}
inline VKAPI_ATTR void VKAPI_CALL buffer_need(VkDevice, VkBuffer buffer, VkMemoryRequirements* out) {
    *out = {size_of(buffer), 256, 1};
}
inline VKAPI_ATTR void VKAPI_CALL image_need(VkDevice, VkImage, VkMemoryRequirements* out) { *out = {256, 256, 1}; }
inline VKAPI_ATTR VkResult VKAPI_CALL format_limits(VkPhysicalDevice, VkFormat, VkImageType, VkImageTiling,
                                                    VkImageUsageFlags, VkImageCreateFlags, VkImageFormatProperties* out) {
    *out = {{16384, 16384, 1}, 15, 2048, VK_SAMPLE_COUNT_1_BIT, ~VkDeviceSize{0}};
    return VK_SUCCESS;
}
inline VKAPI_ATTR VkResult VKAPI_CALL make_memory(VkDevice, VkMemoryAllocateInfo const* info, VkAllocationCallbacks const*,
                                                  VkDeviceMemory* out) {
    *out = handle_of<VkDeviceMemory>(info->allocationSize);
    return VK_SUCCESS;
}
/// Freed when the program ends: the tests that use it are short.
inline std::deque<std::vector<std::byte>> mapped;
inline VKAPI_ATTR VkResult VKAPI_CALL map(VkDevice, VkDeviceMemory memory, VkDeviceSize, VkDeviceSize, VkMemoryMapFlags,
                                          void** out) {
    *out = mapped.emplace_back(static_cast<std::size_t>(size_of(memory))).data();
    return VK_SUCCESS;
}
inline VKAPI_ATTR VkResult VKAPI_CALL make_sets(VkDevice, VkDescriptorSetAllocateInfo const* info, VkDescriptorSet* out) {
    for (std::uint32_t i = 0; i < info->descriptorSetCount; ++i) out[i] = reinterpret_cast<VkDescriptorSet>(8);
    return VK_SUCCESS;
}

inline Functions functions() {
    Functions f;
#define GNOMON_TEST_NOTHING(name) f.name = &Answer<PFN_vk##name>::nothing;
    GNOMON_VULKAN_INSTANCE_FUNCTIONS(GNOMON_TEST_NOTHING)
    GNOMON_VULKAN_DEVICE_FUNCTIONS(GNOMON_TEST_NOTHING)
#undef GNOMON_TEST_NOTHING
#define GNOMON_TEST_COMMAND(name) f.name = &Answer<PFN_vk##name>::command;
    GNOMON_TEST_COMMAND(CmdPipelineBarrier2) GNOMON_TEST_COMMAND(CmdBeginRendering) GNOMON_TEST_COMMAND(CmdEndRendering)
    GNOMON_TEST_COMMAND(CmdBindPipeline) GNOMON_TEST_COMMAND(CmdBindDescriptorSets) GNOMON_TEST_COMMAND(CmdPushConstants)
    GNOMON_TEST_COMMAND(CmdCopyBuffer) GNOMON_TEST_COMMAND(CmdWriteTimestamp2)
#undef GNOMON_TEST_COMMAND
#define GNOMON_TEST_DRAW(name) f.name = &Answer<PFN_vk##name>::draw;
    GNOMON_TEST_DRAW(CmdDraw) GNOMON_TEST_DRAW(CmdDrawIndirect) GNOMON_TEST_DRAW(CmdDrawIndexed)
    GNOMON_TEST_DRAW(CmdDrawIndexedIndirect) GNOMON_TEST_DRAW(CmdDrawIndexedIndirectCount) GNOMON_TEST_DRAW(CmdDispatch)
#undef GNOMON_TEST_DRAW
#define GNOMON_TEST_MAKE(name, Info, Handle) f.name = &make<Info, Handle>;
    GNOMON_TEST_MAKE(CreateImage, VkImageCreateInfo, VkImage)
    GNOMON_TEST_MAKE(CreateImageView, VkImageViewCreateInfo, VkImageView)
    GNOMON_TEST_MAKE(CreateShaderModule, VkShaderModuleCreateInfo, VkShaderModule)
    GNOMON_TEST_MAKE(CreateDescriptorSetLayout, VkDescriptorSetLayoutCreateInfo, VkDescriptorSetLayout)
    GNOMON_TEST_MAKE(CreatePipelineLayout, VkPipelineLayoutCreateInfo, VkPipelineLayout)
    GNOMON_TEST_MAKE(CreateDescriptorPool, VkDescriptorPoolCreateInfo, VkDescriptorPool)
    GNOMON_TEST_MAKE(CreateQueryPool, VkQueryPoolCreateInfo, VkQueryPool)
#undef GNOMON_TEST_MAKE
    f.CreateComputePipelines = &make_pipelines<VkComputePipelineCreateInfo>;
    f.CreateGraphicsPipelines = &make_pipelines<VkGraphicsPipelineCreateInfo>;
    f.CreateBuffer = &make_buffer;
    f.GetBufferMemoryRequirements = &buffer_need;
    f.GetImageMemoryRequirements = &image_need;
    f.GetPhysicalDeviceImageFormatProperties = &format_limits;
    f.AllocateMemory = &make_memory;
    f.MapMemory = &map;
    f.AllocateDescriptorSets = &make_sets;
    return f;
}

}  // namespace null_driver

/// A device of this driver, with the properties of a real one.
inline GpuRef null_gpu(Properties const& properties, Features const& features) {
    auto gpu = std::make_shared<Gpu>();
    gpu->call = null_driver::functions();
    gpu->properties = properties;
    gpu->features = features;
    gpu->timestamp_bits = 64;
    gpu->memory_properties.memoryTypeCount = 1;
    gpu->memory_properties.memoryTypes[0].propertyFlags =
        VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT |
        VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    return gpu;
}

}  // namespace gnomon::vulkan::test
