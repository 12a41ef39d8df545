#pragma once
// Batches: groups of triangles that lie close together and share a transform, each with its box.
//
// source:  [Olsson 2014, Paper III, section 5.2.1]

#include <gnomon/core/contract.hpp>
#include <gnomon/math/bounds.hpp>
#include <gnomon/math/scalar.hpp>
#include <gnomon/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::batch {

/// What batches are made of. A view; owns nothing.
struct Triangles {
    std::span<math::vec3 const> positions;
    std::span<std::uint32_t const> indices;  ///< Three per triangle.
    std::span<std::uint32_t const> groups = {};  ///< One per triangle: what shares a transform. Empty: all are of group 0.

    [[nodiscard]] std::size_t size() const noexcept { return indices.size() / 3; }
    [[nodiscard]] std::uint32_t group(std::size_t triangle) const noexcept {
        return groups.empty() ? 0U : groups[triangle];
    }
};

/// `count` triangles from `first` on in `Batches::triangles`, all of one group.
struct Batch {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t group = 0;

    friend bool operator==(Batch const&, Batch const&) noexcept = default;
};

/// Triangles that are in no batch.
struct LeftOut {
    std::uint64_t bad_index = 0;   ///< An index beyond the positions.
    std::uint64_t not_finite = 0;  ///< A NaN or an infinity in a position.

    friend bool operator==(LeftOut const&, LeftOut const&) noexcept = default;
};

/// Made by `build_batches`. Batches are ordered by group, then along the Morton curve.
struct Batches {
    std::vector<std::uint32_t> triangles;  ///< Every triangle that is not left out, once; ascending in each batch.
    std::vector<Batch> batches;            ///< Cover `triangles` in order.
    std::vector<math::Aabb> boxes;         ///< One per batch: the exact bounds of its triangles.
    LeftOut left_out;
    std::uint64_t hurried = 0;  ///< Searches that gave up at `Config::max_visits`; 0: the paper's tree, exactly.
};

/// What becomes of a triangle.
enum class Fate : std::uint8_t { kept, bad_index, not_finite };

/// The triangle's exact bounds, if it is kept; else `box` is empty.
[[nodiscard]] inline Fate bounds_of_triangle(Triangles const& list, std::size_t triangle, math::Aabb& box) noexcept {
    box = {};
    math::Aabb grown;
    for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t const index = list.indices[3 * triangle + k];
        if (index >= list.positions.size()) return Fate::bad_index;
        grown = math::extended(grown, list.positions[index]);
    }
    for (std::size_t k = 0; k < 3; ++k)
        if (!math::is_finite(list.positions[list.indices[3 * triangle + k]])) return Fate::not_finite;
    box = grown;
    return Fate::kept;
}

}  // namespace gnomon::batch
