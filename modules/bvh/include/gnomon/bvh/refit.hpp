#pragma once
// Following items that moved: the order stays, the boxes are made anew, and a figure says when to build again.

#include <gnomon/bvh/cost.hpp>
#include <gnomon/bvh/detail/fill.hpp>
#include <gnomon/bvh/tree.hpp>
#include <gnomon/core/contract.hpp>
#include <gnomon/core/executor.hpp>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace gnomon::bvh {

struct Refit {
    double cost = 0.0;        ///< `cost` of the tree now.
    double quality = 1.0;     ///< The cost when it was built over the cost now: below some 0.5, build again.
    std::uint64_t lost = 0;   ///< Items of the tree that are not usable now: nothing touches them until they are.
};

namespace detail {

template <class Items>
struct MovedSource {
    std::array<float const*, Items::fields> arrays;
    std::uint32_t const* ids;
    std::atomic<std::uint64_t>& lost;

    [[gnu::always_inline]] void fetch(std::size_t slot) const noexcept {
        for (float const* array : arrays) __builtin_prefetch(array + ids[slot]);
    }
    template <class TreeArrays>
    [[gnu::always_inline]] void copy(std::size_t slot, TreeArrays const& tree) const noexcept {
        ItemOf<float, Items::fields> const item = load_item<float>(arrays, ids[slot]);
        bool const usable = Items::template usable<float>(item).v;
        for (std::size_t k = 0; k < Items::fields; ++k) tree.items[k][slot] = usable ? item[k].v : Items::nothing[k];
        if (!usable) lost.fetch_add(1, std::memory_order_relaxed);
    }
};

}  // namespace detail

/// Takes the new places of the items that `tree` was built over; `items` is the same list, moved.
///
/// expects: `items` is as long as the list of the build. An item that the build left out stays out: build again.
/// returns: how good the tree still is. Never allocates.
/// cost:    O(n): about the last third of a build.
template <ItemList Items, std::uint32_t W, core::Executor E>
Refit refit(Tree<Items, W>& tree, Items const& items, E&& executor) {
    GNOMON_EXPECT(items.size() == tree.ids.size() + tree.left_out);
    std::atomic<std::uint64_t> lost{0};
    detail::TreeArrays<Items, W> const arrays(tree);
    detail::fill_tree(arrays, detail::MovedSource<Items>{items.arrays(), tree.ids.data(), lost}, core::ExecutorRef(executor));
    Refit result;
    result.cost = cost(tree.view());
    result.quality = result.cost > 0.0 ? tree.built_cost / result.cost : 1.0;
    result.lost = lost;
    return result;
}

template <ItemList Items, std::uint32_t W>
Refit refit(Tree<Items, W>& tree, Items const& items) {
    return refit(tree, items, core::SerialExecutor{});
}

}  // namespace gnomon::bvh
