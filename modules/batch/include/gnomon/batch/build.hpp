#pragma once
// Makes batches bottom-up, as [Olsson 2014, Paper III, section 5.2.1]: an agglomerative tree over the triangles with the
// diagonal of the common box as dissimilarity; the largest subtrees of at most `max_triangles` are the batches.

#include <gnomon/batch/batches.hpp>
#include <gnomon/batch/detail/agglomerate.hpp>
#include <gnomon/batch/detail/collect.hpp>
#include <gnomon/batch/refit.hpp>
#include <gnomon/core/contract.hpp>
#include <gnomon/core/executor.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::batch {

struct Config {
    std::uint32_t max_triangles = 128;  ///< Of a batch; at least 1. The paper finds 32 to 512 alike, more slower.
    /// Blocks of eight boxes that one search for the nearest cluster may look at; at least 1. It bounds the time where
    /// all triangles overlap all others; scenes need some tens. A search that gives up takes the best it has seen.
    std::uint32_t max_visits = 1024;
};

/// Memory that `build_batches` keeps from call to call.
struct Workspace {
    std::vector<detail::Key> keys;
    std::vector<detail::Slice> slices;
    std::vector<detail::Block> blocks;
    std::vector<std::uint32_t> size;
    std::vector<std::uint32_t> owner;
    std::vector<std::uint32_t> chain;
};

namespace detail {

/// Agglomerates the slots of one group, and leaves in `owner` the slot that stands for each one's batch.
inline std::uint64_t agglomerate(Triangles const& list, Slice const& slice, Limits const& limits, Workspace& workspace) {
    std::size_t const count = slice.end - slice.begin;
    auto const part = [&](std::vector<std::uint32_t>& all) { return std::span(all).subspan(slice.begin, count); };
    GroupArrays const arrays{std::span(workspace.blocks).subspan(slice.first_block, BoxTree::block_count(count)),
                             part(workspace.size), part(workspace.owner), part(workspace.chain)};
    for (std::size_t i = 0; i < (count + width - 1) / width * width; ++i) {
        math::Aabb box;
        if (i < count) static_cast<void>(bounds_of_triangle(list, workspace.keys[slice.begin + i].triangle, box));
        arrays.blocks[i / width].set(i % width, i < count ? halved(box) : box);
    }
    for (std::size_t i = 0; i < count; ++i) {
        arrays.size[i] = 1;
        arrays.owner[i] = static_cast<std::uint32_t>(i);
    }
    std::uint64_t const hurried = Agglomeration(arrays, limits).run();
    for (std::uint32_t& owner : arrays.owner) owner = arrays.owner[owner];  // ascending: the end is one step away
    return hurried;
}

/// Writes the batches of one group behind those of the groups before.
inline void emit(Slice const& slice, Workspace& workspace, Batches& out) {
    // `size` becomes the number of a slot's batch where one begins, `chain` the place for its next triangle.
    std::size_t const first_batch = out.batches.size();
    for (std::size_t i = slice.begin; i < slice.end; ++i) {
        std::size_t const owner = slice.begin + workspace.owner[i];
        if (owner == i) {
            workspace.size[i] = static_cast<std::uint32_t>(out.batches.size());
            out.batches.push_back({0, 0, slice.group});
        }
        ++out.batches[workspace.size[owner]].count;
    }
    auto first = static_cast<std::uint32_t>(out.triangles.size());
    for (std::size_t b = first_batch; b < out.batches.size(); ++b) {
        out.batches[b].first = workspace.chain[slice.begin + b - first_batch] = first;
        first += out.batches[b].count;
    }
    out.triangles.resize(first);
    for (std::size_t i = slice.begin; i < slice.end; ++i) {
        std::size_t const b = workspace.size[slice.begin + workspace.owner[i]] - first_batch;
        out.triangles[workspace.chain[slice.begin + b]++] = workspace.keys[i].triangle;
    }
}

}  // namespace detail

/// Groups the triangles of each group into batches of at most `config.max_triangles`.
///
/// expects: three indices per triangle, as many groups as triangles or none, fewer than 2^32 - 1 triangles.
/// returns: in `out`, the same for any executor. Triangles with bad indices or positions that are not finite are left out
///          and counted; any finite positions are legal, and triangles without area are triangles.
/// cost:    O(n log n) where triangles do not overlap too much, O(n max_visits) at worst; groups run in parallel.
///          `workspace` and `out` allocate only where they were smaller before: 65 + 5 bytes a triangle.
template <core::Executor E>
void build_batches(Triangles const& list, Config const& config, Workspace& workspace, Batches& out, E& executor) {
    GNOMON_EXPECT(list.indices.size() % 3 == 0 && list.size() < detail::none);
    GNOMON_EXPECT(list.groups.empty() || list.groups.size() == list.size());
    GNOMON_EXPECT(config.max_triangles >= 1 && config.max_visits >= 1);
    out.triangles.clear();
    out.batches.clear();
    out.left_out = detail::collect(list, workspace.keys, executor);
    std::size_t const blocks = detail::slice_groups(workspace.keys, workspace.slices);
    workspace.blocks.resize(blocks);
    for (auto* const array : {&workspace.size, &workspace.owner, &workspace.chain}) array->resize(workspace.keys.size());

    std::atomic<std::uint64_t> hurried{0};
    detail::Limits const limits{config.max_triangles, config.max_visits};
    executor.parallel_for(workspace.slices.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            hurried += detail::agglomerate(list, workspace.slices[i], limits, workspace);
    });
    out.hurried = hurried;
    for (detail::Slice const& slice : workspace.slices) detail::emit(slice, workspace, out);

    out.boxes.resize(out.batches.size());
    executor.parallel_for(out.batches.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) {
            auto const members = std::span(out.triangles).subspan(out.batches[b].first, out.batches[b].count);
            std::sort(members.begin(), members.end());
        }
    });
    static_cast<void>(refit(out, list, out.boxes, executor));
}

[[nodiscard]] inline Batches build_batches(Triangles const& list, Config const& config = {}) {
    core::SerialExecutor const serial;
    Workspace workspace;
    Batches out;
    build_batches(list, config, workspace, out, serial);
    return out;
}

}  // namespace gnomon::batch
