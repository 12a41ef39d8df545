#include "draw_list.hpp"

namespace gnomon::vulkan::detail {

Result<core::Done> make_set(DrawList::State& state) {
    GpuRef const& gpu = state.pipelines->gpu();
    VkDescriptorPoolSize const sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, 1},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, binding_count - 1}};
    VkDescriptorPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    info.maxSets = 1;
    info.poolSizeCount = 2;
    info.pPoolSizes = sizes;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkResult result = gpu->call.CreateDescriptorPool(gpu->device, &info, gpu->host, &pool);
    if (result != VK_SUCCESS) return failure_of(result, "vkCreateDescriptorPool of a draw list");
    state.pool = UniqueDescriptorPool(gpu, pool);
    VkDescriptorSetLayout const layout = state.pipelines->set_layout();
    VkDescriptorSetAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocate.descriptorPool = pool;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &layout;
    result = gpu->call.AllocateDescriptorSets(gpu->device, &allocate, &state.set);
    if (result != VK_SUCCESS) return failure_of(result, "vkAllocateDescriptorSets of a draw list");
    VkDescriptorBufferInfo buffers[binding_count];
    VkWriteDescriptorSet writes[binding_count]{};
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < binding_count; ++i) {
        bool const changes = i == binding_views || i == binding_matrices;
        buffers[i] = {changes ? state.changing.handle.get() : state.fixed.handle.get(), state.bound[i].offset,
                      state.bound[i].size};
        VkWriteDescriptorSet& write = writes[count++];
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = state.set;
        write.dstBinding = i;
        write.descriptorCount = 1;
        write.descriptorType = i == binding_views ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC
                                                          : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        write.pBufferInfo = &buffers[i];
    }
    gpu->call.UpdateDescriptorSets(gpu->device, count, writes, 0, nullptr);
    return core::Done{};
}

}  // namespace gnomon::vulkan::detail
