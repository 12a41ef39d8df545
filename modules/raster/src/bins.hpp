#pragma once
// Which triangles touch which tiles: lists per chunk of triangles, made without locks, read in draw order.
//
// Bins come in levels, each four times as wide as the one before; a triangle lies on the first level where it touches
// at most 16 bins. So a triangle that covers a whole 16k image costs a few entries, not 65,536.

#include "kernel.hpp"

#include <cstddef>
#include <cstdint>

namespace gnomon::raster::detail {

inline constexpr int max_bin_levels = 5;  // 64 px to 16,384 px
inline constexpr std::uint32_t max_bins_touched = 16;

struct BinGrid {
    std::int32_t shift_x = 0;  // Columns by which the grid begins left of the image.
    int levels = 0;
    std::uint32_t total = 0;
    std::uint32_t width[max_bin_levels] = {};
    std::uint32_t base[max_bin_levels] = {};
};

[[nodiscard]] constexpr int bin_shift(int level) noexcept { return tile_shift + 2 * level; }

[[nodiscard]] inline BinGrid make_bin_grid(std::int32_t width_px, std::int32_t height_px,
                                           std::int32_t shift_x) noexcept {
    BinGrid grid;
    grid.shift_x = shift_x;
    width_px += shift_x;
    while (grid.levels < max_bin_levels) {
        int const shift = bin_shift(grid.levels);
        auto const bins = [shift](std::int32_t px) {
            return static_cast<std::uint32_t>((px + (1 << shift) - 1) >> shift);
        };
        grid.width[grid.levels] = bins(width_px);
        grid.base[grid.levels] = grid.total;
        grid.total += bins(width_px) * bins(height_px);
        ++grid.levels;
        if (bins(width_px) * bins(height_px) <= max_bins_touched) break;
    }
    return grid;
}

/// Calls f(bin) for each bin that the record's bounds touch on its level.
///
/// A record is anything with bounds in pixels: min_x, min_y, max_x, max_y.
template <class R, class F>
inline void for_each_bin(BinGrid const& grid, R const& r, F&& f) {
    std::int32_t const tile_x = (r.min_x + grid.shift_x) >> tile_shift;
    std::int32_t const tile_y = r.min_y >> tile_shift;
    if (((r.max_x + grid.shift_x) >> tile_shift) == tile_x && (r.max_y >> tile_shift) == tile_y) {  // Most do.
        f(static_cast<std::uint32_t>(tile_y) * grid.width[0] + static_cast<std::uint32_t>(tile_x));
        return;
    }
    int level = 0;
    std::uint32_t x0 = 0, x1 = 0, y0 = 0, y1 = 0;
    for (;; ++level) {
        int const shift = bin_shift(level);
        x0 = static_cast<std::uint32_t>((r.min_x + grid.shift_x) >> shift);
        x1 = static_cast<std::uint32_t>((r.max_x + grid.shift_x) >> shift);
        y0 = static_cast<std::uint32_t>(r.min_y >> shift);
        y1 = static_cast<std::uint32_t>(r.max_y >> shift);
        if ((x1 - x0 + 1) * (y1 - y0 + 1) <= max_bins_touched || level + 1 == grid.levels) break;
    }
    for (std::uint32_t y = y0; y <= y1; ++y)
        for (std::uint32_t x = x0; x <= x1; ++x) f(grid.base[level] + y * grid.width[level] + x);
}

/// Sorts the records' numbers by bin, stable.
///
/// expects: `begin` has `grid.total + 2` elements.
/// returns: the number of entries; those of bin b are `entries[begin[b]] .. entries[begin[b + 1]]`. `entries(n)` is
///          asked once for room for n.
template <class R, class Entries>
inline std::size_t sort_into_bins(BinGrid const& grid, R const* records, std::size_t count, std::uint32_t* begin,
                                  Entries&& entries) {
    for (std::uint32_t b = 0; b < grid.total + 2; ++b) begin[b] = 0;
    for (std::size_t i = 0; i < count; ++i)
        for_each_bin(grid, records[i], [&](std::uint32_t bin) { ++begin[bin + 2]; });
    for (std::uint32_t b = 2; b < grid.total + 2; ++b) begin[b] += begin[b - 1];
    std::size_t const total = begin[grid.total + 1];
    std::uint32_t* const out = entries(total);
    for (std::size_t i = 0; i < count; ++i)
        for_each_bin(grid, records[i],
                     [&](std::uint32_t bin) { out[begin[bin + 1]++] = static_cast<std::uint32_t>(i); });
    return total;
}

/// Calls f(list, n) so that all entries of one chunk that may touch the tile come in ascending order.
template <class F>
inline void for_each_run(BinGrid const& grid, std::uint32_t const* begin, std::uint32_t const* entries,
                         std::int32_t tile_x, std::int32_t tile_y, F&& f) {
    std::uint32_t const* at[max_bin_levels];
    std::uint32_t const* end[max_bin_levels];
    int used = 0;
    for (int level = 0; level < grid.levels; ++level) {
        std::uint32_t const bin = grid.base[level] +
                                  static_cast<std::uint32_t>(tile_y >> (2 * level)) * grid.width[level] +
                                  static_cast<std::uint32_t>(tile_x >> (2 * level));
        at[used] = entries + begin[bin];
        end[used] = entries + begin[bin + 1];
        if (at[used] != end[used]) ++used;
    }
    while (used > 1) {
        int first = 0;
        for (int i = 1; i < used; ++i)
            if (*at[i] < *at[first]) first = i;
        // A run of the list that holds the lowest number, up to the lowest of the others.
        std::uint32_t limit = ~0U;
        for (int i = 0; i < used; ++i)
            if (i != first && *at[i] < limit) limit = *at[i];
        std::uint32_t const* const from = at[first];
        while (at[first] != end[first] && *at[first] < limit) ++at[first];
        f(from, static_cast<std::size_t>(at[first] - from));
        if (at[first] == end[first]) {
            --used;
            at[first] = at[used];
            end[first] = end[used];
        }
    }
    if (used == 1) f(at[0], static_cast<std::size_t>(end[0] - at[0]));
}

}  // namespace gnomon::raster::detail
