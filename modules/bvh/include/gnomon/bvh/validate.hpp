#pragma once
// Checks everything that queries rely on.

#include <gnomon/bvh/detail/lanes_of.hpp>
#include <gnomon/bvh/tree.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace gnomon::bvh {

enum class TreeFault : std::uint8_t {
    none,
    bad_layout,    ///< The levels do not follow from the number of items.
    short_arrays,  ///< An array is shorter than its slots.
    repeated_id,   ///< An id stands for two items.
    loose_box,     ///< A node's box is not the exact union of its children's boxes.
    bad_padding,   ///< A slot beyond a level's last element is not empty.
};

namespace detail {

using BoxOf = std::array<float, 6>;

inline void grow(BoxOf& sum, BoxOf const& box) noexcept {
    if (!(box[0] <= box[3] && box[1] <= box[4] && box[2] <= box[5])) return;
    for (std::size_t k = 0; k < 3; ++k) {
        sum[k] = box[k] < sum[k] ? box[k] : sum[k];
        sum[k + 3] = box[k + 3] > sum[k + 3] ? box[k + 3] : sum[k + 3];
    }
}

template <class Items, std::uint32_t W>
[[nodiscard]] BoxOf box_at(TreeView<Items, W> const& tree, std::uint32_t level, std::size_t i) noexcept {
    BoxOf box;
    if (level == 0) {
        formula::GnBox<float> const b = Items::template box<float>(load_item<float>(tree.items, i));
        box = {b.lo.x.v, b.lo.y.v, b.lo.z.v, b.hi.x.v, b.hi.y.v, b.hi.z.v};
    } else {
        for (std::size_t k = 0; k < 6; ++k) box[k] = tree.nodes[k][tree.layout.first[level] + i];
    }
    return box;
}

template <class Items, std::uint32_t W>
[[nodiscard]] TreeFault check_boxes(TreeView<Items, W> const& tree) noexcept {
    constexpr float inf = std::numeric_limits<float>::infinity();
    for (std::uint32_t level = 1; level <= tree.layout.levels; ++level)
        for (std::size_t node = 0; node < tree.layout.count[level]; ++node) {
            BoxOf sum{inf, inf, inf, -inf, -inf, -inf};
            for (std::size_t child = node * W; child < (node + 1) * W; ++child) {
                BoxOf const box = box_at(tree, level - 1, child);
                bool const padding = child >= tree.layout.count[level - 1];
                if (padding && box[0] <= box[3]) return TreeFault::bad_padding;
                grow(sum, box);
            }
            if (box_at(tree, level, node) != sum) return TreeFault::loose_box;
        }
    return TreeFault::none;
}

}  // namespace detail

/// Whether `tree` is what `build` and `refit` promise; `TreeFault::none` if so.
///
/// cost: O(n) time, a bit an id.
template <ItemList Items, std::uint32_t W>
[[nodiscard]] TreeFault validate(Tree<Items, W> const& tree) {
    if (tree.layout != make_layout(tree.layout.count[0], W)) return TreeFault::bad_layout;
    if (tree.ids.size() < tree.layout.count[0] || tree.items.size() < Items::fields * std::size_t{tree.layout.item_slots} ||
        tree.nodes.size() < 6 * std::size_t{tree.layout.node_slots})
        return TreeFault::short_arrays;
    std::uint64_t const ids = tree.layout.count[0] + tree.left_out;
    std::vector<bool> seen(ids);
    for (std::uint32_t slot = 0; slot < tree.layout.count[0]; ++slot) {
        std::uint32_t const id = tree.ids[slot];
        if (id >= ids || seen[id]) return TreeFault::repeated_id;
        seen[id] = true;
    }
    return detail::check_boxes(tree.view());
}

}  // namespace gnomon::bvh
