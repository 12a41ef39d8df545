#pragma once
// The triangles in the order of their groups, and in each group along the Morton curve.

#include <gnomon/batch/batches.hpp>
#include <gnomon/batch/detail/box_tree.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/math/morton.hpp>

#include <algorithm>
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

/// Keys of the triangles that are kept, sorted; counts the others.
template <core::Executor E>
LeftOut collect(Triangles const& list, std::vector<Key>& keys, E& executor) {
    LeftOut left_out;
    math::Aabb bounds;  // of the centres: a few huge triangles do not coarsen the grid
    keys.clear();
    keys.reserve(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        math::Aabb box;
        Fate const fate = bounds_of_triangle(list, i, box);
        left_out.bad_index += fate == Fate::bad_index ? 1U : 0U;
        left_out.not_finite += fate == Fate::not_finite ? 1U : 0U;
        if (fate != Fate::kept) continue;
        keys.push_back({0, list.group(i), static_cast<std::uint32_t>(i)});
        bounds = math::extended(bounds, math::center(box));
    }
    executor.parallel_for(keys.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            math::Aabb box;
            static_cast<void>(bounds_of_triangle(list, keys[i].triangle, box));
            keys[i].code = math::morton_63(bounds, math::center(box));
        }
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
