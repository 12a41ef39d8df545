#pragma once
// Building a wide Morton hierarchy [Olsson 2014, Paper II, section 3.3]. Sorted by code, equal codes by id: the tree
// follows from the items alone, whatever executor, thread count or instruction set built it.

#include <gnomon/bvh/cost.hpp>
#include <gnomon/bvh/detail/fill.hpp>
#include <gnomon/bvh/detail/keys.hpp>
#include <gnomon/bvh/detail/radix_sort.hpp>
#include <gnomon/bvh/tree.hpp>
#include <gnomon/core/executor.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace gnomon::bvh {

enum class CodeBits : std::uint8_t {
    bits_30,  ///< 1,024 cells an axis: enough for a million items in a view; sorts faster.
    bits_63,  ///< 2,097,152 cells an axis, for items very unevenly spread.
};

/// Scratch memory of `build`. Kept between builds, so that one of as many items or fewer allocates nothing.
struct Workspace {
    std::vector<detail::Key30> keys_30;  ///< two times the items
    std::vector<detail::Key63> keys_63;
    std::vector<std::uint32_t> counts;   ///< at most 32 blocks of a digit's buckets
    std::vector<detail::BlockSummary> blocks;
    std::vector<float> records;          ///< 16 bytes a sphere, 32 a box
};

namespace detail {

/// Items in the order of sorted keys.
template <class Items, class Key>
struct KeySource {
    static constexpr std::size_t step = record_size<Items::fields>;
    float const* records;
    Key const* keys;

    [[gnu::always_inline]] void fetch(std::size_t slot) const noexcept {
        __builtin_prefetch(records + keys[slot].id() * step);
    }
    template <class Arrays>
    [[gnu::always_inline]] void copy(std::size_t slot, Arrays const& tree) const noexcept {
        std::uint32_t const id = keys[slot].id();
        for (std::size_t k = 0; k < Items::fields; ++k) tree.items[k][slot] = records[id * step + k];
        tree.ids[slot] = id;
    }
};

template <class Items>
BlockSummary summarize_all(Items const& items, Workspace& work, core::ExecutorRef executor) {
    Blocks const blocks = Blocks::of(items.size());
    work.blocks.assign(blocks.count, BlockSummary{});
    Arrays<Items> const arrays = items.arrays();
    bool const wide = has_avx2();
    for_each_block(executor, blocks, [&](std::size_t block) {
#if GNOMON_BVH_AVX2
        if (wide) return summarize_avx2<Items>(arrays, blocks.begin(block), blocks.end(block), work.blocks[block]);
#endif
        summarize<Items, PlainLanes>(arrays, blocks.begin(block), blocks.end(block), work.blocks[block]);
    });
    static_cast<void>(wide);
    BlockSummary total;
    for (BlockSummary& block : work.blocks) {
        std::uint32_t const before = total.usable;
        total.add(block);
        block.usable = before;  // from now on: where the block's keys begin
    }
    return total;
}

/// Keys of all usable items, sorted.
template <class Key, class Items>
Key const* sorted_keys(Items const& items, BlockSummary const& total, std::vector<Key>& keys, Workspace& work,
                       core::ExecutorRef executor) {
    Blocks const blocks = Blocks::of(items.size());
    keys.resize(std::max(keys.size(), 2 * items.size()));
    work.records.resize(std::max(work.records.size(), items.size() * record_size<Items::fields>));
    auto const cells = static_cast<float>(Key::digits == Key30::digits ? 1U << 10U : 1U << 21U);
    formula::GnCodeGrid const grid = make_code_grid(total, cells);
    Arrays<Items> const arrays = items.arrays();
    bool const wide = has_avx2();
    for_each_block(executor, blocks, [&](std::size_t block) {
        KeyOutput<Key> const out{keys.data() + work.blocks[block].usable, work.records.data()};
#if GNOMON_BVH_AVX2
        if (wide) return make_keys_avx2<Items, Key>(arrays, grid, blocks.begin(block), blocks.end(block), out);
#endif
        make_keys<Items, Key, PlainLanes>(arrays, grid, blocks.begin(block), blocks.end(block), out);
    });
    static_cast<void>(wide);
    return sort_keys(keys.data(), keys.data() + items.size(), total.usable, work.counts, executor);
}

}  // namespace detail

/// Builds `tree` over `items`. The tree holds every usable item once; the others are counted in `left_out`.
///
/// source:  [Olsson 2014, Paper II, section 3.3; Paper III, section 5.2.1]
/// expects: at most 2^31 items.
/// cost:    O(n): three digits of 30-bit codes, six of 63-bit ones. Allocates only what `work` and `tree` lack.
template <ItemList Items, std::uint32_t W>
void build(Items const& items, CodeBits codes, Workspace& work, Tree<Items, W>& tree, core::ExecutorRef executor) {
    detail::BlockSummary const total = detail::summarize_all(items, work, executor);
    tree.layout = make_layout(total.usable, W);
    tree.left_out = items.size() - total.usable;
    tree.ids.resize(total.usable);
    tree.items.resize(Items::fields * std::size_t{tree.layout.item_slots});
    tree.nodes.resize(6 * std::size_t{tree.layout.node_slots});
    detail::TreeArrays<Items, W> const arrays(tree);
    detail::pad_nodes(arrays);
    auto const fill = [&]<class Key>(std::vector<Key>& keys) {
        Key const* const sorted = detail::sorted_keys(items, total, keys, work, executor);
        detail::fill_tree(arrays, detail::KeySource<Items, Key>{work.records.data(), sorted}, executor);
    };
    if (codes == CodeBits::bits_30) fill(work.keys_30);
    else fill(work.keys_63);
    tree.built_cost = cost(tree.view());
}

/// The same on any executor, a temporary too.
template <ItemList Items, std::uint32_t W, core::Executor E>
    requires(!std::same_as<std::remove_cvref_t<E>, core::ExecutorRef>)
void build(Items const& items, CodeBits codes, Workspace& work, Tree<Items, W>& tree, E&& executor) {
    build(items, codes, work, tree, core::ExecutorRef(executor));
}

/// A new tree over `items`, on the calling thread.
template <std::uint32_t W = 32, ItemList Items>
[[nodiscard]] Tree<Items, W> build_tree(Items const& items, CodeBits codes = CodeBits::bits_30) {
    Workspace work;
    Tree<Items, W> tree;
    build(items, codes, work, tree, core::SerialExecutor{});
    return tree;
}

}  // namespace gnomon::bvh
