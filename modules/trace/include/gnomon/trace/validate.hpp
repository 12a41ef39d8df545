#pragma once
// Checks everything that queries rely on.

#include <gnomon/trace/bvh.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::trace {

enum class BvhFault : std::uint8_t {
    none,
    empty_root,      ///< There are triangles but no nodes, or nodes but no triangles.
    bad_child,       ///< A child's index is out of range.
    shared_child,    ///< A node or block is reachable twice.
    unreachable,     ///< A node or block is not reachable.
    too_deep,        ///< Deeper than `max_depth`.
    loose_box,       ///< A slot's box is not the exact bounds of what is below it.
    wrong_count,     ///< The blocks do not hold `triangles` triangles.
};

namespace detail {

struct Checked {
    std::array<float, 3> lo;
    std::array<float, 3> hi;
};

struct Validator {
    Bvh const& bvh;
    std::vector<bool> node_seen = std::vector<bool>(bvh.nodes.size());
    std::vector<bool> block_seen = std::vector<bool>(bvh.blocks.size());
    std::size_t triangles = 0;
    BvhFault fault = BvhFault::none;

    void fail(BvhFault f) { fault = fault == BvhFault::none ? f : fault; }

    Checked check_block(std::uint32_t index) {
        Checked box{{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
        if (block_seen[index]) fail(BvhFault::shared_child);
        block_seen[index] = true;
        for (std::size_t lane = 0; lane < width; ++lane) {
            if (bvh.blocks[index].id[lane].is_none()) continue;
            ++triangles;
            for (math::vec3 const& p : bvh.blocks[index].triangle(lane))
                for (int axis = 0; axis < 3; ++axis) {
                    auto const i = static_cast<std::size_t>(axis);
                    box.lo[i] = std::min(box.lo[i], p[axis]);
                    box.hi[i] = std::max(box.hi[i], p[axis]);
                }
        }
        return box;
    }

    Checked check_node(std::uint32_t index, std::size_t depth) {
        Checked box{{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
        if (node_seen[index]) fail(BvhFault::shared_child);
        if (depth >= max_depth) fail(BvhFault::too_deep);
        if (fault != BvhFault::none) return box;
        node_seen[index] = true;
        Node const& node = bvh.nodes[index];
        for (std::size_t i = 0; i < width; ++i) {
            Child const child = node.child[i];
            bool const legal = child.is_empty() ||
                               child.index() < (child.is_block() ? bvh.blocks.size() : bvh.nodes.size());
            if (!legal) fail(BvhFault::bad_child);
            if (child.is_empty() || !legal) continue;
            Checked const below = child.is_block() ? check_block(child.index()) : check_node(child.index(), depth + 1);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (node.lo[axis][i] != below.lo[axis] || node.hi[axis][i] != below.hi[axis]) fail(BvhFault::loose_box);
                box.lo[axis] = std::min(box.lo[axis], below.lo[axis]);
                box.hi[axis] = std::max(box.hi[axis], below.hi[axis]);
            }
        }
        return box;
    }
};

}  // namespace detail

/// Whether `bvh` is what `build_bvh` promises; `BvhFault::none` if so.
///
/// cost: O(n) time and 2 bits a node or block.
[[nodiscard]] inline BvhFault validate(Bvh const& bvh) {
    if (bvh.nodes.empty() != (bvh.triangles == 0)) return BvhFault::empty_root;
    if (bvh.nodes.empty()) return bvh.blocks.empty() ? BvhFault::none : BvhFault::unreachable;
    detail::Validator validator{bvh};
    static_cast<void>(validator.check_node(0, 0));
    auto const all = [](std::vector<bool> const& seen) { return std::find(seen.begin(), seen.end(), false) == seen.end(); };
    if (validator.fault == BvhFault::none && !(all(validator.node_seen) && all(validator.block_seen)))
        return BvhFault::unreachable;
    if (validator.fault == BvhFault::none && validator.triangles != bvh.triangles) return BvhFault::wrong_count;
    return validator.fault;
}

}  // namespace gnomon::trace
