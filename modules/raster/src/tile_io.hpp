#pragma once
// A tile's local image, filled from its layer's target and copied back.

#include "plan.hpp"
#include "summary.hpp"

#include <algorithm>
#include <cstdint>

namespace gnomon::raster::detail {

/// A tile in rows, whatever the kernel's own order. `T` has 32 bits.
template <class T>
struct alignas(64) TileInRows {
    T element[tile_size * tile_pitch];

    /// returns: `own` when the kernel works in rows, else its blocks copied to rows.
    [[nodiscard]] T const* from(KernelTable const& kernel, T const* own) {
        if (kernel.to_rows == nullptr) return own;
        kernel.to_rows(reinterpret_cast<std::uint32_t const*>(own), reinterpret_cast<std::uint32_t*>(element));
        return element;
    }
};

/// Fills a tile's local image from an image's rows.
template <class T, class Element>
void load_rows(KernelTable const& kernel, TileJob const& job, ImageView<Element> const& from, T* own) {
    TileInRows<T> rows;
    T* const to = kernel.from_rows == nullptr ? own : rows.element;
    std::int32_t const width = job.x1 - job.x0;
    for (std::int32_t y = job.y0; y < job.y1; ++y)
        std::copy_n(from.row(y) + job.x0, width, to + std::ptrdiff_t{y - job.y0} * tile_pitch);
    if (to == own) return;
    // Beyond the target's border is whatever is there: never seen.
    for (std::int32_t y = job.y0; y < job.y1; ++y) {
        T* const row = to + std::ptrdiff_t{y - job.y0} * tile_pitch;
        std::fill(row + width, row + tile_size, T{0});
    }
    std::fill(to + std::ptrdiff_t{job.y1 - job.y0} * tile_pitch, to + std::ptrdiff_t{tile_size} * tile_pitch, T{0});
    kernel.from_rows(reinterpret_cast<std::uint32_t const*>(to), reinterpret_cast<std::uint32_t*>(own));
}

inline void load_tile(LayerPlan const& layer, TileJob const& job, Load load) {
    float const farthest = job.reversed ? 0.0F : job.quantize ? 65535.0F : 1.0F;
    layer.kernel->clear(job, farthest, no_triangle);
    if (load == Load::clear) return;
    DepthTarget const& depth = layer.layer->target;
    if (job.quantize)
        load_rows(*layer.kernel, job, depth.unorm16(), job.depth);
    else
        load_rows(*layer.kernel, job, depth.f32(), job.depth);
    if (job.id != nullptr) load_rows(*layer.kernel, job, layer.layer->triangle, job.id);
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
    TileInRows<T> scratch;
    from = scratch.from(*layer.kernel, from);
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
    TileInRows<float> scratch;
    float const* row = scratch.from(*layer.kernel, job.depth);
    for (std::int32_t y = job.y0; y < job.y1; ++y, row += tile_pitch) {
        std::transform(row, row + (job.x1 - job.x0), depth.unorm16().row(y) + job.x0,
                       [](float code) { return static_cast<std::uint16_t>(code); });
    }
}

/// Writes the tile's blocks to the layer's pyramid, while the tile is still in the nearest cache.
///
/// `empty`: every sample is as `load_tile` cleared it.
inline void summarize_tile(LayerPlan const& layer, TileJob const& job, bool empty) {
    DepthPyramid& pyramid = *layer.layer->config.pyramid;
    ImageView<float> const least = pyramid.least(0);
    ImageView<float> const greatest = pyramid.greatest(0);
    if (empty) {
        for (std::int32_t y = job.y0 >> 3; y < (job.y1 + 7) >> 3; ++y) {
            std::int32_t const blocks = (job.x1 - job.x0 + 7) >> 3;
            std::fill_n(least.row(y) + (job.x0 >> 3), blocks, job.depth[0]);
            std::fill_n(greatest.row(y) + (job.x0 >> 3), blocks, job.depth[0]);
        }
        return;
    }
    SummaryTable const& summary = best_summary();
    if (job.blocked && job.x1 - job.x0 == tile_size && job.y1 - job.y0 == tile_size) {
        for (std::int32_t row = 0; row < tile_size; row += 8)
            summary.summarize_blocked(job.depth + blocked_offset(0, row), least.row((job.y0 + row) >> 3) + (job.x0 >> 3),
                                      greatest.row((job.y0 + row) >> 3) + (job.x0 >> 3));
        return;
    }
    TileInRows<float> scratch;
    float const* const depth = scratch.from(*layer.kernel, job.depth);
    for (std::int32_t y = job.y0; y < job.y1; y += 8) {
        SampleRows const rows{depth + std::ptrdiff_t{y - job.y0} * tile_pitch, tile_pitch, job.x1 - job.x0,
                              std::min(8, job.y1 - y)};
        summary.summarize(rows, least.row(y >> 3) + (job.x0 >> 3), greatest.row(y >> 3) + (job.x0 >> 3));
    }
}

}  // namespace gnomon::raster::detail
