#pragma once
// A wide hierarchy without pointers [Olsson 2014, Paper II, section 3.3; Paper III, section 5.2.1]: the items in Morton
// order, W consecutive ones under a node, W consecutive nodes under a node of the next level, until one is left.
//
//     level 0: the items, in tree order;   level l: ceil(count of level l - 1 / W) nodes;   the top level: one
//     children of node i of level l: the elements i W ... min(i W + W, count of level l - 1) - 1 of level l - 1
//
// Everything is arrays of floats, one a coordinate, each level padded to a multiple of W: a GPU takes them as they are.

#include <gnomon/bvh/items.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::bvh {

/// Levels of the deepest tree: 2^32 items, eight to a node.
inline constexpr std::uint32_t max_levels = 12;

/// How many elements each level has, and where its nodes begin in the arrays. Follows from the number of items alone.
struct Layout {
    std::uint32_t levels = 0;                      ///< Of nodes; 0 for a tree without items.
    std::array<std::uint32_t, max_levels> count{};  ///< Elements of a level; `count[0]` items.
    std::array<std::uint32_t, max_levels> first{};  ///< Where level l >= 1 begins in the nodes' arrays.
    std::uint32_t item_slots = 0;                  ///< `count[0]`, padded
    std::uint32_t node_slots = 0;                  ///< of all levels, each padded

    friend constexpr bool operator==(Layout const&, Layout const&) noexcept = default;
};

/// expects: `items` at most 2^31.
[[nodiscard]] constexpr Layout make_layout(std::uint32_t items, std::uint32_t width) noexcept {
    GNOMON_EXPECT(items <= 1U << 31U);
    auto const padded = [width](std::uint32_t n) { return (n + width - 1) / width * width; };
    Layout layout;
    layout.count[0] = items;
    layout.item_slots = padded(items);
    while (layout.count[layout.levels] > 1 || (layout.levels == 0 && items != 0)) {
        std::uint32_t const nodes = padded(layout.count[layout.levels]) / width;
        ++layout.levels;
        layout.count[layout.levels] = nodes;
        layout.first[layout.levels] = layout.node_slots;
        layout.node_slots += padded(nodes);
    }
    return layout;
}

/// What a query walks: a `Tree`, or the same arrays in somebody's buffers.
template <ItemList Items, std::uint32_t W = 32>
struct TreeView {
    static_assert(W == 8 || W == 16 || W == 32);
    static constexpr std::uint32_t width = W;

    Layout layout;
    std::array<float const*, Items::fields> items{};  ///< `item_slots` numbers each, in tree order.
    std::array<float const*, 6> nodes{};              ///< `node_slots` numbers each: lo x y z, hi x y z.
    std::uint32_t const* ids = nullptr;               ///< The item's place in the list that the tree was built over.
};

/// Made by `build`, kept up by `refit`. Holds copies: the list that it was built over may go away.
template <ItemList Items, std::uint32_t W = 32>
struct Tree {
    static_assert(W == 8 || W == 16 || W == 32);
    static constexpr std::uint32_t width = W;

    Layout layout;
    std::vector<std::uint32_t> ids;   ///< In tree order: ascending code, then ascending id.
    std::vector<float> items;         ///< `Items::fields` arrays of `layout.item_slots`.
    std::vector<float> nodes;         ///< Six arrays of `layout.node_slots`.
    std::uint64_t left_out = 0;       ///< Items with a NaN, an infinity, a negative radius or without a point.
    double built_cost = 0.0;          ///< `cost` of the tree as `build` made it.

    [[nodiscard]] TreeView<Items, W> view() const noexcept {
        TreeView<Items, W> v;
        v.layout = layout;
        for (std::size_t k = 0; k < Items::fields; ++k) v.items[k] = items.data() + k * layout.item_slots;
        for (std::size_t k = 0; k < 6; ++k) v.nodes[k] = nodes.data() + k * layout.node_slots;
        v.ids = ids.data();
        return v;
    }
};

using SphereTree = Tree<Spheres>;
using BoxTree = Tree<Boxes>;

static_assert(make_layout(0, 32).levels == 0 && make_layout(1, 32).levels == 1 && make_layout(33, 32).levels == 2);
static_assert(make_layout(1U << 20U, 32).count == std::array<std::uint32_t, max_levels>{1U << 20U, 32768, 1024, 32, 1});

}  // namespace gnomon::bvh
