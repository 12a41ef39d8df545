#pragma once
// The keys of a whole image of samples.

#include <gnomon/cluster/detail/serial.hpp>
#include <gnomon/cluster/key.hpp>
#include <gnomon/core/contract.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/math/scalar.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::cluster {

/// The samples of an image's pixels, in rows from the top.
struct SampleImage {
    std::span<float const> depth_m;          ///< Before the eye; NaN or infinite where there is no geometry.
    std::span<math::vec3 const> normals{};   ///< Not read, and may be empty, if the layout has no normals.
};

namespace detail {

/// The keys of samples of one row of one tile; `parts` goes on with the slice of the last.
template <Key K>
void make_tile_row_keys(Grid const& grid, KeyLayout<K> const& layout, SampleImage const& row, KeyParts& parts, K* out) {
    std::span<float const> const planes_m = grid.slices().planes_m();
    for (std::size_t i = 0; i < row.depth_m.size(); ++i) {
        float const depth_m = row.depth_m[i];
        if (!(planes_m[parts.slice] <= depth_m && depth_m < planes_m[parts.slice + 1]))
            parts.slice = slice_at(grid.slices(), depth_m);
        if (layout.normal_n != 0) parts.cell = normal_cell(row.normals[i], layout.normal_n);
        out[i] = math::is_finite(depth_m) ? pack_key<K>(parts) : no_key<K>;
    }
}

}  // namespace detail

/// Writes the key of each pixel's sample, as `key_at` says, or `no_key` where there is none.
///
/// expects: a layout of this grid; a depth, a key and, with normals, a normal for each pixel of the grid's image
/// returns: the same for any executor
/// cost:    O(pixels): a neighbour in the same slice costs two comparisons; allocates nothing
template <Key K, core::Executor E = core::SerialExecutor const>
void make_keys(Grid const& grid, KeyLayout<K> const& layout, SampleImage const& image, std::span<K> out,
               E& executor = detail::serial) {
    auto const width = static_cast<std::size_t>(grid.size_px().x);
    auto const height = static_cast<std::size_t>(grid.size_px().y);
    bool const with_normals = layout.normal_n != 0;
    GNOMON_EXPECT(image.depth_m.size() == width * height && out.size() == width * height);
    GNOMON_EXPECT(!with_normals || image.normals.size() == width * height);
    executor.parallel_for(height, 8, [&](std::size_t begin, std::size_t end) {
        KeyParts parts;
        for (std::size_t y = begin; y < end; ++y) {
            parts.row = static_cast<std::uint32_t>(y) / grid.table().tile_y;
            for (parts.column = 0; parts.column < grid.table().columns; ++parts.column) {
                std::size_t const x = std::size_t{parts.column} * grid.table().tile_x;
                std::size_t const first = y * width + x;
                std::size_t const count = std::min(width - x, std::size_t{grid.table().tile_x});
                std::span<math::vec3 const> const normals =
                    with_normals ? image.normals.subspan(first, count) : std::span<math::vec3 const>{};
                detail::make_tile_row_keys(grid, layout, {image.depth_m.subspan(first, count), normals}, parts, &out[first]);
            }
        }
    });
}

}  // namespace gnomon::cluster
