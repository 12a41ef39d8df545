#pragma once
// Newtype ids: an index that cannot be mistaken for an index of something else.

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace gnomon::core {

/// A 32-bit index with the type of what it counts: `using LightId = Id<struct LightTag>`.
///
/// Same size and layout as uint32_t, so a span of them can be handed to a GPU.
template <class Tag>
struct Id {
    std::uint32_t value = std::numeric_limits<std::uint32_t>::max();

    constexpr Id() noexcept = default;
    constexpr explicit Id(std::uint32_t v) noexcept : value(v) {}

    /// The id that names nothing; also the default.
    [[nodiscard]] static constexpr Id none() noexcept { return Id{}; }
    [[nodiscard]] constexpr bool is_none() const noexcept { return value == Id{}.value; }
    [[nodiscard]] constexpr std::size_t index() const noexcept { return value; }

    friend constexpr auto operator<=>(Id, Id) noexcept = default;
};

using TriangleId = Id<struct TriangleTag>;  ///< Index into a frame's triangle list.
using MaterialId = Id<struct MaterialTag>;
using LightId = Id<struct LightTag>;

static_assert(sizeof(TriangleId) == sizeof(std::uint32_t));
static_assert(TriangleId{}.is_none() && TriangleId{1} < TriangleId{2});

}  // namespace gnomon::core
