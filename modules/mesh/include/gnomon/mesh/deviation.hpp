#pragma once
// How far two surfaces are apart: the Hausdorff distance, measured between two bounds that both hold.
//
// The farthest that any point of one surface is from the other is searched for by cutting triangles in four. A piece's
// bound from above: distance to one triangle of the other surface is convex, so it is largest at a corner; and no point is
// farther than the piece's centre is, by more than the piece's radius. Pieces that cannot be worse than what is known are
// dropped, so flat regions cost one look.
//
// source:  M. Guthe, P. Borodin, R. Klein, "Fast and accurate Hausdorff distance calculation between meshes", 2005 (bounds)

#include <gnomon/core/contract.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/mesh/detail/surface_tree.hpp>
#include <gnomon/mesh/half_edges.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace gnomon::mesh {

struct DeviationConfig {
    double relative = 0.05;                   ///< The bounds are at most this part of the lower one apart ...
    double absolute_m = 1e-6;                 ///< ... or this far, whichever is more.
    std::uint64_t max_queries = 20'000'000;   ///< Beyond this the upper bound is what it is then.
};

/// In metres, right to the rounding of doubles.
struct Deviation {
    double at_least_m = 0.0;  ///< Some point of the one surface is this far from the other.
    double at_most_m = 0.0;   ///< No point is farther.
    std::uint64_t queries = 0;
};

namespace detail {

class DeviationSearch {
public:
    DeviationSearch(SurfaceTree const& to, DeviationConfig const& config) : to_(&to), config_(config) {}

    void look_at(Triangles const& from) {
        Corners corners{};
        std::uint32_t guess = no_index;
        for (std::size_t t = 0; t < from.size(); ++t) {  // corners first: mostly they are the farthest
            if (!corners_of(from, t, corners)) continue;
            for (math::dvec3 const& p : corners) guess = note(p, guess).triangle;
        }
        for (std::size_t t = 0; t < from.size(); ++t)
            if (corners_of(from, t, corners)) search({corners, no_index});
    }

    [[nodiscard]] Deviation result() const noexcept {
        return {lower_, std::max(lower_, upper_), queries_};
    }

private:
    struct Piece {
        Corners corners{};
        std::uint32_t guess;
    };

    Nearest note(math::dvec3 const& p, std::uint32_t guess) {
        ++queries_;
        Nearest const found = to_->nearest(p, guess);
        lower_ = std::max(lower_, std::sqrt(found.distance_sq));
        return found;
    }

    void search(Piece const& whole) {
        stack_.assign(1, whole);
        while (!stack_.empty()) {
            Piece const piece = stack_.back();
            stack_.pop_back();
            Corners const& c = piece.corners;
            math::dvec3 const center = (c[0] + c[1] + c[2]) / 3.0;
            Nearest const found = note(center, piece.guess);
            double radius_sq = 0.0;
            double corner_sq = 0.0;
            for (math::dvec3 const& p : c) {
                radius_sq = std::max(radius_sq, dot(p - center, p - center));
                corner_sq = std::max(corner_sq, triangle_distance_sq(p, to_->triangle(found.triangle)));
            }
            double const bound = std::min(std::sqrt(found.distance_sq) + std::sqrt(radius_sq), std::sqrt(corner_sq));
            bool const good = bound <= lower_ + std::max(config_.absolute_m, config_.relative * lower_);
            if (good || queries_ >= config_.max_queries) {
                upper_ = std::max(upper_, bound);
                continue;
            }
            math::dvec3 const ab = (c[0] + c[1]) * 0.5;
            math::dvec3 const bc = (c[1] + c[2]) * 0.5;
            math::dvec3 const ca = (c[2] + c[0]) * 0.5;
            for (Corners const& part : {Corners{c[0], ab, ca}, Corners{ab, c[1], bc}, Corners{ca, bc, c[2]}, Corners{ab, bc, ca}})
                stack_.push_back({part, found.triangle});
        }
    }

    SurfaceTree const* to_;
    DeviationConfig config_;
    std::vector<Piece> stack_;
    double lower_ = 0.0;
    double upper_ = 0.0;
    std::uint64_t queries_ = 0;
};

}  // namespace detail

/// Bounds of the farthest distance that a point of `from` has to the surface `to` (one-sided: swap them for the other).
///
/// expects: `config.relative` or `config.absolute_m` above 0.
/// returns: 0 if `from` has no finite triangle, infinity if only `to` has none. Triangles that are not finite do not count.
/// cost:    O((n + pieces) log m), allocates a tree over `to`.
[[nodiscard]] inline Deviation deviation(Triangles const& from, Triangles const& to, DeviationConfig const& config = {}) {
    GNOMON_EXPECT(config.relative > 0.0 || config.absolute_m > 0.0);
    detail::SurfaceTree const tree(to);
    if (tree.empty()) {
        double const far = detail::SurfaceTree(from).empty() ? 0.0 : std::numeric_limits<double>::infinity();
        return {far, far, 0};
    }
    detail::DeviationSearch search(tree, config);
    search.look_at(from);
    return search.result();
}

}  // namespace gnomon::mesh
