#pragma once
// Planes and the conservative test of a box against one.

#include <gnomon/math/bounds.hpp>
#include <gnomon/math/vec.hpp>

#include <cmath>
#include <limits>

namespace gnomon::math {

/// The half-space dot(normal, p) + offset >= 0. The normal need not have unit length.
struct Plane {
    dvec3 normal{0.0, 0.0, 0.0};
    double offset = 1.0;  ///< With a zero normal: everything is inside. That is the default.
};

/// Value of the plane's function at `p`: a distance times the normal's length.
[[nodiscard]] inline double evaluate(Plane const& plane, dvec3 const& p) noexcept {
    return glm::dot(plane.normal, p) + plane.offset;
}

/// Whether no point of the box is in the half-space, for certain.
///
///     v = max over the box of n.p + o, computed with error at most 4 eps (|n_x p_x| + |n_y p_y| + |n_z p_z| + |o|)
///
/// Three products, three sums: each term meets at most four roundings, fused or not, so 4 eps (eps = 2^-53) of the
/// terms' magnitudes bounds the error; the bound itself is rounded, so it is doubled. The box is outside only if v is
/// below minus the bound: a box that exact arithmetic accepts is never rejected (numerics row 4).
[[nodiscard]] inline bool surely_outside(Plane const& plane, Aabb const& box) noexcept {
    double value = plane.offset;
    double magnitude = std::abs(plane.offset);
    for (axis_t axis = 0; axis < 3; ++axis) {
        double const n = plane.normal[axis];
        double const term = n * static_cast<double>(n >= 0.0 ? box.hi[axis] : box.lo[axis]);
        value += term;
        magnitude += std::abs(term);
    }
    return value < -4.0 * std::numeric_limits<double>::epsilon() * magnitude;
}

}  // namespace gnomon::math
