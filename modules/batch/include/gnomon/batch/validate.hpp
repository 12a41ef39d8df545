#pragma once
// Checks everything that users of batches rely on.

#include <gnomon/batch/batches.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::batch {

enum class BatchFault : std::uint8_t {
    none,
    wrong_range,     ///< The batches do not cover `triangles` in order, or one is empty or too large.
    wrong_boxes,     ///< Not one box per batch.
    bad_triangle,    ///< A triangle that does not exist, or that should be left out.
    twice,           ///< A triangle is in two places.
    missing,         ///< A triangle is neither in a batch nor counted as left out.
    mixed_groups,    ///< A batch holds a triangle of another group.
    loose_box,       ///< A box is not the exact bounds of its triangles.
};

namespace detail {

[[nodiscard]] inline BatchFault check_batch(Batches const& batches, std::size_t b, Triangles const& list,
                                            std::vector<bool>& seen) {
    Batch const& batch = batches.batches[b];
    math::Aabb bounds;
    for (std::size_t i = batch.first; i < std::size_t{batch.first} + batch.count; ++i) {
        std::uint32_t const triangle = batches.triangles[i];
        math::Aabb box;
        if (triangle >= list.size() || bounds_of_triangle(list, triangle, box) != Fate::kept) return BatchFault::bad_triangle;
        if (seen[triangle]) return BatchFault::twice;
        if (list.group(triangle) != batch.group) return BatchFault::mixed_groups;
        seen[triangle] = true;
        bounds = math::merged(bounds, box);
    }
    return bounds == batches.boxes[b] ? BatchFault::none : BatchFault::loose_box;
}

}  // namespace detail

/// Whether `batches` are batches of `list` of at most `max_triangles`; `BatchFault::none` if so.
///
/// cost: O(n) time and a bit per triangle.
[[nodiscard]] inline BatchFault validate(Batches const& batches, Triangles const& list, std::uint32_t max_triangles) {
    if (batches.boxes.size() != batches.batches.size()) return BatchFault::wrong_boxes;
    std::size_t next = 0;
    for (Batch const& batch : batches.batches) {
        if (batch.first != next || batch.count == 0 || batch.count > max_triangles) return BatchFault::wrong_range;
        next += batch.count;
    }
    if (next != batches.triangles.size()) return BatchFault::wrong_range;
    std::vector<bool> seen(list.size());
    for (std::size_t b = 0; b < batches.batches.size(); ++b)
        if (BatchFault const fault = detail::check_batch(batches, b, list, seen); fault != BatchFault::none) return fault;
    bool const complete = next + batches.left_out.bad_index + batches.left_out.not_finite == list.size();
    return complete ? BatchFault::none : BatchFault::missing;
}

}  // namespace gnomon::batch
