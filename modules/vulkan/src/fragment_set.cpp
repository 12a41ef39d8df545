#include "fragment_set.hpp"

#include <gnomon/vulkan/shader.hpp>

#include <string>

namespace gnomon::vulkan::detail {

namespace {

Result<core::Done> check_limits(VkPhysicalDeviceLimits const& limits, FragmentSetConfig const& config) {
    auto const refuse = [&](std::uint32_t count, std::string const& what, std::uint32_t most) {
        return core::Failure{Error::missing_feature, "kernel '" + std::string(config.name) + "' has " + std::to_string(count) + ' ' + what +
                                                         "; the device binds " + std::to_string(most)};
    };
    if (config.shape.buffers > limits.maxPerStageDescriptorStorageBuffers)
        return refuse(config.shape.buffers, "buffers", limits.maxPerStageDescriptorStorageBuffers);
    if (config.shape.targets > limits.maxPerStageDescriptorSampledImages)
        return refuse(config.shape.targets, "targets", limits.maxPerStageDescriptorSampledImages);
    return core::Done{};
}

}  // namespace

Result<FragmentSet> FragmentSet::make(GpuRef const& gpu, FragmentSetConfig const& config) {
    if (auto ok = check_limits(gpu->properties.limits, config); !ok) return std::move(ok).failure();
    auto const shader = reflect(config.spirv, config.name);
    if (!shader) return shader.failure();
    if (auto ok = check_fragment_shader(*shader, config.shape, config.limits, config.name); !ok) return std::move(ok).failure();
    auto set = make_kernel_set_layout(gpu, config.shape, VK_SHADER_STAGE_FRAGMENT_BIT, config.name);
    if (!set) return std::move(set).failure();
    VkDescriptorSetLayout const both[] = {config.before, set->get()};
    auto layout = make_pipeline_layout(gpu, std::span(both).subspan(config.limits.set == 0 ? 1 : 0), config.constants, config.name);
    if (!layout) return std::move(layout).failure();
    FragmentSet made;
    made.gpu_ = gpu;
    made.config_ = config;
    made.set_ = *std::move(set);
    made.layout_ = *std::move(layout);
    return made;
}

Result<UniquePipeline> FragmentSet::make_pipeline(std::span<std::uint32_t const> vertex, std::string_view vertex_name,
                                                  GraphicsPipeline build) const {
    auto const corners = make_shader(gpu_, vertex, vertex_name);
    if (!corners) return corners.failure();
    auto const fragments = make_shader(gpu_, config_.spirv, config_.name);
    if (!fragments) return fragments.failure();
    build.name = config_.name;
    build.layout = layout_.get();
    build.vertex = corners->get();
    build.fragment = fragments->get();
    build.has_positions = false;
    return make_graphics_pipeline(gpu_, build);
}

Result<core::Done> FragmentSet::bind(VkCommandBuffer commands, DescriptorRing& sets, FragmentInputs const& inputs) const {
    if (!inputs.constants.empty())
        gpu_->call.CmdPushConstants(commands, layout_.get(), config_.constants.stageFlags, config_.limits.first_constant,
                                    static_cast<std::uint32_t>(inputs.constants.size()), inputs.constants.data());
    KernelShape const& shape = config_.shape;
    if (shape.buffers + shape.targets == 0) return core::Done{};
    auto const set = sets.take(set_.get(), {shape.buffers, shape.targets});
    if (!set) return set.failure();
    write_kernel_set(*gpu_, *set, inputs.buffers, inputs.targets);
    gpu_->call.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), config_.limits.set, 1, &*set, 0, nullptr);
    return core::Done{};
}

}  // namespace gnomon::vulkan::detail
