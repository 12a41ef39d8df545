#pragma once
// The triangles in the order of their groups, and in each group along the Morton curve.

#include <gnomon/batch/batches.hpp>
#include <gnomon/batch/detail/box_tree.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/math/morton.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace gnomon::batch::detail {

/// A triangle's place in the order. The index breaks ties, so that no two are equal.
struct Key {
    std::uint64_t code = 0;
    std::uint32_t group = 0;
    std::uint32_t triangle = 0;

    friend bool operator<(Key const& a, Key const& b) noexcept {
        return std::tie(a.group, a.code, a.triangle) < std::tie(b.group, b.code, b.triangle);
    }
};

/// keys[begin, end) are of one group; its tree's blocks start at `first_block`.
struct Slice {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::size_t first_block = 0;
    std::uint32_t group = 0;
};

[[nodiscard]] inline math::vec3 center_of(Triangles const& list, Key const& key) noexcept {
    math::Aabb box;
    static_cast<void>(bounds_of_triangle(list, key.triangle, box));
    return math::center(box);
}

/// The box that the curve fills: around most centres with four times their extent to spare, cut to `bounds` of all. A few
/// triangles far away do not coarsen the order of the others.
[[nodiscard]] inline math::Aabb curve_box(Triangles const& list, std::vector<Key> const& keys, math::Aabb const& bounds) noexcept {
    std::array<float, 1024> sample{};
    std::size_t const count = std::min(keys.size(), sample.size());
    if (count == 0) return bounds;
    math::Aabb most;
    float spare = 0.0F;
    for (math::axis_t axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < count; ++i) sample[i] = center_of(list, keys[i * keys.size() / count])[axis];
        auto const rank = [&](std::size_t i) {
            std::nth_element(sample.begin(), sample.begin() + i, sample.begin() + count);
            return sample[i];
        };
        most.lo[axis] = rank(count / 16);
        most.hi[axis] = rank(count - 1 - count / 16);
        spare = std::max(spare, 4.0F * (most.hi[axis] - most.lo[axis]));
    }
    if (spare == 0.0F) return bounds;
    return {glm::max(bounds.lo, most.lo - spare), glm::min(bounds.hi, most.hi + spare)};
}

/// Keys of the triangles that are kept, sorted; counts the others.
template <core::Executor E>
LeftOut collect(Triangles const& list, std::vector<Key>& keys, E& executor) {
    LeftOut left_out;
    math::Aabb bounds;  // of the centres
    keys.clear();
    keys.reserve(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        math::Aabb own;
        Fate const fate = bounds_of_triangle(list, i, own);
        left_out.bad_index += fate == Fate::bad_index ? 1U : 0U;
        left_out.not_finite += fate == Fate::not_finite ? 1U : 0U;
        if (fate != Fate::kept) continue;
        keys.push_back({0, list.group(i), static_cast<std::uint32_t>(i)});
        bounds = math::extended(bounds, math::center(own));
    }
    math::Aabb const box = curve_box(list, keys, bounds);
    executor.parallel_for(keys.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) keys[i].code = math::morton_63(box, center_of(list, keys[i]));
    });
    std::sort(keys.begin(), keys.end());
    return left_out;
}

/// One slice per group; returns the blocks that all their trees take.
inline std::size_t slice_groups(std::vector<Key> const& keys, std::vector<Slice>& slices) {
    slices.clear();
    std::size_t blocks = 0;
    for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
        while (end < keys.size() && keys[end].group == keys[begin].group) ++end;
        slices.push_back({begin, end, blocks, keys[begin].group});
        blocks += BoxTree::block_count(end - begin);
    }
    return blocks;
}

}  // namespace gnomon::batch::detail
