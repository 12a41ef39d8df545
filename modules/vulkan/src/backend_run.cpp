// Kernels: the verb `run`.

#include "backend_state.hpp"

namespace gnomon::vulkan {

backend::Result<core::Done> Backend::run(backend::Kernel const& kernel, backend::KernelCall const& call) {
    State& state = *state_;
    if (auto ok = backend::check(kernel, call); !ok) return ok;
    KeptBuffer* buffers[backend::max_kernel_buffers] = {};
    VkDescriptorBufferInfo infos[backend::max_kernel_buffers] = {};
    for (std::size_t i = 0; i < call.buffers.size(); ++i) {
        buffers[i] = state.buffers.find(call.buffers[i]);
        if (buffers[i] == nullptr) return backend::unknown_id("run", "buffer", call.buffers[i].value);
        infos[i] = {buffers[i]->buffer.handle.get(), 0, buffers[i]->buffer.size};
    }
    Target* targets[backend::max_kernel_targets] = {};
    VkDescriptorImageInfo images[backend::max_kernel_targets] = {};
    for (std::size_t i = 0; i < call.targets.size(); ++i) {
        backend::TargetBinding const& binding = call.targets[i];
        targets[i] = state.targets.find(binding.target);
        if (targets[i] == nullptr) return backend::unknown_id("run", "target", binding.target.value);
        backend::TargetPart const nothing{binding.target, 0, binding.plane, {}};
        if (auto ok = backend::check_part("run", nothing, targets[i]->config()); !ok) return ok;
        images[i] = {VK_NULL_HANDLE, image_of(*targets[i], binding.plane).view, Target::sampled_layout};
    }
    auto const compute = state.compiled(kernel);
    if (!compute) return to_backend(compute.failure());
    if (call.count == 0) return core::Done{};
    auto const commands = state.commands();
    if (!commands) return to_backend(commands.failure());
    for (std::uint32_t i = 0; i < kernel.buffers; ++i) {
        if ((*compute)->may_write(i)) state.order.writes(buffers[i]->touched);
        else state.order.reads(buffers[i]->touched);
    }
    state.order.apply(*state.gpu, *commands);
    for (std::size_t i = 0; i < call.targets.size(); ++i) targets[i]->prepare(*commands, TargetUse::sample);
    Dispatch dispatch;
    dispatch.items = call.count;
    dispatch.buffers = {infos, call.buffers.size()};
    dispatch.targets = {images, call.targets.size()};
    dispatch.constants = call.constants;
    if (auto ok = (*compute)->record(*commands, state.sets, dispatch); !ok) return to_backend(std::move(ok).failure());
    return core::Done{};
}

}  // namespace gnomon::vulkan
