#pragma once
// The boxes of batches whose vertices have moved: each frame, without allocation.

#include <gnomon/batch/batches.hpp>
#include <gnomon/core/contract.hpp>
#include <gnomon/core/executor.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::batch {

/// Writes to `boxes` the exact bounds of each batch's triangles, as `list` has them now.
///
/// source:  [Olsson 2014, Paper III, section 5.2.1]
/// expects: `list` has the indices that `batches` were built from, and its positions may have moved; a box per batch.
/// returns: triangles that have a position that is not finite now: no box holds them. A batch without any other has the
///          empty box.
/// cost:    O(n); no allocation.
template <core::Executor E>
std::uint64_t refit(Batches const& batches, Triangles const& list, std::span<math::Aabb> boxes, E& executor) {
    GNOMON_EXPECT(boxes.size() == batches.batches.size());
    std::atomic<std::uint64_t> lost{0};
    executor.parallel_for(batches.batches.size(), 64, [&](std::size_t begin, std::size_t end) {
        std::uint64_t lost_here = 0;
        for (std::size_t b = begin; b < end; ++b) {
            math::Aabb bounds;
            auto const members = std::span(batches.triangles).subspan(batches.batches[b].first, batches.batches[b].count);
            for (std::uint32_t const triangle : members) {
                math::Aabb box;
                lost_here += bounds_of_triangle(list, triangle, box) == Fate::kept ? 0U : 1U;
                bounds = math::merged(bounds, box);
            }
            boxes[b] = bounds;
        }
        lost.fetch_add(lost_here, std::memory_order_relaxed);
    });
    return lost;
}

inline std::uint64_t refit(Batches const& batches, Triangles const& list, std::span<math::Aabb> boxes) {
    core::SerialExecutor const serial;
    return refit(batches, list, boxes, serial);
}

}  // namespace gnomon::batch
