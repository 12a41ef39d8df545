#pragma once
// Trees: a tapering trunk with branches on it, and branches on those. Every branch is a closed pipe that starts inside its
// parent and ends in a point; nothing is placed at random that decides how many triangles there are.

#include "pcg32.hpp"
#include "solid.hpp"

#include <span>
#include <vector>

namespace gnomon::scene::detail {

/// The branches of one order; level 0 is the trunk.
struct BranchLevel {
    std::uint32_t count = 1;      ///< On each branch of the level before.
    std::uint32_t sides = 6;
    std::uint32_t segments = 4;
    double length = 0.6;          ///< Of the parent's length; of the tree's height for the trunk.
    double spread_turns = 0.14;   ///< The angle off the parent.
    double wobble = 0.12;         ///< How much a segment may turn aside.
    double rise = 0.1;            ///< How much a segment turns up; down where negative.
};

struct TreeShape {
    double height_m = 8.0;
    double radius_m = 0.2;        ///< Of the trunk at its foot.
    double bare_share = 0.25;     ///< This much of the trunk carries no branch.
    double crown = 0.45;          ///< How much shorter the topmost branches are than the lowest: 0 round, 1 a cone.
    std::span<BranchLevel const> levels;
};

/// A place on an outermost branch: where leaves can grow.
struct Twig {
    math::dvec3 at_m;
    math::dvec3 direction;
};

struct Tree {
    Solid bark;
    std::vector<Twig> twigs;  ///< `segments` on each branch of the last level.
};

/// Triangles of the bark, whatever the seed.
[[nodiscard]] std::uint64_t count_tree_triangles(TreeShape const& shape) noexcept;

/// A tree that stands on the origin, its foot a little below.
[[nodiscard]] Tree grow_tree(TreeShape const& shape, Pcg32& random);

}  // namespace gnomon::scene::detail
