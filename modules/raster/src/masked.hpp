#pragma once
// Alpha-tested triangles: the reference loop with a texture look-up per sample.

#include <gnomon/raster/draw.hpp>

#include "kernel.hpp"

#include <span>

namespace gnomon::raster::detail {

/// What the tiles need of a draw after set-up.
struct MaskedDraw {
    AlphaTest const* test = nullptr;
    VertexJob const* vertex = nullptr;
    IndexSpan indices;
    std::uint32_t id_base = 0;
};

/// `TileJob::masked`; its context is the array of draws that the records' tags count in.
[[nodiscard]] std::uint64_t draw_masked(TileJob const& job, Record const& record);

/// Whether the test can be made: a texture, and coordinates for all positions.
[[nodiscard]] bool is_complete(AlphaTest const& test, std::size_t positions) noexcept;

}  // namespace gnomon::raster::detail
