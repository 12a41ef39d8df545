#pragma once
// Batches of a frame's triangles: what shares an instance and can be in one draw call, in pieces of up to 128 triangles.
//
// Made once for a geometry; after `update` has moved its positions, `refit` moves the boxes.

#include <gnomon/batch/build.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/scene/flatten.hpp>

#include <cstdint>
#include <vector>

namespace gnomon::scene {

/// What all triangles of a group share: the transform, alpha mode and sidedness.
struct BatchGroup {
    std::uint32_t instance = none;  ///< Into `Scene::instances`.
    std::uint32_t draw = none;      ///< Into `Geometry::draws`.

    friend bool operator==(BatchGroup const&, BatchGroup const&) = default;
};

struct GeometryBatches {
    batch::Batches batches;            ///< `Batch::group` is an index into `groups`.
    std::vector<BatchGroup> groups;    ///< One per instance in each draw that it is in.
    std::vector<std::uint32_t> group_of_triangle;
    std::vector<std::uint32_t> indices;  ///< `Geometry::indices` in the order of the batches: batch b's start at 3 * first.
};

/// The batches of `geometry`.
///
/// source:  [Olsson 2014, Paper III, section 5.2.1]
/// cost:    O(n log n), see `batch::build_batches`; allocates the result and a workspace.
[[nodiscard]] GeometryBatches make_batches(Geometry const& geometry, batch::Config const& config, core::ExecutorRef executor);
[[nodiscard]] GeometryBatches make_batches(Geometry const& geometry, batch::Config const& config = {});

/// Moves the boxes to where `geometry` is now; returns the triangles that are not finite now, which no box holds.
///
/// expects: `batches` are of a geometry with the same triangles.
/// cost:    O(n); no allocation.
std::uint64_t refit(GeometryBatches& batches, Geometry const& geometry, core::ExecutorRef executor);
std::uint64_t refit(GeometryBatches& batches, Geometry const& geometry);

}  // namespace gnomon::scene
