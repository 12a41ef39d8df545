// The verbs `draw_ortho` and `write_depth`: passes in whole units, and depths from kernels.

#include <gnomon/backend/check_ortho.hpp>

#include "backend_state.hpp"
#include "draw_list.hpp"

namespace gnomon::vulkan {

backend::Result<backend::PassCounts> Backend::draw_ortho(backend::DrawListId list, backend::TargetId target,
                                                         std::span<backend::OrthoLayer const> layers) {
    DrawList* const draws = state_->lists.find(list);
    if (draws == nullptr) return backend::unknown_id("draw_ortho", "draw list", list.value);
    Target* const goal = state_->targets.find(target);
    if (goal == nullptr) return backend::unknown_id("draw_ortho", "target", target.value);
    backend::OrthoList const drawn{draws->state().command_of.size(), draws->state().has_instances};
    if (auto ok = backend::check_layers(layers, goal->config(), drawn); !ok) return std::move(ok).failure();
    auto const pipelines = state_->ortho();
    if (!pipelines) return to_backend(pipelines.failure());
    auto const commands = state_->commands();
    if (!commands) return to_backend(commands.failure());
    auto counts = record_ortho(*commands, **pipelines, *draws, *goal, layers);
    if (!counts) return to_backend(std::move(counts).failure());
    return *counts;
}

backend::Result<core::Done> Backend::write_depth(backend::DepthKernel const& kernel, backend::DepthCall const& call) {
    State& state = *state_;
    Target* const goal = state.targets.find(call.to);
    if (goal == nullptr) return backend::unknown_id("write_depth", "target", call.to.value);
    if (auto ok = backend::check(kernel, call, goal->config()); !ok) return ok;
    Bindings found;
    if (auto ok = state.find("write_depth", call.buffers, call.targets, found); !ok) return ok;
    auto const pipeline = state.compiled(kernel);
    if (!pipeline) return to_backend(pipeline.failure());
    auto const writing = (*pipeline)->get(goal->config().depth);
    if (!writing) return to_backend(writing.failure());
    if (call.rect.width <= 0 || call.rect.height <= 0) return core::Done{};
    auto const commands = state.commands();
    if (!commands) return to_backend(commands.failure());
    FragmentInputs const inputs{{found.infos, call.buffers.size()}, {found.images, call.targets.size()}, call.constants};
    if (auto ok = (*pipeline)->bind(*commands, state.sets, inputs); !ok) return to_backend(std::move(ok).failure());
    for (std::size_t i = 0; i < call.buffers.size(); ++i) state.order.reads(found.buffers[i]->touched);
    state.order.apply(*state.gpu, *commands);
    for (std::size_t i = 0; i < call.targets.size(); ++i) found.targets[i]->prepare(*commands, TargetUse::sample);
    (*pipeline)->draw(*commands, *writing, *goal, call);
    return core::Done{};
}

}  // namespace gnomon::vulkan
