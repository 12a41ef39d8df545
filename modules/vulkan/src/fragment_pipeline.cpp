#include "fragment_pipeline.hpp"

#include <gnomon/vulkan/kernel.hpp>
#include <gnomon/vulkan/shader.hpp>
#include <gnomon/vulkan/spirv.hpp>
#include <gnomon/vulkan/target.hpp>

#include "graphics_pipeline.hpp"
#include "pass_layout.hpp"

#include "shaders/shaded_vert.hpp"

namespace gnomon::vulkan {

namespace {

static_assert(sizeof(detail::PassPush) <= backend::fragment_constant_offset);

core::Failure<Error> refuse(Error code, backend::FragmentKernel const& kernel, std::string const& why) {
    return {code, "kernel '" + std::string(kernel.name) + "' " + why};
}

Result<core::Done> check_shader(backend::FragmentKernel const& kernel, ShaderInterface const& shader) {
    if (shader.constant_bytes > backend::fragment_constant_offset + kernel.constant_bytes)
        return refuse(Error::shader_rejected, kernel,
                      "reads push constants up to byte " + std::to_string(shader.constant_bytes) + ", but is given " +
                          std::to_string(kernel.constant_bytes) + " bytes from byte " +
                          std::to_string(backend::fragment_constant_offset) + " on");
    for (ShaderBinding const& b : shader.bindings) {
        bool const is_buffer = b.binding < kernel.buffers;
        VkDescriptorType const wanted = is_buffer ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER : VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
        bool const fits = b.set == 1 && b.binding < kernel.buffers + kernel.targets && b.type == wanted;
        if (fits && (!is_buffer || b.read_only)) continue;
        return refuse(Error::shader_rejected, kernel,
                      "declares set " + std::to_string(b.set) + " binding " + std::to_string(b.binding) +
                          " otherwise than as one of " + std::to_string(kernel.buffers) +
                          " readonly storage buffers from 0 on and " + std::to_string(kernel.targets) +
                          " textures after them, in set 1");
    }
    return core::Done{};
}

bool blends_colors(Gpu const& gpu) noexcept {
    VkFormatProperties properties{};
    gpu.call.GetPhysicalDeviceFormatProperties(gpu.physical, color_format, &properties);
    return (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT) != 0;
}

VkPipelineColorBlendAttachmentState blend_state(backend::Blend blend) noexcept {
    VkPipelineColorBlendAttachmentState state = detail::GraphicsPipeline{}.blend;
    state.blendEnable = VK_TRUE;
    state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    if (blend == backend::Blend::replace_and_add) return state;
    state.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    return state;
}

}  // namespace

Result<FragmentPipeline> FragmentPipeline::make(PassPipelinesRef const& passes, backend::FragmentKernel const& kernel) {
    Gpu const& gpu = *passes->gpu();
    VkPhysicalDeviceLimits const& limits = gpu.properties.limits;
    if (kernel.buffers > limits.maxPerStageDescriptorStorageBuffers || kernel.targets > limits.maxPerStageDescriptorSampledImages)
        return refuse(Error::missing_feature, kernel,
                      "has " + std::to_string(kernel.buffers) + " buffers; the device binds " +
                          std::to_string(limits.maxPerStageDescriptorStorageBuffers));
    if (!blends_colors(gpu)) return refuse(Error::missing_feature, kernel, "needs a device that blends 32-bit float colours");
    auto const shader = reflect(kernel.spirv, kernel.name);
    if (!shader) return shader.failure();
    if (auto ok = check_shader(kernel, *shader); !ok) return std::move(ok).failure();
    FragmentPipeline made;
    made.passes_ = passes;
    made.kernel_ = &kernel;
    if (auto ok = made.make_layouts(); !ok) return std::move(ok).failure();
    return made;
}

Result<core::Done> FragmentPipeline::make_layouts() {
    GpuRef const& gpu = passes_->gpu();
    VkDescriptorSetLayoutBinding bindings[backend::max_kernel_buffers + backend::max_kernel_targets] = {};
    std::uint32_t const count = kernel_->buffers + kernel_->targets;
    for (std::uint32_t i = 0; i < count; ++i) {
        VkDescriptorType const type = i < kernel_->buffers ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER : VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
        bindings[i] = {i, type, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
    }
    VkDescriptorSetLayoutCreateInfo set_info{};
    set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set_info.bindingCount = count;
    set_info.pBindings = bindings;
    VkDescriptorSetLayout set = VK_NULL_HANDLE;
    VkResult result = gpu->call.CreateDescriptorSetLayout(gpu->device, &set_info, gpu->host, &set);
    if (result != VK_SUCCESS) return failure_of(result, "vkCreateDescriptorSetLayout of a fragment kernel");
    set_layout_ = UniqueSetLayout(gpu, set);
    VkDescriptorSetLayout const sets[] = {passes_->set_layout(), set};
    VkPushConstantRange const range{detail::push_stages, 0, backend::max_constant_bytes};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = 2;
    info.pSetLayouts = sets;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &range;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    result = gpu->call.CreatePipelineLayout(gpu->device, &info, gpu->host, &layout);
    if (result != VK_SUCCESS) return failure_of(result, "vkCreatePipelineLayout of a fragment kernel");
    layout_ = UniquePipelineLayout(gpu, layout);
    return core::Done{};
}

Result<VkPipeline> FragmentPipeline::get(backend::Blend blend) {
    UniquePipeline& kept = pipelines_[blend == backend::Blend::over ? 1 : 0];
    if (kept) return kept.get();
    GpuRef const& gpu = passes_->gpu();
    auto const vertex = make_shader(gpu, shaded_vert, "shaded.vert");
    if (!vertex) return vertex.failure();
    auto const fragment = make_shader(gpu, kernel_->spirv, kernel_->name);
    if (!fragment) return fragment.failure();
    detail::GraphicsPipeline build;
    build.name = kernel_->name;
    build.layout = layout_.get();
    build.vertex = vertex->get();
    build.fragment = fragment->get();
    build.has_positions = false;
    build.color_format = color_format;
    build.blend = blend_state(blend);
    auto made = detail::make_graphics_pipeline(gpu, build);
    if (!made) return std::move(made).failure();
    kept = *std::move(made);
    return kept.get();
}

Result<core::Done> FragmentPipeline::bind(VkCommandBuffer commands, DescriptorRing& sets, FragmentInputs const& inputs) const {
    Gpu const& gpu = *passes_->gpu();
    std::uint32_t const count = kernel_->buffers + kernel_->targets;
    if (!inputs.constants.empty())
        gpu.call.CmdPushConstants(commands, layout_.get(), detail::push_stages, backend::fragment_constant_offset,
                                  static_cast<std::uint32_t>(inputs.constants.size()), inputs.constants.data());
    if (count == 0) return core::Done{};
    auto const set = sets.take(set_layout_.get(), {kernel_->buffers, kernel_->targets});
    if (!set) return set.failure();
    VkWriteDescriptorSet writes[backend::max_kernel_buffers + backend::max_kernel_targets] = {};
    for (std::uint32_t i = 0; i < count; ++i) {
        bool const is_buffer = i < kernel_->buffers;
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = *set;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = is_buffer ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER : VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
        writes[i].pBufferInfo = is_buffer ? &inputs.buffers[i] : nullptr;
        writes[i].pImageInfo = is_buffer ? nullptr : &inputs.targets[i - kernel_->buffers];
    }
    gpu.call.UpdateDescriptorSets(gpu.device, count, writes, 0, nullptr);
    gpu.call.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 1, 1, &*set, 0, nullptr);
    return core::Done{};
}

}  // namespace gnomon::vulkan
