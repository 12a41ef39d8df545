#pragma once
// Near and far distances for a light that stands somewhere, from the bounds of what it can light.

#include <gnomon/math/bounds.hpp>
#include <gnomon/math/vec.hpp>

#include <cmath>
#include <limits>

namespace gnomon::projection {

/// Distances along a light's axis of sight.
struct DepthRange {
    double near_m;
    double far_m;
};

/// The smallest distance from `p` to a point of `box`, and the largest. Empty boxes give (infinity, 0).
[[nodiscard]] inline DepthRange distances_to(math::Aabb const& box, math::dvec3 const& p) noexcept {
    if (math::is_empty(box)) return {std::numeric_limits<double>::infinity(), 0.0};
    math::dvec3 const lo = math::to_double(box.lo) - p;
    math::dvec3 const hi = math::to_double(box.hi) - p;
    math::dvec3 nearest(0.0);
    math::dvec3 farthest(0.0);
    for (math::axis_t axis = 0; axis < 3; ++axis) {
        nearest[axis] = std::fmax(0.0, std::fmax(lo[axis], -hi[axis]));
        farthest[axis] = std::fmax(std::abs(lo[axis]), std::abs(hi[axis]));
    }
    return {glm::length(nearest), glm::length(farthest)};
}

/// A light's depth range, if nothing casts nearer than `nearest_m` and nothing lies beyond `farthest_m`.
///
///     near = nearest / sqrt(3) * 0.999, at least far * 2^-16;  far = min(farthest, range) * 1.001
///
/// At `nearest_m` from a light, a point in a cube face is at least nearest / sqrt(3) away along the face's axis. The
/// floor of 2^-16 keeps the depths of a light that touches a caster usable: what is nearer than that casts no shadow.
/// The same factor serves spots up to a half angle of 54.7 degrees; wider ones pass `widest_cos` = cos(window's
/// corner).
///
/// returns: 0 < near < far always; (2^-17, 1) m where the far distance is not in (1e-30, 1e30) m, so that a view can
/// still be made.
[[nodiscard]] inline DepthRange depth_range(double nearest_m, double farthest_m, double range_m,
                                            double widest_cos = 0.57735026918962573) noexcept {
    double const beyond = farthest_m < range_m ? farthest_m : range_m;
    double const far_m = beyond > 1e-30 && beyond < 1e30 ? beyond * 1.001 : 1.0;
    double const least = std::ldexp(far_m, -16);
    double const near_m = nearest_m * widest_cos * 0.999;
    if (!(near_m > least)) return {least, far_m};
    return {near_m < far_m * 0.5 ? near_m : far_m * 0.5, far_m};
}

}  // namespace gnomon::projection
