#pragma once
// Exact welding: vertices at the same place are one vertex. No tolerance, so nothing moves and nothing is a matter of order.

#include <gnomon/core/contract.hpp>
#include <gnomon/math/scalar.hpp>
#include <gnomon/math/vec.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon::mesh {

inline constexpr std::uint32_t no_index = std::numeric_limits<std::uint32_t>::max();

namespace detail {

/// The bits of a coordinate; both zeros have those of +0.
[[nodiscard]] inline std::uint32_t place_bits(float x) noexcept {
    auto const bits = std::bit_cast<std::uint32_t>(x);
    return bits == 0x8000'0000U ? 0U : bits;
}

[[nodiscard]] inline bool same_place(math::vec3 const& a, math::vec3 const& b) noexcept {
    return place_bits(a.x) == place_bits(b.x) && place_bits(a.y) == place_bits(b.y) && place_bits(a.z) == place_bits(b.z);
}

/// The last step of splitmix64 over all three.
[[nodiscard]] inline std::uint64_t place_hash(math::vec3 const& p) noexcept {
    std::uint64_t z = place_bits(p.x) * 0x9E37'79B9'7F4A'7C15ULL;
    z = (z ^ (z >> 32U) ^ place_bits(p.y)) * 0xBF58'476D'1CE4'E5B9ULL;
    z = (z ^ (z >> 32U) ^ place_bits(p.z)) * 0x94D0'49BB'1331'11EBULL;
    return z ^ (z >> 31U);
}

[[nodiscard]] inline bool has_nan(math::vec3 const& p) noexcept {
    return math::is_nan(p.x) || math::is_nan(p.y) || math::is_nan(p.z);
}

}  // namespace detail

/// Finds for each position the first one at the same place: equal bit by bit, but -0 is +0. A NaN is only itself.
///
/// expects: fewer than 2^31 positions; `vertex_of` holds one entry per position.
/// returns: the number of positions that are not the first of their place. `table` is scratch.
/// cost:    O(n); allocates only where `table` was smaller before: 8 to 16 bytes a position.
inline std::size_t weld(std::span<math::vec3 const> positions, std::span<std::uint32_t> vertex_of,
                        std::vector<std::uint32_t>& table) {
    GNOMON_EXPECT(vertex_of.size() == positions.size() && positions.size() < (std::size_t{1} << 31U));
    std::size_t const mask = std::bit_ceil(2 * positions.size() + 1) - 1;
    table.assign(mask + 1, no_index);
    std::size_t welded = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        vertex_of[i] = static_cast<std::uint32_t>(i);
        if (detail::has_nan(positions[i])) continue;
        std::size_t at = detail::place_hash(positions[i]) & mask;
        while (table[at] != no_index && !detail::same_place(positions[table[at]], positions[i])) at = (at + 1) & mask;
        if (table[at] == no_index) table[at] = static_cast<std::uint32_t>(i);
        else ++welded;
        vertex_of[i] = table[at];
    }
    return welded;
}

}  // namespace gnomon::mesh
