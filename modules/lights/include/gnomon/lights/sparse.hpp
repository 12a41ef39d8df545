#pragma once
// Lists of the clusters that have samples, and of no others: a light tree is asked for each short run of them.
//
// A cluster's list is the one that `count_lists` gives it, in the same ascending order; where the cluster has an explicit box or
// a cone of normals, the lights that touch the box and may shine on the front of a sample. First the count, exact; then
// the fill. Memory of lights, clusters and pairs; none of the grid.
//
// source: [Olsson 2014, Paper II, 3.3-3.4]

#include <gnomon/cluster/grid.hpp>
#include <gnomon/cluster/normal_cells.hpp>
#include <gnomon/core/contract.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/cull/rows.hpp>
#include <gnomon/lights/detail/sparse_task.hpp>
#include <gnomon/lights/light.hpp>
#include <gnomon/lights/light_tree.hpp>
#include <gnomon/lights/lists.hpp>
#include <gnomon/math/bounds.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon::lights {

struct SparseConfig {
    std::uint64_t capacity = 0xFFFFFFFFU;  ///< The most indices that the caller has room for.
    float facing_slack_m = 0.0F;           ///< How far a light's centre may be from where it shines, and a sample outside of its box.
    bool lanes = true;                     ///< false: one by one, which gives the same lists
};

/// Memory of the assignment, kept from frame to frame.
struct SparseWorkspace {
    std::vector<std::uint64_t> order;
    std::vector<detail::Segment> segments;
    std::vector<detail::SparseTask> tasks;
    std::vector<detail::ListPlace> places;  ///< Of each cluster's list, until the fill.
    std::vector<LightPairs> pairs;          ///< As `Workspace::pairs`: used where a fixed capacity overflows.

    [[nodiscard]] std::size_t bytes() const noexcept;
};

/// Finds the lights of every cluster given, and writes to `cells` where their indices will be: in the clusters' order.
///
/// expects: the tree of these lights, in the grid's culling space; as many cells as clusters; `work` untouched until the fill.
///          Boxes and cones: none, or one a cluster. An empty box: no lights.
/// returns: as `count_lists`, with `work.pairs[i].light`, i < left_out, for what a capacity leaves out.
/// cost:    O(segments log lights + candidates); allocates when `work` grows, and where lights are left out.
[[nodiscard]] inline ListsReport count_sparse_lists(SparseInput const& in, SparseConfig const& config, SparseWorkspace& work,
                                                    std::span<Cell> cells, core::ExecutorRef executor);

/// Writes the lists that `count_sparse_lists` counted.
///
/// expects: `work` and `cells` as the count left them, `indices` of at least `written` elements.
/// cost:    O(pairs)
template <std::unsigned_integral Index>
void fill_sparse_lists(SparseWorkspace const& work, std::span<Cell const> cells, std::span<Index> indices, core::ExecutorRef executor);

inline std::size_t SparseWorkspace::bytes() const noexcept {
    std::size_t sum = order.capacity() * sizeof(std::uint64_t) + segments.capacity() * sizeof(detail::Segment) +
                      places.capacity() * sizeof(detail::ListPlace) + pairs.capacity() * sizeof(LightPairs);
    for (detail::SparseTask const& task : tasks) sum += sizeof task + task.bytes();
    return sum;
}

