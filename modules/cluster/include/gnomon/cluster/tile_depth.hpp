#pragma once
// The range of depths in each tile of an image: what tiled shading culls lights by.
//
// source: [Olsson 2014, Paper I, 6.3 and its note on transparent geometry]

#include <gnomon/cluster/detail/serial.hpp>
#include <gnomon/cluster/grid.hpp>
#include <gnomon/core/contract.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/math/scalar.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace gnomon::cluster {

/// Depths from `near_m` to `far_m`, both included; empty if they are the other way round.
struct DepthRange {
    float near_m = std::numeric_limits<float>::infinity();
    float far_m = -std::numeric_limits<float>::infinity();

    [[nodiscard]] constexpr bool is_empty() const noexcept { return !(near_m <= far_m); }
    friend constexpr bool operator==(DepthRange const&, DepthRange const&) noexcept = default;
};

/// What a tile's pixels show.
struct TileDepth {
    DepthRange range;             ///< Of the pixels with geometry.
    std::uint32_t background = 0;  ///< Pixels without: their depth is NaN or infinite.

    friend constexpr bool operator==(TileDepth const&, TileDepth const&) noexcept = default;
};

/// For opaque geometry: lights before the nearest or behind the farthest sample reach none.
[[nodiscard]] constexpr DepthRange opaque_range(TileDepth const& tile) noexcept { return tile.range; }

/// For transparent geometry, of which an opaque depth buffer knows nothing: only what the opaque geometry hides is
/// left out, and nothing where a pixel shows the background.
[[nodiscard]] constexpr DepthRange far_only_range(TileDepth const& opaque) noexcept {
    float const inf = std::numeric_limits<float>::infinity();
    return {-inf, opaque.background == 0 ? opaque.range.far_m : inf};
}

/// For transparent geometry that was also rendered to a depth buffer of its own, with the depth test reversed or not,
/// of which `transparent` was made: what is before its nearest sample is left out too.
///
/// expects: `nearest` from the depths of the nearest transparent samples
/// returns: an empty range where there is none, or all of it is hidden
[[nodiscard]] constexpr DepthRange transparent_range(TileDepth const& opaque, TileDepth const& nearest) noexcept {
    return {nearest.range.near_m, far_only_range(opaque).far_m};
}

/// The range of each tile, in rows from the top.
///
/// expects: a depth for each pixel of the grid's image, in rows from the top, in metres before the eye; NaN or infinite
///          where there is no geometry. `out` has columns times rows elements.
/// cost:    O(pixels); allocates nothing
template <core::Executor E = core::SerialExecutor const>
void reduce_tile_depths(Grid const& grid, std::span<float const> depth_m, std::span<TileDepth> out, E& executor = detail::serial) {
    auto const& table = grid.table();
    auto const width = static_cast<std::size_t>(grid.size_px().x);
    auto const height = static_cast<std::size_t>(grid.size_px().y);
    GNOMON_EXPECT(depth_m.size() == width * height && out.size() == std::size_t{table.columns} * table.rows);
    executor.parallel_for(table.rows, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin * table.columns; t < end * table.columns; ++t) {
            std::size_t const x = t % table.columns * table.tile_x;
            std::size_t const y = t / table.columns * table.tile_y;
            TileDepth tile;
            for (std::size_t row = y; row < std::min(height, y + table.tile_y); ++row)
                for (float const d : depth_m.subspan(row * width + x, std::min(width - x, std::size_t{table.tile_x}))) {
                    bool const there = math::is_finite(d);
                    tile.range.near_m = there && d < tile.range.near_m ? d : tile.range.near_m;
                    tile.range.far_m = there && d > tile.range.far_m ? d : tile.range.far_m;
                    tile.background += there ? 0U : 1U;
                }
            out[t] = tile;
        }
    });
}

}  // namespace gnomon::cluster
