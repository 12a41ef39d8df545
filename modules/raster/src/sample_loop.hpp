#pragma once
// One record's samples within one tile, one by one.

#include "pieces.hpp"

namespace gnomon::raster::detail {

struct PixelRange {
    std::int32_t x0, y0, x1, y1;  // End exclusive.
};

/// The record's bounds within the tile.
[[nodiscard]] inline PixelRange range_in_tile(TileJob const& job, Record const& r) noexcept {
    return {r.min_x > job.x0 ? r.min_x : job.x0, r.min_y > job.y0 ? r.min_y : job.y0,
            r.max_x + 1 < job.x1 ? r.max_x + 1 : job.x1, r.max_y + 1 < job.y1 ? r.max_y + 1 : job.y1};
}

[[nodiscard]] inline Oriented oriented_of_large(Record const& r) noexcept {
    Oriented t{};
    for (int i = 0; i < 3; ++i) {
        t.x[i] = r.edge[i];
        t.y[i] = r.step_x[i];
    }
    t.z[0] = r.z0;
    t.z[1] = r.g1;
    t.z[2] = r.g2;
    t.area = edge_at(t, 0, 1, t.x[2], t.y[2]);
    return t;
}

/// Compares and writes one covered sample.
template <class Accept>
[[nodiscard]] inline std::uint64_t write_sample(TileJob const& job, Record const& r, std::int32_t x, std::int32_t y,
                                                float depth, Accept& accept) {
    depth = at_most(at_least(depth, 0.0F), 1.0F);
    if (job.quantize) depth = to_code(depth);
    std::int32_t const column = x - job.x0;
    std::int32_t const row = y - job.y0;
    std::ptrdiff_t const at = job.blocked ? blocked_offset(column, row) : std::ptrdiff_t{row} * tile_pitch + column;
    float& held = job.depth[at];
    if (!(job.reversed ? depth > held : depth < held) || !accept(x, y)) return 0;
    held = depth;
    if (job.id != nullptr) job.id[at] = r.id;
    return 1;
}

template <class Accept>
std::uint64_t draw_regular(TileJob const& job, Record const& r, PixelRange const& range, Accept& accept) {
    std::uint64_t written = 0;
    for (std::int32_t y = range.y0; y < range.y1; ++y) {
        for (std::int32_t x = range.x0; x < range.x1; ++x) {
            std::int32_t e[3];
            for (int i = 0; i < 3; ++i) e[i] = r.edge[i] + r.step_x[i] * (x - r.min_x) + r.step_y[i] * (y - r.min_y);
            if ((e[0] | e[1] | e[2]) < 0) continue;
            written += write_sample(job, r, x, y, regular_depth(r.z0, r.g1, r.g2, e[2], e[0]), accept);
        }
    }
    return written;
}

template <class Accept>
std::uint64_t draw_large(TileJob const& job, Record const& r, PixelRange const& range, Accept& accept) {
    Oriented const t = oriented_of_large(r);
    ShiftedEdge edge[3];
    for (int i = 0; i < 3; ++i) edge[i] = shifted_edge(t, i, range.x0, range.y0);
    DepthGradient const g = depth_gradient(t, edge[2].fraction, edge[0].fraction);
    std::uint64_t written = 0;
    for (std::int32_t y = range.y0; y < range.y1; ++y) {
        for (std::int32_t x = range.x0; x < range.x1; ++x) {
            std::int64_t e[3];
            for (int i = 0; i < 3; ++i)
                e[i] = edge[i].value + std::int64_t{edge[i].step_x} * (x - range.x0) +
                       std::int64_t{edge[i].step_y} * (y - range.y0);
            if ((e[0] | e[1] | e[2]) < 0) continue;
            float const depth = large_depth(g, static_cast<double>(e[2]), static_cast<double>(e[0]));
            written += write_sample(job, r, x, y, depth, accept);
        }
    }
    return written;
}

/// Draws the record's samples that pass the depth test and `accept(x, y)`.
template <class Accept>
std::uint64_t draw_samples(TileJob const& job, Record const& r, Accept accept) {
    PixelRange const range = range_in_tile(job, r);
    return (r.tag & 1U) != 0 ? draw_large(job, r, range, accept) : draw_regular(job, r, range, accept);
}

}  // namespace gnomon::raster::detail
