#include <gnomon/vulkan/kernel.hpp>

#include <gnomon/vulkan/spirv.hpp>

#include "kernel_bindings.hpp"

#include <algorithm>

namespace gnomon::vulkan {

namespace {

core::Failure<Error> refuse(Error code, std::string_view name, std::string const& why) {
    return {code, "kernel '" + std::string(name) + "' " + why};
}

Result<core::Done> check_counts(ComputeConfig const& config) {
    if (config.buffers <= max_compute_buffers && config.targets <= max_compute_targets &&
        config.constant_bytes <= max_compute_constant_bytes && config.constant_bytes % 4 == 0)
        return core::Done{};
    return refuse(Error::bad_argument, config.name,
                  "has " + std::to_string(config.buffers) + " buffers, " + std::to_string(config.targets) +
                      " targets and " + std::to_string(config.constant_bytes) + " bytes of constants; there may be " +
                      std::to_string(max_compute_buffers) + ", " + std::to_string(max_compute_targets) + " and " +
                      std::to_string(max_compute_constant_bytes) + " in fours");
}

Result<core::Done> check_limits(ComputeConfig const& config, VkPhysicalDeviceLimits const& limits) {
    if (config.buffers <= limits.maxPerStageDescriptorStorageBuffers &&
        config.targets <= limits.maxPerStageDescriptorSampledImages)
        return core::Done{};
    return refuse(Error::missing_feature, config.name,
                  "has " + std::to_string(config.buffers) + " buffers and " + std::to_string(config.targets) +
                      " targets; the device binds " + std::to_string(limits.maxPerStageDescriptorStorageBuffers) +
                      " and " + std::to_string(limits.maxPerStageDescriptorSampledImages));
}

Result<core::Done> check_shader(ComputeConfig const& config, ShaderInterface const& shader) {
    auto const& size = shader.local_size;
    if (size[0] != compute_local_size || size[1] != 1 || size[2] != 1)
        return refuse(Error::shader_rejected, config.name,
                      "has local size " + std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " +
                          std::to_string(size[2]) + "; it must be 64 x 1 x 1");
    if (shader.constant_bytes > config.constant_bytes)
        return refuse(Error::shader_rejected, config.name,
                      "reads " + std::to_string(shader.constant_bytes) + " bytes of push constants, but is given " +
                          std::to_string(config.constant_bytes));
    for (ShaderBinding const& b : shader.bindings) {
        bool const is_buffer = b.binding < config.buffers;
        VkDescriptorType const wanted = is_buffer ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER : VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
        if (b.set == 0 && b.binding < config.buffers + config.targets && b.type == wanted) continue;
        return refuse(Error::shader_rejected, config.name,
                      "declares set " + std::to_string(b.set) + " binding " + std::to_string(b.binding) +
                          " otherwise than as one of " + std::to_string(config.buffers) +
                          " storage buffers from 0 on and " + std::to_string(config.targets) + " textures after them");
    }
    return core::Done{};
}

}  // namespace

Result<Grid> grid_of(std::uint64_t items, VkPhysicalDeviceLimits const& limits, bool reads_group_count,
                     std::string_view name) {
    std::uint64_t const groups = (items + compute_local_size - 1) / compute_local_size;
    std::uint64_t const most = limits.maxComputeWorkGroupCount[0];
    if (groups <= most) return Grid{static_cast<std::uint32_t>(groups), groups == 0 ? 0U : 1U};
    if (!reads_group_count)
        return refuse(Error::too_large, name,
                      "is to run on " + std::to_string(items) + " items; the device takes " +
                          std::to_string(most * compute_local_size) +
                          " in a row: find the item with gl_NumWorkGroups too, as kernel.hpp of the backend says");
    std::uint64_t const rows = (groups + most - 1) / most;
    std::uint64_t const columns = (groups + rows - 1) / rows;
    if (rows > limits.maxComputeWorkGroupCount[1] || rows * columns > (std::uint64_t{1} << 32U) / compute_local_size)
        return refuse(Error::too_large, name,
                      "is to run on " + std::to_string(items) + " items: more than the device or 32 bits can count");
    return Grid{static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows)};
}

