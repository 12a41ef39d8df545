#pragma once
// A task of the sparse assignment: some segments, one after the other, with memory of its own.

#include <gnomon/bvh/query.hpp>
#include <gnomon/cluster/normal_cells.hpp>
#include <gnomon/lights/detail/segments.hpp>
#include <gnomon/lights/detail/sparse_rows.hpp>
#include <gnomon/lights/detail/wide_box.hpp>
#include <gnomon/lights/light_tree.hpp>
#include <gnomon/lights/lists.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon::lights {

/// Clusters that want lists, and lights that may be in them.
struct SparseInput {
    cull::RowGrid const& grid;
    std::span<Light const> lights;
    LightTree const& tree;                                  ///< Of `lights`.
    std::span<cluster::ClusterCoordinates const> clusters;  ///< Any order; one may come several times, as with normals in its key.
    std::span<math::Aabb const> boxes{};                    ///< Explicit bounds of samples, in culling space; or none.
    std::span<cluster::NormalCone const> cones{};           ///< Of normals in culling space; or none.
};

namespace detail {

/// Where a cluster's list waits for the fill.
struct ListPlace {
    std::size_t offset = 0;
    std::uint32_t task = 0;
};

/// Enough for the load to even out on some dozen threads.
inline constexpr std::size_t most_tasks = 64;

struct SparseTask {
    std::vector<std::uint32_t> slots;  ///< Of candidates, then of those found.
    std::size_t slot_count = 0;
    FloatArrays<2> spans;              ///< Of those found: low, high.
    std::vector<std::uint32_t> spots;
    std::vector<std::uint64_t> order;  ///< Id, then place among those found.
    std::vector<std::uint32_t> ids;    ///< Sorted from here on.
    FloatArrays<7> sorted;             ///< See SortedLights.
    std::vector<std::uint32_t> hits;   ///< Lists, one after the other.
    std::size_t hit_count = 0;

    [[nodiscard]] std::size_t bytes() const noexcept {
        return 4 * (slots.capacity() + spots.capacity() + ids.capacity() + hits.capacity() + spans.memory.capacity() + sorted.memory.capacity()) +
               8 * order.capacity();
    }
};

struct SparseRun {
    SparseInput const& in;
    float facing_slack_m;
    SparseKernels kernels;
    std::span<std::uint64_t const> order;
    std::span<Cell> cells;
    std::span<ListPlace> places;

