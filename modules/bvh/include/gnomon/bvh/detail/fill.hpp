#pragma once
// Filling a tree: items into their order, boxes of the nodes above them. Boxes of spheres are rounded outward, unions
// of boxes are exact, so the order of the work does not matter.

#include <gnomon/bvh/detail/lanes_of.hpp>
#include <gnomon/bvh/tree.hpp>
#include <gnomon/core/executor.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace gnomon::bvh::detail {

/// The arrays of a tree that is being filled.
template <class Items, std::uint32_t W>
struct TreeArrays {
    Layout layout;
    std::array<float*, Items::fields> items;
    std::array<float*, 6> nodes;
    std::uint32_t* ids;

    explicit TreeArrays(Tree<Items, W>& tree) noexcept : layout(tree.layout), ids(tree.ids.data()) {
        for (std::size_t k = 0; k < Items::fields; ++k) items[k] = tree.items.data() + k * layout.item_slots;
        for (std::size_t k = 0; k < 6; ++k) nodes[k] = tree.nodes.data() + k * layout.node_slots;
    }
};

template <class S>
struct BoxSum {
    formula::Float<S> lo[3], hi[3];

    [[gnu::always_inline]] BoxSum() noexcept {
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = formula::Float<S>(std::numeric_limits<float>::infinity());
            hi[k] = formula::Float<S>(-std::numeric_limits<float>::infinity());
        }
    }
    [[gnu::always_inline]] void add(formula::GnBox<S> const& box) noexcept {
        formula::Float<S> const low[3] = {box.lo.x, box.lo.y, box.lo.z};
        formula::Float<S> const high[3] = {box.hi.x, box.hi.y, box.hi.z};
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = gn_min(lo[k], low[k]);
            hi[k] = gn_max(hi[k], high[k]);
        }
    }
    /// The union over the lanes, to slot `at` of the nodes' arrays.
    [[gnu::always_inline]] void store_to(std::array<float*, 6> const& nodes, std::size_t at) const noexcept {
        for (std::size_t k = 0; k < 3; ++k) {
            float low[lane_count<S>];
            float high[lane_count<S>];
            store(low, lo[k]);
            store(high, hi[k]);
            for (std::size_t i = 1; i < lane_count<S>; ++i) {
                low[0] = low[i] < low[0] ? low[i] : low[0];
                high[0] = high[i] > high[0] ? high[i] : high[0];
            }
            nodes[k][at] = low[0];
            nodes[k + 3][at] = high[0];
        }
    }
};

/// The box of node `node` of level 1 from its items' slots; what is no item has an empty box there.
template <class Items, class S, std::uint32_t W>
[[gnu::always_inline]] inline void bound_items(TreeArrays<Items, W> const& tree, std::uint32_t node) noexcept {
    BoxSum<S> sum;
    std::array<float const*, Items::fields> arrays;
    for (std::size_t k = 0; k < Items::fields; ++k) arrays[k] = tree.items[k];
    for (std::uint32_t i = 0; i < W; i += static_cast<std::uint32_t>(lane_count<S>)) {
        ItemOf<S, Items::fields> const item = load_item<S>(arrays, std::size_t{node} * W + i);
        formula::GnBox<S> box = Items::template box<S>(item);
        formula::Bool<S> const none = gn_is_empty(box);
        formula::Float<S> const inf(std::numeric_limits<float>::infinity());
        box.lo = {gn_select(none, inf, box.lo.x), gn_select(none, inf, box.lo.y), gn_select(none, inf, box.lo.z)};
        box.hi = {gn_select(none, -inf, box.hi.x), gn_select(none, -inf, box.hi.y), gn_select(none, -inf, box.hi.z)};
        sum.add(box);
    }
    sum.store_to(tree.nodes, std::size_t{tree.layout.first[1]} + node);
}

