// Kernels: the verb `run`.

#include "backend_state.hpp"

namespace gnomon::vulkan {

backend::Result<core::Done> Backend::State::find(std::string_view verb, std::span<backend::BufferId const> wanted_buffers,
                                                 std::span<backend::TargetBinding const> wanted_targets, Bindings& out) {
    for (std::size_t i = 0; i < wanted_buffers.size(); ++i) {
        KeptBuffer* const buffer = buffers.find(wanted_buffers[i]);
        if (buffer == nullptr) return backend::unknown_id(verb, "buffer", wanted_buffers[i].value);
        out.buffers[i] = buffer;
        out.infos[i] = {buffer->buffer.handle.get(), 0, buffer->buffer.size};
    }
    for (std::size_t i = 0; i < wanted_targets.size(); ++i) {
        backend::TargetBinding const& binding = wanted_targets[i];
        Target* const target = targets.find(binding.target);
        if (target == nullptr) return backend::unknown_id(verb, "target", binding.target.value);
        backend::TargetPart const nothing{binding.target, 0, binding.plane, {}};
        if (auto ok = backend::check_part(verb, nothing, target->config()); !ok) return ok;
        out.targets[i] = target;
        out.images[i] = {VK_NULL_HANDLE, image_of(*target, binding.plane).view, Target::sampled_layout};
    }
    return core::Done{};
}

backend::Result<core::Done> Backend::run(backend::Kernel const& kernel, backend::KernelCall const& call) {
    State& state = *state_;
    if (auto ok = backend::check(kernel, call); !ok) return ok;
    Bindings found;
    if (auto ok = state.find("run", call.buffers, call.targets, found); !ok) return ok;
    auto const compute = state.compiled(kernel);
    if (!compute) return to_backend(compute.failure());
    if (call.count == 0) return core::Done{};
    auto const commands = state.commands();
    if (!commands) return to_backend(commands.failure());
    for (std::uint32_t i = 0; i < kernel.buffers; ++i) {
        if ((*compute)->may_write(i)) state.order.writes(found.buffers[i]->touched);
        else state.order.reads(found.buffers[i]->touched);
    }
    state.order.apply(*state.gpu, *commands);
    for (std::size_t i = 0; i < call.targets.size(); ++i) found.targets[i]->prepare(*commands, TargetUse::sample);
    Dispatch dispatch;
    dispatch.items = call.count;
    dispatch.buffers = {found.infos, call.buffers.size()};
    dispatch.targets = {found.images, call.targets.size()};
    dispatch.constants = call.constants;
    if (auto ok = (*compute)->record(*commands, state.sets, dispatch); !ok) return to_backend(std::move(ok).failure());
    return core::Done{};
}

}  // namespace gnomon::vulkan