    [[nodiscard]] std::uint32_t cluster(std::uint32_t i) const noexcept { return static_cast<std::uint32_t>(order[i]); }
    [[nodiscard]] SegmentPlace place(Segment const& s) const noexcept {
        cluster::ClusterCoordinates const& a = in.clusters[cluster(s.first)];
        return {a.row, a.slice, a.column, in.clusters[cluster(s.last - 1)].column};
    }
};

template <class T>
void make_room(std::vector<T>& list, std::size_t size) {
    if (list.size() < size) list.resize(2 * size);
}

/// What the tree is asked for: the segment's box, or that of its clusters' explicit ones.
[[nodiscard]] inline math::Aabb query_box(SparseRun const& run, Segment const& s, SegmentPlace const& at) noexcept {
    if (run.in.boxes.empty()) return box_of(run.in.grid, at);
    math::Aabb box;
    for (std::uint32_t i = s.first; i < s.last; ++i)
        if (!is_empty(run.in.boxes[run.cluster(i)])) box = math::merged(box, run.in.boxes[run.cluster(i)]);
    return box;
}

/// Spans of spots and boxes, which are less than their balls'.
inline void cut_others(SparseRun const& run, SegmentInput const& in, std::size_t count, SparseTask& task) {
    FoundSpans const found{task.spans[0], task.spans[1], task.slots.data()};
    make_room(task.spots, count);
    std::size_t spots = 0;
    for (std::size_t i = 0; i < count; ++i) {
        Light const& light = in.lights[in.tree.ids[task.slots[i]]];
        if (is_cone(light)) task.spots[spots++] = static_cast<std::uint32_t>(i);
        if (light.kind != Kind::box) continue;
        cull::Span const s = span_of(in.grid, light, in.at.row, in.at.slice);
        found.low[i] = s.low.v;
        found.high[i] = s.high.v;
    }
    if (spots != 0) run.kernels.spots(in, std::span(task.spots).first(spots), found);
}

/// The segment's lights in ascending order, those that are everywhere among them.
[[nodiscard]] inline SortedLights sort_lights(SparseRun const& run, std::size_t found, SparseTask& task) {
    LightTree const& tree = run.in.tree;
    TreeArrays const arrays = tree.tree.view();
    std::size_t const count = found + tree.directional.size();
    std::size_t const padded = count + SortedLights::padding;
    make_room(task.order, count);
    make_room(task.ids, count);
    task.sorted.grow(padded);
    for (std::size_t i = 0; i < found; ++i) task.order[i] = std::uint64_t{arrays.ids[task.slots[i]]} << 32U | i;
    for (std::size_t i = found; i < count; ++i) task.order[i] = std::uint64_t{tree.directional[i - found]} << 32U | i;
    std::sort(task.order.begin(), task.order.begin() + static_cast<std::ptrdiff_t>(count));
    bool const with_places = !run.in.boxes.empty() || !run.in.cones.empty();
    float const* const low = task.spans[0];
    float const* const high = task.spans[1];
    for (std::size_t i = 0; i < count; ++i) {
        auto const from = static_cast<std::uint32_t>(task.order[i]);
        bool const everywhere = from >= found;
        task.ids[i] = static_cast<std::uint32_t>(task.order[i] >> 32U);
        task.sorted[0][i] = everywhere ? -formula::gn_far() : low[from];
        task.sorted[1][i] = everywhere ? formula::gn_far() : high[from];
        if (!with_places) continue;
        std::uint32_t const slot = everywhere ? 0 : task.slots[from];
        for (std::size_t k = 0; k < 3; ++k) task.sorted[2 + k][i] = everywhere ? 0.0F : arrays.items[k][slot];
        task.sorted[5][i] = everywhere ? std::numeric_limits<float>::infinity() : gn_touch_limit(formula::Float<float>(arrays.items[3][slot])).v;
        bool const faces = !everywhere && (tree.only_points || run.in.lights[task.ids[i]].kind != Kind::box);
        task.sorted[6][i] = faces ? task.sorted[2][i] : std::numeric_limits<float>::quiet_NaN();
    }
    for (std::size_t i = count; i < padded; ++i) {
        task.sorted[0][i] = formula::gn_far();
        task.sorted[1][i] = -formula::gn_far();
        for (std::size_t k = 2; k < 7; ++k) task.sorted[k][i] = 0.0F;
    }
    return {count, task.ids.data(), task.sorted[0], task.sorted[1], task.sorted[2], task.sorted[3], task.sorted[4], task.sorted[5], task.sorted[6]};
}

[[nodiscard]] inline MemberTest test_of(SparseRun const& run, std::uint32_t cluster, SegmentPlace const& at) noexcept {
    std::uint32_t const column = run.in.clusters[cluster].column;
    MemberTest test;
    test.left = run.in.grid.left[column];
    test.right = run.in.grid.right[column];
    test.has_box = !run.in.boxes.empty();
    test.has_cone = !run.in.cones.empty();
    if (!test.has_box && !test.has_cone) return test;
    math::Aabb const box = test.has_box ? run.in.boxes[cluster] : box_of(run.in.grid, {at.row, at.slice, column, column});
    test.box = math::formula_box(box);
    if (!test.has_cone) return test;
    cluster::NormalCone const& cone = run.in.cones[cluster];
    test.cone = cull::formula_cone({cone.axis, cone.cos_half});
    test.samples = samples_ball(box, run.facing_slack_m);
    return test;
}

/// Finds the lists of the clusters of some segments, into the task's memory.
inline void count_segments(SparseRun const& run, std::span<Segment const> segments, std::uint32_t number, SparseTask& task) {
    TreeArrays const tree = run.in.tree.tree.view();
    task.hit_count = 0;
    for (Segment const& s : segments) {
        SegmentPlace const at = run.place(s);
        SegmentInput const in{run.in.grid, at, tree, run.in.lights};
        task.slot_count = 0;
        bvh::for_each_touched(tree, WideBox{query_box(run, s, at)}, [&](std::uint32_t slot, std::uint32_t) {
            make_room(task.slots, task.slot_count + 1);
            task.slots[task.slot_count++] = slot;
        });
        task.spans.grow(task.slot_count);
        FoundSpans const out{task.spans[0], task.spans[1], task.slots.data()};
        std::size_t const found = run.kernels.spans(in, std::span(task.slots).first(task.slot_count), out);
        if (!run.in.tree.only_points) cut_others(run, in, found, task);
        SortedLights const sorted = sort_lights(run, found, task);
        for (std::uint32_t i = s.first; i < s.last; ++i) {
            std::uint32_t const c = run.cluster(i);
            make_room(task.hits, task.hit_count + sorted.count);
            run.places[c] = {task.hit_count, number};
            bool const nothing = !run.in.boxes.empty() && is_empty(run.in.boxes[c]);
            std::size_t const count = nothing ? 0 : run.kernels.members(sorted, test_of(run, c, at), task.hits.data() + task.hit_count);
            run.cells[c].count = static_cast<std::uint32_t>(count);
            task.hit_count += count;
        }
    }
}

}  // namespace detail

}  // namespace gnomon::lights
