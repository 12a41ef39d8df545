#pragma once
// One bit per child of a node that a region may touch: eight, four or one child at a time, with the same bits.

#include <gnomon/bvh/detail/fill.hpp>
#include <gnomon/bvh/detail/lanes_of.hpp>
#include <gnomon/bvh/region.hpp>
#include <gnomon/bvh/tree.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace gnomon::bvh::detail {

/// A region that only knows boxes, as a formula of one.
template <class S, Region R>
[[nodiscard, gnu::always_inline]] inline formula::Bool<S> asked(R const& region, formula::GnBox<S> const& box) noexcept {
    if constexpr (LaneRegion<R>) return region.touches(box);
    else return {region.may_touch(math::Aabb{static_cast<math::vec3>(box.lo), static_cast<math::vec3>(box.hi)})};
}

template <class S, ItemList Items, Region R>
[[nodiscard, gnu::always_inline]] inline formula::Bool<S> asked_item(R const& region, ItemOf<S, Items::fields> const& item) noexcept {
    formula::GnBox<S> const box = Items::template box<S>(item);
    formula::Bool<S> const touched = asked<S>(region, box) && !gn_is_empty(box);
    if constexpr (LaneRegion<R>) {
        if (!gn_any(touched)) return touched;
        return touched && region.touches_item(Items::template shape<S>(item));
    } else {
        return touched;
    }
}

/// Children of node `node` of `level` that `region` may touch; padding never is.
template <class S, ItemList Items, std::uint32_t W, Region R>
[[nodiscard, gnu::always_inline]] inline std::uint32_t touched_children(TreeView<Items, W> const& tree, R const& region,
                                                                        std::uint32_t level, std::uint32_t node) noexcept {
    std::size_t const first = std::size_t{node} * W;
    std::uint32_t mask = 0;
    if (level == 1) {
        for (std::size_t i = 0; i < W; i += lane_count<S>)
            mask |= bits_of(asked_item<S, Items>(region, load_item<S>(tree.items, first + i))) << i;
    } else {
        std::size_t const base = tree.layout.first[level - 1] + first;
        for (std::size_t i = 0; i < W; i += lane_count<S>) {
            ItemOf<S, 6> const b = load_item<S>(tree.nodes, base + i);
            mask |= bits_of(asked<S>(region, formula::GnBox<S>{{b[0], b[1], b[2]}, {b[3], b[4], b[5]}})) << i;
        }
    }
    std::size_t const left = tree.layout.count[level - 1] - first;
    return left >= 32 ? mask : mask & ((1U << left) - 1U);
}

#if GNOMON_BVH_AVX2
template <ItemList Items, std::uint32_t W, Region R>
[[gnu::target("avx2"), gnu::flatten]] std::uint32_t touched_children_avx2(TreeView<Items, W> const& tree, R const& region,
                                                                          std::uint32_t level, std::uint32_t node) noexcept {
    return touched_children<math::Lanes<float, 8>>(tree, region, level, node);
}
#endif

/// Picks the widest of them once for a whole query.
template <ItemList Items, std::uint32_t W, Region R>
struct ChildTests {
    TreeView<Items, W> tree;
    R const& region;
    bool wide = has_avx2();

    [[nodiscard]] std::uint32_t operator()(std::uint32_t level, std::uint32_t node) const noexcept {
        if constexpr (!LaneRegion<R>) return touched_children<float>(tree, region, level, node);
#if GNOMON_BVH_AVX2
        else if (wide) return touched_children_avx2(tree, region, level, node);
#endif
        else return touched_children<PlainLanes>(tree, region, level, node);
    }
};

template <ItemList Items, std::uint32_t W, Region R>
[[nodiscard]] ChildTests<Items, W, R> make_child_tests(TreeView<Items, W> const& tree, R const& region) noexcept {
    return {tree, region};
}

}  // namespace gnomon::bvh::detail
