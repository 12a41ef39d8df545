#pragma once
// Asks the hierarchy: is a segment blocked, and by what first?

#include <gnomon/core/contract.hpp>
#include <gnomon/trace/bvh.hpp>
#include <gnomon/trace/detail/block_test.hpp>
#include <gnomon/trace/detail/slabs.hpp>
#include <gnomon/trace/segment.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace gnomon::trace {

/// How much work queries did. Sums, so the order of queries does not matter.
struct Counts {
    std::uint64_t nodes = 0;
    std::uint64_t blocks = 0;
    std::uint64_t exact = 0;  ///< Triangles that the filter could not decide.

    Counts& operator+=(Counts const& other) noexcept {
        nodes += other.nodes;
        blocks += other.blocks;
        exact += other.exact;
        return *this;
    }
    friend bool operator==(Counts const&, Counts const&) noexcept = default;
};

/// Where a segment passes a triangle. Computed in double; for measures and textures, not for decisions of visibility.
struct Crossing {
    core::TriangleId triangle;
    double t = 0.0;        ///< Of the segment's length (lamp), or in lengths of the direction (sun).
    math::dvec3 weights;   ///< Of the three corners: in [0, 1], sum 1 up to rounding.
};

/// Decides at a crossing whether the triangle is solid there.
template <class F>
concept Opacity = requires(F const& f, Crossing const& crossing) {
    { f(crossing) } -> std::convertible_to<bool>;
};

/// Everything is solid.
struct Solid {
    constexpr bool operator()(Crossing const&) const noexcept { return true; }
};

/// Where `s` passes `t`, in double.
///
/// expects: `blocks(t, s)`.
[[nodiscard]] inline Crossing crossing_of(core::TriangleId id, Triangle const& t, Segment const& s) noexcept {
    math::dvec3 const start = math::to_double(s.start);
    math::dvec3 const extent = s.end.at_infinity ? math::to_double(s.end.xyz) : math::to_double(s.end.xyz) - start;
    math::dvec3 const a = math::to_double(t[0]) - start;
    math::dvec3 const b = math::to_double(t[1]) - start;
    math::dvec3 const c = math::to_double(t[2]) - start;
    math::dvec3 const sides(glm::dot(extent, glm::cross(b, c)), glm::dot(extent, glm::cross(c, a)),
                            glm::dot(extent, glm::cross(a, b)));
    double const total = sides.x + sides.y + sides.z;
    // The exact total is not 0, but a sliver's rounded one can be.
    if (total == 0.0) return {id, 0.0, math::dvec3(1.0 / 3.0)};
    auto const clamped = [](double x) noexcept { return x > 0.0 ? (x < 1.0 ? x : 1.0) : 0.0; };
    double const t_end = s.end.at_infinity ? std::numeric_limits<double>::max() : 1.0;
    double const t_plane = glm::dot(a, glm::cross(b, c)) / total;
    return {id, t_plane > 0.0 ? std::min(t_plane, t_end) : 0.0,
            math::dvec3(clamped(sides.x / total), clamped(sides.y / total), clamped(sides.z / total))};
}

