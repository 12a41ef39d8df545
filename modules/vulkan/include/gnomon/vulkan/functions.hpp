#pragma once
// The Vulkan functions that the adapters call, loaded through the caller's own loader: nothing is linked.

#include <gnomon/vulkan/error.hpp>

#include <vulkan/vulkan_core.h>

namespace gnomon::vulkan {

#define GNOMON_VULKAN_INSTANCE_FUNCTIONS(X)                                                                   \
    X(GetDeviceProcAddr) X(GetPhysicalDeviceFeatures2) X(GetPhysicalDeviceProperties2)                        \
    X(GetPhysicalDeviceMemoryProperties) X(GetPhysicalDeviceQueueFamilyProperties)                            \
    X(GetPhysicalDeviceFormatProperties) X(GetPhysicalDeviceImageFormatProperties)

#define GNOMON_VULKAN_DEVICE_FUNCTIONS(X)                                                                     \
    X(AllocateMemory) X(FreeMemory) X(MapMemory) X(FlushMappedMemoryRanges) X(InvalidateMappedMemoryRanges)   \
    X(CreateBuffer) X(DestroyBuffer) X(GetBufferMemoryRequirements) X(BindBufferMemory)                       \
    X(CreateImage) X(DestroyImage) X(GetImageMemoryRequirements) X(BindImageMemory)                           \
    X(CreateImageView) X(DestroyImageView) X(CreateShaderModule) X(DestroyShaderModule)                       \
    X(CreateDescriptorSetLayout) X(DestroyDescriptorSetLayout) X(CreatePipelineLayout)                        \
    X(DestroyPipelineLayout) X(CreateComputePipelines) X(CreateGraphicsPipelines) X(DestroyPipeline)          \
    X(CreateDescriptorPool) X(DestroyDescriptorPool) X(ResetDescriptorPool) X(AllocateDescriptorSets)         \
    X(UpdateDescriptorSets) X(CreateQueryPool) X(DestroyQueryPool) X(ResetQueryPool) X(GetQueryPoolResults)   \
    X(CmdPipelineBarrier2) X(CmdBeginRendering) X(CmdEndRendering) X(CmdBindPipeline)                         \
    X(CmdBindDescriptorSets) X(CmdPushConstants) X(CmdBindVertexBuffers) X(CmdBindIndexBuffer)                \
    X(CmdSetViewport) X(CmdSetScissor) X(CmdSetDepthBias) X(CmdSetCullMode) X(CmdSetFrontFace)                \
    X(CmdSetDepthCompareOp) X(CmdSetDepthWriteEnable) X(CmdSetDepthBiasEnable) X(CmdDraw) X(CmdDrawIndirect)  \
    X(CmdDrawIndexed) X(CmdDrawIndexedIndirect)                                                               \
    X(CmdDrawIndexedIndirectCount) X(CmdDispatch) X(CmdDispatchIndirect) X(CmdCopyBuffer) X(CmdCopyImage)     \
    X(CmdCopyImageToBuffer) X(CmdCopyBufferToImage) X(CmdFillBuffer) X(CmdUpdateBuffer)                       \
    X(CmdClearColorImage) X(CmdClearDepthStencilImage) X(CmdClearAttachments) X(CmdResetQueryPool)            \
    X(CmdWriteTimestamp2) X(CmdBeginQuery) X(CmdEndQuery) X(CmdCopyQueryPoolResults)

/// One pointer for each function, by its name without "vk": `functions.CmdDispatch(...)`.
struct Functions {
#define GNOMON_VULKAN_MEMBER(name) PFN_vk##name name = nullptr;
    GNOMON_VULKAN_INSTANCE_FUNCTIONS(GNOMON_VULKAN_MEMBER)
    GNOMON_VULKAN_DEVICE_FUNCTIONS(GNOMON_VULKAN_MEMBER)
#undef GNOMON_VULKAN_MEMBER
};

/// Those that take an instance or a physical device, and no others.
///
/// returns: the table, or the name of the first function that the loader lacks.
[[nodiscard]] Result<Functions> load_instance_functions(PFN_vkGetInstanceProcAddr loader, VkInstance instance);

/// All of them.
[[nodiscard]] Result<Functions> load_functions(PFN_vkGetInstanceProcAddr loader, VkInstance instance, VkDevice device);

}  // namespace gnomon::vulkan
