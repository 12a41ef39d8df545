#pragma once
// Morton codes: three coordinates interleaved bit by bit, x lowest. 30 bits (10 per axis) and 63 bits (21 per axis).

#include <gnomon/math/bounds.hpp>
#include <gnomon/math/formula/bits.glsl>
#include <gnomon/math/vec.hpp>

#include <cstdint>

namespace gnomon::math {

/// Bits 0-9 of `x` spread to every third bit.
[[nodiscard]] constexpr std::uint32_t spread_10(std::uint32_t x) noexcept {
    return gn_spread_10(formula::Uint<float>(x)).v;
}

/// Bits 0-20 of `x` spread to every third bit.
[[nodiscard]] constexpr std::uint64_t spread_21(std::uint64_t x) noexcept {
    x &= 0x1F'FFFFULL;
    x = (x | x << 32U) & 0x001F'0000'0000'FFFFULL;
    x = (x | x << 16U) & 0x001F'0000'FF00'00FFULL;
    x = (x | x << 8U) & 0x100F'00F0'0F00'F00FULL;
    x = (x | x << 4U) & 0x10C3'0C30'C30C'30C3ULL;
    return (x | x << 2U) & 0x1249'2492'4924'9249ULL;
}

[[nodiscard]] constexpr std::uint32_t morton_30(std::uint32_t x, std::uint32_t y, std::uint32_t z) noexcept {
    using Uint = formula::Uint<float>;
    return gn_morton_30(Uint(x), Uint(y), Uint(z)).v;
}

[[nodiscard]] constexpr std::uint64_t morton_63(std::uint32_t x, std::uint32_t y, std::uint32_t z) noexcept {
    return spread_21(x) | spread_21(y) << 1U | spread_21(z) << 2U;
}

/// Cell of `p` in a grid of `cells` cells per axis over `box`.
///
/// returns: 0 to cells - 1 per axis: points outside go to the border cells, an axis without extent and a NaN to 0
///          (numerics row 8: the clamp is on the float, before the cast).
[[nodiscard]] inline uvec3 grid_cell(Aabb const& box, vec3 const& p, std::uint32_t cells) noexcept {
    uvec3 cell(0U, 0U, 0U);
    auto const last = static_cast<double>(cells - 1U);
    for (axis_t axis = 0; axis < 3; ++axis) {
        double const lo = static_cast<double>(box.lo[axis]);
        double const extent = static_cast<double>(box.hi[axis]) - lo;
        if (!(extent > 0.0) || !is_finite(extent)) continue;
        double const at = (static_cast<double>(p[axis]) - lo) / extent * static_cast<double>(cells);
        if (at > 0.0) cell[axis] = static_cast<std::uint32_t>(at < last ? at : last);
    }
    return cell;
}

/// 30-bit code of `p` in `box`; see `grid_cell` for points that have no place.
[[nodiscard]] inline std::uint32_t morton_30(Aabb const& box, vec3 const& p) noexcept {
    uvec3 const cell = grid_cell(box, p, 1U << 10U);
    return morton_30(cell.x, cell.y, cell.z);
}

/// 63-bit code of `p` in `box`.
[[nodiscard]] inline std::uint64_t morton_63(Aabb const& box, vec3 const& p) noexcept {
    uvec3 const cell = grid_cell(box, p, 1U << 21U);
    return morton_63(cell.x, cell.y, cell.z);
}

static_assert(morton_30(1, 0, 0) == 1 && morton_30(0, 1, 0) == 2 && morton_30(0, 0, 1) == 4);
static_assert(morton_30(1023, 1023, 1023) == 0x3FFF'FFFFU);
static_assert(morton_63(0x1F'FFFF, 0x1F'FFFF, 0x1F'FFFF) == 0x7FFF'FFFF'FFFF'FFFFULL);

}  // namespace gnomon::math
