#include "kernel_bindings.hpp"

#include <gnomon/backend/kernel.hpp>

#include <string>

namespace gnomon::vulkan::detail {

namespace {

constexpr std::uint32_t max_bindings = backend::max_kernel_buffers + backend::max_kernel_targets;

constexpr VkDescriptorType type_of(KernelShape const& shape, std::uint32_t binding) noexcept {
    return binding < shape.buffers ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER : VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
}

core::Failure<Error> reject(std::string_view name, std::string const& why) {
    return {Error::shader_rejected, "kernel '" + std::string(name) + "' " + why};
}

}  // namespace

Result<UniqueSetLayout> make_kernel_set_layout(GpuRef const& gpu, KernelShape const& shape, VkShaderStageFlags stages,
                                               std::string_view name) {
    VkDescriptorSetLayoutBinding bindings[max_bindings] = {};
    std::uint32_t const count = shape.buffers + shape.targets;
    for (std::uint32_t i = 0; i < count; ++i) bindings[i] = {i, type_of(shape, i), 1, stages, nullptr};
    VkDescriptorSetLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    info.bindingCount = count;
    info.pBindings = bindings;
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    VkResult const result = gpu->call.CreateDescriptorSetLayout(gpu->device, &info, gpu->host, &layout);
    if (result != VK_SUCCESS) return failure_of(result, "vkCreateDescriptorSetLayout of " + std::string(name));
    return UniqueSetLayout(gpu, layout);
}

Result<UniquePipelineLayout> make_pipeline_layout(GpuRef const& gpu, std::span<VkDescriptorSetLayout const> sets,
                                                  VkPushConstantRange const& constants, std::string_view name) {
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = static_cast<std::uint32_t>(sets.size());
    info.pSetLayouts = sets.data();
    info.pushConstantRangeCount = constants.size != 0 ? 1 : 0;
    info.pPushConstantRanges = &constants;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkResult const result = gpu->call.CreatePipelineLayout(gpu->device, &info, gpu->host, &layout);
    if (result != VK_SUCCESS) return failure_of(result, "vkCreatePipelineLayout of " + std::string(name));
    return UniquePipelineLayout(gpu, layout);
}

void write_kernel_set(Gpu const& gpu, VkDescriptorSet set, std::span<VkDescriptorBufferInfo const> buffers,
                      std::span<VkDescriptorImageInfo const> targets) {
    VkWriteDescriptorSet writes[max_bindings] = {};
    KernelShape const shape{static_cast<std::uint32_t>(buffers.size()), static_cast<std::uint32_t>(targets.size())};
    std::uint32_t const count = shape.buffers + shape.targets;
    for (std::uint32_t i = 0; i < count; ++i) {
        VkWriteDescriptorSet& write = writes[i];
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = set;
        write.dstBinding = i;
        write.descriptorCount = 1;
        write.descriptorType = type_of(shape, i);
        if (i < shape.buffers) write.pBufferInfo = &buffers[i];
        else write.pImageInfo = &targets[i - shape.buffers];
    }
    gpu.call.UpdateDescriptorSets(gpu.device, count, writes, 0, nullptr);
}

Result<core::Done> check_fragment_shader(ShaderInterface const& shader, KernelShape const& shape, FragmentLimits const& limits,
                                         std::string_view name) {
    if (shader.constant_bytes > limits.first_constant + limits.constant_bytes)
        return reject(name, "reads push constants up to byte " + std::to_string(shader.constant_bytes) + ", but is given " +
                                std::to_string(limits.constant_bytes) + " bytes from byte " +
                                std::to_string(limits.first_constant) + " on");
    for (ShaderBinding const& b : shader.bindings) {
        bool const fits = b.set == limits.set && b.binding < shape.buffers + shape.targets && b.type == type_of(shape, b.binding);
        if (fits && (b.binding >= shape.buffers || b.read_only)) continue;
        return reject(name, "declares set " + std::to_string(b.set) + " binding " + std::to_string(b.binding) +
                                " otherwise than as one of " + std::to_string(shape.buffers) +
                                " readonly storage buffers from 0 on and " + std::to_string(shape.targets) +
                                " textures after them, in set " + std::to_string(limits.set));
    }
    return core::Done{};
}

}  // namespace gnomon::vulkan::detail
