#pragma once
// A tree over the boxes of clusters that answers: with which cluster does this one make the smallest box?
//
// Implicit and eight wide: slot i of level 0 stands in block i / 8, which is slot i / 8 of level 1, and so on. Clusters
// are merged into the lower of their slots. Boxes are held at half size, so that no extent of finite ones
// overflows; an empty slot has lo = +infinity and hi = -infinity.

#include <gnomon/math/bounds.hpp>
#include <gnomon/math/lanes.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace gnomon::batch::detail {

inline constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
inline constexpr std::size_t width = 8;

/// Halving rounds denormals only, and keeps the order.
[[nodiscard]] inline math::Aabb halved(math::Aabb const& box) noexcept { return {box.lo * 0.5F, box.hi * 0.5F}; }

/// The dissimilarity: a quarter of the squared diagonal of the box. Extents are rounded to float once, so their squares
/// are exact in double, and a fused multiply-add changes nothing. It never falls when the box grows.
[[nodiscard]] inline double diagonal_sq(math::Aabb const& half) noexcept {
    auto const x = static_cast<double>(half.hi.x - half.lo.x);
    auto const y = static_cast<double>(half.hi.y - half.lo.y);
    auto const z = static_cast<double>(half.hi.z - half.lo.z);
    return (x * x + y * y) + z * z;
}

/// Eight boxes, axis by axis.
struct alignas(64) Block {
    float lo[3][width];
    float hi[3][width];

    void set(std::size_t lane, math::Aabb const& box) noexcept {
        for (math::axis_t axis = 0; axis < 3; ++axis) {
            lo[axis][lane] = box.lo[axis];
            hi[axis][lane] = box.hi[axis];
        }
    }
    [[nodiscard]] math::Aabb get(std::size_t lane) const noexcept {
        return {math::vec3(lo[0][lane], lo[1][lane], lo[2][lane]), math::vec3(hi[0][lane], hi[1][lane], hi[2][lane])};
    }
    [[nodiscard]] math::Aabb bounds() const noexcept {
        math::Aabb box;
        for (std::size_t lane = 0; lane < width; ++lane) box = math::merged(box, get(lane));
        return box;
    }
};

/// The best partner so far. Equal distances go to the lower slot.
struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t slot = none;

    [[nodiscard]] bool loses_to(double other, std::uint32_t other_slot) const noexcept {
        return other < distance || (other == distance && other_slot < slot);
    }
};

/// The distances to a block's eight boxes, and a bit for each that is at most some limit.
struct Distances {
    std::array<double, width> to;
    std::uint32_t near;
};

/// The same number in every lane, by way of memory: GCC 12 takes `Lanes::all` for uninitialized where this is inlined.
template <math::Lane T>
[[nodiscard]] inline math::Lanes<T, 4> splat(T x) noexcept {
    std::array<T, 4> const copies{x, x, x, x};
    return math::Lanes<T, 4>::load(copies.data());
}

/// Level 0: `diagonal_sq` of the box around `box` and each of the block's; above: no more than that of any box below.
/// Empty slots are infinitely far.
template <bool Leaf>
[[nodiscard]] inline Distances distances(Block const& block, math::Aabb const& box, double limit) noexcept {
    using Float4 = math::Lanes<float, 4>;
    using Double4 = math::Lanes<double, 4>;
    Distances out;
    out.near = 0;
    for (std::size_t i = 0; i < width; i += 4) {
        Double4 sum = splat(0.0);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            auto const a = static_cast<math::axis_t>(axis);
            Float4 const lo = Float4::load(block.lo[axis] + i);
            Float4 const hi = Float4::load(block.hi[axis] + i);
            // A box of the subtree holds some point of its bounds, no more is known. `lo` makes empty slots infinite.
            Float4 const top = max(max(splat(box.hi[a]), lo), Leaf ? hi : lo);
            Float4 const bottom = min(splat(box.lo[a]), Leaf ? lo : hi);
            Double4 const extent = math::convert<double>(top - bottom);
            sum = sum + extent * extent;
        }
        sum.store(out.to.data() + i);
        out.near |= bits(sum <= splat(limit)) << i;
    }
    return out;
}

/// A view of the blocks of one group.
class BoxTree {
public:
    /// Blocks that a tree over `slots` slots takes.
    [[nodiscard]] static constexpr std::size_t block_count(std::size_t slots) noexcept {
        std::size_t count = 0;
        for (std::size_t n = slots; count == 0 || n > 1; count += n) n = (n + width - 1) / width;
        return count;
    }

