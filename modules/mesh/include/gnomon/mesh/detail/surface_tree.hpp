#pragma once
// The nearest point of a surface: a binary tree of boxes over its triangles, halved at the median.

#include <gnomon/math/bounds.hpp>
#include <gnomon/math/scalar.hpp>
#include <gnomon/math/vec.hpp>
#include <gnomon/mesh/half_edges.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon::mesh::detail {

using Corners = std::array<math::dvec3, 3>;

/// The corners of triangle `t`; false where they do not exist or are not finite.
[[nodiscard]] inline bool corners_of(Triangles const& mesh, std::size_t t, Corners& out) noexcept {
    for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t const i = mesh.indices[3 * t + k];
        if (i >= mesh.positions.size() || !math::is_finite(mesh.positions[i])) return false;
        out[k] = math::to_double(mesh.positions[i]);
    }
    return true;
}

[[nodiscard]] inline double dot(math::dvec3 const& a, math::dvec3 const& b) noexcept {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Squared distance of `p` to the segment from `a` by `ab`; a point if `ab` is zero.
[[nodiscard]] inline double segment_distance_sq(math::dvec3 const& p, math::dvec3 const& a, math::dvec3 const& ab) noexcept {
    double const length_sq = dot(ab, ab);
    double const t = length_sq > 0.0 ? std::clamp(dot(p - a, ab) / length_sq, 0.0, 1.0) : 0.0;
    math::dvec3 const off = p - a - ab * t;
    return dot(off, off);
}

/// Squared distance of `p` to a triangle: to its plane if the foot lies inside, else to the nearest edge.
[[nodiscard]] inline double triangle_distance_sq(math::dvec3 const& p, Corners const& t) noexcept {
    math::dvec3 const ab = t[1] - t[0];
    math::dvec3 const bc = t[2] - t[1];
    math::dvec3 const ca = t[0] - t[2];
    auto const cross = [](math::dvec3 const& a, math::dvec3 const& b) noexcept {
        return math::dvec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    };
    math::dvec3 const normal = cross(ab, t[2] - t[0]);
    double const area_sq = dot(normal, normal);
    if (area_sq > 0.0 && dot(cross(ab, p - t[0]), normal) >= 0.0 && dot(cross(bc, p - t[1]), normal) >= 0.0 &&
        dot(cross(ca, p - t[2]), normal) >= 0.0) {
        double const height = dot(p - t[0], normal);
        return height * height / area_sq;
    }
    return std::min({segment_distance_sq(p, t[0], ab), segment_distance_sq(p, t[1], bc), segment_distance_sq(p, t[2], ca)});
}

struct Nearest {
    double distance_sq = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = no_index;
};

/// Holds copies of the corners: the mesh may go away. Triangles that are not finite are left out.
class SurfaceTree {
public:
    explicit SurfaceTree(Triangles const& mesh) {
        Corners corners{};
        for (std::size_t t = 0; t < mesh.size(); ++t)
            if (corners_of(mesh, t, corners)) triangles_.push_back(corners);
        if (!triangles_.empty()) build(0, triangles_.size());
    }

    [[nodiscard]] bool empty() const noexcept { return triangles_.empty(); }
    [[nodiscard]] Corners const& triangle(std::uint32_t i) const noexcept { return triangles_[i]; }

    /// The triangle nearest to `p`; `guess` (an index, or none) makes it faster. Infinitely far if there is none.
    [[nodiscard]] Nearest nearest(math::dvec3 const& p, std::uint32_t guess) const noexcept {
        Nearest best;
        if (guess < triangles_.size()) best = {triangle_distance_sq(p, triangles_[guess]), guess};
        if (!triangles_.empty()) descend(0, p, best);
        return best;
    }

private:
    struct Node {
        math::dvec3 lo;
        math::dvec3 hi;
        std::uint32_t first = 0;  ///< Of its triangles, if `count` is not 0; else its right child. The left one is the next node.
        std::uint32_t count = 0;

        [[nodiscard]] double distance_sq(math::dvec3 const& p) const noexcept {
            double sum = 0.0;
            for (math::axis_t axis = 0; axis < 3; ++axis) {
                double const off = std::max({lo[axis] - p[axis], p[axis] - hi[axis], 0.0});
                sum += off * off;
            }
            return sum;
        }
    };

    std::uint32_t build(std::size_t begin, std::size_t end) {
        auto const index = static_cast<std::uint32_t>(nodes_.size());
        Node node;
        node.lo = node.hi = triangles_[begin][0];
        for (std::size_t i = begin; i < end; ++i)
            for (math::dvec3 const& p : triangles_[i]) {
                node.lo = glm::min(node.lo, p);
                node.hi = glm::max(node.hi, p);
            }
        node.first = static_cast<std::uint32_t>(begin);
        node.count = end - begin <= 4 ? static_cast<std::uint32_t>(end - begin) : 0U;
        nodes_.push_back(node);
        if (node.count != 0) return index;
        math::dvec3 const size = node.hi - node.lo;
        math::axis_t const axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        auto const middle = [axis](Corners const& t) noexcept { return t[0][axis] + t[1][axis] + t[2][axis]; };
        std::size_t const half = begin + (end - begin) / 2;
        auto const at = [this](std::size_t i) { return triangles_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(begin), at(half), at(end), [&](Corners const& a, Corners const& b) { return middle(a) < middle(b); });
        build(begin, half);
        std::uint32_t const right = build(half, end);
        nodes_[index].first = right;
        return index;
    }

    void descend(std::uint32_t index, math::dvec3 const& p, Nearest& best) const noexcept {
        Node const& node = nodes_[index];
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            double const d = triangle_distance_sq(p, triangles_[i]);
            if (d < best.distance_sq) best = {d, i};
        }
        if (node.count != 0) return;
        double const left = nodes_[index + 1].distance_sq(p);
        double const right = nodes_[node.first].distance_sq(p);
        bool const left_first = left <= right;
        if (std::min(left, right) < best.distance_sq) descend(left_first ? index + 1 : node.first, p, best);
        if (std::max(left, right) < best.distance_sq) descend(left_first ? node.first : index + 1, p, best);
    }

    std::vector<Corners> triangles_;
    std::vector<Node> nodes_;
};

}  // namespace gnomon::mesh::detail