Result<ComputeKernel> ComputeKernel::make(GpuRef const& gpu, ComputeConfig const& config) {
    if (auto ok = check_counts(config); !ok) return std::move(ok).failure();
    if (auto ok = check_limits(config, gpu->properties.limits); !ok) return std::move(ok).failure();
    if (config.spirv.empty())
        return refuse(Error::shader_rejected, config.name, "has no SPIR-V; glslc was missing when this was built");
    auto const shader = reflect(config.spirv, config.name);
    if (!shader) return shader.failure();
    if (auto ok = check_shader(config, *shader); !ok) return std::move(ok).failure();
    ComputeKernel kernel;
    kernel.gpu_ = gpu;
    kernel.name_ = std::string(config.name);
    kernel.buffers_ = config.buffers;
    kernel.targets_ = config.targets;
    kernel.constant_bytes_ = config.constant_bytes;
    kernel.takes_grids_ = shader->reads_group_count;
    for (ShaderBinding const& b : shader->bindings)
        if (b.binding < config.buffers && !b.read_only) kernel.written_ |= 1U << b.binding;
    if (auto ok = kernel.make_layouts(); !ok) return std::move(ok).failure();
    if (auto ok = kernel.make_pipeline(config.spirv); !ok) return std::move(ok).failure();
    return kernel;
}

Result<core::Done> ComputeKernel::make_layouts() {
    auto set = detail::make_kernel_set_layout(gpu_, {buffers_, targets_}, VK_SHADER_STAGE_COMPUTE_BIT, name_);
    if (!set) return std::move(set).failure();
    set_layout_ = *std::move(set);
    VkDescriptorSetLayout const sets[] = {set_layout_.get()};
    auto layout = detail::make_pipeline_layout(gpu_, sets, {VK_SHADER_STAGE_COMPUTE_BIT, 0, constant_bytes_}, name_);
    if (!layout) return std::move(layout).failure();
    pipeline_layout_ = *std::move(layout);
    return core::Done{};
}

Result<core::Done> ComputeKernel::make_pipeline(std::span<std::uint32_t const> spirv) {
    auto const shader = make_shader(gpu_, spirv, name_);
    if (!shader) return shader.failure();
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = shader->get();
    info.stage.pName = "main";
    info.layout = pipeline_layout_.get();
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkResult const result =
        gpu_->call.CreateComputePipelines(gpu_->device, VK_NULL_HANDLE, 1, &info, gpu_->host, &pipeline);
    if (result != VK_SUCCESS) return failure_of(result, "vkCreateComputePipelines of " + name_);
    pipeline_ = UniquePipeline(gpu_, pipeline);
    return core::Done{};
}

Result<core::Done> ComputeKernel::check(Dispatch const& d) const {
    if (d.buffers.size() != buffers_ || d.targets.size() != targets_ || d.constants.size() != constant_bytes_)
        return refuse(Error::bad_argument, name_,
                      "is given " + std::to_string(d.buffers.size()) + " buffers, " + std::to_string(d.targets.size()) +
                          " targets and " + std::to_string(d.constants.size()) + " bytes of constants; it has " +
                          std::to_string(buffers_) + ", " + std::to_string(targets_) + " and " +
                          std::to_string(constant_bytes_));
    VkDeviceSize const most = gpu_->properties.limits.maxStorageBufferRange;
    for (VkDescriptorBufferInfo const& b : d.buffers)
        if (b.range != VK_WHOLE_SIZE && b.range > most)
            return refuse(Error::too_large, name_,
                          "is given a buffer of " + std::to_string(b.range) + " bytes; the device binds " +
                              std::to_string(most));
    return core::Done{};
}

void ComputeKernel::bind(VkCommandBuffer commands, VkDescriptorSet set, Dispatch const& dispatch) const {
    Functions const& call = gpu_->call;
    if (buffers_ + targets_ > 0) {
        detail::write_kernel_set(*gpu_, set, dispatch.buffers, dispatch.targets);
        call.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_layout_.get(), 0, 1, &set, 0, nullptr);
    }
    call.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
    if (constant_bytes_ > 0)
        call.CmdPushConstants(commands, pipeline_layout_.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, constant_bytes_,
                              dispatch.constants.data());
}

Result<core::Done> ComputeKernel::record(VkCommandBuffer commands, DescriptorRing& sets,
                                         Dispatch const& dispatch) const {
    if (auto ok = check(dispatch); !ok) return ok;
    if (dispatch.items == 0) return core::Done{};
    auto const grid = grid_of(dispatch.items, gpu_->properties.limits, takes_grids_, name_);
    if (!grid) return grid.failure();
    VkDescriptorSet set = VK_NULL_HANDLE;
    if (buffers_ + targets_ > 0) {
        auto const taken = sets.take(set_layout_.get(), {buffers_, targets_});
        if (!taken) return taken.failure();
        set = *taken;
    }
    bind(commands, set, dispatch);
    gpu_->call.CmdDispatch(commands, grid->x, grid->y, 1);
    return core::Done{};
}

}  // namespace gnomon::vulkan
