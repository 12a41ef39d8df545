#pragma once
// The triangles of a frame as everybody sees them: one indexed list of float positions. A triangle's id is its place.

#include <gnomon/core/contract.hpp>
#include <gnomon/core/id.hpp>
#include <gnomon/math/scalar.hpp>
#include <gnomon/math/vec.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace gnomon::predicates {

/// A view; owns nothing.
struct TriangleList {
    std::span<math::vec3 const> positions;
    std::span<math::uvec3 const> corners;  ///< Three indices into `positions` per triangle.

    [[nodiscard]] std::size_t size() const noexcept { return corners.size(); }

    /// expects: `id.index() < size()`, and the triangle's indices are in range.
    [[nodiscard]] std::array<math::vec3, 3> operator[](core::TriangleId id) const noexcept {
        GNOMON_EXPECT(id.index() < corners.size());
        math::uvec3 const& at = corners[id.index()];
        GNOMON_EXPECT(at.x < positions.size() && at.y < positions.size() && at.z < positions.size());
        return {positions[at.x], positions[at.y], positions[at.z]};
    }
};

/// The triangle exists, its indices are in range and its positions finite.
[[nodiscard]] inline bool is_usable(TriangleList const& list, core::TriangleId id) noexcept {
    if (id.index() >= list.corners.size()) return false;
    math::uvec3 const& at = list.corners[id.index()];
    std::size_t const n = list.positions.size();
    return at.x < n && at.y < n && at.z < n && math::is_finite(list.positions[at.x]) &&
           math::is_finite(list.positions[at.y]) && math::is_finite(list.positions[at.z]);
}

}  // namespace gnomon::predicates