    /// expects: `blocks` holds `block_count(slots)` blocks, those of level 0 set up and empty behind the last slot.
    BoxTree(std::span<Block> blocks, std::size_t slots) noexcept : blocks_(blocks) {
        std::size_t first = 0;
        std::size_t n = slots;
        do {
            n = (n + width - 1) / width;
            first_[levels_++] = first;
            first += n;
        } while (n > 1);
        for (std::size_t level = 1; level < levels_; ++level) fill(level);
    }

    [[nodiscard]] math::Aabb box(std::uint32_t slot) const noexcept { return blocks_[slot / width].get(slot % width); }

    /// Gives the cluster in `slot` a larger box. The blocks above stay: they hold some of its points still, and that is all
    /// that a search takes from them; grown boxes would tell it less.
    void grow(std::uint32_t slot, math::Aabb const& box) noexcept { blocks_[slot / width].set(slot % width, box); }

    /// Takes the cluster out of `slot`, and blocks without any out of those above.
    void remove(std::uint32_t slot) noexcept {
        std::size_t at = slot;
        for (std::size_t level = 0; level < levels_; ++level) {
            Block& block = blocks_[first_[level] + at / width];
            block.set(at % width, math::Aabb{});
            if (!math::is_empty(block.bounds())) return;
            at /= width;
        }
    }

    /// The slot whose cluster makes the smallest box with that of `slot`, if it beats `best`; else `best`.
    ///
    /// `visits` counts blocks; beyond `max_visits` the best slot so far is returned.
    [[nodiscard]] Nearest nearest(std::uint32_t slot, Nearest best, std::uint32_t max_visits, std::uint32_t& visits) const noexcept {
        Search search{box(slot), best, max_visits, 0};
        scan_leaf(search, slot / width, slot % width);
        // Upwards: the neighbours on the curve come first, so that far subtrees are seldom entered.
        std::size_t at = slot / width;
        for (std::size_t level = 1; level < levels_; ++level) {
            scan_inner(search, level, at / width, at % width);
            at /= width;
        }
        visits = search.visits;
        return search.best;
    }

private:
    struct Search {
        math::Aabb box;
        Nearest best;
        std::uint32_t max_visits;
        std::uint32_t visits;

        [[nodiscard]] double limit() const noexcept { return std::min(best.distance, std::numeric_limits<double>::max()); }
        [[nodiscard]] bool is_over() const noexcept { return visits >= max_visits && best.slot != none; }
    };

    void fill(std::size_t level) noexcept {
        std::size_t const below = first_[level] - first_[level - 1];
        for (std::size_t i = 0; i < (below + width - 1) / width * width; ++i)
            blocks_[first_[level] + i / width].set(i % width, i < below ? blocks_[first_[level - 1] + i].bounds() : math::Aabb{});
    }

    void scan_leaf(Search& search, std::size_t index, std::size_t skip) const noexcept {
        ++search.visits;
        Distances const d = distances<true>(blocks_[index], search.box, search.limit());
        for (std::uint32_t left = d.near & ~(1U << skip); left != 0; left &= left - 1U) {
            auto const lane = static_cast<std::size_t>(std::countr_zero(left));
            auto const slot = static_cast<std::uint32_t>(index * width + lane);
            if (search.best.loses_to(d.to[lane], slot)) search.best = {d.to[lane], slot};
        }
    }

    /// Enters the children of a block, nearest first, `skip` not at all.
    void scan_inner(Search& search, std::size_t level, std::size_t index, std::size_t skip) const noexcept {
        ++search.visits;
        Distances const d = distances<false>(blocks_[first_[level] + index], search.box, search.limit());
        std::uint32_t left = d.near & ~(1U << skip);
        while (left != 0 && !search.is_over()) {
            auto lane = static_cast<std::size_t>(std::countr_zero(left));
            for (std::uint32_t more = left & (left - 1U); more != 0; more &= more - 1U) {
                auto const other = static_cast<std::size_t>(std::countr_zero(more));
                if (d.to[other] < d.to[lane]) lane = other;
            }
            if (d.to[lane] > search.best.distance) return;
            left &= ~(1U << lane);
            std::size_t const child = index * width + lane;
            if (!search.best.loses_to(d.to[lane], static_cast<std::uint32_t>(child << 3U * level))) continue;
            if (level == 1) scan_leaf(search, child, width);
            else scan_inner(search, level - 1, child, width);
        }
    }

    std::span<Block> blocks_;
    std::array<std::size_t, 12> first_{};
    std::size_t levels_ = 0;
};

}  // namespace gnomon::batch::detail
