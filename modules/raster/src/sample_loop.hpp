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

/// Where the tile holds a sample.
[[nodiscard]] inline std::ptrdiff_t place_in_tile(TileJob const& job, std::int32_t x, std::int32_t y) noexcept {
    std::int32_t const column = x - job.x0;
    std::int32_t const row = y - job.y0;
    return job.blocked ? blocked_offset(column, row) : std::ptrdiff_t{row} * tile_pitch + column;
}
[[nodiscard]] inline float& held_depth(TileJob const& job, std::int32_t x, std::int32_t y) noexcept {
    return job.depth[place_in_tile(job, x, y)];
}

/// A depth as the target stores it.
[[nodiscard]] inline float stored_depth(TileJob const& job, float depth) noexcept {
    depth = at_most(at_least(depth, 0.0F), 1.0F);
    return job.quantize ? to_code(depth) : depth;
}

template <class Use>
void for_each_covered_regular(TileJob const& job, Record const& r, PixelRange const& range, Use& use) {
    for (std::int32_t y = range.y0; y < range.y1; ++y) {
        for (std::int32_t x = range.x0; x < range.x1; ++x) {
            std::int32_t e[3];
            for (int i = 0; i < 3; ++i) e[i] = r.edge[i] + r.step_x[i] * (x - r.min_x) + r.step_y[i] * (y - r.min_y);
            if ((e[0] | e[1] | e[2]) < 0) continue;
            use(x, y, stored_depth(job, regular_depth(r.z0, r.g1, r.g2, e[2], e[0])));
        }
    }
}

template <class Use>
void for_each_covered_large(TileJob const& job, Record const& r, PixelRange const& range, Use& use) {
    Oriented const t = oriented_of_large(r);
    ShiftedEdge edge[3];
    for (int i = 0; i < 3; ++i) edge[i] = shifted_edge(t, i, range.x0, range.y0);
    DepthGradient const g = depth_gradient(t, edge[2].fraction, edge[0].fraction);
    for (std::int32_t y = range.y0; y < range.y1; ++y) {
        for (std::int32_t x = range.x0; x < range.x1; ++x) {
            std::int64_t e[3];
            for (int i = 0; i < 3; ++i)
                e[i] = edge[i].value + std::int64_t{edge[i].step_x} * (x - range.x0) +
                       std::int64_t{edge[i].step_y} * (y - range.y0);
            if ((e[0] | e[1] | e[2]) < 0) continue;
            use(x, y, stored_depth(job, large_depth(g, static_cast<double>(e[2]), static_cast<double>(e[0]))));
        }
    }
}

/// Calls `use(x, y, depth)` for each of the tile's samples that the record covers.
template <class Use>
void for_each_covered(TileJob const& job, Record const& r, Use use) {
    PixelRange const range = range_in_tile(job, r);
    if ((r.tag & 1U) != 0)
        for_each_covered_large(job, r, range, use);
    else
        for_each_covered_regular(job, r, range, use);
}

/// Draws the record's samples that pass the depth test and `accept(x, y)`.
template <class Accept>
std::uint64_t draw_samples(TileJob const& job, Record const& r, Accept accept) {
    std::uint64_t written = 0;
    for_each_covered(job, r, [&](std::int32_t x, std::int32_t y, float depth) {
        std::ptrdiff_t const at = place_in_tile(job, x, y);
        float& held = job.depth[at];
        if (!(job.reversed ? depth > held : depth < held) || !accept(x, y)) return;
        held = depth;
        if (job.id != nullptr) job.id[at] = r.id;
        ++written;
    });
    return written;
}

}  // namespace gnomon::raster::detail