namespace detail {

[[nodiscard]] GNOMON_PREDICATES_OUT_OF_LINE inline bool blocks_exactly(Block const& block, std::size_t lane,
                                                                       Segment const& s) noexcept {
    return blocks(block.triangle(lane), s);
}

/// What is looked for. Subtrees that lie wholly beyond t = `limit` are passed over; a visitor may lower it.
struct Search {
    Segment segment;
    core::TriangleId own;
    double limit = std::numeric_limits<double>::infinity();
};

/// Calls `visit(block, lane)` for each triangle that blocks the segment, but for the own one; stops when it returns true.
template <class Visit>
void for_each_blocker(BvhView bvh, Search const& search, Counts& counts, Visit&& visit) {
    Segment const& s = search.segment;
    if (bvh.nodes.empty() || !is_valid(s)) return;
    struct Entry {
        Child child;
        double near;
    };
    // Each level leaves at most three siblings behind.
    std::array<Entry, (width - 1) * max_depth + width> stack;
    std::size_t size = 0;
    stack[size++] = {Child::node(0), 0.0};
    Slabs const slabs = make_slabs(s);
    SegmentLanes const lanes = make_lanes(s);
    while (size != 0) {
        Entry const entry = stack[--size];
        if (entry.near > search.limit) continue;
        if (!entry.child.is_block()) {
            Node const& node = bvh.nodes[entry.child.index()];
            ++counts.nodes;
            double near[width];
            for (std::uint32_t touched = may_touch(slabs, node, near); touched != 0; touched &= touched - 1) {
                auto const i = static_cast<std::size_t>(std::countr_zero(touched));
                stack[size++] = {node.child[i], near[i]};
            }
            continue;
        }
        Block const& block = bvh.blocks[entry.child.index()];
        ++counts.blocks;
        Verdict const verdict = test_block(lanes, block);
        for (std::uint32_t met = verdict.blocked | verdict.unsure; met != 0; met &= met - 1) {
            auto const lane = static_cast<std::size_t>(std::countr_zero(met));
            if (block.id[lane].is_none() || block.id[lane] == search.own) continue;
            if ((verdict.unsure >> lane & 1U) != 0) {
                ++counts.exact;
                if (!blocks_exactly(block, lane, s)) continue;
            }
            if (visit(block, lane)) return;
        }
    }
}

/// Where the box of a block's triangle lets t be: computed as for the nodes above it, so it lies in theirs.
[[nodiscard]] inline double clamp_to_box(double t, Slabs const& slabs, Triangle const& triangle) noexcept {
    float lo[3][width];
    float hi[3][width];
    for (int axis = 0; axis < 3; ++axis) {
        std::fill_n(lo[axis], width, std::min({triangle[0][axis], triangle[1][axis], triangle[2][axis]}));
        std::fill_n(hi[axis], width, std::max({triangle[0][axis], triangle[1][axis], triangle[2][axis]}));
    }
    Interval const box = intersect(slabs, lo, hi, 0);
    return std::max(std::min(t, box.far[0]), box.near[0]);
}

}  // namespace detail

/// Whether anything but `own` blocks `s`, in exact arithmetic.
///
/// expects: `bvh` passes `validate`.
/// returns: false for NaN, infinities and a zero direction in `s` (see `is_valid`), and for an empty hierarchy.
/// cost:    O(visited nodes). Never allocates, never fails.
template <Opacity F = Solid>
[[nodiscard]] bool is_blocked(BvhView bvh, Segment const& s, core::TriangleId own, Counts& counts,
                              F const& opacity = {}) {
    bool found = false;
    detail::for_each_blocker(bvh, {s, own}, counts, [&](Block const& block, std::size_t lane) {
        if constexpr (std::same_as<F, Solid>) {
            found = true;
        } else {
            found = opacity(crossing_of(block.id[lane], block.triangle(lane), s));
        }
        return found;
    });
    return found;
}

template <Opacity F = Solid>
[[nodiscard]] bool is_blocked(BvhView bvh, Segment const& s, core::TriangleId own = {}, F const& opacity = {}) {
    Counts counts;
    return is_blocked(bvh, s, own, counts, opacity);
}

/// The blocker that `s` meets first: smallest t (in double), then smallest id. There is one exactly if `is_blocked`.
///
/// returns: the same for any shape of the hierarchy: t is clamped to the triangle's own box, computed as the nodes'
///          boxes are, and rounding is monotone, so a subtree that is passed over cannot hold a smaller one.
template <Opacity F = Solid>
[[nodiscard]] std::optional<Crossing> nearest_blocker(BvhView bvh, Segment const& s, core::TriangleId own,
                                                      Counts& counts, F const& opacity = {}) {
    std::optional<Crossing> nearest;
    if (!is_valid(s)) return nearest;
    detail::Slabs const slabs = detail::make_slabs(s);
    detail::Search search{s, own};
    detail::for_each_blocker(bvh, search, counts, [&](Block const& block, std::size_t lane) {
        Crossing crossing = crossing_of(block.id[lane], block.triangle(lane), s);
        crossing.t = detail::clamp_to_box(crossing.t, slabs, block.triangle(lane));
        bool const nearer = crossing.t < search.limit || (crossing.t == search.limit && nearest && crossing.triangle < nearest->triangle);
        if (nearer && opacity(crossing)) {
            search.limit = crossing.t;
            nearest = crossing;
        }
        return false;
    });
    return nearest;
}

template <Opacity F = Solid>
[[nodiscard]] std::optional<Crossing> nearest_blocker(BvhView bvh, Segment const& s, core::TriangleId own = {},
                                                      F const& opacity = {}) {
    Counts counts;
    return nearest_blocker(bvh, s, own, counts, opacity);
}

}  // namespace gnomon::trace
