#pragma once
// Builds the hierarchy: binned surface area heuristic, from the top, four children at a time.
//
// source:  I. Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007 (binning); wide nodes by
//          splitting the largest child until there are four, as Embree does.

#include <gnomon/core/contract.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/predicates/orient.hpp>
#include <gnomon/predicates/triangle_list.hpp>
#include <gnomon/trace/bvh.hpp>
#include <gnomon/trace/detail/builder.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::trace {

/// The three points lie on one line: exactly when all three projections do.
[[nodiscard]] inline bool is_zero_area(Triangle const& t) noexcept {
    using predicates::orient2d;
    using predicates::Sign;
    auto const flat = [&](int i, int j) noexcept {
        return orient2d(math::vec2(t[0][i], t[0][j]), math::vec2(t[1][i], t[1][j]), math::vec2(t[2][i], t[2][j])) ==
               Sign::zero;
    };
    return flat(0, 1) && flat(1, 2) && flat(2, 0);
}

namespace detail {

enum class Fate : std::uint8_t { kept, bad_index, not_finite, zero_area };

[[nodiscard]] inline Fate fate_of(predicates::TriangleList const& list, core::TriangleId id) noexcept {
    math::uvec3 const& at = list.corners[id.index()];
    std::size_t const n = list.positions.size();
    if (at.x >= n || at.y >= n || at.z >= n) return Fate::bad_index;
    if (!is_usable(list, id)) return Fate::not_finite;
    return is_zero_area(list[id]) ? Fate::zero_area : Fate::kept;
}

/// References to all triangles that can block, in the list's order; counts the others.
template <core::Executor E>
[[nodiscard]] std::vector<Ref> collect(predicates::TriangleList const& list, LeftOut& left_out, E& executor) {
    std::vector<Ref> refs(list.size());
    std::vector<Fate> fates(list.size());
    executor.parallel_for(list.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            core::TriangleId const id(static_cast<std::uint32_t>(i));
            fates[i] = fate_of(list, id);
            if (fates[i] == Fate::kept) refs[i] = make_ref(list[id], id);
        }
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < refs.size(); ++i) {
        left_out.bad_index += fates[i] == Fate::bad_index ? 1U : 0U;
        left_out.not_finite += fates[i] == Fate::not_finite ? 1U : 0U;
        left_out.zero_area += fates[i] == Fate::zero_area ? 1U : 0U;
        if (fates[i] == Fate::kept) refs[kept++] = refs[i];
    }
    refs.resize(kept);
    return refs;
}

}  // namespace detail

/// Builds the hierarchy over all triangles that can block anything.
///
/// returns: the same hierarchy for any executor. Triangles with bad indices, NaN, infinities or no area are left out
///          and counted. Finite coordinates of any size are legal; identical triangles too.
/// expects: fewer than 2^30 triangles.
/// cost:    O(n log n), 32 bytes of scratch a triangle; depth at most `max_depth` whatever the input.
template <core::Executor E>
[[nodiscard]] Bvh build_bvh(predicates::TriangleList const& list, E& executor) {
    GNOMON_EXPECT(list.size() < (std::size_t{1} << 30U));
    Bvh bvh;
    std::vector<detail::Ref> refs = detail::collect(list, bvh.left_out, executor);
    bvh.triangles = refs.size();
    if (refs.empty()) return bvh;

    // The top is built by one thread down to subtrees of this size, which do not know each other.
    std::size_t const subtree_size = std::max<std::size_t>(refs.size() / 64, 1024);
    detail::Builder top(refs, list, subtree_size);
    top.build_all();
    std::vector<detail::Builder> parts(top.postponed.size(), detail::Builder(refs, list, 0));
    executor.parallel_for(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) parts[i].build(top.postponed[i].range, top.postponed[i].depth);
    });
    detail::stitch(top, parts, bvh);
    return bvh;
}

[[nodiscard]] inline Bvh build_bvh(predicates::TriangleList const& list) {
    core::SerialExecutor const serial;
    return build_bvh(list, serial);
}

}  // namespace gnomon::trace
