#pragma once
// Asking a tree: which items may a region touch?
//
// Order: by default tree order (ascending place in the tree), which is the same on every machine. Lists that must be in
// the order of the caller's ids either ask `query_by_id`, or, cheaper where many lists are made, renumber the caller's
// items by `Tree::ids` once: then tree order is ascending order.

#include <gnomon/bvh/detail/child_tests.hpp>
#include <gnomon/bvh/region.hpp>
#include <gnomon/bvh/tree.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace gnomon::bvh {

/// What a query looked at.
struct QueryStats {
    std::uint64_t hits = 0;
    std::uint64_t nodes = 0;  ///< Opened; each tested its children, up to W of them.
};

/// Calls `visit(slot, id)` for every item that `region` may touch, in tree order; a visitor that returns bool ends the
/// walk with false.
///
/// expects: `tree` passes `validate`. An empty tree is legal.
/// cost:    O(opened nodes), W children each. Never allocates; the stack is `max_levels` entries.
template <ItemList Items, std::uint32_t W, Region R, class F>
QueryStats for_each_touched(TreeView<Items, W> const& tree, R const& region, F&& visit) {
    QueryStats stats;
    if (tree.layout.levels == 0) return stats;
    auto const touched = detail::make_child_tests(tree, region);
    std::array<std::uint32_t, max_levels + 1> node{};
    std::array<std::uint32_t, max_levels + 1> left{};
    std::uint32_t level = tree.layout.levels;
    ++stats.nodes;
    left[level] = touched(level, 0);
    while (true) {
        if (left[level] == 0) {
            if (level == tree.layout.levels) return stats;
            ++level;
            continue;
        }
        std::uint32_t const child = node[level] * W + static_cast<std::uint32_t>(std::countr_zero(left[level]));
        left[level] &= left[level] - 1;
        if (level > 1) {
            node[--level] = child;
            left[level] = touched(level, child);
            ++stats.nodes;
            continue;
        }
        ++stats.hits;
        if constexpr (std::is_same_v<std::invoke_result_t<F&, std::uint32_t, std::uint32_t>, bool>) {
            if (!visit(child, tree.ids[child])) return stats;
        } else {
            visit(child, tree.ids[child]);
        }
    }
}

/// Writes to `out` the id of every item that `region` may touch, in tree order.
///
/// expects: `tree` passes `validate`. An empty tree is legal.
/// returns: the number of hits. If it exceeds `out.size()`, only the first `out.size()` were written; call again with a
///          larger buffer. Never allocates, never fails.
template <ItemList Items, std::uint32_t W, Region R>
[[nodiscard]] std::size_t query(TreeView<Items, W> const& tree, R const& region, std::span<std::uint32_t> out) noexcept {
    std::size_t hits = 0;
    for_each_touched(tree, region, [&](std::uint32_t, std::uint32_t id) {
        if (hits < out.size()) out[hits] = id;
        ++hits;
    });
    return hits;
}

/// The same in ascending order of ids. Where `out` is too small, what was written is sorted, but is the first of the
/// tree's order.
///
/// cost: O(h log h) more for h hits.
template <ItemList Items, std::uint32_t W, Region R>
[[nodiscard]] std::size_t query_by_id(TreeView<Items, W> const& tree, R const& region, std::span<std::uint32_t> out) noexcept {
    std::size_t const hits = query(tree, region, out);
    std::sort(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(std::min(hits, out.size())));
    return hits;
}

}  // namespace gnomon::bvh
