#pragma once
// What is drawn, as every backend is given it (gnomon/backend/draw.hpp), and what may be wrong with it.

#include <gnomon/backend/draw.hpp>
#include <gnomon/raster/instances.hpp>

#include <cstdint>

namespace gnomon::raster {

using backend::AlphaTest;
using backend::Cull;
using backend::Draw;
using backend::IndexSpan;
using backend::triangle_count;

/// What is wrong with a draw's data. A pass leaves such triangles out and counts them; nothing here is fatal.
struct DrawFaults {
    std::uint64_t bad_index_triangles = 0;   ///< With an index at or beyond `positions.size()`.
    std::uint64_t not_finite_positions = 0;  ///< With a NaN or an infinity.
    std::uint32_t loose_indices = 0;         ///< 1 or 2 left over at the end, which make no triangle.
    bool uv_missing = false;                 ///< An alpha test with fewer coordinates than positions, or no texture.

    [[nodiscard]] bool any() const noexcept {
        return bad_index_triangles != 0 || not_finite_positions != 0 || loose_indices != 0 || uv_missing;
    }
};

/// Reads all of a draw's data once and says what a pass would leave out.
///
/// cost: O(positions + indices).
[[nodiscard]] DrawFaults validate(Draw const& draw) noexcept;

}  // namespace gnomon::raster
