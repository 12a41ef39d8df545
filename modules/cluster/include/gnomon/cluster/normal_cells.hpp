#pragma once
// Directions quantized by cube face and an n x n grid on each, and the cone that bounds all directions of a cell.
//
// source: [Olsson 2014, Paper II, 3.1, figure 4]

#include <gnomon/cluster/formula/key.glsl>
#include <gnomon/core/contract.hpp>
#include <gnomon/math/scalar.hpp>
#include <gnomon/math/vec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::cluster {

/// All directions whose angle to `axis` has a cosine of at least `cos_half`; all there are if that is -1.
struct NormalCone {
    math::vec3 axis{0.0F, 0.0F, 1.0F};  ///< Of length 1, each coordinate rounded.
    float cos_half = -1.0F;

    friend bool operator==(NormalCone const&, NormalCone const&) noexcept = default;
};

/// The cell, 0 to 6 n^2 - 1, of a direction of any length.
///
/// expects: n from 1 to 104. NaN and zero vectors have a cell, but no meaning.
[[nodiscard]] inline std::uint32_t normal_cell(math::vec3 const& direction, std::uint32_t n) noexcept {
    GNOMON_EXPECT(n >= 1 && n <= 104);
    return gn_normal_cell(formula::Vec3<float>(direction), n).v;
}

namespace detail {

using Corners = std::array<math::dvec3, 4>;

/// The directions to the corners of a cell, each of length 1.
[[nodiscard]] inline Corners cell_corners(std::uint32_t cell, std::uint32_t n) noexcept {
    std::uint32_t const face = cell / (n * n);
    auto const along = static_cast<math::axis_t>(face / 2);
    auto const first = static_cast<math::axis_t>(face < 2 ? 1 : 0);
    auto const second = static_cast<math::axis_t>(face < 4 ? 2 : 1);
    Corners corners;
    for (std::uint32_t i = 0; i < 4; ++i) {
        math::dvec3 p(0.0);
        p[along] = face % 2 == 0 ? 1.0 : -1.0;
        p[first] = 2.0 * (cell % n + i % 2) / n - 1.0;
        p[second] = 2.0 * (cell / n % n + i / 2) / n - 1.0;
        corners[i] = p / std::sqrt(glm::dot(p, p));
    }
    return corners;
}

/// The least cosine of `axis`, of any length, to a corner; -1 for an axis without direction.
[[nodiscard]] inline double least_cosine(math::dvec3 const& axis, Corners const& corners) noexcept {
    double const length_sq = glm::dot(axis, axis);
    if (!(length_sq > 1e-20)) return -1.0;
    double least = 1.0;
    for (math::dvec3 const& corner : corners) least = std::min(least, glm::dot(axis, corner) / std::sqrt(length_sq));
    return least;
}

/// The axis of the narrowest cone that holds the corners: it runs through the middle of two, or at one angle to three.
[[nodiscard]] inline math::dvec3 narrowest_axis(Corners const& corners) noexcept {
    math::dvec3 best = corners[0];
    auto const offer = [&](math::dvec3 const& axis) {
        if (least_cosine(axis, corners) > least_cosine(best, corners)) best = axis;
    };
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j) {
            offer(corners[i] + corners[j]);
            for (std::size_t k = j + 1; k < 4; ++k) {
                math::dvec3 const across = glm::cross(corners[j] - corners[i], corners[k] - corners[i]);
                offer(across);
                offer(-across);
            }
        }
    return best / std::sqrt(glm::dot(best, best));
}

}  // namespace detail

/// The narrowest cone that holds every direction that `normal_cell` puts into `cell`, but for its rounding.
///
/// A cone of less than 90 degrees that holds the corners holds the cell between them. A ratio errs by e = 2^-24, its
/// part of n by 2 e more of the range [0, 1]: a direction is at most 6 e = 4e-7 beyond its cell along each of two axes.
/// Rounding the axis turns it by 1e-7. A cosine falls by at most the angle, less than 7e-7 in all: 1e-6 is taken off.
///
/// expects: n from 1 to 104, cell below 6 n^2
/// source:  [Olsson 2014, Paper II, figure 4]
[[nodiscard]] inline NormalCone cone_of_cell(std::uint32_t cell, std::uint32_t n) noexcept {
    GNOMON_EXPECT(n >= 1 && n <= 104 && cell < 6 * n * n);
    detail::Corners const corners = detail::cell_corners(cell, n);
    math::dvec3 const axis = detail::narrowest_axis(corners);
    return {math::to_float(axis), math::next_down(static_cast<float>(detail::least_cosine(axis, corners) - 1e-6))};
}

/// The cones of all 6 n^2 cells.
///
/// cost: allocates the table
[[nodiscard]] inline std::vector<NormalCone> make_cell_cones(std::uint32_t n) {
    std::vector<NormalCone> cones;
    for (std::uint32_t cell = 0; cell < 6 * n * n; ++cell) cones.push_back(cone_of_cell(cell, n));
    return cones;
}

}  // namespace gnomon::cluster