namespace detail {

/// Cells out of their counts. returns: the sum.
inline std::uint64_t offset_cells(std::span<Cell> cells) noexcept {
    std::uint64_t sum = 0;
    for (Cell& cell : cells) {
        cell.offset = static_cast<std::uint32_t>(sum);
        sum += cell.count;
    }
    return sum;
}

/// Takes the least important lights out of the tasks' lists until the rest fits. returns: how many.
inline std::uint32_t leave_out_sparse(std::span<Light const> lights, ListsReport& report, std::uint64_t capacity, SparseWorkspace& work,
                                      std::span<Cell> cells) {
    std::vector<std::uint64_t> pairs(lights.size());
    auto const list_of = [&](std::size_t c) { return std::span(work.tasks[work.places[c].task].hits).subspan(work.places[c].offset, cells[c].count); };
    for (std::size_t c = 0; c < cells.size(); ++c)
        for (std::uint32_t const light : list_of(c)) ++pairs[light];
    work.pairs.clear();
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (pairs[i] != 0) work.pairs.push_back({static_cast<std::uint32_t>(i), lights[i].importance, pairs[i]});
    std::uint32_t const out = choose_left_out(work.pairs, report.needed, capacity, report.written);
    std::vector<bool> gone(lights.size());
    for (std::uint32_t i = 0; i < out; ++i) gone[work.pairs[i].light] = true;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        std::span<std::uint32_t> const list = list_of(c);
        auto const end = std::remove_if(list.begin(), list.end(), [&](std::uint32_t light) { return gone[light]; });
        cells[c].count = static_cast<std::uint32_t>(end - list.begin());
    }
    return out;
}

}  // namespace detail

inline ListsReport count_sparse_lists(SparseInput const& in, SparseConfig const& config, SparseWorkspace& work, std::span<Cell> cells,
                                      core::ExecutorRef executor) {
    std::size_t const clusters = in.clusters.size();
    GNOMON_EXPECT(cells.size() == clusters && clusters < 0xFFFFFFFFU);
    GNOMON_EXPECT((in.boxes.empty() || in.boxes.size() == clusters) && (in.cones.empty() || in.cones.size() == clusters));
    ListsReport report;
    report.lights = in.tree.report;
    detail::order_clusters(in.grid, in.clusters, work.order);
    detail::find_segments(in.grid, work.order, work.segments);
    std::size_t const tasks = std::min<std::size_t>(detail::most_tasks, (work.segments.size() + 7) / 8);
    if (work.tasks.size() < tasks) work.tasks.resize(tasks);
    work.places.resize(clusters);
    detail::SparseRun const run{in, config.facing_slack_m, detail::SparseKernels{config.lanes && bvh::detail::has_avx2(), config.lanes},
                                work.order, cells, work.places};
    auto const count = [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            std::size_t const first = work.segments.size() * t / tasks, last = work.segments.size() * (t + 1) / tasks;
            detail::count_segments(run, std::span(work.segments).subspan(first, last - first), static_cast<std::uint32_t>(t), work.tasks[t]);
        }
    };
    if (tasks <= 1) count(0, tasks);
    else executor.parallel_for(tasks, 1, count);
    report.needed = report.written = detail::offset_cells(cells);
    std::uint64_t const capacity = std::min<std::uint64_t>(config.capacity, 0xFFFFFFFFU);
    if (report.needed > capacity) {
        report.left_out = detail::leave_out_sparse(in.lights, report, capacity, work, cells);
        (void)detail::offset_cells(cells);
    }
    return report;
}

template <std::unsigned_integral Index>
void fill_sparse_lists(SparseWorkspace const& work, std::span<Cell const> cells, std::span<Index> indices, core::ExecutorRef executor) {
    GNOMON_EXPECT(work.places.size() == cells.size());
    auto const fill = [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            Cell const cell = cells[c];
            GNOMON_EXPECT(std::size_t{cell.offset} + cell.count <= indices.size());
            std::uint32_t const* const from = work.tasks[work.places[c].task].hits.data() + work.places[c].offset;
            for (std::uint32_t i = 0; i < cell.count; ++i) {
                GNOMON_EXPECT(from[i] <= std::numeric_limits<Index>::max());
                indices[cell.offset + i] = static_cast<Index>(from[i]);
            }
        }
    };
    constexpr std::size_t grain = 2048;
    if (cells.size() <= grain) fill(0, cells.size());
    else executor.parallel_for(cells.size(), grain, fill);
}

}  // namespace gnomon::lights
