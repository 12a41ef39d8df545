#include "pass_plan.hpp"

#include <gnomon/backend/check.hpp>

#include <algorithm>

namespace gnomon::vulkan::detail {

namespace {

Bundle bundle_of(backend::PassLayer const& layer, math::ivec2 const& size_px) {
    Bundle bundle;
    bundle.viewport = layer.viewport.value_or(backend::Rect{0, 0, size_px.x, size_px.y});
    bundle.area = backend::area_of(layer, size_px);
    bundle.subpixel = layer.subpixel;
    bundle.depth = layer.depth;
    bundle.range = layer.range;
    return bundle;
}

bool is_alike(Bundle const& a, Bundle const& b) noexcept {
    return a.viewport == b.viewport && a.subpixel == b.subpixel && a.area == b.area && a.depth == b.depth && a.range == b.range;
}

bool has_layer(Chunk const& chunk, Bundle const& bundle, std::uint32_t layer) noexcept {
    for (std::uint32_t i = 0; i < bundle.count; ++i)
        if (chunk.views[bundle.first_view + i]->layer == layer) return true;
    return false;
}

bool is_whole(backend::PassLayer const& layer, math::ivec2 const& size_px) noexcept {
    return backend::area_of(layer, size_px) == backend::Rect{0, 0, size_px.x, size_px.y};
}

}  // namespace

void next_chunk(Chunk& chunk, std::span<backend::PassLayer const>& layers, math::ivec2 const& size_px,
                ChunkLimits const& limits) {
    std::array<backend::PassLayer const*, max_views> taken;
    std::uint32_t count = 0;
    for (; !layers.empty() && count < limits.views; layers = layers.subspan(1))
        if (backend::area_of(layers[0], size_px).width > 0) taken[count++] = &layers[0];
    // Layer by layer, for devices that draw one at a time; few, so a plain insertion will do.
    for (std::uint32_t i = 1; i < count; ++i)
        for (std::uint32_t j = i; j > 0 && taken[j - 1]->layer > taken[j]->layer; --j) std::swap(taken[j - 1], taken[j]);
    chunk.view_count = chunk.bundle_count = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (taken[i] == nullptr) continue;
        Bundle& bundle = chunk.bundles[chunk.bundle_count++];
        bundle = bundle_of(*taken[i], size_px);
        bundle.first_view = chunk.view_count;
        for (std::uint32_t j = i; j < count && bundle.count < limits.bundle; ++j) {
            if (taken[j] == nullptr || !is_alike(bundle, bundle_of(*taken[j], size_px)) ||
                has_layer(chunk, bundle, taken[j]->layer))
                continue;
            chunk.views[chunk.view_count++] = taken[j];
            ++bundle.count;
            taken[j] = nullptr;
        }
    }
}

bool clears_all(std::span<backend::PassLayer const> layers, math::ivec2 const& size_px, std::uint32_t first,
                std::uint32_t count) noexcept {
    for (std::uint32_t at = first; at < first + count; ++at) {
        bool is_cleared = false;
        for (backend::PassLayer const& layer : layers)
            is_cleared = is_cleared || (layer.layer == at && layer.load == backend::Load::clear &&
                                        layer.depth == layers[0].depth && is_whole(layer, size_px));
        if (!is_cleared) return false;
    }
    return !layers.empty();
}

ViewData view_data(backend::PassLayer const& layer) noexcept {
    ViewData data{};
    for (math::axis_t column = 0; column < 4; ++column)
        for (math::axis_t row = 0; row < 4; ++row)
            data.column[column][row] = layer.clip_from_relative[column][row];
    for (math::axis_t axis = 0; axis < 3; ++axis) data.origin[axis] = layer.origin[axis];
    data.layer = layer.layer;
    data.groups[0] = static_cast<std::uint32_t>(layer.groups);
    data.groups[1] = static_cast<std::uint32_t>(layer.groups >> 32U);
    return data;
}

}  // namespace gnomon::vulkan::detail
