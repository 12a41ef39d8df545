#pragma once
// The builder's inner part; see build.hpp.

#include <gnomon/predicates/triangle_list.hpp>
#include <gnomon/trace/bvh.hpp>
#include <gnomon/trace/detail/split.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::trace::detail {

struct Postponed {
    Range range;
    std::uint32_t depth;
};

/// Builds nodes and blocks for ranges of the shared references; ranges of different builders do not overlap.
class Builder {
public:
    std::vector<Node> nodes;
    std::vector<Block> blocks;
    std::vector<Postponed> postponed;  ///< Subtrees left to others; their slots hold `Child::node(index | 1 << 30)`.

    static constexpr std::uint32_t postponed_flag = 1U << 30U;

    Builder(std::vector<Ref>& refs, predicates::TriangleList const& list, std::size_t subtree_size)
        : refs_(&refs), list_(&list), subtree_size_(subtree_size) {}

    void build_all() { build({0, static_cast<std::uint32_t>(refs_->size()), bounds_of(*refs_)}, 0); }

    /// Makes the node of `range`; returns its index.
    std::uint32_t build(Range const& range, std::uint32_t depth) {
        auto const index = static_cast<std::uint32_t>(nodes.size());
        nodes.push_back(empty_node());
        std::array<Range, width> parts;
        std::size_t const count = split_to_width(range, depth, parts);
        for (std::size_t i = 0; i < count; ++i) {
            Child const child = make_child(parts[i], depth + 1);
            Node& node = nodes[index];
            node.child[i] = child;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                node.lo[axis][i] = parts[i].bounds.lo[axis];
                node.hi[axis][i] = parts[i].bounds.hi[axis];
            }
        }
        return index;
    }

private:
    [[nodiscard]] static Node empty_node() noexcept {
        Node node{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t i = 0; i < width; ++i) {
                node.lo[axis][i] = std::numeric_limits<float>::infinity();
                node.hi[axis][i] = -std::numeric_limits<float>::infinity();
            }
        for (Child& child : node.child) child = Child{};
        return node;
    }

    Child make_child(Range const& range, std::uint32_t depth) {
        if (range.size() <= width) return Child::block(make_block(range));
        if (range.size() <= subtree_size_) {
            postponed.push_back({range, depth});
            return Child::node(static_cast<std::uint32_t>(postponed.size() - 1) | postponed_flag);
        }
        return Child::node(build(range, depth));
    }

    std::uint32_t make_block(Range const& range) {
        Block block{};
        for (std::uint32_t lane = 0; lane < width; ++lane) {
            bool const used = lane < range.size();
            core::TriangleId const id((*refs_)[range.begin + (used ? lane : 0)].id());
            Triangle const t = (*list_)[id];
            for (int corner = 0; corner < 3; ++corner)
                for (int axis = 0; axis < 3; ++axis)
                    block.corner[corner][axis][lane] = t[static_cast<std::size_t>(corner)][axis];
            block.id[lane] = used ? id : core::TriangleId::none();
        }
        blocks.push_back(block);
        return static_cast<std::uint32_t>(blocks.size() - 1);
    }

    std::size_t split_to_width(Range const& range, std::uint32_t depth, std::array<Range, width>& parts) {
        parts[0] = range;
        std::size_t count = 1;
        while (count < width) {
            std::size_t largest = width;
            double area = -1.0;
            for (std::size_t i = 0; i < count; ++i)
                if (parts[i].size() > width && parts[i].bounds.half_area() > area) {
                    area = parts[i].bounds.half_area();
                    largest = i;
                }
            if (largest == width) break;
            parts[count++] = split(parts[largest], depth);
        }
        return count;
    }

    /// Cuts `range` in two: it keeps the left part, the right one is returned. Both hold something.
    Range split(Range& range, std::uint32_t depth) {
        std::span<Ref> const refs = std::span(*refs_).subspan(range.begin, range.size());
        std::size_t left = refs.size() / 2;
        // Below this depth only halves are made: data that peels off one triangle at a time cannot go deeper than
        // max_depth, since 31 halvings end any range.
        if (depth < max_depth - 32) {
            Binning const binning = make_binning(refs);
            Split const cut = best_split(bin(refs, binning));
            if (cut.last_left >= 0) {
                auto const goes_left = [&](Ref const& ref) noexcept {
                    return binning.bins_of(ref)[cut.axis] <= cut.last_left;
                };
                left = static_cast<std::size_t>(std::partition(refs.begin(), refs.end(), goes_left) - refs.begin());
            }
        }
        Range const right{range.begin + static_cast<std::uint32_t>(left), range.end, bounds_of(refs.subspan(left))};
        range.end = right.begin;
        range.bounds = bounds_of(refs.first(left));
        return right;
    }

    [[nodiscard]] static Bins bin(std::span<Ref const> refs, Binning const& binning) noexcept {
        Bins bins;
        for (Ref const& ref : refs) {
            auto const place = binning.bins_of(ref);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                Bin& target = bins[axis][static_cast<std::size_t>(place[axis])];
                target.bounds.grow(ref.lo, ref.hi);
                ++target.count;
            }
        }
        return bins;
    }

    std::vector<Ref>* refs_;
    predicates::TriangleList const* list_;
    std::size_t subtree_size_;
};

/// Puts the top and its subtrees into one array each, and points the top's postponed slots at the subtrees.
inline void stitch(Builder& top, std::vector<Builder> const& parts, Bvh& bvh) {
    bvh.nodes = std::move(top.nodes);
    bvh.blocks = std::move(top.blocks);
    std::vector<std::uint32_t> root_of(parts.size());
    std::size_t const top_nodes = bvh.nodes.size();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        auto const node_base = static_cast<std::uint32_t>(bvh.nodes.size());
        auto const block_base = static_cast<std::uint32_t>(bvh.blocks.size());
        root_of[i] = node_base;
        for (Node node : parts[i].nodes) {
            for (Child& child : node.child)
                if (!child.is_empty())
                    child = child.is_block() ? Child::block(child.index() + block_base)
                                             : Child::node(child.index() + node_base);
            bvh.nodes.push_back(node);
        }
        bvh.blocks.insert(bvh.blocks.end(), parts[i].blocks.begin(), parts[i].blocks.end());
    }
    for (std::size_t i = 0; i < top_nodes; ++i)
        for (Child& child : bvh.nodes[i].child)
            if (!child.is_empty() && !child.is_block() && (child.index() & Builder::postponed_flag) != 0)
                child = Child::node(root_of[child.index() & ~Builder::postponed_flag]);
}

}  // namespace gnomon::trace::detail