/// Nodes [begin, end) of level 2 and above, from the level below.
template <class S, class Items, std::uint32_t W>
[[gnu::always_inline]] inline void bound_nodes(TreeArrays<Items, W> const& tree, std::uint32_t level,
                                               std::size_t begin, std::size_t end) noexcept {
    std::array<float const*, 6> arrays;
    for (std::size_t k = 0; k < 6; ++k) arrays[k] = tree.nodes[k] + tree.layout.first[level - 1];
    for (std::size_t node = begin; node < end; ++node) {
        BoxSum<S> sum;
        for (std::size_t i = 0; i < W; i += lane_count<S>) {
            ItemOf<S, 6> const b = load_item<S>(arrays, node * W + i);
            sum.add({{b[0], b[1], b[2]}, {b[3], b[4], b[5]}});
        }
        sum.store_to(tree.nodes, tree.layout.first[level] + node);
    }
}

/// How many items ahead of use their memory is asked for: of 12 to 320 tried, 96 and more are twice as fast as 24.
inline constexpr std::size_t fetch_ahead = 128;

/// Copies the items of nodes [begin, end) of level 1 into their order and bounds them.
///
/// `source.copy(slot, tree)` writes an item's numbers and id, `source.fetch(slot)` is told what will be asked for soon.
template <class S, class Items, std::uint32_t W, class Source>
[[gnu::always_inline]] inline void fill_leaves(TreeArrays<Items, W> const& tree, std::size_t begin, std::size_t end,
                                               Source const& source) noexcept {
    std::size_t const count = tree.layout.count[0];
    for (std::size_t node = begin; node < end; ++node) {
        std::size_t const first = node * W;
        std::size_t const last = first + W < count ? first + W : count;
        for (std::size_t slot = first; slot < last; ++slot) {
            source.fetch(slot + fetch_ahead < count ? slot + fetch_ahead : slot);
            source.copy(slot, tree);
        }
        for (std::size_t slot = last; slot < first + W; ++slot)
            for (std::size_t k = 0; k < Items::fields; ++k) tree.items[k][slot] = Items::nothing[k];
        bound_items<Items, S, W>(tree, static_cast<std::uint32_t>(node));
    }
}

#if GNOMON_BVH_AVX2
template <class Items, std::uint32_t W, class Source>
[[gnu::target("avx2"), gnu::flatten]] void fill_leaves_avx2(TreeArrays<Items, W> const& tree, std::size_t begin,
                                                            std::size_t end, Source const& source) noexcept {
    fill_leaves<math::Lanes<float, 8>>(tree, begin, end, source);
}
#endif

#if GNOMON_VECTOR_EXTENSION
using PlainLanes = math::Lanes<float, 4>;
#else
using PlainLanes = float;
#endif

/// Fills the whole tree, level by level.
template <class Items, std::uint32_t W, class Source>
void fill_tree(TreeArrays<Items, W> const& tree, Source const& source, core::ExecutorRef executor) {
    if (tree.layout.levels == 0) return;
    bool const wide = has_avx2();
    auto const leaves = [&](std::size_t begin, std::size_t end) {
#if GNOMON_BVH_AVX2
        if (wide) return fill_leaves_avx2(tree, begin, end, source);
#endif
        fill_leaves<PlainLanes>(tree, begin, end, source);
    };
    static_cast<void>(wide);
    if (tree.layout.count[1] <= 512) leaves(0, tree.layout.count[1]);
    else executor.parallel_for(tree.layout.count[1], 512, leaves);
    for (std::uint32_t level = 2; level <= tree.layout.levels; ++level) {
        auto const nodes = [&](std::size_t begin, std::size_t end) { bound_nodes<PlainLanes>(tree, level, begin, end); };
        if (tree.layout.count[level] <= 2048) nodes(0, tree.layout.count[level]);
        else executor.parallel_for(tree.layout.count[level], 1024, nodes);
    }
}

/// Empty boxes where a level's last node has no further children.
template <class Items, std::uint32_t W>
void pad_nodes(TreeArrays<Items, W> const& tree) noexcept {
    constexpr float inf = std::numeric_limits<float>::infinity();
    for (std::uint32_t level = 1; level <= tree.layout.levels; ++level) {
        std::uint32_t const end = level == tree.layout.levels ? tree.layout.node_slots : tree.layout.first[level + 1];
        for (std::uint32_t slot = tree.layout.first[level] + tree.layout.count[level]; slot < end; ++slot)
            for (std::size_t k = 0; k < 6; ++k) tree.nodes[k][slot] = k < 3 ? inf : -inf;
    }
}

}  // namespace gnomon::bvh::detail
