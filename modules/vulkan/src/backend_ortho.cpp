// The verbs `draw_ortho` and `write_depth`: passes in whole units, and depths from kernels.

#include <gnomon/backend/check_ortho.hpp>

#include "backend_state.hpp"
#include "draw_list.hpp"

#include <string>

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

backend::Result<core::Done> Backend::write_depth(backend::DepthKernel const&, backend::DepthCall const&) {
    return core::Failure{backend::Error::missing_feature, std::string("write_depth: not on this backend yet")};
}

}  // namespace gnomon::vulkan
