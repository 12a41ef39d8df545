#pragma once
// A tile's local image, filled from its layer's target and copied back.

#include "plan.hpp"
#include "summary.hpp"

#include <algorithm>
#include <cstdint>

namespace gnomon::raster::detail {

inline void load_tile(LayerPlan const& layer, TileJob const& job, Load load) {
    float const farthest = job.reversed ? 0.0F : job.quantize ? 65535.0F : 1.0F;
    layer.kernel->clear(job, farthest, no_triangle);
    if (load == Load::clear) return;
    DepthTarget const& depth = layer.layer->target;
    for (std::int32_t y = job.y0; y < job.y1; ++y) {
        std::ptrdiff_t const row = std::ptrdiff_t{y - job.y0} * tile_pitch;
        std::int32_t const width = job.x1 - job.x0;
        if (job.quantize)
            std::copy_n(depth.unorm16().row(y) + job.x0, width, job.depth + row);
        else
            std::copy_n(depth.f32().row(y) + job.x0, width, job.depth + row);
        if (job.id != nullptr) std::copy_n(layer.layer->triangle.row(y) + job.x0, width, job.id + row);
    }
}

/// Copies a tile out; past the caches where the image is too large to be found there again.
template <class T>
void store_rows(LayerPlan const& layer, TileJob const& job, T const* from, ImageView<T> const& to) {
    TileRows const rows{to.row(job.y0) + job.x0, to.stride * static_cast<std::ptrdiff_t>(sizeof(T)), job.y1 - job.y0};
    bool const aligned =
        (reinterpret_cast<std::uintptr_t>(rows.first) | static_cast<std::uintptr_t>(rows.stride_bytes)) % 64 == 0;
    if (layer.streams && aligned && job.x1 - job.x0 == tile_size) {
        layer.kernel->stream(rows, from);
        return;
    }
    for (std::int32_t y = job.y0; y < job.y1; ++y, from += tile_pitch)
        std::copy_n(from, job.x1 - job.x0, to.row(y) + job.x0);
}

inline void store_tile(LayerPlan const& layer, TileJob const& job) {
    DepthTarget const& depth = layer.layer->target;
    if (job.id != nullptr) store_rows(layer, job, job.id, layer.layer->triangle);
    if (!job.quantize) {
        store_rows(layer, job, job.depth, depth.f32());
        return;
    }
    for (std::int32_t y = job.y0; y < job.y1; ++y) {
        float const* const row = job.depth + std::ptrdiff_t{y - job.y0} * tile_pitch;
        std::transform(row, row + (job.x1 - job.x0), depth.unorm16().row(y) + job.x0,
                       [](float code) { return static_cast<std::uint16_t>(code); });
    }
}

/// Writes the tile's blocks to the layer's pyramid, while the tile is still in the nearest cache.
inline void summarize_tile(LayerPlan const& layer, TileJob const& job) {
    DepthPyramid& pyramid = *layer.layer->config.pyramid;
    ImageView<float> const least = pyramid.least(0);
    ImageView<float> const greatest = pyramid.greatest(0);
    for (std::int32_t y = job.y0; y < job.y1; y += 8) {
        SampleRows const rows{job.depth + std::ptrdiff_t{y - job.y0} * tile_pitch, tile_pitch, job.x1 - job.x0,
                              std::min(8, job.y1 - y)};
        best_summary().summarize(rows, least.row(y >> 3) + (job.x0 >> 3), greatest.row(y >> 3) + (job.x0 >> 3));
    }
}

}  // namespace gnomon::raster::detail
