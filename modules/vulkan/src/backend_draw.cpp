// Draw lists, targets, passes and queries.

#include "backend_state.hpp"

namespace gnomon::vulkan {

backend::Result<backend::DrawListId> Backend::keep(std::span<backend::Draw const> draws) {
    if (state_->ended) return to_backend(*state_->ended);
    auto passes = state_->passes();
    if (!passes) return to_backend(std::move(passes).failure());
    auto list = make_draw_list(*passes, draws);
    if (!list) return to_backend(std::move(list).failure());
    auto const commands = state_->commands();
    if (!commands) return to_backend(commands.failure());
    backend::DrawListId const id = state_->lists.insert(*std::move(list));
    if (id.is_none()) return a_million_live("keep");
    state_->lists.find(id)->record_upload(*commands);
    state_->uploading.push_back(id);
    return id;
}

StagedFaults Backend::faults(backend::DrawListId list) const noexcept {
    DrawList const* const kept = state_->lists.find(list);
    return kept == nullptr ? StagedFaults{} : kept->faults();
}

backend::Result<backend::TargetId> Backend::make_target(backend::TargetConfig const& config) {
    if (state_->ended) return to_backend(*state_->ended);
    if (auto ok = backend::check(config, limits()); !ok) return std::move(ok).failure();
    auto target = vulkan::make_target(state_->gpu, config);
    if (!target) return to_backend(std::move(target).failure());
    backend::TargetId const id = state_->targets.insert(*std::move(target));
    if (id.is_none()) return a_million_live("make_target");
    return id;
}

backend::Result<core::Done> Backend::release(backend::DrawListId list) {
    DrawList* const kept = state_->lists.find(list);
    if (kept == nullptr) return backend::unknown_id("release", "draw list", list.value);
    state_->retire(*kept, state_->retired_lists);
    state_->lists.erase(list);
    return core::Done{};
}

backend::Result<core::Done> Backend::release(backend::TargetId target) {
    Target* const kept = state_->targets.find(target);
    if (kept == nullptr) return backend::unknown_id("release", "target", target.value);
    state_->retire(*kept, state_->retired_targets);
    state_->targets.erase(target);
    return core::Done{};
}

backend::Result<backend::PassCounts> Backend::draw(backend::DrawListId list, backend::TargetId target,
                                                   std::span<backend::PassLayer const> layers) {
    DrawList* const draws = state_->lists.find(list);
    if (draws == nullptr) return backend::unknown_id("draw", "draw list", list.value);
    Target* const goal = state_->targets.find(target);
    if (goal == nullptr) return backend::unknown_id("draw", "target", target.value);
    if (auto ok = backend::check_layers(layers, goal->config(), limits()); !ok) return std::move(ok).failure();
    auto const commands = state_->commands();
    if (!commands) return to_backend(commands.failure());
    auto counts = record_pass(*commands, *draws, *goal, layers);
    if (!counts) return to_backend(std::move(counts).failure());
    return *counts;
}

backend::Result<core::Done> Backend::count_samples(std::span<math::Aabb const> boxes, backend::TargetId target,
                                                   backend::PassLayer const& view, backend::BufferId counts,
                                                   std::size_t first) {
    constexpr std::string_view verb = "count_samples";
    Target* const seen = state_->targets.find(target);
    if (seen == nullptr) return backend::unknown_id(verb, "target", target.value);
    KeptBuffer* const kept = state_->buffers.find(counts);
    if (kept == nullptr) return backend::unknown_id(verb, "buffer", counts.value);
    if (auto ok = backend::check_layer(verb, view, seen->config(), limits()); !ok) return ok;
    std::size_t const places = kept->bytes / 4;
    if (auto ok = backend::check_range(verb, places, first, boxes.size()); !ok) return ok;
    if (boxes.empty()) return core::Done{};
    auto const queries = state_->counting();
    if (!queries) return to_backend(queries.failure());
    auto const commands = state_->commands();
    if (!commands) return to_backend(commands.failure());
    state_->order.writes(kept->touched);
    state_->order.apply(*state_->gpu, *commands);
    CountsOut const out{kept->buffer.handle.get(), VkDeviceSize{first} * 4};
    if (auto ok = (*queries)->record_boxes(*commands, boxes, *seen, view, out); !ok)
        return to_backend(std::move(ok).failure());
    return core::Done{};
}

}  // namespace gnomon::vulkan
