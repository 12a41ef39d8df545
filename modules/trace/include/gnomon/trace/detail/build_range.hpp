#pragma once
// The builder's inner part; see build.hpp. Nothing here decides visibility: a bad split costs time, never a result.

#include <gnomon/math/lanes.hpp>
#include <gnomon/predicates/triangle_list.hpp>
#include <gnomon/trace/bvh.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::trace::detail {

using Float4 = math::Lanes<float, 4>;  ///< x, y, z and a lane that nobody reads.

struct Box {
    Float4 lo = Float4::all(std::numeric_limits<float>::infinity());
    Float4 hi = Float4::all(-std::numeric_limits<float>::infinity());

    void grow(Float4 const& other_lo, Float4 const& other_hi) noexcept {
        lo = min(lo, other_lo);
        hi = max(hi, other_hi);
    }
    /// Half the surface, in double: float would overflow beyond 1e19 m.
    [[nodiscard]] double half_area() const noexcept {
        double const x = static_cast<double>(hi[0]) - static_cast<double>(lo[0]);
        double const y = static_cast<double>(hi[1]) - static_cast<double>(lo[1]);
        double const z = static_cast<double>(hi[2]) - static_cast<double>(lo[2]);
        return x < 0.0 ? 0.0 : x * y + y * z + z * x;
    }
};

/// A triangle while it is sorted: its box, and its id in the mantissas of the unread lanes (floats in [1, 2): plain
/// id bits would be denormals, on which arithmetic is slow).
struct Ref {
    Float4 lo;
    Float4 hi;

    static constexpr std::uint32_t one = 0x3F80'0000U;
    static constexpr std::uint32_t mantissa = 0x007F'FFFFU;

    [[nodiscard]] std::uint32_t id() const noexcept {
        return (std::bit_cast<std::uint32_t>(lo[3]) & mantissa) | (std::bit_cast<std::uint32_t>(hi[3]) & mantissa) << 23U;
    }
    /// Halves are added, so that no finite box overflows.
    [[nodiscard]] Float4 center() const noexcept { return lo * Float4::all(0.5F) + hi * Float4::all(0.5F); }
};

[[nodiscard]] inline Ref make_ref(Triangle const& t, core::TriangleId id) noexcept {
    std::array<float, 4> lo{};
    std::array<float, 4> hi{};
    for (int axis = 0; axis < 3; ++axis) {
        auto const i = static_cast<std::size_t>(axis);
        lo[i] = std::min({t[0][axis], t[1][axis], t[2][axis]});
        hi[i] = std::max({t[0][axis], t[1][axis], t[2][axis]});
    }
    lo[3] = std::bit_cast<float>(Ref::one | (id.value & Ref::mantissa));
    hi[3] = std::bit_cast<float>(Ref::one | id.value >> 23U);
    return {Float4::load(lo.data()), Float4::load(hi.data())};
}

/// refs[begin, end) and their bounds.
struct Range {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    Box bounds;

    [[nodiscard]] std::uint32_t size() const noexcept { return end - begin; }
};

inline constexpr std::size_t bin_count = 16;

/// Maps centres to bins: floor((center - from) * scale) clamped to the last bin.
struct Binning {
    Float4 from;
    Float4 scale;

    [[nodiscard]] std::array<std::int32_t, 4> bins_of(Ref const& ref) const noexcept {
        Float4 const place = (ref.center() - from) * scale;
        // Clamped in float before the cast: huge boxes can give infinity here, and the unread lane anything.
        Float4 const last = Float4::all(static_cast<float>(bin_count - 1));
        Float4 const legal = select(place >= Float4::all(0.0F), min(place, last), Float4::all(0.0F));
        return std::bit_cast<std::array<std::int32_t, 4>>(math::convert<std::int32_t>(legal));
    }
};

[[nodiscard]] inline Binning make_binning(std::span<Ref const> refs) noexcept {
    Box centers;
    for (Ref const& ref : refs) {
        Float4 const c = ref.center();
        centers.grow(c, c);
    }
    std::array<float, 4> scale{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        float const extent = centers.hi[axis] - centers.lo[axis];
        float const wanted = static_cast<float>(bin_count) / extent;
        bool const legal = extent > 0.0F && wanted <= std::numeric_limits<float>::max() && wanted > 0.0F;
        scale[axis] = legal ? wanted : 0.0F;
    }
    return {centers.lo, Float4::load(scale.data())};
}

struct Split {
    std::size_t axis = 0;
    std::int32_t last_left = -1;  ///< Bins up to this one go left; none: no plane separates anything.
    double cost = std::numeric_limits<double>::infinity();
};

struct Bin {
    Box bounds;
    std::uint32_t count = 0;
};

using Bins = std::array<std::array<Bin, bin_count>, 3>;

/// A leaf costs whole blocks of four triangles.
[[nodiscard]] inline double blocks_for(std::uint32_t count) noexcept { return static_cast<double>((count + 3) / 4); }

[[nodiscard]] inline Split best_split(Bins const& bins) noexcept {
    Split best;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::array<double, bin_count> right_cost{};
        Bin right;
        for (std::size_t i = bin_count - 1; i > 0; --i) {
            right.bounds.grow(bins[axis][i].bounds.lo, bins[axis][i].bounds.hi);
            right.count += bins[axis][i].count;
            right_cost[i] = right.count == 0 ? std::numeric_limits<double>::infinity()
                                             : right.bounds.half_area() * blocks_for(right.count);
        }
        Bin left;
        for (std::size_t i = 0; i + 1 < bin_count; ++i) {
            left.bounds.grow(bins[axis][i].bounds.lo, bins[axis][i].bounds.hi);
            left.count += bins[axis][i].count;
            if (left.count == 0) continue;
            double const cost = left.bounds.half_area() * blocks_for(left.count) + right_cost[i + 1];
            if (cost < best.cost) best = {axis, static_cast<std::int32_t>(i), cost};
        }
    }
    return best;
}

[[nodiscard]] inline Box bounds_of(std::span<Ref const> refs) noexcept {
    Box box;
    for (Ref const& ref : refs) box.grow(ref.lo, ref.hi);
    return box;
}

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
