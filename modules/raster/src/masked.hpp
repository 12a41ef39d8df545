#pragma once
// Alpha-tested triangles: their texture coordinates, and the reference loop with a texture look-up per sample.

#include <gnomon/raster/alpha_map.hpp>
#include <gnomon/raster/draw.hpp>

#include "kernel.hpp"

#include <span>

namespace gnomon::raster::detail {

/// What the tiles need of a draw after set-up.
struct MaskedDraw {
    AlphaTest const* test;
    AlphaMap const* map;  // Null unless it is the test's own.
    VertexJob const* vertex;
    IndexSpan indices;
    std::uint32_t id_base;
    double scale_x, scale_y, shift_x, shift_y;  // From a pixel's number to normalized device space at its centre.
    float column[4][4];                         // The matrix by columns, of rows x, y and w; the rest is 0.
};

/// expects: `is_complete(test, positions)`.
[[nodiscard]] MaskedDraw make_masked_draw(AlphaTest const& test, VertexJob const& vertex, IndexSpan indices,
                                          std::uint32_t id_base) noexcept;

/// A linear function of a pixel's coordinates.
struct Linear {
    double dx, dy, constant;
    [[nodiscard]] double operator()(double x, double y) const { return (dx * x + dy * y) + constant; }
};

/// Perspective-correct texture coordinates of one triangle: (u / w, v / w) at a pixel, from its corners before
/// clipping.
struct TexturePlane {
    Linear w, u, v;
};

[[nodiscard]] TexturePlane make_texture_plane(MaskedDraw const& draw, std::uint32_t triangle);

/// The draw of a masked record, and which of its triangles it is.
[[nodiscard]] inline MaskedDraw const& masked_draw(TileJob const& job, Record const& record) noexcept {
    return static_cast<MaskedDraw const*>(job.masked_context)[(record.tag >> 1U) - 1];
}

/// The reference's `KernelTable::masked`; `TileJob::masked_context` is the array of draws that the records' tags count
/// in.
[[nodiscard]] std::uint64_t draw_masked(TileJob const& job, Record const& record);

/// Whether the test can be made: a texture, and coordinates for all positions.
[[nodiscard]] bool is_complete(AlphaTest const& test, std::size_t positions) noexcept;

}  // namespace gnomon::raster::detail
